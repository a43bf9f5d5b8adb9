# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's specimen at full size: 80 x 160 mm, 1630 grains. About half an hour."""

from statistics import mean

import numpy as np
import pytest

import flexpm

pytestmark = pytest.mark.slow


def paper_specimen(seed: int) -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(0.08, 0.16, thickness=0.08, seed=seed)


def test_table_7_compression():
    result = flexpm.run("uniaxial", paper_specimen(1))
    assert result.status == "ok"
    assert result.youngs_modulus == pytest.approx(24.3e9, rel=0.02)
    assert result.poissons_ratio == pytest.approx(0.23, abs=0.01)
    assert result.energy_error < 0.01
    record = result.curve
    row = int(np.argmax(record["axial_stress"] >= 0.75 * result.peak_stress))
    secant = record["axial_stress"][row] / record["axial_strain"][row]
    assert secant == pytest.approx(result.youngs_modulus, rel=0.03)  # one slope


def test_halving_the_rate_moves_the_mean_peak_by_less_than_2_percent():
    peaks = {
        rate: mean(
            flexpm.run("uniaxial", paper_specimen(seed), rate=rate).peak_stress
            for seed in (1, 2, 3)
        )
        for rate in (1.0, 0.5)
    }
    assert peaks[0.5] == pytest.approx(peaks[1.0], rel=0.02)
