# SPDX-License-Identifier: GPL-3.0-or-later
"""Scorecards: measures of made-up results, verdicts, files, and runs that resume."""

from __future__ import annotations

import csv
import json
import math
import os
import signal
from dataclasses import replace
from importlib.resources import files

import pytest
from killed_scripts import HELPERS
from processes import captured, is_free, wait_for
from refusals import refusal, refused_command
from sample_rows import row as record_row

from flexpm import materials
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.kinds.registry import KINDS
from flexpm.results import strength
from flexpm.results.record import Curve
from flexpm.results.result import Result
from flexpm.studies import pages
from flexpm.studies.scorecards import card, exponents, measures, output, runs
from flexpm.studies.scorecards.measures import MEASURES, Ended, Measure, Value
from flexpm.studies.scorecards.rock import Band, Entry, Rock
from flexpm.studies.scorecards.rock import load as load_rock
from flexpm.studies.scorecards.verdict import MET, NOT_KNOWN, NOT_MET, judge, judge_all

STRENGTH = MEASURES["compressive_strength"]
ENTRY = Entry(100e6, None, Band(90e6, 110e6, "a laboratory"), decides=True)


def numbers(*given):
    return [Value(one) for one in given]


# Verdicts


@pytest.mark.parametrize(
    ("given", "mean", "within", "verdict"),
    [
        ((100e6,) * 5, 100e6, 5, MET),
        ((90e6, 110e6), 100e6, 2, MET),
        ((80e6, 120e6, 100e6, 100e6, 100e6), 100e6, 5, MET),  # the ends of twice the band
        ((75e6, 100e6, 100e6, 100e6, 105e6), 96e6, 4, MET),  # four of five
        ((75e6, 125e6, 100e6, 100e6, 100e6), 100e6, 3, NOT_MET),  # the mean alone is not enough
        ((111e6,) * 5, 111e6, 5, NOT_MET),
        ((100e6,), 100e6, 1, MET),
    ],
)
def test_the_mean_lies_in_the_band_and_packings_within_twice_the_band(given, mean, within, verdict):
    found = judge(STRENGTH, numbers(*given), ENTRY, full=False)
    assert (found.verdict, found.within, found.reasons) == (verdict, within, ())
    assert found.mean == pytest.approx(mean)
    if len(given) == 1:
        assert found.error is None
    else:
        spread = math.sqrt(sum((one - mean) ** 2 for one in given) / (len(given) - 1))
        assert found.error == pytest.approx(spread / math.sqrt(len(given)), abs=1e-3)


@pytest.mark.parametrize(
    ("lower", "upper", "given", "verdict"),
    [
        (0.1, None, 0.1, MET),
        (0.1, None, 50.0, MET),
        (0.1, None, 0.09, NOT_MET),
        (None, 0.3, -9.0, MET),
        (None, 0.3, 0.31, NOT_MET),
    ],
)
def test_a_band_may_be_open(lower, upper, given, verdict):
    entry = Entry(0.2, None, Band(lower, upper, "s"))
    assert judge(MEASURES["drop_30"], numbers(given), entry, full=False).verdict == verdict


def test_packings_that_do_not_count_leave_a_row_unknown():
    def of(*values):
        return judge(STRENGTH, values, ENTRY, full=True)

    good, fast, none = Value(100e6), Value(95e6, "not quasi-static"), Value(None, "no peak")
    assert of(good, good, good, good, none).verdict == MET  # four of five count
    found = of(good, good, good, none, none)
    assert (found.verdict, found.reasons) == (NOT_KNOWN, ("no peak in 2 of 5",))
    assert (found.mean, found.within) == (100e6, 3)
    found = of(fast, fast, fast)
    assert (found.verdict, found.reasons) == (NOT_KNOWN, ("not quasi-static",))
    assert (found.mean, found.within) == (95e6, 0)  # shown, and not counted
    assert of(none).mean is None
    found = of(none, fast, good, good, good)  # each reason alone would leave four of five
    assert found.reasons == ("no peak in 1 of 5", "not quasi-static in 1 of 5")


