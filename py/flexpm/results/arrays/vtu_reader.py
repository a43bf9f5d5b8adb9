# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of a .vtu file as flexpm writes it: base64 texts, compressed in blocks by LZ4.

The reader of VTK does not check a file: a changed file can end the process or block it. This reader
accepts only complete files, and writes nothing to standard error.
"""

from __future__ import annotations

import base64
import contextlib
from collections.abc import Iterator
from typing import Any, NamedTuple
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkIOCore import vtkLZ4DataCompressor

#: Types of numbers.
_TYPES = {"Float64": "f8", "Int32": "i4", "Int64": "i8", "UInt8": "u1"}
_ORDERS = {"LittleEndian": "<", "BigEndian": ">"}
#: Words before the sizes of the blocks: how many there are, size of each, and of the last if less.
_HEADER = 3
#: Largest ratio of a block to what LZ4 makes of it, rounded up.
_LARGEST_RATIO = 256

Array = NDArray[Any]
Arrays = dict[str, Array]


class Grid(NamedTuple):
    """Arrays of a file by name, rows of components."""

    points: Arrays
    cells: Arrays
    places: Array  #: of the points, (N, 3)
    corners: Array  #: points of all cells, one cell after the other
    ends: Array  #: number of these up to the end of each cell


@contextlib.contextmanager
def silence() -> Iterator[None]:
    """Suppress the output of VTK; the caller checks for errors."""
    before = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()
    try:
        yield
    finally:
        vtkObject.SetGlobalWarningDisplay(before)


def grid_of(content: bytes) -> Grid:
    """Arrays of a file with one piece; field data is not read.

    Raises:
        ValueError, LookupError, ElementTree.ParseError: if it is damaged, or no such file.
    """
    root = ElementTree.fromstring(content)
    piece = root.find("UnstructuredGrid/Piece")
    if piece is None or root.attrib["compressor"] != "vtkLZ4DataCompressor":
        raise ValueError("no grid of flexpm")
    order = _ORDERS[root.attrib["byte_order"]]
    words = order + {"UInt32": "u4", "UInt64": "u8"}[root.attrib["header_type"]]
    counts = {name: int(piece.attrib[f"NumberOf{name}"]) for name in ("Points", "Cells")}

    def arrays(part: str, count: int | None = None) -> Arrays:
        found = {}
        for one in piece.iterfind(f"{part}/DataArray"):
            kind = np.dtype(order + _TYPES[one.attrib["type"]])
            data = np.frombuffer(_content(one.text or "", words), kind)
            width = int(one.attrib.get("NumberOfComponents", 1))
            rows = data.reshape(-1, width) if width > 1 else data
            if count not in (None, len(rows)):
                raise ValueError(f"{one.attrib['Name']} has {len(rows)} rows")
            found[one.attrib["Name"]] = rows
        return found

    with silence():
        return Grid(
            arrays("PointData", counts["Points"]),
            arrays("CellData", counts["Cells"]),
            arrays("Points", counts["Points"])["Points"],
            arrays("Cells")["connectivity"],
            arrays("Cells")["offsets"],
        )


def _content(text: str, words: str) -> bytearray:
    """Bytes of an array, decompressed block by block."""
    text = text.strip()
    blocks, size, last = _header(text, words, _HEADER)
    if blocks > len(text):
        raise ValueError("no header")
    lengths = _header(text, words, _HEADER + blocks)[_HEADER:]
    packed = base64.b64decode(text[_characters(words, _HEADER + blocks) :], validate=True)
    found, begin = bytearray(), 0
    for number, length in enumerate(lengths):
        block, begin = packed[begin : begin + length], begin + length
        whole = last if last and number == blocks - 1 else size
        if whole > _LARGEST_RATIO * length or len(block) != length:
            raise ValueError("no block")
        room = bytearray(whole)
        if vtkLZ4DataCompressor().Uncompress(block, length, room, len(room)) != len(room):
            raise ValueError("a damaged block")
        found += room
    if begin != len(packed):
        raise ValueError("more than the blocks")
    return found


def _header(text: str, words: str, count: int) -> list[int]:
    """Words at the beginning of a text, of a type of numpy."""
    part = base64.b64decode(text[: _characters(words, count)], validate=True)
    found: list[int] = np.frombuffer(part[: count * np.dtype(words).itemsize], words).tolist()
    if len(found) != count:
        raise ValueError("no header")
    return found


def _characters(words: str, count: int) -> int:
    """Characters of base64 that hold so many words."""
    return 4 * -(-count * np.dtype(words).itemsize // 3)
