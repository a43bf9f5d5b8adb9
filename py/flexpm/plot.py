# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures: stress-strain curve (paper Figs. 8, 15), specimen (Fig. 5) and cracks (Fig. 10).

Input in SI units; labels in MPa, % and mm. No window is opened and no display is needed.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from . import curve as measures
from . import fragments
from .curve import Curve
from .files import whole_file
from .results import SHEAR, TENSILE, Result

#: Colours that stay apart for colour-blind readers and in print.
COLOURS = {TENSILE: "#0072b2", SHEAR: "#d55e00"}
MODE_NAMES = {TENSILE: "tensile cracks", SHEAR: "shear cracks"}
_GRAIN_TINTS = ("#ece7dc", "#e2dccd", "#d8d1bf", "#f2eee6")
#: Fragments by their rank, loose grains; the largest fragment has the first tint of the grains.
_FRAGMENTS = ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#0072b2", "#d55e00")
_LOOSE = "#8c8674"
#: Minerals in their order.
_MINERALS = ("#f2eee6", "#c9bfa8", "#9fb0bd", "#c7a6a0", "#a9b99a", "#8f8a80")
_EDGE = "#6b6455"
#: Settings of all pictures.
STYLE = {
    "font.size": 9.0,
    "axes.labelsize": 9.5,
    "legend.fontsize": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "savefig.dpi": 220,
    "lines.solid_capstyle": "round",
}


def curve_picture(path: Path | str, result: Result) -> None:
    """Draw stress and crack counts over strain, the line of Young's modulus, and the peak."""
    with rc_context(STYLE):
        figure = Figure(figsize=(5.6, 3.9), layout="constrained")
        axes = figure.add_subplot()
        record = result.curve
        strain = 100.0 * record["axial_strain"]
        counts = axes.twinx()
        _draw_counts(counts, strain, record)
        axes.set_zorder(counts.get_zorder() + 1)  # the curve lies over the counts
        axes.patch.set_visible(False)
        (line,) = axes.plot(strain, 1e-6 * record["axial_stress"], color="black", lw=1.6)
        line.set_label("axial stress")
        _draw_modulus(axes, result)
        _draw_peak(axes, result)
        axes.set_xlabel("axial strain [%]")
        axes.set_ylabel("axial stress [MPa]")
        axes.set_xlim(left=0.0)
        axes.set_ylim(bottom=0.0, top=1.18 * axes.get_ylim()[1])  # room for the peak's label
        handles = [*axes.get_legend_handles_labels()[0], *counts.get_legend_handles_labels()[0]]
        axes.legend(handles=handles, loc="upper left", frameon=False)
        axes.set_title(_caption(result), fontsize=9.5, loc="left")
        save(figure, path)


def specimen_picture(
    path: Path | str,
    polygons: Sequence[np.ndarray],
    mesh: tuple[np.ndarray, np.ndarray] | None = None,
    caption: str = "",
) -> None:
    """Draw the grains of a specimen.

    Args:
        path: Picture to write.
        polygons: Corners (V, 2) of each grain [m].
        mesh: Nodes (N, 2) [m] and triangles (M, 3) to draw in the grains.
        caption: Line above the picture.
    """
    with rc_context(STYLE):
        figure, axes = _map_figure(polygons)
        _draw_grains(axes, polygons)
        if mesh is not None:
            nodes, triangles = (1e3 * np.asarray(mesh[0]), np.asarray(mesh[1]))
            lines = LineCollection(nodes[_unique_edges(triangles)], colors=_EDGE, linewidths=0.15)
            axes.add_collection(lines)
        _draw_scale_bar(axes)
        axes.set_title(caption, fontsize=9.5, loc="left")
        save(figure, path)


def crack_picture(
    path: Path | str,
    snapshot: Mapping[str, np.ndarray],
    caption: str = "",
    minerals: Sequence[str] = (),
) -> None:
    """Draw the deformed grains with their cracks; each point colours its share of a contact.

    Args:
        path: Picture to write.
        snapshot: Arrays as for :func:`flexpm.export.write_vtu`.
        caption: Line above the picture.
        minerals: Their names, for the legend.
    """
    with rc_context(STYLE):
        figure, axes = _map_figure([snapshot["positions"]])
        handles = draw_cracks(axes, snapshot)
        handles += [
            Patch(facecolor=_MINERALS[number % len(_MINERALS)], edgecolor=_EDGE, label=name)
            for number, name in enumerate(minerals)
        ]
        axes.legend(
            handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2, frameon=False
        )
        axes.set_title(caption, fontsize=9.5, loc="left")
        save(figure, path)


