# SPDX-License-Identifier: GPL-3.0-or-later
"""Raster tessellations of Neper, ``.tesr`` in the plane, as labels.

The format is that of Neper's documentation, "Raster Tessellation File".
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...arrays import IntArray
from ..files.neper_text import Words
from .given import MOST_PIXELS

#: Sides of a pixel differ by less [-].
_SQUARE = 1e-6
_LARGEST_LABEL = 2**31 - 1


def read(path: Path) -> IntArray:
    """Read labels, the first row on top; 0 is void.

    Raises:
        InputError: for a file that cannot be read, has three dimensions, pixels that are not
            square or data that are no text, and one that is broken: with its line.
    """
    words = Words(path, "tesr")
    words.expect("***tesr")
    words.skip_to("**general")
    dimension = words.whole("dimension", 1, 3)
    if dimension != 2:
        raise words.refused(
            f"dimension = {dimension}, must be 2: stacks are not read; cut a slice by Neper"
        )
    columns, rows = (words.whole(f"size {key}", 2, MOST_PIXELS) for key in "xy")
    if columns * rows > MOST_PIXELS:
        raise words.refused(f"size = {columns} x {rows} pixels, must be <= {MOST_PIXELS} in all")
    width, height = (words.number(f"size of a pixel {key}") for key in "xy")
    if not abs(width - height) <= _SQUARE * abs(width):
        raise words.refused(f"pixel = {width:g} x {height:g}, must be square; resample it by Neper")
    words.skip_to("**data")
    if words.section == "*file":
        raise words.refused("data = in a file of their own, must be ascii here; write them so")
    kind = words.word("data format")
    if kind != "ascii" or words.section:
        raise words.refused(f"data format = {kind}, must be ascii; write it as ascii")
    labels = np.array(
        [words.whole("cell of a pixel", 0, _LARGEST_LABEL) for _ in range(columns * rows)]
    )
    return labels.reshape(rows, columns)[::-1].copy()
