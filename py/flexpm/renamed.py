# SPDX-License-Identifier: GPL-3.0-or-later
"""Old public names, which work in version 0.3 and are removed in version 0.4.

All tables of names are here. `with_old_names` lets a class have them, each with a FutureWarning at
the line of the caller; `current` and `with_old_keys` translate what files hold.
"""

from __future__ import annotations

import functools
import sys
import warnings
from collections.abc import Callable, Container, Iterable, Mapping
from typing import TypeVar

from .errors import InputError
from .files import Table

#: Methods and attributes of classes.
ATTRIBUTES = {
    "PartRig": {
        "way_of": "displacement_of",
        "contact_of": "contact_angle_of",
        "angle_of": "rotation_of",
        "turn": "rotate",
        "also": "alias_column",
    },
    "RigReadings": {"laid": "layout"},
    "RigPart": {"place": "position"},
    "Specimen": {"joint_bends": "joint_deviations"},
    "Model": {"joint_bend": "joint_deviation"},
    "SolidSpecimen": {"joint_bends": "joint_deviations"},
    "Result": {
        "late_modulus": "tangent_modulus_ratio",
        "joint_bend": "joint_deviation",
        "largest_parting": "largest_separation",
    },
}
_TRANSITS = {"crossings": "transits"}
_RIG = {
    "support": {"place": "position"},
    "jaw": {"place": "position"},
    "elastic": {"way": "displacement"},
    "settle": _TRANSITS,
    "relax": _TRANSITS,
    "dwell": _TRANSITS,
    "unload": _TRANSITS,
    "cycle": {},
    "follow": {},
}
#: Arguments of the methods of classes.
ARGUMENTS: Mapping[str, Mapping[str, Mapping[str, str]]] = {
    "PartRig": _RIG,
    "SolidPartRig": _RIG,
    "EndStatics": {"elastic": {"way": "displacement"}},
    "Result": {"__init__": ATTRIBUTES["Result"]},
}
#: Columns of curve.csv.
COLUMNS = {"crosshead": "crosshead_displacement"}
#: Values of the argument ``by``, of recorded calls and stages, too.
BY = {"way": "displacement"}
#: Keys of each set of traces in ``networks``.
NETWORKS = {"asked": "target", "drawn": "generated"}
#: Keys of each part and each stage in ``inputs`` of result.json.
PARTS = {"place": "position"}
STAGES = {"crossings": "transits"}

Class = TypeVar("Class", bound=type)
Value = TypeVar("Value")


