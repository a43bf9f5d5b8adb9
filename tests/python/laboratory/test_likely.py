# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps that a run announces: closed forms of the estimate, and how it grows."""

from __future__ import annotations

import pytest

from flexpm.kinds.rates import Rates
from flexpm.kinds.registry import kind_of
from flexpm.runs.likely import BRITTLE, Softening, likely_transits, slowing
from flexpm.runs.loading_rate import Loading, Scales, rates_of, schedule

RATES = Rates(0.01, likely_crossings=20.0, likely_softening=100.0)
SOFT = Softening(opening=3e-6, slip=2e-4, cohesion=2e7)
TESTS = ("uniaxial", "tension", "biaxial", "brazilian", "bending", "scb", "shear", "punch")


def transits(test, softening=SOFT, displacement=1e-5, confined=0.0, stop_ratio=0.5):
    kind = kind_of(test)
    sizes = {"displacement": displacement, "confined": confined, "stop_ratio": stop_ratio}
    return likely_transits(kind, RATES, softening, **sizes)


def test_openings_count_up_to_where_the_test_ends():
    assert transits("tension", BRITTLE) == 20.0
    assert transits("tension") == pytest.approx(20.0 + 100.0 * 0.5 * 0.3)
    assert transits("bending", stop_ratio=0.1) == pytest.approx(20.0 + 100.0 * 0.9 * 0.3)


def test_slips_take_no_longer_than_all_of_the_rock():
    assert transits("uniaxial") == pytest.approx(20.0 + 100.0 * 20.0 / 20.6)
    assert transits("uniaxial", displacement=1.0) == pytest.approx(20.0, abs=0.1)
    assert transits("uniaxial", displacement=1e-9) == pytest.approx(120.0, abs=0.1)
    assert transits("biaxial", confined=0.1) == pytest.approx(2.0 * transits("biaxial"))


def test_a_joint_without_cohesion_slides_at_the_fastest_rate():
    sizes = {"displacement": 1e-5, "strength": 4e7}
    assert slowing(RATES, SOFT, **sizes) == pytest.approx(1.0 + 100.0 * 20.0 / 20.6)
    half = slowing(RATES, SOFT, **{**sizes, "strength": 1e7})
    assert half == pytest.approx(1.0 + 0.5 * 100.0 * 20.0 / 20.6)
    assert slowing(RATES, BRITTLE, **sizes) == 1.0


@pytest.mark.parametrize("test", TESTS)
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_what_softens_longer_takes_more_steps_and_a_higher_rate_fewer(test, model):
    scales = Scales(500.0, 2e10, 2e7, 0.1, 0.05, damage_share=0.9)

    def steps(rate=1.0, soft=SOFT):
        return schedule(test, model, Loading(rate, "waiting"), scales, softening=soft).likely_steps

    grows = rates_of(test, model).likely_softening > 0.0
    assert (steps() > steps(soft=BRITTLE)) == grows
    assert steps(4.0) < steps(2.0) < steps()
