# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a script's own test: what it says, who reads it, what is refused."""

from __future__ import annotations

import json

import numpy as np
import pytest
import result_schema_file
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.cli import main as cli
from flexpm.renamed import current
from flexpm.report.curves import peak_place
from flexpm.report.words import words_of_result
from flexpm.results.vtu import read_vtu

FILES = {
    *("result.json", "curve.csv", "cracks.csv", "events.csv", "fragments.csv", "final.vtu"),
    *("curve.png", "cracks.png", "fragments.png", "events.png", "report.html"),
}


@pytest.fixture(scope="module")
def specimen():
    return flexpm.Specimen.rectangle(0.036, 0.012, 0.01, seed=1)


def bent(specimen, model="rigid", **sizes):
    """A beam on two rollers, its rig."""
    rig = flexpm.PartRig(fresh(specimen, model=model))
    rollers = [rig.support((x, 0.0)) for x in (0.004, 0.032)]
    head = rig.support((0.018, 0.012), pinned=True)
    rig.drive(head, (0.0, -1.0), against=rollers, **sizes)
    rig.gauge("sag", (0.018, 0.0), (0.018, 0.012))
    return rig


@pytest.fixture(scope="module")
def broken(specimen, tmp_path_factory):
    """A beam that has been broken: its folder, its result, its record and its state."""
    folder = tmp_path_factory.mktemp("own")
    rig = bent(specimen)
    rig.load(flexpm.Loading(kind="waiting", rate=4.0))
    return folder, rig.save(folder), rig.record, rig.built.snapshot()


def test_the_folder_has_what_a_run_has(broken):
    folder, result, record, state = broken
    assert {file.name for file in folder.iterdir()} - {".flexpm.lock"} >= FILES
    back = flexpm.Result.read(folder)
    assert back.as_dict() == current(json.loads((folder / "result.json").read_text()))
    assert back.as_dict() == result.as_dict()
    assert set(back.curve.columns) == set(record.columns)
    for name in record.columns:
        assert np.array_equal(back.curve[name], record[name], equal_nan=True), name
    assert (back.tensile_cracks, len(back.cracks)) == (result.tensile_cracks, len(result.cracks))
    assert back.tensile_cracks > 0
    assert np.array_equal(read_vtu(folder / "final.vtu").point_damage, state.point_damage)


def test_the_load_is_no_stress_unless_the_script_gives_an_area(broken, specimen, tmp_path):
    _, result, record, _ = broken
    assert result.peak_load == record["load"].max() > 0.0
    assert (result.peak_stress, result.youngs_modulus, result.first_tensile_crack_stress) == (
        *(None, None, None),
    )
    rig = bent(specimen, area=1e-4, length=0.01)
    rig.strain_to(2e-4, rate=4.0)
    stressed = rig.save(tmp_path)
    assert stressed.youngs_modulus is not None
    assert stressed.peak_load is None  # its load still rises
    assert stressed.curve["load"] == pytest.approx(1e-4 * stressed.curve["axial_stress"])


@pytest.mark.parametrize(
    ("sizes", "labels", "known"),
    [
        ({}, ("displacement [µm]", "load [N]"), ()),
        ({"area": 1e-4}, ("displacement [µm]", "stress [MPa]"), ("peak_stress",)),
        ({"length": 0.01}, ("strain [%]", "load [N]"), ("peak_strain",)),
        (
            {"area": 1e-4, "length": 0.01},
            ("strain [%]", "stress [MPa]"),
            ("peak_stress", "peak_strain", "youngs_modulus"),
        ),
    ],
)
def test_what_has_no_size_is_drawn_as_a_load_over_a_way(specimen, tmp_path, sizes, labels, known):
    rig = bent(specimen, **sizes)
    rig.save(tmp_path, report=False)  # before it is loaded
    assert not (tmp_path / "curve.png").exists()
    rig.strain_to(2e-6 / sizes.get("length", 1.0), rate=4.0)
    result = rig.save(tmp_path, report=False)
    words = words_of_result(result)
    assert (words.x.label, words.y.label) == labels
    named = [label.partition(" [")[0] for label in reversed(labels)]
    assert words.title().lower() == " over ".join(named)
    measures = ("peak_stress", "peak_strain", "youngs_modulus")
    assert {name for name in measures if getattr(result, name) is not None} <= {*known}
    assert peak_place(result) is None  # its load still rises
    assert (tmp_path / "curve.png").exists()


def test_the_inputs_say_what_the_test_was(broken, specimen):
    inputs = broken[1].inputs
    assert (inputs["test"], inputs["repeatable"], inputs["schema"]) == ("own", False, 1)
    assert [part["part"] for part in inputs["parts"]] == ["plate"] * 3
    assert inputs["parts"][2]["normal"] == [0.0, -1.0]
    assert inputs["drive"]["driven"]["plates"] == [2]
    assert inputs["drive"]["against"]["plates"] == [0, 1]
    assert [one["gauge"] for one in inputs["gauges"]] == ["sag"]
    (stage,) = inputs["stages"]
    assert (stage["stage"], stage["rate"], stage["kind"]) == ("load", 4.0, "waiting")
    assert (stage["first_step"], stage["last_step"]) == (0, broken[1].steps)
    assert inputs["specimen"]["seed"] == specimen.seed


