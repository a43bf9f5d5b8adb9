# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of what users give: each refusal is one line with quantity, value and rule. SI units."""

from __future__ import annotations

import difflib
import math
import numbers
from collections.abc import Sequence
from dataclasses import dataclass

from .errors import InputError


@dataclass(frozen=True)
class Bounds:
    """Range of a number; None is no bound."""

    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None

    def broken(self, number: float) -> str:
        """The rule that a number breaks, empty if it keeps all."""
        if self.above is not None and not number > self.above:
            return f"> {self.above:g}"
        if self.at_least is not None and not number >= self.at_least:
            return f">= {self.at_least:g}"
        if self.below is not None and not number < self.below:
            return f"< {self.below:g}"
        if self.at_most is not None and not number <= self.at_most:
            return f"<= {self.at_most:g}"
        return ""


ANY = Bounds()
POSITIVE = Bounds(above=0.0)
NOT_NEGATIVE = Bounds(at_least=0.0)


def require_number(
    label: str, value: object, bounds: Bounds = ANY, unit: str = "", shown: str = ""
) -> float:
    """Return `value` as a finite float within its bounds, or raise InputError.

    Args:
        label: Name of the quantity.
        value: What was given.
        bounds: Its range.
        unit: For the message; empty for a number without one.
        shown: How the value is quoted, if not as Python would.
    """
    text = f"{label} = {shown or repr(value)} {unit}".rstrip()
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise InputError(f"{text}, must be a number")
    try:
        number = float(value)
    except OverflowError:  # an integer beyond the largest double
        number = math.inf
    if not math.isfinite(number):
        raise InputError(f"{text}, must be finite")
    if rule := bounds.broken(number):
        raise InputError(f"{text}, must be {rule}")
    return number


def require_whole(label: str, value: object, bounds: Bounds = ANY) -> int:
    """Return `value` as a whole number within its bounds, or raise InputError."""
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise InputError(f"{label} = {value!r}, must be a whole number")
    number = int(value)  # numpy's integers are no integers for the kernel
    if rule := bounds.broken(number):
        raise InputError(f"{label} = {number}, must be {rule}")
    return number


def require_one_of(label: str, value: object, choices: Sequence[object]) -> None:
    """Raise InputError unless `value` is one of a few choices."""
    if value not in choices:
        raise InputError(f"{label} = {value!r}, must be one of {', '.join(map(str, choices))}")


def require_known(label: str, name: object, known: Sequence[str]) -> None:
    """Raise InputError, with the nearest known name, unless `name` is one of `known`."""
    if name not in known:
        raise InputError(
            f"{label} = {name!r}, unknown{nearest(str(name), known)}; known are {', '.join(known)}"
        )


def nearest(name: str, known: Sequence[str]) -> str:
    """Return ' (did you mean X?)' for the known name closest to `name`, or an empty text."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
    return f" (did you mean {close[0]}?)" if close else ""
