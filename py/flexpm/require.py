# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of users' values: each error is one line with quantity, value and rule. SI units."""

from __future__ import annotations

import difflib
import math
import numbers
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .errors import InputError
from .files import Table

#: Characters of a value that are quoted.
_QUOTED = 80
#: Likeness of two names of which one may be a slip of the other [-].
_ALIKE = 0.58


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
#: Lengths [m]: no specimen has others, and their squares and quotients are numbers.
LENGTH = Bounds(above=0.0, at_least=1e-9, at_most=1e6)


def require_number(
    label: str, value: object, bounds: Bounds = ANY, unit: str = "", shown: str = "", why: str = ""
) -> float:
    """Return `value` as a finite float within its bounds, or raise InputError.

    Args:
        label: Name of the quantity.
        value: Value of the user.
        bounds: Its range.
        unit: Unit for the message; empty for a number without a unit.
        shown: How the value is quoted, if not as Python would.
        why: Reason of the bounds and remedy, for the message; empty: the remedy is the direction.
    """
    text = f"{label} = {shown or quoted(value)} {unit}".rstrip()
    if not _is_number(value, numbers.Real):
        raise InputError(f"{text}, must be a number; write it without quotes and unit")
    try:
        number = float(value)  # type: ignore[arg-type]
    except OverflowError:  # an integer beyond the largest double
        number = math.inf
    if not math.isfinite(number):
        raise InputError(f"{text}, must be finite; correct it")
    if rule := bounds.broken(number):
        raise InputError(f"{text}, must be {rule}{f': {why}' if why else _towards(rule)}")
    return number


def require_whole(label: str, value: object, bounds: Bounds = ANY) -> int:
    """Return `value` as a whole number within its bounds, or raise InputError."""
    if not _is_number(value, numbers.Integral):
        raise InputError(
            f"{label} = {quoted(value)}, must be a whole number; write it without decimals, quotes "
            "and unit"
        )
    number: int = int(value)  # type: ignore[call-overload]  # numpy's are none for the kernel
    if rule := bounds.broken(number):
        raise InputError(f"{label} = {quoted(number)}, must be {rule}{_towards(rule)}")
    return number


def require_flag(label: str, value: object) -> bool:
    """Return `value` as true or false, or raise InputError."""
    if not (isinstance(value, bool) or type(value).__name__ == "bool_"):  # numpy's
        raise InputError(
            f"{label} = {quoted(value)}, must be true or false; write it without quotes"
        )
    return bool(value)


def require_threads(label: str, value: object) -> int:
    """Return a number of threads, which the machine has cores for."""
    return require_whole(label, value, Bounds(at_least=1, at_most=os.cpu_count()))


def require_table(label: str, value: object) -> Table:
    """Return `value` as a table, of a TOML file or a dictionary, or raise InputError."""
    if not (isinstance(value, Mapping) and all(isinstance(key, str) for key in value)):
        raise InputError(f"{label} = {quoted(value)}, must be a table; give keys with values")
    return dict(value)


def require_tables(label: str, value: object) -> list[Table]:
    """Return `value` as a list of tables, or raise InputError."""
    return [
        require_table(f"{label} {n}", one) for n, one in enumerate(require_list(label, value), 1)
    ]


def require_list(label: str, value: object) -> list[Any]:
    """Return `value` as a list, or raise InputError."""
    if not isinstance(value, list | tuple):
        raise InputError(f"{label} = {quoted(value)}, must be a list; put the values in brackets")
    return list(value)


def require_text(label: str, value: object) -> str:
    """Return `value` as a text, or raise InputError."""
    if not isinstance(value, str):
        raise InputError(f"{label} = {quoted(value)}, must be a text; put it in quotes")
    return value


def require_name(label: str, value: object) -> str:
    """Return `value` as a name that can be read and typed, or raise InputError."""
    name = require_text(label, value)
    if not (name and name.isprintable() and name == name.strip()):
        raise InputError(
            f"{label} = {quoted(value)}, must be a name of printable characters without blanks at "
            "its ends; choose another name"
        )
    return name


def require_file_name(label: str, value: object, suffixes: Sequence[str] = ()) -> str:
    """Return `value` as the name of a file that stays in its folder, or raise InputError.

    Args:
        label: Name of the quantity.
        value: Value of the user.
        suffixes: Permitted suffixes of the name; none: any suffix.
    """
    name = require_text(label, value)
    plain = name.isprintable() and not set(name) & {"/", "\\", "\0"} and not name.startswith(".")
    if not (plain and 0 < len(name) <= _QUOTED):
        raise InputError(
            f"{label} = {quoted(value)}, must be the plain name of a file, at most {_QUOTED} "
            "characters without / and without a leading dot; choose another name"
        )
    if suffixes and not name.endswith(tuple(suffixes)):
        raise InputError(
            f"{label} = {quoted(value)}, must end in {', '.join(suffixes)}; change the ending"
        )
    return name


def quoted(value: object) -> str:
    """`value` as Python shows it, cut where it is long."""
    try:
        text = repr(value)
    except Exception:  # the largest whole numbers have no text, and other people's classes may fail
        text = f"<{type(value).__name__}>"
    text = " ".join(line.strip() for line in text.splitlines())  # arrays have many lines
    return text if len(text) <= _QUOTED else f"{text[:_QUOTED]}..."


def require_one_of(label: str, value: object, choices: Sequence[object]) -> None:
    """Raise InputError unless `value` is one of a few choices."""
    if not _is_among(value, choices):
        raise InputError(
            f"{label} = {quoted(value)}, must be one of {', '.join(map(str, choices))}; choose one "
            "of them"
        )


def require_known(label: str, name: object, known: Sequence[str]) -> None:
    """Raise InputError, with the nearest known name, unless `name` is one of `known`."""
    if not _is_among(name, known):
        hint = nearest(name, known) if isinstance(name, str) else ""
        raise InputError(f"{label} = {quoted(name)}, unknown{hint}; known are {', '.join(known)}")


def _towards(rule: str) -> str:
    """Remedy for a number out of its bounds."""
    return f"; give a {'larger' if rule.startswith('>') else 'smaller'} value"


def _is_number(value: object, kind: type) -> bool:
    """Whether `value` is a number of a kind; truth values and spans of time are none."""
    is_time = getattr(getattr(value, "dtype", None), "kind", "") in ("m", "M")
    return isinstance(value, kind) and not isinstance(value, bool) and not is_time


def _is_among(value: object, choices: Sequence[object]) -> bool:
    """Whether `value` is a choice and has its type: true is not 1, and an array is not a choice."""
    if not isinstance(value, str | numbers.Real):
        return value in choices if value is None else False
    return any(
        value == choice and isinstance(value, bool) == isinstance(choice, bool)
        for choice in choices
    )


def nearest(name: str, known: Sequence[str]) -> str:
    """Return ' (did you mean X?)' for the known name closest to `name`, or an empty text."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=_ALIKE)
    return f" (did you mean {close[0]}?)" if close else ""
