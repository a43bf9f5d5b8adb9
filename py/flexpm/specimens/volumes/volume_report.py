# SPDX-License-Identifier: GPL-3.0-or-later
"""Comparison of a label volume with the cells that were fitted to it. SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...arrays import BoolArray, FloatArray, IntArray
from ...files import Table
from ..label_volumes.label_volume import Labels
from ..space.own_cells import OwnCells
from .fit import Fitted, edges_of
from .grid import Grid
from .regions import VolumeRegions

#: Agreement below which one convex cell is a poor model of a grain [-].
POOR = 0.8
#: Mean ratio of the surface of a staircase of voxels to the surface that it follows [-].
_STAIRCASE = 1.5


@dataclass(frozen=True, eq=False)
class VolumeReport:
    """Agreement of grains with their cells in the box of the volume.

    Attributes:
        columns: One value for each grain of the volume, by name; see doc/volumes. None: a grain
            that is not in the specimen has no index ``grain``, and a grain without a cell no
            ``centroid_shift``.
        totals: Figures of the whole volume, see doc/volumes.
        regions: Region of each voxel, (z, y, x); regions from ``len(columns["label"])`` on are
            pieces of pores.
        cells: Region whose cell has the middle of each voxel inside, (z, y, x).
        agree: Whether both are the same, or both are in a pore, (z, y, x).
        spacing: Size of a voxel along x, y, z [m].
        origin: Corner of the first voxel in the file [m].
    """

    columns: dict[str, list[Any]]
    totals: Table
    regions: Labels
    cells: Labels
    agree: BoolArray
    spacing: tuple[float, float, float]
    origin: tuple[float, float, float]

    @property
    def poor_grains(self) -> list[int]:
        """Rows of the grains whose agreement is below `POOR`, worst first."""
        agreement = np.array(self.columns["agreement"])
        poor = np.flatnonzero(agreement < POOR)
        order: list[int] = poor[np.argsort(agreement[poor], kind="stable")].tolist()
        return order

    def of_specimen(
        self,
        volumes: FloatArray,
        outline: float,
        kept: IntArray,
        found: VolumeRegions,
        inside: Labels,
        loose: int,
    ) -> VolumeReport:
        """Return the report with figures of the specimen that was cut from the cells.

        Args:
            volumes: Volume of each grain of the specimen [m3].
            outline: Volume of its outline [m3].
            kept: Region of each grain.
            found: Labels, minerals and pores of the regions.
            inside: Regions of the voxels whose middles are in the outline.
            loose: Number of grains that the cut has separated from the rock.
        """
        grain: list[int | None] = [None] * found.grains
        for number, region in enumerate(kept.tolist()):
            grain[region] = number
        voxels = np.bincount(inside, minlength=found.count)
        rock = float(voxels[: found.grains].sum())
        volume = float(volumes.sum())
        totals = self.totals | {
            "specimen_grains": len(kept),
            "loose_grains": self.totals["loose_grains"] + loose,
            "grains_left_out": int(found.grains - len(kept) - loose),
            "pore_fraction": max(1.0 - volume / outline, 0.0),  # 0 but for round-off
            "source_pore_fraction": 1.0 - rock / float(voxels.sum()),
        }
        if found.minerals is not None:
            count = int(found.minerals.max()) + 1
            of_cells = np.bincount(found.minerals[kept], volumes, count) / volume
            source = np.bincount(found.minerals, voxels[: found.grains], count) / rock
            totals |= {
                "mineral_fractions": of_cells.tolist(),
                "source_mineral_fractions": source.tolist(),
            }
        return replace(self, columns={"grain": grain, **self.columns}, totals=totals)


def compare(
    grid: Grid, found: VolumeRegions, fitted: Fitted, origin: tuple[float, float, float]
) -> VolumeReport:
    """Compare regions with their cells.

    Args:
        grid: The regions.
        found: Labels, minerals and pores of the regions.
        fitted: Their cells.
        origin: Corner of the first voxel in the file [m].
    """
    voxels, cells = grid.voxels(), fitted.best.cells
    volumes = voxels * grid.voxel
    places = grid.centroids() + np.array(origin)
    shift = np.sqrt(np.sum((cells.centroids - grid.centroids()) ** 2, axis=1))
    of_voxels, of_cells = grid.neighbours(), edges_of(cells).astype(np.int64)
    keys, others = (pairs @ [grid.count, 1] for pairs in (of_voxels, of_cells))
    lost = of_voxels[~np.isin(keys, others)]
    invented = of_cells[~np.isin(others, keys)]
    columns = {
        "label": found.ids,
        **{axis: places[:, k] for k, axis in enumerate("xyz")},
        "voxels": voxels,
        "volume": cells.volumes,
        "agreement": fitted.best.own,
        "start_agreement": fitted.start.own,
        "centroid_shift": shift,
        "neighbours": _counts(of_voxels, grid.count),
        "neighbours_lost": _counts(lost, grid.count),
        "neighbours_invented": _counts(invented, grid.count),
    }
    rock = slice(found.grains)
    errors = cells.volumes[rock] / volumes[rock] - 1.0
    rms = float(np.sqrt(np.mean(errors**2)))
    both = len(of_voxels) - len(lost)
    between, of_one_label, all_sides = _source_areas(grid, found)
    totals: Table = {
        "voxels": list(grid.counts),
        "voxel_size": grid.spacing.tolist(),
        "grains": found.grains,
        **found.counts,
        "start_agreement": fitted.start.agreement,
        "agreement": fitted.best.agreement,
        "stage": fitted.best.stage,
        "grains_below_start": int(np.count_nonzero(fitted.best.own[rock] < fitted.start.own[rock])),
        "volume_error_rms": rms,
        "neighbours_f1": 2.0 * both / (len(of_voxels) + len(of_cells)),
        "boundary_area": _boundary_area(fitted, found.grains),
        "source_boundary_area": between / _STAIRCASE,
        "divided_share": of_one_label / all_sides if all_sides else 0.0,
        "lost_grains": np.flatnonzero(cells.volumes[rock] <= 0.0).tolist(),
    }
    kept = {name: np.asarray(values)[rock].tolist() for name, values in columns.items()}
    for lost in np.flatnonzero(cells.volumes[rock] <= 0.0).tolist():
        kept["centroid_shift"][lost] = None  # no cell
    agree, spacing = grid.agrees(fitted.best.found), tuple(grid.spacing.tolist())
    made = VolumeReport(kept, totals, grid.regions, fitted.best.found, agree, spacing, origin)
    totals["poor_grains"] = made.poor_grains
    return made


def _counts(pairs: IntArray, count: int) -> IntArray:
    found: IntArray = np.bincount(pairs.ravel(), minlength=count)
    return found


def _boundary_area(fitted: Fitted, grains: int) -> float:
    """Area of the faces between grains [m2]."""
    own = OwnCells.of_weighted(fitted.best.cells)
    between = (own.pairs[:, 1] >= 0) & (own.pairs < grains).all(axis=1)
    return float(np.sqrt(np.sum(own.areas()[between] ** 2, axis=1)).sum())


def _source_areas(grid: Grid, found: VolumeRegions) -> tuple[float, float, float]:
    """Areas of the sides of voxels [m2]: between grains, between grains of a label, of all grains.

    The last one has the walls of pores, too.
    """
    between = of_one_label = of_all = 0.0
    for axis, (one, other) in zip((2, 1, 0), grid.sides(), strict=True):
        side = grid.voxel / float(grid.spacing[axis])
        met = (one != other) & ((one < found.grains) | (other < found.grains))
        pairs = np.column_stack((one[met], other[met]))
        grains = pairs[(pairs < found.grains).all(axis=1)]
        alike = found.ids[grains[:, 0]] == found.ids[grains[:, 1]]
        of_all += side * len(pairs)
        between += side * len(grains)
        of_one_label += side * float(np.count_nonzero(alike))
    return between, of_one_label, of_all
