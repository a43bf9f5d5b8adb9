# SPDX-License-Identifier: GPL-3.0-or-later
"""What a calibration says of itself: advice, keys that stay open, its page, its start."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import pytest
from refusals import refusal

from flexpm import materials
from flexpm.studies import calibration_measures, calibration_problem, calibration_search, pages
from flexpm.studies.calibration_problem import Target
from flexpm.studies.calibration_verdict import judge, left_open, slopes

FILE = """
[calibration]
name = "known"
model = "rigid"
evaluations = 12
rounds = 1
candidates = 1
[screen]
seeds = [1]
[screen.scb]
diameter = 0.03
notch = 0.006
[verify]
seeds = [5, 6]
[target]
direct_tensile_strength = 6e6
[free]
tensile_strength = [2e6, 30e6]
cohesion = [5e6, 90e6]
"""
FREE = {"strength": (1.0, 100.0), "friction": (0.1, 1.0)}
AIMS = [Target("peak", 50.0), Target("other", 3.0)]


@dataclass
class Set:
    """A set of values and what it gave."""

    values: dict[str, float]
    found: dict[str, float | None]
    errors: dict[str, float] = field(default_factory=dict)
    lost: dict[str, str] = field(default_factory=dict)

    def mean(self, name):
        return self.found[name]

    def error(self, name):
        return self.errors.get(name)


def power_law(strength, friction):
    """ln(peak) = ln(strength) + 0.5 ln(friction), ln(other) = 0.5 ln(strength)."""
    peak, other = strength * friction**0.5, strength**0.5
    return Set({"strength": strength, "friction": friction}, {"peak": peak, "other": other})


def tried():
    return [power_law(s, f) for s in (20.0, 24.0, 28.0) for f in (0.4, 0.5)]


def judged(best, **options):
    parts = [(tried(), [*FREE], AIMS)]
    return judge(AIMS, FREE, parts, best, **{"used_up": False, **options})


def test_slopes_are_the_exponents_of_a_power_law():
    assert slopes(tried(), [*FREE], AIMS) == pytest.approx(np.array([[1.0, 0.5], [0.5, 0.0]]))
    assert slopes(tried()[:1], [*FREE], AIMS) == pytest.approx(0.0)
    # a key that was never changed moves nothing that is known
    same = [power_law(s, 0.5) for s in (20.0, 24.0)]
    assert slopes(same, [*FREE], AIMS)[:, 1] == pytest.approx(0.0)


def test_a_measure_that_is_lost_hides_no_other():
    """Sets without one measure still tell the slopes of the other, and the keys of it."""
    sets = tried()
    for one in sets:
        one.found["other"], one.lost["other"] = None, "brazilian ended no_peak in 1 of 1 runs; x"
    assert slopes(sets, [*FREE], AIMS) == pytest.approx(np.array([[1.0, 0.5], [0.0, 0.0]]))
    best = Set(
        {"strength": 20.0, "friction": 0.5}, {"peak": 14.0, "other": None}, lost=sets[0].lost
    )
    found = judge(AIMS, FREE, [(sets, [*FREE], AIMS)], best, used_up=False)
    assert found.missed == ["peak", "other"]
    assert found.advice == [
        "peak: set against other targets; free another key, raise rounds or its tolerance, or give "
        "it more weight",
        "other: not measured, brazilian ended no_peak in 1 of 1 runs; x",
    ]
    assert [(one["name"], one["mean"], one["met"]) for one in found.measures] == [
        ("peak", 14.0, False),
        ("other", None, False),
    ]
    assert found.measures[1]["advice"] == [
        "not measured, brazilian ended no_peak in 1 of 1 runs; x"
    ]
    # verified, though the search went without it
    best = Set({"strength": 20.0, "friction": 0.5}, {"peak": 50.0, "other": 2.0})
    found = judge(AIMS, FREE, [(sets, [*FREE], AIMS)], best, used_up=False)
    assert found.advice == [
        "other: the search measured it in 0 of 6 sets, brazilian ended no_peak in 1 of 1 runs; x"
    ]


def test_what_is_left_open_is_that_of_linear_least_squares():
    """One key, one target: 1 / sqrt(1 + (slope scatter / tolerance)^2); without slope 1."""
    scatter = math.log(100.0) / math.sqrt(12.0)
    found = left_open(np.array([[0.7]]), ["strength"], FREE, AIMS[:1])
    expected = 1.0 / math.sqrt(1.0 + (0.7 * scatter / 0.05) ** 2)
    assert found == {"strength": pytest.approx(expected)}
    assert left_open(np.array([[0.0]]), ["strength"], FREE, AIMS[:1]) == {"strength": 1.0}
    # two keys of one target cannot both be told: one combination of them stays as wide as it was
    both = left_open(np.array([[1.0, 1.0]]), [*FREE], FREE, AIMS[:1])
    assert sum(share**2 for share in both.values()) == pytest.approx(1.0, abs=0.01)


def test_keys_that_no_target_determines_are_named():
    met = Set({"strength": 50.0, "friction": 1.0}, {"peak": 50.0, "other": 3.0})
    found = judge(AIMS[:1], FREE, [(tried(), [*FREE], AIMS[:1])], met, used_up=False)
    assert (found.missed, found.advice) == ([], [])
    assert "friction" in found.open_keys
    assert found.lines()[0].startswith("not determined by the targets: ")
    assert judged(met).open_keys == []


@pytest.mark.parametrize(
    ("strength", "friction", "peak", "error", "used_up", "says"),
    [
        (100.0, 0.5, 40.0, None, False, "strength = 100 is at its upper bound 100; widen"),
        (1.0, 0.5, 60.0, None, False, "strength = 1 is at its lower bound 1; widen"),
        (50.0, 0.1, 60.0, None, False, "friction = 0.1 is at its lower bound 0.1"),
        # at a bound that is not in the way
        (1.0, 0.5, 40.0, None, False, "set against other targets"),
        (50.0, 0.5, 40.0, 12.0, False, "missed by less than the error of its mean, 12"),
        (50.0, 0.5, 40.0, 2.0, True, "raise evaluations, all were used"),
        (50.0, 0.5, None, None, False, "not measured"),
    ],
)
def test_advice_names_the_reason(strength, friction, peak, error, used_up, says):
    errors = {} if error is None else {"peak": error}
    best = Set({"strength": strength, "friction": friction}, {"peak": peak, "other": 3.0}, errors)
    found = judged(best, used_up=used_up)
    assert found.missed == ["peak"]
    assert found.advice[0].startswith("peak: ")
    assert says in found.advice[0]


def test_a_target_that_nothing_moves_is_named():
    idle = [Set({"strength": s}, {"peak": 40.0}) for s in (20.0, 24.0)]
    best = Set({"strength": 20.0}, {"peak": 40.0})
    found = judge(AIMS[:1], FREE, [(idle, ["strength"], AIMS[:1])], best, used_up=True)
    assert found.advice == ["peak: no free key moves it; free another one, or drop the target"]


class MadeUp:
    """In the place of the runs: cohesion does nothing."""

    def __init__(self, *details, **options):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *details):
        pass

    def run(self, wanted, progress=None):
        return [{"result": {"peak_stress": 0.1 * self.of(job)}} for job in wanted]

    @staticmethod
    def of(job):
        return dict(job.inputs)["set.tensile_strength"]


def plan_of(folder, text=FILE):
    path = folder / "calibration.toml"
    path.write_text(text)
    return calibration_problem.read(path)


def test_a_material_outside_its_bounds_starts_at_the_nearer_one(tmp_path, monkeypatch):
    monkeypatch.setattr(calibration_search, "Pool", MadeUp)
    start = {"tensile_strength": 1e6, "cohesion": 1e9}
    found = calibration_search.run(plan_of(tmp_path), tmp_path, start=start)
    assert found.history[0].values == {"tensile_strength": 2e6, "cohesion": 90e6}


def test_the_page_has_the_verdict(tmp_path, monkeypatch):
    """A tenth of the strength: 6 MPa are twice what the bounds allow, and cohesion stays open."""
    monkeypatch.setattr(calibration_search, "Pool", MadeUp)
    start = materials.load("augig-table7").law()
    found = calibration_search.run(plan_of(tmp_path), tmp_path, start=start)
    assert found.verdict.missed == ["direct_tensile_strength"]
    assert "tensile_strength = 3e+07 is at its upper bound" in found.verdict.advice[0]
    assert found.verdict.open_keys == ["cohesion"]
    found.verdict.write(tmp_path)
    text = pages.write(tmp_path).read_text(encoding="utf-8")
    for told in (
        "not met",
        "Missed: direct tensile strength",
        "widen [free]",
        "Uncertainty of the keys",
    ):
        assert told in text, told
    (tmp_path / "verdict.json").unlink()
    assert "Uncertainty of the keys" not in pages.write(tmp_path).read_text(encoding="utf-8")


def test_fracture_toughness_is_a_target_with_options_of_its_own_test(tmp_path):
    text = FILE.replace("direct_tensile_strength = 6e6", "scb_toughness = 1.2e6")
    plan = plan_of(tmp_path, text)
    target = plan.targets[0]
    assert plan.tests(target) == [("scb", 0.0)]
    assert plan.measure(target, {("scb", 0.0): {"fracture_toughness": 1.1e6}}) == 1.1e6
    values = {"tensile_strength": 8e6, "cohesion": 30e6}
    job = calibration_search.jobs_of(plan, plan.screen, values, plan.targets)[(1, ("scb", 0.0))]
    assert (job.inputs["diameter"], job.spec.notch) == (0.03, 0.006)
    assert calibration_measures.tests_of("beam_toughness") == ("bending",)
    refusal("scb key", plan_of, tmp_path, text.replace("notch =", "noch ="))
