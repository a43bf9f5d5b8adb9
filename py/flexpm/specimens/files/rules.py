# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for the values of a specimen file, shared by 2D and 3D."""

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
    """Return the error of a file with inconsistent content."""
    return InputError(f"specimen file: {what}; save the specimen again")


def is_count(value: object) -> bool:
    """Whether a value is an integer >= 0 that fits into the integers of the kernel."""
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**31


def is_number(value: object) -> TypeGuard[float]:
    """Whether a value is a number in the range of lengths."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e9


def is_positive(value: object) -> bool:
    """Whether a value is a number in the range of lengths, and above 0."""
    return is_number(value) and value > 0.0


def is_text(value: object) -> bool:
    """Whether a value is a string."""
    return isinstance(value, str)


def list_of(rule: Rule, least: int = 0, most: float = math.inf) -> Rule:
    """Return the rule of a list with `least` to `most` items that all satisfy `rule`."""

    def holds(value: object) -> bool:
        return isinstance(value, list) and least <= len(value) <= most and all(map(rule, value))

    return holds


def row_of(columns: int, rule: Rule = is_number) -> Rule:
    """Return the rule of a list of `columns` values that all satisfy `rule`."""
    return list_of(rule, columns, columns)


def or_none(rule: Rule) -> Rule:
    """Return the rule of a value that may be None."""
    return lambda value: value is None or rule(value)


def require_rules(content: Table, rules: Mapping[str, Rule], later: Sequence[str] = ()) -> None:
    """Check that each key exists and that its value satisfies its rule.

    Args:
        content: Content of the file.
        rules: Rule of each key.
        later: Keys that files of earlier versions do not have.

    Raises:
        InputError: for the first key that is missing or whose value breaks its rule.
    """
    for name, holds in rules.items():
        if name in content and not holds(content[name]):
            raise refuse(f"{name} = {quoted(content[name])}, is not valid")
        if name not in content and name not in later:
            raise refuse(f"{name} is missing")


def spec_values(given: Table, names: Sequence[str], rules: Mapping[str, Rule]) -> Table:
    """Return the fields of a spec in a file; the spec itself checks fields without a rule.

    Raises:
        InputError: for an unknown field, or a field of another type.
    """
    for name, value in given.items():
        if name not in names:
            raise refuse(f"spec {quoted(name)}, is unknown")
        if name in rules and not rules[name](value):
            raise refuse(f"spec {name} = {quoted(value)}, is not valid")
    diameters = given.get("diameters")
    return given if diameters is None else given | {"diameters": tuple(diameters)}
