# SPDX-License-Identifier: GPL-3.0-or-later
"""3D specimens of tables of grains: a Laguerre tessellation with given volumes. SI units.

Source: D. P. Bourne, M. Pearce, S. M. Roper, "Inverting Laguerre tessellations: recovering
tessellations from the volumes and centroids of their cells using optimal transport", 2024. The sum
over the grains of volume times point times centroid, minus the cost of the transport, is a concave
function of the points. Its gradient is the volume times the difference of given and found centroid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..._flexpm import Solid, weighted_cells, weights_of_volumes
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...files import load_csv
from ...progress import Progress
from ...require import LENGTH, quoted, require_name, require_number, require_one_of
from ..checks import require_short_edge
from ..kernel_input import call
from ..label_volumes.reading import UNITS
from ..labels.picture import HOLE_NAME
from ..space.frame import SolidFrame
from ..space.own_cells import OwnCells
from ..space.specimen import SolidSpecimen

_WHERE = "Specimen.from_grain_table"
_COLUMNS = ("id", "x", "y", "z", "volume")
_PHASE, _MINERAL = "phase", "mineral"
#: Relative difference of the volumes of all grains and of the box that is scaled away [-].
_UNFILLED = 0.02
#: Relative error of the volumes [-].
_EXACT = 1e-7
#: Steps of the points towards the given centroids; one that hides a point is halved.
_STEPS = 12


@dataclass(frozen=True, eq=False)
class GrainTable:
    """Grains of a table.

    Attributes:
        ids: ID of each grain.
        centroids: Rows x, y, z [m].
        volumes: Volume of each grain [m3].
        phases: Name of each grain's phase; empty without phases.
    """

    ids: list[str]
    centroids: FloatArray
    volumes: FloatArray
    phases: tuple[str, ...] = ()


def read(path: Path, unit: str) -> GrainTable:
    """Read a CSV file with the columns id, x, y, z, volume and, optionally, phase or mineral.

    Args:
        path: The file. Other columns are left out.
        unit: Unit of the lengths, see `UNITS`; volumes have its cube.

    Raises:
        InputError: for a missing column, a value that is no number, a volume <= 0 or an ID twice.
    """
    require_one_of(f"{_WHERE}: unit", unit, [*UNITS])
    names, rows = load_csv(path, "table")
    for name in _COLUMNS:
        if name not in names:
            raise InputError(
                f"table = {quoted(str(path))}, must have a column {name}; its columns are "
                f"{', '.join(names)}"
            )
    columns = dict(zip(names, zip(*rows, strict=True), strict=True)) if rows else {}
    if len(rows) < 2:
        raise InputError(f"table = {quoted(str(path))}, must have 2 grains or more; add rows")
    values = np.empty((4, len(rows)))
    for line, row in enumerate(rows, start=2):
        for place, name in enumerate(_COLUMNS[1:]):
            text = row[names.index(name)]
            try:
                value = float(text)
            except ValueError:
                value = math.nan
            if not math.isfinite(value) or (name == "volume" and value <= 0.0):
                rule = "a number above 0" if name == "volume" else "a number"
                raise InputError(
                    f"table line {line}: {name} = {quoted(text)}, must be {rule}; correct it"
                )
            values[place, line - 2] = value
    ids = list(columns["id"])
    if len({*ids}) < len(ids):
        twice = next(one for number, one in enumerate(ids) if one in ids[:number])
        raise InputError(f"table id = {quoted(twice)}, must be in one row; remove the other row")
    _, first, counts = np.unique(values[:3], axis=1, return_index=True, return_counts=True)
    if (counts > 1).any():
        raise InputError(
            f"table id = {quoted(ids[first[np.argmax(counts > 1)]])}, has the centroid of another "
            "grain; move one of them"
        )
    metres = UNITS[unit]
    phases = tuple(
        require_name(f"table id {one}: {_PHASE}", phase)
        for one, phase in zip(ids, columns.get(_PHASE, columns.get(_MINERAL, ())), strict=False)
    )
    if HOLE_NAME in phases:
        raise InputError(
            f"table id = {quoted(ids[phases.index(HOLE_NAME)])}: {_PHASE} = {HOLE_NAME}, must be a "
            "mineral; leave the row out, since a table cannot contain pores"
        )
    return GrainTable(ids, metres * values[:3].T.copy(), metres**3 * values[3], phases)


def _weights(
    points: FloatArray, start: FloatArray, solid: Solid, volumes: FloatArray
) -> FloatArray:
    """Return the weights of the volumes, from weights that hide no point, else from none."""
    if (weighted_cells(points, start, solid).volumes <= 0.0).any():
        start = np.zeros(len(start))
    return call(weights_of_volumes, points, start, solid, volumes, _EXACT)


def centroid_error(made: SolidSpecimen, given: GrainTable) -> float:
    """Root mean square distance of the cells' centroids from those of the table [m]."""
    off = made.centres - given.centroids
    return float(np.sqrt(np.mean(np.sum(off**2, axis=1))))


def specimen_of(
    given: GrainTable,
    sizes: dict[str, float],
    short_edge: float,
    progress: Progress | None = None,
) -> SolidSpecimen:
    """Make a box of grains, see ``Specimen.from_grain_table``.

    Args:
        given: The grains.
        sizes: Width, depth and height [m].
        short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-].
        progress: Receives the steps.

    Raises:
        InputError: as ``Specimen.from_grain_table``.
    """
    for name, size in sizes.items():
        require_number(f"{_WHERE}: {name}", size, LENGTH, "m")
    require_short_edge(short_edge)
    solid = SolidFrame("box", tuple(sizes.values()), 1.0).solid()
    total = float(given.volumes.sum())
    if abs(total - solid.volume) > _UNFILLED * solid.volume:
        raise InputError(
            f"{_WHERE}: volume of all grains = {total:g} m3, must be the volume of the box, "
            f"{solid.volume:g} m3, within {100 * _UNFILLED:g} %; correct the sizes or the unit"
        )
    outside = ((given.centroids < 0.0) | (given.centroids > [*sizes.values()])).any(axis=1)
    if outside.any():
        place = ", ".join(f"{one:g}" for one in given.centroids[outside][0])
        raise InputError(
            f"{_WHERE}: centroid of grain {given.ids[int(np.argmax(outside))]} = {place} m, must "
            "be inside the box, which has a corner at the origin; move the grains"
        )
    volumes = given.volumes * (solid.volume / total)
    points = given.centroids
    weights = _weights(points, np.zeros(len(volumes)), solid, volumes)
    off = points - weighted_cells(points, weights, solid).centroids
    part = 1.0
    for step in range(_STEPS):
        if progress is not None:
            progress(step, _STEPS, f"cells of {len(volumes)} grains")
        trial = points + part * off
        try:
            new = _weights(trial, weights, solid, volumes)
        except (InputError, RuntimeError):  # a point is hidden
            part *= 0.5
            continue
        new_off = given.centroids - weighted_cells(trial, new, solid).centroids
        if np.sum(new_off**2) >= np.sum(off**2):
            part *= 0.5
            continue
        points, weights, off = trial, new, new_off
    own = OwnCells.of_weighted(weighted_cells(points, weights, solid))
    made = SolidSpecimen.of_cells(own, "box", sizes, short_edge)
    names = tuple(dict.fromkeys(given.phases))
    if names:
        numbers: IntArray = np.array([names.index(one) for one in given.phases], dtype=np.int32)
        made = replace(made.with_minerals(numbers), mineral_names=names)
    return made
