# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of users with anything anywhere: read, or refused by InputError before the first run."""

from __future__ import annotations

import copy
import datetime
import math
from pathlib import Path

import numpy as np
import pytest
import tomli_w
from fuzz_child import drawing
from hypothesis import example, given
from hypothesis import strategies as st
from refusals import refused_command

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.files import json_text, load_toml
from flexpm.joints import lines as joint_lines
from flexpm.materials import material as materials
from flexpm.materials.mixing import description
from flexpm.runs import asked
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.spec import SpecimenSpec
from flexpm.studies import calibration_problem, study

MATERIAL = {
    "name": "a rock",
    "tensile_strength": 8e6,
    "cohesion": 3e7,
    "friction": 0.4,
    "softening": "brittle",
    "elastic": {
        "flexible": {"normal_stiffness": 1e14, "shear_ratio": 0.3, "young": 2e10, "poisson": 0.2}
    },
    "joint": {"saw": {"normal_stiffness": 1e13, "shear_stiffness": 1e12, "friction": 0.6}},
    "mineral": [
        {"name": "hard", "fraction": 0.5},
        {"name": "soft", "fraction": 0.5, "elastic": {"flexible": {"young": 1e10}}},
    ],
    "interface": [
        {"pair": ["hard", "soft"], "cohesion": 2e7, "factor": {"tensile_strength": 0.5}},
        {"pair": ["soft", "soft"], "friction": 0.2},
    ],
}
STUDY = {
    "study": {"name": "a study"},
    "common": {"width": 0.02, "height": 0.04, "set": {"friction": 0.3}},
    "grid": {"test": ["uniaxial", "tension"], "seed": [1, 2], "model": ["flexible", "rigid"]},
    "case": [{"rate": 4.0, "dynamic": True}, {"diameters": [2e-3, 4e-3]}],
    "picture": [{"x": "seed", "y": "peak_stress", "by": ["model"], "file": "a.png"}],
}
CALIBRATION = {
    "calibration": {"name": "a calibration", "model": "rigid", "evaluations": 3},
    "common": {"thickness": 0.01},
    "screen": {"width": 0.02, "seeds": [1]},
    "verify": {"seeds": [2, 3]},
    "target": {"compressive_strength": {"value": 1e8, "tolerance": 0.1}, "youngs_modulus": 2e10},
    "free": {"cohesion": [1e7, 9e7], "tensile_strength": [1e6, 2e7], "shear_ratio": [0.1, 2.0]},
    "ratio": [{"of": "cohesion", "to": "tensile_strength", "bounds": [1.0, 9.0]}],
}
KINDS = {
    "material": (MATERIAL, lambda path: description(materials.load(path))),
    "study": (STUDY, study.read),
    "calibration": (CALIBRATION, calibration_problem.read),
}
WORDS = [
    "name",
    "elastic",
    "set",
    "young",
    "test",
    "$x$",
    "../x",
    "a/b",
    "\0",
    "\x1b[31m",
    "a.toml",
]
SCALARS = st.one_of(
    st.booleans(),
    st.integers(),
    st.sampled_from([10**400, -(10**400), 0, 1e308, 1e-308, float("nan"), float("inf")]),
    st.floats(),
    st.text(st.characters(blacklist_categories=["Cs"]), max_size=8),
    st.sampled_from(WORDS),
    st.just(datetime.date(2026, 1, 1)),
)
KEYS = st.sampled_from(WORDS[:5]) | st.text(st.characters(blacklist_categories=["Cs"]), max_size=5)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3),
    max_leaves=6,
)


@pytest.fixture(scope="module")
def small():
    return flexpm.Specimen.rectangle(0.012, 0.016, 0.01)


def places(content, path=()):
    """Each place in nested tables and lists."""
    yield path
    entries = content.items() if isinstance(content, dict) else ()
    if isinstance(content, list):
        entries = enumerate(content)
    for key, inner in entries:
        yield from places(inner, (*path, key))


@st.composite
def documents(draw, whole):
    """A right document with one or two entries replaced or added."""
    changed = copy.deepcopy(whole)
    for _ in range(draw(st.integers(1, 2))):
        *outer, key = draw(st.sampled_from(list(places(changed))[1:]))
        inner = changed
        for one in outer:
            inner = inner[one]
        if isinstance(inner, dict) and draw(st.integers(0, 4)) == 0:
            key = draw(KEYS)
        inner[key] = draw(VALUES)
    return changed


@pytest.mark.parametrize("kind", KINDS)
def test_the_documents_are_right_before_they_are_changed(tmp_path, kind):
    whole, read = KINDS[kind]
    (tmp_path / "it.toml").write_text(tomli_w.dumps(whole))
    read(tmp_path / "it.toml")


@pytest.mark.parametrize("kind", KINDS)
@given(data=st.data())
@drawing(150)
def test_any_shape_is_read_or_refused(tmp_path, kind, data):
    whole, read = KINDS[kind]
    content = data.draw(documents(whole))
    (tmp_path / "it.toml").write_text(tomli_w.dumps(content), encoding="utf-8")
    try:
        read(tmp_path / "it.toml")
    except InputError as error:
        assert str(error)


