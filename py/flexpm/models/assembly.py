# SPDX-License-Identifier: GPL-3.0-or-later
"""Input of the solver of a model: cells, their bonds, and the laws of their contacts.

A solver that has been assembled needs no scene: elastic constants come from it at once. SI units.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from yade import wrapper

from .._flexpm import AssemblyInput, InnerCells, Tessellation
from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..files import Table
from ..materials.joint import require_joints
from ..materials.material import Material
from ..materials.mixing import description, mineral_materials, pair_materials
from ..require import require_one_of
from ..specimens import inner_particles, mineral_map
from ..specimens.specimen import AnySpecimen, Specimen
from ..specimens.strength_map import factors_of
from .options import INNER_MODELS, MESHES, POINTS

#: Keys of a law that a GrainMat takes in another form, or not at all.
_OTHERWISE = {"name", "plane", "softening", "open", "shear_stiffness", "dilation_angle"}


@dataclass
class Grains:
    """Grains for the solver: cells, their discs (rows x, y, radius [m]) and the model."""

    specimen: Specimen
    model: str
    tessellation: Tessellation
    discs: FloatArray
    points: int
    mesh: str
    inner: InnerCells | None = None  #: of the inner particles that the cells are


def grains_of(specimen: Specimen, model: str, points: int, mesh: str) -> Grains:
    """The grains of a specimen, or the inner particles of all of them."""
    require_one_of("build: points", points, POINTS)
    require_one_of("build: mesh", mesh, MESHES)
    if model not in INNER_MODELS:
        discs = np.asarray(specimen.discs, dtype=float)
        return Grains(specimen, model, specimen.tessellation, discs, points, mesh)
    specimen.spec.require_alike(model)
    cells = inner_particles.cells(specimen)
    return Grains(specimen, model, cells.tessellation, cells.discs, 1, mesh, cells)


def fitted(specimen: Specimen, grains: Grains, chosen: Material, model: str) -> Material:
    """The material, with the stiffness of inner particles fitted to the rock's."""
    if model not in INNER_MODELS:
        return chosen
    description(chosen, model)  # refuses a material without the set
    if specimen.kind == "disc":  # no test of it gives a modulus
        like = inner_particles.rectangle_like(specimen)
        grains = grains_of(like, model, POINTS[0], MESHES[0])
    return inner_particles.fitted(chosen, lambda tried: constants(assembled(grains, tried)))


def constants(solver: wrapper.GrainSolver) -> tuple[float, float]:
    """Young's modulus [Pa] and Poisson's ratio [-] of an assembled rectangle."""
    try:
        return solver.elasticConstants()
    except (ValueError, RuntimeError) as error:
        raise InputError(f"elastic: {error}") from error


def assembled(grains: Grains, chosen: Material) -> wrapper.GrainSolver:
    """Make the solver with the packed arrays of the bonded, unloaded grains."""
    description(chosen, grains.model)  # refuses minerals that do not go together
    solver = wrapper.GrainSolver()
    materials = [grain_material(kind, grains.model) for kind in mineral_materials(chosen)]
    try:
        cells = _input(grains)
        pairs = _tell_minerals(cells, grains, chosen)
        joints = _tell_joints(cells, grains, chosen)
        solver.assemble(cells, materials, pairs, joints)
    except (ValueError, RuntimeError) as error:
        raise InputError(f"build: {error}") from error
    return solver


def _input(grains: Grains) -> AssemblyInput:
    """Return cells and bonds, without the properties of the material."""
    cells = AssemblyInput(
        grains.tessellation,
        np.ascontiguousarray(grains.discs[:, :2]),
        np.ascontiguousarray(grains.discs[:, 2]),
        float(grains.specimen.thickness),
    )
    cells.rigid = grains.model != "flexible"
    cells.mesh = grains.mesh
    cells.points = grains.points
    if grains.inner is not None:
        inner_particles.tell(cells, grains.inner, grains.model)
    return cells


def _tell_minerals(
    cells: AssemblyInput, grains: Grains, chosen: Material
) -> list[wrapper.GrainMat]:
    """Set the mineral of each grain; returns the materials of the contacts of each two minerals."""
    found = mineral_map.minerals_of(grains.specimen, chosen)
    if found is None:
        return []
    cells.minerals = found
    return [grain_material(pair, grains.model) for pair in pair_materials(chosen, grains.model)]


def _tell_joints(cells: AssemblyInput, grains: Grains, chosen: Material) -> list[wrapper.GrainMat]:
    """Set strengths and joints of the contacts; returns the materials of the joints."""
    specimen = grains.specimen
    factors = factors_of(specimen, chosen)
    if factors is not None:
        cells.edge_strengths = np.ascontiguousarray(factors)
    materials, joints = joints_of(specimen, chosen, grains.model)
    if joints is not None:
        cells.edge_joints = joints
    return materials


def joints_of(
    specimen: AnySpecimen, chosen: Material, model: str
) -> tuple[list[wrapper.GrainMat], IntArray | None]:
    """Return the materials of the joints, and the joint of each contact, -1: none.

    Raises:
        InputError: for a joint without a law.
    """
    if specimen.edge_joints is None:
        return [], None
    laws = {law["name"]: law for law in chosen.joint_laws(model)}
    names = specimen.spec.joint_names or ()
    bearing = specimen.spec.joints_with_law
    require_joints(bearing, list(laws))
    if not bearing:
        return [], None
    # lines of excavations are rock until then
    numbers = [bearing.index(name) if name in bearing else -1 for name in names]
    joints = np.array([*numbers, -1], dtype=np.int32)[specimen.edge_joints]
    return [_joint_material(laws[name]) for name in bearing], np.ascontiguousarray(joints)


def _joint_material(law: Table) -> wrapper.GrainMat:
    return wrapper.GrainMat(
        label=law["name"],
        shearRatio=law["shear_stiffness"] / law["normal_stiffness"],
        dilation=math.tan(math.radians(law["dilation_angle"])),
        **_numbers(law),
    )


def grain_material(chosen: Material, model: str) -> wrapper.GrainMat:
    """Return the material of a solver for a model."""
    law = chosen.law(model)
    return wrapper.GrainMat(
        label=chosen.name, planeStrain=law["plane"] == "strain", **_numbers({**law})
    )


def _numbers(law: Table) -> dict[str, float]:
    """Numbers of a law as a GrainMat spells their names; 0 where it has none, as rigid grains."""
    return {_spelt(key): value or 0.0 for key, value in law.items() if key not in _OTHERWISE}


def _spelt(key: str) -> str:
    first, *others = key.split("_")
    return first + "".join(word.capitalize() for word in others)
