# SPDX-License-Identifier: GPL-3.0-or-later
"""Quantities that a laboratory measures on a core before its peak. SI units, signs of the record.

Stresses are deviators: axial stress minus the least confining pressure.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray
from .measures import differential_stress, peak_row
from .record import Curve

#: Cracks have begun once this share of those at the peak are there [-].
INITIATION_SHARE = 0.01
#: Crack volumetric strain over the elastic one at which cracks have begun [-].
CRACK_STRAIN_SHARE = 0.02
_NO_LATERAL = "the lateral strain is unknown"
#: Column of the record.
VOLUME = "volumetric_strain"


def volumetric_strain(curve: Curve, *, solid: bool) -> FloatArray:
    """Return the total volumetric strain, positive in contraction [-]; 2D: strain of area."""
    return curve["axial_strain"] - (2.0 if solid else 1.0) * curve["lateral_strain"]


def with_volume(curve: Curve, *, solid: bool) -> Curve:
    """Return the record with its volumetric strain as an additional column; 2D: strain of area."""
    volume = volumetric_strain(curve, solid=solid)
    return Curve.from_array(np.column_stack([curve.array, volume]), (*curve.own, VOLUME))


def elastic_volumetric_strain(
    curve: Curve, modulus: float, ratio: float, *, solid: bool
) -> FloatArray:
    """Return the volumetric strain of the loading of an elastic specimen [-].

    Confining pressures are constant, so only the axial stress strains the specimen. The strain is
    (1 - 2 nu) / E times the stress increase since the strain was 0. In 2D it is (1 - nu) / E, with
    the moduli of plane stress or plane strain.

    Args:
        curve: The record.
        modulus: Young's modulus at the start of the loading [Pa].
        ratio: Poisson's ratio at the start of the loading [-].
        solid: Whether the specimen is 3D.
    """
    stress, strain = curve["axial_stress"], curve["axial_strain"]
    grown = stress - stress[0] + modulus * strain[0] if len(stress) else stress
    return (1.0 - (2.0 if solid else 1.0) * ratio) / modulus * grown


class Thresholds(NamedTuple):
    """Deviators at which cracks begin and take over, by their keys in result.json."""

    stresses: dict[str, float | None]  #: [Pa]
    reasons: dict[str, str]  #: why a stress is missing


def crack_thresholds(
    curve: Curve, modulus: float | None, ratio: float | None, *, solid: bool
) -> Thresholds:
    """Read the thresholds of a compressed core.

    ``crack_initiation_stress``: 1 % of the cracks at the peak exist, at least one crack.
    ``crack_damage_stress``: the volume of the specimen is smallest, and then increases.
    ``crack_initiation_stress_volumetric``: the crack volumetric strain (total minus elastic strain)
    exceeds 2 % of the elastic strain from this row on, until damage or else the peak. A specimen
    that dilates has cracks, so initiation by volume is not above damage. All are the largest
    deviator until their row, because the stress drops within a burst of cracks.

    Args:
        curve: The record.
        modulus: Young's modulus at the start of the loading [Pa].
        ratio: Poisson's ratio at the start of the loading [-].
        solid: Whether the specimen is 3D.
    """
    names = ("crack_initiation_stress", "crack_initiation_stress_volumetric", "crack_damage_stress")
    peak = peak_row(curve)
    if peak is None:
        return Thresholds(dict.fromkeys(names), dict.fromkeys(names, "no peak was passed"))
    before = curve.until(peak + 1)
    deviator = differential_stress(before)
    total = volumetric_strain(before, solid=solid)
    damage = _damage_row(total)
    rows: list[int | str] = [_initiation_row(before)]
    if modulus is None or ratio is None:
        rows.append("elastic constants are unknown")
    else:
        elastic = elastic_volumetric_strain(before, modulus, ratio, solid=solid)
        rows.append(_widening_row(total, elastic, damage if isinstance(damage, int) else None))
    rows.append(damage)
    reached = np.maximum.accumulate(deviator)
    found = {
        name: float(stress[row])
        for name, row, stress in zip(names, rows, (deviator, reached, reached), strict=True)
        if isinstance(row, int)
    }
    reasons = {name: row for name, row in zip(names, rows, strict=True) if isinstance(row, str)}
    return Thresholds({name: found.get(name) for name in names}, reasons)


def _initiation_row(curve: Curve) -> int | str:
    cracks = curve["tensile_cracks"] + curve["shear_cracks"]
    if not cracks[-1] > 0:
        return "no point cracks up to the peak"
    return int(np.argmax(cracks >= max(1, math.ceil(INITIATION_SHARE * cracks[-1]))))


def _damage_row(total: FloatArray) -> int | str:
    if not np.all(np.isfinite(total)):
        return _NO_LATERAL
    row = int(np.argmax(total))
    return row if row + 1 < len(total) else "the specimen shrinks up to the peak"


def _widening_row(total: FloatArray, elastic: FloatArray, damage: int | None) -> int | str:
    """Return the row from which cracks widen the specimen, at most the row of damage."""
    if not np.all(np.isfinite(total + elastic)):
        return _NO_LATERAL
    within = elastic - total <= CRACK_STRAIN_SHARE * np.abs(elastic)
    last = np.flatnonzero(within[:damage])
    row = int(last[-1]) + 1 if len(last) else 0
    return row if row < len(total) else "cracks do not widen the specimen up to the peak"
