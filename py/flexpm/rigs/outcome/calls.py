# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls of a script to its rig, as plain values: compared, stored and repeated.

Each public method of a rig that is recorded is a call: a part, a gauge, a stage. Its arguments are
stored under their names. A new method is recorded without further code if its arguments are
numbers, texts, truth values, arrays, lists, tables, parts of the rig or a `Loading`.
"""

from __future__ import annotations

import functools
import inspect
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from typing import Protocol, TypeVar

import numpy as np

from ...arrays import IntArray
from ...errors import InputError, SimulationError
from ...files import Table
from ...renamed import comparable, current_call
from ...require import quoted
from ...runs.loading_rate import Loading
from ...runs.runner import Runner
from ..parts import HeldNodes, RigPart

#: Public methods that only read, or that make no test of their own.
_READERS = (
    *("start", "scales", "balance", "unbalanced", "reading", "save", "finish", "to_yade_plot"),
)
#: Folder of what finds static solutions, which change no scene.
_STATICS = ".statics."
#: What marks a value that is more than a number, a text or a list.
_PART, _LOADING, _PAIRS, _NODES, _OTHER = "part", "loading", "pairs", "nodes", "unknown"
#: Errors that a script may catch to go on; they come again when its call is passed.
_CAUGHT = (InputError, SimulationError)
_ERRORS = {error.__name__: error for error in _CAUGHT}

Kind = TypeVar("Kind", bound=type)


class Keeper(Protocol):
    """Interface of a folder that records the calls and steps of a rig."""

    calls: Calls

    @property
    def has_frames(self) -> bool:
        """Whether each step is to be looked at."""

    def look(self) -> None:
        """See a step."""

    def draw(self) -> None:
        """Make pictures and report."""

    def before(self, name: str) -> None:
        """A call begins."""

    def after(self, name: str, error: BaseException | None) -> None:
        """A call has ended, or was broken off by an error."""


class Calls:
    """Calls of one test in their order, compared with the calls of an earlier start.

    Attributes:
        made: Calls of this start: the name as ``call``, the arguments, whether it is ``over``, and
            the error that it ``raised``: class, text, and the number of stages begun by then.
    """

    def __init__(
        self, folder: str, runner: Runner, earlier: Sequence[Table] = (), *, passes: bool = False
    ) -> None:
        """Take the calls of an earlier start.

        Args:
            folder: Folder, named in messages.
            runner: Counts the stages of the calls.
            earlier: Calls of the earlier start, which this start must repeat.
            passes: Whether the scene has the outcome of all finished calls.
        """
        self._folder, self._runner = folder, runner
        self._earlier, self._passes = [current_call(one) for one in earlier], passes
        self.made: list[Table] = []
        self.inside = False

    @property
    def storable(self) -> bool:
        """Whether all arguments are plain."""
        return not _has_other([call["with"] for call in self.made])

    @property
    def missing(self) -> int:
        """Number of calls of the earlier start that this start has not repeated yet."""
        return max(len(self._earlier) - len(self.made), 0)

    @contextmanager
    def of(self, name: str, given: Mapping[str, object]) -> Iterator[Table]:
        """Record a call around its execution.

        Raises:
            InputError: if the earlier start has another call there; or the error of that call, if
                it is over.
        """
        call: Table = {"call": name, "with": {key: plain(one) for key, one in given.items()}}
        there = self._at(len(self.made))
        if there is not None:
            self._require_same(there, call)
            if self._passes and there.get("raised"):
                self.made.append(there)
                kind, text, self._runner.stages = there["raised"]
                raise _ERRORS.get(kind, SimulationError)(text)
        self.made.append(call)
        self.inside = True
        try:
            yield call
        except _CAUGHT as error:
            call["over"] = True
            call["raised"] = [type(error).__name__, str(error), self._runner.stages]
            raise
        finally:
            self.inside = False
        call["over"] = True

    def _at(self, number: int) -> Table | None:
        return self._earlier[number] if number < len(self._earlier) else None

    def _require_same(self, there: Table, call: Table) -> None:
        if _asked(there) != _asked(call):
            raise InputError(
                f"out = {self._folder!r}, has another test: call {len(self.made) + 1} = "
                f"{_text(there)} there, {_text(call)} here; make the same calls or choose another "
                "folder"
            )


def recording(rig: Kind) -> Kind:
    """Make a rig with a folder record its calls; a decorator of its class."""
    names = {
        name: function
        for base in reversed(rig.__mro__)
        for name, function in vars(base).items()
        if inspect.isfunction(function) and not name.startswith("_") and name not in _READERS
        if _STATICS not in function.__module__
    }
    for name, function in names.items():
        setattr(rig, name, _recorded(name, function))
    return rig


def _recorded(name: str, function: Callable[..., object]) -> Callable[..., object]:
    signature = inspect.signature(function)

    @functools.wraps(function)
    def call(rig: object, *args: object, **named: object) -> object:
        kept: Keeper | None = getattr(rig, "kept", None)
        if kept is None or kept.calls.inside:
            return function(rig, *args, **named)
        given = dict(signature.bind(rig, *args, **named).arguments)
        del given[next(iter(given))]
        kept.before(name)
        try:
            with kept.calls.of(name, given) as noted:
                result = function(rig, *args, **named)
                if isinstance(result, HeldNodes):  # what a function has chosen
                    for key, one in given.items():
                        if callable(one):
                            noted["with"][key] = {_NODES: result.nodes}
            kept.after(name, None)
            return result
        except BaseException as error:
            kept.after(name, error)
            raise

    return call


def plain(value: object) -> object:
    """A value as JSON has it."""
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float) and np.isfinite(value):
        return value
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, tuple | list):
        return [plain(one) for one in value]
    if isinstance(value, RigPart):
        return {_PART: ["held nodes" if isinstance(value, HeldNodes) else "plate", value.number]}
    if isinstance(value, Loading):
        return {_LOADING: {key: plain(one) for key, one in asdict(value).items()}}
    if isinstance(value, Mapping):
        return {_PAIRS: [[plain(key), plain(one)] for key, one in value.items()]}
    return {_OTHER: quoted(value)}


def _has_other(value: object) -> bool:
    if isinstance(value, Mapping):
        return _OTHER in value or any(map(_has_other, value.values()))
    return isinstance(value, list) and any(map(_has_other, value))


def _asked(call: Table) -> Table:
    """Return the arguments of a call; the choice of a function is known only by its nodes."""
    chosen = [
        key
        for key, one in call["with"].items()
        if isinstance(one, Mapping) and {_NODES, _OTHER} & one.keys()
    ]
    given = comparable({**call["with"], **dict.fromkeys(chosen)})
    return {"call": call["call"], "with": given}


def _text(call: Table) -> str:
    given = ", ".join(f"{key}={quoted(one)}" for key, one in call["with"].items())
    return f"{call['call']}({given})"


class Again:
    """Makes stored calls again on a rig."""

    def __init__(self, rig: object, places: Callable[[], IntArray]) -> None:
        """Prepare the calls for a rig.

        Args:
            rig: The rig in its state before the first call.
            places: Returns the nodes in the order in which a function that chooses nodes receives
                them.
        """
        self._rig, self._places = rig, places
        self._parts: dict[tuple[str, int], RigPart] = {}

    def make(self, call: Table) -> None:
        """Repeat a call; if the first call raised an error, the error is raised and caught again.

        Raises:
            InputError: for a name that is not a call of this rig.
        """
        call = current_call(call)
        function = getattr(type(self._rig), str(call["call"]), None)
        if function is None or not hasattr(function, "__wrapped__"):
            raise InputError(
                f"rerun: call = {quoted(call['call'])}, must be a call of the rig; use the version "
                "of flexpm that wrote the result"
            )
        given = {key: self._real(one) for key, one in call["with"].items()}
        raised = (call.get("raised") or [""])[0]
        try:
            with warnings.catch_warnings():  # the test may have been made with old names
                warnings.simplefilter("ignore", FutureWarning)
                result = function(self._rig, **given)
        except _CAUGHT as error:
            if type(error).__name__ != raised:
                raise
            return
        if isinstance(result, RigPart):
            ((name, number),) = plain(result).values()  # type: ignore[attr-defined]
            self._parts[name, number] = result

    def _real(self, value: object) -> object:
        if isinstance(value, list):
            return [self._real(one) for one in value]
        if not isinstance(value, Mapping):
            return value
        ((kind, of),) = value.items()
        if kind == _PART:
            return self._parts[of[0], of[1]]
        if kind == _LOADING:
            return Loading(**of)
        if kind == _PAIRS:
            return {self._real(key): self._real(one) for key, one in of}
        chosen = np.isin(self._places(), of)
        return lambda x, y: chosen
