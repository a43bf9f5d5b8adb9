# SPDX-License-Identifier: GPL-3.0-or-later
"""End of a confined test: the stress above the confinement has fallen to its part of the peak."""

from __future__ import annotations

import numpy as np
import pytest

import flexpm
from flexpm.results.measures import differential_stress

PRESSURE = 12e6
STOP_RATIO = 0.8


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid", "jcfpm"])
def test_a_confined_test_ends_by_the_stress_above_the_confinement(model):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.01, seed=1)
    result = flexpm.run(
        "biaxial", specimen, model=model, confinement=PRESSURE, rate=8.0, stop_ratio=STOP_RATIO
    )
    stress, strain = differential_stress(result.curve), result.curve["axial_strain"]
    largest = np.maximum.accumulate(stress)
    assert result.curve["confinement"][: int(np.argmax(stress))] == pytest.approx(PRESSURE, rel=0.1)
    assert stress[-1] < STOP_RATIO * largest[-1]
    # a fall from less than a fifth of the reference strength does not count
    counting = stress[:-1] > 0.5 * largest[-1]
    assert np.all(stress[:-1][counting] >= STOP_RATIO * largest[:-1][counting])
    # by the whole stress it would have gone on
    assert result.curve["axial_stress"][-1] > STOP_RATIO * (largest[-1] + PRESSURE)
    assert strain[-1] < 0.05
