# SPDX-License-Identifier: GPL-3.0-or-later
"""Reasons why runs of a calibration have no measure, and remedies."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from ..files import Table
from .calibration_problem import Calibration, Target

#: Outcomes of runs by test with its confinement [Pa], for each seed.
Outcomes = Mapping[int, Mapping[tuple[str, float], Table]]

#: Remedy by the status of a run.
_REMEDIES = {
    "no_peak": "take larger specimens or smaller grains, or raise max_strain",
    "diverged": "lower the rate",
}
_FAILED = "see the messages in runs"
#: Characters of a message that are shown.
_LONGEST = 120


def loss(plan: Calibration, target: Target, outcomes: Outcomes, seeds: Sequence[int]) -> str:
    """Return the reasons why packings have no value of a measure, and remedies.

    Args:
        plan: The calibration.
        target: Its target.
        outcomes: Outcomes of the runs.
        seeds: Seeds of the packings that tell the measure.

    Returns:
        The line.
    """
    lines, remedies = [], []
    for (test, confinement), key in plan.entries(target):
        runs = [outcomes[seed][test, confinement] for seed in seeds]
        lost = [run for run in runs if run.get("result", {}).get(key) is None]
        for (why, remedy), count in Counter(_reason(run, key) for run in lost).items():
            where = f"{test} at {1e-6 * confinement:g} MPa" if confinement else test
            lines.append(f"{where} {why} in {count} of {len(runs)} runs{_size(lost)}")
            remedies.append(remedy)
    if not lines:
        return "no failure criterion fits the peaks of its runs; change confinements"
    return f"{', '.join(lines)}; {', '.join(dict.fromkeys(remedies))}"


def _reason(run: Table, key: str) -> tuple[str, str]:
    """Outcome of a run without a key of result.json, and the remedy."""
    status = run.get("result", {}).get("status")
    if status == "ok":
        return f"has no {key}", "see null_reasons in result.json of the runs"
    if status is not None:
        return f"ended {status}", _REMEDIES.get(status, _FAILED)
    message = str(run.get("message") or "failed")
    shown = message if len(message) <= _LONGEST else f"{message[:_LONGEST]}..."
    return f"failed ({shown})", _FAILED


def _size(runs: Sequence[Table]) -> str:
    """Return the number of grains of the first run with this number."""
    found = [run["result"]["grains"] for run in runs if run.get("result", {}).get("grains")]
    return f" of {found[0]:.0f} grains" if found else ""
