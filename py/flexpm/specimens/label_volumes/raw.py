# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from files that have nothing but numbers, ``.raw``, x fastest."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ...arrays import NumberType
from ...errors import InputError
from ...require import Bounds, quoted, require_list, require_text, require_whole
from .label_volume import AXES, Counts
from .volume_file import Content, VolumeFile, name_of, refused, require_file

#: Types of numbers; < and > before them are the byte orders little and big endian.
_TYPES = {
    **{f"u{size}": f"u{size}" for size in (1, 2, 4, 8)},
    **{f"i{size}": f"i{size}" for size in (1, 2, 4, 8)},
    **{f"f{size}": f"f{size}" for size in (4, 8)},
    **{f"uint{8 * size}": f"u{size}" for size in (1, 2, 4, 8)},
    **{f"int{8 * size}": f"i{size}" for size in (1, 2, 4, 8)},
    **{f"float{8 * size}": f"f{size}" for size in (4, 8)},
}
#: Most voxels along an axis.
_MOST = 10**6


def read(path: Path, counts: Sequence[int] | None, dtype: str | None) -> VolumeFile:
    """Return the volume of a file, whose values stay in the file until they are used.

    Args:
        path: The file.
        counts: Number of voxels along x, y, z.
        dtype: Type of the numbers: ``uint8`` to ``int64``, ``float32`` or ``float64``; with ``>``
            before it they are big endian, otherwise little endian.

    Raises:
        InputError: if an argument is missing or wrong, or the size of the file differs.
    """
    size = require_file(path)
    if counts is None or dtype is None:
        missing = " and ".join(
            name for name, value in (("counts", counts), ("dtype", dtype)) if value is None
        )
        raise refused(
            path,
            f"{missing}: a .raw file has no head",
            "give counts along x, y, z and dtype, such as uint16, or >u2 for big endian",
        )
    sizes, form = _counts(counts), _form(dtype)
    expected = math.prod(sizes) * form.itemsize
    if size != expected:
        raise refused(
            path,
            f"size = {size} bytes, must be {expected} for {' x '.join(map(str, sizes))} numbers "
            f"of {form.itemsize} bytes",
            "correct counts or dtype",
        )

    def load() -> Content:
        shape = sizes[::-1]
        try:
            return Content(np.memmap(path, dtype=form, mode="r", shape=shape))
        except (OSError, ValueError) as error:
            raise InputError(
                f"{name_of(path)}, cannot be read ({error}); give a file of numbers"
            ) from None

    return VolumeFile(sizes, load)


def _counts(counts: object) -> Counts:
    found = require_list("counts", counts)
    if len(found) != 3:
        raise InputError(
            f"counts = {quoted(counts)}, must be three numbers; give voxels along x, y and z"
        )
    bounds = Bounds(at_least=1, at_most=_MOST)
    x, y, z = (
        require_whole(f"counts along {axis}", value, bounds)
        for axis, value in zip(AXES, found, strict=True)
    )
    return x, y, z


def _form(dtype: object) -> NumberType:
    match = re.fullmatch(r"([<>]?)(\w+)", require_text("dtype", dtype))
    if match is None or match[2] not in _TYPES:
        raise InputError(
            f"dtype = {quoted(dtype)}, must be one of {', '.join(_TYPES)}, with > before it for "
            "big endian; choose one of them"
        )
    return np.dtype((match[1] or "<") + _TYPES[match[2]])
