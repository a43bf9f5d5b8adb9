# SPDX-License-Identifier: GPL-3.0-or-later
"""Solid specimens in YADE's scene, and their elastic constants. SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING

from yade import wrapper

from .._flexpm import solid_constants
from ..errors import InputError, SimulationError
from ..materials.material import Material
from ..require import require_one_of
from ..specimens.kernel_input import call
from ..specimens.space.specimen import SolidSpecimen
from .assembly import grain_material
from .options import SOLID_MODELS

if TYPE_CHECKING:
    from ..results.solids.state import SolidSnapshot


def solver_of(specimen: SolidSpecimen, chosen: Material, model: str) -> wrapper.SolidSolver:
    """The solver of a solid, at rest and without masses.

    Raises:
        InputError: for a model that solids do not have, a material of several minerals, or a value
            of it out of range.
    """
    require_one_of(f"build: model for a {specimen.kind}", model, SOLID_MODELS)
    _require_alike("build: material", chosen)
    solver = wrapper.SolidSolver()
    try:
        solver.assembleSolid(
            specimen.cells,
            specimen.outline(),
            [grain_material(chosen, model)],
            rigid=model == "rigid",
        )
    except (ValueError, RuntimeError) as error:
        raise InputError(f"build: {error}") from error
    return solver


def snapshot_of(solver: wrapper.SolidSolver, source: str) -> SolidSnapshot:
    """The present state of a solid.

    Args:
        solver: Holds the grains.
        source: What the stress of a tetrahedron is: its own or its grain's.
    """
    from ..results.solids.state import SolidSnapshot

    found = solver.snapshot()
    nodes = found.pop("corner_nodes")
    middle = found["reference"][nodes].mean(axis=1)
    return SolidSnapshot(**found, corner_reference=middle, stress_source=source)


def _require_alike(call_name: str, chosen: Material) -> None:
    if chosen.minerals:
        raise InputError(
            f"{call_name} = {chosen.name!r} has minerals, must have one kind of grain for "
            "a solid; give another material"
        )


def elastic_of_solid(specimen: SolidSpecimen, chosen: Material, model: str) -> dict[str, float]:
    """Elastic constants along z by conjugate gradients; see ``flexpm.elastic``.

    Raises:
        InputError: for a model that solids do not have, or a material of several minerals.
        SimulationError: if the forces do not come to balance.
    """
    if model != "flexible":
        raise InputError(f"elastic: model = {model}, must be flexible for a solid")
    _require_alike("elastic: material", chosen)
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
