# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps of large specimens that wait to be done together: nobody sees that they do."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from yade import wrapper

import flexpm

O = wrapper.Omega()  # noqa: E741 - its name in YADE
SPEED = 1e-6  # of the top [m/step]: points soften and crack beside it at once
OFTEN, SELDOM = 1, 1000  # mirrorPeriod: no step waits, steps wait


@pytest.fixture(scope="module")
def large() -> flexpm.Specimen:
    """More than the caches hold."""
    return flexpm.Specimen.rectangle(0.2, 0.24, 0.01, seed=1)


@pytest.fixture
def pulled(large: flexpm.Specimen) -> Callable[[int], flexpm.Model]:
    def made(mirror_period: int) -> flexpm.Model:
        O.reset()
        model = flexpm.build(large)
        model.solver.mirrorPeriod = mirror_period
        model.solver.ompThreads = 1
        model.add_engines(before=(wrapper.PlatenEngine(velocity=SPEED),))
        return model

    return made


def at_the_end(model: flexpm.Model, bits) -> dict[str, bytes]:
    model.solver.mirrorBodies()
    return bits()


def test_steps_wait_for_a_look(pulled):
    assert pulled(SELDOM).solver.stepsTogether > 1
    O.run(20, True)
    top = max(O.bodies, key=lambda body: body.state.pos[1])
    view = top.shape.displacements
    before = view.copy()
    O.run(3, True)
    assert (view == before).all(), "an array taken before is behind"
    assert (top.shape.displacements != before).any(), "a look does the steps that wait"
    assert (view != before).any()
    for _ in range(8):
        O.step()
    assert (view[:, 1] > before[:, 1] + 8 * SPEED).any(), "no more wait than are done together"


def test_no_step_waits_where_bodies_are_mirrored_at_each(pulled):
    pulled(OFTEN)
    O.run(20, True)
    top = max(O.bodies, key=lambda body: body.state.pos[1])
    view = top.shape.displacements
    before = view.copy()
    O.step()
    assert (view != before).any()


def test_looks_and_changes_between_steps_give_the_bits_of_steps_one_by_one(pulled, bits):
    def course(mirror_period: int) -> tuple[list, dict[str, bytes]]:
        model = pulled(mirror_period)
        solver, seen = model.solver, []
        platens = next(e for e in O.engines if isinstance(e, wrapper.PlatenEngine))
        top = int(np.argmax(model.specimen.centres[:, 1]))
        bond = next(i for i in O.interactions if top in (i.id1, i.id2))
        O.run(117, True)
        seen += [O.bodies[top].shape.positions.tolist(), bond.phys.traction.tolist()]
        O.run(4, True)
        seen += [bond.geom.normal, solver.energies(), solver.cracks()]
        platens.velocity = 0.5 * SPEED
        O.run(12, True)
        solver.damping = 0.6
        O.run(6, True)
        O.interactions.erase(bond.id1, bond.id2)
        del bond
        O.run(3, True)
        O.bodies[top].shape.velocities[:] *= 0.5
        O.run(8, True)
        solver.measurePeriod = 7
        O.run(9, True)
        seen += [solver.unbalanced(), solver.energies(), solver.cracks()]
        O.run(2, True)
        return seen, at_the_end(model, bits)

    expected = course(OFTEN)
    assert sum(expected[0][-1]) > 10, "points crack"
    assert course(SELDOM) == expected


def test_a_scene_saved_while_steps_wait_continues_to_the_same_bits(
    pulled, bits, scene_solver, tmp_path
):
    model = pulled(SELDOM)
    O.run(33, True)
    O.save(str(tmp_path / "scene.bin"))
    O.run(9, True)
    uninterrupted = at_the_end(model, bits)
    O.load(str(tmp_path / "scene.bin"))
    O.run(9, True)
    scene_solver().mirrorBodies()
    assert bits() == uninterrupted


def test_looks_from_another_thread_change_nothing(pulled, bits):
    model = pulled(OFTEN)
    O.run(200, True)
    expected = at_the_end(model, bits)
    model = pulled(SELDOM)
    looks = 0
    O.run(200)
    while O.running:
        assert np.isfinite(O.bodies[looks % 1000].shape.displacements).all()
        looks += 1
    O.wait()
    assert looks > 10
    assert at_the_end(model, bits) == expected
