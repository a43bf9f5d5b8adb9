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
    solver = pulled(SELDOM).solver
    together = solver.stepsTogether
    assert together > 1
    waiting = []
    for _ in range(20):
        O.step()
        waiting.append(solver.stepsWaiting)
    # discs that come to touch are looked for at step 10 and 20
    assert waiting == [step % 10 % together for step in range(1, 21)]
    bond = next(iter(O.interactions))
    for look in (solver.energies, solver.cracks, solver.snapshot, lambda: bond.geom.normal):
        O.step()
        assert solver.stepsWaiting == 1
        look()
        assert solver.stepsWaiting == 0


def test_no_step_waits_where_bodies_are_mirrored_at_each(pulled):
    solver = pulled(OFTEN).solver
    O.step()
    assert solver.stepsWaiting == 0


@pytest.mark.parametrize("of_grain", [True, False])
def test_no_step_waits_once_a_script_has_taken_an_array(pulled, of_grain):
    solver = pulled(SELDOM).solver
    O.run(3, True)
    assert solver.stepsWaiting == 3
    top = max(O.bodies, key=lambda body: body.state.pos[1])
    bond = next(i for i in O.interactions if top.id in (i.id1, i.id2))
    view = top.shape.displacements if of_grain else bond.phys.opening
    assert solver.stepsTogether == 1
    assert solver.stepsWaiting == 0
    before = view.copy()
    O.step()
    assert solver.stepsWaiting == 0
    assert (view != before).any()


def test_looks_and_changes_between_steps_give_the_bits_of_steps_one_by_one(pulled, bits):
    def course(mirror_period: int) -> tuple[list, dict[str, bytes]]:
        model = pulled(mirror_period)
        solver, seen = model.solver, []
        platens = next(e for e in O.engines if isinstance(e, wrapper.PlatenEngine))
        top = int(np.argmax(model.specimen.centres[:, 1]))
        bond = next(i for i in O.interactions if top in (i.id1, i.id2))
        O.run(117, True)
        seen += [bond.geom.contactPoint, bond.phys.traction.tolist()]
        O.run(4, True)
        seen += [bond.geom.normal, solver.energies(), solver.cracks()]
        platens.velocity = 0.5 * SPEED
        O.run(12, True)
        solver.damping = 0.6
        O.run(6, True)
        O.interactions.erase(bond.id1, bond.id2)
        del bond
        O.run(8, True)
        solver.measurePeriod = 7
        O.run(9, True)
        assert mirror_period == OFTEN or solver.stepsTogether > 1
        O.bodies[top].shape.velocities[:] *= 0.5
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
    assert model.solver.stepsWaiting == 3
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
    bonds, looks = list(O.interactions), 0
    O.run(200)
    while O.running:
        assert np.linalg.norm(bonds[looks % 1000].geom.normal) == pytest.approx(1.0)
        looks += 1
    O.wait()
    assert model.solver.stepsTogether > 1
    assert looks > 10
    assert at_the_end(model, bits) == expected
