# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids in YADE's scene: what bodies and bonds show of the solver's arrays, what is refused."""

from __future__ import annotations

import pickle
import re

import numpy as np
import pytest
from yade import utils, wrapper
from yade.minieigenHP import Vector3

import flexpm

O = wrapper.Omega()  # noqa: E741 - its name in YADE
#: Velocity of the top [m/step]: fast, so that points crack within some hundred steps.
PULL = 3e-9
SIZES = (0.008, 0.008, 0.014)
MODELS = ("flexible", "rigid")


def bonds():
    found = [one for one in O.interactions if one.isReal]
    return sorted(found, key=lambda one: (one.id1, one.id2))


def centre_of(body):
    return tuple(body.shape.positions[body.shape.vertices])


def arms_of(body):
    """Nodes of a grain from its centre: in the bonded state, and now."""
    now = body.shape.positions
    before = now - body.shape.displacements
    return before - before[-1], now - now[-1]


def test_grains_are_bodies_and_bonds_are_interactions(solid, box):
    model = solid()
    counts = model.solver.counts()
    assert len(O.bodies) == counts["grains"] == len(box.spheres)
    assert len(bonds()) == counts["contacts"]
    assert all(isinstance(body.shape, wrapper.LaguerreCell) for body in O.bodies)
    assert sum(len(body.shape.positions) for body in O.bodies) == counts["nodes"]
    assert sum(len(body.shape.tetrahedra) for body in O.bodies) == counts["tetrahedra"]
    volume = 0.0
    for body in O.bodies:
        places = body.shape.positions
        a, b, c, d = np.moveaxis(places[np.array(body.shape.tetrahedra)], 1, 0)
        own = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)).sum() / 6.0
        # the same, between the triangles of its faces and the origin
        p, q, r = np.moveaxis(places[np.array(body.shape.triangles)], 1, 0)
        assert np.einsum("ij,ij->i", p, np.cross(q, r)).sum() / 6.0 == pytest.approx(own)
        assert body.state.mass == pytest.approx(body.material.density * own, rel=1e-9)
        assert body.state.blockedDOFs == "xyzXYZ"
        volume += own
    assert volume == pytest.approx(np.prod(SIZES), rel=1e-12)


@pytest.mark.parametrize("name", MODELS)
def test_bodies_follow_their_grains(solid, name):
    model = solid(name, velocity=PULL)
    model.run(60)
    for body in O.bodies:
        assert tuple(body.state.pos) == centre_of(body)
        assert tuple(body.state.vel) == tuple(body.shape.velocities[body.shape.vertices])
        if name == "rigid":
            before, now = arms_of(body)
            turned = np.array([body.state.ori * Vector3(*arm) for arm in before])
            assert turned == pytest.approx(now, abs=1e-15)
    model.solver.mirrorPeriod = 1000
    model.run(3)
    assert any(tuple(body.state.pos) != centre_of(body) for body in O.bodies)
    model.solver.mirrorBodies()
    assert all(tuple(body.state.pos) == centre_of(body) for body in O.bodies)


def test_a_rigid_grain_moves_and_turns_as_a_script_wants(solid):
    solid("rigid")
    body = O.bodies[7]
    cell = body.shape
    spin = np.array((1e-6, -2e-6, 3e-6))
    cell.setMotion((1e-9, 2e-9, -3e-9), tuple(spin))
    arms, way = arms_of(body)[1], np.array((1e-9, 2e-9, -3e-9))
    assert cell.velocities == pytest.approx(way + np.cross(spin, arms), rel=1e-12)
    O.step()
    assert cell.displacements[cell.vertices] == pytest.approx((1e-9, 2e-9, -3e-9), rel=1e-9)
    angle = body.state.ori.toAxisAngle()
    assert np.array(angle[0]) * angle[1] == pytest.approx(spin, rel=1e-6)
    with pytest.raises(ValueError, match="read-only"):
        cell.velocities[0] = 0.0
    with pytest.raises(ValueError, match="spin = 1 rad/s, must be a vector of three"):
        cell.setMotion((0, 0, 0), 1.0)


@pytest.mark.parametrize("far", [1e20, 1e200])
def test_a_bond_of_a_grain_that_has_flown_out_of_sight_has_no_normal_and_no_force(solid, far):
    model = solid("rigid")
    O.bodies[0].shape.setMotion((far, far, far), (0.0, 0.0, 0.0))
    with pytest.raises(RuntimeError, match="step 1: contacts without a middle face"):
        O.step()
    model.solver.mirrorBodies()
    lost = [one for one in bonds() if one.id1 == 0]
    assert lost
    for one in lost:
        shown = (one.geom.normal, one.phys.normalForce, one.phys.shearForce)
        assert all(tuple(vector) == (0.0, 0.0, 0.0) for vector in shown)


