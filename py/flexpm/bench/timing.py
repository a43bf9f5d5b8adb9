# SPDX-License-Identifier: GPL-3.0-or-later
"""Wall time of a step of each model on one packing, paired in a run. Times in seconds.

Each model has its own scene and does in every step the work of a uniaxial test: flexpm's models
with platens, measurements and record, YADE's models with collider, contact loop and integrator
only. The models alternate in rounds, so that a change of the machine's speed affects all models.
"""

from __future__ import annotations

import json
import math
import os
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

import yade

from ..errors import InputError
from ..files import Table, require_writable, write_text
from ..progress import Progress
from ..specimens.space.spec import SolidSpec
from ..specimens.specimen import AnySpecimen, Specimen
from ..threads import for_scenes, limited
from . import memory, solids
from .cases import BUILDERS, Builder, solid_builders
from .report import (
    Case,
    Timing,
    disc_rows,
    machine,
    scaling_picture,
    scaling_rows,
    size_rows,
    table_rows,
    threads_rows,
)

#: Turns of a run; the steps of a model are shared out over them.
TURNS = 10
#: Turns of the comparison of threads.
_THREAD_TURNS = 5
#: Models of flexpm itself, whose ratios the paper gives.
_OWN = ("refined", "rigid", "inner", "inner-un")
#: Thickness of the paper's specimens [m].
_PAPER = 0.08
#: Steps of each model before the first turn: the collider's first run, the grip of the platens.
_WARM_UP = 100
#: Grains of a scaling run over those of the paper's specimen.
SCALES = (1, 10, 40)
#: Sizes of the boxes of one in 3D over those asked for: 1.8, 12.6 and 100 thousand grains.
SIDES, LARGE_SIDE = (1.0, 1.92), 3.8


@dataclass(frozen=True)
class Plan:
    """Selection of specimens, models and steps for a measurement.

    Attributes:
        steps: Steps of each model; multiples of 1000 weigh measured steps evenly.
        width: Width of the specimen [m].
        height: Height of the specimen [m].
        seed: Seed of the packing.
        threads: Threads of a step.
        scaling: Also time the flexible model with 10 and 40 times the grains, in 3D with 7 times.
        large: With `scaling` of a box also with 55 times the grains.
        shape: ``box`` for the 3D models; None: the 2D models.
        depth: Depth of a box [m]; None: its default.
    """

    steps: int = 2000
    width: float = 0.08
    height: float = 0.16
    seed: int = 1
    threads: int = 1
    scaling: bool = False
    large: bool = False
    shape: str | None = None
    depth: float | None = None

    def __post_init__(self) -> None:
        if self.shape is None and self.depth is not None:
            raise InputError(
                f"bench: depth = {self.depth:g} m, goes with --shape box; leave it out"
            )
        if self.large and not (self.scaling and self.shape is not None):
            raise InputError("bench: large = True, goes with --scaling --shape box; leave it out")


def run(
    plan: Plan, json_file: Path | str | None = None, progress: Progress | None = None
) -> list[tuple[str, str]]:
    """Time all models and describe the results.

    Args:
        plan: Specimens, models and steps.
        json_file: File for the results as JSON, with a plot of the scaling next to it; None: no
            file.
        progress: Called with (steps done, steps expected, text).

    Returns:
        Rows (name, value) for a table.
    """
    if plan.shape is not None:
        data, rows = _run_solid(plan, progress)
    else:
        data, rows = _run_plane(plan, progress)
    if json_file is not None:
        write_text(json_file, json.dumps(data, indent=2) + "\n")
        if plan.scaling and require_writable(Path(json_file)):  # beside a device is no place
            scaling_picture(Path(json_file).with_suffix(".png"), data["scaling"])
    return rows


def _run_solid(plan: Plan, progress: Progress | None) -> tuple[Table, list[tuple[str, str]]]:
    assert plan.shape is not None
    spec = SolidSpec(plan.shape, plan.width, plan.depth, plan.height, seed=plan.seed)
    specimen, setup = solids.timed_set_up(spec, progress)
    builders = solid_builders(plan.shape)
    timing = compare(
        specimen, steps=plan.steps, threads=plan.threads, builders=builders, progress=progress
    )
    pair = compare_threads(specimen, plan.steps, progress, builders, "flexible")
    data = {**timing.as_dict(), "set_up": setup, "two_threads": pair}
    rows = solids.model_rows(timing) + solids.set_up_rows(setup) + threads_rows(pair)
    if plan.scaling:
        data["scaling"] = _grow_solid(plan, spec, progress)
        rows += solids.scaling_rows(data["scaling"])
    return data, rows


def _run_plane(plan: Plan, progress: Progress | None) -> tuple[Table, list[tuple[str, str]]]:
    steps, threads = plan.steps, plan.threads
    specimen, setup = memory.timed_set_up(_PAPER, plan.width, plan.height, plan.seed, progress)
    timing = compare(specimen, steps=steps, threads=threads, progress=progress)
    data, rows = timing.as_dict(), table_rows(timing)
    data["set_up"] = setup
    rows += size_rows(setup)
    disc = compare(
        _disc(plan.width, plan.seed), steps=steps, threads=threads, names=_OWN, progress=progress
    )
    data["brazilian"] = disc.as_dict()
    rows += disc_rows(disc)
    pair = compare_threads(specimen, steps, progress)
    data["two_threads"] = pair
    rows += threads_rows(pair)
    if plan.scaling:
        data["scaling"] = grow(plan, progress)
        rows += scaling_rows(data["scaling"])
    return data, rows


