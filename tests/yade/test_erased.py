# SPDX-License-Identifier: GPL-3.0-or-later
"""Erased bonds and grains are gone at once from all that is asked; only their record is left."""

from __future__ import annotations

import csv
import itertools

import numpy as np
import pytest
from matplotlib.image import imread
from yade import wrapper

import flexpm
from flexpm.report.maps import crack_picture
from flexpm.results.cracks import ERASED, cracks_from_snapshot
from flexpm.results.record import Curve
from flexpm.results.vtu import write_vtu

O = wrapper.Omega()  # noqa: E741 - its name in YADE
HEIGHT = 0.024  #: of the specimen [m]


def real_bonds() -> list:
    return [i for i in O.interactions if i.isReal]


def bonds_of(body: int) -> list:
    return [i for i in real_bonds() if body in (i.id1, i.id2)]


def erase(bonds: list) -> set[int]:
    """Erase bonds; return their numbers."""
    numbers = {bond.phys.contact for bond in bonds}
    for bond in bonds:
        O.interactions.erase(bond.id1, bond.id2)
    return numbers


def cut(discs, width: float = np.inf) -> set[int]:
    """Erase the bonds across the middle of the height, up to a distance from the left side [m]."""
    upper = discs[:, 1] > 0.5 * HEIGHT
    return erase(
        [
            bond
            for bond in real_bonds()
            if upper[bond.id1] != upper[bond.id2] and bond.geom.contactPoint[0] < width
        ]
    )


def miss(energies: dict[str, float]) -> float:
    """What the energy balance lacks [J]."""
    came = energies.pop("boundary_work") + energies.pop("initial_energy")
    return came - sum(energies.values())


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_cut_specimen_is_two_at_once(make, tmp_path, model):
    built = make(model=model)
    bonds = len(real_bonds())
    gone = cut(built.specimen.discs)
    assert len(gone) > 3
    # without a step
    snapshot = built.snapshot()
    assert len(snapshot.contact) == bonds - len(gone) == built.counts()["contacts"]
    assert not gone & set(snapshot.contact.tolist())
    assert set(snapshot.erased_contact.tolist()) == gone
    assert (snapshot.erased_crack_mode == ERASED).all()
    assert built.solver.cracks() == (0, 0)
    assert len(snapshot.fragments) == 2
    crack_picture(tmp_path / "cut.png", snapshot)
    black = np.all(imread(tmp_path / "cut.png")[..., :3] < 0.1, axis=2)
    # a line across the picture, longer than the scale bar
    assert np.count_nonzero(black.any(axis=0)) > 0.8 * black.shape[1]
    write_vtu(tmp_path / "cut.vtu", snapshot)


def test_erased_bonds_of_a_notch_never_crack(make):
    built = make(velocity=5e-9)
    gone = cut(built.specimen.discs, width=0.004)
    assert len(gone) > 1
    while sum(built.solver.cracks()) < 5:
        built.run(500)
        assert O.iter < 20000
    snapshot = built.snapshot()
    cracks = cracks_from_snapshot(snapshot, Curve())
    erased = [crack for crack in cracks if crack.mode == ERASED]
    assert {crack.contact for crack in erased} == gone
    assert {crack.step for crack in erased} == {0}
    assert len(cracks) - len(erased) == sum(built.solver.cracks())
    pairs = {(i.id1, i.id2) for i in real_bonds()}
    shown = {tuple(pair) for pair in snapshot.contact_grains.tolist()}
    assert pairs <= shown
    whole = snapshot.any_of(snapshot.point_damage < 1.0)
    assert {tuple(pair) for pair in snapshot.contact_grains[whole].tolist()} <= pairs


