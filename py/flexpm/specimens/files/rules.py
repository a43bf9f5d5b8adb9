# SPDX-License-Identifier: GPL-3.0-or-later
"""What values of a specimen file must be, one by one; the plane and space share it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TypeGuard

from ...errors import InputError
from ...files import Table
from ...require import quoted

#: Whether a value is what its key stands for.
Rule = Callable[[object], bool]


def refuse(what: str) -> InputError:
    """Error of a file whose content has no sense."""
    return InputError(f"specimen file: {what}; save the specimen again")


def is_count(value: object) -> bool:
    """Whether a value is a whole number from 0 on that the kernel can count with."""
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**31


def is_number(value: object) -> TypeGuard[float]:
    """Whether a value is a number of a length's size."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e9


def is_positive(value: object) -> bool:
    """Whether a value is such a number above 0."""
    return is_number(value) and value > 0.0


def is_text(value: object) -> bool:
    """Whether a value is a text."""
    return isinstance(value, str)


def list_of(rule: Rule, least: int = 0, most: float = math.inf) -> Rule:
    """Rule of a list of what fulfils another."""

    def holds(value: object) -> bool:
        return isinstance(value, list) and least <= len(value) <= most and all(map(rule, value))

    return holds


def row_of(columns: int, rule: Rule = is_number) -> Rule:
    """Rule of a list of so many numbers."""
    return list_of(rule, columns, columns)


def or_none(rule: Rule) -> Rule:
    """Rule of what may be missing."""
    return lambda value: value is None or rule(value)


def require_rules(content: Table, rules: Mapping[str, Rule], later: Sequence[str] = ()) -> None:
    """Check that each key is there and of its type.

    Args:
        content: Content of the file.
        rules: What each key holds.
        later: Keys that files of earlier versions lack.

    Raises:
        InputError: for the first that is not.
    """
    for name, holds in rules.items():
        if name in content and not holds(content[name]):
            raise refuse(f"{name} = {quoted(content[name])}, is not valid")
        if name not in content and name not in later:
            raise refuse(f"{name} is missing")


def spec_values(given: Table, names: Sequence[str], rules: Mapping[str, Rule]) -> Table:
    """Fields of a spec that a file holds; what has no rule the spec checks itself.

    Raises:
        InputError: for a field that is unknown or of another type.
    """
    for name, value in given.items():
        if name not in names:
            raise refuse(f"spec {quoted(name)}, is unknown")
        if name in rules and not rules[name](value):
            raise refuse(f"spec {name} = {quoted(value)}, is not valid")
    diameters = given.get("diameters")
    return given if diameters is None else given | {"diameters": tuple(diameters)}
