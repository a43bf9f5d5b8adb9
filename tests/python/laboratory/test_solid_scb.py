# SPDX-License-Identifier: GPL-3.0-or-later
"""Semi-circular bend of half solid discs: the shape, whole tests, same bits, what is refused."""

import json
import math

import numpy as np
import pytest
from stopped_runs import same, taken_up

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.kinds import toughness
from flexpm.materials.material import default_name

import yade  # isort: skip  (flexpm tells Python where YADE is)

#: Some hundred grains.
DIAMETER, DEPTH = 0.024, 0.008
SPAN, NOTCH = 0.6 * DIAMETER, 0.25 * DIAMETER


@pytest.fixture(scope="module")
def half():
    return Specimen.solid_half_disc(DIAMETER, DEPTH, seed=1)


def test_half_a_disc_is_flat_below_and_has_half_its_volume(half, tmp_path):
    outline = half.outline()
    assert half.spec.volume == pytest.approx(math.pi / 8.0 * DIAMETER**2 * DEPTH)
    assert outline.volume == pytest.approx(half.spec.volume, rel=1e-12)
    assert half.cells.volumes.sum() == pytest.approx(half.spec.volume, rel=1e-12)
    corners = half.cells.vertices
    assert corners.min(axis=0) == pytest.approx([-0.5 * DIAMETER, 0.0, 0.0], rel=0.01, abs=1e-12)
    assert corners.max(axis=0) == pytest.approx([0.5 * DIAMETER, DEPTH, 0.5 * DIAMETER], rel=0.01)
    # as much of it on either side, grains no larger near the arc than within
    assert np.abs(half.spheres[:, 0].mean()) < 0.05 * DIAMETER
    assert half.spheres[:, 2].min() > 0.0
    half.save(tmp_path / "half.json")
    again = Specimen.load_solid(tmp_path / "half.json")
    assert again.kind == "solid-half-disc"
    assert np.array_equal(again.cells.vertices, half.cells.vertices)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_crack_runs_up_from_the_notch(half, model):
    result = flexpm.run("scb", half, default_name(model), model, rate=4.0)
    assert result.energy_error < 0.02
    depth, top = result.notch_depth, 0.5 * DIAMETER
    assert depth == pytest.approx(NOTCH, abs=0.35 * half.mean_diameter)
    area = 2.0 * DEPTH * (top - depth) ** 2 / (3.0 * SPAN)
    assert result.peak_load == pytest.approx(area * result.peak_stress)
    sizes = {"span": SPAN, "radius": top, "thickness": DEPTH, "notch": depth}
    told = toughness.half_disc_toughness(result.peak_load, **sizes)
    assert result.fracture_toughness == pytest.approx(told)
    assert 0.3e6 < result.fracture_toughness < 5e6
    places = np.array([(one.x, one.z) for one in result.cracks])
    assert np.abs(places[:, 0]).max() < 0.25 * DIAMETER
    assert places[:, 1].max() > 0.75 * top
    assert result.tensile_cracks > 10 * result.shear_cracks
    curve = result.curve
    assert curve["cmod"][-1] > 10.0 * curve["cmod"][1]
    loaded = curve["load"] > 0.2 * result.peak_load
    assert sorted(curve["end_mismatch"][loaded])[int(0.5 * loaded.sum())] < 0.1


@pytest.mark.long
def test_threads_and_a_stop_change_no_bit(half, tmp_path, monkeypatch):
    asked = {"model": "flexible", "max_strain": 4e-4}
    whole = flexpm.run("scb", half, threads=2, **asked)
    assert same(taken_up(monkeypatch, tmp_path, 60, "scb", half, **asked), whole)


@pytest.mark.long
def test_a_depth_asks_for_a_solid_and_its_folder_repeats(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    asked = ["scb", "--diameter", "0.024", "--depth", "0.008", "--max-strain", "3e-4"]
    assert cli.main(["run", *asked, "--rate", "4", "--quiet", "--out", "half"]) in (0, 3)
    inputs = json.loads((tmp_path / "half/result.json").read_text())["inputs"]
    assert inputs["specimen"]["kind"] == "solid-half-disc"
    assert (inputs["span"], inputs["notch"]) == pytest.approx((SPAN, NOTCH))
    page = (tmp_path / "half/report.html").read_text()
    assert "--shape solid-half-disc" in page
    assert "half a disc of 24 x 8 mm" in page
    capsys.readouterr()
    assert cli.main(["rerun", "half", "--quiet", "--out", "again", "--no-report"]) in (0, 3)
    assert "the same as in" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (["--depth", "0.02", "--thickness", "0.01"], "thickness = 0.01 m, must not be"),
        (["--depth", "0.02", "--model", "jcfpm"], "must be one of flexible, rigid"),
        (["--depth", "0.02", "--span", "0.06"], "span = 0.06 m, must be"),
        (["--shape", "box"], "must be a half-disc for scb, or a solid-half-disc"),
    ],
)
def test_what_does_not_fit_half_a_disc_is_refused(asked, told, tmp_path, capsys):
    assert cli.main(["run", "scb", *asked, "--out", str(tmp_path / "none")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert told in error
    assert not (tmp_path / "none").exists()


def test_no_rig_of_two_ends_holds_half_a_disc(half):
    yade.O.reset()
    with pytest.raises(InputError, match="rig: specimen = solid-half-disc, must be one of"):
        flexpm.rig(flexpm.build(half))
