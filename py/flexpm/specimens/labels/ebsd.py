# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of maps of crystal orientations (EBSD): points connected by small misorientations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...arrays import IntArray
from ...errors import InputError
from ...files import Table, load_toml
from ...require import Bounds, quoted, require_known, require_name, require_number, require_one_of
from . import ang, ctf
from .laue import misorientations
from .orientation_map import OrientationMap
from .picture import HOLE_NAME

_WHERE = "Specimen.from_ebsd"
#: What becomes of points without an orientation.
UNINDEXED = ("fill", "hole")
#: Below this two neighbours are of one grain [degree].
MISORIENTATION = 10.0
_READERS = {".ctf": ctf.read, ".ang": ang.read}
#: Label of pixels of no grain.
_VOID = -1


@dataclass(frozen=True)
class OrientedGrains:
    """Grains of a map as labels.

    Attributes:
        labels: Label of each pixel, (rows, columns), the first row at the top.
        minerals: Index of each label's mineral in `names`; None for a hole.
        names: Minerals in the order of the file's phases.
        counts: Numbers of points, of unindexed points, and of unindexed points that were filled;
            also ``steps``, ``grid`` and ``cells`` if they differ from the head of the file.
    """

    labels: IntArray
    minerals: dict[int, int | None]
    names: list[str]
    counts: Table


def read(path: Path) -> OrientationMap:
    """Read a map in the format of the file's extension.

    Args:
        path: The file.

    Returns:
        The map.

    Raises:
        InputError: for an unknown extension, and as the reader of the format.
    """
    suffix = path.suffix.lower()
    if suffix not in _READERS:
        raise InputError(
            f"ebsd = {quoted(str(path))}, must end in {' or '.join(_READERS)}; export the map in "
            "such a format"
        )
    return _READERS[suffix](path)


def read_phases(path: Path, found: OrientationMap) -> dict[str, str]:
    """Read the mineral, or ``hole``, of each phase from a TOML file of ``"phase" = "mineral"``.

    Args:
        path: The TOML file.
        found: The map.

    Returns:
        Mineral by phase.

    Raises:
        InputError: for a key that is not a phase, or a phase without a key.
    """
    known = [phase.name for phase in found.phases]
    given: dict[str, str] = {}
    for key, name in load_toml(path, "phases").items():
        require_known("phases key", key, known)
        given[key] = require_name(f"phases {quoted(key)}", name)
    present = {known[index] for index in np.unique(found.phase[found.phase >= 0]).tolist()}
    for name in known:
        if name in present and name not in given:
            raise InputError(f"phases {quoted(name)} is missing in {path}; name its mineral")
    return given


def grains(
    found: OrientationMap,
    misorientation: float = MISORIENTATION,
    unindexed: str = UNINDEXED[0],
    phases: Mapping[str, str] | None = None,
) -> OrientedGrains:
    """Return the grains of a map as labels.

    Two neighbours of the same phase belong to one grain if their misorientation is below a
    threshold.

    Args:
        found: The map.
        misorientation: Smallest misorientation between two grains [degree]: the minimum over all
            rotations that are equivalent by the symmetry of the phase.
        unindexed: Treatment of points without a phase. ``fill``: they take the grain of most of
            their neighbours, from the rim inwards. ``hole``: they are not rock.
        phases: Mineral of each phase, or ``hole``; None: each phase is a mineral with its own name.

    Returns:
        Labels, minerals and counts.

    Raises:
        InputError: for a value out of range, or a map without any phase.
    """
    bounds = Bounds(above=0.0, at_most=180.0)
    require_number(f"{_WHERE}: misorientation", misorientation, bounds, "degree")
    require_one_of(f"{_WHERE}: unindexed", unindexed, UNINDEXED)
    points = int(np.count_nonzero(found.phase >= 0))
    if not points:
        raise InputError("ebsd: points with a phase = 0, must be >= 1; index the map")
    pairs = _neighbours(found.raster)
    labels = _components(found, pairs, misorientation)
    measured = len(found.phase) - found.missing
    counts: Table = {"points": measured, "not_indexed": measured - points, "missing": found.missing}
    counts |= found.grid.unlike_head
    if unindexed == "fill":
        source = _fill(labels, pairs)
        counts["filled"] = int(np.count_nonzero(source != np.arange(len(source))))
        # parts of a grain that gaps have parted meet now
        found = replace(found, phase=found.phase[source], orientations=found.orientations[source])
        labels = _components(found, pairs, misorientation)
    phase_of = np.zeros(labels.max() + 1, dtype=int)
    phase_of[labels[found.phase >= 0]] = found.phase[found.phase >= 0]
    called = [(phases or {}).get(one.name, one.name) for one in found.phases]
    there = [called[index] for index in np.unique(phase_of).tolist()]
    names = [name for name in dict.fromkeys(there) if name != HOLE_NAME]
    minerals: dict[int, int | None] = {_VOID: None}
    for label, index in enumerate(phase_of.tolist()):
        minerals[label] = None if called[index] == HOLE_NAME else names.index(called[index])
    return OrientedGrains(labels[found.raster], minerals, names, counts)


def _neighbours(raster: IntArray) -> IntArray:
    """Return the pairs of points whose pixels share a side, (n, 2)."""
    sides = [(raster[:, :-1], raster[:, 1:]), (raster[:-1], raster[1:])]
    pairs = np.concatenate([np.stack((a.ravel(), b.ravel()), axis=1) for a, b in sides])
    low, high = np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1).T
    size = int(raster.max()) + 1
    found: IntArray = np.stack(np.divmod(np.unique(size * low + high), size), axis=1)
    return found


def _components(found: OrientationMap, pairs: IntArray, most: float) -> IntArray:
    """Return the grain index of each point, (n,); -1 for points that are not indexed."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    hang = np.zeros(len(pairs), dtype=bool)
    one, other = found.phase[pairs].T
    for index, phase in enumerate(found.phases):
        of = np.flatnonzero((one == index) & (other == index))
        first, second = (found.orientations[pairs[of, end]] for end in (0, 1))
        hang[of] = misorientations(first, second, phase.rotations) < most
    first, second = pairs[hang].T
    size, ones = len(found.phase), np.ones(int(hang.sum()), dtype=np.int8)
    graph = coo_array((ones, (first, second)), shape=(size, size))
    numbers = connected_components(graph, directed=False)[1]
    kept = np.unique(numbers[found.phase >= 0], return_inverse=True)[1]
    labels = np.full(size, _VOID)
    labels[found.phase >= 0] = kept
    return labels


def _fill(labels: IntArray, pairs: IntArray) -> IntArray:
    """Give each point without a label the label of most of its neighbours.

    Returns:
        For each point, the index of the point whose label it has: its own index, or an indexed
        point of its new grain.
    """
    ways = np.concatenate((pairs, pairs[:, ::-1]))
    source: IntArray = np.arange(len(labels))
    size = len(labels)
    while True:
        ways = ways[labels[ways[:, 0]] == _VOID]
        known = ways[labels[ways[:, 1]] != _VOID]
        if not len(known):
            return source
        both = known[:, 0] * size + labels[known[:, 1]]
        found, first, often = np.unique(both, return_index=True, return_counts=True)
        point, label = np.divmod(found, size)
        order = np.lexsort((label, -often, point))
        points, chosen = np.unique(point[order], return_index=True)
        labels[points] = label[order[chosen]]
        source[points] = source[known[first[order[chosen]], 1]]
