# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the input of a specimen, with one-line errors. Lengths in metres."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path

from ..errors import InputError
from ..files import read_text
from ..require import LENGTH, Bounds, require_number, require_whole

#: Edges of cells below this share of the mean diameter are collapsed: 0.35 mm for discs of 2-4 mm.
SHORT_EDGE = 0.35 / 3.0
#: Smallest and largest diameter of packed discs and spheres, unless they are given [m].
DIAMETERS = (2e-3, 4e-3)


def require_length(where: str, name: str, value: object) -> float:
    """Return a length [m], which must be above zero."""
    return require_number(f"{where}: {name}", value, LENGTH, "m")


def require_porosity(where: str, porosity: object) -> float:
    """Return a porosity [-], which must be at least 0 and below 1."""
    return require_number(f"{where}: porosity", porosity, Bounds(at_least=0.0, below=1.0))


def require_diameters(where: str, diameters: object, room: float) -> tuple[float, float]:
    """Return smallest and largest diameter [m], which must be in order and fit the room [m]."""
    given = list(diameters) if isinstance(diameters, Iterable) else []
    if len(given) != 2:
        raise InputError(
            f"{where}: diameters = {diameters} m, must be two numbers; give smallest and largest"
        )
    smallest = require_length(where, "smallest diameter", given[0])
    largest = require_length(where, "largest diameter", given[1])
    if smallest > largest:
        raise InputError(
            f"{where}: diameters = {smallest}, {largest} m, smallest must not exceed largest; "
            "swap them"
        )
    if largest > 0.5 * room:
        raise InputError(
            f"{where}: largest diameter = {largest} m, must be <= half the specimen's smallest "
            f"dimension, {0.5 * room:.6g} m; choose smaller discs"
        )
    return smallest, largest


def require_memory(where: str, grains: float, each: float) -> None:
    """Refuse a packing that the machine has no memory for, before it is begun.

    Args:
        where: Beginning of the message: the specimen that is packed.
        grains: Expected number of grains.
        each: Memory of a grain [bytes].

    Raises:
        InputError: if the packing needs more than the memory of the machine.
    """
    needed, there = each * grains, memory_of_machine()
    if needed > there:
        raise InputError(
            f"{where}: grains = {grains:.4g}, need {needed / 1e9:.3g} GB of memory, must be at "
            f"most {there / 1e9:.3g} GB; choose larger diameters or a smaller specimen, in m"
        )


def memory_of_machine() -> int:
    """Return the memory of the machine [byte]."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def available_memory() -> int:
    """Return the memory that processes can take without swapping [byte]."""
    try:
        found = re.search(r"MemAvailable:\s*(\d+) kB", read_text(Path("/proc/meminfo")))
    except (OSError, ValueError):
        found = None
    return memory_of_machine() if found is None else 1024 * int(found[1])


def require_seed(where: str, seed: object) -> int:
    """Return a seed, which must be a whole number of 64 bits."""
    return require_whole(f"{where}: seed", seed, Bounds(at_least=0, below=2**64))


def require_short_edge(share: object) -> float:
    """Return a share of the mean diameter [-], which must be in [0, 0.5)."""
    return require_number("Specimen: short_edge", share, Bounds(at_least=0.0, below=0.5))