def compare_threads(
    specimen: AnySpecimen,
    steps: int,
    progress: Progress | None,
    builders: Mapping[str, tuple[str, Builder]] = BUILDERS,
    name: str = "refined",
) -> dict[str, float | int]:
    """Measure the wall time of the flexible model alternately with one thread and with two threads.

    Args:
        specimen: The grains.
        steps: Steps for each number of threads.
        progress: Called with (rounds done, rounds, text).
        builders: Label and builder of each model by its name.
        name: Name of the model.

    Returns:
        Step times [s], the median over the rounds of the ratio of the time with one thread to the
        time with two threads, and the load of the machine before: the number of processes that wait
        for a core.
    """
    load = os.getloadavg()[0]
    times: dict[int, list[float]] = {1: [], 2: []}
    for turn in range(_THREAD_TURNS):
        for threads, spans in times.items():
            share = max(TURNS, steps // _THREAD_TURNS)
            found = compare(
                specimen, steps=share, threads=threads, names=(name,), builders=builders
            )
            spans.append(found.cases[0].step_time)
        if progress is not None:
            progress(turn + 1, _THREAD_TURNS, "threads")
    return {
        "one": median(times[1]),
        "two": median(times[2]),
        "gain": median(one / two for one, two in zip(times[1], times[2], strict=True)),
        "load": load,
        "cores": os.cpu_count() or 1,
    }


def compare(
    specimen: AnySpecimen,
    *,
    steps: int,
    threads: int = 1,
    names: tuple[str, ...] | None = None,
    builders: Mapping[str, tuple[str, Builder]] = BUILDERS,
    progress: Progress | None = None,
) -> Timing:
    """Time the models on a specimen in alternating rounds; the scenes are removed afterwards.

    Args:
        specimen: A rectangle, a disc or a 3D specimen.
        steps: Steps of each model.
        threads: Threads of a step.
        names: Models to time; None: all models.
        builders: Label and builder of each model by its name.
        progress: Called with (steps done, steps expected, text).

    Returns:
        The times.
    """
    chunk = math.ceil(steps / TURNS)
    turns = math.ceil(steps / chunk)
    with limited(threads):
        with for_scenes():
            yade.O.reset()
        try:
            cases = [
                _case(name, *builders[name], specimen, threads)
                for name in builders
                if names is None or name in names
            ]
            for turn in range(turns):
                for number, case in enumerate(cases):
                    _take_turn(case, chunk)
                    if progress is not None:
                        done = (turn * len(cases) + number + 1) * chunk
                        progress(done, turns * len(cases) * chunk, "timing")
        finally:
            with for_scenes():
                yade.O.reset()
    spec = specimen.spec
    described = {**specimen.dimensions, "seed": spec.seed, **cases[0].counts}
    return Timing(machine(), described, threads, turns * chunk, cases)


def grow(plan: Plan, progress: Progress | None) -> list[dict[str, float | int]]:
    """Time the flexible model on specimens with an increasing number of grains."""
    found = []
    for scale in SCALES:
        side = math.sqrt(scale)
        width, height = plan.width * side, plan.height * side
        specimen, row = memory.timed_set_up(_PAPER, width, height, plan.seed, progress)
        steps = max(10 * TURNS, plan.steps // scale)
        timing = compare(
            specimen, steps=steps, threads=plan.threads, names=("refined",), progress=progress
        )
        case = timing.cases[0]
        row["step_time"] = case.step_time
        row["time_per_grain"] = case.step_time / row["grains"]
        row["bandwidth"] = memory.bytes_per_step(case.counts) / case.step_time
        row["triad"] = memory.triad()
        found.append(row)
    return found


def _grow_solid(plan: Plan, spec: SolidSpec, progress: Progress | None) -> list[Table]:
    """Time the flexible model on boxes of increasing size."""
    found = []
    for side in (*SIDES, LARGE_SIDE) if plan.large else SIDES:
        sizes: Table = {name: side * size for name, size in spec.sizes.items()}
        specimen, row = solids.timed_set_up(replace(spec, **sizes), progress)
        timing = compare(
            specimen,
            steps=max(10 * TURNS, round(plan.steps / side**3)),
            threads=plan.threads,
            names=("flexible",),
            builders=solid_builders(spec.kind),
            progress=progress,
        )
        row["step_time"] = timing.cases[0].step_time
        row["time_per_grain"] = row["step_time"] / row["grains"]
        found.append(row)
    return found


def _case(name: str, label: str, build: Builder, specimen: AnySpecimen, threads: int) -> Case:
    omega = yade.O
    with for_scenes():
        scene = omega.addScene()
    omega.switchToScene(scene)
    counts = build(specimen, threads)
    case = Case(name, label, scene, counts)
    for _ in range(_WARM_UP):
        omega.step()
    return case


def _take_turn(case: Case, steps: int) -> None:
    """Run and time the next steps of a model."""
    omega = yade.O
    omega.switchToScene(case.scene)
    wall, own = time.perf_counter(), time.thread_time()
    for _ in range(steps):
        omega.step()  # in this thread, whose number of threads is known
    for engine in omega.engines:
        if isinstance(engine, yade.wrapper.GrainSolver):
            engine.cracks()  # a look: no step of this turn waits for the next turn
    case.cpu_times.append((time.thread_time() - own) / steps)
    case.times.append((time.perf_counter() - wall) / steps)


def _disc(diameter: float, seed: int) -> Specimen:
    return Specimen.disc(diameter, _PAPER, seed=seed)
