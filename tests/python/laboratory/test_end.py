# SPDX-License-Identifier: GPL-3.0-or-later
"""End of a confined test: the stress above the confinement has fallen to its part of the peak."""

from __future__ import annotations

import numpy as np
import pytest

import flexpm
from flexpm.results.measures import differential_stress
from flexpm.runs import loading_rate

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


#: Specimen of both dimensions, the confined test of each, and a pressure under which its deviator
#: is constant within 2 % over a strain of 0.1 % before it fails [Pa].
CONFINED = {
    "plane": (
        *("biaxial", 20e6),
        lambda: flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.01, seed=1),
    ),
    "space": ("triaxial", 10e6, lambda: flexpm.Specimen.cylinder(0.01, 0.016, seed=1)),
}
PLATEAU = 1e-3


def range_before(result: flexpm.Result, end: int) -> float:
    """Range of the deviator over the strain of a plateau up to a row, over its largest value."""
    strain = result.curve["axial_strain"][:end]
    first = int(np.flatnonzero(strain[-1] - strain >= PLATEAU)[-1])
    rows = differential_stress(result.curve)[first:end]
    return float(np.ptp(rows) / rows.max())


@pytest.mark.long
@pytest.mark.parametrize("where", CONFINED)
def test_a_confined_test_ends_on_a_plateau_unless_a_strain_is_given(where, monkeypatch):
    # small specimens harden or fall: a shorter plateau than that of the rule shows the rule
    monkeypatch.setattr(loading_rate, "PLATEAU_STRAIN", PLATEAU)
    test, pressure, made = CONFINED[where]
    specimen = made()
    asked = {"model": "rigid", "confinement": pressure, "rate": 4.0}
    result = flexpm.run(test, specimen, **asked)
    assert result.ended_by == "plateau"
    rows = len(result.curve)
    assert range_before(result, rows) <= 0.02
    started = int(np.argmax(result.curve["axial_strain"] > PLATEAU))
    for end in range(started + 2, rows):  # and at no row before
        assert range_before(result, end) > 0.02
    further = result.curve["axial_strain"][-1] + PLATEAU
    longer = flexpm.run(test, specimen, max_strain=further, **asked)
    assert longer.ended_by == "largest_strain"
    assert longer.curve["axial_strain"][-1] >= further
    assert np.array_equal(longer.curve.array[:rows], result.curve.array)


def test_a_plateau_ends_only_tests_under_a_pressure_without_a_largest_strain():
    scales = loading_rate.Scales(100.0, 3e10, 1e8, 0.03, 0.015)
    for pressure, largest, expected in ((5e6, None, 0.005), (0.0, None, 0.0), (5e6, 0.02, 0.0)):
        asked = loading_rate.Loading(max_strain=largest)
        plan = loading_rate.schedule("biaxial", "rigid", asked, scales, confinement=pressure)
        assert plan.plateau_strain == expected
