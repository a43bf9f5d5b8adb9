# SPDX-License-Identifier: GPL-3.0-or-later
"""Events of known cracks, b values of known distributions, and the energies of whole runs."""

import csv
import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal

import flexpm
from flexpm.results.cracks import ERASED, SHEAR, TENSILE, Crack, read_cracks
from flexpm.results.emission import (
    Event,
    EventRule,
    event_rule,
    events_csv,
    find_events,
    fits,
    frequencies,
    magnitudes_of,
    read_events,
)

RULE = EventRule(distance=1.0, steps=10.0)


def crack(step, x, y=0.0, mode=TENSILE, energy=1.0):
    return Crack(step, 1e-6 * step, x, y, mode, 0, 0, energy)


def test_points_join_where_both_limits_hold():
    cracks = [crack(0, 0.0), crack(10, 1.0), crack(11, 3.0), crack(20, 2.0), crack(31, 2.0)]
    events = find_events(cracks, RULE)
    # 0 - 1 - 2 is a chain, that at 3.0 joins it by that at 2.0; the last one is a step too late
    assert [(one.step, one.points) for one in events] == [(0, 4), (31, 1)]


def test_an_event_has_the_sums_of_its_points():
    cracks = [crack(5, 0.0, energy=1.0), crack(6, 0.5, 1.0 / 3, SHEAR, 3.0), crack(7, 9.0)]
    event, other = find_events([*cracks, crack(7, 9.0, mode=ERASED)], RULE)
    assert event == pytest.approx((5, 5e-6, 0.375, 0.25, 2, SHEAR, 4.0, event.magnitude))
    assert event.magnitude == pytest.approx((math.log10(4.0) - 4.8) / 1.5)
    assert (other.points, other.mode) == (1, TENSILE)


def test_an_event_without_energy_has_a_place_and_no_magnitude():
    (event,) = find_events([crack(5, 0.0, energy=0.0), crack(5, 1.0, energy=0.0)], RULE)
    assert (event.x, event.energy) == (0.5, 0.0)
    assert math.isnan(event.magnitude)
    assert frequencies(np.array([event.magnitude])) == (None, None, None)


def test_no_cracks_and_cracks_nowhere_make_no_events():
    assert find_events([], RULE) == []
    assert find_events([crack(1, math.nan)], RULE) == []


@given(st.lists(st.tuples(st.integers(0, 60), st.integers(0, 20), st.integers(0, 5)), max_size=40))
def test_events_are_those_of_a_plain_search(points):
    cracks = [crack(step, 0.3 * x, 0.3 * y) for step, x, y in sorted(points)]
    label = list(range(len(cracks)))
    for i, one in enumerate(cracks):
        for j, other in enumerate(cracks[:i]):
            near = math.hypot(one.x - other.x, one.y - other.y) <= RULE.distance
            if near and abs(one.step - other.step) <= RULE.steps:
                label = [label[j] if k == label[i] else k for k in label]
    sizes = sorted(label.count(k) for k in set(label))
    events = find_events(cracks, RULE)
    assert sorted(one.points for one in events) == sizes
    assert sum(one.energy for one in events) == pytest.approx(len(cracks))


def test_the_rule_is_a_grain_and_the_time_to_cross_it_at_half_the_speed():
    assert event_rule(mean_diameter=3e-3, height=0.06, crossing_steps=400.0) == (3e-3, 40.0)


def test_a_magnitude_is_that_of_gutenberg_and_richter():
    assert magnitudes_of(np.array([10.0**4.8, 10.0**6.3])) == pytest.approx([0.0, 1.0])


@pytest.mark.parametrize("b", [0.7, 1.0, 1.6])
def test_b_value_of_an_exponential_distribution(b):
    rng = np.random.default_rng(3)
    found = [
        frequencies(rng.exponential(1.0 / (b * math.log(10.0)), 2000) - 4.05) for _ in range(100)
    ]
    lines = [one for one in found if one.b_value is not None]
    assert len(lines) >= 90  # one in twenty moves by two errors
    completeness, values, errors = np.array(lines).T
    assert completeness == pytest.approx(-4.0, abs=0.1 + 1e-9)  # a bin
    assert np.mean(values) == pytest.approx(b, abs=3.0 * np.std(values) / 10.0)
    assert np.mean(errors) == pytest.approx(np.std(values), rel=0.2)
    assert np.mean(errors) == pytest.approx(b / math.sqrt(2000), rel=0.05)


