# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of a specimen: its grains and mesh (paper Fig. 5), cracks (Fig. 10), fragments, minerals.

Input in SI units; labels in mm.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..arrays import FloatArray, IntArray
from ..files import Table, remove_earlier
from ..results.cracks import ERASED, SHEAR, TENSILE
from ..results.fragments import Fragments
from ..results.snapshot import Snapshot
from ..text import label_of
from .joint_colours import joint_colour, joint_handles
from .style import COLOURS, CUT, MODE_NAMES, STYLE, can_be_drawn, save

if TYPE_CHECKING:
    from .._flexpm import GrainMeshes, Tessellation

_GRAIN_TINTS = ("#ece7dc", "#e2dccd", "#d8d1bf", "#f2eee6")
#: Fragments by their rank, loose grains; the largest fragment has the first tint of the grains.
_FRAGMENTS = ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#0072b2", "#d55e00")
_LOOSE = "#8c8674"
#: Minerals in their order.
MINERALS = ("#f2eee6", "#c9bfa8", "#9fb0bd", "#c7a6a0", "#a9b99a", "#8f8a80")
_EDGE = "#6b6455"
#: Plates and held nodes of a rig.
_PART = "#3a5a78"
#: Pairs of minerals that a legend names.
_MOST_PAIRS = 6


def specimen_picture(
    path: Path | str,
    polygons: Sequence[FloatArray],
    mesh: tuple[FloatArray, IntArray] | None = None,
    caption: str = "",
    joints: Sequence[FloatArray] = (),
    joint_names: Sequence[str] = (),
) -> None:
    """Plot the grains of a specimen.

    Args:
        path: File of the figure.
        polygons: Corners (V, 2) of each grain [m].
        mesh: Nodes (N, 2) [m] and triangles (M, 3) to plot in the grains.
        caption: Line above the map.
        joints: Ends (n, 2, 2) [m] of the contacts of each joint.
        joint_names: Names of the joints, for a legend.
    """
    with rc_context(STYLE):
        figure, axes = map_figure(polygons)
        _draw_grains(axes, polygons)
        for number, ends in enumerate(joints):
            colour = joint_colour(number)
            axes.add_collection(LineCollection(1e3 * ends, colors=colour, linewidths=1.4))
        cut = {k: name for k, name in enumerate(joint_names) if len(joints[k])}
        _add_legend(figure, axes, joint_handles(cut), 2)
        if mesh is not None:
            nodes, triangles = (1e3 * np.asarray(mesh[0]), np.asarray(mesh[1]))
            lines = LineCollection(nodes[_unique_edges(triangles)], colors=_EDGE, linewidths=0.15)
            axes.add_collection(lines)
        draw_scale_bar(axes)
        axes.set_title(label_of(caption), fontsize=9.5, loc="left")
        save(figure, path)


def grain_picture(
    path: Path | str,
    polygons: Sequence[FloatArray],
    kinds: Sequence[int] | IntArray,
    names: Sequence[str] = (),
    caption: str = "",
) -> None:
    """Plot cells in the colour of their mineral, or of their grain.

    Args:
        path: File of the figure.
        polygons: Corners (V, 2) of each cell [m].
        kinds: Index of the mineral of each cell, or index of its grain.
        names: Names of the minerals, for a legend; none: `kinds` are grains.
        caption: Line above the map.
    """
    tints = _tints(kinds) if not names else [MINERALS[kind % len(MINERALS)] for kind in kinds]
    with rc_context(STYLE):
        figure, axes = map_figure(polygons)
        _draw_grains(axes, polygons, tints)
        draw_scale_bar(axes)
        _add_legend(figure, axes, _mineral_handles(names), 1)
        axes.set_title(label_of(caption), fontsize=9.5, loc="left")
        save(figure, path)


def crack_picture(
    path: Path | str,
    snapshot: Snapshot,
    caption: str = "",
    minerals: Sequence[str] = (),
    notches: Sequence[str] = (),
    by_pair: Mapping[str, Mapping[str, int]] | None = None,
    parts: Sequence[Table] = (),
) -> None:
    """Plot the deformed grains with their cracks; each point colours its tributary length.

    A state without positions, of a run that has diverged, is not plotted.

    Args:
        path: File of the figure.
        snapshot: The state.
        caption: Line above the map.
        minerals: Names of the minerals, for the legend.
        notches: Names of the joints that are cut open before the test.
        by_pair: Cracks of each pair of minerals by mode, for the legend.
        parts: Parts of a rig, with their faces.
    """
    if not can_be_drawn(snapshot.positions):
        remove_earlier(path)
        return
    with rc_context(STYLE):
        save(crack_figure(snapshot, caption, minerals, notches, by_pair, parts), path)


