# SPDX-License-Identifier: GPL-3.0-or-later
"""The static solution of rigs between ends, beside the states that they come to."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError

WIDTH, HEIGHT, THICKNESS = 0.012, 0.018, 0.01
AREA = WIDTH * THICKNESS


def made(model: str = "flexible", kind: str = "rectangle", **options: object):
    specimen = (
        flexpm.Specimen.rectangle(WIDTH, HEIGHT, THICKNESS, seed=3)
        if kind == "rectangle"
        else flexpm.Specimen.disc(HEIGHT, THICKNESS, seed=3)
    )
    return flexpm.rig(fresh(specimen, model=model), **options)


def moved(state: flexpm.Snapshot) -> np.ndarray:
    """Displacements [m]."""
    return state.positions - state.reference


def close(one: np.ndarray, other: np.ndarray) -> None:
    """Require the same motions to 0.1 % of the largest, but for a way along smooth plates."""
    apart = one - other
    apart[:, 0] -= apart[:, 0].mean()
    np.testing.assert_allclose(apart, 0.0, atol=1e-3 * np.abs(other).max())


def stopped(rig: object) -> flexpm.Snapshot:
    """State to which a rig between ends comes when its upper one stands."""
    rig._move(0.0, 1.0)
    rig.built.run(5000)
    return rig.built.snapshot()


@pytest.mark.parametrize("model", ["flexible", "rigid", "inner"])
def test_it_is_the_state_that_a_pressure_from_all_sides_brings_about(model):
    rig = made(model)
    state = rig.elastic(2e6)
    rig.confine(2e6)
    rig.built.run(3000)
    there = moved(rig.built.snapshot())
    close(moved(state), there)
    means = state.grain_areas @ state.grain_stress / (WIDTH * HEIGHT)
    np.testing.assert_allclose(means[:2], -2e6, rtol=2e-3)
    close(moved(rig.elastic()), there)


@pytest.mark.parametrize("model", ["flexible", "rigid", "inner"])
@pytest.mark.parametrize("pressure", [None, 2e6])
def test_it_is_the_loaded_state_at_rest(model, pressure):
    rig = made(model)
    if pressure:
        rig.confine(pressure)
        rig.built.run(3000)
    rig.strain_to(2e-5)
    there = stopped(rig)
    load = rig.elastic().load
    assert load > 2e-5 * 15e9 * AREA
    fresh = made(model).elastic(pressure, load=load)
    assert fresh.load == pytest.approx(load, rel=1e-9)
    close(moved(fresh), moved(there))
    largest = np.abs(there.grain_stress).max()
    np.testing.assert_allclose(fresh.grain_stress, there.grain_stress, atol=1e-3 * largest)


def test_a_disc_of_rigid_grains_is_that_of_the_steps():
    rig = made("rigid", "disc")
    rig.strain_to(1e-4)
    there = stopped(rig)
    load = rig.elastic().load
    fresh = made("rigid", "disc").elastic(load=load)
    close(moved(fresh), moved(there))


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("tension", [False, True])
def test_its_modulus_is_that_of_the_elastic_solve(model, tension):
    rig = made(model, tension=tension)
    state = rig.elastic(displacement=1e-7)
    young = flexpm.elastic(rig.built.specimen, model=model)["youngs_modulus"]
    if model == "flexible":
        assert state.load / AREA / (1e-7 / HEIGHT) == pytest.approx(young, rel=1e-6)
    else:  # the contacts of its plates give, too
        assert 0.85 * young < state.load / AREA / (1e-7 / HEIGHT) < young
    back = rig.elastic(load=state.load)
    assert back.way == pytest.approx(1e-7, rel=1e-9)
    sign = 1.0 if tension else -1.0
    assert state.grain_stress[:, 1].mean() * sign > 0.0


def test_a_load_beside_a_pressure_is_that_of_the_steps():
    rig = made()
    asked = 3e6 * AREA
    state = rig.elastic(2e6, load=asked)
    rig.confine(2e6)
    rig.stress_to(3e6)
    part = rig.record["axial_stress"][-1] * AREA / asked
    there = moved(rig.built.snapshot())
    scaled = moved(rig.elastic(load=asked * part))
    np.testing.assert_allclose(scaled, there, atol=0.01 * np.abs(there).max())
    means = state.grain_areas @ state.grain_stress / (WIDTH * HEIGHT)
    np.testing.assert_allclose(means, [-2e6, -3e6, 0.0], atol=0.01 * 3e6)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_piece_that_is_free_to_move_is_named_in_one_line(model):
    cut = [(0.0, 0.5 * HEIGHT), (WIDTH, 0.5 * HEIGHT)]
    specimen = flexpm.Specimen.rectangle(WIDTH, HEIGHT, THICKNESS, seed=3)
    material = flexpm.materials.load("augig-table7").with_set("joint.slit.open=true")
    built = fresh(specimen.with_joints({"slit": cut}), material, model=model)
    rig = flexpm.rig(built, tension=True)
    refusal("elastic: .*along x", rig.elastic, displacement=1e-7)


def test_a_disc_lies_against_ever_more_of_its_plates():
    fine = flexpm.Specimen.disc(HEIGHT, THICKNESS, diameters=(4e-4, 6e-4), seed=3)
    rig = flexpm.rig(fresh(fine))
    least, little, more = (rig.elastic(displacement=way) for way in (1e-9, 1e-6, 1.6e-4))
    # nothing pulls across the gaps before the rim: a disc on its tips is linear
    assert little.load == pytest.approx(1e3 * least.load, rel=1e-9)
    assert more.load > 1.2 * 160.0 * little.load > 0.0
    middle = more.stress_at([(0.0, 0.0)])
    # stress that a concentrated load would have there [Pa]; grains are few
    splitting = 2.0 * more.load / (np.pi * HEIGHT * THICKNESS)
    assert middle.xx[0] == pytest.approx(splitting, rel=0.12)
    assert middle.yy[0] == pytest.approx(-3.0 * splitting, rel=0.12)


def test_the_scene_is_not_changed():
    rows = []
    for asks in (False, True):
        rig = made("rigid")
        if asks:
            rig.elastic(1e6, displacement=1e-7)
        rig.strain_to(2e-5)
        if asks:
            rig.elastic(load=100.0)
            rig.elastic(1e6)
        rig.strain_to(3e-5)
        rows.append(rig.record.array.copy())
    np.testing.assert_array_equal(*rows)


def test_what_it_cannot_do_is_refused_in_one_line():
    rig = made()
    for asked, told in (
        (lambda: rig.elastic(-1.0), "elastic: pressure = -1.0 Pa, must be >= 0"),
        (lambda: rig.elastic(displacement=np.nan), "elastic: displacement = nan m"),
        (
            lambda: rig.elastic(displacement=1e-7, load=1.0),
            "elastic: displacement = 1e-07, must be left out",
        ),
        (lambda: rig.elastic(load="a"), "elastic: load = 'a'"),
    ):
        with pytest.raises(InputError) as refused:
            asked()
        assert str(refused.value).startswith(told), str(refused.value)
    disc = made("flexible", "disc")
    refusal("elastic: pressure on a disc = 1000000 Pa", disc.elastic, 1e6)