def test_small_specimens_leave_rows_unknown_that_depend_on_size():
    entry = Entry(8.8e6, None, Band(8e6, 9e6, "s"), decides=True)
    for name in MEASURES:
        if MEASURES[name].needs_size:
            assert judge(MEASURES[name], numbers(8.5e6), entry, full=False).reasons == ("size",)
            assert judge(MEASURES[name], numbers(8.5e6), entry, full=True).verdict == MET
    assert {name for name, one in MEASURES.items() if one.needs_size} == {
        *("indirect_tensile_strength", "direct_indirect_ratio", "compressive_indirect_ratio"),
        "fracture_toughness",
    }


def test_a_row_without_a_value_is_never_judged():
    for entry in (None, Entry(general=Band(1.0, 2.0))):
        found = judge(STRENGTH, numbers(1.5), entry, full=True)
        assert (found.verdict, found.reasons) == (NOT_KNOWN, ("no value",))
        assert not found.fails(full=True) and found.mean == 1.5


@pytest.mark.parametrize(
    ("value", "decides", "small", "full"),
    [
        (Value(100e6), True, False, False),
        (Value(50e6), True, True, True),
        (Value(50e6), False, False, False),
        (Value(None, "no peak"), True, False, True),
        (Value(None, "no peak"), False, False, False),
    ],
)
def test_only_rows_that_decide_fail_and_unknown_ones_only_with_full_specimens(
    value, decides, small, full
):
    entry = Entry(ENTRY.value, None, ENTRY.band, decides)
    assert judge(STRENGTH, [value], entry, full=False).fails(full=False) == small
    assert judge(STRENGTH, [value], entry, full=True).fails(full=True) == full


# Measures of made-up results


def curve_through(*points, **columns):
    made = Curve()
    for number, (strain, stress) in enumerate(points):
        values = {name: of[number] for name, of in columns.items()}
        made.append(**record_row(axial_strain=strain, axial_stress=stress, **values))
    return made


def ended(test, curve=None, **values):
    basic = {
        **{"flexpm": "0", "yade": "0", "test": test, "model": "rigid", "material": {"name": "m"}},
        **{"seed": 1, "grains": 9, "contacts": 9, "nodes": None, "triangles": None},
    }
    result = Result(**basic, **values, curve=curve or Curve())
    return Ended(result, {key: value for key, value in values.items() if value is not None})


def granite(**changes):
    """Runs of a packing: a Hoek-Brown rock of 100 MPa and m_i 20."""
    law = strength.HoekBrown(100e6, 20.0)
    up = curve_through(
        *((0.0, 0.0), (0.002, 50e6), (0.0036, 90e6), (0.004, 100e6), (0.005, 10e6)),
        lateral_strain=(0.0, 0.0004, 0.0009, 0.002, 0.004),
        tensile_cracks=(0, 0, 8, 30, 99),
        shear_cracks=(0, 0, 0, 10, 99),
    )
    found = {
        "solved": Ended(numbers={"youngs_modulus": 25e9, "poissons_ratio": 0.2}),
        "compressed": ended(
            *("uniaxial", up),
            peak_stress=100e6,
            crack_initiation_stress=45e6,
            crack_damage_stress=80e6,
            null_reasons={"crack_initiation_stress_volumetric": "cracks do not widen it"},
            cracks_by_pair={"a/b": {"tensile": 3, "shear": 1}},
        ),
        "controlled": ended("uniaxial", peak_stress=99e6, softening_slope=20e9),
        "pulled": ended("tension", peak_stress=6e6),
        "split": ended("brazilian", peak_stress=8e6),
        "notched": ended("scb", peak_stress=1e6, fracture_toughness=1.1e6),
    }
    for percent, share in measures.PRESSURES.items():
        pressure = share * 100e6
        peak = float(law.strength(pressure))
        falling = curve_through(
            *((0.0, pressure), (0.01, peak), (0.02, peak - 0.5 * (peak - pressure))),
            lateral_strain=(0.0, 0.002, 0.022),
            confinement=(pressure,) * 3,
        )
        run = ended("triaxial", falling, peak_stress=peak, inputs={"confinement": pressure})
        found[measures.confined(percent)] = run
    return {**found, **changes}


