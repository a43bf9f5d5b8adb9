# SPDX-License-Identifier: GPL-3.0-or-later
"""All tests by name; each file of the folder tests defines a test."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterator

from . import tests
from .option import Option
from .test_kind import Rig, TestKind


def _found() -> Iterator[TestKind]:
    for module in pkgutil.iter_modules(tests.__path__):
        kind = vars(importlib.import_module(f"{tests.__name__}.{module.name}"))["KIND"]
        assert isinstance(kind, TestKind) and kind.name == module.name
        yield kind


_ALL = {kind.name: kind for kind in sorted(_found(), key=lambda kind: kind.order)}
#: A script's own test, which the command does not run.
OWN = _ALL.pop("own")
#: All that the command runs by their names, the direct solve last.
KINDS = {**_ALL}
#: Tests that are simulated.
TESTS = tuple(name for name, kind in KINDS.items() if not kind.is_solve)
#: The direct solve of a rectangle, which is no simulation.
ELASTIC = next(name for name, kind in KINDS.items() if kind.is_solve)


def kind_of(test: str) -> TestKind:
    """Return the test with a name; for any other name the custom test."""
    return KINDS.get(test, OWN)


def names(which: Callable[[TestKind], bool]) -> tuple[str, ...]:
    """Return the names of the tests that satisfy a condition."""
    return tuple(name for name, kind in KINDS.items() if which(kind))


def of_ends(shape: str, *, pulls: bool = False, confined: bool = False) -> str:
    """Return the name of the test between the ends of a specimen."""

    def fits(kind: TestKind) -> bool:
        # a disc has one test, whatever presses on it
        same = shape in ("disc", "solid-disc") or (kind.pulls, kind.confined) == (pulls, confined)
        return kind.rig is Rig.ENDS and shape in kind.variants and same

    return names(fits)[0]


def options() -> dict[str, dict[str, Option]]:
    """Return the options that not all tests have: by name, then by test."""
    found: dict[str, dict[str, Option]] = {}
    for name, kind in KINDS.items():
        for option in kind.options:
            found.setdefault(option.name, {})[name] = option
    return found
