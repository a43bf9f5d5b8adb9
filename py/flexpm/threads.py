# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads of YADE's own loops, by OpenMP.

Engines have a number of threads each, but containers, the collider and sums over all bodies do not
obey it: they take all cores. Beside other programs a step then waits for threads that wait for a
core, and contacts come in another order.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager

#: Numbers that were there before each of the present limits.
_before: list[int] = []


@contextmanager
def limited(count: int) -> Iterator[None]:
    """Let YADE's loops in this thread use at most `count` threads.

    Never more than there were: scenes have room for these alone.
    """
    openmp = ctypes.CDLL("libgomp.so.1")
    _before.append(openmp.omp_get_max_threads())
    openmp.omp_set_num_threads(min(count, _before[-1]))
    try:
        yield
    finally:
        openmp.omp_set_num_threads(_before.pop())


@contextmanager
def for_scenes() -> Iterator[None]:
    """Lift all limits where YADE makes a scene, which later loops with more threads may use."""
    if not _before:
        yield
        return
    openmp = ctypes.CDLL("libgomp.so.1")
    now = openmp.omp_get_max_threads()
    openmp.omp_set_num_threads(_before[0])
    try:
        yield
    finally:
        openmp.omp_set_num_threads(now)
