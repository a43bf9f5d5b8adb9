# SPDX-License-Identifier: GPL-3.0-or-later
"""Half a disc in three-point bending, in 2D and 3D: outline, run, toughness, refusals."""

from __future__ import annotations

import dataclasses
import json
import math

import numpy as np
import pytest
from refusals import refusal, refused_command
from scenes import fresh

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.kinds import toughness
from flexpm.laboratory.part_tests import notch_depth, prepared
from flexpm.materials.material import default_name
from flexpm.report import tables
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.spec import SpecimenSpec

RADIUS = 0.02


@pytest.fixture(scope="module")
def half() -> flexpm.Specimen:
    return flexpm.Specimen.half_disc(2.0 * RADIUS, 0.01, seed=2)


def test_half_a_disc_has_its_outline_its_area_and_its_seed(half):
    corners = half.outline
    assert np.all(corners[0] == 0.0) and np.allclose(corners[1], [2.0 * RADIUS, 0.0])
    from_centre = np.hypot(corners[:, 0] - RADIUS, corners[:, 1])
    assert from_centre == pytest.approx(RADIUS, rel=1e-12)
    # a chord on top, about a grain long
    top = corners[:, 1] >= corners[:, 1].max() - 1e-12
    x = corners[top, 0]
    assert np.count_nonzero(top) == 2 and np.mean(x) == pytest.approx(RADIUS, rel=1e-12)
    assert np.ptp(x) == pytest.approx(half.mean_diameter, rel=0.3)
    area = np.sum(half.tessellation.cell_areas)
    assert area == pytest.approx(0.5 * np.pi * RADIUS**2, rel=0.01)
    assert (half.kind, half.dimensions, half.spec.is_packed) == (
        "half-disc",
        {"diameter": 2.0 * RADIUS},
        True,
    )
    again = flexpm.Specimen.pack(half.spec)
    assert np.array_equal(again.discs, half.discs)
    other = flexpm.Specimen.half_disc(2.0 * RADIUS, 0.01, seed=1)
    assert not np.array_equal(other.discs[0], half.discs[0])


def test_half_a_disc_is_none_of_discs(half):
    refusal("sawn grains", flexpm.build, half, model="jcfpm")
    with pytest.raises(InputError, match="largest diameter = 0.012 m, must be <= half"):
        flexpm.Specimen.half_disc(2.0 * RADIUS, 0.01, diameters=(0.011, 0.012))


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_crack_runs_from_the_notch_to_the_load(half, model, tmp_path):
    rate = {"flexible": 8.0, "rigid": 4.0}[model]
    result = flexpm.run("scb", half, model=model, rate=rate, out=tmp_path, report=False)
    assert result.status == "not_quasistatic"  # several times faster than in use
    curve = result.curve
    assert curve.own == ("load", "displacement", "cmod")
    depth = result.notch_depth
    assert depth == pytest.approx(0.5 * RADIUS, abs=0.5 * half.mean_diameter)
    assert result.fracture_toughness == toughness.half_disc_toughness(
        result.peak_load, span=1.2 * RADIUS, radius=RADIUS, thickness=0.01, notch=depth
    )
    height = half.outline[:, 1].max()
    nominal = 1.5 * result.peak_load * 1.2 * RADIUS / (0.01 * (height - depth) ** 2)
    assert result.peak_stress == pytest.approx(nominal, rel=1e-9)
    # cracks in a band above the notch, to near the top, by opening
    places = np.array([(one.x, one.y) for one in result.cracks])
    assert np.all(np.abs(places[:, 0] - RADIUS) < 2.5 * half.mean_diameter)
    assert places[:, 1].min() > 0.9 * depth
    assert places[:, 1].max() > height - 1.5 * half.mean_diameter
    assert result.tensile_cracks > 5 * result.shear_cracks
    spent = curve["damage_energy"][-1] + curve["friction_energy"][-1]
    assert spent < result.fracture_energy * 0.01 * (height - depth)
    assert curve["load"][-1] <= 0.11 * result.peak_load
    assert curve["cmod"][-1] > 2.0 * curve["cmod"][int(np.argmax(curve["load"]))] > 0.0
    assert result.energy_error < 1e-3
    text = tables.result_table(result)
    assert f"fracture toughness          {result.fracture_toughness / 1e6:.4g}" in text
    inputs = json.loads((tmp_path / "result.json").read_text())["inputs"]
    assert (inputs["span"], inputs["notch"]) == (1.2 * RADIUS, 0.5 * RADIUS)