def test_measures_of_a_known_rock():
    found = runs.values_of(granite(), solid=True)
    assert {name for name, one in found.items() if one.reason} == {"crack_initiation_volumetric"}
    assert found["crack_initiation_volumetric"] == Value(None, "cracks do not widen it")
    known = {
        "youngs_modulus": 25e9,
        "compressive_strength": 100e6,
        "crack_initiation": 0.45,
        "crack_damage": 0.8,
        "secant_poissons_ratio_25": 0.2,
        "secant_poissons_ratio_90": 0.25,
        "tensile_share": 0.75,
        "class_two": 1.0,
        "direct_indirect_ratio": 0.75,
        "compressive_indirect_ratio": 12.5,
        "fracture_toughness": 1.1e6,
        "hoek_brown_m": 20.0,
        "drop_30": 0.25,  # half of it over 1 % of strain
        "dilation_50": 4.0,  # 2 % of lateral strain over 1 %
        "dilation_angle_50": math.degrees(math.asin(3.0 / 5.0)),
    }
    assert {name: found[name].number for name in known} == pytest.approx(known)
    law = strength.HoekBrown(100e6, 20.0)
    line = strength.mohr_coulomb([0.0, 3e6], [100e6, law.strength(3e6)])
    assert found["friction_angle_low"].number == pytest.approx(line.friction_angle)
    assert found["cohesion_low"].number == pytest.approx(line.cohesion)
    assert found["friction_angle_wide"].number < line.friction_angle
    assert found["peak_ratio_10"].number == pytest.approx(law.strength(10e6) / 100e6)
    # 2D has one lateral direction
    assert runs.values_of(granite(), solid=False)["dilation_50"].number == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("change", "measure", "reason"),
    [
        ({"split": ended("brazilian", status="no_peak")}, "direct_indirect_ratio", "no peak"),
        (
            {"pulled": ended("tension", peak_stress=6e6, status="not_quasistatic")},
            *("direct_tensile_strength", "not quasi-static"),
        ),
        ({"notched": ended("scb", status="diverged")}, "fracture_toughness", "diverged"),
        ({"split": Ended(message="exit")}, "compressive_indirect_ratio", "run failed"),
        ({"confined_30": ended("triaxial", status="no_peak")}, "hoek_brown_m", "no peak"),
        ({"controlled": ended("uniaxial", status="no_peak")}, "class_two", "no peak"),
        ({"confined_3": ended("triaxial", peak_stress=90e6)}, "cohesion_low", "no criterion fits"),
        (
            {f"confined_{one}": ended("triaxial", peak_stress=90e6) for one in (3, 10, 30, 50)},
            *("hoek_brown_m", "no criterion fits"),
        ),
        (
            {"split": ended("brazilian", peak_stress=8e6, first_crack_distance=0.8)},
            *("indirect_tensile_strength", "first cracks at the plates"),
        ),
        (
            {"split": ended("brazilian", peak_stress=8e6, first_crack_distance=0.65)},
            *("indirect_tensile_strength", ""),
        ),
        (
            {"notched": ended("scb", fracture_toughness=1e6, peak_stress=1e6)},
            *("fracture_toughness", ""),
        ),
        (
            {
                "notched": ended(
                    "scb", fracture_toughness=1e6, peak_stress=1e6, first_crack_distance=0.6
                )
            },
            *("fracture_toughness", "first cracks far from the notch"),
        ),
    ],
)
def test_reasons_of_measures_that_do_not_count(change, measure, reason):
    assert runs.values_of(granite(**change), solid=True)[measure].reason == reason


def test_grains_that_overlap_spoil_what_follows_the_peak_in_3d():
    run = granite()["confined_30"].result
    run.largest_clearance = 0.05
    for solid, spoilt in ((True, {"drop_30", "dilation_30", "dilation_angle_30"}), (False, set())):
        found = runs.values_of(granite(confined_30=Ended(run)), solid=solid)
        assert {name for name, one in found.items() if one.reason == "overlap"} == spoilt
    assert found["peak_ratio_50"].reason == ""


