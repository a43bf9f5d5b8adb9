# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the command, of studies and of result.json, and their help texts. SI units."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ..dimensions import refused
from ..require import ANY, POSITIVE, Bounds, require_number, require_one_of
from .model_names import BLOCK_MODELS

#: A value of an option; None: not given.
Value = float | str | None
#: Pressures that a test may put on a specimen [Pa].
PRESSURE = Bounds(above=0.0, at_most=1e15)


@dataclass(frozen=True)
class Option:
    """Option of a run.

    Several tests may share the name of an option: the command then has a single option, whose help
    lists the default of each test.
    """

    name: str
    help: str  #: a phrase, without unit and default
    unit: str = ""  #: empty for a number without one, and for a word
    bounds: Bounds = POSITIVE  #: range that the command accepts; the test may be stricter
    choices: tuple[str, ...] = ()  #: valid words
    default: str = ""  #: description of the default value, for the help
    open: str = ""  #: text on pages if the run determines the value; empty: it never does
    size: str = ""  #: size of the specimen for which it is another name
    models: tuple[str, ...] = ()  #: models with this option; empty: all models of the test
    whole: bool = False  #: a whole number
    metavar: str = ""  #: placeholder in the help of the command; empty: by choices or unit

    @property
    def phrase(self) -> str:
        """Help text with the unit."""
        return f"{self.help} [{self.unit}]" if self.unit else self.help


def told_of(tests: Mapping[str, Option]) -> tuple[str, str]:
    """Return the help text with the unit, and the default, of an option that `tests` share."""
    first = next(iter(tests.values()))
    what = _each({test: one.help for test, one in tests.items()})
    those = f", for {' and '.join(tests)}" if what == first.help else ""
    words = {test: ", ".join(one.choices) for test, one in tests.items()}
    choices = f": {_each(words)}" if first.choices and len(tests) > 1 else ""
    unit = f" [{first.unit}]" if first.unit else ""
    return f"{what}{those}{choices}{unit}", _each(
        {test: one.default for test, one in tests.items()}
    )


def _each(texts: Mapping[str, str]) -> str:
    """Return the texts of several tests as one text; only once if all texts are equal."""
    found: dict[str, list[str]] = {}
    for test, text in texts.items():
        found.setdefault(text, []).append(test)
    if len(found) == 1:
        return next(iter(found))
    return "; ".join(f"{', '.join(tests)}: {text}" for text, tests in found.items())


@dataclass(frozen=True)
class Asked:
    """Values from which a test determines its own options."""

    test: str
    sizes: Mapping[str, float]  #: of the specimen [m]
    values: Mapping[str, Value]  #: of the options, by name
    diameter: float | None  #: mean of the grains [m]; None for grains that were given

    def number(
        self, name: str, usual: float, bounds: Bounds = ANY, unit: str = "m", why: str = ""
    ) -> float:
        """Return the value of a numeric option, or its default, within its bounds.

        Args:
            name: Name of the option.
            usual: Default.
            bounds: Range.
            unit: Unit.
            why: Reason of the bounds and remedy, for the message.

        Raises:
            InputError: for a value out of range.
        """
        value = self.values.get(name)
        if value is None:
            label, shown = f"run: default {name}", f"{usual:g}"
            return require_number(label, usual, bounds, unit, shown, why)
        return require_number(f"run: {name}", value, bounds, unit, why=why)

    @property
    def grain(self) -> float:
        """Mean diameter of packed grains [m]; 0 for user-supplied grains."""
        return self.diameter or 0.0

    def word(self, name: str, choices: tuple[str, ...]) -> str:
        """Return the value of an option with choices; the first choice by default.

        Raises:
            InputError: for a value that is not among the choices.
        """
        value = self.values.get(name) or choices[0]
        require_one_of(f"run: {name}", value, choices)
        return str(value)


def control_of(*measures: str) -> Option:
    """Return the option for the quantity that grows at the rate; the first is of the ends."""
    return Option(
        "control",
        "Quantity that grows at the loading rate; the loaded part moves back where the specimen "
        "snaps back",
        choices=measures,
        default=measures[0],
        open="displacement of the ends",
    )


#: Name of the radius of the jaws in which a disc is split.
JAW_RADIUS = "jaw_radius"
#: Friction of the ends of a solid.
END_FRICTION = Option(
    "end_friction",
    "Friction coefficient between the platens and a 3D specimen, active during the loading",
    bounds=Bounds(at_least=0.0, at_most=10.0),
    default="0, smooth ends",
    open="0, smooth ends",
    models=BLOCK_MODELS,
)


def end_friction_of(asked: Asked) -> Mapping[str, Value]:
    """Return the friction of the ends; None if it is 0.

    Raises:
        InputError: for a value out of range, or for a 2D specimen.
    """
    name = END_FRICTION.name
    if asked.values.get(name) is None:
        return {}
    friction = asked.number(name, 0.0, END_FRICTION.bounds, "")
    if friction > 0.0 and asked.sizes.keys() == {"width", "height"}:
        raise refused(f"run: {name} = {friction:g}, must not be given for a rectangle", name)
    return {name: friction or None}


#: Checks and completes the values of a test's own options.
Settle = Callable[[Asked], Mapping[str, Value]]