def test_the_function_is_that_of_the_suggested_method():
    """Values of the polynomial by hand, and the range of the sizes in which it is given."""
    # s / 2R = 0.5 and 0.8, a / R = 0.5
    assert toughness.half_disc_function(0.5, 0.5) == pytest.approx(3.461 - 4.34925 + 4.567875)
    assert toughness.half_disc_function(0.5, 0.8) == pytest.approx(6.3158 - 6.8178 + 7.14795)
    sizes = {"radius": 0.04, "thickness": 0.03}
    found = toughness.half_disc_toughness(1e4, span=0.04, notch=0.02, **sizes)
    assert found == pytest.approx(1e4 / 2.4e-3 * np.sqrt(np.pi * 0.02) * 3.679625)
    # deeper notches and longer spans, larger intensity
    for slenderness in (0.5, 0.65, 0.8):
        values = [toughness.half_disc_function(one, slenderness) for one in (0.4, 0.5, 0.6)]
        assert values == sorted(values)
    for span, notch in ((0.039, 0.02), (0.065, 0.02), (0.04, 0.015), (0.04, 0.025)):
        assert toughness.half_disc_toughness(1e4, span=span, notch=notch, **sizes) is None


def spec_of(model: str = "flexible", **options: float) -> RunSpec:
    law = described(flexpm.materials.load(None, model), model)
    return RunSpec("scb", SpecimenSpec("half-disc"), law, model, **options)


def test_sizes_follow_from_the_diameter_and_keep_to_the_range():
    spec = spec_of()
    assert (spec.specimen.diameter, spec.span, spec.notch) == (0.08, 0.048, 0.02)
    assert (spec.stop_ratio, spec.loading) == (0.5, "waiting")
    options = {"diameter": 0.1, "notch": 0.03}
    asked = RunSpec.from_options("scb", options, flexpm.materials.load(None))
    assert (asked.specimen.kind, asked.specimen.diameter) == ("half-disc", 0.1)
    assert (asked.span, asked.notch, asked.stop_ratio) == (pytest.approx(0.06), 0.03, 0.1)
    assert RunSpec.from_json(asked.to_json()) == asked
    # the ends of the range count, in whatever digits
    for span, notch in ((0.5 * 0.08, 0.4 * 0.04), (0.8 * 0.08, 0.6 * 0.04)):
        assert spec_of(span=span, notch=notch).span == span
    for wrong, message in (
        ({"span": 0.039}, "run: span = 0.039 m, must be 0.04 to 0.064 m: 0.5 to 0.8 diameters"),
        ({"span": 0.065}, "run: span = 0.065 m, must be 0.04"),
        ({"span": 0.09}, "run: span = 0.09 m, must be < 0.08"),
        ({"notch": 0.015}, "run: notch = 0.015 m, must be 0.016 to 0.024 m: 0.4 to 0.6 radii"),
        ({"notch": 0.025}, "run: notch = 0.025 m"),
        ({"notch": 0.0}, "run: notch = 0 m"),
        ({"notch": 0.05}, "run: notch = 0.05 m, must be < 0.04"),
    ):
        assert refusal("", spec_of, **wrong).startswith(message)
    refusal("model of scb = 'inner'", spec_of, "inner")
    refusal("must be a half-disc for scb", dataclasses.replace, spec, specimen=SpecimenSpec("disc"))


