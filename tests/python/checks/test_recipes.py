# SPDX-License-Identifier: GPL-3.0-or-later
"""Recipes of own tests: each runs as it stands and leaves its folder."""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path

import pytest
from processes import captured

RECIPES = sorted(
    (Path(__file__).resolve().parents[3] / "scripts" / "tutorials" / "own").glob("*.py")
)
#: What each prints first, and between which bounds it lies.
PRINTED = {
    "beam_with_hole": (r"peak load ([\d.]+) N", 200.0, 900.0),
    "core_in_a_cell": (r"peak ([\d.]+) MPa", 125.0, 185.0),
    "cycles": (r"peak ([\d.]+) MPa", 100.0, 200.0),
    "four_point_bending": (r"strength ([\d.]+) MPa", 11.5, 40.0),
    "incline": (r"slid ([\d.]+) um", 1.0, 20.0),
    "jaws": (r"strength ([\d.]+) MPa", 10.0, 16.0),
    "joint_sets": (r"network 1: ([\d.]+) MPa", 10.0, 120.0),
    "kirsch": (r"at the side: ([\d.]+) MPa", 41.0, 44.0),
    "punch_through": (r"strength ([\d.]+) MPa", 8.0, 40.0),
}


def test_each_recipe_has_its_bounds():
    assert sorted(PRINTED) == [script.stem for script in RECIPES]


@pytest.mark.long
@pytest.mark.parametrize("script", RECIPES, ids=lambda script: script.stem)
def test_a_recipe_runs_and_leaves_its_folder(script, package_parent, tmp_path):
    done = captured(
        [sys.executable, str(script)],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(package_parent), "OMP_NUM_THREADS": "1"},
        check=True,
    )
    pattern, low, high = PRINTED[script.stem]
    found = re.search(pattern, done.stdout)
    assert found, done.stdout
    assert low < float(found[1]) < high
    results = list((tmp_path / script.stem).rglob("result.json"))
    assert results
    for result in results:
        assert json.loads(result.read_text())["status"] in ("ok", "not_quasistatic")
        assert (result.parent / "report.html").stat().st_size > 10000
