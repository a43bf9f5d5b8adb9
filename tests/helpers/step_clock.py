# SPDX-License-Identifier: GPL-3.0-or-later
"""A clock of steps: a run looks up, saves, and writes its tables after given numbers of steps."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace

import flexpm  # noqa: F401
from flexpm.runs import checkpoint, runner

import yade  # isort: skip  (flexpm makes YADE importable)

#: Time of a step by this clock [s]: a power of two, so that its multiples are exact.
STEP = 2.0**-10


def step_clock(assign: Callable[[object, str, object], None], look: int) -> None:
    """Replace the clock of runs: a step takes STEP, everything else takes no time.

    A run saves at the first look after more than ``checkpoint_interval / STEP`` steps, and so it
    writes its tables. The default interval has 30 720 steps.

    Args:
        assign: Sets an attribute: `monkeypatch.setattr`, or `setattr` in a process of its own.
        look: Steps from one look to the next, counted from the start of a stage.
    """
    steps, last = 0, yade.O.iter

    def seconds() -> float:
        nonlocal steps, last
        now = yade.O.iter
        steps += now == last + 1  # else another scene was loaded
        last = now
        return steps * STEP

    clock = SimpleNamespace(perf_counter=seconds, monotonic=seconds)
    for module in (runner, checkpoint):
        assign(module, "time", clock)
    assign(runner, "_LOOK_UP", look * STEP)
