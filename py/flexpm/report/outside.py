# SPDX-License-Identifier: GPL-3.0-or-later
"""The outside of a solid, seen from the front, the right and above, and its section. SI units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from ..arrays import FloatArray, IntArray
from ..files import remove_earlier
from ..results.solids.state import SolidSnapshot, edge_keys
from ..text import label_of
from .joint_colours import joint_colour, joint_handles
from .maps import MINERALS, crack_segments, draw_joints, draw_scale_bar
from .style import COLOURS, STYLE, can_be_drawn, colour_limits, save

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
#: Width of the trace of a joint and of the edge of a face [point].
_TRACE, _LINE = 1.8, 0.3
#: Distance of a trace from its face towards the viewer, over the longest side [-].
_ABOVE = 0.04
#: Edges (n, 2) of each joint on the surface, by its name.
Traces = Mapping[str, IntArray]
Colour = tuple[float, ...]


class _Piece(NamedTuple):
    """A face, or an edge as a polygon of two corners."""

    corners: FloatArray  #: in the picture, (n, 2) [mm]
    fill: Colour
    edge: Colour
    width: float  #: of the edge [point]
    depth: float  #: towards the viewer [m]


def outside_picture(
    path: Path | str,
    vertices: FloatArray,
    faces: Sequence[IntArray],
    grains: IntArray,
    caption: str = "",
    traces: Traces | None = None,
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
        width, height = draw_faces(axes, vertices, faces, grains, traces=traces)
        figure.set_figwidth(max(2.6, tall * width / height + 0.4))
        _add_legend(axes, traces or {})
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
    traces: Traces | None = None,
) -> tuple[float, float]:
    """Plot the faces towards the viewer, the farther faces first.

    Args:
        axes: Axes to plot in.
        vertices: Positions (n, 3) [m].
        faces: Vertices of each outer face, counter-clockwise as seen from outside.
        grains: Grain of each of these faces.
        edges: Whether their edges are plotted.
        minerals: Index of each grain's mineral, which then selects the colour.
        traces: Edges (n, 2) of each joint on the surface, by its name. Faces in front hide them.

    Returns:
        Width and height of the plotted faces [mm].
    """
    eye, axes_of_picture = _view()
    light = _LIGHT / np.linalg.norm(_LIGHT)
    tints = _GRAINS if minerals is None else np.array([to_rgb(one) for one in MINERALS])
    pieces, chosen = [], []
    for face, grain in zip(faces, grains, strict=True):
        corners = vertices[face]
        normal = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
        length = np.linalg.norm(normal)
        if not normal @ eye > 0.0:
            continue
        lit = max(float(normal @ light) / float(length), 0.0)
        # neighbours in number are neighbours in space: steps by 3 of 7 colours tell them apart
        number = 3 * int(grain) if minerals is None else int(minerals[grain])
        fill = tuple((_SHADE + (1.0 - _SHADE) * lit) * tints[number % len(tints)])
        depth = float(corners.mean(axis=0) @ eye)
        shape = 1e3 * corners @ axes_of_picture
        pieces.append(_Piece(shape, fill, _EDGE if edges else fill, _LINE, depth))
        chosen.append(face)
    places = np.vstack([one.corners for one in pieces])
    low, high = places.min(axis=0), places.max(axis=0)
    width, height = high - low
    depths = np.array([one.depth for one in pieces])
    pieces += _trace_pieces(vertices, chosen, depths, traces or {})
    pieces.sort(key=lambda one: one.depth)
    polygons, fills, outlines, widths, _ = zip(*pieces, strict=True)
    shown = PolyCollection(polygons, facecolors=fills, edgecolors=outlines, linewidths=widths)
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


def _trace_pieces(
    vertices: FloatArray, faces: Sequence[IntArray], depths: FloatArray, traces: Traces
) -> Iterator[_Piece]:
    """Yield the edges of joints among these faces.

    An edge is a little nearer to the viewer than its face, so that it is drawn after the face.
    """
    sizes = np.array([len(face) for face in faces])
    corners, ends = np.concatenate(faces), np.cumsum(sizes)
    after = np.arange(len(corners)) + 1
    after[ends - 1] = ends - sizes
    pairs = np.column_stack((corners, corners[after]))
    keys, owner = edge_keys(*pairs.T), np.repeat(np.arange(len(faces)), sizes)
    above = _ABOVE * float(np.ptp(vertices, axis=0).max())
    for number, edges in enumerate(traces.values()):
        chosen, colour = np.isin(keys, edge_keys(*edges.T)), to_rgb(joint_colour(number))
        lines = 1e3 * vertices[pairs[chosen]] @ _view()[1]
        for line, depth in zip(lines, depths[owner[chosen]].tolist(), strict=True):
            yield _Piece(line, colour, colour, _TRACE, depth + above)


def _add_legend(axes: Axes, traces: Traces) -> None:
    """Add a legend of the joints on the surface below the plot."""
    shown = {number: name for number, name in enumerate(traces) if len(traces[name])}
    if shown:
        axes.legend(
            handles=joint_handles(shown),
            loc="upper left",
            bbox_to_anchor=(0.0, 0.0),
            ncol=2,
            frameon=False,
        )


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
        traces = snapshot.joint_traces()
        draw_faces(
            outside,
            snapshot.positions,
            list(faces),
            grains,
            edges=False,
            minerals=snapshot.grain_mineral,
            traces=traces,
        )
        _add_legend(outside, traces)
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
    draw_joints(axes, section)
    for mode, segments in crack_segments(section).items():
        axes.add_collection(LineCollection(1e3 * segments, colors=COLOURS[mode], linewidths=1.2))
    axes.autoscale_view()
    draw_scale_bar(axes)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title("section with cracks", fontsize=9.5)
    figure.colorbar(triangles, ax=axes, shrink=0.7, label="stress along z [MPa], tension > 0")