def test_a_rock_that_never_peaks_has_a_drop_once_the_window_is_whole():
    flat = curve_through((0.0, 0.0), (0.01, 100e6), (0.02, 98e6))
    still = ended("triaxial", flat, status="no_peak")
    found = runs.values_of(granite(confined_30=still), solid=True)
    assert found["drop_30"] == Value(pytest.approx(0.01), "")
    assert found["peak_ratio_30"].reason == "no peak"
    rising = ended("triaxial", flat.until(2), status="no_peak")
    found = runs.values_of(granite(confined_30=rising), solid=True)
    assert found["drop_30"] == found["dilation_30"] == Value(None, "ends early")


def test_a_specimen_that_contracts_has_no_dilation_angle():
    falling = curve_through(
        *((0.0, 0.0), (0.01, 100e6), (0.02, 50e6)), lateral_strain=(0.0, 0.002, -0.002)
    )
    still = ended("triaxial", falling, peak_stress=100e6)
    found = runs.values_of(granite(confined_30=still), solid=True)
    assert found["dilation_30"] == Value(pytest.approx(-0.8), "")
    assert found["dilation_angle_30"] == Value(None, "D <= 0")


def test_cracks_by_pair_are_shares_of_all_cracks():
    shares = {"pair": "a/b", "tensile": 0.75, "shear": 0.25}
    assert runs.pairs_of([granite(), granite()]) == [shares]
    assert runs.pairs_of([{}]) == []


# Runs of a scorecard, and its files


def plan_of(material="augig-calibrated", **options):
    return card.plan_of(material, options)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"model": "rigd"}, "did you mean rigid?"),
        ({"model": "jcfpm"}, "must be flexible or rigid"),
        ({"shape": "disc"}, "known are rectangle, box, cylinder"),
        ({"size": "tiny"}, "must be one of small, full"),
        ({"seeds": [1, 1]}, "each once"),
        ({"seeds": []}, "one or more"),
        ({"seeds": [-1]}, "seed"),
        ({"seeds": 41}, "whole numbers in a list"),
        ({"seeds": [[41]]}, "seeds = [41], must be a whole number"),
        ({"seed": 41}, "did you mean seeds?"),
        ({"sizes": "full"}, "did you mean size?"),
        ({"rock": "none.toml"}, "cannot be read"),
    ],
)
def test_wrong_options_are_refused(options, says):
    refusal(says, lambda: plan_of(**options))


def test_the_command_refuses_in_one_line(capsys):
    refused_command(capsys, "unknown preset", "scorecard", "augig-calibratd")
    refused_command(capsys, "did you mean small", "scorecard", "augig-calibrated", "--size", "smal")


@pytest.mark.parametrize(
    ("material", "shape", "tests"),
    [
        ("augig-calibrated", "rectangle", {"biaxial": 4, "brazilian": 1}),
        ("augig3d-calibrated-rigid", "box", {"triaxial": 4, "brazilian": 1}),
    ],
)
def test_runs_follow_the_dimension_of_the_material(material, shape, tests):
    plan = plan_of(material, seeds=[41, 42])
    assert (plan.shape, plan.model) == (shape, "rigid" if "rigid" in material else "flexible")
    jobs = plan.jobs
    assert len(jobs) == 2 and len({job.key for one in jobs.values() for job in one.values()}) == 20
    asked = [job.inputs for job in jobs[41].values()]
    assert {name: sum(one["test"] == name for one in asked) for name in tests} == tests
    assert all(one["rate"] == 2.0 for one in asked if one["test"] != "elastic")
    pressures = [one["confinement"] for one in asked if "confinement" in one]
    assert pressures == pytest.approx([3.663e6, 12.21e6, 36.63e6, 61.05e6])
    jaws = [one.get("jaw_radius") for one in asked if one["test"] == "brazilian"]
    assert jaws == ([0.0225] if plan.solid else [None])
    assert 300 < plan.grains < 500
    assert plan_of(material, size="full").jobs[41]["compressed"].inputs["rate"] == 1.0


