# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from files of DREAM3D, ``.dream3d`` of versions 6, 7 and 8.

Version 8 has the numbers of voxels, their size and the origin in attributes of the geometry,
version 7 in the group ``_SIMPL_GEOMETRY`` of a container, version 6 in the container itself.
Features are numbered from 1; voxels with 0 belong to no feature.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import AnyArray, IntArray
from ...errors import InputError
from ...require import quoted
from ..labels.image_files import BROKEN, short
from ..labels.whole import KINDS
from .label_volume import Counts, Triple
from .volume_file import (
    Content,
    VolumeFile,
    name_of,
    refused,
    require_file,
    require_size,
    triple_of,
)

if TYPE_CHECKING:
    import h5py

#: Names of the arrays of features, by age.
_LABELS = ("FeatureIds", "GrainIds")
_PHASES, _PHASE_NAMES = "Phases", "PhaseName"
_OLD_GEOMETRY = "_SIMPL_GEOMETRY"
#: Numbers of voxels, their size and the origin: attributes of version 8, datasets before.
_NEW, _OLD = ("_DIMENSIONS", "_SPACING", "_ORIGIN"), ("DIMENSIONS", "SPACING", "ORIGIN")
#: Groups within each other, and groups and arrays of a file.
_DEEPEST, _MOST = 8, 10_000
_MOST_PHASES = 10_000
_MOST_VOXELS_ALONG = 2**31


@dataclass
class _Geometry:
    """A geometry of a file, with its arrays."""

    name: str
    counts: Counts
    spacing: Triple
    origin: Triple
    arrays: dict[str, h5py.Dataset] = field(default_factory=dict)  #: by path in the file


def read(path: Path, array: str | None = None) -> VolumeFile:
    """Return the head of a file.

    Args:
        path: The file.
        array: Name of the labels of voxels, or their path in the file; None: ``FeatureIds`` or
            ``GrainIds``.

    Raises:
        InputError: if the library is missing, for a file that cannot be read, and for no or
            several such arrays.
    """
    size = require_file(path)
    with _opened(path) as file:
        geometry, name = _chosen(path, _geometries(path, file), array)
        labels = geometry.arrays[name]
        by_feature, by_voxel = _phase_arrays(geometry, name)
        bytes_a_voxel = labels.dtype.itemsize
        if by_feature is None and by_voxel is not None:
            bytes_a_voxel += geometry.arrays[by_voxel].dtype.itemsize
        names = _phase_names(path, geometry)
    require_size(path, geometry.counts, size, bytes_a_voxel)

    def load() -> Content:
        with _opened(path) as file:
            shape = geometry.counts[::-1]
            values = _numbers(path, file[name]).reshape(shape)
            phases, phase_values = None, None
            if by_feature is not None:
                numbers: IntArray = _numbers(path, file[by_feature]).ravel().astype(np.int64)
                phases = (np.arange(len(numbers)), numbers)
            elif by_voxel is not None:
                phase_values = _numbers(path, file[by_voxel]).reshape(shape)
            return Content(values, phases, phase_values, names, has_voids=True)

    return VolumeFile(geometry.counts, load, bytes_a_voxel, geometry.spacing, geometry.origin)


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[h5py.File]:
    """Open a file, with errors of one line that name it."""
    try:
        import h5py
    except ImportError:
        raise InputError(
            f"{name_of(path)}, needs h5py to be read; install the package python3-h5py"
        ) from None
    try:
        with h5py.File(path, "r") as file:
            yield file
    except InputError:  # a ValueError, too
        raise
    except (*BROKEN, RuntimeError, NotImplementedError) as error:
        reason = f"must be a file of DREAM3D: {short(error)}"
        raise refused(path, reason, "give a whole file") from None


def _geometries(path: Path, file: h5py.File) -> list[_Geometry]:
    """Return the image geometries of a file and their arrays."""
    import h5py

    found: list[_Geometry] = []
    left = [(0, file)]
    visited = 0
    while left:
        depth, group = left.pop()
        children = _children(group)
        visited += len(children)
        if visited > _MOST or depth > _DEEPEST:
            raise refused(
                path,
                f"groups and arrays = more than {_MOST}, or {_DEEPEST} within each other",
                "export the volume alone",
            )
        geometry = _geometry(path, group, children)
        if geometry is None:
            left += [(depth + 1, one) for one in children.values() if isinstance(one, h5py.Group)]
            continue
        found.append(geometry)
        for one in children.values():
            inner = _children(one).values() if isinstance(one, h5py.Group) else [one]
            geometry.arrays |= {str(it.name): it for it in inner if isinstance(it, h5py.Dataset)}
    return found


