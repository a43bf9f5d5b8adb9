# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of VTK's files, and the one among them that has the labels of voxels.

The readers of VTK do not check a file: a changed file can end the process or block it. These
readers know the few forms of regular grids, and check all sizes before they take memory.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...arrays import AnyArray, NumberType
from ..files.number_text import Bytes, mapped
from .label_volume import Counts, Triple
from .volume_file import Content, VolumeFile, refused, require_file, require_size

#: Most voxels along an axis.
MOST_ALONG = 2**31


@dataclass(frozen=True)
class Array:
    """An array of a file.

    Attributes:
        name: Its name.
        of_cells: Whether it has a value for each cell; otherwise for each point.
        form: Type of its numbers.
        components: Numbers for each cell or point.
        values: Reads this many numbers.
        bytes_a_number: Memory that this takes for each number [byte].
    """

    name: str
    of_cells: bool
    form: NumberType
    components: int
    values: Callable[[int], AnyArray]
    bytes_a_number: float


@dataclass(frozen=True)
class Grid:
    """A regular grid.

    Attributes:
        points: Number of points along x, y, z.
        spacing: Distance of points.
        origin: Position of the first point.
        arrays: Arrays of cells and points.
    """

    points: Counts
    spacing: Triple
    origin: Triple
    arrays: Sequence[Array]


def content_of(path: Path) -> Bytes:
    """Return the content of a file, which stays on the disk.

    Raises:
        InputError: if it is not a file, or cannot be read.
    """
    require_file(path)
    try:
        return mapped(path)
    except (OSError, ValueError) as error:
        raise refused(path, f"cannot be read ({error})", "give a file of VTK") from None


def volume_of(path: Path, grid: Grid, array: str | None) -> VolumeFile:
    """Return the volume of a grid: its cells are voxels; without data of cells, its points are.

    Args:
        path: The file.
        grid: The grid.
        array: Name of the labels; None: the only array of whole numbers, otherwise the only one.

    Raises:
        InputError: if several arrays or none may have the labels.
    """
    chosen = _chosen(path, grid.arrays, array)
    counts, origin = grid.points, grid.origin
    if chosen.of_cells:
        x, y, z = (max(count - 1, 0) for count in counts)
        counts = (x, y, z)
    else:  # a point is the middle of its voxel
        corner = [o - 0.5 * d for o, d in zip(origin, grid.spacing, strict=True)]
        origin = (corner[0], corner[1], corner[2])
    require_size(path, counts, require_file(path), chosen.bytes_a_number)
    number = counts[0] * counts[1] * counts[2]

    def load() -> Content:
        return Content(chosen.values(number).reshape(counts[::-1]))

    bytes_a_voxel = round(chosen.bytes_a_number)
    return VolumeFile(counts, load, bytes_a_voxel, grid.spacing, origin)


def _chosen(path: Path, arrays: Sequence[Array], name: str | None) -> Array:
    """Return the array of labels."""
    single = [one for one in arrays if one.components == 1]
    named = [one for one in single if name in (None, one.name)]
    found = [one for one in named if one.of_cells] or named
    found = [one for one in found if one.form.kind in "iu"] or found
    if len(found) == 1:
        return found[0]
    there = ", ".join(dict.fromkeys(one.name for one in single)) or "none"
    if not found:
        raise refused(
            path,
            f"array {'of labels' if name is None else name} is missing; arrays of one number for "
            f"each cell or point = {there}",
            "write one of labels",
        )
    raise refused(path, f"array of labels may be one of {there}", "give one of them as array")
