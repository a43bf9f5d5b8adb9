# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of a result.json: types, counts, and the values that reports and warnings read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import MISSING, Field
from pathlib import Path

from ..errors import InputError
from ..files import Table

#: Numbers of what is counted, and shares, which are not above 1.
_COUNTS = (
    *("grains", "contacts", "nodes", "triangles", "particles", "inner_contacts", "steps"),
    *("tensile_cracks", "shear_cracks", "fragments", "events"),
)
_SHARES = ("largest_fragment",)
#: Measures that are not below zero.
_NOT_NEGATIVE = (
    *("step_time", "confinement", "unbalanced_ratio", "end_mismatch", "energy_error"),
    *("second_confinement", "first_crack_stress", "first_crack_distance"),
    *("contact_width", "notch_depth", "joint_deviation", "peak_load", "vp", "vs", "b_value_error"),
)
#: File with the numbers of a run that has ended.
FINISHED = "result.json"
#: File with the numbers of a run that has not ended, and its status; a script's own test writes
#: that status into result.json.
SO_FAR, UNFINISHED = "unfinished.json", "unfinished"
STATUSES = ("ok", "no_peak", "not_quasistatic", "diverged", UNFINISHED)
#: What ends a test: the deviator falls to the stop ratio, or is constant; the largest strain; a
#: stage that ends at rest.
ENDS = ("drop", "plateau", "largest_strain", "equilibrium")
_KINDS: dict[str, tuple[type, ...]] = {
    "int": (int,),
    "float": (int, float),
    "str": (str,),
    "Table": (dict,),
    "list[Table]": (list,),
}


def require_sense(file: Path, content: Table, known: Iterable[Field[object]]) -> None:
    """Check the content of a result.json.

    Args:
        file: Named in messages.
        content: Content of the file.
        known: Fields of a result.

    Raises:
        InputError: for a value that is missing, of another type, or out of its range.
    """
    name, fields = f"result = {str(file)!r}", [*known]
    missing = [one.name for one in fields if _is_required(one) and one.name not in content]
    if missing:
        raise InputError(f"{name}, has no {', '.join(missing)}; give result.json of a test")
    for one in fields:
        value = content.get(one.name)
        if one.name in content and not (_fits(one, value) and _is_in_range(one.name, value)):
            raise InputError(
                f"{name}, has {one.name} = {str(value)[:80]}; give result.json of a test"
            )
    for what in _wrong(content):
        raise InputError(f"{name}, has {what} that no run has; give result.json of a test")


def _wrong(content: Table) -> Iterator[str]:
    """Names of tables that are none of a run."""
    inputs = content.get("inputs")
    if not _is_material(content["material"]):
        yield "a material"
    if inputs is None:
        return
    if not (_is_number(inputs.get("rate")) and isinstance(inputs.get("specimen"), Mapping)):
        yield "inputs"
    if not _is_material(inputs.get("material")):
        yield "inputs"


def _is_material(value: object) -> bool:
    """Whether a value is a table with a name, and lists of such tables for minerals and joints."""
    if not isinstance(value, Mapping) or not isinstance(value.get("name"), str):
        return False
    parts = [value.get(key, []) for key in ("minerals", "joints")]
    return all(
        isinstance(part, list)
        and all(isinstance(one, Mapping) and isinstance(one.get("name"), str) for one in part)
        for part in parts
    )


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_in_range(name: str, value: object) -> bool:
    if name == "status":
        return value in STATUSES
    if name == "ended_by":
        return value in (*ENDS, None)
    if not isinstance(value, int | float):
        return True
    if name in _SHARES:
        return 0.0 <= value <= 1.0 + 1e-9
    return value >= 0 or name not in (*_COUNTS, *_NOT_NEGATIVE)


def _fits(one: Field[object], value: object) -> bool:
    """Whether a value of result.json is of the type that the field is said to have."""
    named = str(one.type).split(" | ")
    if value is None or isinstance(value, bool):
        return value is None and "None" in named
    return any(isinstance(value, _KINDS.get(name, ())) for name in named)


def _is_required(one: Field[object]) -> bool:
    return one.default is MISSING and one.default_factory is MISSING
