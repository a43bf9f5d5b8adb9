# SPDX-License-Identifier: GPL-3.0-or-later
"""Flexible against rigid grains at equal strengths, paper Sec. 4.3: means of three packings.

The runs are those of scripts/studies/trends.py, each done once.
"""

from __future__ import annotations

import functools
import importlib.util
import sys
from pathlib import Path
from statistics import mean

import pytest

from flexpm.results import strength

pytestmark = pytest.mark.slow

BILINEAR, BRITTLE = "augig-table2-bilinear", "augig-table2-brittle"


def _study():
    file = Path(__file__).parents[2] / "scripts" / "studies" / "trends.py"
    spec = importlib.util.spec_from_file_location("trends", file)
    module = sys.modules["trends"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def runs():
    """Give the runs of all seeds for (material, model, test, confinement)."""
    study = _study()

    @functools.cache
    def of(material, model, test, confinement=0.0):
        return [study.run(material, model, test, confinement, seed) for seed in study.SEEDS]

    return of


def peak(found):
    return mean(run.peak_stress for run in found)


def tensile_ratio(runs, material, model):
    direct, indirect = (runs(material, model, test) for test in ("tension", "brazilian"))
    return strength.tensile_ratio(peak(direct), peak(indirect))


def friction_angle(runs, model):
    tests = {0.0: "uniaxial", 4e6: "biaxial", 12e6: "biaxial"}
    peaks = [peak(runs(BILINEAR, model, test, at)) for at, test in tests.items()]
    return strength.mohr_coulomb(list(tests), peaks).friction_angle


def tangent_modulus_ratio(runs, model):
    return mean(run.tangent_modulus_ratio for run in runs(BILINEAR, model, "uniaxial"))


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_brittle_contacts_are_stronger_in_direct_than_in_indirect_tension(runs, model):
    assert tensile_ratio(runs, BRITTLE, model) > 1.0


def test_bilinear_flexible_grains_are_weaker_in_direct_than_in_indirect_tension(runs):
    assert tensile_ratio(runs, BILINEAR, "flexible") < 1.0


def test_bilinear_rigid_grains_are_about_as_strong_in_direct_as_in_indirect_tension(runs):
    assert 0.85 < tensile_ratio(runs, BILINEAR, "rigid") < 1.15


def test_bilinear_flexible_grains_have_the_lower_direct_over_indirect_tension(runs):
    flexible, rigid = (tensile_ratio(runs, BILINEAR, model) for model in ("flexible", "rigid"))
    assert flexible < rigid


def test_rigid_grains_have_two_slopes_and_flexible_ones_have_one(runs):
    """The modulus around 80 % of the peak, over that around 20 %."""
    assert tangent_modulus_ratio(runs, "rigid") < 0.9
    assert tangent_modulus_ratio(runs, "flexible") > 0.9


def test_flexible_grains_are_stronger_in_compression(runs):
    flexible, rigid = (peak(runs(BILINEAR, model, "uniaxial")) for model in ("flexible", "rigid"))
    assert flexible > rigid


def test_friction_angles_are_alike(runs):
    """Within two standard errors of three packings. The paper has that of flexible grains above;
    over the eight packings of the study it lies 0.1 +- 0.7 degrees above that of rigid ones."""
    flexible, rigid = (friction_angle(runs, model) for model in ("flexible", "rigid"))
    assert abs(flexible - rigid) < 3.0
