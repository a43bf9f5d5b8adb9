# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains and pores of a label volume: connected regions of its voxels."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import AnyArray, BoolArray, FloatArray, IntArray
from ...errors import InputError
from ...files import Table
from ..label_volumes.label_volume import Labels, LabelVolume
from ..label_volumes.reading import MOST_PHASES
from ..labels.regions import Merging, connected, shared_sides

_WHERE = "Specimen.from_label_volume"
#: Most grains and pieces of pores; the fit takes about 50 000 bytes for each.
MOST_REGIONS = 100_000
#: Pieces of a pore have at most this share of the volume of a mean grain [-].
_PIECE = 0.5
#: Rounds of the division of a pore, in which a piece's voxels are those nearest to its centroid.
_ROUNDS = 10
#: Standard deviation of the smoothing of distances, and side of the cube that has one centre of a
#: grain [voxels]: smaller bumps of a surface make no grain of their own.
_SMOOTHING, _CUBE = 1.0, 5


@dataclass(frozen=True)
class Kinds:
    """Minerals and pores among the labels of a volume.

    Attributes:
        minerals: Index of the mineral of each label that is no pore; None: a single mineral.
        pores: Labels of pores.
        names: Names of the minerals, or none.
    """

    minerals: Mapping[int, int] | None = None
    pores: frozenset[int] = frozenset()
    names: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class VolumeRegions:
    """Regions of a label volume, grains before pieces of pores.

    Attributes:
        regions: Region of each voxel, (z, y, x).
        ids: Label of each region; for a piece of a pore the label of its first voxel.
        minerals: Index of each grain's mineral; None without minerals.
        grains: Number of grains: the first regions.
        counts: Numbers of regions and voxels that were merged, removed or divided, by reason.
    """

    regions: Labels
    ids: IntArray
    minerals: IntArray | None
    grains: int
    counts: Table

    @property
    def count(self) -> int:
        """Number of regions."""
        return len(self.ids)


def find(
    volume: LabelVolume,
    kinds: Kinds,
    least_voxels: int,
    *,
    watershed: bool = False,
) -> VolumeRegions:
    """Find the grains and pores of a volume.

    The voxels of a label that are connected by sides are a region. Regions with fewer voxels than
    `least_voxels` join a neighbour: a grain rather than a pore, of the same mineral, and with the
    largest common surface. Grains that are not connected with the largest part of the rock are
    removed like pores. Pores are divided into pieces that are smaller than grains.

    Args:
        volume: The volume.
        kinds: Minerals and pores among the labels.
        least_voxels: Smallest number of voxels of a region.
        watershed: Divide regions of a label where they are narrow.

    Raises:
        InputError: if less than two grains remain, or there are too many of them.
    """
    if watershed and len(volume.ids) > MOST_PHASES:
        raise InputError(
            f"{_WHERE}: watershed of {len(volume.ids)} labels, must be <= {MOST_PHASES} phases; "
            "leave it out for labels of grains"
        )
    holes = np.isin(volume.ids, [*kinds.pores])
    of_label = np.arange(len(volume.ids))  # without minerals each label is of its own kind
    if kinds.minerals is not None:
        of_label = np.array([kinds.minerals.get(one, -1) for one in volume.ids.tolist()])
    marks = np.where(holes, -1, np.arange(len(holes)))[volume.labels]
    found = _divided(marks, volume) if watershed else connected(marks)
    first = np.unique(found, return_index=True)[1]
    labels = volume.labels.ravel()[first]
    is_hole = holes[labels]
    counts: Table = {"regions": int(np.count_nonzero(~is_hole))}
    merging = Merging(found, is_hole, of_label[labels])
    counts["small_regions"] = merging.merge(least_voxels, holes=False)
    counts["small_pores"] = merging.merge(least_voxels, holes=True)
    found = merging.target[found]
    voxels = np.bincount(found.ravel(), minlength=len(is_hole))
    loose = loose_grains(shared_sides(found)[0], is_hole, voxels)
    counts["loose_grains"] = len(loose)
    is_hole[loose] = True
    counts["pore_voxels"] = int(np.count_nonzero(is_hole[found]))
    rock = np.flatnonzero(~is_hole & np.isin(np.arange(len(is_hole)), found))
    rock = rock[np.argsort(volume.ids[labels[rock]], kind="stable")]
    if not 2 <= len(rock) <= MOST_REGIONS:
        raise InputError(
            f"{_WHERE}: grains = {len(rock)}, must be 2 to {MOST_REGIONS}; choose another part of "
            "the volume, or least_voxels"
        )
    number = np.full(len(is_hole), -1, dtype=np.int32)
    number[rock] = np.arange(len(rock))
    regions = number[found]
    firsts = _divide_pores(regions, len(rock), np.asarray(volume.spacing))
    counts["pore_pieces"] = len(firsts)
    ids = np.concatenate((volume.ids[labels[rock]], volume.ids[volume.labels.ravel()[firsts]]))
    minerals = None if kinds.minerals is None else of_label[labels[rock]].astype(np.int32)
    return VolumeRegions(regions, ids, minerals, len(rock), counts)


