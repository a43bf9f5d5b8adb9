# SPDX-License-Identifier: GPL-3.0-or-later
"""Rubble and blocks under gravity: they fall on walls, touch, rub, and come to rest."""

from __future__ import annotations

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm

SIZE, DROP, ASIDE = 0.016, 1e-3, 1e-3  # of the specimen; under it and beside it [m]
GRAVITY = 9.81
#: Bonds that break at a touch; soft, so that steps are long.
LOOSE = ("tensile_strength=1", "cohesion=1", "softening=brittle", "normal_stiffness=1e11")


class Box:
    """A specimen without strength in a box of three walls."""

    def __init__(self, model: str, drop: float = DROP, aside: float = ASIDE) -> None:
        yade.O.reset()
        material = flexpm.materials.load("augig-table2-bilinear", model)
        material = material.with_set(LOOSE, model)
        if model == "flexible":
            material = material.with_set(["young=1e8"], model)
        self.specimen = flexpm.Specimen.rectangle(SIZE, SIZE, thickness=0.08, seed=5)
        self.built = flexpm.build(
            self.specimen, material, model, mesh="fan", damping=0.1, dynamic=True, gravity=GRAVITY
        )
        self.solver = self.built.solver
        for place, normal in (
            ((0.0, -drop, 0.0), (0.0, 1.0, 0.0)),
            ((-aside, 0.0, 0.0), (1.0, 0.0, 0.0)),
            ((SIZE + aside, 0.0, 0.0), (-1.0, 0.0, 0.0)),
        ):
            self.solver.addWall(place, normal, friction=0.5)
        self.built.set_masses()
        self.allowed = np.minimum(self.distances(), self.reaches())
        self.worst_overlap = self.worst_error = 0.0

    def centres(self) -> np.ndarray:
        return np.array([list(yade.O.bodies[i].state.pos)[:2] for i in self.solver.bodyIds])

    def distances(self) -> np.ndarray:
        x = self.centres()
        first, second = np.triu_indices(len(x), 1)
        return np.hypot(*(x[first] - x[second]).T)

    def reaches(self) -> np.ndarray:
        radii = self.specimen.discs[:, 2]
        first, second = np.triu_indices(len(radii), 1)
        return radii[first] + radii[second]

    def weight(self) -> float:
        return 2650.0 * SIZE * SIZE * 0.08 * GRAVITY

    def run(self, steps: int) -> dict[str, float]:
        """Step on, watch overlap and energy balance, and return the energies."""
        for _ in range(steps // 500):
            self.built.run(500)
            overlap = float(np.max(self.allowed - self.distances()))
            self.worst_overlap = max(self.worst_overlap, overlap)
            now = self.solver.energies()
            into = now.pop("boundary_work") + now.pop("initial_energy")
            self.worst_error = max(self.worst_error, abs(into - sum(now.values())))
        return now


@pytest.mark.long
@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_rubble_falls_and_comes_to_rest(model):
    box = Box(model)
    fallen, quiet = 0.0, 0
    for _ in range(80):
        energies = box.run(2000)
        fallen = max(fallen, -energies["potential_energy"])
        quiet = quiet + 1 if energies["kinetic_energy"] < 1e-5 * fallen else 0
        if quiet == 4:  # at the end of a bounce it is low, too
            break
    assert quiet == 4
    assert fallen > 0.9 * DROP * box.weight()
    # all bonds have broken; their grains bear on each other, most at the faces that they had
    assert sum(box.solver.cracks()) >= 3 * box.solver.counts()["contacts"] - 6
    assert sum(bond.isReal for bond in yade.O.interactions) > 10
    assert box.worst_overlap < 0.02 * 0.5 * box.specimen.mean_diameter
    assert box.worst_error < 0.01 * fallen
    floor, left, right = (plate["force"] for plate in box.solver.plates())
    assert floor[1] + left[1] + right[1] == pytest.approx(box.weight(), rel=0.02)
    collider = next(e for e in yade.O.engines if type(e).__name__ == "InsertionSortCollider")
    runs = collider.numAction
    box.run(2000)
    assert collider.numAction <= runs + 1  # of 20 looks; hundreds while the grains fell
    assert runs > 100


@pytest.mark.long
def test_contacts_keep_their_numbers_while_others_come_and_go():
    box = Box("rigid", 2e-3, 3e-3)  # so far that grains lose their faces
    bonds = {i.phys.contact: (i.id1, i.id2) for i in yade.O.interactions if i.isReal}
    assert sorted(bonds) == list(range(len(bonds)))
    pairs, now, gone, kept = dict(bonds), set(bonds), set(), {}
    for _ in range(120):
        box.built.run(1000)
        snapshot = box.built.snapshot()
        before, now = now, set(snapshot.contact.tolist())
        assert len(now) == len(snapshot.contact), "a number stands for one contact"
        assert not now & gone, "a number came back"
        assert all(number > max(pairs) for number in now - set(pairs)), "new ones are higher"
        gone |= before - now
        for number, grains in zip(snapshot.contact, snapshot.contact_grains, strict=True):
            assert pairs.setdefault(number, tuple(grains)) == tuple(grains)
        for bond in (i for i in yade.O.interactions if i.isReal):
            assert pairs[bond.phys.contact] == (bond.id1, bond.id2)
            assert bond.geom.contact == bond.phys.contact
            kept.setdefault(bond.phys.contact, bond.phys)
    assert set(bonds) <= now, "bonds that have ended keep their place in the record"
    assert len(gone) > 3
    assert len(now - set(bonds)) > 3
    ended = kept[max(set(kept) & gone)]
    with pytest.raises(RuntimeError, match="has ended"):
        _ = ended.opening


@pytest.mark.parametrize("model", ["rigid", "flexible"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_bonded_block_falls_on_a_wall_and_comes_to_rest(dimension, model):
    yade.O.reset()
    if dimension == 2:
        specimen = flexpm.Specimen.rectangle(0.008, 0.008, thickness=0.08, seed=1)
    else:
        specimen = flexpm.Specimen.box(0.009, 0.009, 0.009, seed=1)
    weight = 2650.0 * GRAVITY * (0.008**2 * 0.08 if dimension == 2 else 0.009**3)
    built = flexpm.build(specimen, model=model, damping=0.7, dynamic=True, gravity=GRAVITY)
    drop, up = 1e-8, dimension - 1
    place, normal = np.zeros(3), np.zeros(3)
    place[up], normal[up] = -drop, 2.0
    wall = built.solver.addWall(place, normal)
    built.set_masses()
    assert built.solver.plates()[wall]["force"] == (0.0,) * dimension
    for _ in range(40):
        built.run(500)
        force = built.solver.plates()[wall]["force"]
        rests = built.solver.energies()["kinetic_energy"] < 1e-6 * weight * drop
        if rests and force[up] > 0.0:
            break
    assert rests
    assert force[up] == pytest.approx(weight, rel=1e-2)
    energies = built.solver.energies()
    given = energies.pop("boundary_work") + energies.pop("initial_energy")
    assert -energies["potential_energy"] > weight * drop
    assert sum(energies.values()) == pytest.approx(given, abs=0.01 * weight * drop)
    with pytest.raises(ValueError, match="gap between wall and grains"):
        built.solver.addWall(-2.0 * place, normal)


@pytest.mark.parametrize(
    ("options", "rule"),
    [
        ({"gravity": 9.81}, "must be 0 with scaled masses"),
        ({"gravity": -1.0, "dynamic": True}, "gravity = -1.0 m/s2, must be >= 0"),
        ({"gravity": 9.81, "dynamic": True, "model": "jcfpm"}, "must be one of 0.0"),
    ],
)
def test_gravity_is_refused_where_it_makes_no_sense(options, rule):
    specimen = flexpm.Specimen.rectangle(0.012, 0.012, thickness=0.08, seed=1)
    yade.O.reset()
    refusal(rule, flexpm.build, specimen, **options)


def test_the_solver_refuses_gravity_on_scaled_masses():
    built = fresh(flexpm.Specimen.rectangle(0.012, 0.012, thickness=0.08, seed=1))
    with pytest.raises(ValueError, match="scaled masses"):
        built.solver.gravity = (0.0, -9.81, 0.0)
