# SPDX-License-Identifier: GPL-3.0-or-later
"""Requested inputs of a run, from its result.json: with units and sources, and as a command.

No heavy library is imported before a report is written, so that a file is checked before YADE
starts.
"""

from __future__ import annotations

import contextlib
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeGuard

from ..dimensions import is_solid
from ..errors import InputError
from ..files import Table, load_json
from ..kinds.registry import options
from ..materials.keys import JOINT_UNITS, UNITS
from ..materials.material import Material, load, preset_names
from ..materials.mixing import from_description
from ..renamed import current
from ..results.result_checks import FINISHED, SO_FAR
from ..specimens.space.any_spec import SIZES, AnySpec, field_names, spec_of
from ..specimens.spec import GRAINS_FILE
from .groups import DECLARED
from .input_names import INPUT_UNITS, unused
from .run_inputs import RunInputs
from .run_spec import LABELS, RunSpec, described, law_of

if TYPE_CHECKING:
    from ..results.result import Result

#: Inputs that follow from test, model and material unless they are given.
_FOLLOWING = ("start", "loading", "damping")
_NESTED = ("specimen", "material", "own")
#: What repeats a test that says all of itself.
_AGAIN = ("From its result file:", "flexpm rerun result.json")
#: What stands for None: an input that the loading finds, and the first kind of control.
_OPEN = {
    **{name: one.open for name, one in DECLARED.items() if one.open},
    **{name: one.open for name, of in options().items() for one in of.values() if one.open},
}
#: Entries of result.json that depend on the machine or the version.
_SURROUNDINGS = ("flexpm", "yade", "step_time", "warnings", "inputs")


def read_inputs(file: Path) -> tuple[RunSpec, Material]:
    """The run that has left `file`, its result.json.

    Raises:
        InputError: if it cannot be read, or is no such file.
    """
    inputs = load_json(file, "result").get("inputs")
    if is_own(inputs):
        why = f", {inputs['reason']}" if inputs.get("reason") else ""
        raise InputError(
            f"result = {str(file)!r}, is of a custom test (repeatable = false{why}), must be of a "
            "run; start its script again"
        )
    if not isinstance(inputs, Mapping) or not isinstance(inputs.get("material"), Mapping):
        raise InputError(
            f"result = {str(file)!r}, has no inputs of a run; give a result.json of flexpm"
        )
    with _refusing(file):
        spec = RunSpec.from_json(dict(inputs))
    return spec, _material_of(file, spec)


def read_own(file: Path) -> tuple[RunInputs, Material, list[Table]] | None:
    """Return the first inputs of a custom test and its calls; None for a run; as `read_inputs`.

    Raises:
        InputError: if it cannot be read.
    """
    inputs = load_json(file, "result").get("inputs")
    if not is_repeatable(inputs):
        return None
    with _refusing(file):
        spec = _own_inputs(inputs)
        return spec, _material_of(file, spec), [dict(call) for call in inputs["calls"]]


def _material_of(file: Path, spec: RunInputs) -> Material:
    """The material of a test, from its description."""
    with _refusing(file):
        material = from_description(spec.material, spec.model)
        found = described(material, spec.model)
    if found != spec.material:
        name = next(key for key in {**found, **spec.material} if _differ(found, spec.material, key))
        raise InputError(
            f"result = {str(file)!r}, has material {name} = {str(spec.material.get(name))[:80]}, "
            "which this version cannot read from a result; give the file of the material to "
            "flexpm run"
        )
    return material


def is_repeatable(inputs: object) -> TypeGuard[Table]:
    """Whether inputs belong to a custom test that has stored all of its calls."""
    return isinstance(inputs, Mapping) and inputs.get("repeatable") is True


def _own_inputs(inputs: Table) -> RunInputs:
    """Specimen, material and model of a script's own test."""
    names = {field.name for field in fields(RunInputs)}
    plain = {name: value for name, value in inputs.items() if name in names}
    known = field_names(plain["specimen"]["kind"])
    specimen = {key: value for key, value in plain["specimen"].items() if key in known}
    return RunInputs(**{**plain, "specimen": spec_of(specimen)})


@contextlib.contextmanager
def _refusing(file: Path) -> Iterator[None]:
    """Name the file whose inputs do not belong to a run."""
    try:
        yield
    except (TypeError, ValueError) as error:  # also an InputError
        raise InputError(f"result = {str(file)!r}: {error}") from None
    except (AttributeError, LookupError):
        raise InputError(
            f"result = {str(file)!r}, has inputs that no run has; give a result.json of flexpm"
        ) from None


