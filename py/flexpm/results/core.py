# SPDX-License-Identifier: GPL-3.0-or-later
"""What a laboratory reads off a compressed core before its peak. SI units, signs as in the record.

Stresses are deviators: axial stress above the least lateral pressure.
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import FloatArray
from .measures import differential_stress, peak_row
from .record import Curve

#: Cracks have begun once this share of those at the peak are there [-].
INITIATION_SHARE = 0.01
#: Crack volumetric strain over the elastic one at which cracks have begun [-].
CRACK_STRAIN_SHARE = 0.02
#: Column of the record.
VOLUME = "volumetric_strain"


def volumetric_strain(curve: Curve, *, solid: bool) -> FloatArray:
    """Total volumetric strain, positive as the specimen shrinks [-]; of the plane that of area."""
    return curve["axial_strain"] - (2.0 if solid else 1.0) * curve["lateral_strain"]


def with_volume(curve: Curve, *, solid: bool) -> Curve:
    """The record with its volumetric strain as a column of its own; of the plane that of area."""
    volume = volumetric_strain(curve, solid=solid)
    return Curve.from_array(np.column_stack([curve.array, volume]), (*curve.own, VOLUME))


def elastic_volumetric_strain(
    curve: Curve, modulus: float, ratio: float, *, solid: bool
) -> FloatArray:
    """Volumetric strain of the loading, were the specimen elastic [-].

    Lateral pressures stay, so that the axial stress alone strains it: (1 - 2 nu) / E times its
    growth since the strain was 0; in the plane (1 - nu) / E, with the moduli of its own state,
    plane stress or plane strain.

    Args:
        curve: The record.
        modulus: Young's modulus as the loading starts [Pa].
        ratio: Poisson's ratio as the loading starts [-].
        solid: The specimen is one of space.
    """
    stress, strain = curve["axial_stress"], curve["axial_strain"]
    grown = stress - stress[0] + modulus * strain[0] if len(stress) else stress
    return (1.0 - (2.0 if solid else 1.0) * ratio) / modulus * grown


def crack_initiation_stress(curve: Curve) -> float | None:
    """Deviator at which 1 % of the cracks at the peak are there [Pa]; None without peak or crack.

    At least one crack counts.
    """
    peak = peak_row(curve)
    if peak is None:
        return None
    cracks = (curve["tensile_cracks"] + curve["shear_cracks"])[: peak + 1]
    if not cracks[-1] > 0:
        return None
    row = int(np.argmax(cracks >= max(1, math.ceil(INITIATION_SHARE * cracks[-1]))))
    return float(differential_stress(curve)[row])


def crack_initiation_stress_volumetric(
    curve: Curve, modulus: float | None, ratio: float | None, *, solid: bool
) -> float | None:
    """Deviator from which on cracks widen the specimen by 2 % of its elastic strain [Pa].

    Crack volumetric strain is the total less the elastic one. It is read where it passes that share
    for the last time before the peak. None without a peak, moduli or a lateral strain, and where it
    does not pass.
    """
    peak = peak_row(curve)
    if peak is None or modulus is None or ratio is None:
        return None
    total = volumetric_strain(curve, solid=solid)[: peak + 1]
    elastic = elastic_volumetric_strain(curve, modulus, ratio, solid=solid)[: peak + 1]
    if not np.all(np.isfinite(total + elastic)):
        return None
    within = np.flatnonzero(elastic - total <= CRACK_STRAIN_SHARE * np.abs(elastic))
    row = int(within[-1]) + 1 if len(within) else 0
    return float(differential_stress(curve)[row]) if row <= peak else None


def crack_damage_stress(curve: Curve, *, solid: bool) -> float | None:
    """Deviator at which the specimen is smallest, from where on it dilates [Pa].

    None without a peak or a lateral strain, and where it shrinks up to the peak.
    """
    peak = peak_row(curve)
    if peak is None:
        return None
    total = volumetric_strain(curve, solid=solid)[: peak + 1]
    if not np.all(np.isfinite(total)):
        return None
    row = int(np.argmax(total))
    return float(differential_stress(curve)[row]) if row < peak else None
