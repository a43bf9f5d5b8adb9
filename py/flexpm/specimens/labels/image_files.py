# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the libraries that read images and arrays, as one line each."""

from __future__ import annotations

import contextlib
import os
import struct
import sys
import tokenize
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...errors import InputError

if TYPE_CHECKING:
    from PIL.Image import Image as ImageFile

#: Errors of Pillow and numpy for broken files.
BROKEN = (
    *(OSError, EOFError, ValueError, SyntaxError, TypeError, LookupError, AttributeError),
    *(OverflowError, ZeroDivisionError, struct.error, tokenize.TokenError),
)
#: Longest head of an array, and longest output of a library that is read [byte].
_LONGEST = 10_000


@contextlib.contextmanager
def opened(path: Path, refused: Callable[[str], InputError]) -> Iterator[ImageFile]:
    """Yield a PNG or TIFF image of which only the head has been read.

    The errors of Pillow and libtiff, and their lines on standard error, become one error.

    Args:
        path: The file.
        refused: Makes the error of a reason.

    Raises:
        InputError: if the block fails, or a C library has complained.
    """
    from PIL import Image

    reason = ""
    with _complaints() as lines, warnings.catch_warnings():
        # large images are refused by their readers, broken ones by errors
        warnings.simplefilter("ignore")
        try:
            with Image.open(path, formats=("PNG", "TIFF")) as image:
                yield image
        except InputError:  # a ValueError, too
            raise
        except (*BROKEN, Image.DecompressionBombError) as error:
            reason = short(error)
    if lines or reason:
        raise refused(lines[0] if lines else reason)


@contextlib.contextmanager
def _complaints() -> Iterator[list[str]]:
    """Collect the lines that C libraries write to standard error for a broken TIFF file."""
    lines: list[str] = []
    kept, taken = os.dup(2), os.memfd_create("complaints")
    try:
        if sys.stderr is not None:
            sys.stderr.flush()
        os.dup2(taken, 2)
        yield lines
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        with os.fdopen(taken, "rb") as written:
            written.seek(0)
            lines += written.read(_LONGEST).decode(errors="replace").splitlines()


def short(error: Exception) -> str:
    """Return the first line of an error."""
    return str(error).splitlines()[0] if str(error) else type(error).__name__


def require_short_head(path: Path) -> None:
    """Check the claimed length of the head of a ``.npy`` file, for which numpy makes room.

    Raises:
        OSError: if the file cannot be read.
        ValueError: if the head is too long.
    """
    first = np.fromfile(path, dtype=np.uint8, count=12).tobytes()
    magic, version, length = struct.unpack("<6sHI", first.ljust(12, b"\0"))
    if magic == b"\x93NUMPY" and version & 0xFF >= 2 and length > _LONGEST:
        raise ValueError(f"head = {length} bytes, must be <= {_LONGEST}; save the array again")
