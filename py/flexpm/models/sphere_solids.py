# SPDX-License-Identifier: GPL-3.0-or-later
"""State of YADE's bonded spheres in 3D as the arrays of the other models' snapshots. SI units.

Each cell moves and rotates with its sphere; its stress is the mean stress of the bonds of the
sphere. A bond is one point in the middle of its face, with a damage of 0 or 1 and an elastic slip.
A bond of an interaction range is a square in the gap. Tension is positive.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from yade import wrapper

from ..arrays import FloatArray, IntArray
from ..results.solids.state import SolidSnapshot
from ..results.stress.point_stress import OF_GRAINS
from ..specimens.space.specimen import SolidSpecimen
from .sphere_bonds import Bonds
from .sphere_cracks import CrackWatch, body_with

#: Entries of a tensor that are its components xx, yy, zz, yz, xz, xy.
_ROWS, _COLUMNS = [0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]


def solid_snapshot(
    specimen: SolidSpecimen,
    bodies: Sequence[int],
    bonds: Bonds,
    cracks: CrackWatch,
    interactions: Sequence[wrapper.Interaction | None],
    minerals: IntArray | None = None,
) -> SolidSnapshot:
    """Return the state of spheres and bonds, also of erased bonds; erased spheres have no position.

    Args:
        specimen: The grains.
        bodies: Body of each grain.
        bonds: Properties of the bonds.
        cracks: Observer of the bonds, immediately after an observation.
        interactions: That each bonded pair has now.
        minerals: Index of each grain's mineral, or None if all grains are alike.
    """
    motion = SpaceMotion(specimen, bodies)
    mesh, (offsets, corners) = _mesh(specimen), _corners(specimen, bonds)
    pairs = np.repeat(bonds.grains, np.diff(offsets), axis=0)
    forces = forces_on_second(bodies, bonds, interactions)
    normal, tangents, length = motion.frames(bonds.grains)
    pulls = -np.einsum("ij,ij->i", forces, normal)
    shears = -np.einsum("kij,ij->ik", tangents, forces)
    middle = motion.between(bonds.grains, bonds.ends[:, 0])
    stress = _grain_stress(specimen, motion, bonds, forces, middle)
    start = np.diff(specimen.centres[bonds.grains], axis=1)[:, 0]
    count = len(bonds)
    return SolidSnapshot(
        positions=motion.carry(mesh.grain_of, mesh.nodes),
        reference=mesh.nodes,
        velocities=motion.velocities(mesh.grain_of, mesh.nodes),
        forces=np.zeros_like(mesh.nodes),
        node_offsets=mesh.offsets,
        centres=motion.carry(np.arange(len(bodies)), mesh.nodes[mesh.offsets[1:] - 1]),
        volumes=np.array(specimen.cells.volumes),
        tetrahedra=mesh.tetrahedra,
        tetrahedron_grain=mesh.owners,
        tetrahedron_stress=stress[mesh.owners],
        surface=mesh.surface,
        surface_grain=mesh.surface_grain,
        surface_side=mesh.surface_side,
        contact_grains=bonds.grains,
        corner_offsets=offsets,
        corner_reference=corners,
        corners=motion.between(pairs, corners),
        areas=bonds.areas,
        point_offsets=np.arange(count + 1),
        point_area=bonds.areas,
        point_position=middle,
        point_opening=length - np.hypot.reduce(start, axis=1),
        point_slip=shears / bonds.shear_stiffness[:, None],
        point_damage=(cracks.steps >= 0).astype(float),
        point_traction=np.column_stack((pulls, shears)) / bonds.areas[:, None],
        crack_step=cracks.steps,
        crack_mode=cracks.modes,
        crack_position=cracks.places,
        crack_energy=np.full(count, math.nan),
        grain_mineral=minerals,
        stress_source=OF_GRAINS,
    )


class SpaceMotion:
    """Where the spheres have gone and how they have turned; nan of those that were erased."""

    def __init__(self, specimen: SolidSpecimen, bodies: Sequence[int]) -> None:
        """Read the scene."""
        self._start = np.array(specimen.centres)
        self.centres, self._speeds, self._spins = np.full((3, len(bodies), 3), math.nan)
        self._turns = np.full((len(bodies), 3, 3), math.nan)
        for grain, number in enumerate(bodies):
            body = body_with(number)
            if body is None:
                continue
            state = body.state
            self.centres[grain], self._speeds[grain] = state.pos, state.vel
            self._spins[grain] = state.angVel
            matrix = state.ori.toRotationMatrix()
            self._turns[grain] = [[matrix[i, k] for k in range(3)] for i in range(3)]

    def carry(self, grains: IntArray, points: FloatArray) -> FloatArray:
        """Present places of points [m] that move with grains."""
        places: FloatArray = self.centres[grains] + self._arms(grains, points)
        return places

    def between(self, pairs: IntArray, points: FloatArray) -> FloatArray:
        """The middle of where both grains of pairs carry points [m]."""
        first, second = (self.carry(pairs[:, side], points) for side in (0, 1))
        places: FloatArray = 0.5 * (first + second)
        return places

    def velocities(self, grains: IntArray, points: FloatArray) -> FloatArray:
        """Velocities of points that move with grains."""
        turning = np.cross(self._spins[grains], self._arms(grains, points))
        found: FloatArray = self._speeds[grains] + turning
        return found

    def frames(self, pairs: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Unit vectors between the centres of pairs, two (2, n, 3) across, and the distances."""
        branch = self.centres[pairs[:, 1]] - self.centres[pairs[:, 0]]
        length = np.hypot.reduce(branch, axis=1)
        normal = branch / length[:, None]
        return normal, np.stack(_across(normal)), length

    def _arms(self, grains: IntArray, points: FloatArray) -> FloatArray:
        arms: FloatArray = np.einsum(
            "nij,nj->ni", self._turns[grains], points - self._start[grains]
        )
        return arms


