# SPDX-License-Identifier: GPL-3.0-or-later
"""Local damping: its defaults, motion under gravity without it, and runs that take it or not."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yade
from refusals import failure, refusal
from scenes import fresh

import flexpm
from flexpm.materials import load
from flexpm.results import doubts
from flexpm.rigs.part_rig import PartRig
from flexpm.runs.run_spec import ELASTIC, RunSpec, described
from flexpm.specimens.spec import SpecimenSpec

GRAVITY = 9.81
SIDE = 0.012
#: Sizes of the block and what it lies on [m], and friction of the joint between them.
WIDTH, HEIGHT, FRICTION = 0.016, 0.016, 0.5
ANGLE = math.atan(FRICTION) + math.radians(10.0)
#: So soft that no point opens as the sudden weight swings: points that rattle slide more easily.
JOINT = {
    "joint.slope.normal_stiffness": 1e12,
    "joint.slope.shear_stiffness": 1e12,
    "joint.slope.friction": FRICTION,
    "joint.slope.cohesion": 0.0,
    "joint.slope.tensile_strength": 0.0,
}


def spec_of(test: str = "uniaxial", model: str = "flexible", **options) -> RunSpec:
    material = described(load("augig-table7"), model)
    return RunSpec(test, SpecimenSpec("rectangle"), material, model, **options)


@pytest.fixture(scope="module")
def square() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(SIDE, SIDE, thickness=0.01, seed=1)


@pytest.fixture(scope="module")
def cube() -> flexpm.specimens.space.specimen.SolidSpecimen:
    return flexpm.Specimen.box(SIDE, SIDE, SIDE, seed=1)


def fallen(rock: flexpm.Specimen, model: str, **options) -> float:
    """Velocity of an unheld specimen over g t."""
    built = fresh(rock, model=model, dynamic=True, gravity=GRAVITY, **options)
    built.run(1000)
    last = built.snapshot().positions.shape[1] - 1
    speeds = [yade.O.bodies[body].state.vel[last] for body in built.solver.bodyIds]
    energies = built.solver.energies()
    lost = energies["damping_energy"] + energies["kinetic_energy"] + energies["elastic_energy"]
    assert lost == pytest.approx(-energies["potential_energy"], rel=1e-6)
    return -float(np.mean(speeds)) / (GRAVITY * yade.O.iter * yade.O.dt)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("shape", ["square", "cube"])
def test_what_falls_freely_gains_g(shape, model, request):
    rock = request.getfixturevalue(shape)
    assert fallen(rock, model) == pytest.approx(1.0, abs=1e-3)
    assert fallen(rock, model, damping=0.7) == pytest.approx(0.3, abs=1e-3)


def slid(model: str, **options) -> tuple[float, float]:
    """How far a block slides down a joint in 2 ms, and a t^2 / 2 of a free one [m]."""
    slope = math.tan(ANGLE)
    low, beside, drop = 0.25 * HEIGHT, 1e-3, WIDTH * slope
    specimen = flexpm.Specimen.rectangle(WIDTH, HEIGHT + drop, thickness=0.01, seed=3)
    ends = [[x, low + x * slope] for x in (-beside, WIDTH + beside)]
    built = fresh(
        specimen.with_joints({"slope": [ends]}),
        load(None, model).with_set(JOINT, model),
        model,
        mesh="fan",
        dynamic=True,
        gravity=GRAVITY,
        **options,
    )

    def below(x, y):
        return y < low + x * slope - 1e-6

    PartRig(built).hold(where=below)
    states = [yade.O.bodies[number].state for number in built.solver.bodyIds]
    block = [one for one in states if not below(one.pos[0], one.pos[1])]
    start = middle_of(block)
    built.run(math.ceil(0.002 / yade.O.dt))
    way = float((start - middle_of(block)) @ [math.cos(ANGLE), math.sin(ANGLE)])
    gain = GRAVITY * (math.sin(ANGLE) - FRICTION * math.cos(ANGLE))
    return way, 0.5 * gain * (yade.O.iter * yade.O.dt) ** 2


def middle_of(block: list) -> np.ndarray:
    """Mean place of bodies [m]."""
    return np.mean([[one.pos[0], one.pos[1]] for one in block], axis=0)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_block_slides_down_a_joint_steeper_than_its_friction(model):
    way, free = slid(model)
    assert way == pytest.approx(free, rel=1e-3)


def test_damping_holds_a_block_on_a_joint_steeper_than_its_friction():
    way, free = slid("flexible", damping=0.7)
    assert way < 0.3 * free


def test_the_default_follows_from_the_masses_in_run_and_build_alike(square):
    for dynamic, expected in ((False, 0.7), (True, 0.0)):
        assert spec_of(dynamic=dynamic).local_damping == expected
        for model in ("flexible", "jcfpm"):
            assert fresh(square, model=model, dynamic=dynamic).damping == expected


@pytest.mark.parametrize("test", ["sonic", ELASTIC])
def test_tests_without_damping_refuse_it(test):
    refusal(f"damping = 0.0, must not be given for {test}", spec_of, test, damping=0.0)


@pytest.mark.parametrize("value", [-0.1, 1.0, math.nan, "a", True])
def test_damping_out_of_range_is_refused(value):
    refusal("damping = ", spec_of, damping=value)


def test_keys_of_before_stay_and_runs_with_real_masses_have_others():
    plain = spec_of()
    assert plain == spec_of(damping=0.7)
    assert "damping" not in {name for name, value in plain.to_json().items() if value is not None}
    assert plain.key() == RunSpec.from_json(without_damping(plain)).key()
    real = spec_of(dynamic=True)
    before = RunSpec.from_json(without_damping(real))
    assert (before.local_damping, real.local_damping) == (0.7, 0.0)
    assert before.key() != real.key()
    assert before == spec_of(dynamic=True, damping=0.7)


def without_damping(spec: RunSpec) -> dict:
    """Inputs as a version wrote them in which damping could not be chosen."""
    return {name: value for name, value in spec.to_json().items() if name != "damping"}


def test_gravity_against_damping_is_a_doubt():
    real = spec_of(dynamic=True, gravity=9.81, damping=0.3)
    assert "damping = 0.3, is above 0.2 with gravity" in doubts.of_inputs(real.to_json())[0]
    for quiet in (spec_of(dynamic=True, gravity=9.81), spec_of(dynamic=True, damping=0.7)):
        assert doubts.of_inputs(quiet.to_json()) == []


def test_a_rig_tells_of_gravity_against_damping(square):
    rig = PartRig(fresh(square, dynamic=True, gravity=9.81, damping=0.7))
    low = rig.hold(where=lambda x, y: y < 0.1 * SIDE)
    top = rig.hold(where=lambda x, y: y > 0.9 * SIDE)
    rig.drive([top], (0.0, -1.0), against=[low])
    rig.strain_to(1e-7, rate=10.0)
    assert any("with gravity" in line for line in rig.warnings)


@pytest.mark.parametrize(("test", "shape"), [("biaxial", "square"), ("triaxial", "cube")])
def test_a_confined_run_with_real_masses_settles_damped_and_is_loaded_undamped(
    test, shape, request
):
    rock = request.getfixturevalue(shape)
    options = {"confinement": 4e6, "dynamic": True, "rate": 2.0, "max_strain": 1e-4}
    found = flexpm.run(test, rock, "augig-table7", "rigid", **options)
    assert found.curve["axial_stress"][0] == pytest.approx(4e6, rel=0.1)
    assert np.all(np.diff(found.curve["damping_energy"]) == 0.0)
    assert found.curve["axial_stress"][-1] > 5e6


@pytest.mark.parametrize("model", ["flexible", "rigid", "jcfpm"])
def test_a_run_with_real_masses_begins_without_a_shock(model):
    """Its ends come slowly to their velocity, so that it is quasi-static without damping."""
    rock = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
    found = flexpm.run("uniaxial", rock, None, model, dynamic=True)
    factor = found.curve["velocity_factor"]
    assert found.status == "ok"
    assert factor[0] < 0.02 and factor[-1] == 1.0 and np.all(np.diff(factor) >= 0.0)


@pytest.mark.parametrize(
    ("model", "off"), [("rigid", 0.05), pytest.param("flexible", 0.01, marks=pytest.mark.long)]
)
def test_a_solid_with_real_masses_has_the_peak_of_scaled_ones(model, off):
    core = flexpm.Specimen.box(0.009, 0.009, 0.018, seed=1)
    real, scaled = (
        flexpm.run("uniaxial", core, None, model, dynamic=dynamic, rate=0.5)
        for dynamic in (True, False)
    )
    assert real.peak_stress == pytest.approx(scaled.peak_stress, rel=off)
    assert real.youngs_modulus == pytest.approx(scaled.youngs_modulus, rel=0.01)
    assert real.energy_error < 1e-3
    factor = real.curve["velocity_factor"]
    assert factor[0] < 0.02 and factor[-1] == 1.0 and np.all(np.diff(factor) >= 0.0)


@pytest.mark.parametrize(("shape", "unit"), [("square", 1e-4), ("cube", 2e-4)])
def test_a_velocity_rises_from_the_one_before_it(shape, unit, request):
    """A later loading with real masses: on at the same velocity, back from the slowest one."""
    rock = request.getfixturevalue(shape)
    rig = flexpm.rig(fresh(rock, model="rigid", dynamic=True))
    factors = []
    for strain in (2.0, 4.0, 3.0):
        before = len(rig.record)
        rig.strain_to(strain * unit)
        factors.append(rig.record["velocity_factor"][before:])
    assert factors[0][0] < 0.02 and factors[0][-1] == 1.0
    assert np.all(factors[1] == 1.0) and factors[2][0] < 0.02


def test_confining_without_damping_is_refused_with_its_remedy(square):
    rig = flexpm.rig(fresh(square, "augig-table7", "rigid", dynamic=True))
    failure("damping = 0, take 0.2 or above", rig.confine, 4e6)
