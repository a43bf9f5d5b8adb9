# SPDX-License-Identifier: GPL-3.0-or-later
"""Read raster tessellations of Neper, ``.tesr`` in 2D, as labels.

Format: Neper's documentation, "Raster Tessellation File".
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...arrays import IntArray
from ...files import read_bytes
from ...require import quoted
from ..files.neper_text import Words
from .given import MOST_PIXELS, NO_VOLUMES

#: Sides of a pixel differ by less [-].
_SQUARE = 1e-6
_LARGEST_LABEL = 2**31 - 1
#: Numbers of cells by the word for their format.
_BINARY = {
    **{"binary8": "u1", "binary16": "<i2", "binary16_big": ">i2"},
    **{"binary32": "<i4", "binary32_big": ">i4"},
}


def read(path: Path) -> IntArray:
    """Read labels, (rows, columns), the first row at the top; 0 is void.

    Raises:
        InputError: for a file that cannot be read or has three dimensions, pixels that are not
            square, or orientations only, and for a broken line, with its number.
    """
    words = Words(path, "tesr")
    words.expect("***tesr")
    words.expect("**format")
    # the oldest files have the format of all data here
    kind = words.word("format of the data") if words.word("format") == "2.0" else ""
    words.skip_to("**general")
    dimension = words.whole("dimension", 1, 3)
    if dimension != 2:
        raise words.refused(
            f"dimension = {dimension}, must be 2: {NO_VOLUMES}; cut a slice by Neper"
        )
    columns, rows = (words.whole(f"size {key}", 2, MOST_PIXELS) for key in "xy")
    if columns * rows > MOST_PIXELS:
        raise words.refused(
            f"size = {columns} x {rows} pixels, must be <= {MOST_PIXELS} in all; use a coarser "
            "raster"
        )
    width, height = (words.number(f"size of a pixel {key}") for key in "xy")
    if not abs(width - height) <= _SQUARE * abs(width):
        raise words.refused(f"pixel = {width:g} x {height:g}, must be square; resample it by Neper")
    most, section = _LARGEST_LABEL, words.skip_to("**cell", "**data", "***end")
    if section == "**cell":
        most = words.whole("cells", 1, _LARGEST_LABEL)
        section = words.skip_to("**data", "***end")
    if section == "***end":
        raise words.refused("**data is missing, the cell of each pixel; compute the cells first")
    labels = _cells(words, kind or words.word("data format"), columns * rows, path.parent)
    if labels.max() > most:
        raise words.refused(
            f"cell of a pixel = {labels.max()}, must be <= {most}, the number of cells in **cell; "
            "correct one of them"
        )
    return labels.reshape(rows, columns)[::-1].copy()


def _cells(words: Words, kind: str, number: int, folder: Path) -> IntArray:
    """Return the cell of each pixel."""
    if kind != "ascii" and kind not in _BINARY:
        raise words.refused(
            f"data format = {quoted(kind)}, must be ascii or one of {', '.join(_BINARY)}; convert "
            "it with Neper"
        )
    binary, is_file = words.binary, words.section == "*file"
    if is_file:
        words.expect("*file")
        path = folder / words.word("file of the data")
        try:
            is_there = path.is_file()  # no pipe, which might never end
            binary = read_bytes(path, 4 * MOST_PIXELS) if is_there else b""
        except (OSError, ValueError) as error:
            why = f"cannot be read: {error}"
            raise words.refused(f"data = {quoted(str(path))}, {why}") from None
        if not is_there:
            raise words.refused(f"data = {quoted(str(path))}, must be a file; put it there")
        if kind == "ascii":
            words = Words(path, "data of a tesr")
    if kind == "ascii":
        whole = [words.whole("cell of a pixel", 0, _LARGEST_LABEL) for _ in range(number)]
        if not words.is_over and not words.section:
            raise words.refused(
                f"data = more than {number} pixels, must be {number} by the size in **general; "
                "correct one of them"
            )
        return np.array(whole)
    form = np.dtype(_BINARY[kind])
    there = len(binary) // form.itemsize
    rest = binary[number * form.itemsize :]
    if there < number or (rest if is_file else not rest.lstrip().startswith(b"*")):
        told = f"{there} pixels" if there < number or is_file else f"more than {number} pixels"
        raise words.refused(
            f"data = {told}, must be {number} by the size in **general; give the whole file"
        )
    labels = np.frombuffer(binary, form, number).astype(int)
    if labels.min() < 0:
        raise words.refused(f"cell of a pixel = {labels.min()}, must be >= 0; correct it")
    return labels
