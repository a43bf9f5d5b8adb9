# SPDX-License-Identifier: GPL-3.0-or-later
"""State of a solid as plain arrays, and a plane cut through it, which is a state of the plane. SI.

Stress, traction and opening are positive in tension.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ...arrays import BoolArray, FloatArray, IntArray
from ..fragments import Fragments, connected
from ..snapshot import Snapshot
from ..stress.point_stress import OF_TRIANGLES
from ..stress.tensors import means_by
from .pairs import PressingPairs

#: Axes of a section in space: across, and along the load.
_PLANE = (0, 2)
#: Components of a stress xx, yy, zz, yz, xz, xy that lie in a section: xx, yy, xy there.
_IN_PLANE = (0, 2, 4)
#: Edges of a tetrahedron by its corners.
_EDGES = np.array([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])
#: Tetrahedra that are computed at a time.
_AT_ONCE = 20_000
#: Distance below which two positions are equal, relative to the longest side.
_SAME = 1e-7


@dataclass(frozen=True, eq=False)
class SolidSnapshot:
    """Arrays of N nodes, M tetrahedra, and C contacts with K corners and P points in total.

    Nodes are sorted by grain, with the centre of each grain last.
    """

    positions: FloatArray  #: of the nodes, (N, 3) [m]
    reference: FloatArray  #: positions in the bonded state, (N, 3) [m]
    velocities: FloatArray  #: (N, 3) [m/s]
    forces: FloatArray  #: on the nodes, (N, 3) [N]
    node_offsets: IntArray  #: first node of each grain, and the end
    centres: FloatArray  #: of the grains, (G, 3) [m]
    volumes: FloatArray  #: of the grains, undeformed [m3]
    tetrahedra: IntArray  #: nodes of each, (M, 4)
    tetrahedron_grain: IntArray  #: (M,)
    tetrahedron_stress: FloatArray  #: xx, yy, zz, yz, xz, xy, (M, 6) [Pa]
    surface: IntArray  #: nodes of the triangles on the outside, (T, 3)
    surface_grain: IntArray  #: (T,)
    surface_side: IntArray  #: number of the side, (T,)
    contact_grains: IntArray  #: (C, 2)
    corner_offsets: IntArray  #: first corner of each contact, and the end
    corner_reference: FloatArray  #: where they were in the bonded state, (K, 3) [m]
    corners: FloatArray  #: (K, 3) [m]
    areas: FloatArray  #: of the contacts when bonded [m2]
    point_offsets: IntArray  #: first point of each contact, and the end
    point_area: FloatArray  #: (P,) [m2]
    point_position: FloatArray  #: (P, 3) [m]
    point_opening: FloatArray  #: (P,) [m]
    point_slip: FloatArray  #: along both tangents, (P, 2) [m]
    point_damage: FloatArray  #: (P,) [-]
    point_traction: FloatArray  #: normal and both shears, (P, 3) [Pa]
    crack_step: IntArray  #: -1 where a point has not cracked, (P,)
    crack_mode: IntArray  #: 0 where a point has not cracked, (P,)
    crack_position: FloatArray  #: (P, 3) [m]
    crack_energy: FloatArray  #: that damage took until the crack, (P,) [J]
    grain_mineral: IntArray | None = None  #: of each grain, if there are minerals
    stress_source: str = (
        OF_TRIANGLES  #: what the stress of a tetrahedron is: its own or its grain's
    )
    #: Pairs of grains that press on each other without a common face.
    pairs: PressingPairs = field(default_factory=PressingPairs.none)
    #: joint of each contact, an index into `joint_names`, -1: none, (C,); None without joints
    contact_joint: IntArray | None = None
    joint_names: tuple[str, ...] = ()  #: where they are known; a file has none

    #: No bond of a solid is erased.
    erased_contact = erased_grains = erased_point_bond = erased_crack_step = None
    erased_crack_mode = erased_crack_position = erased_crack_energy = None
    size_name = "volume"  #: what its fragments are measured by
    contact_size_name = "area"  #: what its contacts are measured by

    @property
    def drawn(self) -> Snapshot:
        """The state that maps draw: the section."""
        return self.section

    @property
    def elements(self) -> int | None:
        """Number of tetrahedra."""
        return len(self.tetrahedra)

    @property
    def extreme_stresses(self) -> tuple[FloatArray, FloatArray]:
        """Smallest and largest principal stress of each tetrahedron [Pa]."""
        smallest, _, largest = self.principal_stresses.T
        return smallest, largest

    @property
    def contact(self) -> IntArray:
        """Index of each contact, which never changes."""
        return np.arange(len(self.contact_grains))

    @cached_property
    def point_contact(self) -> IntArray:
        """Contact of each point."""
        return np.repeat(self.contact, np.diff(self.point_offsets))

    @property
    def point_number(self) -> IntArray:
        """Index of each point in its contact, from 0."""
        return np.arange(len(self.point_contact)) - self.point_offsets[self.point_contact]

    @cached_property
    def fragments(self) -> Fragments:
        """Return the fragments: grains connected by a point that is not fully damaged."""
        bonded = self.any_of(self.point_damage < 1.0)
        return connected(self.contact_grains, bonded, self.volumes)

    def any_of(self, chosen: BoolArray) -> BoolArray:
        """Return for each contact (C,) whether any of its points is chosen (P,)."""
        found: BoolArray = np.zeros(len(self.contact_grains), dtype=bool)
        found[self.point_contact[chosen]] = True
        return found

    @property
    def point_sizes(self) -> FloatArray:
        """Area of the contact that each point stands for, (P,) [m2]."""
        return self.point_area

    @property
    def slip_sizes(self) -> FloatArray:
        """Slip of each point without its direction, (P,) [m]."""
        return _lengths(self.point_slip)

    @property
    def grain_areas(self) -> FloatArray:
        """Volume of each grain [m3], by which fragments are measured."""
        return self.volumes

    @property
    def grain_stress(self) -> FloatArray:
        """Mean stress of each grain, xx, yy, zz, yz, xz, xy, (G, 6) [Pa]."""
        owners = self.tetrahedron_grain[:, None]
        return means_by(self.tetrahedron_stress, self._volumes, owners, len(self.volumes))

    @property
    def principal_stresses(self) -> FloatArray:
        """Principal stresses of each tetrahedron, ascending, (M, 3) [Pa]; nan if not finite."""
        rows, stress = [0, 5, 4, 5, 1, 3, 4, 3, 2], self.tetrahedron_stress
        found = np.full((len(stress), 3), np.nan)
        if np.all(np.isfinite(stress)):
            for begin in range(0, len(stress), _AT_ONCE):  # as matrices they take three times more
                part = slice(begin, begin + _AT_ONCE)
                found[part] = np.linalg.eigvalsh(stress[part, rows].reshape(-1, 3, 3))
        return found

    @property
    def centre_displacements(self) -> FloatArray:
        """Displacement of the centre of each grain, (G, 3) [m]."""
        found: FloatArray = self.centres - self.reference[self.node_offsets[1:] - 1]
        return found

    @property
    def parting(self) -> float:
        """Largest increase of the distance between the centres of bonded grains [m]."""
        before = self.reference[self.node_offsets[1:] - 1]
        first, second = self.contact_grains.T
        grown = _lengths(self.centres[second] - self.centres[first]) - _lengths(
            before[second] - before[first]
        )
        return float(max(np.max(grown, initial=0.0), 0.0))

    @property
    def _volumes(self) -> FloatArray:
        volumes = np.empty(len(self.tetrahedra))
        for begin in range(0, len(volumes), _AT_ONCE):
            part = slice(begin, begin + _AT_ONCE)
            origin, a, b, c = (self.reference[nodes] for nodes in self.tetrahedra[part].T)
            crossed = np.cross(b - origin, c - origin)
            volumes[part] = np.abs(np.einsum("ij,ij->i", a - origin, crossed)) / 6.0
        return volumes

    @cached_property
    def section(self) -> Snapshot:
        """The state on the plane along the axis and x, through the middle of the bonded specimen.

        A tetrahedron gives a triangle or two, a contact a segment. Points of a contact have their
        shares of it in their order, wherever on the face they are.
        """
        low, high = self.reference.min(axis=0), self.reference.max(axis=0)
        # off the symmetry of what was packed by hand, whose faces lie in the middle
        depth = 0.5 * (low[1] + high[1]) + 1e-6 * (high[1] - low[1])
        side = self.reference[:, 1] - depth
        corners, triangles, owners = self._cut_tetrahedra(side)
        moved, before = (
            self._between(corners, self.positions),
            self._between(corners, self.reference),
        )
        triangles = _turned(triangles, before)
        rows, ends = self._cut_contacts(self.corner_reference[:, 1] - depth)
        each = np.diff(self.point_offsets)[rows]
        owner = np.repeat(np.arange(len(rows)), each)
        points = self.point_offsets[rows][owner] + _numbers(each)
        return Snapshot(
            positions=moved,
            reference=before,
            velocities=self._between(corners, self.velocities),
            triangles=triangles,
            triangle_grain=self.tetrahedron_grain[owners],
            triangle_stress=self.tetrahedron_stress[owners][:, _IN_PLANE],
            contact=rows,
            contact_grains=self.contact_grains[rows],
            contact_ends=ends,
            point_contact=owner,
            point_share=self.point_area[points] / self.areas[rows][owner],
            point_opening=self.point_opening[points],
            point_slip=self.slip_sizes[points],
            point_damage=self.point_damage[points],
            point_traction=np.column_stack(
                (self.point_traction[points, 0], _lengths(self.point_traction[points, 1:]))
            ),
            crack_step=self.crack_step[points],
            crack_mode=self.crack_mode[points],
            crack_position=self.crack_position[points][:, _PLANE],
            crack_energy=self.crack_energy[points],
            grain_mineral=self.grain_mineral,
            stress_source=self.stress_source,
            contact_joint=None if self.contact_joint is None else self.contact_joint[rows],
            joint_names=self.joint_names,
        )

    def joint_traces(self) -> dict[str, IntArray]:
        """Return the edges of the surface at which each joint meets it, by name: nodes, (n, 2).

        The grains on both sides of a joint have nodes of their own, so that each edge between them
        occurs once for each side.
        """
        if self.contact_joint is None:
            return {}
        _, corner, node = self.merged()
        after, row = self._next_corners()
        edges = edge_keys(corner, corner[after])
        outer = np.concatenate([self.surface[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
        keys, joint = edge_keys(*node[outer].T), self.contact_joint[row]
        return {
            name: outer[np.isin(keys, edges[joint == number])]
            for number, name in enumerate(self.joint_names)
        }

    def merged(self) -> tuple[FloatArray, IntArray, IntArray]:
        """Return the positions in the bonded state, and that of each corner and each node."""
        places = np.concatenate([self.corner_reference, self.reference])
        step = _SAME * float(np.ptp(places, axis=0).max())
        _, first, one = np.unique(
            np.rint(places / step).astype(np.int64), axis=0, return_index=True, return_inverse=True
        )
        one = one.ravel()
        corners = len(self.corner_reference)
        return places[first], one[:corners], one[corners:]

    def _next_corners(self) -> tuple[IntArray, IntArray]:
        """For each corner the next one around its contact, and the contact."""
        after = np.arange(self.corner_offsets[-1]) + 1
        after[self.corner_offsets[1:] - 1] = self.corner_offsets[:-1]
        sizes = np.diff(self.corner_offsets)
        return after, np.repeat(np.arange(len(sizes)), sizes)

    def _cut_tetrahedra(
        self, side: FloatArray
    ) -> tuple[tuple[IntArray, FloatArray], IntArray, IntArray]:
        """Nodes of a section, each between two nodes, its triangles, and their tetrahedra."""
        below = (side < 0.0)[self.tetrahedra]
        cut = np.flatnonzero(np.any(below, axis=1) & ~np.all(below, axis=1))  # few of many
        nodes = self.tetrahedra[cut][:, _EDGES]  # (c, 6, 2)
        away = side[nodes]
        crossed = (away[..., 0] < 0.0) != (away[..., 1] < 0.0)
        count = crossed.sum(axis=1)
        three, four = np.flatnonzero(count == 3), np.flatnonzero(count == 4)
        order = np.argsort(~crossed, axis=1, kind="stable")
        # the first and the last of four crossed edges share no corner: they lie across
        around = order[four][:, [0, 1, 3, 2]]
        chosen = np.concatenate([order[three][:, :3], around[:, [0, 1, 2]], around[:, [0, 2, 3]]])
        owner = np.concatenate([three, four, four])
        ends = np.sort(nodes[owner[:, None], chosen], axis=2).reshape(-1, 2)
        ends, numbers = np.unique(ends, axis=0, return_inverse=True)
        return (ends, _shares(side[ends])), numbers.reshape(-1, 3), cut[owner]

    def _between(self, corners: tuple[IntArray, FloatArray], values: FloatArray) -> FloatArray:
        """Values of nodes at corners of a section, the components in its plane."""
        ends, share = corners
        first, second = values[ends[:, 0]][:, _PLANE], values[ends[:, 1]][:, _PLANE]
        found: FloatArray = first + share[:, None] * (second - first)
        return found

    def _cut_contacts(self, away: FloatArray) -> tuple[IntArray, FloatArray]:
        """Contacts that a section cuts, and the ends of each there, (c, 2, 2) [m].

        Args:
            away: Distance of each corner from the section [m].
        """
        after, row = self._next_corners()
        crossed = np.flatnonzero((away < 0.0) != (away[after] < 0.0))
        twice = np.bincount(row[crossed], minlength=len(self.contact_grains)) == 2
        crossed = crossed[twice[row[crossed]]]
        first, second = crossed, after[crossed]
        share = _shares(np.column_stack((away[first], away[second])))[:, None]
        ends = self.corners[first] + share * (self.corners[second] - self.corners[first])
        return np.flatnonzero(twice), ends[:, _PLANE].reshape(-1, 2, 2)


#: States of specimens of both dimensions.
AnySnapshot = Snapshot | SolidSnapshot


def drawn_state(state: AnySnapshot | None) -> Snapshot | None:
    """Return the state that maps show: the state itself, or the section of a 3D state."""
    return None if state is None else state.drawn


def _turned(triangles: IntArray, places: FloatArray) -> IntArray:
    """Return the triangles with counter-clockwise corners."""
    a, b, c = (places[triangles[:, k]] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return np.where((area < 0.0)[:, None], triangles[:, ::-1], triangles)


def edge_keys(first: IntArray, last: IntArray) -> IntArray:
    """Return one number for each edge, by the numbers of its ends in any order."""
    keys: IntArray = np.minimum(first, last).astype(np.int64) << 32 | np.maximum(first, last)
    return keys


def _shares(away: FloatArray) -> FloatArray:
    """Where pairs of ends on both sides of a plane cross it, as a part of their way."""
    found: FloatArray = away[:, 0] / (away[:, 0] - away[:, 1])
    return found


def _lengths(vectors: FloatArray) -> FloatArray:
    found: FloatArray = np.linalg.norm(vectors, axis=1)
    return found


def _numbers(counts: IntArray) -> IntArray:
    """Return 0, 1, ... for each count, concatenated."""
    found: IntArray = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return found
