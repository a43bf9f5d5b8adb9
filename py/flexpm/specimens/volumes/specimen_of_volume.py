# SPDX-License-Identifier: GPL-3.0-or-later
"""3D specimens of label volumes: one power cell for each grain. SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..._flexpm import weighted_cells
from ...arrays import AnyArray, FloatArray
from ...errors import InputError
from ...files import Table
from ...progress import Progress
from ...require import POSITIVE, Bounds, quoted, require_number, require_one_of, require_whole
from ..checks import require_short_edge
from ..kernel_input import call
from ..label_volumes.label_volume import LabelVolume
from ..label_volumes.reading import read
from ..space.frame import SolidFrame
from ..space.own_cells import OwnCells
from ..space.spec import SHORT_EDGE
from ..space.specimen import SolidSpecimen
from . import regions
from .fit import Grid, fit
from .regions import Kinds
from .volume_report import compare

_WHERE = "Specimen.from_label_volume"
SHAPES = ("box", "cylinder", "solid-disc")
VOLUMES = ("fitted", "exact")
#: Default of the smallest number of voxels of a region.
LEAST_VOXELS = 8
#: Most voxels of a fit.
MOST_VOXELS = 30_000_000
#: Volume over that of a mean grain below which the outline leaves too little of a grain [-].
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
    report = compare(grid, found, fitted, volume.origin)
    frame, corner = _frame(options, sizes, found.grains)
    points, weights = fitted.best.points + corner, fitted.best.weights
    kept = np.arange(found.count)
    cells = call(weighted_cells, points, weights, frame.solid())
    least = 0.0 if options.shape == "box" else _REST * frame.solid().volume / found.grains
    while True:
        there = cells.volumes > least
        if there.all():
            break
        points, weights, kept = points[there], weights[there], kept[there]
        cells = call(weighted_cells, points, weights, frame.solid())
    left = int(np.count_nonzero(kept < found.grains))
    if left < 2:
        remedy = "give another part of the volume"
        if options.diameter is not None:
            remedy = "give a larger diameter"
        raise InputError(
            f"{_WHERE}: grains with a cell in the {options.shape} = {left} of {found.grains}, must "
            f"be >= 2; {remedy}"
        )
    own = OwnCells.of_weighted(cells).with_pores(int(np.count_nonzero(kept >= found.grains)))
    made = SolidSpecimen.of_cells(
        own, options.shape, _named_sizes(options, sizes), options.short_edge
    )
    if found.minerals is not None:
        made = made.with_minerals(found.minerals[kept[kept < found.grains]])
    return replace(made, mineral_names=kinds.names, fit=report)


def volume_of(
    source: LabelVolume | AnyArray | Path | str,
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


def kinds_of(volume: LabelVolume, minerals: Mapping[int, int | None] | None) -> Kinds:
    """Return the minerals and pores among the labels of a volume.

    Args:
        volume: The volume.
        minerals: As for ``Specimen.from_label_volume``.

    Raises:
        InputError: for a label without a mineral, or an index that is none.
    """
    voids = {0} if volume.has_voids else set()
    ids = [one for one in volume.ids.tolist() if one not in voids]
    if minerals is None:
        if volume.phases is None:
            return Kinds(pores=frozenset(voids))
        phases = dict(zip(volume.ids.tolist(), volume.phases.tolist(), strict=True))
        numbers = sorted({phases[label] for label in ids})
        if len(numbers) < 2:
            return Kinds(pores=frozenset(voids))
        names = tuple(volume.phase_names.get(one, f"phase {one}") for one in numbers)
        return Kinds({one: numbers.index(phases[one]) for one in ids}, frozenset(voids), names)
    for label, mineral in minerals.items():
        if mineral is not None:
            where = f"{_WHERE}: minerals[{label}]"
            require_whole(where, mineral, Bounds(at_least=0, at_most=99))
    pores = frozenset(voids | {label for label, one in minerals.items() if one is None})
    if pores.issuperset(minerals):
        return Kinds(pores=pores)
    missing = [label for label in ids if label not in minerals]
    if missing:
        others = f" and of {len(missing) - 1} others" if len(missing) > 1 else ""
        raise InputError(
            f"{_WHERE}: mineral of label {missing[0]}{others} is missing; give its index, or None "
            "for a pore"
        )
    return Kinds({key: one for key, one in minerals.items() if one is not None}, pores)


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
