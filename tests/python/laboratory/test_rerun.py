# SPDX-License-Identifier: GPL-3.0-or-later
"""A run from its file: the same numbers, the material again, refusals in one line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from refusals import refusal, refused_command

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.materials.material import load, preset_names
from flexpm.materials.mixing import from_description
from flexpm.models.options import MODELS
from flexpm.runs.asked import read_inputs
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.files import given, specimen_file
from flexpm.specimens.space import file as solid_file
from flexpm.specimens.spec import PACKING_FILE, SpecimenSpec

ROOT = Path(__file__).resolve().parents[3]
MINERALS = ROOT / "scripts" / "tutorials" / "two_minerals.toml"
SMALL = ["--width", "0.012", "--height", "0.024", "--thickness", "0.01", "--quiet"]
#: Ends within a second, without a peak.
SHORT = ["--max-strain", "2e-5"]


@pytest.fixture(scope="module")
def given_specimen():
    """Discs, an outline and minerals as a script has them."""
    packed = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=4)
    made = flexpm.Specimen.from_discs(packed.centres, packed.radii, packed.outline, 0.01)
    return made.with_minerals(np.arange(len(made.discs)) % 2)


@pytest.mark.parametrize("name", [*preset_names(), str(MINERALS)])
def test_a_material_comes_back_from_its_description(name):
    for model in MODELS:
        try:
            told = described(load(name), model)
        except InputError:  # a preset without a set for the model
            continue
        again = from_description(told, model)
        assert described(again, model) == told


def test_brittle_contacts_come_back_from_their_description():
    told = described(load("augig-table2-brittle").with_set(cohesion=31e6), "flexible")
    again = from_description(told, "flexible")
    assert (described(again, "flexible"), again.softening) == (told, "brittle")


def test_a_run_is_repeated_from_its_file_alone(capsys, tmp_path):
    options = ["--diameters", "0.0015,0.0025", "--porosity", "0.12", "--set", "cohesion=29e6"]
    first, second = tmp_path / "first", tmp_path / "second"
    command = ["run", "tension", *SMALL, *SHORT, *options, "--seed", "3", "--out", str(first)]
    assert cli.main(command) == 3
    asked = ["rerun", str(first / "result.json"), "--quiet", "--out", str(second)]
    assert cli.main(asked) == 3
    assert "the same as in" in capsys.readouterr().out
    for name in ("curve.csv", "cracks.csv", "fragments.csv", "final.vtu"):
        assert (first / name).read_bytes() == (second / name).read_bytes(), name
    before, now = (json.loads((one / "result.json").read_text()) for one in (first, second))
    assert now["inputs"] == before["inputs"]


PLANE = SMALL[:-1]
SOLID = ["--shape", "box", "--width", "0.009", "--depth", "0.009", "--height", "0.018"]


@pytest.mark.parametrize(("sizes", "key"), [(PLANE, "discs"), (SOLID, "spheres")])
def test_another_packing_than_before_is_told_in_one_line(capsys, tmp_path, sizes, key):
    def told() -> list[str]:
        capsys.readouterr()
        assert cli.main(["rerun", str(first), "--quiet", "--out", str(tmp_path / "second")]) == 3
        return [line for line in capsys.readouterr().out.splitlines() if line.startswith("packing")]

    first = tmp_path / "first"
    assert cli.main(["run", "tension", *sizes, *SHORT, "--quiet", "--out", str(first)]) == 3
    file = first / PACKING_FILE
    assert told() == []
    content = json.loads(file.read_text())
    del content["format"], content["checksum"]
    grains = len(content[key])
    content[key][3][0] *= 1.0 + 1e-15
    (solid_file if key == "spheres" else specimen_file).write(file, content)
    (line,) = told()
    assert f"packing differs in 1 of {grains} grains from {file}, by up to " in line
    del content[key][3]
    if key == "discs":
        del content["cells"][3]
    (solid_file if key == "spheres" else specimen_file).write(file, content)
    assert told() == [f"packing has {grains} grains, {grains - 1} in {file}"]
    file.write_text(file.read_text().replace("0.0", "0.1"))
    (line,) = told()
    assert line.startswith(f"packing is not compared: specimen = '{file}', was changed")
    file.unlink()
    assert told() == []


def test_other_numbers_are_told_by_their_names(capsys, tmp_path):
    first = tmp_path / "first"
    assert cli.main(["elastic", *SMALL, "--out", str(first)]) == 0
    content = json.loads((first / "result.json").read_text())
    content["poissons_ratio"] *= 1.0 + 1e-15
    (first / "result.json").write_text(json.dumps(content))
    assert cli.main(["rerun", str(first), "--quiet", "--out", str(tmp_path / "second")]) == 0
    assert f"different from {first / 'result.json'}: poissons_ratio" in capsys.readouterr().out


def test_a_run_of_arrays_saves_them_and_is_repeated_from_them(given_specimen, tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    ended = flexpm.run("tension", given_specimen, MINERALS, max_strain=2e-5, out=first)
    assert cli.main(["rerun", str(first), "--quiet", "--out", str(second)]) == 3
    assert (first / "curve.csv").read_bytes() == (second / "curve.csv").read_bytes()
    assert (second / given.FILE).is_file()
    assert flexpm.Result.read(second).inputs == ended.inputs


def test_a_packing_needs_no_file(tmp_path):
    given.save(tmp_path, flexpm.Specimen.rectangle(0.012, 0.024, 0.01))
    assert not list(tmp_path.iterdir())


def test_minerals_of_a_packing_are_kept(tmp_path):
    packed = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    chosen = packed.with_minerals(np.arange(len(packed.discs)) % 2)
    given.save(tmp_path, chosen)
    again = given.load(chosen.spec, tmp_path)
    assert np.array_equal(again.minerals, chosen.minerals)
    assert np.array_equal(again.discs, chosen.discs)


def test_discs_in_a_circle_are_kept(tmp_path):
    packed = flexpm.Specimen.disc(0.016, 0.01)
    made = flexpm.Specimen.from_discs(packed.centres, packed.radii, packed.outline, 0.01)
    given.save(tmp_path, made)
    assert given.load(made.spec, tmp_path).spec == made.spec


@pytest.mark.parametrize("harm", ["gone", "different", "no table", "changed"])
def test_a_specimen_that_is_gone_or_different_is_refused_in_one_line(
    capsys, given_specimen, tmp_path, harm
):
    inputs = RunSpec(
        "tension", given_specimen.spec, described(load(str(MINERALS)), "flexible")
    ).to_json()
    (tmp_path / "result.json").write_text(json.dumps({"inputs": inputs}))
    given.save(tmp_path, given_specimen)
    file = tmp_path / given.FILE
    if harm == "gone":
        file.unlink()
    elif harm == "different":
        given.save(tmp_path, given_specimen.with_minerals([0] * len(given_specimen.discs)))
    elif harm == "no table":
        file.write_text("discs")
    else:
        content = json.loads(file.read_text())
        file.write_text(json.dumps({**content, "minerals": None}))
    refused_command(capsys, str(file), "rerun", tmp_path, "--out", tmp_path / "out")


@pytest.mark.parametrize(
    ("content", "why"),
    [
        ("no table", "is not a JSON table"),
        ("{}", "has no inputs"),
        ('{"inputs": {"test": "uniaxial"}}', "has no inputs"),
        ('{"inputs": {"test": "uniaxial", "material": {}}}', "specimen is missing"),
        ('{"inputs": {"test": "uniaxial", "material": {}, "specimen": 1}}', "must be a table"),
    ],
)
def test_a_file_that_is_no_result_is_refused_in_one_line(capsys, tmp_path, content, why):
    file = tmp_path / "result.json"
    file.write_text(content)
    refused_command(capsys, why, "rerun", file, "--out", tmp_path / "out")


@pytest.mark.parametrize(
    ("key", "value"),
    [("cohesion", "x"), ("cohesoin", 1.0), ("young", [1.0]), ("friction", None), ("name", 3)],
)
def test_a_material_that_cannot_be_read_is_refused(tmp_path, key, value):
    spec = RunSpec("tension", SpecimenSpec(), described(load(), "flexible")).to_json()
    spec["material"][key] = value
    file = tmp_path / "result.json"
    file.write_text(json.dumps({"inputs": spec}))
    refusal(r"result.json", read_inputs, file)


def test_a_result_is_read_with_its_record_cracks_and_inputs(tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    ended = flexpm.run("uniaxial", specimen, rate=16.0, out=tmp_path)
    read = flexpm.Result.read(tmp_path)
    assert read.as_dict() == ended.as_dict()
    assert len(read.cracks) > 0
    assert read.cracks == ended.cracks
    assert np.array_equal(read.curve.array, ended.curve.array, equal_nan=True)
    assert read.warnings == ended.warnings
    assert read.inputs["specimen"]["seed"] == 1


@pytest.mark.parametrize("name", ["result.json", "curve.csv", "cracks.csv"])
def test_a_result_without_a_file_or_with_another_one_is_refused(tmp_path, name):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    flexpm.run("tension", specimen, max_strain=2e-5, out=tmp_path)
    (tmp_path / name).write_text("step,x\n1,a\n")
    refusal(name, flexpm.Result.read, tmp_path)
    (tmp_path / name).unlink()
    refusal(name, flexpm.Result.read, tmp_path)
