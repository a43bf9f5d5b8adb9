# SPDX-License-Identifier: GPL-3.0-or-later
"""What YADE's own functions tell of the grains: truth, or numbers that are none."""

from __future__ import annotations

import numpy as np
import pytest
from yade import utils, wrapper

import flexpm
from flexpm.arrays import FloatArray

O = wrapper.Omega()  # noqa: E741 - its name in YADE


@pytest.fixture
def loaded(make) -> flexpm.Model:
    """A specimen in compression, some of the way to its strength."""
    model = make(velocity=-2e-9)
    model.run(2000)
    return model


def volume(model: flexpm.Model) -> float:
    return model.specimen.thickness * 0.012 * 0.024


def of_bonds(body) -> FloatArray:
    """Mean stress in a grain by the forces of its bonds [Pa]."""
    total = np.zeros((2, 2))
    for bond in O.interactions.withBody(body.id):
        force = np.array(bond.phys.normalForce + bond.phys.shearForce)[:2]
        arm = np.array(bond.geom.contactPoint - body.state.pos)[:2]
        total += np.outer(force if bond.id2 == body.id else -force, arm)
    return total / (body.state.mass / body.material.density)


def top_force(model: flexpm.Model) -> float:
    nodes = model.solver.sideNodes(2)
    return sum(O.bodies[int(grain)].shape.forces[node, 1] for grain, node in nodes)


def test_states_have_the_mass_of_their_grains(loaded):
    states = [body.state for body in O.bodies]
    total = O.bodies[0].material.density * volume(loaded)
    assert sum(state.mass for state in states) == pytest.approx(total, rel=1e-9)
    for state, radius in zip(states, loaded.specimen.radii, strict=True):
        # no polygon has less than the disc of its area
        area = state.mass / (O.bodies[0].material.density * loaded.specimen.thickness)
        assert state.inertia[2] > state.mass * area / (2 * np.pi)
        assert state.inertia[2] < 4.0 * state.mass * radius**2
        assert state.blockedDOFs == "xyzXYZ"


def test_forces_of_bonds_are_those_of_their_points(loaded):
    for bond in O.interactions:
        phys, geom = bond.phys, bond.geom
        normal, tangent = np.array(geom.normal)[:2], np.array([-geom.normal[1], geom.normal[0]])
        pull = phys.traction.T @ phys.area  # on the first grain, tension positive
        expected = -(pull[0] * normal + pull[1] * tangent)
        found = np.array(phys.normalForce + phys.shearForce)[:2]
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.abs(pull).max())
        assert phys.shearForce.dot(geom.normal) == pytest.approx(0.0, abs=1e-9)
        law = bond.phys.kn / phys.area.sum()
        assert law == pytest.approx(O.bodies[0].material.normalStiffness, rel=1e-12)
        assert geom.penetrationDepth == pytest.approx(-phys.opening @ phys.area / phys.area.sum())


@pytest.mark.parametrize("run", [lambda model: model.run(50), lambda _: O.step()])
def test_functions_of_yade_see_the_bonds_when_the_simulation_stops(loaded, run):
    run(loaded)
    plane = utils.forcesOnPlane((0, 0.012, 0), (0, 1, 0))
    assert plane[1] == pytest.approx(top_force(loaded), rel=1e-3)
    # that of the bonds alone, without what the ends press on
    axial = utils.getStress(volume(loaded))[1, 1]
    assert axial == pytest.approx(-top_force(loaded) / (0.012 * 0.01), rel=0.2)
    stresses = utils.bodyStressTensors()
    for body in O.bodies:
        found = np.array([[stresses[body.id][i, j] for j in range(2)] for i in range(2)])
        expected = of_bonds(body)
        for i in range(2):
            assert found[i, i] == pytest.approx(expected[i, i], rel=1e-9, abs=1.0)


def test_forces_and_torques_of_bodies_are_the_resultants_of_their_nodes(loaded):
    loaded.run(20)
    for body in O.bodies:
        nodes = body.shape.forces
        arms = body.shape.positions - np.array(body.state.pos)[:2]
        moment = (arms[:, 0] * nodes[:, 1] - arms[:, 1] * nodes[:, 0]).sum()
        scale = np.abs(nodes).max()
        assert tuple(O.forces.f(body.id))[:2] == pytest.approx(nodes.sum(axis=0), abs=1e-9 * scale)
        assert O.forces.t(body.id)[2] == pytest.approx(moment, abs=1e-9 * scale)


def test_within_a_run_the_bonds_tell_nothing_rather_than_the_past(loaded):
    O.step()
    before = utils.getStress(1.0)[1, 1]
    assert before < 0.0
    loaded.solver.mirrorPeriod = 2
    O.step()
    assert np.isnan(utils.getStress(1.0)[1, 1])
    assert not np.isnan(next(iter(O.interactions)).phys.normalForce[0]), (
        "a script's look is present"
    )
    loaded.solver.mirrorBodies()
    assert utils.getStress(1.0)[1, 1] < 0.0


def test_energies_are_tracked_and_sum_to_what_there_was(make):
    model = make(velocity=-2e-9)
    O.trackEnergy = True
    model.run(1000)
    found, expected = dict(O.energy.items()), model.solver.energies()
    assert found["elastic_energy"] == expected["elastic_energy"] > 0.0
    assert found["boundary_work_taken"] == -expected["boundary_work"]
    total = O.energy.total()
    assert total == pytest.approx(expected["initial_energy"], abs=1e-3 * found["elastic_energy"])


@pytest.mark.parametrize("recorders", ["all", "stress", "bstresses", "intr", "force"])
def test_the_vtk_recorder_runs(loaded, tmp_path, recorders):
    O.engines = [
        *O.engines,
        wrapper.VTKRecorder(fileName=f"{tmp_path}/", recorders=[recorders], iterPeriod=1),
    ]
    O.step()
    wrote = any(tmp_path.iterdir())
    assert wrote == (recorders in ("all", "intr")), "grains are no spheres"


def test_what_knows_only_spheres_tells_no_number(loaded):
    loaded.run(1)
    assert all(np.isnan(x) for corner in utils.aabbExtrema() for x in corner)
    assert np.isnan(utils.porosity())
    assert np.isnan(utils.fabricTensor()[0][0, 0])
    assert np.isnan(utils.unbalancedForce())
    assert utils.kineticEnergy() == 0.0
