# SPDX-License-Identifier: GPL-3.0-or-later
"""The outside of a solid, seen from the front, the right and above, and its section. SI units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from ..arrays import FloatArray, IntArray
from ..files import remove_earlier
from ..results.solids.state import SolidSnapshot
from ..text import label_of
from .maps import MINERALS, crack_segments, draw_scale_bar
from .style import COLOURS, CYCLE, STYLE, can_be_drawn, colour_limits, save

#: Where the eye is, far away, in space.
_EYE = np.array([0.42, -0.80, 0.43])
#: Where the light comes from.
_LIGHT = np.array([0.15, -0.75, 0.65])
#: Darkest share of a colour, on faces that the light does not reach.
_SHADE = 0.55
#: Colours of grains, drawn by their numbers.
_GRAINS = np.array(
    [
        (0.85, 0.80, 0.72),
        (0.76, 0.70, 0.62),
        (0.90, 0.87, 0.82),
        (0.70, 0.67, 0.66),
        (0.82, 0.72, 0.66),
        (0.64, 0.62, 0.58),
        (0.88, 0.80, 0.76),
    ]
)
_EDGE = (0.25, 0.23, 0.22)
#: Most joints that a legend names.
_MOST_NAMES = 8


def outside_picture(
    path: Path | str,
    vertices: FloatArray,
    faces: Sequence[IntArray],
    grains: IntArray,
    caption: str = "",
    traces: Mapping[str, IntArray] | None = None,
) -> None:
    """Plot the visible faces of a convex 3D specimen, each grain in its own colour.

    The specimen is convex, so faces towards the viewer never hide each other.

    Args:
        path: File of the figure.
        vertices: Positions (n, 3) [m].
        faces: Vertices of each outer face, counter-clockwise as seen from outside.
        grains: Grain of each of these faces.
        caption: Line above the figure.
        traces: Edges (n, 2) of each joint on the surface, by its name.
    """
    with rc_context(STYLE):
        tall = 5.6
        figure = Figure(figsize=(tall, tall), layout="constrained")
        axes = figure.add_subplot()
        width, height = draw_faces(axes, vertices, faces, grains)
        figure.set_figwidth(max(2.6, tall * width / height + 0.4))
        if traces:
            _draw_traces(axes, vertices, faces, traces)
            axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.0), ncol=2, frameon=False)
        axes.set_title(label_of(caption), fontsize=9.5, loc="left")
        save(figure, path)


def draw_faces(
    axes: Axes,
    vertices: FloatArray,
    faces: Sequence[IntArray],
    grains: IntArray,
    *,
    edges: bool = True,
    minerals: IntArray | None = None,
) -> tuple[float, float]:
    """Plot the faces towards the viewer, the farther faces first.

    Args:
        axes: Axes to plot in.
        vertices: Positions (n, 3) [m].
        faces: Vertices of each outer face, counter-clockwise as seen from outside.
        grains: Grain of each of these faces.
        edges: Whether their edges are plotted.
        minerals: Index of each grain's mineral, which then selects the colour.

    Returns:
        Width and height of the plotted faces [mm].
    """
    eye, axes_of_picture = _view()
    light = _LIGHT / np.linalg.norm(_LIGHT)
    tints = _GRAINS if minerals is None else np.array([to_rgb(one) for one in MINERALS])
    seen, colours, depths = [], [], []
    for face, grain in zip(faces, grains, strict=True):
        corners = vertices[face]
        normal = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
        length = np.linalg.norm(normal)
        if not normal @ eye > 0.0:
            continue
        lit = max(float(normal @ light) / float(length), 0.0)
        # neighbours in number are neighbours in space: steps by 3 of 7 colours tell them apart
        number = 3 * int(grain) if minerals is None else int(minerals[grain])
        colours.append((_SHADE + (1.0 - _SHADE) * lit) * tints[number % len(tints)])
        seen.append(1e3 * corners @ axes_of_picture)
        depths.append(float(corners.mean(axis=0) @ eye))
    places = np.vstack(seen)
    low, high = places.min(axis=0), places.max(axis=0)
    width, height = high - low
    shown = PolyCollection(
        [seen[k] for k in np.argsort(depths)],
        facecolors=[colours[k] for k in np.argsort(depths)],
        edgecolors=_EDGE if edges else "face",
        linewidths=0.3,
    )
    axes.add_collection(shown)
    margin = 0.02 * height
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return float(width), float(height)


def _view() -> tuple[FloatArray, FloatArray]:
    """Direction to the viewer, and the directions (3, 2) to the right and upwards."""
    eye: FloatArray = _EYE / np.linalg.norm(_EYE)
    right = np.cross([0.0, 0.0, 1.0], eye)
    right /= np.linalg.norm(right)
    return eye, np.column_stack((right, np.cross(eye, right)))


def _draw_traces(
    axes: Axes,
    vertices: FloatArray,
    faces: Sequence[IntArray],
    traces: Mapping[str, IntArray],
) -> None:
    """Plot the edges of joints that belong to a face towards the viewer."""
    eye, axes_of_picture = _view()
    shown: set[tuple[int, int]] = set()
    for face in faces:
        corners = vertices[face]
        normal = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
        if normal @ eye > 0.0:
            ends = zip(face.tolist(), np.roll(face, -1).tolist(), strict=True)
            shown |= {(min(pair), max(pair)) for pair in ends}
    for number, (name, edges) in enumerate(traces.items()):
        seen = [pair for pair in edges.tolist() if tuple(pair) in shown]
        lines = 1e3 * vertices[np.array(seen, dtype=int).reshape(-1, 2)] @ axes_of_picture
        colour = CYCLE[number % len(CYCLE)]
        label = label_of(f"joint {name}") if number < _MOST_NAMES else None
        axes.add_collection(LineCollection(list(lines), colors=colour, linewidths=1.8, label=label))


def draw_solid(path: Path | str, snapshot: SolidSnapshot, caption: str = "") -> None:
    """Plot the surface of a 3D specimen next to its section, which has the colours of the z stress.

    A state without positions, of a run that has diverged, is not plotted.

    Args:
        path: File of the figure.
        snapshot: The state.
        caption: Line above the figure.
    """
    if not can_be_drawn(snapshot.positions[:, [0, 2]]):
        remove_earlier(path)
        return
    with rc_context(STYLE):
        figure = Figure(figsize=(7.2, 5.2), layout="constrained")
        outside, cut = figure.subplots(1, 2)
        faces, grains = _shown_faces(snapshot)
        draw_faces(
            outside,
            snapshot.positions,
            list(faces),
            grains,
            edges=False,
            minerals=snapshot.grain_mineral,
        )
        _draw_section(figure, cut, snapshot)
        figure.suptitle(label_of(caption), fontsize=9.5)
        save(figure, path)


def _shown_faces(snapshot: SolidSnapshot) -> tuple[IntArray, IntArray]:
    """Triangles of the surface and, of grains with a cracked contact, all that bound the grain.

    Cracked faces may have moved apart. Triangles of faces that still lie on each other are hidden
    by those in front of them.

    Returns:
        Nodes (n, 3), counter-clockwise as seen from outside, and the grain of each triangle.
    """
    cracked = ~snapshot.any_of(snapshot.point_damage < 1.0)
    torn = np.unique(snapshot.contact_grains[cracked])
    chosen = np.isin(snapshot.tetrahedron_grain, torn)
    nodes = snapshot.tetrahedra[chosen]
    faces = np.concatenate([np.delete(nodes, opposite, axis=1) for opposite in range(4)])
    apexes = nodes.T.ravel()
    of_grain = np.tile(snapshot.tetrahedron_grain[chosen], 4)
    _, first, counts = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    outer = first[counts == 1]
    faces, apexes, of_grain = faces[outer], apexes[outer], of_grain[outer]
    a, b, c = (snapshot.positions[faces[:, k]] for k in range(3))
    inside = np.einsum("ij,ij->i", np.cross(b - a, c - a), snapshot.positions[apexes] - a) > 0.0
    faces[inside] = faces[inside][:, ::-1]
    kept = ~np.isin(snapshot.surface_grain, torn)
    return (
        np.vstack((snapshot.surface[kept], faces)),
        np.concatenate((snapshot.surface_grain[kept], of_grain)),
    )


def _draw_section(figure: Figure, axes: Axes, snapshot: SolidSnapshot) -> None:
    section = snapshot.section
    stress = 1e-6 * section.triangle_stress[:, 1]
    low, high = colour_limits(stress)
    corners: FloatArray = 1e3 * section.positions[section.triangles]
    triangles = PolyCollection(list(corners), array=stress, cmap="viridis", edgecolors="face")
    triangles.set(clim=(low, max(high, low + 1e-9)), linewidth=0.2)
    axes.add_collection(triangles)
    for mode, segments in crack_segments(section).items():
        axes.add_collection(LineCollection(1e3 * segments, colors=COLOURS[mode], linewidths=1.2))
    axes.autoscale_view()
    draw_scale_bar(axes)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title("section with cracks", fontsize=9.5)
    figure.colorbar(triangles, ax=axes, shrink=0.7, label="stress along z [MPa], tension > 0")