def _across(normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors across each normal and each other."""
    first = np.cross(normals, np.eye(3)[np.argmin(np.abs(normals), axis=1)])
    first /= np.hypot.reduce(first, axis=1)[:, None]
    return first, np.cross(normals, first)


def forces_on_second(
    bodies: Sequence[int], bonds: Bonds, interactions: Sequence[wrapper.Interaction | None]
) -> FloatArray:
    """Return the force of each bond on its second grain [N], (C, 3), also after it has broken."""
    forces = np.zeros((len(bonds), 3))
    for row, interaction in enumerate(interactions):
        if interaction is not None and interaction.isReal:
            force = interaction.phys.normalForce + interaction.phys.shearForce
            # the collider may have named the other sphere first
            first = bodies[int(bonds.grains[row, 0])]
            forces[row] = force if interaction.id1 == first else -force
    return forces


def _grain_stress(
    specimen: SolidSpecimen,
    motion: SpaceMotion,
    bonds: Bonds,
    forces: FloatArray,
    middle: FloatArray,
) -> FloatArray:
    """Mean stress of each grain, xx, yy, zz, yz, xz, xy [Pa]."""
    tensor = np.zeros((len(specimen.spheres), 3, 3))
    for side, sign in ((0, -1.0), (1, 1.0)):
        grains = bonds.grains[:, side]
        arm = middle - motion.centres[grains]
        np.add.at(tensor, grains, sign * arm[:, :, None] * forces[:, None, :])
    tensor /= np.array(specimen.cells.volumes)[:, None, None]
    found: FloatArray = 0.5 * (tensor[:, _ROWS, _COLUMNS] + tensor[:, _COLUMNS, _ROWS])
    return found


class _Mesh(NamedTuple):
    """Tetrahedra of all grains and the triangles of their surface, over nodes of grains."""

    nodes: FloatArray
    grain_of: IntArray  #: of each node
    offsets: IntArray
    tetrahedra: IntArray
    owners: IntArray
    surface: IntArray
    surface_grain: IntArray
    surface_side: IntArray


def _mesh(specimen: SolidSpecimen) -> _Mesh:
    nodes, tetrahedra, owners = specimen.tetrahedra()
    meshes, cells = specimen.meshes(), specimen.cells
    offsets = np.array(meshes.node_offsets)
    grain_of = np.repeat(np.arange(cells.cells), np.diff(offsets))
    # nodes of a grain follow its vertices, the centre comes last
    size = len(cells.vertices) + 1
    vertices = np.array(meshes.node_vertices, dtype=int)
    keys = grain_of * size + np.where(vertices < 0, size - 1, vertices)
    faces = np.array(cells.faces[cells.contacts :], dtype=int)
    polygons = specimen.outer_polygons()
    triangles = np.array([len(one) - 2 for one in polygons])
    grains = np.repeat(faces[:, 0], triangles)
    corners = [(one[0], one[k], one[k + 1]) for one in polygons for k in range(1, len(one) - 1)]
    surface = np.searchsorted(keys, grains[:, None] * size + np.array(corners, dtype=int))
    sides = np.array(specimen.outline().sides, dtype=int)[faces[:, 2]]
    return _Mesh(
        *(nodes, grain_of, offsets, tetrahedra, owners, surface, grains),
        np.repeat(sides, triangles),
    )


def _corners(specimen: SolidSpecimen, bonds: Bonds) -> tuple[IntArray, FloatArray]:
    """First corner of each bond, and the end; where the corners were at the start [m]."""
    cells = specimen.cells
    faces = cells.contacts
    ends = np.array(cells.face_offsets[: faces + 1], dtype=int)
    corners = np.array(cells.vertices)[np.array(cells.face_vertices[: ends[-1]], dtype=int)]
    farther = bonds.grains[faces:]
    if len(farther) == 0:
        return ends, corners
    across = specimen.centres[farther[:, 1]] - specimen.centres[farther[:, 0]]
    normal = across / np.hypot.reduce(across, axis=1)[:, None]
    first, second = _across(normal)
    half = np.sqrt(0.5 * bonds.areas[faces:])[:, None]  # of a diagonal
    ways = np.stack((half * first, half * second, -half * first, -half * second), axis=1)
    squares = (bonds.ends[faces:] + ways).reshape(-1, 3)
    added = ends[-1] + 4 * np.arange(1, len(farther) + 1)
    return np.concatenate((ends, added)), np.concatenate((corners, squares))
