# SPDX-License-Identifier: GPL-3.0-or-later
"""Direct shear of solid boxes: whole tests, same bits, folders, what is refused."""

import json

import numpy as np
import pytest
from stopped_runs import same, taken_up

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.materials.material import default_name

import yade  # isort: skip  (flexpm tells Python where YADE is)

#: A hundred grains.
WIDTH, DEPTH, HEIGHT = 0.016, 0.009, 0.012
AREA = WIDTH * DEPTH


@pytest.fixture(scope="module")
def block():
    return Specimen.box(WIDTH, DEPTH, HEIGHT, seed=1)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_the_lower_half_slides_below_the_upper_one(block, model):
    result = flexpm.run("shear", block, default_name(model), model, rate=2.0, normal_stress=2e6)
    curve = result.curve
    assert result.energy_error < 0.01
    assert curve["load"] == pytest.approx(AREA * curve["axial_stress"])
    assert curve["displacement"] == pytest.approx(HEIGHT * curve["axial_strain"])
    assert np.array_equal(curve["shear_stress"], curve["axial_stress"])
    strength = result.material["cohesion"] + result.material["friction"] * 2e6
    assert 0.2 * strength < result.peak_stress < 1.2 * strength
    assert 0.0 < result.residual_strength < result.peak_stress
    assert (result.youngs_modulus, result.poissons_ratio) == (None, None)
    # upper and lower box bear the same up to the peak; the joint that has formed opens the sample
    rising = slice(1, int(np.argmax(curve["axial_stress"])))
    assert np.median(curve["end_mismatch"][rising]) < 0.02
    assert curve["dilation"][-1] > 1e-5
    assert curve["shear_displacement"][-1] > 0.0  # the lower point goes on, the upper one stays
    assert result.fragments > 1


@pytest.mark.long
def test_more_pressure_bears_more(block):
    low, high = (
        flexpm.run(
            "shear", block, default_name("rigid"), "rigid", rate=4.0, normal_stress=stress
        ).peak_stress
        for stress in (0.5e6, 8e6)
    )
    assert high > 1.2 * low


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_threads_and_a_stop_change_no_bit(block, model, tmp_path, monkeypatch):
    asked = {"model": model, "max_displacement": 1e-5, "rate": 4.0}
    whole = flexpm.run("shear", block, threads=2, **asked)
    for step in (40, 140):
        assert same(
            taken_up(monkeypatch, tmp_path / str(step), step, "shear", block, **asked), whole
        )


@pytest.mark.long
def test_a_depth_asks_for_a_solid_and_its_folder_repeats(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    asked = ["shear", "--width", "0.016", "--height", "0.012", "--depth", "0.009"]
    more = ["--model", "rigid", "--max-displacement", "5e-6", "--rate", "4", "--quiet"]
    assert cli.main(["run", *asked, *more, "--out", "slid"]) in (0, 3)
    inputs = json.loads((tmp_path / "slid/result.json").read_text())["inputs"]
    assert inputs["specimen"]["kind"] == "box"
    assert inputs["normal_stress"] == 1e6
    page = (tmp_path / "slid/report.html").read_text()
    assert "--shape box" in page
    assert "shear stress" in page
    capsys.readouterr()
    assert cli.main(["rerun", "slid", "--quiet", "--out", "again", "--no-report"]) in (0, 3)
    assert "the same as in" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (["--depth", "0.02", "--thickness", "0.01"], "thickness = 0.01 m, must not be"),
        (["--depth", "0.02", "--model", "jcfpm"], "must be one of flexible, rigid"),
        (["--depth", "0.02", "--joints", "no.csv"], "joints = no.csv, must not be given for a box"),
        (["--depth", "0.02", "--normal-stress", "-1"], "normal-stress = -1 Pa, must be > 0"),
        (["--shape", "cylinder"], "must be a rectangle for shear, or a box"),
    ],
)
def test_what_does_not_fit_is_refused(asked, told, tmp_path, capsys):
    assert cli.main(["run", "shear", *asked, "--out", str(tmp_path / "none")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert told in error
    assert not (tmp_path / "none").exists()


def test_plates_without_one_for_a_pressure_are_not_pressed():
    from flexpm.laboratory import part_tests
    from flexpm.runs.run_spec import RunSpec, described

    beam = Specimen.box(0.036, 0.008, 0.008, seed=1)
    material = flexpm.materials.load("augig-table7")
    spec = RunSpec("bending", beam.spec, described(material, "flexible"))
    yade.O.reset()
    rig = part_tests.part_rig(flexpm.build(beam, material), spec, None)
    with pytest.raises(InputError, match="confine: part = None, must be one of the rig"):
        rig.confine(1e6)
