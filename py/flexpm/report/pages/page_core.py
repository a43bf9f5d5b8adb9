# SPDX-License-Identifier: GPL-3.0-or-later
"""Volumetric strains of a compressed core on the page of a run, and where its cracks begin."""

from __future__ import annotations

import numpy as np

from ...results.result import Result
from ..curves import volumes_of
from ..style import CYCLE
from ..words import words_of_result
from .page import Chart, Line, numbers, rows_to_draw

_POINTS = 700
_PER_CENT = 100.0


def volume_chart(result: Result) -> Chart | None:
    """Total, elastic and crack volumetric strain over the axial strain; None where there is none.

    Points mark the stresses of crack damage and of crack initiation by the volume.
    """
    found = volumes_of(result)
    if found is None:
        return None
    strains = np.column_stack([one.strain for one in found.lines])
    axis = words_of_result(result).x
    along = result.curve[axis.column][: len(strains)]
    kept = [one.mark for one in found.lines if one.mark is not None]
    rows = rows_to_draw(np.column_stack([along, strains]), _POINTS, kept)
    x = numbers(along[rows], axis.factor)
    lines = []
    for one, colour in zip(found.lines, CYCLE, strict=False):
        marks = [] if one.mark is None else [int(np.searchsorted(rows, one.mark))]
        values = numbers(one.strain[rows], _PER_CENT)
        lines.append(Line(one.label, x, values, colour, dashed=one.dashed, marks=marks))
    return Chart("volume", found.title, axis.label, f"{found.name} [%]", lines)
