# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of tests between parts, from their record. SI units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .words import Columns

#: The end of a way over which what is left of a strength is taken [-].
_REST = 0.1


def work(record: Columns) -> float:
    """Return the work of the load over the displacement [J]."""
    load, way = record["load"], record["displacement"]
    means = 0.5 * (load[1:] + load[:-1])
    return float(means @ (way[1:] - way[:-1]))


def residual(record: Columns) -> float | None:
    """Return the residual strength [Pa]: mean stress over the last tenth of the displacement.

    None for a record without rows or with a number that is not finite.
    """
    way, stress = record["displacement"], record["axial_stress"]
    if not (len(way) and math.isfinite(stress[-1])):
        return None
    return float(stress[way >= (1.0 - _REST) * way[-1]].mean())
