# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of grains, which may consist of several cells, and of the source image. SI units."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import BoolArray, FloatArray, IntArray
from ...files import Table
from .regions import connected

if TYPE_CHECKING:  # an image is read before YADE is there
    from ..._flexpm import Tessellation


def of_grains(
    cells: Tessellation, grains: IntArray, minerals: IntArray | None, names: Sequence[str]
) -> Table:
    """Return sizes, shapes and neighbours of grains, and boundary lengths by pair of minerals.

    Args:
        cells: The cells.
        grains: Grain of each cell.
        minerals: Index of each cell's mineral; None: a single mineral.
        names: Names of the minerals.

    Returns:
        Quantiles of equal-area diameters and lengths [m], aspect ratios [-] and shares [-].
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


def of_image(
    image: IntArray, holes: BoolArray, kinds: Mapping[int, int | None] | None, sides: FloatArray
) -> Table:
    """Return the figures of the regions of an image, before regions are merged or smoothed.

    A staircase is longer than the line that it follows, by a factor 4 / pi in the mean over all
    directions. Boundary lengths are divided by this factor.

    Args:
        image: Label of each pixel.
        holes: Whether a pixel belongs to no grain.
        kinds: Index of each label's mineral; None: a single mineral.
        sides: Width and height of a pixel [m].

    Returns:
        As `of_grains`; a mineral has its index as key, a pair of minerals both indices.
    """
    regions = np.where(holes, -1, connected(np.where(holes, image.min() - 1, image)))
    kept, first, whole = np.unique(regions, return_index=True, return_inverse=True)
    rock = kept >= 0
    number = (np.cumsum(rock) - 1)[whole].reshape(image.shape)
    number[holes] = -1
    count = int(rock.sum())
    if not count:
        return {}
    y, x = (np.nonzero(~holes)[axis] * sides[1 - axis] for axis in (0, 1))
    of = number[~holes]
    pixels = np.bincount(of)
    means = [np.bincount(of, one) / pixels for one in (x, y)]
    off = [one - mean[of] for one, mean in zip((x, y), means, strict=True)]
    moments = np.empty((count, 2, 2))
    for a, b in ((0, 0), (0, 1), (1, 0), (1, 1)):
        own = sides[a] ** 2 / 12.0 if a == b else 0.0
        moments[:, a, b] = np.bincount(of, off[a] * off[b]) / pixels + own
    pairs, lengths = _sides(number, sides)
    met = np.unique(pairs, axis=0)
    found: Table = {
        "grains": count,
        "equal_area_diameter": _spread(np.sqrt(4.0 / math.pi * pixels * sides[0] * sides[1])),
        "aspect_ratio": _spread(_axes(moments)),
        "neighbours": float(2.0 * len(met) / count),
        "boundary_length": float(0.25 * math.pi * lengths.sum()),
    }
    if kinds is not None:
        minerals = np.array([kinds[label] for label in image.ravel()[first[rock]].tolist()])
        share = np.bincount(minerals.astype(int), pixels) / pixels.sum()
        found["area_share"] = dict(enumerate(share.tolist()))
        two = np.sort(minerals.astype(int)[pairs], axis=1)
        by_pair = np.unique(two, axis=0, return_inverse=True)
        sums = 0.25 * math.pi * np.bincount(by_pair[1].ravel(), lengths)
        keys = map(tuple, by_pair[0].tolist())
        found["boundary_length_by_pair"] = dict(zip(keys, sums.tolist(), strict=True))
    return found


def _sides(number: IntArray, sides: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return the two regions at each pixel side between regions, and its length [m]."""
    found, lengths = [], []
    for one, other, length in (
        (number[:, :-1], number[:, 1:], sides[1]),
        (number[:-1], number[1:], sides[0]),
    ):
        met = (one != other) & (one >= 0) & (other >= 0)
        found.append(np.sort(np.stack((one[met], other[met]), axis=1), axis=1))
        lengths.append(np.full(len(found[-1]), length))
    return np.concatenate(found), np.concatenate(lengths)


def named(found: Table, names: Sequence[str]) -> Table:
    """Return the figures of an image with the names of minerals instead of their indices."""
    if "area_share" not in found:
        return found
    if not names:
        minerals = ("area_share", "boundary_length_by_pair")
        return {key: one for key, one in found.items() if key not in minerals}
    share, by_pair = found["area_share"], found["boundary_length_by_pair"]
    return found | {
        "area_share": {names[index]: one for index, one in share.items()},
        "boundary_length_by_pair": {
            "/".join(sorted((names[a], names[b]))): one for (a, b), one in by_pair.items()
        },
    }


def _spread(values: FloatArray) -> dict[str, float]:
    return {
        "mean": float(values.mean()),
        "smallest": float(values.min()),
        "median": float(np.median(values)),
        "largest": float(values.max()),
    }


def _aspects(cells: Tessellation, grains: IntArray, count: int) -> FloatArray:
    """Return each grain's axis ratio [-]: ellipse with the second moments of its area."""
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
    return _axes(moments / area[:, None, None] - centre[:, :, None] * centre[:, None, :])


def _axes(moments: FloatArray) -> FloatArray:
    """Return the axis ratios of ellipses with central second moments, (n, 2, 2) [-]."""
    low, high = np.linalg.eigvalsh(moments).T
    ratios: FloatArray = np.sqrt(high / np.maximum(low, 1e-12 * high))
    return ratios
