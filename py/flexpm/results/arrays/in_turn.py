# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids of .vtu files, written array by array: memory holds one array at a time."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import BinaryIO, NamedTuple

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

from ...files import whole_file
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
    empty = vtkUnstructuredGrid()
    for name, value in about.items():
        describe(empty.GetFieldData(), name, value)
    frame = content_of(empty)
    piece = frame.index(b"    <Piece")
    points, cells = grid.counts
    parts = zip((b"PointData", b"CellData", b"Points", b"Cells"), grid[1:], strict=True)
    with whole_file(path) as temporary, temporary.open("wb") as file:
        file.write(frame[:piece])
        file.write(f'    <Piece NumberOfPoints="{points}" NumberOfCells="{cells}">\n'.encode())
        for name, arrays in parts:
            file.write(b"      <%b>\n" % name)
            for array in arrays:
                _write_array(file, array)
            file.write(b"      </%b>\n" % name)
        file.write(frame[frame.index(b"    </Piece>") :])


def _write_array(file: BinaryIO, array: vtkDataArray) -> None:
    holder = vtkUnstructuredGrid()
    holder.GetFieldData().AddArray(array)
    content = content_of(holder)
    begin = content.index(b"      <DataArray")
    values = content.index(b"\n", begin) + 1
    after = content.index(b"\n", values) + 1  # all values are one line
    file.write(_DEEPER + re.sub(rb' NumberOfTuples="\d+"', b"", content[begin:values]) + _DEEPER)
    file.write(memoryview(content)[values:after])
    rest = content[after : content.index(b"    </FieldData>", after)]
    file.write(b"".join(_DEEPER + line for line in rest.splitlines(keepends=True)))
