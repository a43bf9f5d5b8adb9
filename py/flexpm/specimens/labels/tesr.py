# SPDX-License-Identifier: GPL-3.0-or-later
"""Read raster tessellations of Neper, ``.tesr`` in 2D and 3D, as labels.

Format: Neper's documentation, "Raster Tessellation File".
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ...arrays import AnyArray, IntArray
from ...errors import InputError
from ...require import quoted
from ..files.neper_text import Words
from ..files.number_text import Bytes, WrongTextError, first_of, line_at, mapped, numbers_of
from .given import MOST_PIXELS, NO_VOLUMES

#: Sides of a pixel differ by less [-].
_SQUARE = 1e-6
#: Largest label, and most cells along an axis.
_LARGEST = 2**31 - 1
#: Largest size of all before the data [byte].
_LARGEST_HEAD = 64 * 10**6
#: Numbers of cells by the word for their format.
_BINARY = {
    **{"binary8": "u1", "binary16": "<i2", "binary16_big": ">i2"},
    **{"binary32": "<i4", "binary32_big": ">i4"},
}
#: The head ends before the data, or before the orientations of a file without cells.
_END_OF_HEAD = re.compile(rb"\*\*(?:data|oridata|oridef)(?=\s)")
_FORMAT = re.compile(rb"\s*([^\s*]\S*)[ \t]*(?:\r?\n)?")
_FILE = re.compile(rb"\s*\*file\s+(\S+)")
_SECTIONS = ("**cell", "**data", "**oridata", "**oridef", "***end")


@dataclass(frozen=True)
class Raster:
    """The head of a raster tessellation, and where its cells are.

    Attributes:
        path: The file.
        counts: Number of pixels or voxels along x, y (, z).
        spacing: Size of a pixel or voxel.
        origin: Corner of the first pixel or voxel.
        cells: Number of cells; None: not given.
        ids: Label of each cell from 1 on; None: its number.
        phases: Phase of each cell; None without phases.
        form: Format of the data.
        data: File of the data.
        start: Position of the data in this file [byte].
    """

    path: Path
    counts: tuple[int, ...]
    spacing: tuple[float, ...]
    origin: tuple[float, ...]
    cells: int | None
    ids: IntArray | None
    phases: IntArray | None
    form: str
    data: Path
    start: int

    @property
    def number(self) -> int:
        """Number of pixels or voxels."""
        return int(np.prod(self.counts, dtype=object))

    @property
    def element(self) -> str:
        """Word for an element of the raster."""
        return "pixel" if len(self.counts) == 2 else "voxel"

    def labels(self) -> AnyArray:
        """Return the label of each element, x fastest, then y; 0 is void.

        Raises:
            InputError: for data that are broken or of another number.
        """
        content = _mapped(self.data)
        found = self._text(content) if self.form == "ascii" else self._numbers(content)
        lowest, highest = int(found.min()), int(found.max())
        if lowest < 0:
            raise self._refused(f"cell of a {self.element} = {lowest}, must be >= 0; correct it")
        if self.cells is not None and highest > self.cells:
            raise self._refused(
                f"cell of a {self.element} = {highest}, must be <= {self.cells}, the number of "
                "cells in **cell; correct one of them"
            )
        if self.ids is None:
            return found
        table = np.zeros(len(self.ids) + 1, dtype=np.int32)
        table[1:] = self.ids
        named: npt.NDArray[np.int32] = table[found]
        return named

    def _numbers(self, content: Bytes) -> AnyArray:
        """Return data that are bytes, which stay in the file."""
        form = np.dtype(_BINARY[self.form])
        rest = content[self.start :]
        size = self.number * form.itemsize
        after = rest[size : size + 100].tobytes()
        is_file = self.data != self.path
        if len(rest) < size or (after if is_file else not after.lstrip().startswith(b"*")):
            there = len(rest) // form.itemsize
            told = f"{there}" if there < self.number or is_file else f"more than {self.number}"
            raise self._refused(
                f"data = {told} {self.element}s, must be {self.number} by the size in **general; "
                "give the whole file"
            )
        return rest[:size].view(form)

    def _text(self, content: Bytes) -> AnyArray:
        """Return data that are text; they are converted in parts."""
        end = first_of(content, ord("*"), self.start)
        try:
            found = numbers_of(content, self.start, end, self.number, np.dtype(np.int32))
        except WrongTextError as error:
            if error.is_longer:
                raise self._refused(
                    f"data = more than {self.number} {self.element}s, must be {self.number} by the "
                    "size in **general; correct one of them"
                ) from None
            raise InputError(
                f"tesr = {quoted(str(self.data))}, line {line_at(content, error.position)}: cell "
                f"of a {self.element} = {quoted(error.word)}, must be a whole number from 0 to "
                f"{_LARGEST}; correct it or the size in **general"
            ) from None
        return found

    def _refused(self, why: str) -> InputError:
        return InputError(f"tesr = {quoted(str(self.path))}: {why}")


def read(path: Path) -> IntArray:
    """Read labels of a 2D raster, (rows, columns), the first row at the top; 0 is void.

    Raises:
        InputError: for a file that cannot be read or has three dimensions, pixels that are not
            square, or orientations only, and for a broken line, with its number.
    """
    raster = head(path, 2)
    columns, rows = raster.counts
    labels: IntArray = raster.labels().reshape(rows, columns)[::-1].astype(np.int64)
    return labels


def head(path: Path, dimension: int) -> Raster:
    """Read all but the cells of the pixels or voxels.

    Args:
        path: The file.
        dimension: Its dimension, 2 or 3.

    Raises:
        InputError: as `read`.
    """
    content = _mapped(path)
    match = _END_OF_HEAD.search(content[:_LARGEST_HEAD].tobytes())
    if match is None and len(content) > _LARGEST_HEAD:
        raise InputError(
            f"tesr = {quoted(str(path))}, cannot be read: the part before **data is larger than "
            f"{_LARGEST_HEAD // 10**6} MB; give a file of Neper"
        )
    end = len(content) if match is None else match.end()
    words = Words(path, "tesr", content[:end].tobytes())
    words.expect("***tesr")
    words.expect("**format")
    # the oldest files have the format of all data here
    kind = words.word("format of the data") if words.word("format") == "2.0" else ""
    words.skip_to("**general")
    if (found := words.whole("dimension", 1, 3)) != dimension:
        other = f"{NO_VOLUMES}; cut a slice by Neper" if dimension == 2 else "give a volume, or"
        other += "" if dimension == 2 else " a raster in 2D to flexpm specimen image"
        raise words.refused(f"dimension = {found}, must be {dimension}: {other}")
    axes = "xyz"[:dimension]
    counts = tuple(words.whole(f"size {key}", 1 + (dimension == 2), _LARGEST) for key in axes)
    if dimension == 2 and counts[0] * counts[1] > MOST_PIXELS:
        raise words.refused(
            f"size = {counts[0]} x {counts[1]} pixels, must be <= {MOST_PIXELS} in all; use a "
            "coarser raster"
        )
    spacing = tuple(words.number(f"size of a pixel {key}") for key in axes)
    if dimension == 2 and not abs(spacing[0] - spacing[1]) <= _SQUARE * abs(spacing[0]):
        raise words.refused(
            f"pixel = {spacing[0]:g} x {spacing[1]:g}, must be square; resample it by Neper"
        )
    origin = tuple(0.0 for _ in axes)
    section = words.skip_to("*origin", *_SECTIONS)
    if section == "*origin":
        origin = tuple(words.number(f"origin {key}") for key in axes)
        section = words.skip_to(*_SECTIONS)
    cells, ids, phases = None, None, None
    if section == "**cell":
        cells, ids, phases, section = _cells(words)
    if section != "**data":
        raise words.refused("**data is missing, the cell of each pixel; compute the cells first")
    form, data, start = _data(words, content, end, kind)
    return Raster(path, counts, spacing, origin, cells, ids, phases, form, data, start)


def _cells(words: Words) -> tuple[int | None, IntArray | None, IntArray | None, str]:
    """Return number, labels and phases of the cells, and the section that follows."""
    cells = None if words.section else words.whole("cells", 0, _LARGEST)
    found: dict[str, IntArray] = {}
    while True:
        section = words.skip_to("*id", "*phase", "*group", *_SECTIONS)
        if section in _SECTIONS:
            break
        rows = []
        while not (words.section or words.is_over):
            rows.append(words.whole(f"{section[1:]} of a cell", 0, _LARGEST))
        if cells is not None and len(rows) != cells:
            raise words.refused(
                f"{section} = {len(rows)} numbers, must be {cells}, the number of cells; correct it"
            )
        cells = len(rows)
        found[section] = np.array(rows, dtype=np.int64)
    ids = found.get("*id")
    if ids is not None and len(np.unique(ids[ids > 0])) < len(ids):
        raise words.refused(
            "*id = 0 or the same number twice, must be different numbers from 1 on; correct it"
        )
    if ids is not None and np.array_equal(ids, np.arange(1, len(ids) + 1)):
        ids = None
    return cells, ids, found.get("*phase", found.get("*group")), section


def _data(words: Words, content: Bytes, at: int, kind: str) -> tuple[str, Path, int]:
    """Return format, file and position of the data, which follow their mark."""
    after = content[at : at + 5000].tobytes()
    if kind:
        first = re.match(rb"[ \t]*(?:\r?\n)?", after)
    else:
        first = _FORMAT.match(after)
        kind = first[1].decode(errors="replace") if first else ""
    if kind != "ascii" and kind not in _BINARY:
        raise words.refused(
            f"data format = {quoted(kind)}, must be ascii or one of {', '.join(_BINARY)}; convert "
            "it with Neper"
        )
    skipped = first.end() if first else 0
    named = _FILE.match(after, skipped)
    if named is None:
        return kind, words.path, at + skipped
    try:
        data = words.path.parent / named[1].decode()
        is_there = data.is_file()  # no pipe, which might never end
    except (OSError, ValueError) as error:
        raise words.refused(f"data file cannot be read: {error}; correct its name") from None
    if not is_there:
        raise words.refused(f"data = {quoted(str(data))}, must be a file; put it there")
    return kind, data, 0


def _mapped(path: Path) -> Bytes:
    """Return the content of a file, which stays on the disk until it is used."""
    try:
        return mapped(path)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"tesr = {quoted(str(path))}, cannot be read ({reason}); give a file of Neper"
        ) from None
