# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds and memory of each stage of a run of a solid: ``flexpm run``, with a clock on its stages.

    python3 scripts/studies/solid_sizes.py stages.csv run uniaxial --shape cylinder ...

What stands behind the name of the table is the command. Each row has the stage, how often it came,
seconds of wall time and of the processor, the most memory within it and what was left after it
[GB]. Stages within others are told, too; Linux alone tells the most memory of a stage.
"""

from __future__ import annotations

import csv
import functools
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

_STATUS, _PEAK = Path("/proc/self/status"), Path("/proc/self/clear_refs")


def memory(name: str) -> float:
    """Memory of the process by its name in Linux [GB]."""
    lines = _STATUS.read_text().splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith(name)) * 1024e-9


class Clock:
    """Stages that have been timed."""

    def __init__(self, table: Path) -> None:
        self._table = table
        self._rows: dict[str, tuple[float, ...]] = {}
        self._most: list[float] = []

    def on(self, owner: object, name: str, stage: str) -> None:
        """Time a function or method by its owner and name."""
        setattr(owner, name, self.timed(getattr(owner, name), stage))

    def timed(self, of: Callable[..., Any], stage: str) -> Callable[..., Any]:
        """The function, timed as a stage, which may be within another."""

        @functools.wraps(of)
        def call(*given: Any, **named: Any) -> Any:
            if self._most:  # the stage that this one is within
                self._most[-1] = max(self._most[-1], memory("VmHWM"))
            _PEAK.write_text("5")
            self._most.append(0.0)
            wall, own = time.perf_counter(), time.process_time()
            try:
                return of(*given, **named)
            finally:
                spent = time.perf_counter() - wall, time.process_time() - own
                most = max(self._most.pop(), memory("VmHWM"))
                if self._most:
                    self._most[-1] = max(self._most[-1], most)
                self._add(stage, spent, most)

        return call

    def _add(self, stage: str, spent: tuple[float, float], most: float) -> None:
        before = self._rows.get(stage, (0, 0.0, 0.0, 0.0))
        wall, own = before[1] + spent[0], before[2] + spent[1]
        self._rows[stage] = (before[0] + 1, wall, own, max(before[3], most), memory("VmRSS"))
        with self._table.open("w", newline="") as file:
            out = csv.writer(file)
            out.writerow(["stage", "times", "wall", "processor", "most", "left"])
            for name, row in self._rows.items():
                out.writerow([name, row[0], *(f"{value:.4g}" for value in row[1:])])


def main() -> None:
    """Run a command of flexpm with a clock on its stages."""
    clock = Clock(Path(sys.argv[1]))
    sys.argv = ["flexpm", *sys.argv[2:]]
    from flexpm.cli import inputs, signals

    signals.end_in_time()

    loaded = inputs.load_yade

    def load_yade() -> None:
        loaded()
        if inputs.load_yade is load_yade:
            inputs.load_yade = loaded
            _put_on(clock)

    inputs.load_yade = load_yade
    from flexpm.cli.main import main as run

    sys.exit(clock.timed(run, "all")())


def _put_on(clock: Clock) -> None:
    from flexpm.laboratory import carrying_out
    from flexpm.models import grains
    from flexpm.runs import checkpoint, runner, written
    from flexpm.specimens import packing
    from flexpm.specimens.space import cells

    clock.on(packing, "pack", "packing")
    clock.on(cells, "polyhedra", "cells")
    clock.on(grains, "solver_of", "state of the kernel")
    clock.on(grains, "_in_scene", "bodies and bonds of YADE")
    clock.on(grains.SolidModel, "set_masses", "masses")
    clock.on(grains.SolidModel, "snapshot", "snapshots")
    clock.on(carrying_out, "write_vtu", "specimen.vtu")
    clock.on(runner.Runner, "enter", "hold of the ends")
    clock.on(checkpoint.Checkpoint, "save", "checkpoints")
    clock.on(carrying_out, "outcome", "result")
    clock.on(written, "write_vtu", "final.vtu")
    clock.on(written, "draw_solid", "outside.png")
    clock.on(written, "draw_pictures", "pictures")
    clock.on(carrying_out, "write_report", "report.html")
    step, first = runner.Runner._step_on, True

    @functools.wraps(step)
    def steps(self: runner.Runner, one: Callable[[], None], over: Callable[[], bool]) -> None:
        nonlocal first
        stage = "first steps, elastic start" if first else "steps"
        first = False
        clock.timed(step, stage)(self, one, over)

    runner.Runner._step_on = steps


if __name__ == "__main__":
    main()
