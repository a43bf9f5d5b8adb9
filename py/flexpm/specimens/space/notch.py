# SPDX-License-Identifier: GPL-3.0-or-later
"""Notches across a solid, along y (D99). Lengths in metres."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..._flexpm import Polyhedra, Solid, polyhedra
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ..kernel_input import call
from .specimen import SolidSpecimen


@dataclass(frozen=True, eq=False)
class NotchedSolid(SolidSpecimen):
    """A 3D specimen whose cells are cut by notches: used for a test, not saved.

    Attributes:
        whole: The specimen without notches.
        notches: x of each notch, requested z of its front [m], and whether it comes from above.
    """

    whole: SolidSpecimen | None = None
    notches: tuple[tuple[float, float, bool], ...] = ()

    @property
    def before(self) -> SolidSpecimen:
        """The solid before."""
        assert self.whole is not None
        return self.whole

    @property
    def parents(self) -> IntArray:
        """Grain of the whole solid that each grain is, or is a piece of."""
        return self.cells.sphere_of_cell

    @property
    def mean_diameter(self) -> float:
        """Mean diameter of the spheres, which pieces do not change [m]."""
        return self.before.mean_diameter

    def depths(self) -> list[float]:
        """Area of each notch, as seen along x, over the depth of the specimen [m]."""
        walls, across = len(self.outline().walls), self.dimensions["depth"]
        return [_flank_area(self.cells, walls + i) / across for i in range(len(self.notches))]

    def lines_of(self, joint: str) -> FloatArray:
        """Return the notches as cut, see `lines`, for any name of a joint."""
        return self.lines()

    def lines(self) -> FloatArray:
        """The notches as cut, ends (n, 2, 2) in x and z, from the outside to the front [m]."""
        top = self.dimensions.get("height", 0.0)
        ends = [
            [[x, top], [x, top - depth]] if above else [[x, 0.0], [x, depth]]
            for (x, _, above), depth in zip(self.notches, self.depths(), strict=True)
        ]
        return np.array(ends)

    def outline(self) -> Solid:
        """Return the outline of the cells; flanks of notches are not part of it."""
        return self.before.outline()


def notched(specimen: SolidSpecimen, notches: Sequence[tuple[float, float, bool]]) -> NotchedSolid:
    """Cut plane notches across the whole depth of a solid.

    Args:
        specimen: Made of packed or given spheres.
        notches: x of each, z of its front [m], and whether it comes from above.

    Raises:
        InputError: for user-supplied cells, and for a specimen with joints.
    """
    if specimen.given is not None:
        raise InputError(
            f"run: notch = {notches[0][1]:g} m, must not be given for user-supplied cells; pack "
            "spheres instead"
        )
    if specimen.holes:
        raise InputError(
            f"run: notch = {notches[0][1]:g} m, must not be given for a 3D specimen with holes; "
            "leave out one of them"
        )
    if specimen.planes:
        raise InputError(
            f"run: notch = {notches[0][1]:g} m, must not be given for a 3D specimen with joints; "
            "leave out one of them"
        )
    short = specimen.spec.short_edge * specimen.mean_diameter
    asked = [(float(x), float(front), bool(above)) for x, front, above in notches]
    cells = call(polyhedra, specimen.spheres, specimen.outline(), short, False, asked)
    parents = cells.sphere_of_cell
    spheres = specimen.spheres[parents]
    pieces = np.bincount(parents)[parents] > 1
    spheres[pieces, :3] = cells.centres[pieces]
    spheres[pieces, 3] = np.cbrt(0.75 / np.pi * cells.volumes[pieces])
    spheres.setflags(write=False)
    minerals = None if specimen.minerals is None else specimen.minerals[parents]
    return NotchedSolid(
        spheres,
        cells,
        specimen.spec,
        minerals=minerals,
        whole=specimen,
        notches=tuple(asked),
    )


def _flank_area(cells: Polyhedra, wall: int) -> float:
    """Area of the left flanks, as seen along x [m2]."""
    total = 0.0
    for face in np.flatnonzero(cells.faces[:, 2] == wall):
        corners = cells.face_vertices[cells.face_offsets[face] : cells.face_offsets[face + 1]]
        total += max(_area_along_x(cells.vertices[corners]), 0.0)
    return total


def _area_along_x(polygon: FloatArray) -> float:
    y, z = polygon[:, 1], polygon[:, 2]
    return 0.5 * float(np.sum(y * np.roll(z, -1) - z * np.roll(y, -1)))
