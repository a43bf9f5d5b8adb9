# SPDX-License-Identifier: GPL-3.0-or-later
"""3D specimens of label volumes: one power cell for each grain. SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..._flexpm import WeightedCells, weighted_cells
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...files import Table
from ...progress import Progress
from ...require import POSITIVE, Bounds, quoted, require_number, require_one_of, require_whole
from ..checks import require_short_edge
from ..grain_source import traced
from ..kernel_input import call
from ..label_volumes.label_volume import Labels, LabelVolume
from ..label_volumes.reading import read
from ..space.frame import SolidFrame
from ..space.own_cells import OwnCells
from ..space.spec import SHORT_EDGE
from ..space.specimen import SolidSpecimen
from . import regions
from .fit import Trial, edges_of, fit
from .grid import Grid
from .regions import Kinds, loose_grains
from .volume_report import compare

_WHERE = "Specimen.from_label_volume"
#: Shapes that are cut from a volume, and the kinds of specimens that they are.
SHAPES = {"box": "box", "cylinder": "cylinder", "disc": "solid-disc", "solid-disc": "solid-disc"}
VOLUMES = ("fitted", "exact")
#: Default of the smallest number of voxels of a region.
LEAST_VOXELS = 8
#: Most voxels of a fit.
MOST_VOXELS = 30_000_000
#: Ratio of the volume of a cell to that of its grain, or of a mean grain, that is too little [-].
_REST = 0.05


@dataclass(frozen=True)
class VolumeOptions:
    """How a volume becomes a specimen; see ``Specimen.from_label_volume``."""

    least_voxels: int = LEAST_VOXELS
    watershed: bool = False
    shape: str = "box"
    diameter: float | None = None
    volumes: str = "fitted"
    short_edge: float = SHORT_EDGE

    def __post_init__(self) -> None:
        require_whole(f"{_WHERE}: least_voxels", self.least_voxels, Bounds(at_least=1))
        require_one_of(f"{_WHERE}: shape", self.shape, [*SHAPES])
        object.__setattr__(self, "shape", SHAPES[self.shape])
        require_one_of(f"{_WHERE}: volumes", self.volumes, [*VOLUMES])
        require_short_edge(self.short_edge)
        if (self.diameter is None) != (self.shape == "box"):
            rule = "must be left out" if self.shape == "box" else "must be given"
            raise InputError(f"{_WHERE}: diameter = {self.diameter}, {rule} for a {self.shape}")
        if self.diameter is not None:
            require_number(f"{_WHERE}: diameter", self.diameter, POSITIVE, "m")


def specimen_of(
    volume: LabelVolume, kinds: Kinds, options: VolumeOptions, progress: Progress | None = None
) -> SolidSpecimen:
    """Make a specimen of a label volume, see ``Specimen.from_label_volume``.

    Args:
        volume: The volume.
        kinds: Minerals and pores among its labels.
        options: How it becomes a specimen.
        progress: Receives the stages of the fit.

    Raises:
        InputError: as ``Specimen.from_label_volume``.
    """
    if volume.labels.size > MOST_VOXELS:
        raise InputError(
            f"{_WHERE}: voxels = {volume.labels.size}, must be <= {MOST_VOXELS}; give coarsen or "
            "crop"
        )
    sizes = dict(zip("xyz", (np.array(volume.counts) * volume.spacing).tolist(), strict=True))
    _require_inside(options, sizes)
    found = regions.find(volume, kinds, options.least_voxels, watershed=options.watershed)
    grid = Grid(found.regions, np.array(volume.spacing), found.count, found.grains)
    fitted = fit(grid, progress, exact=options.volumes == "exact")
    frame, corner = _frame(options, sizes, found.grains)
    cells, kept, loose = _cut(grid, fitted.best, frame, corner)
    kept_grains = kept[kept < found.grains]
    if len(kept_grains) < 2:
        remedy = "give another part of the volume"
        if options.diameter is not None:
            remedy = "give a larger diameter"
        raise InputError(
            f"{_WHERE}: grains with a cell in the {options.shape} = {len(kept_grains)} of "
            f"{found.grains}, must be >= 2; {remedy}"
        )
    own = OwnCells.of_weighted(cells).with_pores(len(kept) - len(kept_grains))
    made = SolidSpecimen.of_cells(
        own, options.shape, _named_sizes(options, sizes), options.short_edge
    )
    if found.minerals is not None:
        made = made.with_minerals(found.minerals[kept_grains])
    report = compare(grid, found, fitted, volume.origin)
    inside = _voxels_inside(grid, frame, corner)
    size = made.outline().volume
    report = report.of_specimen(made.cells.volumes, size, kept_grains, found, inside, loose)
    made = replace(made, mineral_names=kinds.names, fit=report)
    agreement = fitted.best.agreement
    return traced(
        made,
        volume.source,
        grains=found.grains,
        voxel_size=[*volume.spacing],
        agreement=agreement,
    )


def _cut(
    grid: Grid, best: Trial, frame: SolidFrame, corner: FloatArray
) -> tuple[WeightedCells, IntArray, int]:
    """Cut the cells by the outline.

    Grains of which too little is left give their place to their neighbours: less than 5 % of the
    grain, and in a round outline less than 5 % of a mean grain. Grains that are not connected with
    the largest part of the rock become pores.

    Returns:
        The cells, grains before pores; the region of each cell; the number of loose grains.
    """
    solid = frame.solid()
    points, weights, kept = best.points + corner, best.weights, np.arange(grid.count)
    volumes = grid.voxel * grid.voxels()
    least = _REST * volumes
    if frame.kind != "box":
        least = np.maximum(least, _REST * float(volumes[: grid.grains].mean()))
    cells = call(weighted_cells, points, weights, solid)
    while not (there := cells.volumes > least[kept]).all():
        points, weights, kept = points[there], weights[there], kept[there]
        cells = call(weighted_cells, points, weights, solid)
    pores = kept >= grid.grains
    loose = loose_grains(edges_of(cells), pores, cells.volumes)
    if len(loose):
        pores[loose] = True
        order = np.argsort(pores, kind="stable")
        kept = np.where(pores & (kept < grid.grains), grid.count, kept)[order]
        cells = call(weighted_cells, points[order], weights[order], solid)
    return cells, kept, len(loose)


def _voxels_inside(grid: Grid, frame: SolidFrame, corner: FloatArray) -> Labels:
    """Return the regions of the voxels whose middles are in the outline."""
    if frame.kind == "box":
        return grid.regions.ravel()
    axes = (0, 1) if frame.kind == "cylinder" else (0, 2)
    off = [
        (np.arange(grid.counts[axis]) + 0.5) * grid.spacing[axis] + corner[axis] for axis in axes
    ]
    inside = off[0][None, :] ** 2 + off[1][:, None] ** 2 < (0.5 * frame.sizes[0]) ** 2
    # voxels are (z, y, x): layers along z of a cylinder, along y of a disc
    layers = np.moveaxis(grid.regions, axes[1] - 1, 0)
    return layers[:, inside].ravel()


def volume_of(
    source: LabelVolume | npt.ArrayLike | Path | str,
    voxel: float | tuple[float, float, float] | None,
    reading: Table,
) -> LabelVolume:
    """Return the volume that ``Specimen.from_label_volume`` is given.

    Raises:
        InputError: for a file or an array that is refused, or arguments that are for files only.
    """
    if isinstance(source, Path | str):
        return read(source, voxel=voxel, **reading)
    given = {**reading, **({"voxel": voxel} if isinstance(source, LabelVolume) else {})}
    for name, value in given.items():
        if value is not None:
            raise InputError(f"{_WHERE}: {name} = {quoted(value)}, is for files only; leave it out")
    if isinstance(source, LabelVolume):
        return source
    if voxel is None:
        raise InputError(f"{_WHERE}: voxel = None, must be given for an array; give its size in m")
    return LabelVolume.of(np.asarray(source), voxel)


def _require_inside(options: VolumeOptions, sizes: Mapping[str, float]) -> None:
    if options.diameter is None:
        return
    for axis in ("xy", "xz")[options.shape == "solid-disc"]:
        if options.diameter > (1.0 + 1e-9) * sizes[axis]:
            raise InputError(
                f"{_WHERE}: diameter = {options.diameter:g} m, must be <= {sizes[axis]:g} m, the "
                f"size of the volume along {axis}; give a smaller one"
            )


def _named_sizes(options: VolumeOptions, sizes: Mapping[str, float]) -> dict[str, float]:
    if options.diameter is None:
        return {"width": sizes["x"], "depth": sizes["y"], "height": sizes["z"]}
    if options.shape == "cylinder":
        return {"diameter": options.diameter, "height": sizes["z"]}
    return {"diameter": options.diameter, "depth": sizes["y"]}


def _frame(
    options: VolumeOptions, sizes: Mapping[str, float], grains: int
) -> tuple[SolidFrame, FloatArray]:
    """Return the outline, and the corner of the volume in its coordinates [m]."""
    x, y, z = sizes.values()
    middle = {"box": (0.0, 0.0, 0.0), "cylinder": (x, y, 0.0), "solid-disc": (x, 0.0, z)}
    corner: FloatArray = -0.5 * np.array(middle[options.shape])
    grain = float(np.cbrt(6.0 / np.pi * x * y * z / grains))
    lengths = tuple(_named_sizes(options, sizes).values())
    return SolidFrame(options.shape, lengths, grain), corner