def test_runs_of_soft_rocks_reach_larger_strains():
    def ends(rock):
        asked = runs.plan(
            materials.load("augig-calibrated"),
            *("augig-calibrated",),
            **{"model": None, "shape": None, "seeds": [41], "size": "small", "rock": rock},
        )
        return [
            one.inputs["max_strain"]
            for one in asked.jobs[41].values()
            if "max_strain" in one.inputs
        ]

    strong, young = Entry(60e6, None, Band(50e6)), Entry(3e9, None, Band(2e9))
    soft = Rock("soft", (), "", "", {"compressive_strength": strong, "youngs_modulus": young})
    unknown = Rock("unknown", (), "", "", {"compressive_strength": strong})
    usual = [0.015, 0.025, 0.03, 0.03]
    assert ends(load_rock("augig", "any")) == ends(unknown) == usual
    assert ends(soft) == pytest.approx([0.06, 0.1, 0.12, 0.12])


def test_each_role_has_one_test_in_each_dimension():
    roles = {kind.scored for kind in KINDS.values()} - {""}
    assert roles == {"solved", "compressed", "confined", "pulled", "split", "notched"}
    for role in roles:
        for solid in (False, True):
            of_role = [kind for kind in KINDS.values() if kind.scored == role]
            assert sum(kind.variant_in(solid=solid) is not None for kind in of_role) == 1


def test_files_have_all_rows_and_the_page_is_made_from_them(tmp_path, monkeypatch):
    plan = plan_of(seeds=[41])
    packings = [runs.values_of(granite(), solid=False)]
    rows = judge_all(packings, plan.rock.entries, full=False)
    pairs = runs.pairs_of([granite()])
    output.write(tmp_path, plan, rows, pairs)
    content = json.loads((tmp_path / output.FILE).read_text())
    assert [one["measure"] for one in content["rows"]] == [*MEASURES]
    assert content["failed"] == [one.measure.name for one in rows if one.fails(full=False)] != []
    with (tmp_path / output.TABLE).open() as file:
        table = {one["measure"]: one for one in csv.DictReader(file)}
    assert table["crack_initiation"]["general_upper"] == "0.6"
    assert (table["compressive_strength"]["mean"], table["compressive_strength"]["decides"]) == (
        "100000000.0",
        "true",
    )
    page = pages.write(tmp_path).read_text()
    assert "Cracks by pair of minerals" in page and "data:image/" in page
    assert "How to repeat" not in page  # no run has a result
    assert all(one.words in page for one in MEASURES.values() if "'" not in one.words)
    text = output.table(plan, rows, pairs)
    assert "17 to 23 (25 to 33)" in text and " (0.4 to 0.6)" in text
    assert len(text.splitlines()) == len(MEASURES) + 5
    assert "no value" in text


def test_rows_that_are_not_met_name_the_keys_that_change_them_most(tmp_path):
    packings = [runs.values_of(granite(), solid=False)]
    preset = plan_of(seeds=[41])
    rows = judge_all(packings, preset.rock.entries, full=False)
    # the preset's ratios are others than those of the material that was measured
    assert output.keys_of(preset, rows) == [""] * len(rows)
    plan = replace(preset, loaded=exponents.load("flexible", "2D").measured)
    known = exponents.load("flexible", "2D").text("compressive_strength")
    assert known.startswith("cohesion +0.")
    keys = dict(zip(MEASURES, output.keys_of(plan, rows), strict=True))
    assert keys["compressive_strength"] == known  # 100 MPa, and not 122
    assert {name for name, text in keys.items() if text} <= {
        row.measure.name for row in rows if row.verdict == NOT_MET
    }
    output.write(tmp_path, plan, rows, [])
    content = json.loads((tmp_path / output.FILE).read_text())
    assert [one["exponents"] for one in content["rows"]] == [*keys.values()]
    with (tmp_path / output.TABLE).open() as file:
        assert [one["exponents"] for one in csv.DictReader(file)] == [*keys.values()]
    assert known in output.table(plan, rows, []) and output.KEYS in output.table(plan, rows, [])
    page = pages.write(tmp_path).read_text()
    assert known in page and output.KEYS in page
    # no exponents were measured of rigid grains
    others = plan_of(seeds=[41], model="rigid")
    assert output.keys_of(others, rows) == [""] * len(rows)
    assert output.KEYS not in output.table(others, rows, [])