def draw_cracks(axes: Axes, snapshot: Mapping[str, np.ndarray]) -> list[Line2D]:
    """Draw the deformed grains and their cracks [mm]; return the handles of a legend."""
    outlines = grain_corners(snapshot["triangles"])
    tints = None
    if "grain_mineral" in snapshot:
        minerals = np.asarray(snapshot["grain_mineral"])[_grains_of(snapshot, outlines)]
        tints = np.array(_MINERALS)[minerals % len(_MINERALS)]
    _draw_grains(axes, [snapshot["positions"][corners] for corners in outlines], tints)
    segments, handles = crack_segments(snapshot), []
    for mode in (TENSILE, SHEAR):
        lines = LineCollection(1e3 * segments[mode], colors=COLOURS[mode], linewidths=1.3)
        axes.add_collection(lines)
        points = int(np.count_nonzero(np.asarray(snapshot["crack_mode"]) == mode))
        label = f"{MODE_NAMES[mode]} ({points})"
        handles.append(Line2D([], [], color=COLOURS[mode], lw=2.0, label=label))
    _draw_scale_bar(axes)
    return handles


def fragment_picture(
    path: Path | str, snapshot: Mapping[str, np.ndarray], caption: str = ""
) -> None:
    """Draw the deformed grains in the colour of their fragment.

    Grains of the largest fragment are pale, grains that hang on no other one are dark.

    Args:
        path: Picture to write.
        snapshot: Arrays as for :func:`flexpm.export.write_vtu`.
        caption: Line above the picture; if empty, the number of fragments.
    """
    found = fragments.of_snapshot(snapshot)
    colours = [_FRAGMENTS[rank % len(_FRAGMENTS)] for rank in range(len(found))]
    colours = np.where(found.grains > 1, colours, _LOOSE)
    colours[0] = _GRAIN_TINTS[0]
    outlines = grain_corners(snapshot["triangles"])
    polygons = [snapshot["positions"][corners] for corners in outlines]
    with rc_context(STYLE):
        figure, axes = _map_figure(polygons)
        _draw_grains(axes, polygons, colours[found.labels[_grains_of(snapshot, outlines)]])
        _draw_scale_bar(axes)
        largest = 100.0 * found.areas[0] / found.areas.sum()
        text = f"{len(found)} fragments, the largest has {largest:.0f} % of the area"
        axes.set_title(caption or text, fontsize=9.5, loc="left")
        save(figure, path)


def cell_polygons(tessellation: Any) -> list[np.ndarray]:
    """Corners (V, 2) [m] of each cell of a tessellation."""
    corners = tessellation.vertices[tessellation.cell_vertices]
    return np.split(corners, tessellation.cell_offsets[1:-1])


