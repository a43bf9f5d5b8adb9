# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids of .vtu files, written array by array: memory holds one array at a time."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

from ...files import write_parts
from .vtu_arrays import content_of, describe

#: Indent of a line within a piece, beyond that of field data.
_DEEPER = b"  "


class GridInTurn(NamedTuple):
    """A grid; an array is made when its turn has come."""

    counts: tuple[int, int]  #: points and cells
    points: Iterable[vtkDataArray]  #: arrays over points
    cells: Iterable[vtkDataArray]  #: arrays over cells
    places: Iterable[vtkDataArray]  #: `Points`
    corners: Iterable[vtkDataArray]  #: `connectivity`, `offsets` and `types`


def write_in_turn(path: Path | str, grid: GridInTurn, about: Mapping[str, object]) -> None:
    """Write the file that VTK writes of a grid, byte by byte, whole or not at all.

    VTK makes the text of each array as field data of an empty grid.

    Args:
        path: Name of the file, ending in .vtu.
        grid: Its arrays.
        about: Field data by name.
    """
    write_parts(path, _parts(grid, about))


def _parts(grid: GridInTurn, about: Mapping[str, object]) -> Iterator[bytes | memoryview]:
    empty = vtkUnstructuredGrid()
    for name, value in about.items():
        describe(empty.GetFieldData(), name, value)
    frame = content_of(empty)
    yield frame[: frame.index(b"    <Piece")]
    points, cells = grid.counts
    yield f'    <Piece NumberOfPoints="{points}" NumberOfCells="{cells}">\n'.encode()
    parts = (b"PointData", b"CellData", b"Points", b"Cells")
    for part, arrays in zip(parts, grid[1:], strict=True):
        yield b"      <%b>\n" % part
        for array in arrays:
            yield from _array(array)
        yield b"      </%b>\n" % part
    yield frame[frame.index(b"    </Piece>") :]


def _array(array: vtkDataArray) -> Iterator[bytes | memoryview]:
    holder = vtkUnstructuredGrid()
    holder.GetFieldData().AddArray(array)
    content = content_of(holder)
    begin = content.index(b"      <DataArray")
    values = content.index(b"\n", begin) + 1
    after = content.index(b"\n", values) + 1  # all values are one line
    yield _DEEPER + re.sub(rb' NumberOfTuples="\d+"', b"", content[begin:values]) + _DEEPER
    yield memoryview(content)[values:after]
    rest = content[after : content.index(b"    </FieldData>", after)]
    yield b"".join(_DEEPER + line for line in rest.splitlines(keepends=True))