def warn(old: str, new: str) -> None:
    """Warn of an old name, at the innermost line that is not of this package."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and _is_own(frame.f_globals.get("__name__")):
        frame, level = frame.f_back, level + 1
    text = f"{old} is now called {new}; the old name goes with flexpm 0.4"
    warnings.warn(text, FutureWarning, stacklevel=level)


def present(name: str, names: Mapping[str, str], there: Container[str]) -> str:
    """Return the present name of a column or a measure; warn of an old name.

    A name that is there, as of a gauge that a script has called so, stays.
    """
    if not isinstance(name, str) or name in there or names.get(name) not in there:
        return name
    warn(repr(name), repr(names[name]))
    return names[name]


class OldName:
    """An attribute or a method by its old name."""

    def __init__(self, old: str, new: str) -> None:
        """Take both names."""
        self._old, self._new = old, new

    def __get__(self, one: object, owner: type | None = None) -> object:
        """Return the attribute with the new name."""
        if one is None:
            return self
        warn(f"{type(one).__name__}.{self._old}", self._new)
        return getattr(one, self._new)

    def __set__(self, one: object, value: object) -> None:
        """Set the attribute with the new name."""
        warn(f"{type(one).__name__}.{self._old}", self._new)
        setattr(one, self._new, value)


class Renamed(dict[str, Value]):
    """A table that has its values by their old names, too."""

    def __init__(
        self,
        values: Mapping[str, Value] | Iterable[tuple[str, Value]] = (),
        names: Mapping[str, str] | None = None,
    ) -> None:
        """Store values by their new names, and the new name of each old name."""
        super().__init__(values)
        self._names = names or {}

    def get(self, key: str, default: Value | None = None) -> Value | None:  # type: ignore[override]
        """Return a value by either of its names, or the default."""
        try:
            return self[key]
        except KeyError:
            return default

    def __missing__(self, key: str) -> Value:
        new = self._names.get(key)
        if new is None or new not in self:
            raise KeyError(key)
        warn(repr(key), repr(new))
        return self[new]


def with_old_names(owner: Class) -> Class:
    """Let a class have its attributes, and the arguments of its methods, by their old names."""
    for old, new in ATTRIBUTES.get(owner.__name__, {}).items():
        setattr(owner, old, OldName(old, new))
    for name, names in ARGUMENTS.get(owner.__name__, {}).items():
        setattr(owner, name, _by_old(getattr(owner, name), names))
    return owner


def current(content: Table) -> Table:
    """Return the content or inputs of a result.json with present names only."""
    return _translated(content, _to_new)


def with_old_keys(content: Table) -> Table:
    """The content of a result.json with each renamed key under its old name, too."""
    return _translated(content, _to_both)


def current_call(call: Table) -> Table:
    """A recorded call of a rig under the present names."""
    name = str(ATTRIBUTES["PartRig"].get(str(call["call"]), call["call"]))
    return {**call, "call": name, "with": _with_new_by(_to_new(call["with"], _RIG.get(name, {})))}


def current_stage(stage: Table) -> Table:
    """A stage of a rig, as a checkpoint or a result.json has it, under the present names."""
    return _with_new_by(_to_new(stage, STAGES))


def comparable(given: Table) -> Table:
    """Arguments of a call, or a stage, in which a column has its present name.

    Not for more than comparing: a script may have called a gauge by an old name of a column.
    """
    found = {}
    for key, one in given.items():
        found[key] = comparable(one) if isinstance(one, dict) else one
        if isinstance(one, str):
            found[key] = COLUMNS.get(one, one)
    return found


def _by_old(function: Callable[..., object], names: Mapping[str, str]) -> Callable[..., object]:
    """A function that takes its arguments, and the value of ``by``, by their old names, too."""
    label = function.__name__

    @functools.wraps(function)
    def call(*args: object, **given: object) -> object:
        for old, new in names.items():
            if old not in given:
                continue
            if new in given:
                raise InputError(
                    f"{label}: {old}, {new} = both given, must be one of them; {old} is the old "
                    f"name of {new}"
                )
            warn(f"{label}: {old}=", f"{new}=")
            given[new] = given.pop(old)
        by = given.get("by")
        if isinstance(by, str) and by in BY:
            warn(f"{label}: by={by!r}", repr(BY[by]))
        return function(*args, **_with_new_by(given))

    return call


def _is_own(module: object) -> bool:
    return isinstance(module, str) and module.partition(".")[0] == "flexpm"


def _with_new_by(given: Table) -> Table:
    by = given.get("by")
    return {**given, "by": BY[by]} if isinstance(by, str) and by in BY else given


def _to_new(table: Table, names: Mapping[str, str]) -> Table:
    """Rename old keys; an old key is left out if its new key exists."""
    return {
        names.get(key, key): value
        for key, value in table.items()
        if key not in names or names[key] not in table
    }


def _to_both(table: Table, names: Mapping[str, str]) -> Table:
    return {**table, **{old: table[new] for old, new in names.items() if new in table}}


def _translated(content: Table, way: Callable[[Table, Mapping[str, str]], Table]) -> Table:
    """A result's content, its sets of traces, and parts and stages of its inputs, translated."""
    found = way(content, ATTRIBUTES["Result"])
    if isinstance(sets := found.get("networks"), dict):
        found["networks"] = {
            name: way(one, NETWORKS) if isinstance(one, dict) else one for name, one in sets.items()
        }
    if isinstance(inputs := found.get("inputs"), dict):
        for key, names in (("parts", PARTS), ("stages", STAGES)):
            if isinstance(entries := inputs.get(key), list):
                new = [way(one, names) if isinstance(one, dict) else one for one in entries]
                inputs = {**inputs, key: new}
        found["inputs"] = inputs
    return found
