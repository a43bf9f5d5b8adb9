# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver in YADE's scene: erased bodies, the collider, numbers that are not finite."""

from __future__ import annotations

import re

import numpy as np
import pytest
from refusals import refusal
from yade import wrapper

import flexpm

O = wrapper.Omega()  # noqa: E741 - its name in YADE


def bonds_of(body: int) -> list:
    return [i for i in O.interactions if i.isReal and body in (i.id1, i.id2)]


def resultant(body: int) -> float:
    """Largest component of the sum of a grain's nodal forces over the largest nodal force.

    Forces of the grain's elements balance, so what is left is of its contacts.
    """
    forces = O.bodies[body].shape.forces
    return np.abs(forces.sum(axis=0)).max() / np.abs(forces).max()


def test_an_erased_bond_carries_nothing_from_the_next_step(make):
    model = make(velocity=-5e-9)
    model.run(300)
    *others, last = bonds_of(20)
    assert len(others) >= 3
    for bond in others:
        O.interactions.erase(bond.id1, bond.id2)
    O.step()
    # force of one bond alone: its tractions times its areas
    pull = last.phys.traction.T @ last.phys.area
    found = O.bodies[20].shape.forces.sum(axis=0)
    assert np.linalg.norm(found) == pytest.approx(np.linalg.norm(pull), rel=1e-9)
    assert np.linalg.norm(pull) > 0.0


def test_a_grain_without_bonds_is_free(make):
    model = make(velocity=-5e-9)
    model.run(300)
    assert resultant(20) > 1e-6
    for bond in bonds_of(20):
        O.interactions.erase(bond.id1, bond.id2)
    O.step()
    assert resultant(20) < 1e-11


def test_an_erased_grain_leaves_its_neighbours_alone(make):
    model = make(velocity=-5e-9)
    model.run(300)
    neighbours = {i.id1 + i.id2 - 20 for i in bonds_of(20)}
    # neighbours that keep a bond with the erased grain only
    lonely = min(neighbours)
    for bond in bonds_of(lonely):
        if 20 not in (bond.id1, bond.id2):
            O.interactions.erase(bond.id1, bond.id2)
    O.bodies.erase(20)
    assert O.bodies[20] is None
    O.step()
    assert resultant(lonely) < 1e-11
    stopped = wrapper.LaguerreCell(grain=20)
    place = stopped.positions.copy()
    O.run(50, True)
    assert (stopped.positions == place).all()


def test_a_grain_without_bonds_can_be_erased(make):
    model = make(velocity=-5e-9)
    model.run(100)
    for bond in bonds_of(20):
        O.interactions.erase(bond.id1, bond.id2)
    O.bodies[20].shape.velocities[:] = 1e-9
    O.step()
    O.bodies.erase(20)
    ghost = wrapper.LaguerreCell(grain=20)
    place = ghost.positions.copy()
    O.run(5, True)
    assert (ghost.positions == place).all()


def collider():
    return next(e for e in O.engines if isinstance(e, wrapper.InsertionSortCollider))


def test_the_collider_is_idle_while_nothing_moves_far(make):
    model = make(velocity=-5e-9)
    model.run(50)
    runs = collider().numAction
    model.run(1000)
    assert collider().numAction == runs


def test_the_collider_runs_when_a_grain_has_moved(make):
    model = make()
    model.run(100)
    runs = collider().numAction
    speed = 0.2 * model.specimen.mean_diameter / 1000
    cell = O.bodies[20].shape
    cell.held[:] = 1
    cell.velocities[:] = (speed, 0.0)
    model.run(1000)
    later = collider().numAction
    assert 2 <= later - runs <= 10
    bound = O.bodies[20].bound
    assert bound.min[0] <= cell.positions[:, 0].min() <= cell.positions[:, 0].max() <= bound.max[0]


@pytest.mark.parametrize("grain", [0, 20])
def test_a_number_that_is_not_finite_stops_the_run(make, grain):
    model = make(velocity=-5e-9)
    model.run(130)
    O.bodies[grain].shape.velocities[2, 1] = np.nan
    with pytest.raises(RuntimeError, match="not a finite number") as caught:
        model.run(1000)
    found = re.search(
        r"(force|velocity) of node \d+ of grain (\d+) .* at step (\d+)", str(caught.value)
    )
    assert found, str(caught.value)
    assert 130 < int(found[3]) <= 230
    # the fault spreads from grain to grain: the one named is among those it has reached
    named = O.bodies[int(found[2])].shape
    assert not (np.isfinite(named.forces).all() and np.isfinite(named.velocities).all())


@pytest.mark.parametrize("name", ["measurePeriod", "mirrorPeriod", "touchPeriod", "checkPeriod"])
def test_a_period_of_no_steps_is_refused(make, name):
    model = make()
    setattr(model.solver, name, 0)
    with pytest.raises(RuntimeError, match=rf"GrainSolver\.{name} = 0, must be >= 1 step"):
        model.run(1)


def test_a_scene_has_room_for_one_solver(make, specimen):
    make()
    refusal(r"GrainSolver.*O\.reset", flexpm.build, specimen)
    assert len(O.bodies) == len(specimen.discs), "nothing was added"


def test_engines_put_in_during_a_step_run_from_the_next(make, monkeypatch):
    model = make()
    late = wrapper.PyRunner(command="None", iterPeriod=1, initRun=True)
    monkeypatch.setattr("__main__.put_in", lambda: model.add_engines(last=(late,)), raising=False)
    once = wrapper.PyRunner(command="put_in()", iterPeriod=1, nDo=1, initRun=True)
    model.add_engines(last=(once,))
    model.run(1)
    assert late.nDone == 0
    model.run(1)
    assert late.nDone == 1


def test_bodies_of_a_script_are_kept(specimen):
    O.reset()
    from yade import utils

    O.bodies.append(utils.sphere((0.5, 0.5, 0.0), 0.001))
    model = flexpm.build(specimen)
    assert model.solver.bodyIds[0] == 1
    model.add_engines(before=(wrapper.EndDisplacementController(velocity=-5e-9),))
    model.run(200)
    assert tuple(O.bodies[1].state.pos)[:2] == tuple(
        O.bodies[1].shape.positions[O.bodies[1].shape.vertices]
    )