def differences(before: Table, now: Table) -> list[str]:
    """Return the names of the results in which two runs of the same inputs differ.

    Args:
        before: Content of a result.json.
        now: Content of the second file.
    """
    before, now = _without_times(current(before)), _without_times(current(now))
    return [
        name
        for name in {**before, **now}
        if name not in _SURROUNDINGS and _differ(before, now, name)
    ]


def _without_times(content: Table) -> Table:
    """Return the content of a result.json without the wall times of its loadings."""
    if not content.get("rates"):
        return content
    rates = [{k: v for k, v in one.items() if k != "seconds"} for one in content["rates"]]
    return {**content, "rates": rates}


def _differ(first: Mapping[str, object], second: Mapping[str, object], name: str) -> bool:
    return (name in first) != (name in second) or first.get(name) != second.get(name)


def write_report(folder: Path, result: Result) -> Path:
    """Write report.html of a run into its folder, from its result and its specimen.vtu."""
    from ..report.pages.page_run import write_page

    if is_own(result.inputs):
        return _write_own(folder, result)
    ended = (folder / FINISHED).is_file()
    with _refusing(folder / (FINISHED if ended else SO_FAR)):
        spec = RunSpec.from_json(result.inputs or {})
    commands = [_AGAIN] if ended else []
    if line := command(spec):
        commands.append(("Or with all inputs on the command line:", line))
    return write_page(folder, result, told(spec), commands)


def is_own(inputs: object) -> TypeGuard[Table]:
    """Whether inputs of a result.json belong to a custom test."""
    return isinstance(inputs, Mapping) and "repeatable" in inputs


def _write_own(folder: Path, result: Result) -> Path:
    """The page of a script's own test."""
    from ..report.pages.page_run import write_own_page

    content = result.inputs or {}
    with _refusing(folder / "result.json"):
        inputs = _told_own(content)
    again = [_AGAIN] if is_repeatable(content) else []
    return write_own_page(folder, result, inputs, again)


def _told_own(content: Table) -> list[Input]:
    """Specimen, material and model of a script's own test."""
    spec = _own_inputs(content)
    shown = ("model", "points", "mesh", "dynamic", "gravity", "damping")
    values = [(name, getattr(spec, name)) for name in shown]
    return [
        *(Input(name, value, INPUT_UNITS.get(name, ""), "given") for name, value in values),
        *_of_specimen(spec.specimen),
        *_of_material(spec),
    ]


class Input(NamedTuple):
    """One input of a run."""

    name: str
    value: object
    unit: str  #: empty if it has none
    source: str  #: where the value comes from


def told_of(inputs: Table) -> list[Input]:
    """Return inputs of a result.json, of a run or of a custom test, with units and sources."""
    return _told_own(inputs) if is_own(inputs) else told(RunSpec.from_json(inputs))


def told(spec: RunSpec) -> list[Input]:
    """All inputs of a run in order: test and model, specimen, material, loading."""
    test, *others = _of_test(spec)
    return [test, *_of_specimen(spec.specimen), *_of_material(spec), *others]


def command(spec: RunSpec) -> str:
    """Return the command for a run, or an empty text if no options describe it."""
    preset = spec.material.get("name")
    if preset not in preset_names() or {"minerals", "joints"} & spec.material.keys():
        return ""
    words = ["flexpm", spec.test] if spec.kind.is_solve else ["flexpm", "run", spec.test]
    changes = [one for one in _changes(spec) if not _follows(spec, one[0])]
    if spec.is_solid:
        words += ["--shape", spec.specimen.kind]
    if spec.specimen.is_packed:
        renamed = {one.size: one.name for one in spec.kind.options if one.size}
        sizes = [(renamed.get(name, name), value) for name, value in _changes(spec.specimen)]
        changes = [*sizes, *changes]
    else:
        words += ["--specimen", GRAINS_FILE]
    for name, value in changes:
        if name == "short_edge":
            return ""
        words.append(f"--{name.replace('_', '-')}")
        if value is not True:
            words.append(_text(value))
    words += _material_options(spec, str(preset))
    return shlex.join(words)


def _material_options(spec: RunSpec, preset: str) -> Iterator[str]:
    usual = described(load(None, spec.model, solid=spec.is_solid), spec.model)
    base = described(load(preset, spec.model), spec.model)
    if usual["name"] != preset:
        yield from ("--material", preset)
    for key, value in law_of(spec.material).items():
        if base.get(key) != value:
            yield from ("--set", f"{key}={_text(value)}")


