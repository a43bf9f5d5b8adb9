# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON schema of results has every field, takes what runs write, and nothing else."""

from __future__ import annotations

import copy
import json
from pathlib import Path

import pytest
import result_schema_file

import flexpm
from flexpm.renamed import with_old_keys
from flexpm.results.result import OF_SOLIDS, Result

ROOT = Path(__file__).resolve().parents[3]
MINERALS = ROOT / "scripts" / "tutorials" / "two_minerals.toml"


@pytest.fixture(scope="module")
def validator():
    return result_schema_file.validator()


def test_a_result_of_the_plane_has_the_keys_that_are_asked_for():
    result = Result("", "", "", "", {}, 1, 1, 1, 1, 1)
    schema = result_schema_file.schema()
    assert set(schema["required"]) == set(with_old_keys(result.as_dict()))
    assert set(schema["properties"]) == set(with_old_keys(result.as_dict())) | set(OF_SOLIDS)


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


def test_what_a_solid_writes_is_valid(validator, tmp_path):
    solid = flexpm.Specimen.box(0.009, 0.009, 0.012)
    flexpm.run("tension", solid, MINERALS, max_strain=2e-5, out=tmp_path)
    content = json.loads((tmp_path / "result.json").read_text())
    assert list(validator.iter_errors(content)) == []


def test_what_a_solid_with_a_network_writes_is_valid(validator, tmp_path):
    """One set has no target, and one plane, whose concentration is unknown."""
    radius = {"law": "constant", "value": 0.004}
    orientation = {"law": "constant", "dip": 40, "dip_direction": 100}
    discs = {"kind": "discs", "number": 6, "radius": radius, "orientation": orientation}
    plane = {"kind": "planes", "dip": 5, "dip_direction": 0, "spacing": 0.02}
    sets = {"a": discs, "b": {**plane, "origin": [0.0, 0.0, 0.006]}}
    cut = flexpm.Specimen.box(0.009, 0.009, 0.012).with_network({"seed": 3, "set": sets})
    law = {"normal_stiffness": 1e13, "shear_stiffness": 5e12, "friction": 0.5, "cohesion": 1e7}
    rock = flexpm.materials.load("augig3d-calibrated", solid=True)
    rock = rock.with_set({f"joint.{name}.{key}": law[key] for name in sets for key in law})
    flexpm.run("tension", cut, rock, max_strain=2e-6, out=tmp_path)
    content = json.loads((tmp_path / "result.json").read_text())
    assert list(validator.iter_errors(content)) == []
    assert content["networks"]["b"]["concentration"] is None
    content["networks"]["b"]["p10_x"] = "many"
    assert list(validator.iter_errors(content))
