# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the grains of an image, whose cells may be pieces of them. SI units."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..._flexpm import Tessellation
from ...arrays import FloatArray, IntArray
from ...files import Table


def of_grains(
    cells: Tessellation, grains: IntArray, minerals: IntArray | None, names: Sequence[str]
) -> Table:
    """Sizes, shapes and neighbours of grains, and lengths of boundary by pair of minerals.

    Args:
        cells: The cells.
        grains: Grain of each cell.
        minerals: Index of each cell's mineral; None: all alike.
        names: Names of the minerals.

    Returns:
        Quantiles of equal-area diameters and lengths [m], aspect ratios, shares [-].
    """
    areas = np.bincount(grains, cells.cell_areas)
    pairs = cells.shared_edges[:, :2]
    real = grains[pairs[:, 0]] != grains[pairs[:, 1]]
    ends = cells.vertices[cells.shared_edges[:, 2:]]
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    met = np.unique(np.sort(grains[pairs[real]], axis=1), axis=0)
    found: Table = {
        "grains": len(areas),
        "equal_area_diameter": _spread(np.sqrt(4.0 / math.pi * areas)),
        "aspect_ratio": _spread(_aspects(cells, grains, len(areas))),
        "neighbours": float(2.0 * len(met) / len(areas)),
        "boundary_length": float(lengths[real].sum()),
        "added_boundary_length": float(lengths[~real].sum()),
        "shortest_edge": float(lengths.min()),
    }
    if minerals is not None:
        shares = np.bincount(minerals, cells.cell_areas, minlength=len(names)) / areas.sum()
        found["area_share"] = dict(zip(names, shares.tolist(), strict=True))
        by_pair: dict[str, float] = {}
        kinds = minerals[pairs[real]].tolist()
        for (one, other), length in zip(kinds, lengths[real].tolist(), strict=True):
            name = "/".join(sorted((names[one], names[other])))
            by_pair[name] = by_pair.get(name, 0.0) + length
        found["boundary_length_by_pair"] = dict(sorted(by_pair.items()))
    return found


def _spread(values: FloatArray) -> dict[str, float]:
    return {
        "mean": float(values.mean()),
        "smallest": float(values.min()),
        "median": float(np.median(values)),
        "largest": float(values.max()),
    }


def _aspects(cells: Tessellation, grains: IntArray, count: int) -> FloatArray:
    """Ratio of the axes of the ellipse with the second moments of each grain's area."""
    moments, area, first = np.zeros((count, 2, 2)), np.zeros(count), np.zeros((count, 2))
    for cell, grain in enumerate(grains.tolist()):
        start, end = cells.cell_offsets[cell : cell + 2]
        corners = cells.vertices[cells.cell_vertices[start:end]]
        after = np.roll(corners, -1, axis=0)
        cross = corners[:, 0] * after[:, 1] - after[:, 0] * corners[:, 1]
        area[grain] += 0.5 * cross.sum()
        first[grain] += (cross[:, None] * (corners + after)).sum(axis=0) / 6.0
        for one, other in ((corners, corners), (after, after), (corners, after), (after, corners)):
            weight = 2.0 if one is other else 1.0
            moments[grain] += weight * np.einsum("i,ij,ik->jk", cross, one, other) / 24.0
    centre = first / area[:, None]
    central = moments / area[:, None, None] - centre[:, :, None] * centre[:, None, :]
    low, high = np.linalg.eigvalsh(central).T
    ratios: FloatArray = np.sqrt(high / np.maximum(low, 1e-12 * high))
    return ratios
