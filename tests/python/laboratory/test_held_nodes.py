# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that a rig holds, moves or turns: forces, moments, works, same bits, what is refused."""

from __future__ import annotations

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.rigs.part_rig import PartRig
from flexpm.rigs.parts import HeldNodes
from flexpm.runs.loading_rate import Loading

LENGTH, HEIGHT, END = 0.04, 0.012, 0.004
STRONG = flexpm.materials.load("augig-table7").with_set(
    tensile_strength=1e9,
    cohesion=1e9,
    tensile_fracture_energy=1e6,
    shear_fracture_energy=1e6,
)
MODELS = ("flexible", "rigid")


@pytest.fixture(scope="module")
def bar() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(LENGTH, HEIGHT, thickness=0.01, seed=1)


def held(bar: flexpm.Specimen, model: str, threads: int = 1) -> tuple[PartRig, list[HeldNodes]]:
    """A bar whose ends are held."""
    rig = PartRig(fresh(bar, STRONG, model=model, threads=threads))
    left = rig.hold(box=((0.0, 0.0), (END, HEIGHT)))
    return rig, [left, rig.hold(where=lambda x, y: x > LENGTH - END)]


def balance_of(rig: PartRig) -> float:
    """What the energies of the last row lack, over the work [-]."""
    record = rig.record
    kinds = ("kinetic", "elastic", "damage", "friction", "damping")
    kept = sum(record[f"{kind}_energy"][-1] for kind in kinds)
    work = record["boundary_work"][-1]
    return (work + rig.initial_energy - kept) / work


@pytest.mark.parametrize("model", MODELS)
def test_pulled_ends_have_equal_forces_and_their_work_is_the_energy(bar, model):
    rig, (left, right) = held(bar, model)
    rig.displacement_of("way", right, (1.0, 0.0))
    rig.drive([right], (1.0, 0.0), against=[left])
    rig.strain_to(1e-6, rate=5e-4)
    record = rig.record
    load, way = record["load"][-1], record["displacement"][-1]
    assert right.force[0] == pytest.approx(-left.force[0], rel=0.01)
    assert load == pytest.approx(0.5 * (right.force[0] - left.force[0]), rel=1e-9)
    assert load / way == pytest.approx(rig.scales().modulus, rel=0.01)
    assert record["way"] == pytest.approx(record["displacement"], rel=1e-9)
    assert right.displacement[0] == pytest.approx(way, rel=1e-9)
    assert right.work == pytest.approx(0.5 * load * way, rel=0.01)
    assert left.work == 0.0
    assert abs(balance_of(rig)) < 1e-9
    # stiffness of a bar between the sets, in which the sides are free
    young = flexpm.elastic(bar, STRONG, model=model)["youngs_modulus"]
    assert load / way * (LENGTH - 2.0 * END) / (HEIGHT * 0.01) == pytest.approx(young, rel=0.2)


@pytest.mark.parametrize("model", MODELS)
def test_a_turned_end_bears_a_moment_alone(bar, model):
    rig, (left, right) = held(bar, model)
    rig.rotate([right])
    rig.strain_to(1e-5, rate=1e-3)
    record = rig.record
    assert right.angle == pytest.approx(record["displacement"][-1], rel=1e-9)
    assert right.moment == pytest.approx(record["load"][-1], rel=1e-9)
    assert right.moment == pytest.approx(rig.scales().modulus * right.angle, rel=0.01)
    assert left.moment == pytest.approx(-right.moment, rel=0.01)
    assert np.hypot(*right.force) * LENGTH < 0.01 * right.moment
    assert right.work == pytest.approx(0.5 * right.moment * right.angle, rel=0.01)
    assert abs(balance_of(rig)) < 1e-9
    # a beam of this stiffness; where the sets end is not sharper than half a grain
    young = flexpm.elastic(bar, STRONG, model=model)["youngs_modulus"]
    bending = right.moment / right.angle * (LENGTH - 2.0 * END)
    assert bending == pytest.approx(young * 0.01 * HEIGHT**3 / 12.0, rel=0.35)


