# SPDX-License-Identifier: GPL-3.0-or-later
"""Containers of packings of spheres. Lengths in metres."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from yade import utils, wrapper

from ..._flexpm import Solid, insert_spheres
from ...arrays import FloatArray
from .spec import SolidSpec

#: Length of facets beyond top and bottom, in largest sizes of the frame.
_BEYOND = 0.05
#: Makers of the outlines that are round.
_ROUND = {
    "cylinder": Solid.cylinder,
    "solid-disc": Solid.disc,
    "solid-half-disc": Solid.half_disc,
}


@dataclass(frozen=True)
class SolidFrame:
    """Box from the origin, cylinder from z = 0, or disc or half disc from y = 0 about the y axis.

    Attributes:
        kind: ``box``, ``cylinder``, ``solid-disc`` or ``solid-half-disc``.
        sizes: Width, depth and height, diameter and height, or diameter and depth [m].
        grain: Mean diameter of the spheres, which the facets of a mantle follow [m].
    """

    kind: str
    sizes: tuple[float, ...]
    grain: float

    @classmethod
    def of(cls, spec: SolidSpec, grain: float) -> SolidFrame:
        """The frame of a specimen of grains of a mean diameter [m]."""
        return cls(spec.kind, tuple(spec.sizes.values()), grain)

    def scaled(self, factor: float) -> SolidFrame:
        """Return the frame with all lengths multiplied by ``factor``."""
        sizes = tuple(size * factor for size in self.sizes)
        return SolidFrame(self.kind, sizes, self.grain * factor)

    def solid(self) -> Solid:
        """Return the outline as the kernel's object."""
        if self.kind == "box":
            return Solid.box(*self.sizes)
        diameter, length = self.sizes
        return _ROUND[self.kind](diameter, length, self.grain)

    def insert(self, radii: FloatArray, shrink: float, seed: int) -> FloatArray:
        """Return random places at which shrunken spheres do not overlap, (n, 3) [m]."""
        return insert_spheres(radii, self.solid(), shrink, seed)

    def walls(self, material: wrapper.Material) -> list[wrapper.Body]:
        """Make the bodies that hold spheres inside: planes, and two facets for each of a mantle."""
        bodies = []
        for *normal, offset in self.solid().walls:
            axis = int(np.argmax(np.abs(normal)))
            if normal[axis] in (-1.0, 1.0):
                side = int(normal[axis])
                wall = utils.wall(side * offset, axis, sense=-side, material=material)
                bodies.append(wall)
        return bodies + ([] if self.kind == "box" else self._mantle(material))

    def has_inside(self, place: FloatArray) -> bool:
        """Whether a place x, y, z is inside."""
        return bool(np.all(self._walls[:, :3] @ place < self._walls[:, 3]))

    @cached_property
    def _walls(self) -> FloatArray:
        walls: FloatArray = self.solid().walls  # a mantle has hundreds, each place asks for them
        return walls

    def _mantle(self, material: wrapper.Material) -> list[wrapper.Body]:
        walls = self.solid().walls
        apothem = walls[-1, 3]
        halved = self.kind == "solid-half-disc"
        count = len(walls) - (3 if halved else 2)
        around = 2 * count if halved else count
        corner = apothem / math.cos(math.pi / around)
        low = -_BEYOND * max(self.sizes)
        high = self.sizes[1] - low
        # numpy has cosines of its own on some processors: spheres would differ between machines
        upright = self.kind == "cylinder"
        first = {"cylinder": 0.0, "solid-half-disc": -0.5 * math.pi}.get(self.kind, math.pi / count)
        angles = [first + 2.0 * math.pi * k / around for k in range(count + 1)]
        rim = [(corner * math.cos(angle), corner * math.sin(angle)) for angle in angles]

        def place(point: tuple[float, float], along: float) -> tuple[float, float, float]:
            # the mantle of a disc is that of a cylinder that has been laid down
            return (*point, along) if upright else (point[1], along, point[0])

        facets = []
        for a, b in itertools.pairwise(rim):
            for corners in (
                [place(a, low), place(b, low), place(a, high)],
                [place(b, low), place(b, high), place(a, high)],
            ):
                facets.append(utils.facet(corners, material=material))
        return facets
