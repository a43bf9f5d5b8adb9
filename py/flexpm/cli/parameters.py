# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinds of values that options of the command take, each checked as it is read. SI units."""

from __future__ import annotations

import contextlib
import re
from typing import Any

import click

from ..errors import InputError
from ..require import ANY, POSITIVE, Bounds, require_known, require_number, require_whole
from ..runs.groups import AUTO


class Quantity(click.ParamType):
    """A finite number with a unit and a range."""

    name = "number"

    def __init__(self, unit: str = "", bounds: Bounds = ANY) -> None:
        self.unit, self.bounds = unit, bounds

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number, or raise InputError naming option, value and rule."""
        number = value
        with contextlib.suppress(ValueError):
            number = float(str(value))
        return require_number(label_of(param), number, self.bounds, self.unit, shown=str(value))


class Pressures(Quantity):
    """One pressure, or two between a comma."""

    name = "pressures"

    def convert(  # type: ignore[override]  # one or two
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, ...]:
        """Return one or two numbers, or raise InputError."""
        if isinstance(value, tuple):
            return value
        parts = str(value).split(",")
        if len(parts) > 2:
            raise InputError(
                f"{label_of(param)} = {value} Pa, must be one or two pressures; write P or P,P"
            )
        return tuple(super(Pressures, self).convert(part.strip(), param, ctx) for part in parts)


class Rate(Quantity):
    """A factor on the loading rate, or ``auto``."""

    name = "rate"

    def convert(  # type: ignore[override]  # or a word
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float | str:
        """Return the number or the word, or raise InputError."""
        return AUTO if value == AUTO else super().convert(value, param, ctx)


class Range(click.ParamType):
    """Two lengths DMIN,DMAX with 0 < DMIN <= DMAX."""

    name = "range"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        """Return both lengths, or raise InputError."""
        if isinstance(value, tuple):
            low, high = value
            return low, high
        parts = str(value).split(",")
        if len(parts) != 2:
            raise InputError(f"{label_of(param)} = {value} m, must be two lengths; write DMIN,DMAX")
        length = Quantity("m", POSITIVE)
        low, high = (length.convert(part.strip(), param, ctx) for part in parts)
        if low > high:
            raise InputError(f"{label_of(param)} = {value} m, DMIN must not exceed DMAX; swap them")
        return low, high


class Place(click.ParamType):
    """A point X,Y."""

    name = "place"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        """Return both coordinates, or raise InputError."""
        if isinstance(value, tuple):
            x, y = value
            return x, y
        parts = str(value).split(",")
        if len(parts) != 2:
            raise InputError(f"{label_of(param)} = {value} m, must be two coordinates; write X,Y")
        length = Quantity("m", ANY)
        x, y = (length.convert(part.strip(), param, ctx) for part in parts)
        return x, y


class Several(click.ParamType):
    """Several values between commas, in a fixed order."""

    name = "list"

    def __init__(self, kind: click.ParamType, numbers: tuple[int, ...]) -> None:
        self._kind, self._numbers = kind, numbers

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[Any, ...] | Any:
        """Return the values, a single one alone, or raise InputError."""
        if isinstance(value, tuple):
            return value
        parts = [part.strip() for part in str(value).split(",")]
        if len(parts) not in self._numbers:
            told = " or ".join(map(str, self._numbers))
            raise InputError(
                f"{label_of(param)} = {value}, must be {told} numbers; write commas between them"
            )
        found = tuple(self._kind.convert(part, param, ctx) for part in parts)
        return found if len(found) > 1 else found[0]


class Window(click.ParamType):
    """Parts X0:X1,Y0:Y1,Z0:Z1 of three axes, in voxels."""

    name = "window"
    _PART = re.compile(r"([0-9]{1,9}):([0-9]{1,9})")

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[tuple[int, int], ...]:
        """Return first and end of each part, or raise InputError."""
        if isinstance(value, tuple):
            return value
        parts = [self._PART.fullmatch(part.strip()) for part in str(value).split(",")]
        found = tuple((int(part[1]), int(part[2])) for part in parts if part is not None)
        if len(found) != len(parts) or len(found) != 3:
            raise InputError(
                f"{label_of(param)} = {value}, must be three parts; write X0:X1,Y0:Y1,Z0:Z1"
            )
        return found


class Count(click.ParamType):
    """A whole number of at least `at_least`."""

    name = "integer"

    def __init__(self, at_least: int, at_most: int | None = None) -> None:
        self.at_least, self.at_most = at_least, at_most

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> int:
        """Return the number, or raise InputError."""
        try:
            number = int(str(value))
        except ValueError:
            raise InputError(
                f"{label_of(param)} = {value}, must be a whole number; write it without decimals "
                "and unit"
            ) from None
        return require_whole(
            label_of(param), number, Bounds(at_least=self.at_least, at_most=self.at_most)
        )


class Each(click.ParamType):
    """Several values between commas, each once."""

    name = "list"

    def __init__(self, kind: click.ParamType) -> None:
        self._kind = kind

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[object, ...]:
        """Return the values, or raise InputError."""
        if isinstance(value, tuple):
            return value
        parts = [part.strip() for part in str(value).split(",")]
        found = tuple(self._kind.convert(part, param, ctx) for part in parts)
        for one in found:
            if found.count(one) > 1:
                raise InputError(
                    f"{label_of(param)} = {value}, must name {one} once; remove the repeated entry"
                )
        return found


class Seeds(click.ParamType):
    """Seeds of several packings: numbers and ranges between commas, each seed once."""

    name = "seeds"
    _PART = re.compile(r"([0-9]{1,9})(?:-([0-9]{1,9}))?")
    #: More are a mistake in a range.
    _MOST = 1000

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        """Return the seeds in the order given, or raise InputError."""
        if isinstance(value, tuple):
            return value
        told = f"{label_of(param)} = {value}, must"
        ranges = []
        for part in str(value).split(","):
            found = self._PART.fullmatch(part.strip())
            if found is None:
                raise InputError(f"{told} be whole numbers and ranges; write e.g. 1-5 or 1,3,7-9")
            first, last = int(found[1]), int(found[2] or found[1])
            if last < first:
                raise InputError(f"{told} have increasing ranges; write {last}-{first}")
            ranges.append(range(first, last + 1))
        count = sum(map(len, ranges))
        if count > self._MOST:
            raise InputError(f"{told} be <= {self._MOST} seeds, not {count}; give a smaller range")
        seeds = tuple(seed for one in ranges for seed in one)
        for number, seed in enumerate(seeds):
            if seed in seeds[:number]:
                raise InputError(f"{told} name {seed} once; remove the repeated seed")
        return seeds


class Name(click.ParamType):
    """One of a few names; a typo names the nearest."""

    name = "name"

    def __init__(self, *known: str) -> None:
        self.known = known

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> str:
        """Return the name, or raise InputError with the nearest known name."""
        require_known(label_of(param), value, self.known)
        return str(value)


def label_of(param: click.Parameter | None) -> str:
    """Name of a parameter as the user knows it."""
    if param is None:
        return "value"
    return (
        param.human_readable_name.lower()
        if param.param_type_name == "argument"
        else (param.opts[0].lstrip("-"))
    )