def crack_figure(
    snapshot: Snapshot,
    caption: str = "",
    minerals: Sequence[str] = (),
    notches: Sequence[str] = (),
    by_pair: Mapping[str, Mapping[str, int]] | None = None,
    parts: Sequence[Table] = (),
) -> Figure:
    """Return the figure of `crack_picture`."""
    with rc_context(STYLE):
        figure, axes = map_figure([snapshot.positions])
        handles = draw_cracks(axes, snapshot)
        handles += draw_joints(axes, snapshot, notches) + _draw_parts(axes, parts)
        handles += _mineral_handles(minerals)
        handles += _pair_handles(by_pair or {})
        _add_legend(figure, axes, handles, 1 if by_pair else 2)  # names of pairs are long
        axes.set_title(label_of(caption), fontsize=9.5, loc="left")
    return figure


def draw_cracks(axes: Axes, snapshot: Snapshot) -> list[Line2D]:
    """Plot the deformed grains and their cracks [mm]; return the handles of a legend."""
    tints = None
    if snapshot.grain_mineral is not None:
        tints = [MINERALS[number % len(MINERALS)] for number in snapshot.grain_mineral]
    _draw_rock(axes, snapshot, tints)
    segments, handles = crack_segments(snapshot), []
    for mode in (TENSILE, SHEAR):
        colour = COLOURS[mode]
        lines = LineCollection(1e3 * segments[mode], colors=colour, linewidths=1.3, zorder=1.5)
        axes.add_collection(lines)
        points = int(np.count_nonzero(snapshot.crack_mode == mode))
        label = f"{MODE_NAMES[mode]} ({points})"
        handles.append(Line2D([], [], color=colour, lw=2.0, label=label))
    handles += _draw_erased(axes, snapshot)
    draw_scale_bar(axes)
    return handles


def draw_grains(axes: Axes, snapshot: Snapshot) -> None:
    """Plot the deformed grains and a scale bar below them [mm]."""
    _draw_rock(axes, snapshot)
    draw_scale_bar(axes)


def _mineral_handles(names: Sequence[str]) -> list[Patch]:
    return [
        Patch(facecolor=MINERALS[number % len(MINERALS)], edgecolor=_EDGE, label=label_of(name))
        for number, name in enumerate(names)
    ]


def _pair_handles(by_pair: Mapping[str, Mapping[str, int]]) -> list[Patch]:
    """Return lines of a legend without a colour: the pairs of minerals with most cracks."""
    order = sorted(by_pair, key=lambda pair: (-sum(by_pair[pair].values()), pair))
    texts = [
        f"{pair}: {', '.join(f'{number} {mode}' for mode, number in by_pair[pair].items())}"
        for pair in order[:_MOST_PAIRS]
    ]
    if len(order) > _MOST_PAIRS:
        texts.append(f"{len(order) - _MOST_PAIRS} other pairs")
    return [Patch(alpha=0.0, label=label_of(text)) for text in texts]


def draw_joints(axes: Axes, snapshot: Snapshot, notches: Sequence[str] = ()) -> list[Line2D]:
    """Plot joints below the cracks in their colours, and notches above; return their handles.

    Args:
        axes: Axes to plot in [mm].
        snapshot: The state.
        notches: Names of the joints that are cut open before the test.
    """
    if snapshot.contact_joint is None:
        return []
    shown = {
        number: name
        for number, name in enumerate(snapshot.joint_names)
        if np.any(snapshot.contact_joint == number)
    }
    for number, name in shown.items():
        ends = 1e3 * snapshot.contact_ends[snapshot.contact_joint == number]
        if name in notches:
            look = {"colors": CUT, "linewidths": 2.2, "zorder": 1.6}
        else:
            look = {"colors": joint_colour(number), "linewidths": 3.0, "zorder": 1.4}
        axes.add_collection(LineCollection(list(ends), **look))
    handles = joint_handles({k: name for k, name in shown.items() if name not in notches})
    if any(name in notches for name in shown.values()):
        handles.append(Line2D([], [], color=CUT, lw=2.2, label="notch"))
    return handles


