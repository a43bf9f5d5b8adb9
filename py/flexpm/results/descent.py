# SPDX-License-Identifier: GPL-3.0-or-later
"""Widening and cracking of a compressed specimen up to its peak, and its descent. SI units.

Stresses are deviators: axial stress minus the least confining pressure. Signs are those of the
record.
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import FloatArray
from .core import volumetric_strain
from .measures import PEAK_DROP, differential_stress, peak_row
from .record import Curve

#: Axial strain after the peak over which drop and dilation are measured [-].
WINDOW = 0.005
#: Reason of a missing drop.
ENDS_EARLY = "the test ends soon after the largest deviator, before a tenth of it is lost"


def secant_poissons_ratio(curve: Curve, share: float) -> float | None:
    """Return lateral over axial strain when the stress first reaches a share of its peak [-].

    Args:
        curve: The record of a test without confining pressure.
        share: Share of the peak [-], above 0 and up to 1.

    Returns:
        The ratio, interpolated between two rows; None without a peak or a lateral strain.
    """
    peak = peak_row(curve)
    if peak is None:
        return None
    stress = differential_stress(curve)[: peak + 1]
    wanted = share * float(stress[peak])
    row = int(np.argmax(stress >= wanted))
    axial, lateral = (
        _between(stress, curve[name], row, wanted) for name in ("axial_strain", "lateral_strain")
    )
    return lateral / axial if axial > 0.0 and math.isfinite(lateral) else None


def tensile_share(curve: Curve) -> float | None:
    """Return the share of tensile cracks in all cracks up to the peak [-]; None without cracks."""
    peak = peak_row(curve)
    if peak is None:
        return None
    tensile, shear = (float(curve[name][peak]) for name in ("tensile_cracks", "shear_cracks"))
    return tensile / (tensile + shear) if tensile + shear > 0.0 else None


def drop_after_peak(curve: Curve, window: float = WINDOW) -> float | None:
    """Return the part of the largest deviator that is lost soon after it [-].

    The lowest deviator within the window counts.

    Args:
        curve: The record.
        window: Axial strain after the peak [-].

    Returns:
        The part; None if the record ends within the window before a tenth is lost.
    """
    stress, strain = differential_stress(curve), curve["axial_strain"]
    peak = _largest(stress)
    if peak is None:
        return None
    end = float(strain[peak]) + window
    after = _last_within(strain, peak, end) + 1
    lowest = min(float(np.min(stress[peak:after])), _between(strain, stress, after, end))
    drop = 1.0 - lowest / float(stress[peak])
    return drop if np.max(strain[peak:]) >= end or drop >= PEAK_DROP else None


def dilation_after_peak(curve: Curve, *, solid: bool, window: float = WINDOW) -> float | None:
    """Return D = 1 - dV/de of the window after the largest deviator [-].

    dV is the change of the volumetric strain, positive in contraction (2D: strain of area), and de
    that of the axial strain. D is 1 at constant volume.

    Args:
        curve: The record.
        solid: Whether the specimen is 3D.
        window: Axial strain after the peak [-].

    Returns:
        D; None if the record ends within the window, or the lateral strain is unknown.
    """
    stress, strain = differential_stress(curve), curve["axial_strain"]
    peak = _largest(stress)
    if peak is None or not np.max(strain[peak:]) >= strain[peak] + window:
        return None
    volume = volumetric_strain(curve, solid=solid)
    end = float(strain[peak]) + window
    row = _last_within(strain, peak, end) + 1
    change = _between(strain, volume, row, end) - float(volume[peak])
    return 1.0 - change / window if math.isfinite(change) else None


def dilation_angle(dilation: float) -> float:
    """Return the angle psi [degree] with sin psi = (D - 1) / (D + 1).

    Args:
        dilation: D [-], > 0.
    """
    return math.degrees(math.asin((dilation - 1.0) / (dilation + 1.0)))


def _largest(stress: FloatArray) -> int | None:
    """Row of the largest deviator; None without a positive one."""
    if len(stress) == 0 or not np.all(np.isfinite(stress)) or not np.max(stress) > 0.0:
        return None
    return int(np.argmax(stress))


def _last_within(strain: FloatArray, peak: int, end: float) -> int:
    """Last row before the strain first exceeds its end."""
    beyond = np.flatnonzero(strain[peak:] > end)
    return peak + int(beyond[0]) - 1 if len(beyond) else len(strain) - 1


def _between(along: FloatArray, values: FloatArray, row: int, wanted: float) -> float:
    """Value at a place between a row and the row before it."""
    if row == 0 or row >= len(along):  # none before, or none after it
        return float(values[min(row, len(values) - 1)])
    before, after = float(along[row - 1]), float(along[row])
    part = (wanted - before) / (after - before) if after > before else 1.0
    return float(values[row - 1] + part * (values[row] - values[row - 1]))
