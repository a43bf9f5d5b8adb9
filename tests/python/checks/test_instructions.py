# SPDX-License-Identifier: GPL-3.0-or-later
"""The guard on the step's instructions lets small changes pass and catches larger ones."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[3] / "scripts" / "checks" / "instructions.py"
spec = importlib.util.spec_from_file_location("instructions", SCRIPT)
assert spec is not None and spec.loader is not None
instructions = importlib.util.module_from_spec(spec)
spec.loader.exec_module(instructions)


def counts(factor: float, compiler: str = "12") -> dict:
    return {
        "compiler": compiler,
        "instructions": {case: round(1e6 * factor) for case in instructions.CASES},
    }


@pytest.mark.parametrize(("factor", "status"), [(0.9, 0), (1.0, 0), (1.04, 0), (1.06, 1)])
def test_tolerance(factor: float, status: int) -> None:
    assert instructions._compare(counts(factor), counts(1.0)) == status


def test_one_slower_case_fails() -> None:
    found = counts(1.0)
    found["instructions"]["softening"] *= 2
    assert instructions._compare(found, counts(1.0)) == 1


def test_other_compiler_fails(capsys: pytest.CaptureFixture) -> None:
    assert instructions._compare(counts(1.0, "13"), counts(1.0)) == 1
    assert "compiler = 13, must be 12" in capsys.readouterr().err