@pytest.fixture(params=MODELS)
def broken(solid, request):
    """A box in tension of which some points have cracked."""
    model = solid(request.param, velocity=PULL)
    while sum(model.solver.cracks()) < 10:
        model.run(50)
        assert O.iter < 20000, "nothing cracked"
    return model


@pytest.mark.parametrize("name", MODELS)
def test_bonds_and_nodes_are_those_of_the_last_step_wherever_a_run_stops(solid, name):
    model = solid(name, velocity=PULL)
    model.run(34)
    for _ in range(3):  # between two checks
        O.step()

    def bonded():
        return [(tuple(one.geom.contactPoint), tuple(one.phys.normalForce)) for one in bonds()]

    shown = bonded()
    model.solver.mirrorBodies()
    assert bonded() == shown
    cell = O.bodies[0].shape
    kept = cell.positions.copy()
    model.run(13)
    state = model.snapshot()
    assert (cell.positions == state.positions[: len(kept)]).all()
    assert (cell.forces == state.forces[: len(kept)]).all()
    assert (cell.positions != kept).any()


def test_bonds_show_their_points(broken):
    state = broken.snapshot()
    law = broken.material.law(broken.name)
    for number, bond in enumerate(bonds()):
        phys, geom = bond.phys, bond.geom
        assert [bond.id1, bond.id2] == list(state.contact_grains[number])
        points = state.point_contact == number
        for name in ("area", "opening", "slip", "damage", "traction"):
            assert (getattr(phys, name) == getattr(state, f"point_{name}")[points]).all(), name
        assert (phys.cracked == state.crack_mode[points]).all()
        assert (geom.points == state.point_position[points]).all()
        corners = slice(*state.corner_offsets[number : number + 2])
        assert (geom.corners == state.corners[corners]).all()
        sound = phys.damage == 0.0
        elastic = law["normal_stiffness"] * phys.opening[sound]
        assert phys.traction[sound, 0] == pytest.approx(elastic, rel=1e-12, abs=1e-6)
        # forces of the points are those of the bond, across and along the face
        found = np.array(phys.normalForce + phys.shearForce)
        scale = np.abs(phys.forces).max()
        assert phys.forces.sum(axis=0) == pytest.approx(found, abs=1e-9 * scale)
        normal = np.array(geom.normal)
        pull = -phys.forces @ normal
        assert pull == pytest.approx(phys.traction[:, 0] * phys.area, abs=1e-9 * scale)
        assert phys.shearForce.dot(geom.normal) == pytest.approx(0.0, abs=1e-9 * scale)
        assert phys.kn == pytest.approx(law["normal_stiffness"] * phys.area.sum(), rel=1e-12)
        middle = phys.area @ geom.points / phys.area.sum()
        assert tuple(geom.contactPoint) == pytest.approx(tuple(middle))
        assert geom.penetrationDepth == pytest.approx(-phys.opening @ phys.area / phys.area.sum())
    modes = np.concatenate([bond.phys.cracked for bond in bonds()])
    assert broken.solver.cracks() == ((modes == 1).sum(), (modes == 2).sum())


def test_forces_of_bodies_and_stresses_are_those_of_their_bonds(broken):
    volume = np.prod(SIZES)
    low, high = [], []
    for body in O.bodies:
        nodes = body.shape.forces if broken.name == "flexible" else body.shape.forces[:-1]
        scale = max(np.abs(nodes).max(), 1.0)
        assert tuple(O.forces.f(body.id)) == pytest.approx(nodes.sum(axis=0), abs=1e-9 * scale)
        arms = arms_of(body)[1][: len(nodes)]
        moment = np.cross(arms, nodes).sum(axis=0)
        assert tuple(O.forces.t(body.id)) == pytest.approx(moment, abs=1e-9 * scale)
        (high if body.state.pos[2] > SIZES[2] / 2 else low).append(body.id)
    # what the bonds across the middle carry is what the upper grains are pulled down with
    across = [bond for bond in bonds() if (bond.id1 in low) != (bond.id2 in low)]
    force = sum(
        np.array(bond.phys.normalForce + bond.phys.shearForce) * (1 if bond.id2 in high else -1)
        for bond in across
    )
    assert force[2] < 0.0
    seen = sum(O.forces.f(number)[2] for number in high)
    if broken.name == "flexible":  # plates push on rigid ones, too
        assert seen == pytest.approx(force[2], rel=1e-9)
    # YADE's stress of the bonds alone is near that of the section, as there are few grains
    axial = utils.getStress(volume)[2, 2]
    assert axial == pytest.approx(-force[2] / (SIZES[0] * SIZES[1]), rel=0.35)
    within = utils.bodyStressTensors()
    assert np.mean([tensor[2, 2] for tensor in within]) > 0.0


