# SPDX-License-Identifier: GPL-3.0-or-later
"""The static solution of a rig of parts beside the state that it relaxes to, and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refusal
from scenes import fresh

import flexpm

WIDTH, HEIGHT, THICKNESS = 0.012, 0.018, 0.01
AREA = WIDTH * THICKNESS


def made(model: str = "flexible", **options: object) -> flexpm.PartRig:
    specimen = flexpm.Specimen.rectangle(WIDTH, HEIGHT, THICKNESS, seed=3)
    return flexpm.PartRig(fresh(specimen, model=model, **options))


def between_platens(model: str = "flexible", **options: object):
    rig = made(model, **options)
    return rig, [rig.platen(side) for side in range(4)]


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_it_is_the_state_that_the_specimen_relaxes_to_under_pressures(model):
    rig, (floor, right, top, left) = between_platens(model)
    asked = {top: 2e6, right: 1e6}
    state = rig.elastic(asked)
    for part, pressure in asked.items():
        rig.press(part, pressure)
    rig.built.run(4000)
    relaxed = rig.built.snapshot()
    moved = relaxed.positions - relaxed.reference
    largest = np.abs(moved).max()
    np.testing.assert_allclose(state.displacements, moved, atol=1e-3 * largest)
    stresses = relaxed.triangle_stress
    np.testing.assert_allclose(state.triangle_stress, stresses, atol=1e-3 * np.abs(stresses).max())
    for part in (floor, right, top, left):
        np.testing.assert_allclose(state.force(part), part.force, atol=1e-3 * 2e6 * AREA)
        np.testing.assert_allclose(state.displacement(part), part.displacement, atol=1e-3 * largest)
    # from there on nothing is left to do
    again = rig.elastic()
    np.testing.assert_allclose(again.displacements, moved, atol=1e-4 * largest)


def test_forces_of_parts_are_those_asked_for_and_in_balance():
    rig, (floor, right, top, left) = between_platens()
    state = rig.elastic({top: 2e6, right: 1e6})
    assert state.force(top)[1] == pytest.approx(-2e6 * AREA, rel=1e-9)
    assert state.force(right)[0] == pytest.approx(-1e6 * HEIGHT * THICKNESS, rel=1e-9)
    total = np.sum([state.force(part) for part in (floor, right, top, left)], axis=0)
    np.testing.assert_allclose(total, 0.0, atol=1e-9 * 2e6 * AREA)
    assert state.beyond_friction == 0
    means = state.grain_areas @ state.grain_stress / (WIDTH * HEIGHT)
    np.testing.assert_allclose(means, [-1e6, -2e6, 0.0], atol=2e3)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_way_gives_the_load_that_gives_the_way_back(model):
    rig, (floor, _, top, _) = between_platens(model)
    rig.drive(top, (0.0, -1.0), against=floor)
    one = rig.elastic(displacement=1e-6)
    assert one.way == 1e-6
    assert one.load == pytest.approx(-one.force(top)[1], rel=1e-12)
    assert one.load == pytest.approx(one.force(floor)[1], rel=1e-9)
    back = rig.elastic(load=one.load)
    assert back.way == pytest.approx(1e-6, rel=1e-9)
    np.testing.assert_allclose(back.displacements, one.displacements, atol=1e-14)
    assert rig.elastic(displacement=2e-6).load == pytest.approx(2.0 * one.load, rel=1e-6)


def test_what_is_pulled_off_a_plate_bears_nothing():
    rig = made()
    base = rig.hold(box=((0.0, 0.0), (0.6 * WIDTH, 1e-5)))
    right = rig.platen(1)
    rig.drive(right, (1.0, 0.0))
    state = rig.elastic(displacement=1e-6)  # it leaves
    assert state.force(right) == (0.0, 0.0)
    assert np.abs(state.displacements).max() == 0.0
    pushed = rig.elastic(displacement=-1e-6)
    assert pushed.force(right)[0] < 0.0
    assert pushed.force(base)[0] == pytest.approx(-pushed.force(right)[0], rel=1e-9)
    assert pushed.moment(base) != 0.0


def test_weight_is_borne_by_what_holds():
    rig = made(dynamic=True, gravity=9.81)
    base = rig.hold(box=((0.0, 0.0), (WIDTH, 1e-5)))
    density = rig.built.material.law("flexible")["density"]
    weight = density * WIDTH * HEIGHT * THICKNESS * 9.81
    state = rig.elastic()
    assert state.force(base)[1] == pytest.approx(weight, rel=1e-9)
    middle = state.stress_along((0.1 * WIDTH, 0.5 * HEIGHT), (0.9 * WIDTH, 0.5 * HEIGHT))
    assert np.mean(middle.yy) == pytest.approx(-0.5 * weight / AREA, rel=0.1)


def test_a_notch_opens_and_closes_as_the_load_has_it():
    line = [(0.0, 0.5 * HEIGHT), (0.5 * WIDTH, 0.5 * HEIGHT)]
    specimen = flexpm.Specimen.rectangle(WIDTH, HEIGHT, THICKNESS, seed=3).with_joints(
        {"notch": line}
    )
    material = flexpm.materials.load("augig-table7").with_set("joint.notch.open=true")
    rig = flexpm.PartRig(fresh(specimen, material))
    rig.hold(box=((0.0, 0.0), (WIDTH, 1e-5)))
    head = rig.hold(box=((0.0, HEIGHT - 1e-5), (WIDTH, HEIGHT)))
    rig.drive(head, (0.0, 1.0))
    pulled, pushed = rig.elastic(displacement=1e-6), rig.elastic(displacement=-1e-6)
    cut = pulled.cuts
    assert len(cut) > 1
    on = np.isin(pulled.point_contact, cut)
    assert np.all(pulled.point_opening[on] > 0.0)
    assert np.all(pulled.point_traction[on] == 0.0)
    assert np.mean(pushed.point_traction[on, 0]) < 0.0
    assert pulled.load < -0.9 * pushed.load


def test_the_run_goes_on_to_the_same_bits():
    rows = []
    for asks in (False, True):
        rig, (floor, right, top, _) = between_platens()
        rig.press(right, 1e6)
        if asks:
            rig.elastic({top: 3e6})
        rig.drive(top, (0.0, -1.0), against=floor)
        if asks:
            rig.elastic(displacement=1e-6)
        rig.strain_to(2e-6)
        if asks:
            rig.elastic(load=100.0)
        rig.strain_to(3e-6)
        rows.append(rig.record.array.copy())
    np.testing.assert_array_equal(*rows)


def test_a_free_motion_is_named_in_one_line():
    rig = made()
    floor, top = rig.platen(0), rig.platen(2)
    refusal("along x.*fix nodes", rig.elastic, {top: 1e6})
    refusal("driven parts = none", rig.elastic, displacement=1e-6)
    refusal("pressure on a part = -1", rig.elastic, {top: -1.0})
    refusal("must be a table", rig.elastic, [top])
    rig.drive(top, (0.0, -1.0), against=floor)
    refusal("is driven; leave it out", rig.elastic, {top: 1e6})
    refusal("must be left out if a load is given", rig.elastic, displacement=1e-6, load=1.0)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_beam_is_as_stiff_as_when_it_is_loaded(model):
    beam = flexpm.Specimen.rectangle(0.05, 0.012, THICKNESS, seed=1)
    rig = flexpm.PartRig(fresh(beam, model=model))
    rollers = [rig.support((x, 0.0)) for x in (0.005, 0.045)]
    pin = rig.support((0.025, 0.012), pinned=True)
    rig.drive(pin, (0.0, -1.0), against=rollers)
    state = rig.elastic(displacement=1e-6)
    assert state.load == pytest.approx(sum(state.force(one)[1] for one in rollers), rel=1e-9)
    rig.strain_to(2e-7)  # a way of 0.2 um
    slope = np.polyfit(rig.record["displacement"], rig.record["load"], 1)[0]
    assert state.load / 1e-6 == pytest.approx(slope, rel=1e-4)


def test_a_moment_turns_an_end_by_the_angle_that_asks_for_it():
    rig = made()
    base = rig.hold(box=((0.0, 0.0), (WIDTH, 1e-5)))
    head = rig.hold(box=((0.0, HEIGHT - 1e-5), (WIDTH, HEIGHT)))
    rig.rotate(head)
    state = rig.elastic(displacement=1e-5)
    assert state.moment(head) == pytest.approx(state.load, rel=1e-12)
    # a moment alone acts
    np.testing.assert_allclose(state.force(head), 0.0, atol=1e-9 * state.load / WIDTH)
    assert state.moment(base) == pytest.approx(-state.load, rel=1e-6)
    assert rig.elastic(load=state.load).way == pytest.approx(1e-5, rel=1e-9)


def test_the_scale_of_a_loading_is_that_stiffness_whichever_part_is_pinned():
    length, height, span, inner = 0.06, 0.012, 0.048, 0.016
    beam = flexpm.Specimen.rectangle(length, height, 0.01, seed=1)
    found = []
    for pinned in range(4):
        rig = flexpm.PartRig(fresh(beam))
        places = [(0.5 * (length + side * span), 0.0) for side in (-1, 1)]
        places += [(0.5 * (length + side * inner), height) for side in (-1, 1)]
        parts = [rig.support(place, pinned=number == pinned) for number, place in enumerate(places)]
        rig.drive(parts[2:], (0.0, -1.0), against=parts[:2])
        found += [rig.scales().modulus, rig.elastic(displacement=1e-6).load / 1e-6]
    # held once along x: statically determinate, so that it does not matter where
    np.testing.assert_allclose(found, found[0], rtol=1e-3)


def rig_in(dimension: int, width: float, height: float, model: str):
    """A rig of a bar as deep as thick, and what makes a place or direction of its x and height."""
    if dimension == 2:
        bar = flexpm.Specimen.rectangle(width, height, THICKNESS, seed=3)
        return flexpm.PartRig(fresh(bar, model=model)), lambda x, y, _=0.0: (x, y)
    bar = flexpm.Specimen.box(width, THICKNESS, height, seed=3)
    rig = flexpm.PartRig(fresh(bar, "augig-table7", model=model))
    return rig, lambda x, z, y=0.5 * THICKNESS: (x, y, z)


ONE_SIDED = pytest.mark.parametrize(
    ("dimension", "model"), [(2, "flexible"), (2, "rigid"), (3, "flexible"), (3, "rigid")]
)


@ONE_SIDED
def test_a_beam_lifts_off_the_roller_that_would_have_to_pull(dimension, model):
    rig, at = rig_in(dimension, 0.04, 0.008, model)
    far, middle, near = (rig.support(at(x, 0.0), pinned=x == 0.02) for x in (0.004, 0.02, 0.036))
    head = rig.support(at(0.026, 0.008))
    rig.drive(head, at(0.0, -1.0, 0.0), against=(far, middle, near))
    state = rig.elastic(displacement=1e-6)
    assert state.solutions > 1
    up = [state.force(one)[-1] / state.load for one in (far, middle, near)]
    # levers of 6 and 10 mm; in 2D a roller lies on edges near its place, in 3D on lines there
    assert up == pytest.approx([0.0, 0.625, 0.375], abs=0.1 if dimension == 2 else 1e-4)
    assert up[0] == 0.0 and sum(up) == pytest.approx(1.0, rel=1e-4)
    # the load of that way gives it back, half of it half
    assert rig.elastic(load=0.5 * state.load).way == pytest.approx(0.5e-6, rel=1e-6)
    # the roller that has let go does not stiffen it
    alone, at = rig_in(dimension, 0.04, 0.008, model)
    left = [alone.support(at(x, 0.0), pinned=x == 0.02) for x in (0.02, 0.036)]
    alone.drive(alone.support(at(0.026, 0.008)), at(0.0, -1.0, 0.0), against=left)
    assert alone.elastic(displacement=1e-6).load == pytest.approx(state.load, rel=1e-6)


@ONE_SIDED
def test_a_block_that_is_tilted_stands_on_its_edge(dimension, model):
    rig, at = rig_in(dimension, WIDTH, HEIGHT, model)
    length = 0.5 * WIDTH if dimension == 2 else (0.5 * WIDTH, THICKNESS, 0.002)
    halves = [rig.support(at(x * WIDTH, 0.0), length) for x in (0.25, 0.75)]
    head = rig.support(at(0.875 * WIDTH, HEIGHT), pinned=True)
    rig.drive(head, at(0.0, -1.0, 0.0), against=halves)
    state = rig.elastic(displacement=1e-6)
    # a rigid one would press on thrice the distance from the load to the edge, 3/8 of its width
    lifted, pressed = (state.force(one) for one in halves)
    # in 2D both halves lie on the edges that the line between them crosses
    assert 0.0 <= lifted[-1] <= (0.1 * state.load if dimension == 2 else 0.0)
    assert lifted[-1] + pressed[-1] == pytest.approx(state.load, rel=1e-4)
    total = np.sum([state.force(one) for one in (*halves, head)], axis=0)
    np.testing.assert_allclose(total, 0.0, atol=1e-4 * state.load)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_what_is_pulled_off_a_plate_bears_nothing_in_3d(model):
    rig, _ = rig_in(3, WIDTH, HEIGHT, model)
    base = rig.hold(box=((0.0, 0.0, 0.0), (0.6 * WIDTH, THICKNESS, 0.2 * HEIGHT)))
    right = rig.platen(1)
    rig.drive(right, (1.0, 0.0, 0.0), against=base)
    state = rig.elastic(displacement=1e-6)  # it leaves
    assert state.force(right) == state.force(base) == (0.0, 0.0, 0.0)
    assert np.abs(state.positions - state.reference).max() == 0.0
    pushed = rig.elastic(displacement=-1e-6)
    assert pushed.force(right)[0] < 0.0
    assert pushed.force(base)[0] == pytest.approx(-pushed.force(right)[0], rel=1e-4)
    with pytest.raises(flexpm.InputError, match="nothing resists it"):
        rig.elastic(load=1.0)
