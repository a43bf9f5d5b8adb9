# SPDX-License-Identifier: GPL-3.0-or-later
"""Young's modulus of a rock for grains of another size, by a formula. SI units.

Grains and contacts are in series, 1/E = 1/E_grain + k / (K_n d): the smaller the grains, the more
contacts there are along a length. k belongs to an isotropic packing whose grains follow the mean
strain. eta is the ratio of shear stiffness to normal stiffness:

    2D: k = (3 + eta) / (2 (1 + eta)),  3D: k = (4 + eta) / (2 + 3 eta).
"""

from __future__ import annotations

from collections.abc import Mapping

from ..files import Table
from .keys import elastic_set_name


def modulus_ratio(
    material: Table, model: str, mean_diameter: float, before: float, *, solid: bool
) -> float:
    """Return the ratio of Young's modulus at a mean diameter to that at the diameter before [-].

    Inner particles whose contacts are fitted to the modulus of the rock keep it.

    Args:
        material: Parameters in effect for the model, as result.json has them.
        model: Name of the model.
        mean_diameter: Mean diameter of the grains [m].
        before: Mean diameter with which it is compared [m].
        solid: Whether the specimen is 3D.
    """
    if elastic_set_name(model) == "inner" and material.get("young") is not None:
        return 1.0
    kinds = material.get("minerals") or [{**material, "fraction": 1.0}]
    of_grains, of_contacts = 0.0, 0.0
    for kind in kinds:
        grain = 1.0 / kind["young"] if model == "flexible" else 0.0
        of_grains += kind["fraction"] * grain
        of_contacts += kind["fraction"] * _compliance(kind, solid=solid)
    return float((of_grains + of_contacts / before) / (of_grains + of_contacts / mean_diameter))


def _compliance(law: Mapping[str, float], *, solid: bool) -> float:
    """Return the compliance of contacts times the mean diameter [m/Pa]."""
    ratio = law["shear_ratio"]
    factor = (4.0 + ratio) / (2.0 + 3.0 * ratio) if solid else (1.5 + 0.5 * ratio) / (1.0 + ratio)
    return factor / law["normal_stiffness"]
