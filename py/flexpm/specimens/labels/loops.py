# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of an image of regions: loops around them, and cuts of regions that enclose others.

A line follows the edges of pixels from vertex to vertex, with the region at its left. Vertices are
numbered row by row; row 0 is the lowest row. Where a region touches itself at a corner, its line
bends to the right: pixels of the region that touch at this corner stay connected, and the pixels
that they separate stay separated.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import BoolArray, IntArray
from .regions import HOLE, Cuts, Regions, connected

#: Steps of the four directions: east, north, west, south.
_STEPS = ((1, 0), (0, 1), (-1, 0), (0, -1))
#: Edges of pixels around the smallest piece that is cut for its shape.
_LEAST_LOOP = 16


@dataclass(frozen=True)
class Corners:
    """Regions of the four pixels at each vertex."""

    right_up: IntArray
    left_up: IntArray
    left_down: IntArray
    right_down: IntArray

    @classmethod
    def of(cls, image: IntArray) -> Corners:
        """Return the corners of an image; outside of the image there are holes."""
        padded = np.pad(image, 1, constant_values=HOLE)
        return cls(padded[1:, 1:], padded[1:, :-1], padded[:-1, :-1], padded[:-1, 1:])

    def sides(self) -> tuple[list[IntArray], list[IntArray]]:
        """Return the regions left and right of each vertex's outgoing edge in each direction."""
        around = [self.right_up, self.left_up, self.left_down, self.right_down]
        return around, [around[-1], *around[:-1]]

    def degree(self) -> IntArray:
        """Return the number of lines that meet at each vertex."""
        left, right = self.sides()
        met: IntArray = sum(
            ((one != other).astype(np.int8) for one, other in zip(left, right, strict=True)),
            start=np.zeros(left[0].shape, dtype=np.int8),
        )
        return met


def loops_of(image: IntArray) -> list[tuple[int, IntArray]]:
    """Return region and vertices of each loop, by region; outer loops are counter-clockwise."""
    left, right = (np.stack(side).reshape(4, -1) for side in Corners.of(image).sides())
    width = image.shape[1] + 1
    direction, start = np.nonzero((left != right) & (left >= 0))
    steps = np.array([x + width * y for x, y in _STEPS])
    region, end = left[direction, start], start + steps[direction]
    turn = np.where(
        right[direction, end] == region, -1, np.where(left[direction, end] == region, 0, 1)
    )
    number = left.shape[1]
    following = np.searchsorted(
        direction * number + start, (direction + turn) % 4 * number + end
    ).tolist()
    starts, regions = start.tolist(), region.tolist()
    seen, loops = bytearray(len(starts)), []
    for first in np.argsort(region, kind="stable").tolist():
        if seen[first]:
            continue
        loop, edge = [], first
        while not seen[edge]:
            seen[edge] = 1
            loop.append(starts[edge])
            edge = following[edge]
        loops.append((regions[first], np.array(loop)))
    return loops


def divided(found: Regions, least_fill: float) -> tuple[IntArray, IntArray]:
    """Cut regions that enclose others, or are far from convex, into pieces.

    A horizontal cut goes left from the leftmost point of the enclosed region, and another cut right
    from its rightmost point, both to the end of the enclosing region. A piece that is far from
    convex is cut across the middle of its longer side, along x or y; its parts are cut in the same
    way.

    Args:
        found: The regions.
        least_fill: Smallest ratio of a piece's area to the area of its convex hull [-]; half a ring
            has about 0.6.

    Returns:
        Piece index of each pixel, the first piece of each grain first, and the grain of each piece.
    """
    image = found.image
    cuts = Cuts.none(image)
    for region, loop in loops_of(image):
        x, y = _places(loop, image)
        if np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) < 0:  # around what is inside
            _cut(cuts.above, image, region, np.stack((x, y)))
    parts = connected(image, cuts)
    while _halve(cuts, parts, image, least_fill):
        parts = connected(image, cuts)
    rock = image >= 0
    kept, first = np.unique(parts[rock], return_index=True)
    grains = image[rock][first]
    order = np.lexsort((kept, grains, _repeats(grains)))
    number = np.full(parts.max() + 1, HOLE)
    number[kept[order]] = np.arange(len(kept))
    return np.where(rock, number[parts], HOLE), grains[order]


def _places(loop: IntArray, image: IntArray) -> IntArray:
    """Return the columns and rows of vertices."""
    y, x = np.divmod(loop, image.shape[1] + 1)
    return np.stack((x, y))


def _halve(cuts: Cuts, parts: IntArray, image: IntArray, least_fill: float) -> bool:
    """Cut all parts that are far from convex; return whether any part was cut."""
    found = False
    for part, loop in loops_of(np.where(image >= 0, parts, HOLE)):
        places = _places(loop, image)
        if len(loop) < _LEAST_LOOP or _fill(places) >= least_fill:
            continue
        found = True
        (left, low), (right, top) = places.min(axis=1), places.max(axis=1)
        if right - left > top - low:
            middle = (left + right) // 2
            cuts.beside[low:top, middle - 1] |= parts[low:top, middle - 1] == part
        else:
            middle = (low + top) // 2
            cuts.above[middle - 1, left:right] |= parts[middle - 1, left:right] == part
    return found


def _fill(places: IntArray) -> float:
    """Return the ratio of the area within a loop to the area of its convex hull [-]."""
    from scipy.spatial import ConvexHull

    x, y = places
    area = 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
    return area / float(ConvexHull(places.T).volume)


def _repeats(grains: IntArray) -> BoolArray:
    """Return for each grain index whether it has occurred before."""
    again = np.ones(len(grains), dtype=bool)
    again[np.unique(grains, return_index=True)[1]] = False
    return again


def _cut(cuts: BoolArray, image: IntArray, region: int, loop: IntArray) -> None:
    """Cut a region left and right of an inner loop."""
    x, y = loop
    for side, to_left in ((int(x.min()), True), (int(x.max()), False)):
        beside = side - 1 if to_left else side
        rows = np.unique(y[x == side])
        free = rows[(image[rows - 1, beside] == region) & (image[rows, beside] == region)]
        if not len(free):
            continue  # both ends touch another loop
        row = int(free[len(free) // 2])
        whole = (image[row - 1] == region) & (image[row] == region)
        if to_left:
            stop = np.flatnonzero(~whole[:side])
            cuts[row - 1, int(stop[-1]) + 1 if len(stop) else 0 : side] = True
        else:
            stop = np.flatnonzero(~whole[side:])
            cuts[row - 1, side : side + int(stop[0]) if len(stop) else None] = True
