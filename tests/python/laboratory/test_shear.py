# SPDX-License-Identifier: GPL-3.0-or-later
"""Direct shear of joints and of rock, in 2D and 3D, and what of it is refused."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import yade
from refusals import failure, refusal
from scenes import fresh

import flexpm
from flexpm import Specimen
from flexpm.cli.main import main
from flexpm.errors import InputError
from flexpm.materials.material import default_name
from flexpm.report import tables
from flexpm.rigs.part_rig import PartRig
from flexpm.runs.loading_rate import Loading
from flexpm.runs.run_spec import RunSpec

WIDTH, HEIGHT = 0.024, 0.016
PRESSURE = 2e6
FRICTION = 0.5
LAW = {"normal_stiffness": 1.8e13, "shear_stiffness": 5e12, "friction": FRICTION}
MIDDLE = {"plane": [(0.0, HEIGHT / 2), (WIDTH, HEIGHT / 2)]}


@pytest.fixture(scope="module")
def whole() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(WIDTH, HEIGHT, thickness=0.01, seed=1)


def rock(**law: float) -> flexpm.Material:
    values = {f"joint.plane.{key}": value for key, value in (LAW | law).items()}
    return flexpm.materials.load("augig-table7").with_set(values)


def sheared(whole, model: str, material: flexpm.Material | None = None, **options) -> flexpm.Result:
    cut = whole.with_joints(MIDDLE)
    options = {"normal_stress": PRESSURE} | options
    return flexpm.run("shear", cut, material or rock(), model, **options)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_joint_without_cohesion_carries_its_friction(whole, model):
    """Within 1 %, and 2 % at four times the rate: the load slows down before it slides (D58)."""
    results = {rate: sheared(whole, model, rate=rate) for rate in (4.0, 2.0, 1.0)}
    errors = {}
    for rate, result in results.items():
        # four times the rate is told, as its growth before the slip is
        assert result.status == "ok" or rate == 4.0
        assert not result.failed
        assert result.peak_stress is None
        stress = result.curve["shear_stress"] / (FRICTION * PRESSURE)
        errors[rate] = stress.max() - 1.0
        # once it slides
        assert np.abs(stress[len(stress) // 2 :] - 1.0).max() < 1e-3
        assert result.residual_strength == pytest.approx(FRICTION * PRESSURE, rel=1e-3)
        assert result.energy_error < 1e-3
        assert result.tensile_cracks == result.shear_cracks == 0
    assert all(error > 0.0 for error in errors.values())
    assert errors[1.0] < 0.01
    assert errors[4.0] < 0.02


def test_faces_of_a_crack_within_a_plate_slide_past_each_other():
    """Grains that meet the crack in a point caught on the other side: 0.45 of the slip was left."""
    side, reach = 0.1, 0.01 / math.sqrt(2.0)
    plate = flexpm.Specimen.rectangle(side, side, 0.08, diameters=(1.33e-3, 2.67e-3), seed=1)
    ends = [[0.5 * side + one * reach] * 2 for one in (-1.0, 1.0)]
    law = {"normal_stiffness": 1.8e14, "shear_stiffness": 1e3, "friction": 0.0}
    material = flexpm.materials.load("augig-table7").with_set(
        {f"joint.crack.{key}": value for key, value in law.items()}
    )
    cut = plate.with_joints({"crack": ends})
    rig = flexpm.rig(flexpm.build(cut, material))
    rig.start(Loading())
    slips = []
    for steps in (1, 199):
        for _ in range(steps):
            yade.O.step()
        state = rig.built.snapshot()
        contacts = state.contact[state.point_contact]
        crack = np.isin(contacts, np.flatnonzero(cut.edge_joints >= 0))
        slips.append(np.abs(state.point_slip[crack]).mean())
        assert np.all(state.point_opening[crack] < 0.0)
    assert rig.built.solver.counts()["touching"] == 0
    # the first step has the velocities of the elastic solution; waves of the start are left
    assert slips[1] == pytest.approx(200.0 * slips[0], rel=0.15)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_joint_with_teeth_opens_by_the_tangent_of_their_angle(whole, model):
    law = {"dilation_angle": 10.0, "dilation_slip": 10e-6}
    curve = sheared(whole, model, rock(**law), max_displacement=20e-6).curve
    assert curve.own == ("load", "displacement", "shear_displacement", "dilation", "shear_stress")
    assert np.array_equal(curve["shear_stress"], curve["axial_stress"])
    opened = math.tan(math.radians(10.0))
    slip, dilation = curve["shear_displacement"], curve["dilation"]
    ramp = (slip > 3e-6) & (slip < 8e-6)
    assert np.polyfit(slip[ramp], dilation[ramp], 1)[0] == pytest.approx(opened, rel=0.01)
    assert dilation[-1] == pytest.approx(opened * 10e-6, rel=0.01)
    # nothing is opened before it slides, and teeth alone add nothing to the friction
    assert np.abs(dilation[: len(dilation) // 20]).max() < 0.05 * dilation[-1]
    assert curve["shear_stress"][-1] == pytest.approx(FRICTION * PRESSURE, rel=0.01)


def test_a_bonded_joint_softens_to_its_friction(whole, tmp_path):
    law = {"cohesion": 2e6, "tensile_strength": 1e6, "shear_fracture_energy": 20.0}
    result = sheared(whole, "rigid", rock(**law), max_displacement=60e-6, out=tmp_path)
    strength = 2e6 + FRICTION * PRESSURE
    assert 0.9 * strength < result.peak_stress <= 1.01 * strength
    assert result.residual_strength == pytest.approx(FRICTION * PRESSURE, rel=0.01)
    assert result.curve["displacement"][-1] == pytest.approx(60e-6, rel=0.01)
    edges = 3 * len([c for c in result.cracks if c.point == 1])
    assert result.shear_cracks == len(result.cracks) == edges
    area = WIDTH * 0.01
    assert result.curve["damage_energy"][-1] == pytest.approx(20.0 * area, rel=0.02)
    assert result.youngs_modulus is None
    read = json.loads((tmp_path / "result.json").read_text())
    assert read["residual_strength"] == result.residual_strength
    assert (read["inputs"]["normal_stress"], read["inputs"]["max_displacement"]) == (2e6, 60e-6)
    text = tables.result_table(result)
    assert "peak shear stress" in text
    assert f"residual strength           {result.residual_strength / 1e6:.4g}" in text


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_faces_that_slide_far_keep_their_friction_and_their_interactions(whole, model):
    result = sheared(whole, model, **FAR)
    assert result.energy_error < 1e-3
    slip, stress = result.curve["shear_displacement"], result.curve["shear_stress"]
    assert slip[-1] == pytest.approx(FAR["max_displacement"], rel=0.01)
    slides = stress[slip > 0.1 * slip[-1]] / (FRICTION * PRESSURE)
    assert slides.mean() == pytest.approx(1.0, abs=2e-3)
    # YADE has one interaction for each pair with a contact, and none for pairs that have parted
    contacts = [one for one in yade.O.interactions if one.isReal]
    assert all(one.phys.area.sum() > 0.0 for one in contacts)
    across = [one for one in contacts if np.abs(one.geom.ends[:, 1] - HEIGHT / 2).max() < 1e-5]
    area = sum(one.phys.area.sum() for one in across)
    assert area == pytest.approx((WIDTH - slip[-1]) * 0.01, rel=0.01)


def test_rock_without_a_joint_shears_beyond_its_cohesion(whole):
    result = flexpm.run("shear", whole, model="rigid", normal_stress=PRESSURE)
    law = result.material
    least = 0.25 * (law["cohesion"] + law["friction"] * PRESSURE)
    assert least < result.curve["shear_stress"].max() < 8.0 * least
    assert result.status in ("ok", "not_quasistatic")
    assert not result.failed


#: Slides by half a grain: faces get new partners.
FAR = {"rate": 20.0, "max_displacement": 1.5e-3}


def test_the_scales_of_a_loading_are_those_that_it_began_with(whole):
    """Not those of what is broken by then, also in a scene that is taken up again."""
    yade.O.reset()
    beam = flexpm.Specimen.rectangle(0.056, 0.012, thickness=0.01, seed=1)

    def rig() -> PartRig:
        rig = PartRig(built, kind="bending")
        rollers = [rig.support((x, 0.0)) for x in (0.004, 0.052)]
        head = rig.support((0.028, 0.012), pinned=True)
        rig.drive([head], (0.0, -1.0), against=rollers)
        return rig

    built = flexpm.build(beam, model="rigid")
    first = rig()
    first.load(flexpm.Loading(kind="waiting", stop_ratio=0.1))
    saved = first.scales()
    built.rebind()
    assert rig().scales() == saved
    # what has broken has none
    with pytest.raises(ValueError, match="stiffness that the driven parts feel"):
        built.engine(type(first._recorder)).scales()


def test_the_command_shears_and_ends_well(tmp_path, capsys):
    lines = tmp_path / "plane.csv"
    middle = HEIGHT / 2
    lines.write_text(f"x1,y1,x2,y2,name\n0,{middle},{WIDTH},{middle},plane\n")
    law = [word for key, value in LAW.items() for word in ("--set", f"joint.plane.{key}={value}")]
    size = ["--width", str(WIDTH), "--height", str(HEIGHT), "--joints", str(lines)]
    ask = ["--normal-stress", "3e6", "--model", "rigid", "--out", str(tmp_path / "out")]
    assert main(["run", "shear", *size, *law, *ask, "--no-report"]) == 0
    assert "peak shear stress           -" in capsys.readouterr().out
    content = json.loads((tmp_path / "out" / "result.json").read_text())
    assert (content["status"], content["peak_stress"]) == ("ok", None)
    assert content["residual_strength"] == pytest.approx(1.5e6, rel=1e-3)
    both = ["--models", "flexible,rigid", "--out", str(tmp_path / "both"), "--no-report"]
    assert main(["compare", "shear", *size, *law, *both]) == 0
    assert Path(tmp_path / "both" / "compare.csv").is_file()


@pytest.mark.parametrize(
    ("test", "options", "message"),
    [
        ("shear", {"normal_stress": 0.0}, "run: normal_stress = 0.0 Pa, must be > 0"),
        ("shear", {"max_displacement": WIDTH}, "run: max_displacement = 0.024 m"),
        ("shear", {"confinement": 1e6}, "run: confinement = 1000000.0 Pa, must be 0 for shear"),
        ("shear", {"model": "inner"}, "run: model of shear = 'inner'"),
        (
            "uniaxial",
            {"normal_stress": 1e6},
            "run: normal_stress = 1000000.0 Pa, must not be given",
        ),
        ("uniaxial", {"max_displacement": 1e-3}, "run: max_displacement = 0.001 m, must not be"),
    ],
)
def test_shear_out_of_range_is_refused_in_one_line(test, options, message):
    size = {"width": WIDTH, "height": HEIGHT}
    with pytest.raises(InputError) as refused:
        RunSpec.from_options(test, size | options, flexpm.materials.load(None))
    assert str(refused.value).startswith(message)
    assert "\n" not in str(refused.value)


def test_shear_has_its_own_size_and_pressure():
    spec = RunSpec.from_options("shear", {}, flexpm.materials.load(None))
    assert (spec.specimen.width, spec.specimen.height) == (0.08, 0.04)
    assert spec.normal_stress == 1e6
    assert RunSpec.from_json(spec.to_json()) == spec


def test_a_rig_presses_on_what_it_is_told(whole):
    rig = PartRig(fresh(whole, model="rigid"))
    floor, lid = rig.platen(0), rig.platen(2)
    refusal("confine: part = None", rig.confine, 1e6)
    rig.drive([floor], (0.0, 1.0))
    rig.alias_column("stress", "axial_stress")
    refusal("alias_column = 'stress'", rig.alias_column, "stress", "load")
    with pytest.raises(InputError, match="gauge side: length of its direction = 0"):
        rig.gauge("side", (0.0, 0.0), (0.01, 0.0), along=(0.0, 0.0))
    rig.press(lid, 1e6)
    assert lid.force[1] == pytest.approx(-1e6 * WIDTH * 0.01, rel=0.02)
    assert floor.force[1] == pytest.approx(1e6 * WIDTH * 0.01, rel=0.02)


def test_a_specimen_that_is_pressed_to_pieces_is_refused(whole):
    """It gives way to all sides, and no contact bears anything then."""
    soft = {"normal_stiffness": 1.3e12, "friction": 0.0}
    rock = flexpm.materials.load(None, "rigid").with_set(soft, "rigid")
    line = (
        r"confine: imbalance = .* of 1.2e\+09 Pa \(reactions .*, mean stress .*, motion .*\), must"
    )
    failure(line, flexpm.run, "shear", whole, rock, "rigid", normal_stress=1.2e9)


def test_the_forces_balance_under_a_pressure_on_two_grains():
    """A wave crosses them within a few steps: the balance must be known as often."""
    square = np.array([[0.0, 0.0], [0.01, 0.0], [0.01, 0.01], [0.0, 0.01]])
    blocks = flexpm.Specimen.from_polygons([square, square + np.array([0.0, 0.01])], 0.01)
    rig = PartRig(fresh(blocks, model="rigid"))
    floor, lid = rig.platen(0, bonded=True), rig.platen(2)
    rig.drive([floor], (0.0, 1.0))
    rig.press(lid, 1e6)
    assert floor.force[1] == pytest.approx(100.0, rel=0.01)
    assert lid.force[1] == pytest.approx(-100.0, rel=0.01)


#: A hundred grains.
SOLID_WIDTH, DEPTH, SOLID_HEIGHT = 0.016, 0.009, 0.012
AREA = SOLID_WIDTH * DEPTH


@pytest.fixture(scope="module")
def block():
    return Specimen.box(SOLID_WIDTH, DEPTH, SOLID_HEIGHT, seed=1)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_the_lower_half_slides_below_the_upper_one(block, model):
    result = flexpm.run("shear", block, default_name(model), model, rate=2.0, normal_stress=2e6)
    curve = result.curve
    assert result.energy_error < 0.01
    assert curve["load"] == pytest.approx(AREA * curve["axial_stress"])
    assert curve["displacement"] == pytest.approx(SOLID_HEIGHT * curve["axial_strain"])
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


def test_plates_without_one_for_a_pressure_are_not_pressed():
    from flexpm.laboratory import part_tests
    from flexpm.runs.run_spec import RunSpec, described

    beam = Specimen.box(0.036, 0.008, 0.008, seed=1)
    material = flexpm.materials.load("augig-table7")
    spec = RunSpec("bending", beam.spec, described(material, "flexible"))
    rig = part_tests.part_rig(fresh(beam, material), spec, None)
    refusal("confine: part = None, must be a part of the rig", rig.confine, 1e6)
