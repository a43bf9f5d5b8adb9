# SPDX-License-Identifier: GPL-3.0-or-later
"""Rock files of scorecards: those that are included, and wrong ones."""

from __future__ import annotations

import math

import pytest
from refusals import refusal

from flexpm.materials.references import reference_of
from flexpm.results import strength
from flexpm.studies.scorecards import measures, rock

AUGIG = reference_of("augig")
GOOD = """
[rock]
name = "known"
source = "a laboratory"
[compressive_strength]
value = 120e6
lower = 110e6
upper = 130e6
unit = "Pa"
decides = true
[fracture_toughness.general]
lower = 0.9e6
"""


def rock_of(folder, text):
    path = folder / "rock.toml"
    path.write_text(text)
    return rock.read(path)


@pytest.mark.parametrize("name", [*rock.names(), "template"])
def test_rocks_that_are_included_can_be_read(name):
    found = rock.read(rock._ROCKS / f"{name}.toml")
    assert found.compressive_strength > 1e6
    for measure, one in found.entries.items():
        # what is not from a source decides nothing
        assert not one.decides or one.band.source, measure


def test_the_papers_rock_follows_from_its_table():
    found = rock.load("augig", "any").entries
    of_paper = {
        "youngs_modulus": AUGIG.youngs_modulus,
        "poissons_ratio": AUGIG.poissons_ratio,
        "compressive_strength": AUGIG.compressive_strength,
        "indirect_tensile_strength": AUGIG.brazilian_strength,
        "cohesion_low": AUGIG.cohesion,
        "friction_angle_low": AUGIG.friction_angle,
    }
    assert {name: found[name].value for name in of_paper} == of_paper
    assert all(found[name].decides for name in of_paper)
    # both readings of 53 degrees, and the peaks that follow
    strength_of = AUGIG.compressive_strength
    slope = math.tan(math.radians(45 + AUGIG.friction_angle / 2)) ** 2
    readings = [
        strength.hoek_brown([0.0, top], [strength_of, strength_of + slope * top])
        for top in (4e6, 12e6)
    ]
    assert [round(one.m_i) for one in readings] == [18, 22]
    for percent, share in measures.PRESSURES.items():
        if percent > 3:
            low, high = (one.strength(share * strength_of) / strength_of for one in readings)
            entry = found[f"peak_ratio_{percent}"]
            assert entry.value == pytest.approx(low, rel=0.013)
            assert entry.band.has(low) and entry.band.has(high) and not entry.decides


def test_a_preset_has_the_rock_of_its_name():
    for name in ("augig-calibrated", "augig3d-calibrated-rigid"):
        assert rock.load(None, name).name == "Augig granite"
    for name in ("red-bohus", "red-bohus-calibrated", "red-bohus3d-calibrated"):
        assert rock.load(None, name).name == "Red Bohus granite"
    for name in ("augig3", "red", "red-bohus2", "augigneiss-calibrated"):
        refusal("named after none", rock.load, None, name)
    assert "give a rock or its file" in refusal("named after none", rock.load, None, "mine")
    assert "did you mean augig?" in refusal("unknown", rock.load, "augg", "mine")


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("[rock]", "[rok]", "measure = 'rok', unknown"),
        ('name = "known"', 'nam = "known"', "did you mean name?"),
        ('name = "known"', "name = 3", "must be a text"),
        ("[compressive_strength]", "[compresive_strength]", "did you mean compressive_strength?"),
        ("value = 120e6", "vlue = 120e6", "did you mean value?"),
        ("value = 120e6\n", "", "must not be given without a value"),
        ("value = 120e6", "value = 120", "must be >= 10000"),
        ("value = 120e6", 'value = "120 MPa"', "must be a number"),
        ("value = 120e6", "value = 140e6", "must lie in its band"),
        ('unit = "Pa"', 'unit = "MPa"', "must be one of Pa"),
        ("lower = 110e6\nupper = 130e6\n", "", "no band"),
        ("lower = 110e6", "lower = 130e6\nspread = 1.0", "swap them"),
        ("lower = 110e6", "lower = 110e6\nspread = -1.0", "must be >= 0"),
        ('source = "a laboratory"\n', "", "decides, but has no source"),
        ("decides = true", "decides = 1", "true or false"),
        ("lower = 0.9e6", "lowr = 0.9e6", "did you mean lower?"),
        ("lower = 0.9e6\n", "", "no band"),
        ("[fracture_toughness.general]", "[fracture_toughness]", "without a value"),
        (
            *(
                "[fracture_toughness.general]",
                "[fracture_toughness]\ndecides = true\n[fracture_toughness.general]",
            ),
            "decides = true, must be false without a value",
        ),
        ("[compressive_strength]", "[youngs_modulus]", "confining pressures are shares"),
    ],
)
def test_wrong_rock_files_are_refused(tmp_path, old, new, says):
    assert rock_of(tmp_path, GOOD).entries["compressive_strength"].value == 120e6
    refusal(says, rock_of, tmp_path, GOOD.replace(old, new))
