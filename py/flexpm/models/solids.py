# SPDX-License-Identifier: GPL-3.0-or-later
"""Elastic constants of solid specimens, the one thing that is solved of them so far. SI units."""

from __future__ import annotations

from .._flexpm import solid_constants
from ..errors import InputError, SimulationError
from ..materials.material import Material
from ..specimens.kernel_input import call
from ..specimens.space.specimen import SolidSpecimen


def elastic_of_solid(specimen: SolidSpecimen, chosen: Material, model: str) -> dict[str, float]:
    """Elastic constants along z by conjugate gradients; see ``flexpm.elastic``.

    Raises:
        InputError: for a model that solids do not have, or a material of several minerals.
        SimulationError: if the forces do not come to balance.
    """
    if model != "flexible":
        raise InputError(f"elastic: model = {model}, must be flexible for a solid")
    if chosen.minerals:
        raise InputError(
            f"elastic: material = {chosen.name!r} has minerals, must have one kind of grain for a "
            "solid; give another material"
        )
    law = chosen.law(model)
    assert law["young"] is not None and law["poisson"] is not None
    try:
        modulus, ratio, iterations, _ = call(
            solid_constants,
            specimen.cells,
            specimen.outline(),
            law["young"],
            law["poisson"],
            law["normal_stiffness"],
            law["shear_ratio"],
        )
    except RuntimeError as error:
        raise SimulationError(str(error)) from None
    meshes = specimen.meshes()
    return {
        "youngs_modulus": modulus,
        "poissons_ratio": ratio,
        "grains": specimen.cells.cells,
        "contacts": specimen.cells.contacts,
        "nodes": len(meshes.node_vertices),
        "tetrahedra": len(meshes.elements),
        "iterations": iterations,
    }
