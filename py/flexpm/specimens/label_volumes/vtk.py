# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from legacy files of VTK, ``.vtk``, of structured points.

Format: "The VTK User's Guide", chapter "VTK File Formats". Numbers in bytes are big endian.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np

from ...arrays import AnyArray
from ...errors import InputError
from ...require import quoted
from ..files.number_text import (
    Bytes,
    WrongTextError,
    end_of_words,
    first_of,
    line_at,
    numbers_of,
)
from .label_volume import Counts
from .volume_file import VolumeFile, refused, triple_of
from .vtk_arrays import MOST_ALONG, Array, Grid, content_of, volume_of

_TYPES = {
    **{"char": "i1", "unsigned_char": "u1", "short": "i2", "unsigned_short": "u2"},
    **{"int": "i4", "unsigned_int": "u4", "long": "i8", "unsigned_long": "u8"},
    **{"vtktypeint64": "i8", "vtktypeuint64": "u8", "vtkidtype": "i4"},
    **{"float": "f4", "double": "f8", "unsigned_char of colours": "u1"},
}
#: Attributes of a fixed number of components, which cannot be labels.
_VECTORS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9}
#: Type of colours: bytes, or in texts parts of 255. VTK writes labels of 8 bits so, too.
_COLOURS = "unsigned_char of colours"
_LONGEST_LINE, _MOST_COMPONENTS, _MOST_ARRAYS = 1000, 100, 1000
_NEW_LINE = ord("\n")


def read(path: Path, array: str | None = None) -> VolumeFile:
    """Return the head of a file of structured points.

    Args:
        path: The file.
        array: Name of the labels; None: the only array of whole numbers.

    Raises:
        InputError: for a file that cannot be read, another kind of grid, or no such array.
    """
    return volume_of(path, _Reader(path, content_of(path)).grid(), array)