def _add_legend(
    figure: Figure, axes: Axes, handles: Sequence[Line2D | Patch], columns: int
) -> None:
    """Add a legend below a map, which becomes higher by more than one row of it."""
    if not handles:
        return
    rows = math.ceil(len(handles) / columns)
    figure.set_figheight(figure.get_figheight() + 0.2 * (rows - 1))
    place = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0)}
    axes.legend(handles=handles, ncol=columns, frameon=False, **place)


def _draw_parts(axes: Axes, parts: Sequence[Table]) -> list[Line2D]:
    """Plot plates and boxes around fixed nodes where they were placed; return a handle if any."""
    if not (faces := [1e3 * np.array(part["face"]) for part in parts if part.get("face")]):
        return []
    axes.add_collection(LineCollection(faces, colors=_PART, linewidths=2.6, zorder=1.7))
    return [Line2D([], [], color=_PART, lw=2.6, label="parts")]


def _draw_erased(axes: Axes, snapshot: Snapshot) -> list[Line2D]:
    """Plot the erased bonds between existing grains as cuts; return a handle if any exists."""
    if snapshot.erased_ends is None:
        return []
    cuts = snapshot.erased_ends[np.all(np.isfinite(snapshot.erased_ends), axis=(1, 2))]
    if not len(cuts):
        return []
    colour = COLOURS[ERASED]
    axes.add_collection(LineCollection(1e3 * cuts, colors=colour, linewidths=1.6, zorder=1.6))
    label = f"{MODE_NAMES[ERASED]} ({len(cuts)})"
    return [Line2D([], [], color=colour, lw=2.0, label=label)]


def fragment_picture(
    path: Path | str, snapshot: Snapshot, caption: str = "", of: Fragments | None = None
) -> None:
    """Plot the deformed grains in the colour of their fragment.

    Grains of the largest fragment are pale; grains without any connection are dark.

    Args:
        path, snapshot, caption: As for `crack_picture`; the number of fragments is below the map.
        of: Fragments of the 3D state of which `snapshot` is a section; None: of `snapshot`.
    """
    if not can_be_drawn(snapshot.positions):
        remove_earlier(path)
        return
    with rc_context(STYLE):
        save(fragment_figure(snapshot, caption, of), path)


def fragment_figure(snapshot: Snapshot, caption: str = "", of: Fragments | None = None) -> Figure:
    """Return the figure of `fragment_picture`."""
    found = snapshot.fragments if of is None else of
    colours = [
        _FRAGMENTS[rank % len(_FRAGMENTS)] if grains > 1 else _LOOSE
        for rank, grains in enumerate(found.grains)
    ]
    colours[0] = _GRAIN_TINTS[0]
    with rc_context(STYLE):
        figure, axes = map_figure([snapshot.positions])
        _draw_rock(axes, snapshot, [colours[rank] for rank in found.labels])
        draw_scale_bar(axes)
        size = "area" if of is None or of is snapshot.fragments else "volume"
        largest = 100.0 * found.areas[0] / found.areas.sum()
        text = f"{len(found)} fragments, the largest has {largest:.0f} % of the {size}"
        text = text if len(found) > 1 else "1 fragment"
        lines = [line for line in (label_of(caption), text) if line]
        axes.set_title("\n".join(lines), fontsize=9.5, loc="left")
    return figure


def cell_polygons(tessellation: Tessellation) -> list[FloatArray]:
    """Corners (V, 2) [m] of each cell of a tessellation."""
    corners = tessellation.vertices[tessellation.cell_vertices]
    return np.split(corners, tessellation.cell_offsets[1:-1])


def mesh_triangles(meshes: GrainMeshes) -> tuple[FloatArray, IntArray]:
    """Nodes (N, 2) [m] and triangles (M, 3) of all grains from the meshes of each."""
    offsets = np.repeat(meshes.node_offsets[:-1], np.diff(meshes.triangle_offsets))
    return np.asarray(meshes.nodes), np.asarray(meshes.triangles) + offsets[:, None]