def mesh_triangles(meshes: Any) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (N, 2) [m] and triangles (M, 3) of all grains from the meshes of each."""
    offsets = np.repeat(meshes.node_offsets[:-1], np.diff(meshes.triangle_offsets))
    return np.asarray(meshes.nodes), np.asarray(meshes.triangles) + offsets[:, None]


def grain_corners(triangles: np.ndarray) -> list[np.ndarray]:
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


def _grains_of(snapshot: Mapping[str, np.ndarray], outlines: Sequence[np.ndarray]) -> np.ndarray:
    """Grain of each outline."""
    node_grain = np.zeros(len(snapshot["positions"]), dtype=int)
    node_grain[np.ravel(snapshot["triangles"])] = np.repeat(snapshot["triangle_grain"], 3)
    return node_grain[[corners[0] for corners in outlines]]


def crack_segments(snapshot: Mapping[str, np.ndarray]) -> dict[int, np.ndarray]:
    """Segments (K, 2, 2) [m] of the cracked points by mode; a point covers its share of area."""
    from .export import POINT_SHARES

    modes, ends = np.asarray(snapshot["crack_mode"]), np.asarray(snapshot["contact_ends"])
    bounds = np.concatenate([[0.0], np.cumsum(POINT_SHARES[modes.shape[1]])])
    start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    places = start[:, None] + bounds[None, :, None] * along[:, None]
    pieces = np.stack([places[:, :-1], places[:, 1:]], axis=2)
    return {mode: pieces[modes == mode] for mode in (TENSILE, SHEAR)}


def _draw_counts(axes: Axes, strain: np.ndarray, record: Curve) -> None:
    for mode, column in ((TENSILE, "tensile_cracks"), (SHEAR, "shear_cracks")):
        axes.plot(strain, record[column], color=COLOURS[mode], lw=1.1, label=MODE_NAMES[mode])
    axes.set_ylabel("cracked contact points [-]")
    axes.set_ylim(bottom=0.0, top=max(1.0, 1.18 * axes.get_ylim()[1]))
    axes.spines["right"].set_visible(True)


def _draw_modulus(axes: Axes, result: Result) -> None:
    rows = measures.elastic_rows(result.curve)
    if result.youngs_modulus is None or rows.stop <= rows.start:
        return
    strain = result.curve["axial_strain"]
    stress = result.curve["axial_stress"]
    middle = np.mean(strain[rows]), np.mean(stress[rows])
    top = np.nanmax(stress)
    ends = np.array([max(0.0, middle[1] - result.youngs_modulus * middle[0]), top])
    places = middle[0] + (ends - middle[1]) / result.youngs_modulus
    label = f"E = {1e-9 * result.youngs_modulus:.1f} GPa"
    axes.plot(100.0 * places, 1e-6 * ends, color="0.45", lw=1.0, ls=(0, (5, 3)), label=label)


def _draw_peak(axes: Axes, result: Result) -> None:
    if result.peak_stress is None or result.peak_strain is None:
        return
    place = 100.0 * result.peak_strain, 1e-6 * result.peak_stress
    axes.plot(*place, "o", ms=5.0, mfc="white", mec="black", mew=1.2)
    axes.annotate(f"{place[1]:.1f} MPa", place, (0, 7), textcoords="offset points", ha="center")


def _caption(result: Result) -> str:
    confined = result.confinement or 0.0
    where = f", confinement {1e-6 * confined:g} MPa" if confined else ""
    caption = f"{result.test}, {result.model} model, {result.material.get('name', '')}{where}"
    return caption if result.status == "ok" else f"{caption} ({result.status.replace('_', ' ')})"


def _map_figure(polygons: Sequence[np.ndarray]) -> tuple[Figure, Axes]:
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


def _draw_grains(
    axes: Axes, polygons: Sequence[np.ndarray], tints: Sequence[str] | None = None
) -> None:
    if tints is None:
        tints = [_GRAIN_TINTS[number * 7 % len(_GRAIN_TINTS)] for number in range(len(polygons))]
    scaled = [1e3 * np.asarray(polygon) for polygon in polygons]
    grains = PolyCollection(scaled, facecolors=tints, edgecolors=_EDGE, linewidths=0.25)
    axes.add_collection(grains)


def _draw_scale_bar(axes: Axes) -> None:
    """Draw a bar of a round length, about a quarter of the width, below the lower left corner."""
    data = axes.dataLim
    quarter = data.width / 4.0
    decade = 10.0 ** math.floor(math.log10(quarter))
    length = max(step for step in (1.0, 2.0, 5.0) if step * decade <= quarter) * decade
    gap = 0.03 * max(data.width, data.height)
    ends, place = (data.x0, data.x0 + length), data.y0 - gap
    axes.plot(ends, (place, place), color="black", lw=2.0, solid_capstyle="butt")
    axes.text(ends[1] + 0.5 * gap, place, f"{length:g} mm", va="center", ha="left")


def _unique_edges(triangles: np.ndarray) -> np.ndarray:
    edges = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2)
    return np.unique(np.sort(edges, axis=1), axis=0)


@contextlib.contextmanager
def drawing(path: Path | str, size: tuple[float, float] = (5.6, 3.9)) -> Iterator[Axes]:
    """Axes to draw in, in the style of all pictures; written to `path` afterwards.

    Args:
        path: Picture to write.
        size: Width and height [inch].
    """
    with rc_context(STYLE):
        figure = Figure(figsize=size, layout="constrained")
        yield figure.add_subplot()
        save(figure, path)


def save(figure: Figure, path: Path | str) -> None:
    """Write a picture, whole or not at all."""
    with whole_file(path) as temporary:
        figure.savefig(temporary)