@pytest.mark.parametrize("name", MODELS)
def test_a_saved_scene_goes_on_with_the_same_bits(solid, bits, tmp_path, scene_solver, name):
    model = solid(name, velocity=PULL)
    model.run(60)
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    model.run(45)
    without = bits()
    O.load(str(tmp_path / "scene.yade.gz"), quiet=True)
    shown = [tuple(body.state.pos) for body in O.bodies]
    assert shown == [centre_of(body) for body in O.bodies]
    scene_solver().stepsToCome = 0
    O.run(45, True)
    assert bits() == without
    assert bonds()[3].phys.traction.any()


def test_boxes_bound_the_grains_and_the_collider_is_idle(solid):
    model = solid(velocity=-1e-10)
    collider = model.required(wrapper.InsertionSortCollider)
    model.run(2)
    runs = collider.numAction
    model.run(300)
    assert collider.numAction == runs
    for body in O.bodies:
        places = body.shape.positions
        low, high = np.array(body.bound.min), np.array(body.bound.max)
        assert np.all(low <= places.min(axis=0)) and np.all(high >= places.max(axis=0))
        assert np.ptp(places, axis=0) == pytest.approx(
            high - low, abs=0.15 * model.specimen.mean_diameter
        )
    # one that moves has its box renewed
    cell = O.bodies[5].shape
    cell.held[:] = 1
    cell.velocities[:] = (0.1 * model.specimen.mean_diameter / 200, 0.0, 0.0)
    model.run(401)
    assert collider.numAction > runs
    assert cell.positions[:, 0].max() <= O.bodies[5].bound.max[0]


@pytest.mark.parametrize("erase", ["bond", "grain"])
def test_a_solid_keeps_its_grains_and_bonds(solid, erase):
    model = solid()
    model.run(1)
    if erase == "bond":
        first = bonds()[0]
        O.interactions.erase(first.id1, first.id2)
        del first
    else:
        O.bodies.erase(7)
    with pytest.raises(
        RuntimeError, match="SolidSolver: grains and bonds that are erased = "
    ) as told:
        model.run(101)
    assert "\n" not in str(told.value)


def test_handles_are_copied_and_say_what_is_not_theirs(solid, make):
    solid()
    shape, bond = O.bodies[5].shape, bonds()[0]
    again = pickle.loads(pickle.dumps(shape))
    again.velocities[0, 2] = 4.0
    assert shape.velocities[0, 2] == 4.0
    assert (pickle.loads(pickle.dumps(bond.phys)).area == bond.phys.area).all()
    with pytest.raises(ValueError, match="ends = 3D, must be 2D"):
        bond.geom.ends.any()
    make()
    flat = bonds()[0]
    for thing, name in ((flat.geom, "corners"), (flat.geom, "points"), (flat.phys, "forces")):
        with pytest.raises(ValueError, match=f"{name} = 2D, must be 3D"):
            getattr(thing, name)
    assert O.bodies[0].shape.tetrahedra == []


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ("O.bodies[3].material = wrapper.GrainMat()", r"O.bodies\[3\].material = changed"),
        ("model.solver.addToScene()", "are in the scene already"),
        ("O.bodies.clear()", "SolidSolver|grains in O.bodies = 0"),
        ("wrapper.LaguerreCell(grain=10**6).positions", "grain = 1000000, is no grain"),
        ("wrapper.LobattoPhys().forces", "contact = -1, does not exist"),
        ("model.solver.sideNodes(0)", "must be 2D for this call"),
        ("model.solver.mirrorPeriod = 0", "mirrorPeriod = 0"),
    ],
)
def test_what_cannot_be_done_is_refused_in_one_line(solid, change, told):
    model = solid()
    with pytest.raises((RuntimeError, ValueError)) as found:
        exec(change, {"O": O, "wrapper": wrapper, "model": model})
        model.run(101)
    assert re.search(told, str(found.value)) and "\n" not in str(found.value)


def test_after_a_test_the_scene_shows_the_grains(box):
    O.reset()
    flexpm.run("tension", box, model="rigid", rate=8.0, max_strain=2e-4)
    assert all(tuple(body.state.pos) == centre_of(body) for body in O.bodies)
    (solver,) = (one for one in O.engines if isinstance(one, wrapper.SolidSolver))
    assert solver.mirrorPeriod == 1, "a script may go on"
    assert any(bond.phys.opening.any() for bond in bonds())
