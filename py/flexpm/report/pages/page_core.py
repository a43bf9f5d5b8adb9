# SPDX-License-Identifier: GPL-3.0-or-later
"""Volumetric strains of a compressed core on the page of a run, and where its cracks begin."""

from __future__ import annotations

import numpy as np

from ...kinds.registry import kind_of
from ...results import core, measures
from ...results.result import Result
from ..style import CYCLE
from ..words import words_of_result
from .page import Chart, Line, numbers, rows_to_draw

_POINTS = 700
_PER_CENT = 100.0


def volume_chart(result: Result) -> Chart | None:
    """Total, elastic and crack volumetric strain over the axial strain; None where there is none.

    Points mark the stresses of crack damage and of crack initiation by the volume.
    """
    record, solid = result.curve, result.tetrahedra is not None
    modulus, ratio = result.youngs_modulus, result.poissons_ratio
    peak = measures.peak_row(record) if len(record) else None
    if not kind_of(result.test).is_core or peak is None or modulus is None or ratio is None:
        return None
    total = core.volumetric_strain(record, solid=solid)
    elastic = core.elastic_volumetric_strain(record, modulus, ratio, solid=solid)
    if not np.all(np.isfinite(total[: peak + 1])):
        return None
    deviator = measures.differential_stress(record)[: peak + 1]
    stresses = (result.crack_damage_stress, result.crack_initiation_stress_volumetric)
    found = [None if s is None else int(np.argmin(np.abs(deviator - s))) for s in stresses]
    strains = np.column_stack([total, elastic, total - elastic])[: peak + 1]
    axis = words_of_result(result).x
    along = record[axis.column][: peak + 1]
    kept = [row for row in found if row is not None]
    rows = rows_to_draw(np.column_stack([along, strains]), _POINTS, kept)
    x = numbers(along[rows], axis.factor)

    def line(label: str, column: int, mark: int | None = None, *, dashed: bool = False) -> Line:
        marks = [] if mark is None else [int(np.searchsorted(rows, mark))]
        values = numbers(strains[rows, column], _PER_CENT)
        return Line(label, x, values, CYCLE[column], dashed=dashed, marks=marks)

    lines = [
        line("total, at its largest: crack damage", 0, found[0]),
        line("of elasticity", 1, dashed=True),
        line("of cracks, at its point: crack initiation", 2, found[1]),
    ]
    name = "volumetric strain" if solid else "strain of area"
    return Chart("volume", f"{name.capitalize()} up to the peak", axis.label, f"{name} [%]", lines)
