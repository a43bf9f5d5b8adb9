# SPDX-License-Identifier: GPL-3.0-or-later
"""Soft strips before platens are springs in a row with the specimen: closed forms."""

from __future__ import annotations

import pytest
from scenes import fresh

import flexpm

WIDTH, LENGTH, THICKNESS = 0.012, 0.03, 0.01
AREA = WIDTH * THICKNESS


def between_strips(model: str, first: float | None, second: float | None, **leaves: object):
    """A bar between smooth platens with strips [Pa/m]: its rig, its driven platen."""
    bar = flexpm.Specimen.rectangle(WIDTH, LENGTH, THICKNESS, seed=3)
    rig = flexpm.PartRig(fresh(bar, model=model), **leaves)
    floor, top = rig.platen(0, strip=first), rig.platen(2, strip=second)
    # a grain in the middle, or more, is kept from sliding along the platens
    rig.hold(disc=((0.5 * WIDTH, 0.5 * LENGTH), 2e-3), axes="x")
    rig.drive(top, (0.0, -1.0), against=floor)
    return rig, top


def compliance(model: str, first: float | None, second: float | None) -> float:
    return 1e-7 / between_strips(model, first, second)[0].elastic(displacement=1e-7).load


@pytest.mark.parametrize("strips", [(None, None), (1e12, None), (1e12, 3e12), (1e11, 2e11)])
def test_a_bar_gives_by_its_modulus_its_platens_and_its_strips(strips):
    """L / (E A) + 2 / (K_n A) + the sum of 1 / (k A)."""
    bar = flexpm.Specimen.rectangle(WIDTH, LENGTH, THICKNESS, seed=3)
    young = flexpm.elastic(bar)["youngs_modulus"]
    plates = flexpm.materials.load("augig-table7").law("flexible")["normal_stiffness"]
    layers = sum(1.0 / strip for strip in strips if strip is not None)
    whole = (LENGTH / young + 2.0 / plates + layers) / AREA
    assert compliance("flexible", *strips) == pytest.approx(whole, rel=1e-3)


def test_strips_add_to_rigid_grains_what_they_give_alone():
    """Rigid grains bear on a platen unevenly, on soft strips they do not."""
    alone = (1.0 / 1e11 + 1.0 / 2e11) / AREA
    added = compliance("rigid", 1e11, 2e11) - compliance("rigid", None, None)
    assert added == pytest.approx(alone, rel=1e-3)


def test_the_loaded_bar_comes_to_rest_at_the_same_stiffness():
    rig, top = between_strips("flexible", 1e12, 2e12)
    state = rig.elastic(displacement=2e-6)
    rig.strain_to(2e-6, rate=0.1)
    rig.relax()
    way = -top.displacement[1]
    assert -top.force[1] == pytest.approx(state.load * way / 2e-6, rel=1e-3)
    energies = rig.built.solver.energies()
    # springs in a row store half of load times way
    assert energies["elastic_energy"] == pytest.approx(-0.5 * top.force[1] * way, rel=1e-3)
    assert rig.warnings == []
