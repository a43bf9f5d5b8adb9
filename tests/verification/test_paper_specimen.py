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


@pytest.mark.parametrize(
    ("model", "material", "young", "poisson"),
    [
        ("rigid", "augig-table2-bilinear", 25.4e9, 0.238),
        ("flexible", "augig-table7-quartz", 25.2e9, 0.236),
    ],
)
def test_table_1_by_stepping(model, material, young, poisson):
    """The start of a compression test gives what the elastic solve gives."""
    unbroken = flexpm.materials.load(material, model).with_set(
        ["tensile_strength=1e10", "cohesion=1e10", "softening=brittle"], model
    )
    # the loading rate follows the strengths: this makes it that of the granite's
    slow = flexpm.materials.load(material, model).cohesion / 1e10
    result = flexpm.run("uniaxial", paper_specimen(1), unbroken, model, max_strain=1e-3, rate=slow)
    assert result.youngs_modulus == pytest.approx(young, rel=0.02)
    assert result.poissons_ratio == pytest.approx(poisson, abs=0.015)


def test_halving_the_rate_moves_the_mean_peak_by_less_than_2_percent():
    peaks = {
        rate: mean(
            flexpm.run("uniaxial", paper_specimen(seed), rate=rate).peak_stress
            for seed in (1, 2, 3)
        )
        for rate in (1.0, 0.5)
    }
    assert peaks[0.5] == pytest.approx(peaks[1.0], rel=0.02)
