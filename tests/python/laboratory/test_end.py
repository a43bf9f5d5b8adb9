# SPDX-License-Identifier: GPL-3.0-or-later
"""End of a confined test: the stress above the confinement has fallen to its part of the peak."""

from __future__ import annotations

import numpy as np
import pytest

import flexpm
from flexpm.results.measures import differential_stress

PRESSURE = 12e6
#: A rock that breaks at this pressure in a few inner particles too, and the strain that it needs.
WEAK, FAR = {"cohesion": 5e6, "friction": 0.1}, 0.06


@pytest.mark.long
@pytest.mark.parametrize(
    ("model", "stop_ratio", "changes", "max_strain"),
    [
        ("flexible", 0.8, {}, None),
        ("rigid", 0.8, {}, None),
        ("jcfpm", 0.8, {}, None),
        ("cohfrict", 0.5, {}, None),
        pytest.param("inner", 0.5, WEAK, FAR, marks=pytest.mark.slow),
        pytest.param("inner-un", 0.5, WEAK, FAR, marks=pytest.mark.slow),
    ],
)
def test_a_confined_test_ends_by_the_stress_above_the_confinement(
    model, stop_ratio, changes, max_strain
):
    result = flexpm.run(
        "biaxial",
        flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.01, seed=1),
        flexpm.materials.load(None, model).with_set(changes),
        model,
        confinement=PRESSURE,
        rate=8.0,
        stop_ratio=stop_ratio,
        max_strain=max_strain,
    )
    stress, strain = differential_stress(result.curve), result.curve["axial_strain"]
    largest = np.maximum.accumulate(stress)
    pressure = result.curve["confinement"][: int(np.argmax(stress))]
    assert np.median(pressure) == pytest.approx(PRESSURE, rel=0.05)
    assert stress[-1] < stop_ratio * largest[-1]
    # a fall from less than a fifth of the reference strength does not count
    counting = stress[:-1] > 0.5 * largest[-1]
    assert np.all(stress[:-1][counting] >= stop_ratio * largest[:-1][counting])
    # by the whole stress it would have gone on
    assert result.curve["axial_stress"][-1] > stop_ratio * (largest[-1] + PRESSURE)
    assert strain[-1] < 0.055


#: Specimens of both dimensions and the confined test of each.
CONFINED = {
    "plane": ("biaxial", lambda: flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.01, seed=1)),
    "space": ("triaxial", lambda: flexpm.Specimen.cylinder(0.01, 0.016, seed=1)),
}


def plateau_rows(result: flexpm.Result, end: int) -> np.ndarray:
    """Deviators of the rows before `end` within half a per cent of strain."""
    strain = result.curve["axial_strain"][:end]
    return differential_stress(result.curve)[:end][strain > strain[-1] - 0.005]


@pytest.mark.long
@pytest.mark.parametrize("where", CONFINED)
def test_a_confined_test_ends_on_a_plateau_unless_a_strain_is_given(where):
    test, made = CONFINED[where]
    specimen = made()
    asked = {"model": "rigid", "confinement": 60e6, "rate": 8.0}
    result = flexpm.run(test, specimen, **asked)
    assert result.ended_by == "plateau"
    assert result.curve["axial_strain"][-1] > 0.005
    last = plateau_rows(result, len(result.curve))
    assert np.ptp(last) <= 0.02 * last.max()
    # and not a row earlier
    before = plateau_rows(result, len(result.curve) - 1)
    strain = result.curve["axial_strain"]
    rows = int(np.argmax(strain > strain[-2] - 0.005)) - 1
    before = np.append(before, differential_stress(result.curve)[rows])
    assert np.ptp(before) > 0.02 * before.max()
    further = 1.2 * strain[-1]
    longer = flexpm.run(test, specimen, max_strain=further, **asked)
    assert longer.ended_by == "largest_strain"
    assert longer.curve["axial_strain"][-1] >= further
    assert np.array_equal(longer.curve.array[: len(strain)], result.curve.array)
