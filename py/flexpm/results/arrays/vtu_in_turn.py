# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids of .vtu files, written array by array: memory holds one array at a time."""

from __future__ import annotations

import errno
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

from ...files import lines_of, require_room, scratch_beside, write_parts
from .vtu_arrays import content_of, describe, writer_of
from .vtu_reader import silence

#: Indent of a line within a piece, beyond that of field data.
_DEEPER = b"  "
#: Bytes of a text that are copied at a time.
_PIECE = 2**20
#: Largest size of what is around a text [byte], and of a text of base64 over its numbers [-].
_FRAME, _TEXT = 2**14, 1.4
#: Last line of each file.
_END = b"</VTKFile>\n"


class GridInTurn(NamedTuple):
    """A grid; an array is made when its turn has come."""

    counts: tuple[int, int]  #: points and cells
    points: Iterable[vtkDataArray]  #: arrays over points
    cells: Iterable[vtkDataArray]  #: arrays over cells
    places: Iterable[vtkDataArray]  #: `Points`
    corners: Iterable[vtkDataArray]  #: `connectivity`, `offsets` and `types`


def write_in_turn(path: Path | str, grid: GridInTurn, about: Mapping[str, object]) -> None:
    """Write the file that VTK writes of a grid, byte by byte, whole or not at all.

    VTK writes each array as field data of an empty grid into a file of its own beside the other,
    from which its text is copied piece by piece.

    Args:
        path: Name of the file, ending in .vtu.
        grid: Its arrays.
        about: Field data by name.

    Raises:
        OSError: if the disk does not take it.
    """
    with scratch_beside(path) as scratch:
        write_parts(path, _parts(grid, about, scratch))


def _parts(grid: GridInTurn, about: Mapping[str, object], scratch: Path) -> Iterator[bytes]:
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
            _write_alone(array, scratch)
            del array  # the next one is made in its place
            yield from _text_in(scratch)
        yield b"      </%b>\n" % part
    yield frame[frame.index(b"    </Piece>") :]


def _write_alone(array: vtkDataArray, scratch: Path) -> None:
    """Write a file of an empty grid whose field data are an array.

    VTK ends the process where the disk refuses a part: there is room, or it is not asked.
    """
    size = array.GetNumberOfValues() * array.GetDataTypeSize()
    require_room(scratch, _FRAME + math.ceil(_TEXT * size))
    holder = vtkUnstructuredGrid()
    holder.GetFieldData().AddArray(array)
    writer = writer_of(holder)
    writer.SetFileName(str(scratch))
    with silence():
        done = writer.Write()
    if done != 1 or writer.GetErrorCode():
        raise _full()


def _text_in(scratch: Path) -> Iterator[bytes]:
    """Text of the array in such a file, indented as within a piece."""
    lines = lines_of(scratch, _PIECE)
    begin = next((line for line in lines if line.startswith(b"      <DataArray")), b"")
    yield _DEEPER + re.sub(rb' NumberOfTuples="\d+"', b"", begin) + _DEEPER
    for values in lines:  # all values are one line
        yield values
        if values.endswith(b"\n"):
            break
    for line in lines:
        if line.startswith(b"    </FieldData>"):
            break
        yield _DEEPER + line
    if not [*lines][-1:] == [_END]:  # VTK does not tell that a part was refused
        raise _full()


def _full() -> OSError:
    """Error of a file that is not whole, whose name the writer of the other file adds."""
    return OSError(errno.ENOSPC, "VTK could not write all of an array: no space left")
