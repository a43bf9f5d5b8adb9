# SPDX-License-Identifier: GPL-3.0-or-later
"""Erased bonds and bodies of YADE's own bonded spheres are no cracks and in no number."""

from __future__ import annotations

import numpy as np
import pytest
from yade import wrapper

import flexpm
from flexpm.errors import InputError
from flexpm.report.maps import crack_picture
from flexpm.results.cracks import ERASED, cracks_from_snapshot
from flexpm.results.record import Curve
from flexpm.results.vtu import write_vtu

O = wrapper.Omega()  # noqa: E741 - its name in YADE
HEIGHT = 0.024  #: of the specimen [m]


@pytest.fixture(params=["jcfpm", "cohfrict"])
def model(request):
    return request.param


def bonds_across(built) -> set[int]:
    """Rows of the bonds across the middle of the height."""
    upper = built.specimen.centres[:, 1] > 0.5 * HEIGHT
    return set(np.flatnonzero(np.diff(upper[built.bonds.grains]).ravel()).tolist())


def erase(built, rows: set[int]) -> None:
    for row in rows:
        O.interactions.erase(*(built.ids[grain] for grain in built.bonds.grains[row]))


def test_a_cut_specimen_is_two_without_a_crack(make, model, tmp_path):
    built = make(model=model)
    O.step()  # JCFpm sets up its bonds
    rows = bonds_across(built)
    assert len(rows) > 3
    erase(built, rows)
    snapshot = built.snapshot()
    assert built.cracks.counts == (0, 0)
    assert set(snapshot.erased_contact.tolist()) == rows
    assert (snapshot.erased_crack_mode == ERASED).all()
    assert not rows & set(snapshot.contact.tolist())
    assert len(snapshot.contact) == built.counts()["contacts"] == len(built.bonds) - len(rows)
    assert len(snapshot.fragments) == 2
    assert {crack.mode for crack in cracks_from_snapshot(snapshot, Curve())} == {ERASED}
    crack_picture(tmp_path / "cut.png", snapshot)
    write_vtu(tmp_path / "cut.vtu", snapshot)
    built.run(200)  # where discs overlap, they touch anew, without cohesion
    assert built.cracks.counts == (0, 0)
    assert len(built.snapshot().contact) == len(snapshot.contact)


def test_erased_bonds_store_nothing(make, model):
    built = make(model=model)
    upper = built.specimen.centres[:, 1] > 0.5 * HEIGHT
    for body in np.flatnonzero(upper).tolist():  # the halves part, held
        O.bodies[body].state.blockedDOFs = "xyzXYZ"
        O.bodies[body].state.vel = (0.0, 2e-9, 0.0)
    for body in np.flatnonzero(~upper).tolist():
        O.bodies[body].state.blockedDOFs = "xyzXYZ"
    built.run(10)
    before = built.elastic_energy()
    assert before > 0.0
    erase(built, bonds_across(built))
    assert built.elastic_energy() < 1e-9 * before  # only the bonds across were strained


def test_an_erased_body_is_gone(make, model, tmp_path):
    built = make(model=model)
    O.step()
    before, counts = built.snapshot(), built.counts()
    body = 30
    lost = int((built.bonds.grains == body).any(axis=1).sum())
    O.bodies.erase(body)
    snapshot = built.snapshot()
    assert built.cracks.counts == (0, 0)
    assert built.counts() == {
        "grains": counts["grains"] - 1,
        "contacts": counts["contacts"] - lost,
    }
    assert body not in snapshot.triangle_grain
    assert body not in snapshot.contact_grains
    assert len(snapshot.erased_contact) == lost > 0
    assert np.isnan(snapshot.erased_ends).all()
    assert np.isfinite(snapshot.positions).all()
    assert np.isfinite(snapshot.triangle_stress).all()
    # all other triangles are where they were
    left = before.triangle_grain != body
    assert np.array_equal(
        snapshot.reference[snapshot.triangles], before.reference[before.triangles[left]]
    )
    assert snapshot.fragments.grains.sum() == counts["grains"] - 1
    crack_picture(tmp_path / "hole.png", snapshot)
    write_vtu(tmp_path / "hole.vtu", snapshot)
    built.run(50)
    assert built.cracks.counts == (0, 0)


def test_nothing_is_left_without_bodies(make, model):
    built = make(model=model)
    O.bodies.clear()
    snapshot = built.snapshot()
    assert built.counts() == {"grains": 0, "contacts": 0}
    assert len(snapshot.positions) == len(snapshot.contact) == len(snapshot.fragments) == 0


@pytest.mark.usefixtures("look_each_tenth_step")
def test_files_of_a_run_name_erased_bonds_apart_from_cracks(specimen, model):
    gone: set[int] = set()

    def progress(*_: object) -> None:
        if not gone and O.iter > 100:
            for bond in [i for i in O.interactions.withBody(20) if i.isReal]:
                gone.add(bond.id1 if bond.id2 == 20 else bond.id2)
                O.interactions.erase(bond.id1, bond.id2)

    result = flexpm.run("tension", specimen, model=model, rate=4.0, progress=progress)
    modes = [crack.mode for crack in result.cracks]
    assert modes.count(ERASED) == len(gone) > 2
    assert (modes.count(1), modes.count(2)) == (result.tensile_cracks, result.shear_cracks)
    assert result.tensile_cracks > 0


@pytest.mark.usefixtures("look_each_tenth_step")
@pytest.mark.parametrize("test", ["uniaxial", "tension", "biaxial", "brazilian"])
def test_a_test_whose_grain_is_erased_ends_in_one_line(specimen, disc, test, model):
    def progress(*_: object) -> None:
        if O.bodies[30] is not None:
            O.bodies.erase(30)

    chosen = disc if test == "brazilian" else specimen
    with pytest.raises(InputError, match="^grain 30 = erased, must exist for a test"):
        flexpm.run(
            test,
            chosen,
            model=model,
            rate=4.0,
            confinement=2e6 if test == "biaxial" else 0.0,
            progress=progress,
        )


@pytest.mark.usefixtures("look_each_tenth_step")
@pytest.mark.parametrize("test", ["uniaxial", "brazilian"])
def test_a_test_whose_plate_is_erased_ends_in_one_line(specimen, disc, test, model):
    def progress(*_: object) -> None:
        plates = [body.id for body in O.bodies if isinstance(body.shape, wrapper.Box)]
        if len(plates) == 2:
            O.bodies.erase(plates[1])

    chosen = disc if test == "brazilian" else specimen
    with pytest.raises(InputError, match="^plate [0-9]+ = erased, must exist for a test"):
        flexpm.run(test, chosen, model=model, rate=4.0, progress=progress)
