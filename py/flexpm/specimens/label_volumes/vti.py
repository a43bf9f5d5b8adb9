# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from images of VTK in XML, ``.vti``.

Arrays are text, base64 or bytes, as they are or in blocks compressed by zlib, LZMA or LZ4. Format:
"VTK XML Formats" in VTK's documentation.
"""

from __future__ import annotations

import base64
import binascii
import html
import lzma
import math
import re
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import AnyArray, NumberType
from ...errors import InputError
from ...require import quoted
from ..files.number_text import Bytes, WrongTextError, line_at, numbers_of
from .label_volume import Counts
from .volume_file import VolumeFile, refused, triple_of
from .vtk_arrays import MOST_ALONG, Array, Grid, content_of, volume_of

_TYPES = {
    **{f"Int{8 * size}": f"i{size}" for size in (1, 2, 4, 8)},
    **{f"UInt{8 * size}": f"u{size}" for size in (1, 2, 4, 8)},
    **{f"Float{8 * size}": f"f{size}" for size in (4, 8)},
}
_ORDERS = {"LittleEndian": "<", "BigEndian": ">"}
_WORDS = {"UInt32": "u4", "UInt64": "u8"}
_TAG = re.compile(rb"<!--.*?-->|<\?.*?\?>|<(/?)([A-Za-z_][\w.:-]*)([^<>]*?)(/?)>", re.S)
_ATTRIBUTE = re.compile(rb"([\w.:-]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")
_APPENDED = re.compile(rb"<AppendedData([^<>]*)>\s*_")
#: Words before the sizes of the blocks: how many there are, size of each, size of the last one.
_HEADER = 3
#: Most tags before the data.
_MOST_TAGS = 10_000
_AXES = b"1 0 0 0 1 0 0 0 1".split()

Attributes = dict[str, str]


def read(path: Path, array: str | None = None) -> VolumeFile:
    """Return the head of an image.

    Args:
        path: The file.
        array: Name of the labels; None: the only array of whole numbers.

    Raises:
        InputError: for a file that cannot be read, has several pieces, or no such array.
    """
    return volume_of(path, _Image(path, content_of(path)).grid(), array)


@dataclass(frozen=True)
class _Tag:
    name: str
    attributes: Attributes
    is_end: bool
    start: int  #: position of the tag
    end: int  #: position behind it


class _Image:
    """Tags of a file, and where its arrays are."""

    def __init__(self, path: Path, content: Bytes) -> None:
        self._path, self._content = path, content
        self._appended = _APPENDED.search(content.data)
        end = self._appended.start() if self._appended else len(content)
        self._tags = self._found(end)
        self._file = self._only("VTKFile")
        order = _ORDERS.get(self._file.attributes.get("byte_order", ""), "<")
        self._order = order
        word = self._file.attributes.get("header_type", "UInt32")
        if word not in _WORDS:
            raise self._wrong(f"header_type = {quoted(word)}, must be UInt32 or UInt64", "save it")
        self._word = np.dtype(order + _WORDS[word])

    def grid(self) -> Grid:
        """Return the grid and its arrays."""
        kind = self._file.attributes.get("type", "ImageData")
        if kind != "ImageData":
            raise self._wrong(f"type = {quoted(kind)}, must be ImageData", "save it as an image")
        image, piece = self._only("ImageData"), self._only("Piece")
        whole = image.attributes.get("WholeExtent", "").split()
        if piece.attributes.get("Extent", "").split() != whole:
            raise self._wrong(
                "extent of the piece, must be the whole extent", "save the image in one piece"
            )
        ends = [int(word) if re.fullmatch(r"-?[0-9]{1,10}", word) else None for word in whole]
        if len(ends) != 6 or None in ends:
            raise self._wrong(
                f"WholeExtent = {quoted(' '.join(whole))}, must be 6 whole numbers", "correct it"
            )
        first, last = [e or 0 for e in ends[0::2]], [e or 0 for e in ends[1::2]]
        sizes = [b - a + 1 for a, b in zip(first, last, strict=True)]
        if min(sizes) < 1 or max(sizes) > MOST_ALONG:
            raise self._wrong(
                f"WholeExtent = {quoted(' '.join(whole))}, must be ascending along x, y and z",
                "correct it",
            )
        axes = image.attributes.get("Direction", "1 0 0 0 1 0 0 0 1").split()
        if not _are_axes(axes):
            raise self._wrong(
                f"Direction = {quoted(' '.join(axes))}, must be 1 0 0 0 1 0 0 0 1",
                "resample the image along x, y and z",
            )
        spacing = triple_of(
            self._path, "Spacing", image.attributes.get("Spacing", "1 1 1").split(), 0.0
        )
        given = image.attributes.get("Origin", "0 0 0").split()
        origin = triple_of(self._path, "Origin", given, -math.inf)
        corner = [o + n * d for o, n, d in zip(origin, first, spacing, strict=True)]
        points: Counts = (sizes[0], sizes[1], sizes[2])
        return Grid(points, spacing, (corner[0], corner[1], corner[2]), self._arrays())

    def _found(self, end: int) -> list[_Tag]:
        """Return the tags up to a position."""
        tags: list[_Tag] = []
        for match in _TAG.finditer(self._content.data[:end]):
            if match[2] is None:
                continue
            if len(tags) >= _MOST_TAGS:
                raise self._wrong(f"tags = more than {_MOST_TAGS}", "save the labels alone")
            attributes = {
                bytes(one[1]).decode(errors="replace"): html.unescape(
                    bytes(one[2] if one[2] is not None else one[3]).decode(errors="replace")
                )
                for one in _ATTRIBUTE.finditer(bytes(match[3]))
            }
            name = bytes(match[2]).decode(errors="replace")
            tags.append(_Tag(name, attributes, bool(match[1]), match.start(), match.end()))
        return tags

    def _only(self, name: str) -> _Tag:
        found = [tag for tag in self._tags if tag.name == name and not tag.is_end]
        if len(found) != 1:
            raise self._wrong(f"tags {name} = {len(found)}, must be one", "give an image of VTK")
        return found[0]

    def _arrays(self) -> list[Array]:
        """Return the arrays of cells and points whose numbers can be labels."""
        found, section = [], ""
        for tag, after in zip(self._tags, [*self._tags[1:], None], strict=True):
            if tag.name in ("CellData", "PointData"):
                section = "" if tag.is_end else tag.name
            if tag.name != "DataArray" or tag.is_end or not section:
                continue
            kind = tag.attributes.get("type", "")
            width = tag.attributes.get("NumberOfComponents", "1")
            if kind not in _TYPES or not re.fullmatch(r"[0-9]{1,3}", width):
                continue  # texts and bits
            end = after.start if after else len(self._content)
            found.append(self._array(tag, section == "CellData", int(width), end))
        return found

    def _array(self, tag: _Tag, of_cells: bool, components: int, end: int) -> Array:
        form = np.dtype(self._order + _TYPES[tag.attributes["type"]])
        how = tag.attributes.get("format", "ascii")
        name = tag.attributes.get("Name", "")

        def values(number: int) -> AnyArray:
            try:
                if how == "ascii":
                    return numbers_of(self._content, tag.end, end, number, form.newbyteorder("="))
                data = self._data(tag, how, end, number * form.itemsize)
            except WrongTextError as error:
                raise self._wrong(
                    f"array {quoted(name)}: number = {quoted(error.word)}, must be one of "
                    f"{number} of type {tag.attributes['type']}",
                    "correct it",
                    error.position,
                ) from None
            except (ValueError, LookupError, zlib.error, lzma.LZMAError, RuntimeError) as error:
                if isinstance(error, InputError):
                    raise
                raise self._wrong(
                    f"array {quoted(name)}: data are broken: {str(error).splitlines()[0]}",
                    "give a whole file",
                    tag.start,
                ) from None
            return np.frombuffer(data, dtype=form)

        memory = form.itemsize * (2.5 if how != "ascii" else 1.0)
        return Array(name, of_cells, form, components, values, memory)

    def _data(self, tag: _Tag, how: str, end: int, size: int) -> Any:
        """Return the bytes of an array that is not text."""
        compressor = self._file.attributes.get("compressor", "")
        start, is_raw = tag.end, False
        if how == "appended":
            if self._appended is None:
                raise ValueError("the appended data are missing")
            offset = tag.attributes.get("offset", "")
            if not re.fullmatch(r"[0-9]{1,18}", offset):
                raise ValueError(f"offset = {offset!r} is not a number")
            given = _ATTRIBUTE.findall(bytes(self._appended[1]))
            encoding = {one[0]: one[1] or one[2] for one in given}.get(b"encoding", b"base64")
            is_raw = encoding == b"raw"
            start, end = self._appended.end() + int(offset), len(self._content)
        elif how != "binary":
            raise ValueError(f"format = {how!r} is not ascii, binary or appended")
        stream = _Stream(self._content[start:end], is_raw, self._word)
        return stream.compressed(size, compressor) if compressor else stream.plain(size)

    def _wrong(self, reason: str, remedy: str, position: int = 0) -> InputError:
        line = line_at(self._content, position)
        return refused(self._path, f"line {line}: {reason}" if position else reason, remedy)


class _Stream:
    """Bytes of an array and the words before them."""

    def __init__(self, content: Bytes, is_raw: bool, word: NumberType) -> None:
        if not is_raw:
            blank = np.flatnonzero(content[:1000] > ord(" "))
            content = content[int(blank[0]) :] if len(blank) else content[:0]
        self._content, self._is_raw, self._word = content, is_raw, word

    def plain(self, size: int) -> Any:
        """Return data that are not compressed."""
        words, start, is_apart = self._words(1)
        if words[0] != size:
            raise ValueError(f"they have {words[0]} bytes, must have {size}")
        if self._is_raw:
            return self._part(start, size)
        if is_apart:
            return self._part(start, size)
        lead = self._word.itemsize
        return self._part(0, lead + size)[lead:]

    def compressed(self, size: int, compressor: str) -> bytearray:
        """Return data that are compressed in blocks."""
        blocks, whole, last = self._words(_HEADER)[0]
        total = (blocks - 1) * whole + (last or whole) if blocks else 0
        if total != size or blocks > len(self._content):
            raise ValueError(f"their blocks have {total} bytes, must have {size}")
        words, start, _ = self._words(_HEADER + blocks)
        lengths = words[_HEADER:]
        packed = memoryview(self._part(start, sum(lengths)))
        found, begin = bytearray(size), 0
        for number, length in enumerate(lengths):
            room = last if last and number == blocks - 1 else whole
            block, begin = packed[begin : begin + length], begin + length
            part = _unpacked(block, room, compressor)
            if len(part) != room:
                raise ValueError(f"block {number + 1} has {len(part)} bytes, must have {room}")
            found[number * whole : number * whole + room] = part
        return found

    def _words(self, count: int) -> tuple[list[int], int, bool]:
        """Return words, the position behind them, and whether they are encoded apart."""
        size = count * self._word.itemsize
        if self._is_raw:
            return self._numbers(self._content[:size].tobytes(), count), size, True
        characters = 4 * -(-size // 3)
        text = self._content[:characters].tobytes()
        is_apart = text.endswith(b"=") or size % 3 == 0
        return self._numbers(_decoded(text)[:size], count), characters, is_apart

    def _numbers(self, data: bytes, count: int) -> list[int]:
        found: list[int] = np.frombuffer(data, self._word).tolist() if data else []
        if len(found) != count:
            raise ValueError("their head is not complete")
        return found

    def _part(self, start: int, size: int) -> bytes:
        """Return a number of bytes from a position on."""
        length = size if self._is_raw else 4 * -(-size // 3)
        part = self._content[start : start + length].tobytes()
        data = part if self._is_raw else _decoded(part)
        if len(data) < size:
            raise ValueError(f"they have {len(data)} bytes, must have {size}")
        return data[:size] if len(data) > size else data


def _decoded(text: bytes) -> bytes:
    try:
        return base64.b64decode(text.rstrip(), validate=True)
    except binascii.Error as error:
        raise ValueError(f"they are not base64 ({error})") from None


def _unpacked(block: memoryview, size: int, compressor: str) -> bytes | bytearray:
    """Return the content of a block, which must have no more than its size."""
    if compressor == "vtkZLibDataCompressor":
        return zlib.decompressobj().decompress(block, size)
    if compressor == "vtkLZMADataCompressor":
        return lzma.LZMADecompressor().decompress(block, size)
    if compressor == "vtkLZ4DataCompressor":
        from vtkmodules.vtkIOCore import vtkLZ4DataCompressor

        room = bytearray(size)
        got = vtkLZ4DataCompressor().Uncompress(bytes(block), len(block), room, size)
        return room[:got]
    raise ValueError(f"compressor = {compressor!r} is unknown")


def _are_axes(words: list[str]) -> bool:
    """Whether the axes of an image are x, y and z."""
    try:
        return np.array_equal(np.array(words, dtype=float), np.eye(3).ravel())
    except ValueError:
        return False