def _children(group: h5py.Group) -> dict[str, h5py.Group | h5py.Dataset]:
    """Return what a group holds itself: links to other places and files are not followed."""
    import h5py

    return {
        name: group[name]
        for name in group
        if isinstance(group.get(name, getlink=True), h5py.HardLink)
    }


def _geometry(path: Path, group: h5py.Group, children: Mapping[str, object]) -> _Geometry | None:
    """Return the image geometry that a group is or has; None if it has none."""
    import h5py

    new, old = _NEW, _OLD
    holder = children.get(_OLD_GEOMETRY, group)
    given: list[object]
    if new[0] in group.attrs:
        given = [group.attrs.get(key) for key in new]
    elif isinstance(holder, h5py.Group) and old[0] in holder:
        inner = _children(holder)
        given = [_small(path, inner.get(key)) for key in old]
    else:
        return None
    where = f"{group.name}: "
    sizes = triple_of(path, f"{where}dimensions", given[0], 0.0)
    if not all(size == int(size) and size < _MOST_VOXELS_ALONG for size in sizes):
        raise refused(
            path, f"{where}dimensions = {sizes}, must be whole numbers below 2^31", "correct them"
        )
    x, y, z = map(int, sizes)
    spacing = triple_of(path, f"{where}spacing", given[1], 0.0)
    origin = triple_of(path, f"{where}origin", given[2], -np.inf)
    return _Geometry(str(group.name), (x, y, z), spacing, origin)


def _small(path: Path, dataset: object) -> AnyArray | None:
    """Return the few numbers of a dataset."""
    import h5py

    if not isinstance(dataset, h5py.Dataset) or not dataset.size or dataset.size > 3:
        return None
    return _numbers(path, dataset)


def _numbers(path: Path, dataset: h5py.Dataset) -> AnyArray:
    """Return the numbers of an array, which must be in the file itself."""
    if dataset.external is not None or dataset.is_virtual:
        raise refused(path, f"{dataset.name} lies in other files, must not", "save it in one file")
    return np.asarray(dataset[()])


def _chosen(path: Path, geometries: list[_Geometry], array: str | None) -> tuple[_Geometry, str]:
    """Return the geometry and the name of the array that has the labels of voxels."""
    wanted = _LABELS if array is None else (array,)
    for label in wanted:
        found = [
            (one, name)
            for one in geometries
            for name, dataset in one.arrays.items()
            if (name.rpartition("/")[2] == label or name.strip("/") == label.strip("/"))
            and _is_of_voxels(dataset, one.counts)
        ]
        if len(found) > 1:
            raise refused(
                path,
                f"array {label} = {', '.join(name for _, name in found)}, must be one",
                "give one of these as array",
            )
        if found:
            return found[0]
    if not geometries:
        raise refused(
            path, "image geometries = 0, must be at least one", "write a file of version 6 to 8"
        )
    there = [
        name
        for one in geometries
        for name, dataset in one.arrays.items()
        if _is_of_voxels(dataset, one.counts)
    ]
    raise refused(
        path,
        f"array {' or '.join(wanted)} of one number for each voxel is missing",
        f"give one of {quoted(there)} as array" if there else "write it by DREAM3D",
    )


def _is_of_voxels(dataset: h5py.Dataset, counts: Counts) -> bool:
    """Whether an array has one number for each voxel."""
    shape = (*counts[::-1], 1)
    return dataset.dtype.kind in KINDS and dataset.shape in (shape, shape[:3])


def _phase_arrays(geometry: _Geometry, labels: str) -> tuple[str | None, str | None]:
    """Return the names of the phases of features, and of those of voxels."""
    beside = f"{labels.rpartition('/')[0]}/{_PHASES}"
    by_voxel = geometry.arrays.get(beside)
    if by_voxel is not None and not _is_of_voxels(by_voxel, geometry.counts):
        by_voxel = None
    by_feature = [
        name
        for name, one in geometry.arrays.items()
        if name.rpartition("/")[2] == _PHASES
        and name != beside
        and one.dtype.kind in "iu"
        and one.ndim in (1, 2)
        and one.size == one.shape[0] <= int(np.prod(geometry.counts, dtype=object)) + 1
    ]
    is_known = labels.rpartition("/")[2] in _LABELS
    return (
        by_feature[0] if is_known and len(by_feature) == 1 else None,
        None if by_voxel is None else beside,
    )


def _phase_names(path: Path, geometry: _Geometry) -> dict[int, str]:
    """Return the names of the phases by their number, from 1."""
    for name, dataset in geometry.arrays.items():
        if name.rpartition("/")[2] != _PHASE_NAMES or dataset.size > _MOST_PHASES:
            continue
        rows = [
            row.decode(errors="replace") if isinstance(row, bytes) else str(row)
            for row in _numbers(path, dataset).ravel().tolist()
        ]
        return {number: row.strip("\0 ") for number, row in enumerate(rows) if number}
    return {}
