# SPDX-License-Identifier: GPL-3.0-or-later
"""Exponents of measures in keys: the script that makes them, and the table that was made."""

from __future__ import annotations

import importlib.util
import tomllib
from pathlib import Path

import pytest

from flexpm import materials
from flexpm.materials.material import Material
from flexpm.studies.scorecards import exponents, measures
from flexpm.studies.scorecards.exponents import Exponent, Exponents

STUDIES = Path(__file__).parents[3] / "scripts" / "studies"
_spec = importlib.util.spec_from_file_location("exponents", STUDIES / "exponents.py")
script = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(script)


def rows(law):
    """Measures of all packings, by a function of the key, its factor and the seed."""
    return {one: law(*one) for one in script.packings()}


def test_power_laws_have_their_exponents():
    def law(key, factor, seed):
        slope = {"cohesion": 0.5 + 0.1 * seed, "friction": -2.0}.get(key, 0.0)
        return {"compressive_strength": 1e8 * factor**slope, "crack_damage": 0.8, "class_two": 1.0}

    found = script.table_of(rows(law))
    of = found["exponents"]["compressive_strength"]
    assert of["cohesion"] == pytest.approx([0.65, 0.05])  # 0.6 and 0.7
    assert of["friction"] == pytest.approx([-2.0, 0.0]) and of["weibull"] == [0.0, 0.0]
    assert found["measures"] == {"compressive_strength": 1e8, "crack_damage": 0.8}
    assert found["material"]["cohesion"] == materials.load(script.MATERIAL).cohesion


def test_a_packing_without_one_of_both_values_tells_no_exponent():
    def law(key, factor, seed):
        known = not (key == "cohesion" and seed == 2 and factor < 1.0) and key != "weibull"
        return {"compressive_strength": 1e8 * factor} if known else {}

    of = script.table_of(rows(law))["exponents"]["compressive_strength"]
    assert of["cohesion"] == [1.0]  # without an error
    assert "weibull" not in of and of["friction"] == [1.0, 0.0]


def test_the_table_follows_from_its_rows():
    made = script.table_of(script.read_rows(STUDIES / "exponents.csv"))
    assert tomllib.loads(exponents.FILE.read_text()) == made


def test_measured_exponents_keep_stresses_similar():
    """Strengths times k and energies times k^2 multiply stresses by k, and leave quotients."""
    table = exponents.load("flexible", "2D")
    assert table is not None and exponents.load("rigid", "2D") is None
    weights = {
        **dict.fromkeys(("tensile_strength", "cohesion"), 1.0),
        **dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 2.0),
    }
    names = ("compressive_strength", "direct_tensile_strength", "indirect_tensile_strength")
    for name in (*names, "direct_indirect_ratio", "compressive_indirect_ratio"):
        found = sum(weight * table.of[name][key].value for key, weight in weights.items())
        assert found == pytest.approx(1.0 if name in names else 0.0, abs=0.15), name
    assert {*table.of} <= {*measures.MEASURES}
    assert Material.from_dict(table.material).weibull == table.material["weibull"]


def test_keys_are_named_by_the_size_of_their_exponents():
    of = {
        "cohesion": Exponent(0.6, 0.1),
        "friction": Exponent(-0.7, 0.1),
        "weibull": Exponent(0.3, 0.2),  # within its scatter
        "normal_stiffness": Exponent(0.05, 0.001),  # too small
        "tensile_strength": Exponent(0.2),
    }
    table = Exponents("flexible", "2D", 0.15, {}, {}, {"drop_30": of})
    assert table.text("drop_30") == "friction -0.70, cohesion +0.60, tensile_strength +0.20"
    assert table.text("drop_50") == ""
