# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages that come to a stress, also right after a turn, and ends that only press."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import fresh

import flexpm
from flexpm.rigs.rig import TestRig

PLANE = [("plane", model) for model in ("flexible", "rigid", "jcfpm")]
SPACE = [("space", model) for model in ("flexible", "rigid")]
BOTH = [*PLANE, *SPACE]


@pytest.fixture(scope="module")
def specimens() -> dict[str, object]:
    return {
        "plane": flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.01, seed=1),
        "space": flexpm.Specimen.cylinder(0.01, 0.016, seed=1),
    }


def rig_of(specimens: dict[str, object], where: str, model: str, *, tension: bool = False):
    return flexpm.rig(fresh(specimens[where], model=model), tension=tension)


def require_reached(rig: TestRig, stress: float) -> None:
    largest = np.abs(rig.record["axial_stress"]).max()
    assert rig.stress == rig.record["axial_stress"][-1]
    assert abs(rig.stress - stress) <= max(0.005 * abs(stress), 0.001 * largest)


@pytest.mark.parametrize(("where", "model"), BOTH)
def test_a_stage_comes_to_its_stress_also_right_after_a_turn(specimens, where, model):
    rig = rig_of(specimens, where, model)
    for stress in (30e6, 1e6, 40e6, 39e6, 0.0, 20e6):
        rig.stress_to(stress)
        require_reached(rig, stress)


@pytest.mark.parametrize(("where", "model"), BOTH)
@pytest.mark.parametrize("way", ["stress", "strain"])
def test_a_stage_that_would_pull_ends_at_zero_stress(specimens, where, model, way, capfd):
    rig = rig_of(specimens, where, model)
    rig.stress_to(40e6)
    largest = np.abs(rig.record["axial_stress"]).max()
    capfd.readouterr()
    if way == "stress":
        rig.stress_to(-5e6)
    else:
        rig.strain_to(-0.5 * rig.strain, rate=4.0)
    lines = capfd.readouterr().err.splitlines()
    assert len(lines) == 1
    assert lines[0].startswith(f"{way}_to: axial {way} = ")
    assert "the stage ends at zero stress" in lines[0]
    assert abs(rig.stress) <= 0.001 * largest
    assert rig.record["axial_stress"].min() >= -0.001 * largest
    rig.stress_to(10e6)  # and the test goes on
    require_reached(rig, 10e6)


@pytest.mark.parametrize(("where", "model"), [("plane", "flexible"), ("space", "flexible")])
def test_a_strain_that_is_reached_without_a_pull_prints_nothing(specimens, where, model, capfd):
    rig = rig_of(specimens, where, model)
    rig.strain_to(2e-4, rate=4.0)
    rig.strain_to(5e-5, rate=4.0)
    assert rig.strain == pytest.approx(5e-5, abs=2e-6)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(("where", "model"), [*PLANE[:2], *SPACE])
def test_grips_pull_and_push(specimens, where, model, capfd):
    rig = rig_of(specimens, where, model, tension=True)
    for stress in (2e6, -2e6, 1e6):
        rig.stress_to(stress)
        require_reached(rig, stress)
    rig.strain_to(-1e-5)
    assert rig.strain <= -1e-5
    assert rig.stress < 0.0
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("where", ["plane", "space"])
@pytest.mark.parametrize("bonded", [False, True])
def test_platens_of_a_custom_test_separate_unless_they_are_bonded(specimens, where, bonded, capfd):
    built = fresh(specimens[where], model="rigid")
    kind = flexpm.PartRig if where == "plane" else flexpm.SolidPartRig
    rig = kind(built)
    # a bonded plate of a solid holds across, too, and takes no friction
    held = {"friction": 0.0 if bonded and where == "space" else 0.3, "bonded": bonded}
    upper, lower = (rig.platen(side, **held) for side in (2, 0))
    area = lower.area
    down = (0.0, -1.0) if where == "plane" else (0.0, 0.0, -1.0)
    rig.drive(upper, down, against=lower, area=area)
    for stress in (10e6, 5e6):
        rig.stress_to(stress)
        require_reached(rig, stress)
    capfd.readouterr()
    rig.stress_to(-1e6)
    lines = capfd.readouterr().err.splitlines()
    if bonded:
        require_reached(rig, -1e6)
        assert lines == []
    else:
        assert abs(rig.stress) <= 0.001 * 10e6
        assert [line.split(":")[0] for line in lines] == ["stress_to"]
        before = rig.strain
        rig.strain_to(before - 1e-6)  # the platen separates from the specimen
        assert rig.strain <= before - 1e-6
        assert rig.stress == pytest.approx(0.0, abs=1e3)
