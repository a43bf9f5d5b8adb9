# SPDX-License-Identifier: GPL-3.0-or-later
"""Step times of the 3D models on one packing, in alternating rounds, and costs of the set-up.

Times in seconds, sizes in bytes.
"""

from __future__ import annotations

import resource
import time
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

import yade

from ..files import Table
from ..models.grains import build
from ..progress import Progress
from ..report.tables import scaled
from ..specimens.space import cells as of_spheres
from ..specimens.space.spec import SolidSpec
from ..specimens.space.specimen import SolidSpecimen
from ..threads import for_scenes
from . import cases, memory
from .report import REFERENCE, Case, Timing, host_rows

Found = TypeVar("Found")

#: Kilobytes in which Linux tells the peak of a process's memory.
_PEAK_UNIT = 1024


def timed_set_up(spec: SolidSpec, progress: Progress | None) -> tuple[SolidSpecimen, Table]:
    """Make a 3D specimen and its flexible model, and measure times and memory.

    Args:
        spec: Spec of the specimen.
        progress: Called with (steps done, steps expected, text).

    Returns:
        The specimen, and: grains, contacts, packing_time, cells_time (cells, edges collapsed),
        model_time (tetrahedra, rules of points, arrays, masses), start_time (elastic state and
        ends), first_step_time, memory_per_grain (growth of the resident set from before the model
        to after the step) and peak_memory of the process until this step.
    """
    times: dict[str, float] = {}
    spheres = _timed(
        times, "packing", lambda: of_spheres.packed_spheres(f"bench: {spec.kind}", spec, progress)
    )
    kept, cells = _timed(
        times, "cells", lambda: of_spheres.cells_of(spheres, spec, drop_hidden=True)
    )
    specimen = SolidSpecimen(kept, cells, spec, len(spheres) - len(kept))
    with for_scenes():
        yade.O.reset()
    try:
        memory.give_back()
        before = memory.resident()
        built = _timed(times, "model", lambda: build(specimen))
        _timed(times, "start", lambda: cases.start(built))
        _timed(times, "first_step", yade.O.step)
        grown = memory.resident() - before
    finally:
        with for_scenes():
            yade.O.reset()
    grains = len(kept)
    return specimen, {
        "grains": grains,
        "contacts": cells.contacts,
        **{f"{stage}_time": taken for stage, taken in times.items()},
        "memory_per_grain": grown / grains,
        "peak_memory": _PEAK_UNIT * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
    }


def model_rows(timing: Timing) -> list[tuple[str, str]]:
    """Describe a comparison as rows (name, value)."""
    counts = timing.cases[0].counts
    rows = host_rows(timing)
    rows.insert(3, ("nodes, tetrahedra", f"{counts['nodes']}, {counts['tetrahedra']}"))
    return rows + [(case.label, _costs(timing, case)) for case in timing.cases]


def set_up_rows(found: Mapping[str, float]) -> list[tuple[str, str]]:
    """Describe set-up and memory as rows (name, value)."""
    return [
        (
            "set-up",
            f"packing {found['packing_time']:.1f} s, cells {found['cells_time']:.2f} s, "
            f"model {found['model_time']:.2f} s, elastic start {found['start_time']:.1f} s, "
            f"first step {found['first_step_time']:.2f} s",
        ),
        (
            "memory",
            f"{found['memory_per_grain'] / 1024:.1f} KiB a grain, peak of the process "
            f"{found['peak_memory'] / 2**20:.0f} MiB",
        ),
    ]


def scaling_rows(found: Sequence[Mapping[str, float]]) -> list[tuple[str, str]]:
    """Describe growth as rows (name, value)."""
    base = found[0]["time_per_grain"]
    rows = []
    for row in found:
        name = f"{row['grains']} grains"
        share = row["time_per_grain"] / base
        step = scaled(row["step_time"], 1e6, "us")
        each = scaled(row["time_per_grain"], 1e9, "ns", 3)
        rows.append((name, f"{step}, {each} a grain ({share:.2f} of the first)"))
        rows += [(f"{name}: {label}", text) for label, text in set_up_rows(row)]
    return rows


def _costs(timing: Timing, case: Case) -> str:
    """Return the time of a step, per grain and per bond, and its ratio to the reference."""
    step = case.step_time
    parts = [scaled(step, 1e6, "us")]
    for name, unit in (("grains", "grain"), ("contacts", "bond")):
        parts.append(f"{scaled(step / case.counts[name], 1e9, 'ns')} a {unit}")
    if any(other.name == REFERENCE for other in timing.cases) and case.name != REFERENCE:
        parts.append(f"{timing.ratio(case.name):.3f} of JCFpm's")
    return ", ".join(parts)


def _timed(times: dict[str, float], stage: str, work: Callable[[], Found]) -> Found:
    begin = time.perf_counter()
    found = work()
    times[stage] = time.perf_counter() - begin
    return found
