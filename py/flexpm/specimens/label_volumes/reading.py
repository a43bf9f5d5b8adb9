# SPDX-License-Identifier: GPL-3.0-or-later
"""Read a label volume from a file of any known format."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...arrays import IntArray
from ...errors import InputError
from ...require import Bounds, quoted, require_number, require_one_of
from ..checks import require_length
from ..labels.majority import majority
from . import dream3d, npy, raw, tesr, tiff, vti, vtk
from .label_volume import AXES, Crop, LabelVolume, Triple, Window, require_counts, voxel_sizes
from .volume_file import (
    Content,
    VolumeFile,
    name_of,
    refused,
    require_memory_of,
)

#: Lengths of the units that users may state for files without one [m].
UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6}
_READERS: dict[str, Callable[[Path], VolumeFile]] = {
    **dict.fromkeys(tiff.SUFFIXES, tiff.read),
    ".npy": npy.read,
    ".tesr": tesr.read,
}
#: Formats of which a file may have several arrays.
_NAMED: dict[str, Callable[[Path, str | None], VolumeFile]] = {
    ".dream3d": dream3d.read,
    ".vti": vti.read,
    ".vtk": vtk.read,
}
_RAW = ".raw"
#: Largest distance of the first voxel from 0 [m].
_FARTHEST = 1e6
#: Different phases of a volume.
MOST_PHASES = 100
#: Memory of the labels and of the tables that number them, for each voxel [byte].
_BYTES_A_VOXEL = 12


def read(
    path: Path | str,
    *,
    voxel: float | Sequence[float] | None = None,
    unit: str | None = None,
    counts: Sequence[int] | None = None,
    dtype: str | None = None,
    array: str | None = None,
    crop: Crop | None = None,
    coarsen: int = 1,
) -> LabelVolume:
    """Read a label volume.

    Formats: ``.tif`` and ``.tiff`` with several pages, a folder of numbered slices (``.tif``,
    ``.png``), ``.npy``, ``.raw``, ``.tesr``, ``.dream3d``, ``.vti`` and ``.vtk``.

    Args:
        path: The file, or the folder of slices.
        voxel: Size of a voxel, or sizes along x, y, z [m]. It replaces the spacing in the file.
        unit: Unit of the spacing in the file, ``m``, ``mm`` or ``um``, for files that do not state
            it.
        counts: Number of voxels along x, y, z, for ``.raw`` files only.
        dtype: Type of the numbers, for ``.raw`` files only, see `raw.read`.
        array: Name of the array of labels, for files that have several arrays.
        crop: Part that is read: first voxel, and the voxel after the last one, along x, y, z.
        coarsen: Take every n-th voxel along each axis, see `LabelVolume.coarsen`.

    Returns:
        The volume.

    Raises:
        InputError: for a file that cannot be read, a wrong argument, or a volume that needs more
            memory than the machine has available.
    """
    path = Path(path)
    file = _head(path, counts, dtype, array)
    spacing, origin = _scale(path, file, voxel, unit)
    name = name_of(path)
    require_counts(name, file.counts)
    window = Window.of(name, file.counts, crop, coarsen)
    needed = file.bytes_a_voxel * math.prod(file.counts)
    needed += _BYTES_A_VOXEL * math.prod(window.counts)
    require_memory_of(path, file.counts, needed)
    content = file.load()
    spacing, origin = window.frame(spacing, origin)
    made = LabelVolume.of(content.values[window.slices], spacing, origin, source=path.name)
    return replace(
        made,
        phases=_phases(path, made, content, window),
        phase_names=content.phase_names,
        has_voids=content.has_voids and bool((made.ids == 0).any()),
        file_counts=file.counts,
    )


def _head(
    path: Path, counts: Sequence[int] | None, dtype: str | None, array: str | None
) -> VolumeFile:
    """Return the head of a file, by the reader of its suffix."""
    suffix = path.suffix.lower()
    if array is not None and suffix not in _NAMED:
        raise refused(
            path,
            f"array = {quoted(array)}, is for {', '.join(_NAMED)} files only",
            "leave array out",
        )
    if suffix == _RAW:
        return raw.read(path, counts, dtype)
    for key, value in (("counts", counts), ("dtype", dtype)):
        if value is not None:
            raise refused(
                path, f"{key} = {quoted(value)}, is for {_RAW} files only", f"leave {key} out"
            )
    if suffix in _NAMED:
        return _NAMED[suffix](path, array)
    if _is_folder(path):
        return tiff.read_folder(path)
    if suffix not in _READERS:
        raise InputError(
            f"{name_of(path)}, must be a folder of slices or end in "
            f"{', '.join((*_READERS, _RAW, *_NAMED))}; convert it"
        )
    return _READERS[suffix](path)


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):  # no name of a file
        return False


def _scale(
    path: Path, file: VolumeFile, voxel: float | Sequence[float] | None, unit: str | None
) -> tuple[Triple, Triple]:
    """Return the size of a voxel and the corner of the first voxel [m]."""
    if unit is not None:
        require_one_of("unit", unit, [*UNITS])
    if voxel is not None:
        if unit is not None:
            raise refused(
                path, f"unit = {unit}, has no use: voxel is in metres", "give voxel or unit"
            )
        given = voxel_sizes(voxel)
        steps = file.spacing or given
        return given, _corner(path, [h / d for d, h in zip(steps, given, strict=True)], file.origin)
    if file.spacing is None:
        raise refused(path, "size of a voxel is missing in the file", "give voxel in metres")
    if file.metres is None and unit is None:
        sizes = " x ".join(f"{size:g}" for size in file.spacing)
        raise refused(
            path,
            f"spacing = {sizes} along x, y, z has no unit",
            f"give unit, one of {', '.join(UNITS)}, or voxel in metres",
        )
    if file.metres is not None and unit is not None:
        raise refused(path, f"unit = {unit}, has no use: the file states its unit", "leave it out")
    metres = UNITS[unit] if unit is not None else file.metres or 1.0
    x, y, z = (
        require_length(name_of(path), f"spacing along {axis}", metres * size)
        for axis, size in zip(AXES, file.spacing, strict=True)
    )
    return (x, y, z), _corner(path, [metres] * 3, file.origin)


def _corner(path: Path, metres: Sequence[float], origin: Triple) -> Triple:
    """Return the corner of the first voxel [m] from its lengths in units of `metres`."""
    bounds = Bounds(at_least=-_FARTHEST, at_most=_FARTHEST)
    x, y, z = (
        require_number(f"{name_of(path)}: origin along {axis}", unit * length, bounds, "m")
        for axis, unit, length in zip(AXES, metres, origin, strict=True)
    )
    return x, y, z


def _phases(path: Path, made: LabelVolume, content: Content, window: Window) -> IntArray | None:
    """Return the phase of each label of a volume, from a table of the file or by its voxels."""
    if content.phases is not None and len(content.phases[0]):
        known, numbers = content.phases
        order = np.argsort(known, kind="stable")
        at = order[np.minimum(np.searchsorted(known[order], made.ids), len(known) - 1)]
        missing = made.ids[known[at] != made.ids]
        missing = missing[missing != 0] if content.has_voids else missing
        if len(missing):
            raise refused(path, f"phase of label {missing[0]} is missing", "complete the file")
        phases: IntArray = np.where(known[at] == made.ids, numbers[at], 0)
        return phases
    if content.phase_values is None:
        return None
    name = f"phases of {path.name}"
    volume = LabelVolume.of(content.phase_values[window.slices], made.spacing, source=name)
    kinds = len(volume.ids)
    if kinds > MOST_PHASES:
        raise refused(
            path, f"phases = {kinds} different ones, must be <= {MOST_PHASES}", "renumber them"
        )
    most: IntArray = volume.ids[majority(made.labels, volume.labels, len(made.ids), kinds)]
    return most