def test_a_notch_that_is_cut_elsewhere_has_no_toughness_out_of_the_range():
    whole = flexpm.Specimen.half_disc(0.08, 0.08, seed=1)
    cut, _ = prepared(spec_of(notch=0.024), whole, flexpm.materials.load("augig-table7"))
    sizes = {"span": 0.048, "radius": 0.04, "thickness": 0.08}
    assert notch_depth(cut) / 0.04 > 0.6
    assert toughness.half_disc_toughness(1.0, notch=notch_depth(cut), **sizes) is None


ARGUMENTS = ["--diameter", "0.04", "--thickness", "0.01", "--rate", "8", "--quiet"]


@pytest.mark.long
def test_the_command_runs_compares_and_repeats_it(tmp_path, capsys):
    out = tmp_path / "run"
    assert cli.main(["run", "scb", "--model", "rigid", *ARGUMENTS, "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert "fracture toughness" in said and "peak bending stress" in said
    assert "half a disc of 40 mm" in (out / "report.html").read_text()
    assert not (out / "grains.json").exists()
    again = tmp_path / "again"
    assert cli.main(["rerun", str(out), "--quiet", "--out", str(again)]) == 0
    assert "the same as in" in capsys.readouterr().out
    both = tmp_path / "both"
    asked = ["compare", "scb", "--notch", "0.009", *ARGUMENTS, "--out", str(both)]
    assert cli.main(asked) == 0
    assert "K_I [MPa m^0.5]" in capsys.readouterr().out
    for model in ("flexible", "rigid"):
        found = json.loads((both / model / "result.json").read_text())
        assert (found["inputs"]["notch"], found["inputs"]["stop_ratio"]) == (0.009, 0.1)
    for wrong, message in (
        (["--width", "0.1"], "width = 0.1 m, must not be given for a half-disc"),
        (["--notch", "0.004"], "notch = 0.004 m, must be 0.008 to 0.012 m"),
    ):
        refused_command(capsys, message, "run", "scb", *ARGUMENTS, *wrong)


#: Some hundred grains.
DIAMETER, DEPTH = 0.024, 0.008
SPAN, NOTCH = 0.6 * DIAMETER, 0.25 * DIAMETER


@pytest.fixture(scope="module")
def solid_half():
    return Specimen.solid_half_disc(DIAMETER, DEPTH, seed=1)


def test_half_a_disc_is_flat_below_and_has_half_its_volume(solid_half, tmp_path):
    outline = solid_half.outline()
    assert solid_half.spec.volume == pytest.approx(math.pi / 8.0 * DIAMETER**2 * DEPTH)
    assert outline.volume == pytest.approx(solid_half.spec.volume, rel=1e-12)
    assert solid_half.cells.volumes.sum() == pytest.approx(solid_half.spec.volume, rel=1e-12)
    corners = solid_half.cells.vertices
    assert corners.min(axis=0) == pytest.approx([-0.5 * DIAMETER, 0.0, 0.0], rel=0.01, abs=1e-12)
    assert corners.max(axis=0) == pytest.approx([0.5 * DIAMETER, DEPTH, 0.5 * DIAMETER], rel=0.01)
    # as much of it on either side, grains no larger near the arc than within
    assert np.abs(solid_half.spheres[:, 0].mean()) < 0.05 * DIAMETER
    assert solid_half.spheres[:, 2].min() > 0.0
    solid_half.save(tmp_path / "half.json")
    again = Specimen.load_solid(tmp_path / "half.json")
    assert again.kind == "solid-half-disc"
    assert np.array_equal(again.cells.vertices, solid_half.cells.vertices)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_crack_runs_up_from_the_notch(solid_half, model):
    result = flexpm.run("scb", solid_half, default_name(model), model, rate=4.0)
    assert result.energy_error < 0.02
    depth, top = result.notch_depth, 0.5 * DIAMETER
    assert depth == pytest.approx(NOTCH, abs=0.35 * solid_half.mean_diameter)
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


def test_no_rig_of_two_ends_holds_half_a_disc(solid_half):
    refusal("rig: specimen = solid-half-disc, must be one of", flexpm.rig, fresh(solid_half))
