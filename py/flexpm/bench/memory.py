# SPDX-License-Identifier: GPL-3.0-or-later
"""Costs of a specimen besides its steps: set-up, memory, files, and memory traffic of a step.

Times in seconds, sizes in bytes.
"""

from __future__ import annotations

import gc
import os
import time
from collections.abc import Mapping
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
import yade

from .._flexpm import give_back_memory
from ..models.grains import build
from ..progress import Progress
from ..results.vtu import write_vtu
from ..specimens.specimen import Specimen

#: Bytes that a step has to move with the refined mesh and three points when the arrays exceed the
#: caches: every array once for each time it is read or written, no write-allocation.
_TRAFFIC = {
    # between whole shared edges: the rows (nodes 24, areas 16, span, reach and normal 56, state
    # 216, forces 64) and the places of the forces (24); what contacts leave in a cache for the
    # grains that follow at once does not count again
    "contacts": 400,
    # displacement and velocity, both ways (64), force (16), mass (8) and prescribed flags (2)
    "nodes": 90,
    # shape functions and volume
    "triangles": 40,
    # position and velocity of the body
    "grains": 48,
}

_TRIAD_LENGTH = 1 << 24  # doubles of each array: 128 MiB, more than any cache
_TRIAD_BYTES = 5 * 8  # two passes: read and write, read two and write
_TRIAD_PASSES = 9


def timed_set_up(
    thickness: float, width: float, height: float, seed: int, progress: Progress | None
) -> tuple[Specimen, dict[str, float | int]]:
    """Make a rectangle and its flexible model, and measure times and memory.

    Args:
        thickness: Thickness of the specimen [m].
        width: Width of the specimen [m].
        height: Height of the specimen [m].
        seed: Seed of the packing.
        progress: Called with (steps done, steps expected, text).

    Returns:
        The specimen, and: grains, contacts, specimen_time (packing and cells), model_time (meshes,
        arrays, bodies, interactions), first_step_time (the collider's first run), vtu_time,
        memory_per_grain (growth of the resident set from before the packing to after the step).
    """
    give_back()
    before, start = resident(), time.perf_counter()
    specimen = Specimen.rectangle(width, height, thickness, seed=seed, progress=progress)
    packed = time.perf_counter()
    yade.O.reset()
    try:
        built = build(specimen)
        made = time.perf_counter()
        yade.O.step()
        stepped = time.perf_counter()
        memory = resident() - before
        grains, contacts = len(specimen.discs), len(specimen.tessellation.shared_edges)
        with TemporaryDirectory() as folder:
            snapshot = built.snapshot()
            begin = time.perf_counter()
            write_vtu(Path(folder) / "state.vtu", snapshot)
            written = time.perf_counter() - begin
    finally:
        yade.O.reset()
    return specimen, {
        "grains": grains,
        "contacts": contacts,
        "specimen_time": packed - start,
        "model_time": made - packed,
        "first_step_time": stepped - made,
        "vtu_time": written,
        "memory_per_grain": memory / grains,
    }


def bytes_per_step(counts: Mapping[str, int]) -> int:
    """Return the memory traffic of a step with the refined mesh and three points [B]."""
    return sum(size * counts[name] for name, size in _TRAFFIC.items())


def triad() -> float:
    """Return the memory bandwidth of a thread [B/s]: median of several passes of a = b + s c."""
    a, b, c = (np.full(_TRIAD_LENGTH, value) for value in (0.0, 1.0, 2.0))
    times = []
    for _ in range(_TRIAD_PASSES):
        start = time.perf_counter()
        np.multiply(c, 3.0, out=a)
        np.add(a, b, out=a)
        times.append(time.perf_counter() - start)
    return _TRIAD_BYTES * _TRIAD_LENGTH / median(times)


def resident() -> int:
    """Return the memory that the process uses now [B]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def give_back() -> None:
    """Return freed memory to the system, so that later measurements count new memory."""
    gc.collect()
    give_back_memory()
