# SPDX-License-Identifier: GPL-3.0-or-later
"""Friction of cracked contacts that falls with their slip: keys, laws of pairs, runs, warnings."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal
from stopped_runs import same, taken_up

import flexpm
from flexpm import Specimen
from flexpm.materials.material import Material, load
from flexpm.materials.mixing import description, from_description, pair_materials
from flexpm.models import assembly
from flexpm.results import doubts

FRICTION, RESIDUAL, LENGTH = 0.5, 0.3, 4e-5
PRESSURE, MIDDLE = 2e6, 0.008
JOINT = {"normal_stiffness": 1.8e13, "shear_stiffness": 5e12, "friction": FRICTION}
FALLS = {"residual_friction": RESIDUAL, "slip_length": LENGTH}


def rock(**values: float) -> Material:
    return load("augig-table7").with_set({"friction": FRICTION, **FALLS, **values})


def with_joint(**values: float) -> Material:
    law = {f"joint.plane.{key}": value for key, value in (JOINT | values).items()}
    return load("augig-table7").with_set(law)


def two_minerals(*interfaces, soft=None, **values) -> Material:
    kinds = [{"name": "a", "fraction": 0.5}, {"name": "b", "fraction": 0.5, **(soft or {})}]
    return dataclasses.replace(rock(**values), minerals=kinds, interfaces=interfaces)


def test_the_solver_gets_both_keys_and_zeros_without_them():
    found = assembly.grain_material(rock(), "flexible")
    assert (found.residualFriction, found.slipLength) == (RESIDUAL, LENGTH)
    found = assembly.grain_material(load("augig-table7"), "flexible")
    assert (found.residualFriction, found.slipLength) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"residual_friction": 0.51}, "residual_friction = 0.51, must be <= the friction 0.5"),
        ({"residual_friction": -0.1}, "residual_friction = -0.1, must be >= 0"),
        ({"residual_friction": None}, "residual_friction is missing; slip_length needs it"),
        ({"slip_length": None}, "slip_length is missing; residual_friction needs it"),
        ({"slip_length": 0.0}, "slip_length = 0.0 m, must be > 0"),
        ({"slip_length": -1e-5}, "slip_length = .*e-05 m, must be > 0"),
        ({"slip_length": math.nan}, "slip_length = nan"),
    ],
)
def test_values_that_are_refused(values, words):
    refusal(words, rock, **values)
    of_joint = FALLS | values
    refusal(words, lambda: with_joint(**of_joint).joint_laws())


def test_a_residual_friction_below_the_dilation_of_a_joint_is_refused():
    dilating = {"dilation_angle": 20.0, "dilation_slip": 1e-4, **FALLS}
    words = r"residual_friction = 0.3, must be >= the tangent of the dilation angle, 0.364; raise"
    refusal(words, with_joint(**dilating).joint_laws)
    raised = dilating | {"residual_friction": 0.37}
    assert with_joint(**raised).joint_laws()[0]["residual_friction"] == 0.37


def test_a_notch_has_the_residual_friction_of_the_rock():
    (notch,) = rock().with_set({"joint.slot.open": True}).joint_laws()
    assert {key: notch[key] for key in FALLS} == FALLS
    (rough,) = rock().with_set({"joint.slot.open": True, "joint.slot.friction": 0.1}).joint_laws()
    assert rough["residual_friction"] is None


def test_a_pair_has_the_smaller_values_of_its_minerals():
    soft = {"friction": 0.4, "residual_friction": 0.35, "slip_length": 1e-5}
    pair = pair_materials(two_minerals(soft=soft), "flexible")[1]
    assert (pair.friction, pair.residual_friction, pair.slip_length) == (0.4, RESIDUAL, 1e-5)
    # a mineral without residual friction keeps its own
    slippery = {"friction": 0.2, "residual_friction": None, "slip_length": None}
    pair = pair_materials(two_minerals(soft=slippery), "flexible")[1]
    assert (pair.friction, pair.residual_friction, pair.slip_length) == (0.2, 0.2, LENGTH)
    own = {"pair": ["a", "b"], "residual_friction": 0.1, "slip_length": 1e-6}
    pair = pair_materials(two_minerals(own), "flexible")[1]
    assert (pair.friction, pair.residual_friction, pair.slip_length) == (FRICTION, 0.1, 1e-6)
    refusal(
        "mineral b: material residual_friction = 0.3, must be <= the friction 0.2",
        lambda: pair_materials(two_minerals(soft={"friction": 0.2}), "flexible"),
    )
    factor = {"pair": ["a", "b"], "factor": {"slip_length": 2.0}}
    refusal("factor.slip_length, must not be given; give slip_length", two_minerals, factor)


@given(st.floats(0.0, FRICTION), st.floats(1e-9, 1.0), st.sampled_from(["flexible", "rigid"]))
def test_a_description_gives_the_same_law_back(residual, length, model):
    own = {"pair": ["a", "b"], "residual_friction": 0.5 * residual}
    one = two_minerals(own, residual_friction=residual, slip_length=length).with_set(
        {f"joint.plane.{key}": value for key, value in (JOINT | FALLS).items()}
    )
    found = {"name": one.name, **description(one, model)}
    assert description(from_description(found, model), model) | {"name": one.name} == found


def test_the_keys_are_absent_without_them():
    assert not {*FALLS} & {*description(load("augig-table7"))}
    assert description(rock().with_set(["residual_friction=none", "slip_length=none"])) == (
        description(load("augig-table7").with_set({"friction": FRICTION}))
    )


def test_a_slip_length_is_a_length_of_the_grains():
    own = {"pair": ["a", "b"], "residual_friction": 0.1, "slip_length": 1e-6}
    one = two_minerals(own, soft={"slip_length": 2e-5})
    fine = one.at_grain_size(0.5 * one.made_for.mean_diameter)
    assert fine.slip_length == pytest.approx(0.5 * LENGTH)
    assert fine.minerals[1].changes["slip_length"] == pytest.approx(1e-5)
    assert fine.interfaces[0].values["slip_length"] == pytest.approx(5e-7)
    assert fine.residual_friction == RESIDUAL


def test_models_of_yade_do_not_use_the_keys():
    spheres = load("augig-calibrated-rigid")
    values = {"friction": FRICTION, **FALLS}
    with pytest.warns(UserWarning, match="no effect, model jcfpm") as caught:
        changed = spheres.with_set(values, "jcfpm")
    assert len(caught) == 2
    assert changed.residual_friction is None


@pytest.mark.parametrize("pressure", ["confinement", "normal_stress"])
def test_friction_that_falls_faster_than_its_contact_unloads_is_told(pressure):
    law = rock().law()
    least = (FRICTION - RESIDUAL) * 40e6 / (law["shear_ratio"] * law["normal_stiffness"])
    for share, lines in ((0.99, 1), (1.01, 0)):
        described = {"name": "rock", **description(rock(slip_length=share * least))}
        inputs = {"material": described, "model": "flexible", pressure: 40e6}
        found = doubts.of_slip_lengths(inputs)
        assert len(found) == lines
        assert all("slip_length" in line and "40 MPa" in line for line in found)
        assert doubts.of_slip_lengths(inputs | {"model": "jcfpm"}) == []
        assert doubts.of_slip_lengths(inputs | {pressure: None}) == []
    of_joint = {"name": "rock", **description(with_joint(**FALLS))}
    inputs = {"material": of_joint, "model": "rigid", pressure: 1.1e9}
    (line,) = doubts.of_slip_lengths(inputs)
    assert line.startswith("joint plane slip_length = 4e-05 m")


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_joint_loses_friction_as_it_slides(model):
    cut = Specimen.rectangle(0.024, 2.0 * MIDDLE, thickness=0.01, seed=1).with_joints(
        {"plane": [(0.0, MIDDLE), (0.024, MIDDLE)]}
    )
    result = flexpm.run(
        *("shear", cut, with_joint(**FALLS), model),
        normal_stress=PRESSURE,
        max_displacement=1.2 * LENGTH,
        report=False,
    )
    ways, friction = result.curve["shear_displacement"], result.curve["shear_stress"] / PRESSURE
    peak = int(friction.argmax())
    # within 1 %, since the joint begins to slide at its ends
    assert friction[peak] == pytest.approx(FRICTION, rel=0.01)
    # of the displacement, deformation takes a part in proportion to the stress
    slip = ways - friction / friction[peak] * ways[peak]
    falls = (slip > 0.1 * LENGTH) & (slip < 0.9 * LENGTH)
    slope = np.polyfit(slip[falls], friction[falls], 1)[0]
    assert slope == pytest.approx(-(FRICTION - RESIDUAL) / LENGTH, rel=0.01)
    assert friction[-1] == pytest.approx(RESIDUAL, rel=1e-3)
    assert result.energy_error < 1e-4


CRUSHED = {
    "2D": ("uniaxial", lambda: Specimen.rectangle(0.01, 0.02, 0.08, seed=1), {"rate": 4.0}),
    "3D": (
        "triaxial",
        lambda: Specimen.cylinder(0.01, 0.016, seed=1),
        {"rate": 4.0, "confinement": 2e6, "max_strain": 1.5e-2},
    ),
}


@pytest.mark.parametrize("dimension", CRUSHED)
def test_crushed_rock_goes_on_from_a_saved_scene_to_the_same_bits(tmp_path, monkeypatch, dimension):
    """Equal frictions change no bit of a run without the keys, and a smaller one does."""
    test, make, options = CRUSHED[dimension]
    specimen = make()
    name = "augig3d-calibrated" if dimension == "3D" else "augig-table7"
    plain = load(name)
    asked = {"report": False, **options}
    run = {"material": plain, **asked}
    whole = flexpm.run(test, specimen, **run)
    equal = plain.with_set(residual_friction=plain.friction, slip_length=1e-5)
    assert same(whole, flexpm.run(test, specimen, material=equal, **asked))
    weaker = {"material": plain.with_set(residual_friction=0.1, slip_length=1e-4), **asked}
    weakened = flexpm.run(test, specimen, **weaker)
    assert not same(whole, weakened)
    # at four times the rate
    assert weakened.energy_error < 2e-3
    stop = weakened.cracks[len(weakened.cracks) // 2].step + 100
    again = taken_up(monkeypatch, tmp_path / "run", stop, test, specimen, **weaker)
    assert same(weakened, again)


def test_the_keys_are_inputs_of_a_run():
    specimen = Specimen.rectangle(0.01, 0.02, 0.08, seed=1)
    result = flexpm.run("uniaxial", specimen, rock(), max_strain=1e-5, report=False)
    assert {key: result.material[key] for key in FALLS} == FALLS
    assert result.inputs["material"]["slip_length"] == LENGTH
