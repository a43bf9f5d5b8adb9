# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that are repeated at half the rate until they are quasi-static. Deviation D75. SI units.

If the first run is quasi-static, the test is not repeated: the limits of ``not_quasistatic`` are at
rates whose halving changes the mean peak by less than 2 %. Otherwise the test is repeated until it
is quasi-static and its peak does not change.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..files import Table
from ..results.doubts import LARGEST_PEAK_CHANGE, peak_change
from ..results.result import Result
from ..runs.run_spec import RunSpec

#: Status of a loading that was too fast.
_FAST = "not_quasistatic"


def rate_of(spec: RunSpec, loadings: int) -> float:
    """Factor on the loading rate after so many loadings [-]."""
    return float(spec.rate * 0.5**loadings)


def loading(result: Result, rate: float, first_step: int) -> Table:
    """Result and cost of a loading.

    Args:
        result: The test with this loading.
        rate: Factor on the loading rate [-].
        first_step: Steps before it, of settling.

    Returns:
        ``rate`` [-], ``status``, ``peak_stress`` [Pa] or None, ``steps``, and ``seconds``: their
        wall time at the median pace [s].
    """
    steps = max(result.steps - first_step, 0)
    return {
        "rate": rate,
        "status": result.status,
        "peak_stress": result.peak_stress,
        "steps": steps,
        "seconds": steps * (result.step_time or 0.0),
    }


def is_over(spec: RunSpec, loadings: Sequence[Table]) -> bool:
    """Whether no slower loading follows: slow enough, failed, or at the bound.

    Args:
        spec: The run.
        loadings: All so far, the fastest first.
    """
    if len(loadings) > (spec.halvings or 0):
        return True
    return loadings[-1]["status"] != _FAST and not _moves(loadings)


def conclude(result: Result, loadings: Sequence[Table]) -> None:
    """Store the loadings of a run in its result; if the peak still changes, it was too fast."""
    result.rates = [*loadings]
    result.final_rate = loadings[-1]["rate"]
    if _moves(loadings):
        result.status = _FAST


def foreseen(spec: RunSpec, last: Table) -> tuple[int, float]:
    """Steps and wall time [s] that half the rate of the last loading will probably take."""
    power = spec.kind.likely_power if spec.loading == "waiting" else 1.0
    return round(last["steps"] * 2.0**power), last["seconds"] * 2.0**power


def told(spec: RunSpec, loadings: Sequence[Table]) -> str:
    """Return one line with the last result and the expected cost at half the rate."""
    last = loadings[-1]
    steps, seconds = foreseen(spec, last)
    peak = last["peak_stress"]
    reached = "no peak" if peak is None else f"peak {1e-6 * peak:.4g} MPa"
    why = last["status"] if last["status"] == _FAST else f"peak moved by {_percent(loadings)} %"
    return (
        f"rate {last['rate']:g}: {why}, {reached}, {last['steps']} steps; again at rate "
        f"{0.5 * last['rate']:g}, about {float(f'{steps:.2g}'):.0f} steps and "
        f"{float(f'{seconds:.2g}'):g} s, halving {len(loadings)} of at most {spec.halvings}"
    )


def _moves(loadings: Sequence[Table]) -> bool:
    """Whether the peaks of the last two loadings differ, of a test that ended in a peak."""
    if loadings[-1]["status"] != "ok" or len(loadings) < 2:
        return False
    if loadings[-1]["peak_stress"] is loadings[-2]["peak_stress"] is None:
        return False  # what slides may have none
    change = peak_change(loadings)
    return change is None or change > LARGEST_PEAK_CHANGE


def _percent(loadings: Sequence[Table]) -> str:
    change = peak_change(loadings)
    return "-" if change is None else f"{100.0 * change:.2g}"