def loose_grains(pairs: IntArray, is_pore: BoolArray, sizes: AnyArray) -> IntArray:
    """Return the grains that are not connected with the largest part of the rock.

    Args:
        pairs: Neighbours, rows of two.
        is_pore: Whether a region is a pore.
        sizes: Volume of each region in any unit; 0: there is none.

    Raises:
        InputError: if there is no rock.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    rock = np.flatnonzero(~is_pore & (sizes > 0.0))
    if not len(rock):
        raise InputError(f"{_WHERE}: all labels are pores; choose another phase as hole")
    joined = pairs[~is_pore[pairs].any(axis=1)]
    count = len(is_pore)
    ones = np.ones(len(joined), dtype=np.int8)
    graph = coo_array((ones, (joined[:, 0], joined[:, 1])), shape=(count, count))
    part = connected_components(graph, directed=False)[1]
    largest = int(np.argmax(np.bincount(part[rock], sizes[rock])))
    loose: IntArray = rock[part[rock] != largest]
    return loose


def _divide_pores(regions: Labels, grains: int, spacing: FloatArray) -> IntArray:
    """Number the pieces of pores, voxels of -1, from `grains` on; return the first voxel of each.

    Pieces of one connected pore are nearest to their centroids, which begin at equal distances in
    the order of the voxels.
    """
    from scipy.spatial import cKDTree

    is_pore = regions < 0
    if not is_pore.any():
        return np.zeros(0, dtype=np.int64)
    piece = _PIECE * np.count_nonzero(~is_pore) / grains
    pores = connected(is_pore.astype(np.int8))
    voxels = np.flatnonzero(is_pore)
    owner = pores.ravel()[voxels]
    order = np.argsort(owner, kind="stable")
    voxels = voxels[order]
    starts = np.flatnonzero(np.diff(owner[order], prepend=-1))
    firsts: list[int] = []
    for members in np.split(voxels, starts[1:]):
        places = np.column_stack(np.unravel_index(members, regions.shape)) * spacing[::-1]
        count = max(1, math.ceil(len(members) / piece))
        middles = places[(np.arange(count) * len(members)) // count]
        nearest = np.zeros(len(members), dtype=np.int64)
        for _ in range(_ROUNDS if count > 1 else 0):
            nearest = cKDTree(middles).query(places)[1]
            sizes = np.bincount(nearest, minlength=count)
            sums = [np.bincount(nearest, one, count) for one in places.T]
            there = sizes > 0
            middles[there] = np.column_stack(sums)[there] / sizes[there, None]
        kept, at, own = np.unique(nearest, return_index=True, return_inverse=True)
        regions.ravel()[members] = grains + len(firsts) + own
        firsts += members[at].tolist()
        if grains + len(firsts) > MOST_REGIONS:
            raise InputError(
                f"{_WHERE}: pieces of pores = {len(firsts)} and more, must be <= "
                f"{MOST_REGIONS - grains}; crop the volume to the rock"
            )
    return np.array(firsts, dtype=np.int64)


def _divided(marks: IntArray, volume: LabelVolume) -> IntArray:
    """Return connected regions, those of rock divided where they are narrow."""
    found = np.zeros(marks.shape, dtype=np.int64)
    for mark in np.unique(marks).tolist():
        inside = marks == mark
        found[inside] = 0 if mark < 0 else 1 + _centres(inside, volume.spacing)[inside]
    # numbers of centres differ between labels: a centre is a voxel of its label
    return connected(found)


def _centres(inside: BoolArray, spacing: tuple[float, float, float]) -> IntArray:
    """Return the centre of the grain of each voxel of a phase, as the index of a voxel.

    A centre is the place in a cube of voxels that is farthest from the surface. From any other
    voxel the way goes to the centre of its cube, and on: voxels of one centre are a grain
    (watershed of the distances).
    """
    from scipy.ndimage import distance_transform_edt, gaussian_filter, maximum_filter

    distance = distance_transform_edt(np.pad(inside, 1), sampling=spacing[::-1])
    smooth = gaussian_filter(distance[1:-1, 1:-1, 1:-1], _SMOOTHING)
    # ranks have no ties, and lead back to their voxels
    order = np.argsort(np.where(inside, smooth, -1.0).ravel(), kind="stable")
    ranks = np.empty(order.size, dtype=np.int64)
    ranks[order] = np.arange(order.size)
    nearby = maximum_filter(ranks.reshape(inside.shape), size=_CUBE)
    centres = order[nearby.ravel()]
    while np.any(centres != centres[centres]):
        centres = centres[centres]
    found: IntArray = centres.reshape(inside.shape)
    return found
