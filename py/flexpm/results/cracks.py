# SPDX-License-Identifier: GPL-3.0-or-later
"""Cracks: contact points that have lost their bond, and their table. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..files import csv_text
from .record import Curve
from .snapshot import Snapshot

TENSILE, SHEAR = 1, 2
#: Name of each mode.
MODES = {TENSILE: "tensile", SHEAR: "shear"}


class Crack(NamedTuple):
    """One contact point that has lost its bond."""

    step: int
    strain: float  #: axial strain when it broke [-]
    x: float  #: position when it broke [m]
    y: float  #: [m]
    mode: int  #: TENSILE if the point was opening, else SHEAR
    contact: int  #: number of the contact, as in each snapshot
    point: int  #: index of the point in its contact


def cracks_csv(cracks: Sequence[Crack]) -> str:
    """Cracks as CSV text in the order given; numbers read back unchanged."""
    rows = (
        (int(crack.step), *map(float, crack[1:4]), MODES[crack.mode], crack.contact, crack.point)
        for crack in cracks
    )
    return csv_text(Crack._fields, rows)


def cracks_from_snapshot(snapshot: Snapshot, curve: Curve) -> list[Crack]:
    """Cracks of a snapshot in the order of their steps; strains are interpolated in `curve`."""
    steps = snapshot.crack_step
    rows, points = np.nonzero(steps >= 0)
    order = np.lexsort((points, snapshot.contact[rows], steps[rows, points]))
    rows, points = rows[order], points[order]
    steps = steps[rows, points]
    strains = (
        np.interp(steps, curve["step"], curve["axial_strain"])
        if len(curve)
        else np.full(len(steps), np.nan)
    )
    modes = snapshot.crack_mode[rows, points]
    places = snapshot.crack_position[rows, points]
    contacts = snapshot.contact[rows]
    return [
        Crack(int(step), float(strain), float(x), float(y), int(mode), int(contact), int(point))
        for step, strain, (x, y), mode, contact, point in zip(
            steps, strains, places, modes, contacts, points, strict=True
        )
    ]