def _of_specimen(spec: AnySpec) -> Iterator[Input]:
    usual: Table = {field.name: field.default for field in fields(spec)} | SIZES[spec.kind]
    for name, default in usual.items():
        value = getattr(spec, name)
        if value is None:
            continue
        if name == "networks":
            yield from _of_networks(value)
            continue
        source = "default" if value == default else "given"
        if name in ("discs", "outline", "cells", "minerals", "joints", "strengths"):
            source = f"checksum of the content of {GRAINS_FILE}"
        elif name == "kind":
            source = "given" if is_solid(value) else "by the test"
        label = "shape" if name == "kind" else name
        yield Input(label, value, INPUT_UNITS.get(name, ""), source)


def _of_networks(networks: Sequence[Table]) -> Iterator[Input]:
    for network in networks:
        yield Input("network_seed", network["seed"], "", "given")
        for name, one in network["set"].items():
            if "kind" in one:
                yield from _of_solid_set(name, one)
                continue
            for key in ("length", "orientation"):
                yield Input(f"{name}: {key}", _law_text(one[key]), "", "given")
            yield Input(f"{name}: intensity P21", one["intensity"], "1/m", "given")


def _of_solid_set(name: str, one: Table) -> Iterator[Input]:
    """A set of discs or planes in 3D."""
    units = {"intensity": "1/m", "dip": "degree", "dip_direction": "degree"}
    for key, value in one.items():
        label = f"{name}: {key.replace('_', ' ')}"
        if key == "intensity":
            label += " P32"
        text = _law_text(value) if isinstance(value, dict) else value
        unit = "m" if key in ("spacing", "origin") else units.get(key, "")
        yield Input(label, text, unit, "given")


def _law_text(law: Table) -> str:
    """A law of a network and its numbers in a line."""
    name, *others = (f"{key.replace('_', ' ')} {value}" for key, value in law.items())
    return ", ".join((name.removeprefix("law "), *others))


def _of_material(spec: RunInputs) -> Iterator[Input]:
    name = str(spec.material.get("name"))
    known = name in preset_names()
    preset = described(load(name, spec.model), spec.model) if known else {}
    yield Input("material", name, "", "preset" if known else "given")
    yield from _of_law("", spec.material, preset, f"preset {name}" if known else f"material {name}")
    for kind in spec.material.get("minerals", ()):
        yield from _of_law(f"{kind['name']}: ", kind, {}, f"material {name}")
    for pair in spec.material.get("interfaces", ()):
        yield from _of_law(f"{'/'.join(pair['pair'])}: ", pair, {}, f"material {name}")
    for joint in spec.material.get("joints", ()):
        yield from _of_law(f"joint {joint['name']}: ", joint, {}, f"material {name}")


def _of_law(where: str, law: Table, preset: Table, source: str) -> Iterator[Input]:
    for key, value in law.items():
        if key in (*LABELS, "pair", "minerals", "interfaces", "joints") or value is None:
            continue
        changed = bool(preset) and preset.get(key) != value
        unit = (UNITS.get(key) or JOINT_UNITS.get(key) or "").removeprefix("-")
        yield Input(where + key, value, unit, "given" if changed else source)


def _of_test(spec: RunSpec) -> Iterator[Input]:
    unknown = unused(spec.test, spec.specimen.kind)
    for field in fields(spec):
        if field.name in (*_NESTED, *unknown):
            continue
        value = getattr(spec, field.name)
        if _follows(spec, field.name):
            source = "default of the test"
        else:
            source = "default" if value == field.default else "given"
        if field.name == "damping":
            value = spec.local_damping
        shown = _OPEN.get(field.name, "-") if value is None else value
        yield Input(field.name, shown, INPUT_UNITS.get(field.name, ""), source)
    for name, own in spec.own.items():
        yield Input(name, own, INPUT_UNITS.get(name, ""), "given")


def _follows(spec: RunSpec, name: str) -> bool:
    """Whether an input has the value that follows from test, model and material."""
    if name not in _FOLLOWING:
        return False
    plain = replace(spec, start="", loading="", damping=None)
    return bool(getattr(plain, name) == getattr(spec, name))


def _changes(spec: RunSpec | AnySpec) -> Iterator[tuple[str, object]]:
    sizes = {} if isinstance(spec, RunSpec) else SIZES[spec.kind]
    for field in fields(spec):
        value = getattr(spec, field.name)
        default = sizes.get(field.name, field.default)
        if field.name not in (*_NESTED, "test", "kind") and value not in (None, default):
            yield field.name, value
    if isinstance(spec, RunSpec):
        yield from spec.own.items()


def _text(value: object) -> str:
    return ",".join(map(str, value)) if isinstance(value, list | tuple) else str(value)
