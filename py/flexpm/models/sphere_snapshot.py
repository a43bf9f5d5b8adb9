# SPDX-License-Identifier: GPL-3.0-or-later
"""State of YADE's bonded spheres as the plain arrays of the other models' snapshots. SI units.

Each cell is plotted as a fan of triangles that moves and rotates with its sphere. Its stress is the
mean stress of the bonds of the sphere, the sum of branch times force divided by the volume. A bond
is one point in the middle of its edge, with a damage of 0 or 1 and an elastic slip. Tension is
positive.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from yade import wrapper

from ..arrays import BoolArray, FloatArray, IntArray
from ..results.snapshot import Snapshot
from ..results.stress.point_stress import OF_GRAINS
from ..specimens.specimen import Specimen
from .sphere_bonds import Bonds
from .sphere_cracks import CrackWatch, body_with

#: One for each bonded pair.
Interactions = Sequence[wrapper.Interaction | None]


def snapshot(
    specimen: Specimen,
    bodies: Sequence[int],
    bonds: Bonds,
    cracks: CrackWatch,
    interactions: Interactions,
    minerals: IntArray | None = None,
) -> Snapshot:
    """State of the spheres and their bonds.

    Args:
        specimen: The grains.
        bodies: Body of each grain.
        bonds: Properties of the bonds.
        cracks: Observer of the bonds, immediately after an observation.
        interactions: That each bonded pair has now.
        minerals: Index of each grain's mineral, or None if all grains are alike.
    """
    motion = Motion(specimen, bodies)
    grain_of, reference, triangles, triangle_grain = _fans(specimen, cracks.alive)
    erased = cracks.erased
    kept = ~erased
    gone, bonds = bonds.chosen(erased), bonds.chosen(kept)
    interactions = [one for one, keep in zip(interactions, kept, strict=True) if keep]
    ends = _present_ends(motion, bonds)
    forces = bond_forces(bodies, bonds, interactions)
    along, length = motion.branches(bonds.grains)
    normal = np.einsum("ij,ij->i", forces, along)
    shear = along[:, 0] * forces[:, 1] - along[:, 1] * forces[:, 0]
    middle = 0.5 * (ends[:, 0] + ends[:, 1])
    stress = _grain_stress(specimen, motion, bonds, forces, middle)
    start = np.hypot(*np.diff(specimen.centres[bonds.grains], axis=1)[:, 0].T)
    return Snapshot(
        positions=motion.carry(grain_of, reference),
        reference=reference,
        velocities=motion.velocities(grain_of, reference),
        triangles=triangles,
        triangle_grain=triangle_grain,
        triangle_stress=stress[triangle_grain],
        grain_mineral=minerals,
        contact=np.flatnonzero(kept),
        contact_grains=bonds.grains,
        contact_ends=ends,
        point_contact=np.arange(len(bonds.grains)),
        point_share=np.ones(len(bonds.grains)),
        point_opening=length - start,
        point_slip=-shear / bonds.shear_stiffness,
        point_damage=(cracks.steps[kept] >= 0).astype(float),
        point_traction=np.stack([-normal, -shear], axis=1) / bonds.areas[:, None],
        crack_step=cracks.steps[kept],
        crack_mode=cracks.modes[kept],
        crack_position=cracks.places[kept],
        erased_contact=np.flatnonzero(erased),
        erased_grains=gone.grains,
        erased_ends=_present_ends(motion, gone),
        erased_point_bond=np.arange(len(gone.grains)),
        erased_crack_step=cracks.steps[erased],
        erased_crack_mode=cracks.modes[erased],
        erased_crack_position=cracks.places[erased],
        stress_source=OF_GRAINS,
    )


def _present_ends(motion: Motion, bonds: Bonds) -> FloatArray:
    """Return the ends of the edges of bonds, moved with both grains [m]; nan without a grain."""
    sides = [
        [motion.carry(bonds.grains[:, side], bonds.ends[:, end]) for side in (0, 1)]
        for end in (0, 1)
    ]
    ends: FloatArray = np.stack([0.5 * (one + other) for one, other in sides], axis=1)
    return ends


class Motion:
    """Where the spheres have gone and how they have turned; nan of those that were erased."""

    def __init__(self, specimen: Specimen, bodies: Sequence[int]) -> None:
        self._start = np.array(specimen.centres)
        self.centres, self._speeds = np.full((2, len(bodies), 2), math.nan)
        self._spins, angles = np.full((2, len(bodies)), math.nan)
        for grain, number in enumerate(bodies):
            body = body_with(number)
            if body is None:
                continue
            state = body.state
            self.centres[grain] = state.pos[0], state.pos[1]
            self._speeds[grain] = state.vel[0], state.vel[1]
            self._spins[grain] = state.angVel[2]
            axis, angle = state.ori.toAxisAngle()
            angles[grain] = math.copysign(1.0, axis[2]) * angle
        self._cos, self._sin = np.cos(angles), np.sin(angles)

    def carry(self, grains: IntArray, points: FloatArray) -> FloatArray:
        """Present places of points [m] that move with grains."""
        places: FloatArray = self.centres[grains] + self._arms(grains, points)
        return places

    def velocities(self, grains: IntArray, points: FloatArray) -> FloatArray:
        """Velocities of points that move with grains."""
        x, y = self._arms(grains, points).T
        turning = self._spins[grains, None] * np.column_stack((-y, x))
        found: FloatArray = self._speeds[grains] + turning
        return found

    def branches(self, pairs: IntArray) -> tuple[FloatArray, FloatArray]:
        """Unit vectors and distances between the centres of pairs."""
        branch = self.centres[pairs[:, 1]] - self.centres[pairs[:, 0]]
        length = np.hypot(*branch.T)
        return branch / length[:, None], length

    def _arms(self, grains: IntArray, points: FloatArray) -> FloatArray:
        x, y = (points - self._start[grains]).T
        c, s = self._cos[grains], self._sin[grains]
        return np.column_stack((c * x - s * y, s * x + c * y))


def bond_forces(bodies: Sequence[int], bonds: Bonds, interactions: Interactions) -> FloatArray:
    """Return the force of each bond on its second grain [N], (C, 2), also after it has broken."""
    forces = np.zeros((len(bonds), 2))
    for row, interaction in enumerate(interactions):
        if interaction is not None and interaction.isReal:
            phys = interaction.phys
            force = phys.normalForce + phys.shearForce
            forces[row] = force[0], force[1]
    # the collider may have named the other sphere first
    first = np.array(bodies)[bonds.grains[:, 0]]
    named = [one.id1 if one is not None else -1 for one in interactions]
    forces[np.array(named) != first] *= -1.0
    return forces


def _grain_stress(
    specimen: Specimen, motion: Motion, bonds: Bonds, forces: FloatArray, middle: FloatArray
) -> FloatArray:
    """Mean stress of each grain, rows xx, yy, xy [Pa]."""
    tensor = np.zeros((len(specimen.discs), 2, 2))
    for side, sign in ((0, -1.0), (1, 1.0)):
        grains = bonds.grains[:, side]
        arm = middle - motion.centres[grains]
        np.add.at(tensor, grains, sign * arm[:, :, None] * forces[:, None, :])
    volumes = np.array(specimen.tessellation.cell_areas) * specimen.thickness
    tensor /= volumes[:, None, None]
    return np.column_stack(
        (tensor[:, 0, 0], tensor[:, 1, 1], 0.5 * (tensor[:, 0, 1] + tensor[:, 1, 0]))
    )


def _fans(specimen: Specimen, alive: BoolArray) -> tuple[IntArray, FloatArray, IntArray, IntArray]:
    """Return the grain of each node, nodes, triangles, and the grain of each triangle."""
    meshes = specimen.meshes("fan")
    nodes = np.diff(meshes.node_offsets)
    count = np.diff(meshes.triangle_offsets)
    first = np.repeat(np.array(meshes.node_offsets)[:-1], count)
    grains = np.arange(len(nodes))
    node_grain, triangle_grain = np.repeat(grains, nodes), np.repeat(grains, count)
    kept, drawn = alive[node_grain], alive[triangle_grain]
    place = np.cumsum(kept) - 1  # of each node among those kept
    triangles = place[np.array(meshes.triangles) + first[:, None]]
    return (
        node_grain[kept],
        np.array(meshes.nodes)[kept],
        triangles[drawn],
        triangle_grain[drawn],
    )