def grain_corners(triangles: IntArray) -> list[IntArray]:
    """Outer nodes of each grain in order, from its counter-clockwise triangles.

    Grains share no nodes, so an edge that belongs to one triangle only lies on an outline.
    """
    triangles = np.asarray(triangles)
    starts, ends = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    base = int(triangles.max(initial=0)) + 1
    outer = ~np.isin(starts * base + ends, ends * base + starts)
    following = dict(zip(starts[outer].tolist(), ends[outer].tolist(), strict=True))
    loops = []
    while following:
        first, node = following.popitem()
        loop = [first]
        while node != first:
            loop.append(node)
            node = following.pop(node)
        loops.append(np.array(loop))
    return loops[::-1]


def _grains_of(snapshot: Snapshot, outlines: Sequence[IntArray]) -> IntArray:
    """Return the grain of each outline."""
    node_grain = np.zeros(len(snapshot.positions), dtype=int)
    node_grain[np.ravel(snapshot.triangles)] = np.repeat(snapshot.triangle_grain, 3)
    return node_grain[[corners[0] for corners in outlines]]


def crack_segments(snapshot: Snapshot) -> dict[int, FloatArray]:
    """Segments (K, 2, 2) [m] of the cracked points by mode; a point covers its share of area."""
    pieces = snapshot.point_segments
    return {mode: pieces[snapshot.crack_mode == mode] for mode in (TENSILE, SHEAR)}


def map_figure(polygons: Sequence[FloatArray]) -> tuple[Figure, Axes]:
    """Return a figure with the size and the axes [mm] of a map, for grains with corners [m]."""
    corners = 1e3 * np.concatenate(polygons)
    low, high = corners.min(axis=0), corners.max(axis=0)
    width, height = high - low
    scale = min(6.5 / height, 5.0 / width)
    figure = Figure(figsize=(width * scale + 0.3, height * scale + 0.9), layout="constrained")
    axes = figure.add_subplot(aspect="equal")
    margin = 0.02 * max(width, height)
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - 2.5 * margin, high[1] + margin)  # the scale bar stands below
    axes.set_axis_off()
    return figure, axes


def _draw_rock(axes: Axes, snapshot: Snapshot, tints: Sequence[str] | None = None) -> None:
    """Plot the deformed grains; without lines between inner particles.

    Args:
        axes: Axes to plot in.
        snapshot: The state.
        tints: Colour of each grain.
    """
    outlines = grain_corners(snapshot.triangles)
    polygons = [snapshot.positions[corners] for corners in outlines]
    grains = _grains_of(snapshot, outlines)
    chosen = _tints(grains) if tints is None else [tints[grain] for grain in grains]
    if len(np.unique(grains)) == len(grains):
        _draw_grains(axes, polygons, chosen)
        return
    _draw_grains(axes, polygons, chosen, edges="face")
    pairs = snapshot.contact_grains
    between = 1e3 * snapshot.contact_ends[pairs[:, 0] != pairs[:, 1]]
    axes.add_collection(LineCollection(between, colors=_EDGE, linewidths=0.25))


def _tints(numbers: Iterable[int]) -> list[str]:
    return [_GRAIN_TINTS[number * 7 % len(_GRAIN_TINTS)] for number in numbers]


def _draw_grains(
    axes: Axes,
    polygons: Sequence[FloatArray],
    tints: Sequence[str] | None = None,
    edges: str = _EDGE,
) -> None:
    if tints is None:
        tints = _tints(range(len(polygons)))
    scaled = [1e3 * np.asarray(polygon) for polygon in polygons]
    grains = PolyCollection(scaled, facecolors=tints, edgecolors=edges, linewidths=0.25)
    axes.add_collection(grains)


def draw_scale_bar(axes: Axes) -> None:
    """Draw a bar of a round length, about a quarter of the width, below the lower left corner."""
    data = axes.dataLim
    quarter = data.width / 4.0
    decade = 10.0 ** math.floor(math.log10(quarter))
    most = quarter * (1.0 + 1e-9)  # one that is a decade to round-off
    length = max(step for step in (1.0, 2.0, 5.0) if step * decade <= most) * decade
    gap = 0.03 * max(data.width, data.height)
    ends, place = (data.x0, data.x0 + length), data.y0 - gap
    axes.plot(ends, (place, place), color="black", lw=2.0, solid_capstyle="butt")
    axes.text(ends[1] + 0.5 * gap, place, f"{length:g} mm", va="center", ha="left")


def _unique_edges(triangles: IntArray) -> IntArray:
    edges = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2)
    found: IntArray = np.unique(np.sort(edges, axis=1), axis=0)
    return found
