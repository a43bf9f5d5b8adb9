# SPDX-License-Identifier: GPL-3.0-or-later
"""Elastic constants of solids: their bounds, and what is refused."""

import dataclasses

import pytest
from refusals import refusal

import flexpm
from flexpm import Specimen
from flexpm.errors import InputError
from flexpm.materials.material import load


@pytest.fixture(scope="module")
def box():
    return Specimen.box(0.012, 0.013, 0.018, seed=2)


def with_stiffness(normal_stiffness):
    rock = load("augig-table7")
    own = dataclasses.replace(rock.elastic["flexible"], normal_stiffness=normal_stiffness)
    return dataclasses.replace(rock, elastic={"flexible": own})


def test_constants_tend_to_those_of_the_grains(box):
    young, poisson = 25.8e9, 0.23
    found = flexpm.elastic(box, "augig-table7")
    # contacts of 1.8e14 Pa/m in series with grains of 3 mm take some per cent
    assert 0.93 * young < found["youngs_modulus"] < 0.97 * young
    assert found["grains"] == box.cells.cells
    stiff = flexpm.elastic(box, with_stiffness(1.8e16))
    assert stiff["youngs_modulus"] == pytest.approx(young, rel=2e-3)
    assert stiff["poissons_ratio"] == pytest.approx(poisson, rel=2e-3)
    assert stiff["youngs_modulus"] < young


def test_a_cylinder_has_the_constants_of_a_box(box):
    core = Specimen.cylinder(0.014, 0.02)
    found, other = flexpm.elastic(core), flexpm.elastic(box)
    assert found["youngs_modulus"] == pytest.approx(other["youngs_modulus"], rel=0.01)
    assert found["poissons_ratio"] == pytest.approx(other["poissons_ratio"], rel=0.03)
    # the same bits again
    assert flexpm.elastic(core) == found


def test_what_solids_do_not_have_is_refused(box):
    with pytest.raises(InputError, match="model for a box = 'inner', must be one of flexible, ri"):
        flexpm.elastic(box, model="inner")
    with pytest.raises(InputError, match="specimen = solid-disc, must be a box or a cylinder"):
        flexpm.elastic(Specimen.solid_disc(0.012, 0.008))
    refusal("points, mesh = 1, refined, must not be given", flexpm.elastic, box, points=1)
    refusal("build: points, mesh = 1, refined, must not be given", flexpm.build, box, points=1)