@pytest.mark.parametrize("model", ["flexible", "rigid", "inner"])
def test_an_erased_body_is_gone(make, tmp_path, model):
    built = make(model=model)
    before, all_counts = built.snapshot(), built.counts()
    body = 30
    particle = O.bodies[body].shape.grain
    lost = len(bonds_of(body))
    O.bodies.erase(body)
    counts, snapshot = built.counts(), built.snapshot()
    assert counts["particles"] == all_counts["particles"] - 1
    assert counts["particles"] == sum(b is not None for b in O.bodies)
    if model != "inner":  # one of several particles of a grain
        assert counts["grains"] == all_counts["grains"] - 1
    assert sum(counts[name] for name in ("contacts", "inner_contacts")) == len(real_bonds())
    assert counts["nodes"] == len(snapshot.positions) < len(before.positions)
    of_it = np.count_nonzero(before.triangle_particle == particle)
    assert of_it > 0
    assert particle not in snapshot.triangle_particle
    assert len(snapshot.triangles) == len(before.triangles) - of_it
    assert len(snapshot.contact) == len(before.contact) - lost == len(real_bonds())
    assert not np.isfinite(snapshot.erased_ends).any()
    fragments = snapshot.fragments
    assert fragments.grains.sum() == counts["grains"]
    crack_picture(tmp_path / "hole.png", snapshot)
    write_vtu(tmp_path / "hole.vtu", snapshot)
    built.run(20)
    assert built.counts() == counts


def test_a_body_that_is_replaced_is_gone(make):
    built = make()
    grains = built.counts()["grains"]
    O.bodies[30].shape = wrapper.Sphere(radius=1e-3)
    assert built.counts()["grains"] == grains - 1


def test_nothing_is_left_without_bodies(make, tmp_path):
    built = make(velocity=5e-9)
    built.run(150)
    O.bodies.clear()
    counts, snapshot = built.counts(), built.snapshot()
    assert [counts[name] for name in ("grains", "contacts", "nodes", "triangles")] == [0] * 4
    assert len(snapshot.positions) == len(snapshot.contact) == len(snapshot.fragments) == 0
    energies = built.solver.energies()
    assert energies["elastic_energy"] == 0.0
    write_vtu(tmp_path / "empty.vtu", snapshot)
    crack_picture(tmp_path / "empty.png", snapshot)
    assert not (tmp_path / "empty.png").exists()


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("what", ["bonds", "body"])
def test_the_energy_balance_is_kept(make, model, what):
    built = make(model=model)
    if model == "flexible":
        built.add_engines(before=(wrapper.EndDisplacementController(velocity=-5e-9),))
    else:
        plates = [built.solver.addSidePlates(side)[0] for side in (0, 2)]
        built.set_masses()
        built.add_engines(
            before=(wrapper.PlateController(plates=plates[1:], velocity=(0.0, -5e-9, 0.0)),)
        )
    built.solver.measurePeriod = 1
    built.run(800)
    before = built.solver.energies()
    work, lacking = abs(before["boundary_work"]), miss(dict(before))
    assert before["erased_energy"] == 0.0
    if what == "bonds":
        erase(bonds_of(20))
    else:
        O.bodies.erase(20)
    now = built.solver.energies()
    assert now["erased_energy"] > 1e-3 * work
    assert now["erased_energy"] == pytest.approx(before["elastic_energy"] - now["elastic_energy"])
    assert miss(dict(now)) == pytest.approx(lacking, abs=1e-12 * work)
    built.run(1)
    assert miss(built.solver.energies()) == pytest.approx(lacking, abs=1e-9 * work)


def test_a_kept_handle_says_that_its_bond_is_gone(make):
    built = make(velocity=5e-9)
    built.run(310)
    bond = real_bonds()[7]
    geom, phys, number = bond.geom, bond.phys, bond.phys.contact
    area = phys.area
    assert area.all()
    O.interactions.erase(bond.id1, bond.id2)
    for ask in (lambda: phys.traction, lambda: phys.damage, lambda: geom.normal):
        with pytest.raises(RuntimeError, match=rf"contact = {number}, .* was erased"):
            ask()
    built.run(92)  # the check at step 400 sees it, though no object was destroyed
    assert number in built.snapshot().erased_contact
    assert (built.snapshot().erased_crack_step == 400).all()


