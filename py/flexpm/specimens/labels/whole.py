# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels as whole numbers, for images and volumes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...arrays import AnyArray, IntArray
from ...errors import InputError

#: Kinds of numbers that labels may have: truth values, whole numbers, and floats that are whole.
KINDS = "biuf"
#: Above it, floats are not exact.
_MOST_FLOAT = 2.0**53
_INT = np.iinfo(np.int64)


def whole_numbers(what: str, given: AnyArray, position: Callable[[list[int]], str]) -> IntArray:
    """Return labels as integers of 64 bits.

    Args:
        what: Name of the labels, for messages.
        given: The labels, of a kind in `KINDS`.
        position: Text for the position of an element, from its index in `given`.

    Returns:
        The labels, in an array of the same shape.

    Raises:
        InputError: for numbers that are not whole, or that do not fit.
    """
    if given.dtype.kind == "f":
        wrong = ~np.isfinite(given) | (given != np.floor(given)) | (np.abs(given) > _MOST_FLOAT)
        if wrong.any():
            at: list[int] = np.argwhere(wrong)[0].tolist()
            raise InputError(
                f"{what} = {given[tuple(at)]} at {position(at)}, must be whole numbers; round them"
            )
    if given.dtype.kind == "u" and given.max(initial=0) > _INT.max:
        raise InputError(f"{what} = {given.max()}, must be below 2^63; renumber them")
    whole = given.astype(np.int64)
    if whole.min(initial=0) == _INT.min:  # one less stands for holes
        raise InputError(f"{what} = {whole.min()}, must be above -2^63; renumber them")
    return whole
