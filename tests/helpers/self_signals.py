# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that send signals to themselves at events, so that nobody has to catch them in time.

As a script, the command flexpm with signals at given steps, or killed after a number of runs::

    self_signals.py '{"at_steps": [[300, 15]]}' run uniaxial --out folder
    self_signals.py '{"after_runs": 2}' study study.toml
"""

from __future__ import annotations

import importlib
import json
import os
import signal
import sys
from collections.abc import Callable, Sequence
from typing import Any

import flexpm  # noqa: F401
from flexpm.files import Table
from flexpm.rigs.rig import TestRig
from flexpm.rigs.sphere_rig import SphereRig
from flexpm.runs.checkpoint import Checkpoint, Position
from flexpm.studies import jobs

import yade  # isort: skip  (flexpm makes YADE importable)

#: Steps from a save to the kill: the next start repeats them. No multiple of a usual look.
LOST = 7


def _after_steps(act: Callable[[], None]) -> None:
    """Call `act` after each step of a rig, before the rig writes anything about this step."""
    for kind in (TestRig, SphereRig):
        take = kind._step

        def step(rig: TestRig, take: Callable[[TestRig], None] = take) -> None:
            take(rig)
            act()

        kind._step = step


def at_steps(moments: Sequence[tuple[int, int]]) -> None:
    """Send signals to this process after steps of its scene; `moments` has (step, signal)."""
    coming = sorted(moments)

    def look() -> None:
        while coming and yade.O.iter >= coming[0][0]:
            os.kill(os.getpid(), coming.pop(0)[1])

    _after_steps(look)


def after_save(wanted: Callable[[Position], bool]) -> None:
    """Kill this process LOST steps after it has saved a wanted position for the first time."""
    last: list[int] = []
    save = Checkpoint.save

    def saved(checkpoint: Checkpoint) -> None:
        save(checkpoint)
        if not last and wanted(checkpoint.position):
            last.append(yade.O.iter + LOST)

    def look() -> None:
        if last and yade.O.iter >= last[0]:
            os.kill(os.getpid(), signal.SIGKILL)

    Checkpoint.save = saved
    _after_steps(look)


def after_runs(number: int) -> None:
    """Kill this process when it has stored the outcome of so many runs of a study."""
    left, conclude = number, jobs.conclude

    def concluded(*given: Any) -> Table:
        nonlocal left
        outcome = conclude(*given)
        left -= 1
        if left == 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return outcome

    jobs.conclude = concluded


def command(*arguments: object, **event: object) -> list[str]:
    """Command line of flexpm in a process that sends itself signals.

    Args:
        arguments: Arguments of flexpm.
        event: Name and argument of `at_steps` or `after_runs`.
    """
    python = ["env", "-u", "FLEXPM_DEFER", "/usr/bin/python3", "-P"]
    return [*python, __file__, json.dumps(event), *map(str, arguments)]


if __name__ == "__main__":
    for name, value in json.loads(sys.argv.pop(1)).items():
        {"at_steps": at_steps, "after_runs": after_runs}[name](value)
    importlib.import_module("flexpm.__main__")
