# SPDX-License-Identifier: GPL-3.0-or-later
"""State of a specimen as plain arrays, and its fragments. SI units.

Stress, traction and opening are positive in tension.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..require import Bounds, require_flag, require_whole
from .fragments import Fragments, connected
from .stress.point_stress import OF_TRIANGLES, PointStress, require_points, stress_of_points
from .stress.tensors import means_by, principal_stresses


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Arrays of N nodes, M triangles, C contacts and their P points, contact after contact.

    The arrays have all nodes, triangles and contacts that exist. A cracked bond stays after its
    grains have separated. A bond that a script has erased does not stay; E erased bonds and their R
    points are stored separately.

    Example:
        >>> state = flexpm.build(specimen).snapshot()
        >>> len(state.grain_areas), f"{state.grain_areas.sum():.6f}"
        (37, '0.000288')
    """

    positions: FloatArray  #: of the nodes, (N, 2) [m]
    reference: FloatArray  #: positions in the bonded state, (N, 2) [m]
    velocities: FloatArray  #: (N, 2) [m/s]
    triangles: IntArray  #: nodes of each triangle, (M, 3)
    triangle_grain: IntArray  #: (M,)
    triangle_stress: FloatArray  #: xx, yy, xy, (M, 3) [Pa]
    contact: IntArray  #: number of each contact, which it keeps, (C,)
    contact_grains: IntArray  #: (C, 2)
    contact_ends: FloatArray  #: (C, 2, 2) [m]
    point_contact: IntArray  #: row of the contact of each point, rising, (P,)
    point_share: FloatArray  #: share of its contact's area that a point stands for, (P,) [-]
    point_opening: FloatArray  #: (P,) [m]
    point_slip: FloatArray  #: (P,) [m]
    point_damage: FloatArray  #: (P,) [-]
    point_traction: FloatArray  #: normal and shear, (P, 2) [Pa]
    crack_step: IntArray  #: -1 where a point has not cracked, (P,)
    crack_mode: IntArray  #: 0 where a point has not cracked, (P,)
    crack_position: FloatArray  #: (P, 2) [m]
    forces: FloatArray | None = None  #: on the nodes, (N, 2) [N]
    crack_energy: FloatArray | None = None  #: that damage took until the crack, (P,) [J]
    triangle_particle: IntArray | None = None  #: (M,), where grains have inner particles
    triangle_stress_zz: FloatArray | None = None  #: (M,) [Pa], in plane strain
    grain_mineral: IntArray | None = None  #: of each grain, if there are minerals
    erased_contact: IntArray | None = None  #: number of each erased bond, (E,)
    erased_grains: IntArray | None = None  #: (E, 2)
    erased_ends: FloatArray | None = None  #: (E, 2, 2) [m], nan if one of the grains is gone
    erased_point_bond: IntArray | None = None  #: row of the erased bond of each point, (R,)
    erased_crack_step: IntArray | None = None  #: of the crack or the erasure, (R,)
    erased_crack_mode: IntArray | None = None  #: (R,)
    erased_crack_position: FloatArray | None = None  #: (R, 2) [m]
    erased_crack_energy: FloatArray | None = None  #: (R,) [J]
    stress_source: str = OF_TRIANGLES  #: what the stress of a triangle is: its own, or its grain's
    #: joint of each contact, an index into `joint_names`, -1: none, (C,); None without joints
    contact_joint: IntArray | None = None
    joint_names: tuple[str, ...] = ()  #: where they are known; a file has none
    #: of each contact, 0 of contacts that came later, (C,) [m]; None without joints and of a file
    bonded_length: FloatArray | None = None

    size_name = "area"  #: what its fragments are measured by
    contact_size_name = "length"  #: what its contacts are measured by
    elements = None  #: number of tetrahedra, of a solid
    parting = None  #: largest growth of a distance of bonded grains, of a solid [m]

    @property
    def drawn(self) -> Snapshot:
        """The state that maps draw: itself."""
        return self

    @property
    def extreme_stresses(self) -> tuple[FloatArray, FloatArray]:
        """Smaller and larger principal stress of each triangle [Pa]."""
        larger, smaller = principal_stresses(self.triangle_stress)
        return smaller, larger

    @cached_property
    def fragments(self) -> Fragments:
        """Sets of connected grains: a connection has a contact point that is not fully damaged."""
        bonded = self.any_of(self.point_damage < 1.0)
        return connected(self.contact_grains, bonded, self.grain_areas)

    @property
    def grain_areas(self) -> FloatArray:
        """Undeformed area of each grain [m2]."""
        areas = np.bincount(self.triangle_grain, weights=triangle_areas(self))
        return areas.astype(float, copy=False)

    @property
    def grain_stress(self) -> FloatArray:
        """Mean stress of each grain, xx, yy, xy, (G, 3) [Pa]; nan for an erased grain."""
        owners = self.triangle_grain[:, None]
        count = int(np.max(self.triangle_grain, initial=-1)) + 1
        return means_by(self.triangle_stress, triangle_areas(self), owners, count)

    def stress_at(
        self, points: Sequence[Sequence[float]] | FloatArray, *, moved: bool = False
    ) -> PointStress:
        """Return the stresses at points of the specimen.

        A point in a deformable grain has the stress of its triangle. Rigid grains and spheres have
        no inner stress. A point in such a grain has the mean stress that follows from the forces on
        the grain, and ``source`` of the result states this. A point outside, in a hole or in an
        erased grain has nan. ``missing`` counts such points.

        Args:
            points: Rows of x and y, or one point [m].
            moved: Whether points are present positions. False: they are positions in the bonded
                state, in which there are no open cracks and no overlaps.

        Raises:
            InputError: for a value that is not an array of points.

        Example:
            >>> state = flexpm.build(specimen).snapshot()
            >>> state.stress_at([(0.006, 0.012), (1.0, 1.0)]).missing
            1
        """
        places = self.positions if require_flag("stress_at: moved", moved) else self.reference
        asked = require_points("stress_at: points", points)
        corners = places[self.triangles]
        return stress_of_points(corners, self.triangle_stress, asked, self.stress_source)

    def stress_along(
        self,
        first: Sequence[float],
        last: Sequence[float],
        count: int = 101,
        *,
        moved: bool = False,
    ) -> PointStress:
        """Return the stresses at equal distances along a straight line, see `stress_at`.

        Args:
            first: x and y of the first point [m].
            last: x and y of the last point [m].
            count: Number of points, including both ends.
            moved: As for `stress_at`.

        Raises:
            InputError: for a value that is not a point, or fewer than two points.
        """
        ends = [
            require_points(f"stress_along: {name}", one)[0]
            for name, one in (("first", first), ("last", last))
        ]
        share = np.linspace(
            0.0, 1.0, require_whole("stress_along: count", count, Bounds(at_least=2.0))
        )
        return self.stress_at(ends[0] + share[:, None] * (ends[1] - ends[0]), moved=moved)

    @property
    def cuts(self) -> IntArray:
        """Indices of contacts that are open without a crack. Before a test these are the notches.

        Later, grains that have come into contact also have such contacts.
        """
        return np.flatnonzero(~self.any_of((self.point_damage < 1.0) | (self.crack_mode != 0)))

    def any_of(self, chosen: BoolArray) -> BoolArray:
        """Return for each contact (C,) whether any of its points is chosen (P,)."""
        found: BoolArray = np.zeros(len(self.contact), dtype=bool)
        found[self.point_contact[chosen]] = True
        return found

    @property
    def point_sizes(self) -> FloatArray:
        """Length of the contact that each point stands for, when bonded if known, (P,) [m]."""
        lengths = self.bonded_length
        if lengths is None:
            lengths = np.hypot(*np.diff(self.contact_ends, axis=1)[:, 0].T)
        found: FloatArray = lengths[self.point_contact] * self.point_share
        return found

    @property
    def slip_sizes(self) -> FloatArray:
        """Slip of each point without its direction, (P,) [m]."""
        return np.abs(self.point_slip)

    @property
    def point_segments(self) -> FloatArray:
        """Tributary segment of each point on its contact, from start to end, (P, 2, 2) [m]."""
        ends = self.contact_ends[self.point_contact]
        before = np.concatenate([[0.0], np.cumsum(self.point_share)])
        first = np.flatnonzero(self.point_number == 0)
        bounds = np.stack([before[:-1], before[1:]], axis=1)
        bounds -= np.repeat(before[first], np.diff(first, append=len(ends)))[:, None]
        segments: FloatArray = ends[:, :1] + bounds[..., None] * (ends[:, 1:] - ends[:, :1])
        return segments

    @property
    def point_number(self) -> IntArray:
        """Index of each point in its contact, from 0, (P,)."""
        return numbers_within(self.point_contact)


def numbers_within(owners: IntArray) -> IntArray:
    """Return the index of each row among the consecutive rows of the same owner, from 0."""
    first = np.flatnonzero(np.diff(owners, prepend=-1))
    return np.arange(len(owners)) - np.repeat(first, np.diff(first, append=len(owners)))


def triangle_areas(snapshot: Snapshot) -> FloatArray:
    """Return the undeformed area of each triangle, (M,) [m2]."""
    corners = snapshot.reference[snapshot.triangles]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    areas: FloatArray = 0.5 * (ax * by - ay * bx)
    return areas
