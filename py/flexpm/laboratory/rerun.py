# SPDX-License-Identifier: GPL-3.0-or-later
"""What determined a run, from its file result.json. SI units.

Nothing heavy is loaded here, so that the file is checked before YADE starts.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..errors import InputError
from ..files import Table, load_json
from ..materials.material import Material
from ..materials.mixing import from_description
from .run_spec import RunSpec, described

#: Entries of result.json that depend on the machine or the version.
_SURROUNDINGS = ("flexpm", "yade", "step_time", "warnings", "inputs")


def read_inputs(file: Path) -> tuple[RunSpec, Material]:
    """The run that has left `file`, its result.json.

    Raises:
        InputError: if it cannot be read, or is no such file.
    """
    inputs = load_json(file, "result").get("inputs")
    if not isinstance(inputs, Mapping) or not isinstance(inputs.get("material"), Mapping):
        raise InputError(
            f"result = {str(file)!r}, has no inputs of a run; give a result.json of flexpm"
        )
    try:
        spec = RunSpec.from_json(dict(inputs))
        material = from_description(spec.material, spec.model)
        found = described(material, spec.model)
    except (TypeError, ValueError) as error:  # also an InputError
        raise InputError(f"result = {str(file)!r}: {error}") from None
    if found != spec.material:
        name = next(key for key in {**found, **spec.material} if _differ(found, spec.material, key))
        raise InputError(
            f"result = {str(file)!r}, has material {name} = {str(spec.material.get(name))[:80]}, "
            "which this version cannot take from a result; give the material's own file to flexpm "
            "run"
        )
    return spec, material


def differences(before: Table, now: Table) -> list[str]:
    """Names of the results in which two runs of the same inputs differ.

    Args:
        before: Content of a result.json.
        now: Of the other one.
    """
    return [
        name
        for name in {**before, **now}
        if name not in _SURROUNDINGS and _differ(before, now, name)
    ]


def _differ(first: Mapping[str, object], second: Mapping[str, object], name: str) -> bool:
    return (name in first) != (name in second) or first.get(name) != second.get(name)