class _Reader:
    """Reads lines and arrays one after the other."""

    def __init__(self, path: Path, content: Bytes) -> None:
        self._path, self._content = path, content
        self._at, self._line = 0, 0
        self._is_text = True
        self._arrays: list[Array] = []

    def grid(self) -> Grid:
        """Return the grid and its arrays."""
        if not self._next_line().startswith("# vtk DataFile"):
            raise self._wrong("must begin with # vtk DataFile", "give a legacy file of VTK")
        self._next_line()
        form = self._next_line().strip().upper()
        if form not in ("ASCII", "BINARY"):
            raise self._wrong(f"format = {quoted(form)}, must be ASCII or BINARY", "correct it")
        self._is_text = form == "ASCII"
        words = self._words()
        if words[:2] != ["DATASET", "STRUCTURED_POINTS"]:
            raise self._wrong(
                f"grid = {quoted(' '.join(words))}, must be DATASET STRUCTURED_POINTS",
                "save it as an image",
            )
        head = {"ORIGIN": ["0"] * 3, "SPACING": ["1"] * 3}
        while (words := self._words()) and words[0] not in ("CELL_DATA", "POINT_DATA"):
            key = "SPACING" if words[0] == "ASPECT_RATIO" else words[0]
            if key not in ("DIMENSIONS", "ORIGIN", "SPACING"):
                raise self._wrong(f"section = {quoted(words[0])}, is unknown", "correct it")
            head[key] = words[1:]
        if "DIMENSIONS" not in head:
            raise self._wrong("DIMENSIONS is missing", "complete the file")
        points = self._counts(head["DIMENSIONS"])
        spacing = triple_of(self._path, "SPACING", head["SPACING"], 0.0)
        origin = triple_of(self._path, "ORIGIN", head["ORIGIN"], -math.inf)
        while words:
            words = self._data(words, points)
        return Grid(points, spacing, origin, self._arrays)

    def _data(self, words: list[str], points: Counts) -> list[str]:
        """Read arrays of cells or points; returns the words of the next such section."""
        of_cells = words[0] == "CELL_DATA"
        expected = math.prod(count - 1 if of_cells else count for count in points)
        number = self._whole(words[1:2], f"number in {words[0]}")
        if number != expected:
            raise self._wrong(
                f"{words[0]} = {number}, must be {expected} by DIMENSIONS", "correct one of them"
            )
        while (words := self._words()) and words[0] not in ("CELL_DATA", "POINT_DATA"):
            if len(self._arrays) > _MOST_ARRAYS:
                raise self._wrong(f"arrays = more than {_MOST_ARRAYS}", "save the labels alone")
            self._attribute(words, number, of_cells)
        return words

    def _attribute(self, words: list[str], number: int, of_cells: bool) -> None:
        """Read an attribute of cells or points."""
        kind = words[0].upper()
        if kind == "SCALARS" and len(words) >= 3:
            components = self._whole(words[3:4] or ["1"], "components")
            before = self._at, self._line
            if self._words()[:1] != ["LOOKUP_TABLE"]:
                self._at, self._line = before
            self._array(words[1], words[2], components, number, of_cells)
        elif kind == "FIELD" and len(words) >= 3:
            for _ in range(self._whole(words[2:3], "arrays of a field", _MOST_ARRAYS)):
                row = self._words()
                while row[:1] == ["METADATA"]:
                    self._skip_metadata()
                    row = self._words()
                if len(row) != 4:
                    raise self._wrong(
                        f"array of a field = {quoted(' '.join(row))}, must be name, components, "
                        "number and type",
                        "complete the file",
                    )
                counts = [self._whole(row[k : k + 1], "numbers of a field") for k in (1, 2)]
                self._array(row[0], row[3], counts[0], counts[1], of_cells, number)
        elif kind in _VECTORS and len(words) >= 3:
            self._array(words[1], words[2], _VECTORS[kind], number, of_cells)
        elif kind == "COLOR_SCALARS" and len(words) >= 3:
            self._array(words[1], _COLOURS, self._whole(words[2:], "components"), number, of_cells)
        elif kind == "LOOKUP_TABLE" and len(words) >= 3:
            self._array(words[1], _COLOURS, 4, self._whole(words[2:], "colours"), of_cells, -1)
        elif kind == "METADATA":
            self._skip_metadata()
        else:
            raise self._wrong(
                f"attribute = {quoted(words[0])}, must be SCALARS, FIELD or {', '.join(_VECTORS)}",
                "save the labels alone",
            )

    def _array(
        self,
        name: str,
        kind: str,
        components: int,
        number: int,
        of_cells: bool,
        expected: int | None = None,
    ) -> None:
        """Note an array and pass it."""
        if kind.lower() not in _TYPES or not 1 <= components <= _MOST_COMPONENTS:
            raise self._wrong(
                f"array {quoted(name)} = {components} components of type {quoted(kind)}, must be "
                f"1 to {_MOST_COMPONENTS} of {', '.join(_TYPES)}",
                "convert it",
            )
        form = np.dtype(_TYPES[kind.lower()]).newbyteorder(">")
        start, size = self._at, number * components
        if self._is_text:
            end = end_of_words(self._content, start, size) if size else start
            self._at = self._behind_line(end)
        else:
            end = start + size * form.itemsize
            self._at = end
        if end > len(self._content) or (self._is_text and 2 * size - 1 > end - start):
            raise self._wrong(
                f"array {quoted(name)} = less than {size} numbers, must be {size} of type {kind}",
                "give a whole file",
            )
        if expected not in (None, number):
            return  # a table of colours, or a field of another size

        def values(asked: int) -> AnyArray:
            if not self._is_text:
                return self._content[start:end].view(form)[:asked]
            try:
                if kind == _COLOURS:
                    parts = numbers_of(self._content, start, end, asked, np.dtype(float))
                    whole: AnyArray = np.rint(255.0 * parts)
                    return whole
                return numbers_of(self._content, start, end, asked, form.newbyteorder("="))
            except WrongTextError as error:
                raise self._wrong(
                    f"array {quoted(name)}: number = {quoted(error.word)}, must be one of {asked} "
                    f"of type {kind}",
                    "correct it",
                    line_at(self._content, error.position),
                ) from None

        memory = (16 if kind == _COLOURS else form.itemsize) if self._is_text else 0
        self._arrays.append(Array(name, of_cells, form, components, values, memory))

    def _counts(self, words: list[str]) -> Counts:
        if len(words) != 3:
            raise self._wrong(
                f"DIMENSIONS = {quoted(' '.join(words))}, must be 3 numbers", "correct it"
            )
        x, y, z = (self._whole([word], "DIMENSIONS", MOST_ALONG) for word in words)
        return x, y, z

    def _whole(self, words: list[str], what: str, most: int = 2**62) -> int:
        word = words[0] if words else ""
        if not re.fullmatch(r"[0-9]{1,18}", word) or int(word) > most:
            raise self._wrong(
                f"{what} = {quoted(word)}, must be a whole number from 0 to {most}", "correct it"
            )
        return int(word)

    def _words(self) -> list[str]:
        """Return the words of the next line that has some; none at the end of the file."""
        while self._at < len(self._content):
            if words := self._next_line().split():
                return words
        return []

    def _skip_metadata(self) -> None:
        while self._at < len(self._content) and self._next_line().strip():
            pass

    def _next_line(self) -> str:
        self._line = self._at
        end = self._at + _LONGEST_LINE
        part = self._content[self._at : end]
        stop = first_of(part, _NEW_LINE)
        self._at += min(stop + 1, len(part))
        return part[:stop].tobytes().decode(errors="replace").rstrip("\r")

    def _behind_line(self, position: int) -> int:
        return min(first_of(self._content, _NEW_LINE, position) + 1, len(self._content))

    def _wrong(self, reason: str, remedy: str, line: int | None = None) -> InputError:
        where = line_at(self._content, self._line) if line is None else line
        return refused(self._path, f"line {where}: {reason}", remedy)
