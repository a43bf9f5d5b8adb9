# SPDX-License-Identifier: GPL-3.0-or-later
"""Which contact of a model has which factor of its strengths, deviation D38."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..materials.material import Material
from . import strengths
from .space.specimen import SolidSpecimen
from .specimen import AnySpecimen


def factors_of(specimen: AnySpecimen, material: Material) -> FloatArray | None:
    """Factor of the strengths of each contact [-], or None if all are 1.

    It is the product of the specimen's factor and the factor that the material draws with the seed
    of the specimen (0 without a seed). Contacts on joints have the specimen's factor only.
    """
    given = None if isinstance(specimen, SolidSpecimen) else specimen.strengths
    if material.weibull is None:
        return given
    drawn = strengths.of_material(material.weibull, specimen.seed or 0, contacts_of(specimen))
    drawn[on_joints(specimen)] = 1.0
    return drawn if given is None else given * drawn


def contacts_of(specimen: AnySpecimen) -> int:
    """Return the number of contacts."""
    if isinstance(specimen, SolidSpecimen):
        return specimen.cells.contacts
    return len(specimen.tessellation.shared_edges)


def on_joints(specimen: AnySpecimen) -> BoolArray:
    """Whether each contact lies on a joint; lines of later excavations are rock until then."""
    if specimen.edge_joints is None:
        return np.zeros(contacts_of(specimen), dtype=bool)
    names = specimen.spec.joint_names or ()
    bearing = [names.index(name) for name in specimen.spec.joints_with_law]
    found: BoolArray = np.isin(specimen.edge_joints, bearing)
    return found
