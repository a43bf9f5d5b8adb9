# SPDX-License-Identifier: GPL-3.0-or-later
"""Strength of the weakest contacts of a material whose strengths scatter. SI units."""

from __future__ import annotations

import numpy as np

from .._flexpm import bond_strengths, reference_strength
from ..arrays import FloatArray, IntArray
from ..materials.mixing import pair_materials
from ..models.grains import Model
from ..models.sphere_faces import shared_faces
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import AnySpecimen
from ..specimens.strength_map import factors_of, on_joints


def scattered_strength(built: Model, *, pulled: bool) -> float | None:
    """Return the reference strength that contacts on 1 % of the area do not exceed [Pa], D38.

    Contacts count with their factors, and contacts on joints do not count. None for a material
    without scatter, whose loading rate follows the laws of pairs of minerals.

    Args:
        built: The grains.
        pulled: Whether the reference is the tensile strength; else it is the compressive strength.
    """
    specimen, material = built.specimen, built.material
    factors = factors_of(specimen, material)
    rock = np.flatnonzero(~on_joints(specimen))
    if material.weibull is None or factors is None or not len(rock):
        return None
    laws = [pair.law(built.name) for pair in pair_materials(material, built.name)]
    whole = np.array(
        [
            reference_strength(pulled, law["tensile_strength"], law["cohesion"], law["friction"])
            for law in laws
        ]
    )
    pairs, areas = _contacts(specimen)
    kinds = np.zeros(len(specimen.radii), dtype=int) if built.minerals is None else built.minerals
    first, second = kinds[pairs].T
    strengths = whole[first * round(len(laws) ** 0.5) + second] * factors
    return bond_strengths(strengths[rock], areas[rock], pairs[rock], len(specimen.radii))[0]


def _contacts(specimen: AnySpecimen) -> tuple[IntArray, FloatArray]:
    """Return the grains of each contact, (n, 2), and its area [m2]."""
    if isinstance(specimen, SolidSpecimen):
        faces = shared_faces(specimen)
        return faces.grains.astype(np.int32), faces.areas
    cells = specimen.tessellation
    edges = np.array(cells.shared_edges, dtype=np.int32).reshape(-1, 4)
    ends = np.array(cells.vertices)[edges[:, 2:]]
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    return np.ascontiguousarray(edges[:, :2]), lengths * specimen.thickness