def test_what_is_below_completeness_does_not_count():
    rng = np.random.default_rng(4)
    magnitudes = rng.exponential(1.0 / math.log(10.0), 20000) - 4.05
    seen = magnitudes[rng.random(20000) < 100.0 ** np.minimum(magnitudes + 3.05, 0.0)]
    completeness, b, error = frequencies(seen)
    assert completeness == pytest.approx(-3.0, abs=0.15)
    assert b == pytest.approx(1.0, abs=0.1)
    assert error < 0.05


def test_numbers_that_follow_no_line_have_no_b_value():
    """Energies up to that of a point: the curve bends down, so b grows with its first magnitude."""
    rng = np.random.default_rng(5)
    magnitudes = 1.5 * (1.0 - np.sqrt(rng.random(2000))) - 4.05
    first, later = fits(magnitudes)
    assert later.least == pytest.approx(first.least + 0.3)
    assert later.number < first.number
    assert later.b_value > first.b_value + 3.0 * later.b_error
    assert frequencies(magnitudes) == (first.least, None, None)


def test_few_or_equal_events_have_no_b_value():
    steps = np.repeat([0.0, 0.1, 0.2], [30, 15, 5])
    assert frequencies(steps).b_value is not None
    assert frequencies(steps[1:]) == (0.0, None, None)
    assert frequencies(np.zeros(100)) == (0.0, None, None)


def test_events_read_back_unchanged(tmp_path):
    events = [
        Event(7, 0.1 / 3, 0.01, -0.02, 3, TENSILE, 1e-3 / 7, -5.2 / 3),
        Event(9, 0.2, 0.0, 0.0, 1, SHEAR, 0.0, math.nan),
    ]
    (tmp_path / "events.csv").write_text(events_csv(events))
    first, second = read_events(tmp_path / "events.csv")
    assert first == events[0]
    assert second[:-1] == events[1][:-1]
    (tmp_path / "events.csv").write_text("step,strain\n1,2\n")
    refusal("is not a table of events", read_events, tmp_path / "events.csv")


def test_cracks_of_an_older_version_have_no_energy(tmp_path):
    text = "step,strain,x,y,mode,contact,point\n7,0.1,0.0,0.0,shear,3,1\n"
    (tmp_path / "cracks.csv").write_text(text)
    (found,) = read_cracks(tmp_path / "cracks.csv")
    assert found[:7] == (7, 0.1, 0.0, 0.0, SHEAR, 3, 1)
    assert math.isnan(found.energy)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid", "inner"])
@pytest.mark.parametrize("test", ["uniaxial", "tension"])
def test_damage_is_that_of_events_and_of_softened_points(test, model, tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    result = flexpm.run(test, specimen, model=model, out=tmp_path, rate=2.0)
    damage, softened = result.curve["damage_energy"], result.curve["softened_energy"]
    cracks = np.array([(one.step, one.energy) for one in result.cracks])
    assert len(cracks) > 5
    by_then = np.searchsorted(cracks[:, 0], result.curve["step"], side="right")
    cracked = np.concatenate([[0.0], np.cumsum(cracks[:, 1])])[by_then]
    assert cracked + softened == pytest.approx(damage, rel=1e-9, abs=1e-9 * damage[-1])
    assert model == "inner" or 0.0 < softened.max() < damage[-1]
    total = sum(one.energy for one in result.emission)
    assert total + softened[-1] == pytest.approx(damage[-1], rel=1e-9)
    assert sum(one.points for one in result.emission) == len(cracks)
    rows = list(csv.DictReader((tmp_path / "events.csv").read_text().splitlines()))
    assert len(rows) == json.loads((tmp_path / "result.json").read_text())["events"]
    assert (tmp_path / "events.png").stat().st_size > 10000
    assert "Acoustic emission" in (tmp_path / "report.html").read_text()
    assert flexpm.Result.read(tmp_path).emission == result.emission


def test_models_of_yade_have_no_events(tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    result = flexpm.run("tension", specimen, model="jcfpm", out=tmp_path, rate=4.0)
    assert result.tensile_cracks > 0
    assert result.events is result.emission is None
    assert not (tmp_path / "events.csv").exists()
    assert all(math.isnan(one.energy) for one in flexpm.Result.read(tmp_path).cracks)