def test_charts_name_their_tests_and_say_which_runs_they_leave_out(monkeypatch):
    curve = curve_through((0.0, 0.0), (0.01, 1e6))
    found = {"a": ended("scb", curve), "b": ended("tension", curve), "c": ended("tension", curve)}
    results = {name: one.result for name, one in found.items()}
    assert [one.title for one in pages._curves_by_test(results)] == ["SCB", "Tension"]
    monkeypatch.setattr(pages, "_MOST_CURVES", 1)
    titles = ["SCB", "Tension, first 1 of 2 runs"]
    assert [one.title for one in pages._curves_by_test(results)] == titles


class MadeUp:
    """A pool whose runs are made up: the first is the direct solve, the others are alike."""

    others = None

    def __init__(self, *_, **__):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def run(self, wanted, progress=None):
        solved = {"exit_code": 0, "message": "", "result": {"youngs_modulus": 5e8}}
        killed = {"exit_code": -9, "message": "ended by signal 9", "result": {}}
        return [solved, *[self.others or killed] * (len(wanted) - 1)]


DECIDING = """
[compressive_strength]
value = 120e6
lower = 110e6
decides = true
source = "s"
[youngs_modulus]
value = {value}
lower = {lower}
decides = true
source = "s"
"""


@pytest.mark.parametrize(
    ("lower", "peak", "size", "verdict", "says"),
    [
        (1e4, "lost", "small", "not known", "runs = 9 of 10 failed"),
        (1e9, "lost", "small", "not met", "measures = youngs_modulus, not met; runs = 9 of 10"),
        (1e4, 120e6, "small", "met", ""),
        (1e4, None, "small", "not known", ""),
        (1e4, None, "full", "not known", "measures = compressive_strength, not known; see"),
        (
            *(1e9, None, "full", "not met"),
            "measures = youngs_modulus, not met; measures = compressive_strength, not known; see",
        ),
    ],
)
def test_exit_code_and_box_tell_what_is_not_met_not_known_or_failed(
    tmp_path, monkeypatch, capsys, lower, peak, size, verdict, says
):
    pool = type("_Pool", (MadeUp,), {})
    if peak != "lost":
        pool.others = {"exit_code": 0, "message": "", "result": {"peak_stress": peak, "any": 1.0}}
    monkeypatch.setattr(card, "Pool", pool)
    file = tmp_path / "mine.toml"
    file.write_text(DECIDING.format(value=2.0 * lower, lower=lower))
    asked = ["scorecard", "augig-calibrated", "--rock", str(file), "--seeds", "41", "--quiet"]
    code = cli.main([*asked, "--size", size, "--out", str(tmp_path / "card")])
    said = capsys.readouterr()
    assert code == (3 if says else 0)
    assert said.err.startswith(f"flexpm: {says}") if says else not said.err
    assert ("failed: seed 41 compressed: ended by signal 9" in said.out) == (peak == "lost")
    assert "10 runs, 0 of them finished; about" in said.out
    page = (tmp_path / "card" / "report.html").read_text()
    box = page[page.index('<section id="status"') :].partition("</section>")[0]
    assert f"<h2>{verdict}</h2>" in box
    assert ("are not known: compressive strength." in box) == (peak != 120e6)
    assert ("are not met: Young&#39;s modulus." in box) == (lower == 1e9)


