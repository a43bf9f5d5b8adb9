# SPDX-License-Identifier: GPL-3.0-or-later
"""A notch across a solid, from below, along y (D99). Lengths in metres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..._flexpm import Polyhedra, Solid, polyhedra
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ..kernel_input import call
from .specimen import SolidSpecimen


@dataclass(frozen=True, eq=False)
class NotchedSolid(SolidSpecimen):
    """A solid whose cells a notch has cut: what a test is done on, no specimen to save.

    Attributes:
        whole: The solid before.
        place: x of the notch [m].
    """

    whole: SolidSpecimen | None = None
    place: float = 0.0

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

    @property
    def notch_depth(self) -> float:
        """Area of the notch, as seen along x, over the depth of the specimen [m]."""
        return _flank_area(self.cells, len(self.outline().walls)) / self.dimensions["depth"]

    def outline(self) -> Solid:
        """What the cells fill; flanks of the notch are no walls of it."""
        return self.before.outline()


def notched(specimen: SolidSpecimen, place: float, top: float) -> NotchedSolid:
    """Cut a plane notch across the whole depth of a solid, from the bottom up.

    Args:
        specimen: Made of packed or given spheres.
        place: x of the notch [m].
        top: z of its front [m].

    Raises:
        InputError: for cells that were given, which are not cut.
    """
    if specimen.given is not None:
        raise InputError(
            f"run: notch = {top:g} m, must be left out for given cells; make the solid of spheres"
        )
    short = specimen.spec.short_edge * specimen.mean_diameter
    cells = call(
        polyhedra, specimen.spheres, specimen.outline(), short, False, (float(place), float(top))
    )
    parents = cells.sphere_of_cell
    spheres = specimen.spheres[parents]
    pieces = np.bincount(parents)[parents] > 1
    spheres[pieces, :3] = cells.centres[pieces]
    spheres[pieces, 3] = np.cbrt(0.75 / np.pi * cells.volumes[pieces])
    spheres.setflags(write=False)
    minerals = None if specimen.minerals is None else specimen.minerals[parents]
    return NotchedSolid(
        spheres, cells, specimen.spec, minerals=minerals, whole=specimen, place=place
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
