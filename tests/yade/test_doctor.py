# SPDX-License-Identifier: GPL-3.0-or-later
"""flexpm doctor finds a sound installation sound, and names what is wrong with a broken one."""

from __future__ import annotations

import importlib.util

import pytest

from flexpm import _flexpm, _plugin
from flexpm.cli import doctor


def test_sound_installation() -> None:
    found = list(doctor.checks())
    assert [check for check in found if not check[1]] == []
    assert {"yade", "plugin", "sizes of classes", "forces and energies"} <= {c[0] for c in found}
    assert all(text and "\n" not in text for _, _, text in found)


def test_an_instruction_set_is_used_that_the_machine_has() -> None:
    assert _flexpm.instruction_sets()[0] == "baseline"
    assert _flexpm.instruction_set() == _flexpm.instruction_sets()[-1]
    with pytest.raises(ValueError, match="instruction set = 'neon', must be available .* baseline"):
        _flexpm.use_instruction_set("neon")
    _flexpm.use_instruction_set("baseline")
    assert _flexpm.instruction_set() == "baseline"
    _flexpm.use_instruction_set(_flexpm.instruction_sets()[-1])


def test_running_simulation_is_left_alone() -> None:
    from yade import utils
    from yade.wrapper import FrictMat, Omega

    scene = Omega()
    scene.materials.append(FrictMat())
    scene.bodies.append(utils.sphere((0, 0, 0), 1))
    assert all(ok for _, ok, _ in doctor.checks())
    assert len(scene.bodies) == 1 and tuple(scene.forces.f(0)) == (0, 0, 0)


@pytest.mark.parametrize(
    ("fault", "part"),
    [
        ("size:State", "sizes of classes"),
        ("vtable:State", "virtual tables"),
        ("attribute:State.vel", "attribute offsets"),
    ],
)
def test_layout_mismatch_is_named(monkeypatch: pytest.MonkeyPatch, fault: str, part: str) -> None:
    report = _flexpm.abi_report(fault)
    monkeypatch.setattr(_flexpm, "abi_report", lambda: report)
    wrong = {name: text for name, ok, text in doctor.checks() if not ok}
    assert "State" in wrong[part] and _plugin.REMEDY in wrong[part]


def test_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    real = importlib.util.find_spec

    def find_spec(name: str) -> object:
        return None if name == "vtkmodules" else real(name)

    monkeypatch.setattr(importlib.util, "find_spec", find_spec)
    wrong = {name: text for name, ok, text in doctor.checks() if not ok}
    assert list(wrong) == ["vtkmodules"] and "python3-vtk9" in wrong["vtkmodules"]
