# SPDX-License-Identifier: GPL-3.0-or-later
"""Which triangles have a point in them. They may overlap, and need not be joined.

Squares of the size of a triangle name their candidates. Only squares with a triangle are kept, so
that grains that have flown off cost nothing; a triangle that is stretched over many of them is a
candidate for all points.
"""

from __future__ import annotations

import numpy as np

from ...arrays import FloatArray, IntArray

#: Distance from an edge over the height on it at which a point still lies on it: round-off [-].
_ROUND_OFF = 1e-9
#: Places beyond this are nowhere, and have no square that is a number [m].
_LARGEST = 1e100
#: Places beyond this number of squares are nowhere, those of a run that has diverged.
_FARTHEST = 2.0**30
#: Squares that a triangle may touch and be listed in each.
_MOST_SQUARES = 10_000


def triangles_at(corners: FloatArray, points: FloatArray) -> tuple[IntArray, IntArray]:
    """Pairs of a point and a triangle that has it: both of an edge's, all of a corner's.

    Args:
        corners: Places of each triangle, counter-clockwise, (M, 3, 2) [m].
        points: (n, 2) [m].

    Returns:
        Numbers of the points, rising, and of the triangles.
    """
    low, high = corners.min(axis=1), corners.max(axis=1)
    known = np.all((np.abs(low) < _LARGEST) & (np.abs(high) < _LARGEST), axis=1)
    widths = (high - low)[known]
    size = np.sqrt(np.median(np.prod(widths, axis=1))) if len(widths) else 0.0
    if not size > 0.0:
        none = np.empty(0, dtype=int)
        return none, none
    squares, owners, wide = _squares(low / size - _ROUND_OFF, high / size + _ROUND_OFF)
    order = np.argsort(squares, kind="stable")
    squares, owners = squares[order], owners[order]
    there = np.flatnonzero(np.all(np.abs(points) < _FARTHEST * size, axis=1))
    wanted = _number(np.floor(points[there] / size).astype(np.int64))
    first = np.searchsorted(squares, wanted, "left")
    count = np.searchsorted(squares, wanted, "right") - first
    point = np.concatenate([np.repeat(there, count), np.repeat(there, len(wide))])
    triangle = np.concatenate([owners[_spans(first, count)], np.tile(wide, len(there))])
    rising = np.argsort(point, kind="stable")
    point, triangle = point[rising], triangle[rising]
    inside = _contains(corners[triangle], points[point])
    return point[inside], triangle[inside]


def _squares(low: FloatArray, high: FloatArray) -> tuple[IntArray, IntArray, IntArray]:
    """Each square that a box from low to high touches, and the box; the boxes with too many."""
    known = np.all((np.abs(low) < _FARTHEST) & (np.abs(high) < _FARTHEST), axis=1)
    boxes = np.flatnonzero(known)
    start, end = (np.floor(one[boxes]).astype(np.int64) for one in (low, high))
    columns, rows = (end - start + 1).T
    wide = boxes[columns * rows > _MOST_SQUARES]
    few = columns * rows <= _MOST_SQUARES
    boxes, start, columns, rows = boxes[few], start[few], columns[few], rows[few]
    count = columns * rows
    owner = np.repeat(np.arange(len(boxes)), count)
    place = _spans(np.zeros_like(count), count)
    steps = np.column_stack([place % columns[owner], place // columns[owner]])
    return _number(start[owner] + steps), boxes[owner], wide


def _number(squares: IntArray) -> IntArray:
    """One number for each square (column, row)."""
    numbers: IntArray = (squares[:, 0] << 32) + squares[:, 1]
    return numbers


def _spans(first: IntArray, count: IntArray) -> IntArray:
    """Return the numbers first, first + 1, ... of all spans, concatenated."""
    begin = np.cumsum(count) - count
    spans: IntArray = np.arange(count.sum()) + np.repeat(first - begin, count)
    return spans


def _contains(corners: FloatArray, points: FloatArray) -> IntArray:
    """Return whether each triangle contains its point."""
    start, end = corners, np.roll(corners, -1, axis=1)
    along, arm = end - start, points[:, None] - start
    left = along[..., 0] * arm[..., 1] - along[..., 1] * arm[..., 0]  # twice an area
    whole = np.abs(left.sum(axis=1, keepdims=True))
    inside: IntArray = np.all(left >= -_ROUND_OFF * whole, axis=1)
    return inside