@pytest.mark.parametrize("model", MODELS)
def test_ends_turn_about_a_point_and_against_each_other(bar, model):
    rig, (left, right) = held(bar, model)
    rig.rotate([right], [left], about=(LENGTH, HEIGHT / 2))
    rig.strain_to(1e-5, rate=1e-3)
    assert right.position == left.position == (LENGTH, HEIGHT / 2)
    assert left.angle == -right.angle
    assert rig.record["load"][-1] == pytest.approx(right.moment - left.moment, rel=1e-9)
    # the left end goes up, the right one does not: that takes a shear force
    assert abs(right.force[1]) * LENGTH > 0.5 * right.moment
    assert right.force[1] == pytest.approx(-left.force[1], rel=0.01)
    assert abs(balance_of(rig)) < 1e-9


def test_nodes_move_at_a_given_velocity(bar):
    rig, (left, right) = held(bar, "flexible")
    right.move((1e-10, 2e-10), spin=1e-9)
    rig.built.run(200)
    assert right.displacement == pytest.approx((2e-8, 4e-8))
    assert right.angle == pytest.approx(2e-7)
    assert left.displacement == (0.0, 0.0)
    assert right.force[0] > 0.0


@pytest.mark.parametrize("model", MODELS)
def test_other_threads_and_a_saved_scene_give_the_same_bits(bar, tmp_path, model):
    records = []
    for threads in (1, 2):
        rig, (left, right) = held(bar, model, threads)
        rig.rotate([right], strength=0.5)
        rig.start(Loading(kind="waiting"))
        for step in range(600):
            if threads == 2 and step == 300:
                yade.O.save(str(tmp_path / "scene.bin"), quiet=True)
                yade.O.load(str(tmp_path / "scene.bin"), quiet=True)
                rig.built.rebind()
                rig = PartRig(rig.built)
                right = rig.hold(where=lambda x, y: x > LENGTH - END)
                left = rig.hold(box=((0.0, 0.0), (END, HEIGHT)))
                rig.rotate([right], strength=0.5)
            yade.O.step()
        records.append([*rig.record.array[-1], *right.force, right.moment, right.work, left.moment])
        assert right.moment > 0.0
    assert np.array_equal(*records, equal_nan=True)


def test_nodes_that_cannot_be_held_are_refused_in_one_line(bar):
    rig, (left, _) = held(bar, "rigid")
    plate = rig.support((LENGTH / 2, 0.0))
    for wrong, message in (
        (lambda: rig.hold(), "hold: give exactly one of box, disc and where"),
        (lambda: rig.hold(box=((0, 0), (1, 1)), disc=((0, 0), 1)), "hold: give exactly one of"),
        (lambda: rig.hold(disc=((0, 0), -1.0)), "hold: radius of the disc = -1.0 m"),
        (
            lambda: rig.hold(where=lambda x, y: x),
            r"hold: where\(\) must return one bool per position, got float64 of shape",
        ),
        (lambda: rig.hold(box=((0, 0), (1, 1)), axes="z"), "hold: axes = 'z', must be x, y or xy"),
        (lambda: rig.hold(box=((1, 1), (2, 2))), "hold: nodes of a set = 0"),
        (lambda: rig.hold(box=((0, 0), (END, HEIGHT))), "fixed already"),
        (lambda: rig.hold(disc=((LENGTH / 2, 0.001), 0.002)), "lies on a plate"),
        (lambda: rig.support((0.001, 0.0)), "support: .* lies on a plate"),
        (lambda: rig.platen(3), "platen: .* lies on a plate"),
        (
            lambda: rig.rotate([plate]),
            "rotate: part = support at .* must be a set of held nodes, from hold",
        ),
        (lambda: left.move((float("nan"), 0.0)), "move: velocity: x = nan m/s, must be finite"),
    ):
        refusal(message, wrong)
