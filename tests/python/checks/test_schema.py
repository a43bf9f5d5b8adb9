# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON schema of results has every field, takes what runs write, and nothing else."""

from __future__ import annotations

import copy
import dataclasses
import json
from pathlib import Path

import pytest

import flexpm
from flexpm.materials.keys import JOINT_UNITS, UNITS
from flexpm.models.options import MESHES, MODELS, POINTS
from flexpm.results.result import Result
from flexpm.runs.input_names import OWN_OPTIONS, STARTS
from flexpm.runs.run_spec import ELASTIC, TESTS, RunSpec
from flexpm.specimens.spec import SIZES, SpecimenSpec

ROOT = Path(__file__).resolve().parents[3]
SCHEMA = json.loads((ROOT / "doc" / "schema" / "result.schema.json").read_text(encoding="utf-8"))
MINERALS = ROOT / "scripts" / "tutorials" / "two_minerals.toml"


@pytest.fixture(scope="module")
def validator():
    jsonschema = pytest.importorskip("jsonschema", reason="needs python3-jsonschema")
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    return jsonschema.Draft202012Validator(SCHEMA)


def names(cls: type) -> set[str]:
    return {field.name for field in dataclasses.fields(cls)}


def test_the_schema_has_every_field():
    parts = SCHEMA["$defs"]
    result = Result("", "", "", "", {}, 1, 1, 1, 1, 1)
    assert set(SCHEMA["properties"]) == set(result.as_dict())
    assert set(SCHEMA["required"]) == set(result.as_dict())
    # options that are no fields stand beside those that are
    assert set(parts["run_spec"]["properties"]) == (names(RunSpec) - {"own"}) | {*OWN_OPTIONS}
    assert set(parts["specimen"]["properties"]) == names(SpecimenSpec)
    assert set(UNITS) < set(parts["material"]["properties"])
    assert set(JOINT_UNITS) | {"name"} == set(parts["joint"]["properties"])


def test_the_schema_has_every_word():
    parts = SCHEMA["$defs"]
    run = parts["run_spec"]["properties"]
    assert run["test"]["enum"] == [*TESTS, ELASTIC]
    assert run["model"]["enum"] == list(MODELS)
    assert set(run["mesh"]["enum"]) == set(MESHES)
    assert run["points"]["enum"] == list(POINTS)
    assert run["start"]["enum"] == ["", *STARTS]
    assert parts["specimen"]["properties"]["kind"]["enum"] == list(SIZES)


@pytest.mark.parametrize("model", ["flexible", "jcfpm"])
@pytest.mark.parametrize("given", [False, True])
def test_what_a_run_writes_is_valid(validator, tmp_path, model, given):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    material = MINERALS if model == "flexible" else None
    if given:
        centres, radii, outline = specimen.centres, specimen.radii, specimen.outline
        specimen = flexpm.Specimen.from_discs(centres, radii, outline, 0.01)
    flexpm.run("tension", specimen, material, model=model, max_strain=2e-5, out=tmp_path)
    content = json.loads((tmp_path / "result.json").read_text())
    assert list(validator.iter_errors(content)) == []


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("peak_stress",), "12 MPa"),
        (("status",), "fine"),
        (("inputs", "rat"), 1.0),
        (("inputs", "model"), "soft"),
        (("inputs", "specimen", "diameters"), [1e-3]),
        (("inputs", "material", "cohesion"), "3e7"),
        (("grains",), None),
    ],
)
def test_what_no_run_writes_is_invalid(validator, tmp_path, path, value):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    flexpm.run("tension", specimen, max_strain=2e-5, out=tmp_path)
    content = json.loads((tmp_path / "result.json").read_text())
    assert list(validator.iter_errors(content)) == []
    changed = copy.deepcopy(content)
    place = changed
    for name in path[:-1]:
        place = place[name]
    place[path[-1]] = value
    assert list(validator.iter_errors(changed))
