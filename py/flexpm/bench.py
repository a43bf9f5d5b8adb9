# SPDX-License-Identifier: GPL-3.0-or-later
"""Wall time of a step of each model on one packing, paired in one run. Times in seconds.

Each model has a scene of its own and does what a uniaxial test does in every step: flexpm's models
with platens, measures and record, YADE's with collider, contact loop and integrator only. They
take turns, so that a change of the machine's speed meets all of them.
"""

from __future__ import annotations

import ctypes
import json
import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import yade
from yade import wrapper

from . import models, protocols, yade_models
from .bench_report import Case, Timing, machine, scaling_rows, table_rows
from .files import write_text
from .packing import Progress
from .specimen import Specimen

#: Turns of a run; the steps of a model are shared out over them.
TURNS = 10
#: Steps of each model before the first turn: the collider's first run, the grip of the platens.
_WARM_UP = 100
#: Grains of a scaling run over those of the paper's specimen.
SCALES = (1, 10, 40)


def run(
    steps: int = 2000,
    progress: Progress | None = None,
    *,
    width: float = 0.08,
    height: float = 0.16,
    seed: int = 1,
    threads: int = 1,
    json_file: Path | str | None = None,
    scaling: bool = False,
) -> list[tuple[str, str]]:
    """Time all models and describe the outcome.

    Args:
        steps: Steps of each model; multiples of 1000 weigh measured steps evenly.
        progress: Called with (steps done, steps expected, text).
        width: Of the specimen [m].
        height: Of the specimen [m].
        seed: Of the packing.
        threads: Threads of a step.
        json_file: Also written there.
        scaling: Time the flexible model also with 10 and 40 times the grains.

    Returns:
        Rows (name, value) for a table.
    """
    timing = compare(
        _specimen(width, height, seed, progress), steps=steps, threads=threads, progress=progress
    )
    data, rows = timing.as_dict(), table_rows(timing)
    if scaling:
        data["scaling"] = grow(steps, width, height, seed, threads, progress)
        rows += scaling_rows(data["scaling"])
    if json_file is not None:
        write_text(Path(json_file), json.dumps(data, indent=2) + "\n")
    return rows


def compare(
    specimen: Specimen,
    *,
    steps: int,
    threads: int = 1,
    names: tuple[str, ...] | None = None,
    progress: Progress | None = None,
) -> Timing:
    """Time the models on one specimen in turns; the scenes are removed afterwards.

    Args:
        specimen: A rectangle.
        steps: Steps of each model.
        threads: Threads of a step.
        names: Models to time; None for all.
        progress: Called with (steps done, steps expected, text).
    """
    chunk = math.ceil(steps / TURNS)
    turns = math.ceil(steps / chunk)
    with _threads(threads):
        yade.O.reset()
        try:
            cases = [
                _case(name, specimen, threads)
                for name in BUILDERS
                if names is None or name in names
            ]
            for turn in range(turns):
                for number, case in enumerate(cases):
                    _take_turn(case, chunk)
                    if progress is not None:
                        done = (turn * len(cases) + number + 1) * chunk
                        progress(done, turns * len(cases) * chunk, "timing")
        finally:
            yade.O.reset()
    described = {**specimen.dimensions, "seed": specimen.seed, **cases[0].counts}
    return Timing(machine(), described, threads, turns * chunk, cases)


def grow(
    steps: int, width: float, height: float, seed: int, threads: int, progress: Progress | None
) -> list[dict[str, float | int]]:
    """Time the flexible model on specimens with more and more grains."""
    found = []
    for scale in SCALES:
        side = math.sqrt(scale)
        start = time.perf_counter()
        specimen = _specimen(width * side, height * side, seed, progress)
        packed = time.perf_counter() - start
        share = max(10 * TURNS, steps // scale)
        timing = compare(
            specimen, steps=share, threads=threads, names=("refined",), progress=progress
        )
        case = timing.cases[0]
        grains = case.counts["grains"]
        found.append(
            {
                "grains": grains,
                "contacts": case.counts["contacts"],
                "specimen_time": packed,
                "step_time": case.step_time,
                "time_per_grain": case.step_time / grains,
            }
        )
    return found


def _build_own(specimen: Specimen, threads: int, **options: Any) -> dict[str, int | None]:
    """A uniaxial test as `flexpm run` sets it up, just before it is driven."""
    built = models.build(specimen, None, threads=threads, **options)
    recorder = wrapper.AxialRecorder()
    built.add_engines(after=(recorder,))
    plan = protocols.schedule(recorder.scales(), "uniaxial", protocols.Settings())
    built.add_engines(before=(wrapper.PlatenEngine(velocity=-plan.velocity),))
    return built.solver.counts()


def _build_yade(specimen: Specimen, threads: int, model: str) -> dict[str, int | None]:
    """Bonded spheres squeezed at about the same rate, without plates and record."""
    built = yade_models.build(specimen, None, model, damping=models.DAMPING, threads=threads)
    heights = specimen.centres[:, 1]
    rate = 1e-8 / np.ptp(heights)
    for body, height in zip(built.ids, heights.tolist(), strict=True):
        yade.O.bodies[body].state.vel = (0.0, -rate * height, 0.0)
    return built.counts()


#: Name, label and builder of each model, in the order of a turn.
BUILDERS: dict[str, tuple[str, Callable[[Specimen, int], dict[str, int | None]]]] = {
    "refined": (
        "flexible, refined, 3 points",
        lambda specimen, threads: _build_own(specimen, threads, mesh="refined", points=3),
    ),
    "fan": (
        "flexible, fan, 3 points",
        lambda specimen, threads: _build_own(specimen, threads, mesh="fan", points=3),
    ),
    "jcfpm": (
        "YADE JCFpm",
        lambda specimen, threads: _build_yade(specimen, threads, "jcfpm"),
    ),
    "cohfrict": (
        "YADE CohFrict",
        lambda specimen, threads: _build_yade(specimen, threads, "cohfrict"),
    ),
}


def _case(name: str, specimen: Specimen, threads: int) -> Case:
    label, build = BUILDERS[name]
    omega = yade.O
    scene = omega.addScene()
    omega.switchToScene(scene)
    counts = build(specimen, threads)
    case = Case(name, label, scene, counts)
    for _ in range(_WARM_UP):
        omega.step()
    return case


def _take_turn(case: Case, steps: int) -> None:
    """Do and time the next steps of a model."""
    omega = yade.O
    omega.switchToScene(case.scene)
    wall, own = time.perf_counter(), time.thread_time()
    for _ in range(steps):
        omega.step()  # in this thread, whose number of threads is known
    case.cpu_times.append((time.thread_time() - own) / steps)
    case.times.append((time.perf_counter() - wall) / steps)


@contextmanager
def _threads(count: int) -> Iterator[None]:
    """Let YADE's own loops use `count` threads: not all of them obey their engine's number."""
    openmp = ctypes.CDLL("libgomp.so.1")
    before = openmp.omp_get_max_threads()
    openmp.omp_set_num_threads(count)
    try:
        yield
    finally:
        openmp.omp_set_num_threads(before)


def _specimen(width: float, height: float, seed: int, progress: Progress | None) -> Specimen:
    """Grains and thickness of the paper's specimen."""
    return Specimen.rectangle(width, height, 0.08, seed=seed, progress=progress)