def test_material_that_is_removed_during_the_runs_loses_no_results(tmp_path, monkeypatch):
    file = tmp_path / "mine.toml"
    preset = files("flexpm.materials") / "presets" / "augig-calibrated.toml"
    file.write_text(preset.read_text())

    class Removing(MadeUp):
        def run(self, wanted, progress=None):
            file.unlink()
            return super().run(wanted, progress)

    monkeypatch.setattr(card, "Pool", Removing)
    found = card.scorecard(file, tmp_path / "card", rock="augig", seeds=[41], report=False)
    assert found.row("youngs_modulus").mean == 5e8 and len(found.lost) == 9
    assert (tmp_path / "card" / output.FILE).is_file()
    refusal("did you mean compressive_strength", found.row, "compresive_strength")


def test_a_folder_with_other_results_is_refused(tmp_path):
    (tmp_path / "history.csv").write_text("round\n")
    with pytest.raises(InputError, match="has results of calibrate"):
        card.scorecard("augig-calibrated", tmp_path)


# Real runs

_GRAINS = {"diameters": (0.003, 0.004)}
_TINY = {
    "rectangle": {"width": 0.012, "height": 0.024},
    "disc": {"diameter": 0.016},
    "half-disc": {"diameter": 0.024},
    "box": {"width": 0.008, "depth": 0.008, "height": 0.014},
    "solid-disc": {"diameter": 0.016, "depth": 0.008},
    "solid-half-disc": {"diameter": 0.016, "depth": 0.008},
}
TINY = runs.Size("tiny", False, 30.0, _TINY, _GRAINS)


def started(monkeypatch):
    """Commands of the runs that are started, as they are."""
    found = []
    command = card.jobs.Job.command

    def counted(self, *arguments):
        found.append(self.key)
        return command(self, *arguments)

    monkeypatch.setattr(card.jobs.Job, "command", counted)
    return found


#: A scorecard in a process of its own, which kills itself after two runs.
KILLED = """
from self_signals import after_runs
from flexpm.studies.scorecards import card, measures
from flexpm.studies.scorecards.runs import Size
after_runs(2)
measures.PRESSURES = {pressures}
card.scorecard({material!r}, {out!r}, workers=1, **{asked})
"""


@pytest.mark.parametrize("shape", ["rectangle", pytest.param("box", marks=pytest.mark.long)])
def test_a_killed_scorecard_does_what_is_missing_and_then_nothing(
    tmp_path, monkeypatch, package_parent, shape
):
    material = "augig3d-calibrated-rigid" if shape == "box" else "augig-calibrated-rigid"
    pressures = {3: 0.03} if shape == "box" else {}  # the others only take time
    missing = 4 + len(pressures)
    monkeypatch.setattr(measures, "PRESSURES", pressures)
    asked = {"shape": shape, "seeds": [41], "size": TINY, "model": "rigid", "report": False}
    text = KILLED.format(pressures=pressures, material=material, out=str(tmp_path), asked=asked)
    paths = f"PYTHONPATH={package_parent}{os.pathsep}{HELPERS}"
    killed = captured(["env", paths, "/usr/bin/python3", "-P", "-c", text])
    assert killed.returncode == -signal.SIGKILL, killed.stderr
    done = {file.parent.name for file in tmp_path.glob("runs/*/outcome.json")}
    assert len(done) == 2
    wait_for(lambda: all(is_free(folder) for folder in tmp_path.glob("runs/*")))
    begun = started(monkeypatch)
    first = card.scorecard(material, tmp_path, **asked)
    assert len(begun) == missing and not done & {*begun}  # the missing ones, each once
    for name in ("youngs_modulus", "compressive_strength", "direct_tensile_strength"):
        assert first.row(name).mean > 0.0, first.row(name)
    whole = (tmp_path / output.FILE).read_bytes()
    assert card.scorecard(material, tmp_path, **asked).rows == first.rows
    assert len(begun) == missing  # nothing again
    assert (tmp_path / output.FILE).read_bytes() == whole


def test_a_measure_knows_its_runs():
    names = {*granite()}
    assert all(set(one.runs) <= names for one in MEASURES.values())
    assert all(isinstance(one, Measure) and one.about for one in MEASURES.values())
    assert materials.load("augig-calibrated").made_for is not None