def inputs_of_a_run():
    """Content of a result.json, as far as `flexpm rerun` reads it."""
    rock = materials.Material.from_dict({**MATERIAL, "name": "a rock"})
    spec = RunSpec("uniaxial", SpecimenSpec("rectangle"), described(rock, "flexible"))
    return {"inputs": spec.to_json()}


@given(data=st.data())
@drawing(150)
def test_any_shape_of_a_result_is_read_or_refused(tmp_path, data):
    file = tmp_path / "result.json"
    whole = inputs_of_a_run()
    file.write_text(json_text(whole))
    asked.read_inputs(file)
    content = data.draw(documents(whole))
    try:
        text = json_text(content)
    except (TypeError, ValueError):  # no JSON: a date, or a number that is none
        return
    file.write_text(text, encoding="utf-8")
    try:
        asked.read_inputs(file)
    except InputError as error:
        assert "\n" not in str(error)


@given(st.binary(max_size=40))
@example(b"a = " + b"9" * 5000)
@example(b"a = " + b"[" * 3000)
@example(b"a = 1e999999\n[a]")
@drawing(100)
def test_any_bytes_are_toml_or_refused(tmp_path, content):
    (tmp_path / "it.toml").write_bytes(content)
    try:
        assert isinstance(load_toml(tmp_path / "it.toml", "it"), dict)
    except InputError as error:
        assert str(error)


CELLS = SCALARS.map(str) | st.sampled_from(["0", "0.005", "-1e300", '"', ",", "\n", "x1"])


@given(rows=st.lists(st.lists(CELLS, max_size=6), max_size=4), named=st.booleans())
@example(rows=[["0", "0.004", "0.012", "0.004", "saw"]], named=True)
@example(rows=[["0", "0.004", "1e300", "0.004", "saw"]], named=True)
@drawing(150)
def test_any_file_of_joints_cuts_or_is_refused(tmp_path, small, rows, named):
    text = "\n".join(",".join(row) for row in rows)
    header = ",".join(joint_lines.COLUMNS) + "\n" if named else ""
    (tmp_path / "joints.csv").write_text(header + text, encoding="utf-8")
    try:
        cut = small.with_joints(joint_lines.read(tmp_path / "joints.csv"))
        assert math.fsum(cut.tessellation.cell_areas) == pytest.approx(0.012 * 0.016, rel=1e-12)
    except InputError as error:
        assert "\n" not in str(error)


@given(place=st.integers(0, 10**6), byte=st.integers(0, 255))
@drawing(100)
def test_a_saved_specimen_with_another_byte_is_the_same_or_refused(tmp_path, small, place, byte):
    file = tmp_path / "grains.json"
    small.save(file)
    content = bytearray(file.read_bytes())
    content[place % len(content)] = byte
    file.write_bytes(content)
    try:
        assert np.array_equal(flexpm.Specimen.load(file).discs, small.discs)
    except InputError as error:
        assert "\n" not in str(error)


def refused(capsys, path: Path, content: dict, command: str = "study") -> str:
    """The line in which a command refuses a file; nothing is run."""
    path.write_text(tomli_w.dumps(content))
    errors = refused_command(capsys, "", command, path, "--out", path.parent / "out")
    assert not (path.parent / "out").exists()
    return errors


@pytest.mark.parametrize(
    ("picture", "says"),
    [
        ({"foo": 1}, "[[picture]] key = 'foo'"),
        ({"x": "nothere"}, "column = 'nothere'"),
        ({"file": "../../escaped.png"}, "plain name of a file"),
        ({"file": "/tmp/escaped.png"}, "plain name of a file"),
        ({"file": "a.doc"}, "must end in .png"),
    ],
)
def test_pictures_are_checked_before_the_first_run(capsys, tmp_path, picture, says):
    content = STUDY | {"picture": [STUDY["picture"][0] | picture]}
    assert says in refused(capsys, tmp_path / "it.toml", content)


@pytest.mark.parametrize("name", ["../x", "a/b/c", "", ".", "a\0b", "x" * 300])
def test_the_name_of_a_calibration_stays_in_its_folder(capsys, tmp_path, name):
    content = CALIBRATION | {"calibration": {"name": name}}
    errors = refused(capsys, tmp_path / "it.toml", content, "calibrate")
    assert "plain name of a file" in errors


def test_too_many_runs_are_refused_with_their_number(capsys, tmp_path):
    content = {"grid": {"test": ["uniaxial"], "seed": [1] * 1000, "rate": [1.0] * 1000}}
    assert "runs = 1000000, must be <=" in refused(capsys, tmp_path / "it.toml", content)


def test_too_many_minerals_are_refused_with_their_number(capsys, tmp_path):
    kinds = [{"name": f"kind {number}", "fraction": 1e-3} for number in range(1000)]
    (tmp_path / "it.toml").write_text(tomli_w.dumps(MATERIAL | {"mineral": kinds}))
    assert cli.main(["elastic", "--material", str(tmp_path / "it.toml")]) == 2
    assert "minerals = 1000, must be <= 100" in capsys.readouterr().err


def test_a_scheduler_that_is_none_is_refused(capsys, tmp_path):
    (tmp_path / "it.toml").write_text(tomli_w.dumps(STUDY))
    arguments = ["study", str(tmp_path / "it.toml"), "--out", str(tmp_path / "out")]
    refused_command(capsys, "cannot be reached", *arguments, "--scheduler", "nonsense")
