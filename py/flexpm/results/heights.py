# SPDX-License-Identifier: GPL-3.0-or-later
"""The column z of tables of places, which only solids have: behind x and y."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

#: Name of the column, and the one that it follows.
_NAME, _BEFORE = "z", "y"


def with_heights(
    names: Sequence[str], rows: Iterable[Sequence[object]], heights: Sequence[float | None]
) -> tuple[tuple[str, ...], list[tuple[object, ...]]]:
    """Put heights [m] into a table that has any."""
    if not heights or heights[0] is None:
        return tuple(names), [tuple(row) for row in rows]
    at = list(names).index(_BEFORE) + 1
    return (*names[:at], _NAME, *names[at:]), [
        (*row[:at], height, *row[at:]) for row, height in zip(rows, heights, strict=True)
    ]


def without_heights(
    names: Sequence[str], rows: Sequence[Sequence[str]]
) -> tuple[Sequence[str], Sequence[Sequence[str]], list[float | None]]:
    """Split the heights [m] from a table; None for rows without a height.

    Raises:
        ValueError: if a height is not a number, or a row has another number of columns.
    """
    if _NAME not in names:
        return names, rows, [None] * len(rows)
    at = list(names).index(_NAME)
    if any(len(row) != len(names) for row in rows):
        raise ValueError("rows of different lengths")
    heights: list[float | None] = [float(row[at]) for row in rows]
    kept = [[*row[:at], *row[at + 1 :]] for row in rows]
    return [*names[:at], *names[at + 1 :]], kept, heights
