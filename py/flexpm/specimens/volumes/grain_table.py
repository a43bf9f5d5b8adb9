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

from ..._flexpm import weighted_cells, weights_of_volumes
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...files import load_csv
from ...progress import Progress
from ...require import LENGTH, quoted, require_number, require_one_of
from ..checks import require_short_edge
from ..kernel_input import call
from ..label_volumes.reading import UNITS
from ..space.frame import SolidFrame
from ..space.own_cells import OwnCells
from ..space.specimen import SolidSpecimen

_WHERE = "Specimen.from_grain_table"
_COLUMNS = ("id", "x", "y", "z", "volume")
_PHASE = "phase"
#: Relative difference of the volumes of all grains and of the box that is scaled away [-].
_UNFILLED = 0.02
#: Relative error of the volumes [-].
_EXACT = 1e-7
#: Steps of the points towards the given centroids. The error falls by about a half in each.
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
    """Read a CSV file with the columns id, x, y, z, volume and, optionally, phase.

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
    metres = UNITS[unit]
    phases = tuple(columns.get(_PHASE, ()))
    return GrainTable(ids, metres * values[:3].T.copy(), metres**3 * values[3], phases)


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
            f"{_WHERE}: volume of all grains = {total:g} m3, must be that of the box, "
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
    points, weights = given.centroids.copy(), np.zeros(len(volumes))
    best: tuple[float, FloatArray, FloatArray] | None = None
    for step in range(_STEPS + 1):
        if progress is not None:
            progress(step, _STEPS, f"cells of {len(volumes)} grains")
        weights = call(weights_of_volumes, points, weights, solid, volumes, _EXACT)
        off = given.centroids - weighted_cells(points, weights, solid).centroids
        error = float(np.sqrt(np.mean(off**2)))
        if best is not None and error > best[0]:
            break
        best = error, points, weights
        points = points + off
    assert best is not None
    error, points, weights = best
    own = OwnCells.of_weighted(weighted_cells(points, weights, solid))
    made = SolidSpecimen.of_cells(own, "box", sizes, short_edge)
    names = tuple(dict.fromkeys(given.phases))
    if len(names) > 1:
        numbers: IntArray = np.array([names.index(one) for one in given.phases], dtype=np.int32)
        made = replace(made.with_minerals(numbers), mineral_names=names)
    return made
