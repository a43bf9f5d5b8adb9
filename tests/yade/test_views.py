# SPDX-License-Identifier: GPL-3.0-or-later
"""What bodies and interactions show of the solver's arrays, and what scripts can write there."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from yade import wrapper

import flexpm

O = wrapper.Omega()  # noqa: E741 - its name in YADE


def bonds() -> list:
    return [i for i in O.interactions if i.isReal]


def test_grains_are_bodies_and_bonds_are_interactions(make):
    model = make()
    counts = model.solver.counts()
    assert len(O.bodies) == counts["grains"] == len(model.specimen.discs)
    assert len(bonds()) == counts["contacts"]
    assert all(isinstance(b.shape, wrapper.LaguerreCell) for b in O.bodies)
    assert sum(len(b.shape.positions) for b in O.bodies) == counts["nodes"]
    assert sum(len(b.shape.triangles) for b in O.bodies) == counts["triangles"]


def test_bodies_follow_the_centre_nodes(half_broken):
    for body in O.bodies:
        cell = body.shape
        centre = cell.vertices
        assert tuple(body.state.pos)[:2] == tuple(cell.positions[centre])
        assert tuple(body.state.vel)[:2] == tuple(cell.velocities[centre])
        assert body.state.pos[2] == 0.0
    disc = half_broken.specimen.discs[7, :2]
    cell = O.bodies[half_broken.solver.bodyIds[7]].shape
    start = cell.positions[cell.vertices] - cell.displacements[cell.vertices]
    assert start == pytest.approx(disc, abs=1e-17)


def centre_of(body) -> tuple:
    return tuple(body.shape.positions[body.shape.vertices])


def test_bodies_follow_when_a_script_wants_them(make):
    model = make(velocity=-5e-9)
    model.solver.mirrorPeriod = 10
    model.run(10)
    body = O.bodies[3]
    shown = tuple(body.state.pos)[:2]
    assert shown == centre_of(body)
    model.run(9)
    assert tuple(body.state.pos)[:2] == shown != centre_of(body)
    model.solver.mirrorBodies()
    assert tuple(body.state.pos)[:2] == centre_of(body)


@pytest.mark.parametrize("test", ["tension", "brazilian"])
def test_bodies_are_where_a_test_has_left_their_grains(test):
    O.reset()
    size = {"brazilian": {"diameter": 12e-3}}.get(test, {"width": 9e-3, "height": 12e-3})
    size["thickness"] = 0.01
    shape = flexpm.Specimen.disc if test == "brazilian" else flexpm.Specimen.rectangle
    flexpm.run(test, shape(**size, seed=1), model="rigid", rate=4.0)
    assert all(tuple(b.state.pos)[:2] == centre_of(b) for b in O.bodies)
    solver = next(e for e in O.engines if type(e).__name__ == "GrainSolver")
    assert solver.mirrorPeriod == 1, "a script may go on"


def test_a_velocity_written_by_a_script_moves_the_node_in_the_next_step(either):
    model = either()
    cell = O.bodies[3].shape
    velocities, displacements, forces = cell.velocities, cell.displacements, cell.forces
    positions = cell.positions
    assert velocities.shape == positions.shape
    start, way = positions.copy(), (3e-9, -2e-9, 1e-9)[: positions.shape[1]]
    assert not displacements.any() and not forces.any()
    velocities[0] = way
    O.step()
    # the views are the solver's own memory: nothing was read again
    assert tuple(displacements[0]) == way
    assert cell.positions[0] == pytest.approx(start[0] + way, rel=1e-15)
    assert forces[0] @ way < 0.0, "the grain resists"
    state = model.snapshot()
    first = sum(len(O.bodies[b].shape.positions) for b in range(3))
    assert (state.forces[first : first + len(forces)] == forces).all()
    assert (state.positions[first : first + len(forces)] == cell.positions).all()


def test_a_held_node_keeps_the_velocity_that_a_script_gives_it(either):
    either()
    cell = O.bodies[3].shape
    velocity = np.array((1e-9, 0.0, -1e-9)[: cell.positions.shape[1]])
    cell.held[0] = 1
    cell.velocities[0] = velocity
    O.run(25, True)
    assert cell.displacements[0] == pytest.approx(25.0 * velocity, rel=1e-12)
    cell.held[0] = 0
    O.run(50, True)
    assert cell.velocities[0, 0] != 1e-9


def test_results_cannot_be_written(either):
    either()
    cell, bond = O.bodies[0].shape, bonds()[0]
    phys, geom = bond.phys, bond.geom
    of_solids = (phys.forces, phys.traction, geom.corners) if cell.positions.shape[1] == 3 else ()
    for view in (cell.positions, cell.forces, phys.opening, phys.cracked, *of_solids):
        with pytest.raises(ValueError, match="read-only"):
            view[:] = 1


def test_views_keep_their_memory_alive(make):
    make()
    velocities = O.bodies[0].shape.velocities
    velocities[:] = 4.0
    O.reset()
    assert (velocities == 4.0).all()


def test_bonds_show_their_points(half_broken):
    snapshot = half_broken.snapshot()
    law = half_broken.material.law("flexible")
    for number, bond in enumerate(sorted(bonds(), key=lambda i: (i.id1, i.id2))):
        phys, geom = bond.phys, bond.geom
        assert [bond.id1, bond.id2] == list(snapshot.contact_grains[number])
        points = snapshot.point_contact == number
        for name in ("opening", "slip", "damage", "traction"):
            assert (getattr(phys, name) == getattr(snapshot, f"point_{name}")[points]).all()
        assert (phys.cracked == snapshot.crack_mode[points]).all()
        assert phys.area / phys.area.sum() == pytest.approx(snapshot.point_share[points], rel=1e-14)
        assert ((phys.cracked > 0) == (phys.damage >= 1.0)).all()
        sound = phys.damage == 0.0
        elastic = law["normal_stiffness"] * phys.opening[sound]
        assert phys.traction[sound, 0] == pytest.approx(elastic, rel=1e-12, abs=1e-6)
        a, b = (O.bodies[i].state.pos for i in (bond.id1, bond.id2))
        if not phys.cracked.all():  # the normal of a cracked bond is across its faces (D59)
            assert geom.normal == pytest.approx((b - a).normalized(), abs=1e-5)
        length = np.linalg.norm(geom.ends[1] - geom.ends[0])
        thickness = half_broken.specimen.thickness
        assert phys.area.sum() == pytest.approx(length * thickness, rel=1e-3)
        assert tuple(geom.contactPoint)[:2] == pytest.approx(geom.ends.mean(axis=0))


def test_copies_and_pickles_of_a_shape_are_handles_of_the_same_grain(make):
    make()
    shape = O.bodies[5].shape
    for other in (copy.deepcopy(shape), pickle.loads(pickle.dumps(shape))):
        assert other.grain == shape.grain
        other.velocities[0, 0] = shape.velocities[0, 0] + 1.0
        assert other.velocities[0, 0] == shape.velocities[0, 0]
    bond = bonds()[0]
    phys = pickle.loads(pickle.dumps(bond.phys))
    assert (phys.area == bond.phys.area).all()


def test_a_handle_without_its_solver_says_so(make):
    make()
    shape, phys = O.bodies[5].shape, bonds()[0].phys
    O.reset()
    for read in (lambda: shape.positions, lambda: phys.opening):
        with pytest.raises(RuntimeError, match=r"GrainSolver.*flexpm\.build"):
            read()
    make()
    with pytest.raises(RuntimeError, match=r"grain = -1, is no grain"):
        wrapper.LaguerreCell().positions  # noqa: B018
