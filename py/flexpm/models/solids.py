# SPDX-License-Identifier: GPL-3.0-or-later
"""Solid specimens in YADE's scene, and their elastic constants. SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from yade import wrapper

from .._flexpm import solid_constants
from ..arrays import IntArray
from ..errors import InputError, SimulationError
from ..files import Table
from ..materials.material import Material
from ..materials.mixing import description, mineral_materials, pair_materials
from ..specimens import mineral_map
from ..specimens.kernel_input import call
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.strength_map import factors_of
from .assembly import grain_material, joints_of
from .options import SOLID_MODELS, require_model

#: What the elastic solve takes of the law of each pair of minerals, in this order.
_ELASTIC = ("young", "poisson", "normal_stiffness", "shear_ratio")

if TYPE_CHECKING:
    from ..results.solids.state import SolidSnapshot


def solver_of(specimen: SolidSpecimen, chosen: Material, model: str) -> wrapper.GrainSolver:
    """The solver of a solid, at rest and without masses.

    Raises:
        InputError: for a model that solids do not have, minerals that do not go together, or a
            value out of range.
    """
    require_model(f"build: model for a {specimen.kind}", model, SOLID_MODELS, solid=True)
    minerals = _minerals(specimen, chosen, model)
    pairs = [] if minerals is None else pair_materials(chosen, model)
    factors = factors_of(specimen, chosen)
    materials, joints = joints_of(specimen, chosen, model)
    solver: wrapper.GrainSolver = wrapper.SolidSolver()
    try:
        solver.assembleSolid(
            specimen.cells,
            specimen.outline(),
            [grain_material(kind, model) for kind in mineral_materials(chosen)],
            [grain_material(pair, model) for pair in pairs],
            [] if minerals is None else minerals.tolist(),
            rigid=model == "rigid",
            strengths=[] if factors is None else factors.tolist(),
            joints=materials,
            contact_joints=[] if joints is None else joints.tolist(),
        )
    except (ValueError, RuntimeError) as error:
        raise InputError(f"build: {error}") from error
    return solver


def snapshot_of(found: Table, others: Table) -> SolidSnapshot:
    """A state of a solid.

    Args:
        found: Its arrays, as `GrainSolver.snapshot` gives them.
        others: Other data of the state: minerals, source of stresses, joints.
    """
    from ..results.solids.state import SolidSnapshot

    nodes = found.pop("corner_nodes")
    middle = found["reference"][nodes].mean(axis=1)
    return SolidSnapshot(**found, corner_reference=middle, **others)


def _minerals(specimen: SolidSpecimen, chosen: Material, model: str) -> IntArray | None:
    description(chosen, model)  # refuses minerals that do not go together
    return mineral_map.minerals_of(specimen, chosen)


def _elastic_of_state(specimen: SolidSpecimen, chosen: Material, model: str) -> dict[str, float]:
    try:
        modulus, ratio = solver_of(specimen, chosen, model).elasticConstants()
    except RuntimeError as error:
        raise SimulationError(str(error)) from None
    return {
        "youngs_modulus": modulus,
        "poissons_ratio": ratio,
        "grains": specimen.cells.cells,
        "contacts": specimen.cells.contacts,
    }


def elastic_of_solid(specimen: SolidSpecimen, chosen: Material, model: str) -> dict[str, float]:
    """Elastic constants along z by conjugate gradients; see ``flexpm.elastic``.

    Rigid grains are bonded to plates; their strains are measured as in a test.

    Raises:
        InputError: for a model that is not available in 3D, or incompatible minerals.
        SimulationError: if the forces do not reach equilibrium.
    """
    require_model(f"elastic: model for a {specimen.kind}", model, SOLID_MODELS, solid=True)
    if "height" not in specimen.dimensions:
        raise InputError(
            f"elastic: specimen = {specimen.kind}, must be a box or a cylinder; use one of these "
            "shapes"
        )
    if model == "rigid" or specimen.planes:
        return _elastic_of_state(specimen, chosen, model)
    minerals = _minerals(specimen, chosen, model)
    pairs = [chosen] if minerals is None else pair_materials(chosen, model)
    # a pair's element constants are those of its first mineral
    laws = np.array([[{**pair.law(model)}[key] for key in _ELASTIC] for pair in pairs], dtype=float)
    try:
        modulus, ratio, iterations, _ = call(
            solid_constants,
            specimen.cells,
            specimen.outline(),
            laws,
            np.zeros(0, dtype=np.int32) if minerals is None else minerals,
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
