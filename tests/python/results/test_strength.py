# SPDX-License-Identifier: GPL-3.0-or-later
"""Strength criteria recover the parameters that made the peaks, and say how well they fit."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from refusals import refusal

from flexpm.results.strength import HoekBrown, MohrCoulomb, hoek_brown, mohr_coulomb, tensile_ratio

CONFINEMENTS = np.array([0.0, 2e6, 4e6, 8e6, 12e6])
several = st.lists(st.floats(0.0, 50e6), min_size=3, max_size=8)


@given(cohesion=st.floats(1e5, 1e8), angle=st.floats(-20.0, 70.0), confinements=several)
def test_mohr_coulomb_recovers_its_line(cohesion, angle, confinements):
    assume(np.ptp(confinements) > 1e5)
    line = MohrCoulomb(cohesion, angle)
    found = mohr_coulomb(confinements, line.strength(np.array(confinements)))
    assert found.cohesion == pytest.approx(cohesion, rel=1e-6)
    assert found.friction_angle == pytest.approx(angle, abs=1e-5)
    assert found.cohesion_error < 1e-5 * (cohesion + 50e6)


def test_the_line_of_table_3_implies_its_uniaxial_strength():
    line = MohrCoulomb(21e6, 53.0)
    sine = math.sin(math.radians(53.0))
    assert line.slope == pytest.approx((1.0 + sine) / (1.0 - sine))
    # 2 c cos(phi) / (1 - sin(phi))
    expected = 2.0 * 21e6 * math.cos(math.radians(53.0)) / (1.0 - sine)
    assert line.uniaxial_strength == pytest.approx(expected)


@given(sigma_ci=st.floats(1e6, 4e8), m_i=st.floats(0.5, 40.0), share=st.floats(0.05, 1.0))
def test_hoek_brown_recovers_its_curve(sigma_ci, m_i, share):
    confinements = share * sigma_ci * np.array([0.0, 0.1, 0.2, 0.5])
    made = HoekBrown(sigma_ci, m_i)
    found = hoek_brown(confinements, made.strength(confinements))
    assert found.sigma_ci == pytest.approx(sigma_ci, rel=1e-6)
    assert found.m_i == pytest.approx(m_i, rel=1e-6)
    assert (found.strength(0.0), found.strength(confinements[1])) == (
        pytest.approx(sigma_ci, rel=1e-6),
        pytest.approx(made.strength(confinements[1]), rel=1e-6),
    )


@pytest.mark.parametrize("fit", ["mohr_coulomb", "hoek_brown"])
def test_errors_of_the_fit_are_the_scatter_of_repeated_fits(fit):
    """Standard errors agree with the spread of the parameters over many noisy sets of peaks."""
    names = {
        "mohr_coulomb": ("cohesion", "friction_angle"),
        "hoek_brown": ("sigma_ci", "m_i"),
    }[fit]
    made = MohrCoulomb(21e6, 53.0) if fit == "mohr_coulomb" else HoekBrown(122e6, 25.0)
    random = np.random.default_rng(1)
    confinements = np.repeat(CONFINEMENTS, 4)
    clean = made.strength(confinements)
    found = [
        {"mohr_coulomb": mohr_coulomb, "hoek_brown": hoek_brown}[fit](
            confinements, clean + 3e6 * random.normal(size=len(clean))
        )
        for _ in range(200)
    ]
    for name in names:
        values = np.array([getattr(one, name) for one in found])
        stated = np.array([getattr(one, f"{name}_error") for one in found])
        assert np.mean(values) == pytest.approx(getattr(made, name), rel=0.02)
        # the spread of 200 values is known to 1 / sqrt(400) = 5 %; three times that
        assert np.mean(stated) == pytest.approx(np.std(values), rel=0.15)


def test_two_peaks_give_a_criterion_without_errors():
    line = mohr_coulomb([0.0, 4e6], [100e6, 140e6])
    assert line.slope == pytest.approx(10.0)
    assert line.uniaxial_strength == pytest.approx(100e6)
    assert line.cohesion_error is line.friction_angle_error is None
    curve = hoek_brown([0.0, 4e6], [100e6, 140e6])
    assert curve.strength(4e6) == pytest.approx(140e6)
    assert curve.sigma_ci_error is curve.m_i_error is None


@pytest.mark.parametrize("fit", [mohr_coulomb, hoek_brown])
@pytest.mark.parametrize(
    ("confinements", "peaks", "message"),
    [
        ([0.0], [1e8], "at least two different"),
        ([4e6, 4e6], [1e8, 1.1e8], "at least two different"),
        ([0.0, 4e6], [1e8], "one per confining pressure, 2"),
        ([0.0, -4e6], [1e8, 1e8], "confinements = -4000000.0 Pa"),
        ([0.0, 4e6], [1e8, math.nan], "peaks = nan Pa"),
        ([0.0, 4e6], [1e8, 0.9e8], "check the peaks"),
    ],
)
def test_wrong_peaks_are_refused_in_one_line(fit, confinements, peaks, message):
    refusal(message, fit, confinements, peaks)


def test_ratio_of_the_tensile_strengths():
    assert tensile_ratio(8e6, 10e6) == pytest.approx(0.8)
    assert tensile_ratio(None, 10e6) is tensile_ratio(8e6, None) is None
