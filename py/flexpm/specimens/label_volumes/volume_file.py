# SPDX-License-Identifier: GPL-3.0-or-later
"""Heads of the files of label volumes, which are known before their voxels are read."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...arrays import AnyArray, IntArray
from ...errors import InputError
from ...require import quoted
from ..checks import available_memory
from .label_volume import AXES, Counts, Triple, require_counts, sized

#: Largest ratio of voxels to bytes of a file, which no compression of these formats exceeds.
_MOST_VOXELS_A_BYTE = 4096


@dataclass(frozen=True)
class Content:
    """Voxels of a file.

    Attributes:
        values: Labels, (z, y, x).
        phases: Labels, and the index of the phase of each; None without phases.
        phase_values: Index of each voxel's phase, (z, y, x); None without phases by voxel.
        phase_names: Names of phases by index.
        has_voids: Whether label 0 stands for no rock.
    """

    values: AnyArray
    phases: tuple[IntArray, IntArray] | None = None
    phase_values: AnyArray | None = None
    phase_names: Mapping[int, str] = field(default_factory=dict)
    has_voids: bool = False


@dataclass(frozen=True)
class VolumeFile:
    """The head of a file.

    Attributes:
        counts: Number of voxels along x, y, z.
        load: Reads the voxels.
        bytes_a_voxel: Memory that `load` takes for each voxel [byte].
        spacing: Size of a voxel along x, y, z, in the unit of the file; None: not in the file.
        origin: Corner of the first voxel in the same unit.
        metres: Length of the unit [m]; None: not in the file.
    """

    counts: Counts
    load: Callable[[], Content]
    bytes_a_voxel: int = 0
    spacing: Triple | None = None
    origin: Triple = (0.0, 0.0, 0.0)
    metres: float | None = None


def name_of(path: Path) -> str:
    """Return how messages name the file of a volume."""
    return f"volume = {quoted(str(path))}"


def refused(path: Path, reason: str, remedy: str) -> InputError:
    """Return the error of a file of a volume."""
    return InputError(f"{name_of(path)}: {reason}; {remedy}")


def require_file(path: Path) -> int:
    """Return the size of a plain file [byte]; pipes might never end.

    Raises:
        InputError: if it is not a file.
    """
    try:
        if path.is_file():
            return path.stat().st_size
        reason = "is missing" if not path.exists() else "is not a file"
    except (OSError, ValueError) as error:
        reason = f"cannot be read ({error})"
    raise InputError(f"{name_of(path)}, {reason}; give the file of a volume")


def require_size(path: Path, counts: Counts, size: int, bytes_a_voxel: float) -> None:
    """Check the numbers of voxels of a head before memory is taken.

    Args:
        path: The file.
        counts: Number of voxels along x, y, z.
        size: Size of the file [byte].
        bytes_a_voxel: Memory that reading takes for each voxel [byte].

    Raises:
        InputError: for a single slice, for more voxels than a file of this size can have, and for
            more than the memory.
    """
    require_counts(name_of(path), counts)
    voxels = math.prod(counts)
    if voxels > _MOST_VOXELS_A_BYTE * size:
        raise refused(
            path,
            f"voxels = {sized(counts)}, are more than a file of {size} bytes can have",
            "give a whole file",
        )
    require_memory_of(path, counts, bytes_a_voxel * voxels)


def require_memory_of(path: Path, counts: Counts, needed: float) -> None:
    """Refuse a volume that needs more memory [byte] than the machine has available.

    Raises:
        InputError: with the sizes of the volume and of the memory.
    """
    there = available_memory()
    if needed > there:
        raise refused(
            path,
            f"voxels = {sized(counts)}, need {needed / 1e9:.3g} GB of memory, must be at most "
            f"{there / 1e9:.3g} GB",
            "crop or coarsen the volume",
        )


def triple_of(path: Path, what: str, values: object, least: float) -> Triple:
    """Return three numbers of a file, along x, y, z.

    Args:
        path: The file.
        what: Name of the numbers.
        values: The numbers.
        least: They must be above it.

    Raises:
        InputError: if they are not three finite numbers above `least`.
    """
    try:
        given = np.asarray(values).ravel()
        # the shortest decimal number of 32 bits, which was meant
        single = given.dtype == np.float32
        found = np.array([*map(str, given)] if single else given, dtype=float)
    except (TypeError, ValueError, OverflowError):
        found = np.zeros(0)
    if len(found) != 3:
        raise refused(
            path, f"{what} = {quoted(values)}, must be 3 numbers along x, y, z", "correct it"
        )
    for axis, value in zip(AXES, found.tolist(), strict=True):
        if not (math.isfinite(value) and value > least):
            rule = "a finite number" if least < 0.0 else f"> {least:g}"
            raise refused(path, f"{what} along {axis} = {value:g}, must be {rule}", "correct it")
    return float(found[0]), float(found[1]), float(found[2])
