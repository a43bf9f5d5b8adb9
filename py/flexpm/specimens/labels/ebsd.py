# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of maps of crystal orientations (EBSD): what hangs together at small misorientations."""

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
        labels: Label of each pixel, the first row on top.
        minerals: Index of each label's mineral in `names`; None for a hole.
        names: Minerals in the order of the file's phases.
        counts: Points, those not indexed, and those of them that were filled; ``steps``, ``grid``
            and ``cells`` where they differ from the file's head.
    """

    labels: IntArray
    minerals: dict[int, int | None]
    names: list[str]
    counts: Table


def read(path: Path) -> OrientationMap:
    """Read a map by the end of its name.

    Raises:
        InputError: for another end, and as the readers.
    """
    suffix = path.suffix.lower()
    if suffix not in _READERS:
        raise InputError(
            f"ebsd = {quoted(str(path))}, must end in {' or '.join(_READERS)}; export the map so"
        )
    return _READERS[suffix](path)


def read_phases(path: Path, found: OrientationMap) -> dict[str, str]:
    """Mineral, or ``hole``, of each phase, from a TOML file of ``"phase" = "mineral"``.

    Raises:
        InputError: for a key that is no phase, and a phase that no key names.
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
    """Labels of grains.

    Neighbours of one phase are of one grain below a misorientation.

    Args:
        found: The map.
        misorientation: The smallest one, over all that the phase's symmetry makes alike, that
            parts two grains [degree].
        unindexed: ``fill``: points without a phase take that of most of their neighbours, from
            the rim inwards; ``hole``: they are no rock.
        phases: Mineral of each phase, or ``hole``; None: each is one of its own name.

    Raises:
        InputError: for a value out of range, and a map without any phase.
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
    """Pairs of points whose pixels share a side, (n, 2)."""
    sides = [(raster[:, :-1], raster[:, 1:]), (raster[:-1], raster[1:])]
    pairs = np.concatenate([np.stack((a.ravel(), b.ravel()), axis=1) for a, b in sides])
    low, high = np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1).T
    size = int(raster.max()) + 1
    found: IntArray = np.stack(np.divmod(np.unique(size * low + high), size), axis=1)
    return found


def _components(found: OrientationMap, pairs: IntArray, most: float) -> IntArray:
    """Number of the grain of each point; -1 where it is not indexed."""
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
    """Give each point without a label that of most of its neighbours.

    Returns:
        For each point itself, or the indexed point of its new grain that it is now like.
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