def test_an_erased_pair_that_touches_has_a_new_number(make):
    built = make(velocity=-5e-9)
    built.run(310)
    highest = max(bond.phys.contact for bond in real_bonds())
    discs = built.specimen.discs

    def gap(bond) -> float:
        a, b = discs[bond.id1], discs[bond.id2]
        return np.hypot(*(b - a)[:2]) - a[2] - b[2]

    bond = min(real_bonds(), key=gap)
    assert gap(bond) < 0.0, "they touch as soon as the bond is gone"
    pair, old = (bond.id1, bond.id2), bond.phys.contact
    O.interactions.erase(*pair)
    del bond
    built.run(20)
    new = O.interactions[pair]
    assert new.isReal
    assert new.phys.contact > highest
    snapshot = built.snapshot()
    rows = np.flatnonzero((snapshot.contact_grains == pair).all(axis=1))
    assert snapshot.contact[rows].tolist() == [new.phys.contact]
    assert snapshot.erased_contact.tolist() == [old]
    assert built.counts()["touching"] >= 1


@pytest.mark.parametrize("kept", [False, True])
def test_a_scene_saved_just_after_erasing_continues_to_the_same_bits(make, bits, tmp_path, kept):
    built = make(velocity=1e-9)
    built.run(10)
    bond = real_bonds()[3]
    handle = [bond.phys] if kept else []
    O.interactions.erase(bond.id1, bond.id2)
    O.bodies.erase(25)
    del bond
    O.save(str(tmp_path / "scene.bin"))
    built.run(300)
    uninterrupted = bits()
    O.load(str(tmp_path / "scene.bin"))
    O.run(300, True)
    assert bits() == uninterrupted
    assert len(handle) == kept


@pytest.mark.usefixtures("look_each_tenth_step")
def test_files_of_a_run_name_erased_bonds_apart_from_cracks(specimen, tmp_path):
    gone: set[int] = set()

    def progress(*_: object) -> None:
        if not gone and O.iter > 1000:
            gone.update(erase(bonds_of(20)))

    result = flexpm.run("tension", specimen, rate=0.5, out=tmp_path, progress=progress)
    with (tmp_path / "cracks.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert gone
    assert {int(row["contact"]) for row in rows if row["mode"] == "erased"} == gone
    cracks = [row["mode"] for row in rows if row["mode"] != "erased"]
    assert len(cracks) == result.tensile_cracks + result.shear_cracks > 0
    assert cracks.count("tensile") == result.tensile_cracks
    assert result.energy_error < 0.01


@pytest.mark.long
@pytest.mark.usefixtures("look_each_tenth_step")
@pytest.mark.parametrize(
    ("model", "test"),
    [
        *itertools.product(["flexible", "rigid"], ["uniaxial", "tension", "biaxial", "brazilian"]),
        ("inner", "tension"),
        *(
            pytest.param("inner", test, marks=pytest.mark.slow)
            for test in ("uniaxial", "biaxial", "brazilian")
        ),
    ],
)
def test_a_test_goes_on_without_grains_that_it_loads(specimen, disc, test, model):
    """The particle at the bottom is erased, then the one at the top."""
    erasures = [max, min]

    def progress(*_: object) -> None:
        if erasures and O.iter > 100 * (3 - len(erasures)):
            cells = [body for body in O.bodies if isinstance(body.shape, wrapper.LaguerreCell)]
            chosen = erasures.pop()(cells, key=lambda body: body.state.pos[1])
            O.bodies.erase(chosen.id)

    result = flexpm.run(
        test,
        disc if test == "brazilian" else specimen,
        model=model,
        rate=1.0,
        confinement=2e6 if test == "biaxial" else 0.0,
        progress=progress,
    )
    assert not erasures
    assert result.status in ("ok", "no_peak", "not_quasistatic")
    assert np.isfinite(result.curve["axial_stress"]).all()
    assert result.energy_error < 0.01
    assert len({crack.contact for crack in result.cracks if crack.mode == ERASED}) > 2