def test_the_result_is_valid(broken):
    content = json.loads((broken[0] / "result.json").read_text())
    assert list(result_schema_file.validator().iter_errors(content)) == []


def test_what_a_function_has_chosen_is_kept_as_nodes(specimen, tmp_path):
    rig = flexpm.PartRig(fresh(specimen, model="rigid"))
    held = rig.hold(where=lambda x, y: x < 0.004)
    moved = rig.hold(box=((0.032, 0.0), (0.036, 0.012)), axes="x")
    rig.drive(moved, (1.0, 0.0), against=held)
    inputs = rig.save(tmp_path).inputs  # not loaded yet
    assert [part["nodes"] for part in inputs["parts"]] == [held.nodes, moved.nodes]
    assert [part["axes"] for part in inputs["parts"]] == ["xy", "x"]
    assert inputs["stages"] == []


def test_the_page_is_made_again_and_nothing_repeats_the_test(broken, tmp_path, capsys):
    folder = broken[0]
    page = (folder / "report.html").read_text()
    for word in ("Stages", "Parts", "Gauges", "peak load", "waiting"):
        assert word in page
    assert "flexpm rerun" not in page
    (folder / "report.html").unlink()
    assert cli.main(["report", str(folder)]) == 0
    assert (folder / "report.html").read_text() == page
    capsys.readouterr()
    assert cli.main(["rerun", str(folder), "--out", str(tmp_path / "again")]) == 2
    told = capsys.readouterr().err.strip()
    assert told.endswith("start its script again")
    assert "\n" not in told
    assert not (tmp_path / "again").exists()


@pytest.mark.parametrize("model", ["flexible", "jcfpm"])
def test_a_rig_of_ends_saves_stage_after_stage(model, tmp_path):
    specimen = flexpm.Specimen.rectangle(0.01, 0.014, 0.01, seed=1)
    rig = flexpm.rig(fresh(specimen, model=model))
    rig.confine(1e6)
    rig.save(tmp_path)
    rig.strain_to(5e-5, rate=4.0)
    rig.strain_to(2e-5, rate=4.0)
    result = rig.save(tmp_path, report=False)
    names = [stage["stage"] for stage in result.inputs["stages"]]
    assert names == ["confine", "strain_to", "strain_to"]
    steps = [stage["last_step"] for stage in result.inputs["stages"]]
    assert steps == sorted(steps)
    assert steps[-1] == yade.O.iter
    assert result.inputs["ends"]["pull"] is False
    assert result.inputs["confinement"] == 1e6
    assert flexpm.Result.read(tmp_path).inputs == result.inputs
    assert not (tmp_path / "report.html").exists()  # the earlier one would be another state's


def test_saving_changes_no_bit_of_the_test(specimen, tmp_path):
    records = []
    for saves in (False, True):
        rig = bent(specimen)
        rig.strain_to(5e-7, rate=4.0)
        if saves:
            rig.save(tmp_path)
        rig.strain_to(1e-6, rate=4.0)
        records.append(rig.record.array)
    assert np.array_equal(*records, equal_nan=True)


def test_a_folder_of_another_run_is_refused_both_ways(broken, specimen, tmp_path):
    small = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
    flexpm.run("tension", small, model="rigid", max_strain=2e-5, out=tmp_path, report=False)
    before = {file.name: file.read_bytes() for file in tmp_path.iterdir()}
    rig = bent(specimen)
    refusal("another run", rig.save, tmp_path)
    (tmp_path / "result.json").unlink()  # a run that has begun
    refusal("another run", rig.save, tmp_path)
    del before["result.json"]
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == before
    refusal("another run", rig.save, broken[0])
    with pytest.raises(flexpm.InputError, match="another run"):
        flexpm.run("tension", small, model="rigid", max_strain=2e-5, out=broken[0])


def test_given_grains_are_saved_beside(specimen, tmp_path):
    made = flexpm.Specimen.from_discs(specimen.centres, specimen.radii, specimen.outline, 0.01)
    rig = bent(made)
    rig.save(tmp_path)
    assert flexpm.Specimen.load(tmp_path / "grains.json").spec == made.spec


def test_a_folder_that_was_saved_on_the_way_is_saved_again(specimen, tmp_path):
    """Numbers of numpy are kept as those of Python; a stage that is refused is none."""
    rig = flexpm.rig(fresh(specimen, model="rigid"))
    rig.watch = lambda one: one.save(tmp_path, report=False) if yade.O.iter == 5 else None
    refusal("", rig.strain_to, -1e-5, rate=-1.0)
    assert rig.stages == []
    rig.strain_to(np.float32(1e-4), rate=np.int64(4))
    rig.watch = None
    assert json.loads((tmp_path / "result.json").read_text())["inputs"]["stages"][0] == {
        **{key: rig.stages[0][key] for key in ("stage", "strain", "first_step")},
        "rate": 4,
    }
    rig.save(tmp_path)
    stages = flexpm.Result.read(tmp_path).inputs["stages"]
    assert [one["last_step"] for one in stages] == [yade.O.iter]
