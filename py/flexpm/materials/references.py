# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured properties of the rocks that presets stand for, paper Table 3. SI units, degrees."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Reference:
    """Properties of a rock from laboratory tests; strengths are magnitudes."""

    name: str
    youngs_modulus: float  #: [Pa]
    poissons_ratio: float  #: [-]
    compressive_strength: float  #: uniaxial [Pa]
    brazilian_strength: float  #: 2P / (pi D t) [Pa]
    cohesion: float  #: c [Pa]
    friction_angle: float  #: phi [degree]


_AUGIG = Reference("Augig granite", 25.8e9, 0.23, 122.1e6, 8.8e6, 21.0e6, 53.0)
#: By the first part of the names of the presets, in 2D and in 3D.
_ROCKS = {"augig": _AUGIG, "augig3d": _AUGIG}


def reference_of(material: str) -> Reference | None:
    """Properties of the rock that a material is named after, or None."""
    return _ROCKS.get(material.partition("-")[0])
