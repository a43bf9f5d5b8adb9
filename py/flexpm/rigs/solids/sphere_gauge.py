# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean strains of a solid from the centres of its spheres. Extension positive."""

from __future__ import annotations

import math

import numpy as np

from ..._flexpm import StrainGauge
from ...arrays import FloatArray
from ...models.sphere_bonds import in_order
from ...models.sphere_faces import outer_faces
from ...specimens.space.specimen import SolidSpecimen
from ..rig import BOTTOM, TOP

#: Columns across and along the axis, as a gauge of the plane takes them.
_SECTION = [0, 2]


class SphereGauge:
    """Axial strain between bands of centres (D21), lateral strain by the mantle's ways (D80)."""

    def __init__(self, specimen: SolidSpecimen) -> None:
        """Find the faces of the mantle."""
        height = specimen.dimensions["height"]
        self._bands = StrainGauge(0.0, height, specimen.mean_diameter, [], [])
        grains, sides, vectors = outer_faces(specimen)
        mantle = ~np.isin(sides, (BOTTOM, TOP))
        self._grains, self._vectors = grains[mantle], vectors[mantle]

    def strains(self, centres: FloatArray, ways: FloatArray) -> tuple[float, float]:
        """Axial strain, and the mean of both lateral strains [-].

        Args:
            centres: Where the centres were, (n, 3) [m].
            ways: Their displacements since, (n, 3) [m].
        """
        axial, _ = self._bands.strains(
            np.ascontiguousarray(centres[:, _SECTION]), np.ascontiguousarray(ways[:, _SECTION])
        )
        across = self._sum(centres)
        return axial, self._sum(ways) / across if across else math.nan  # a single column

    def _sum(self, values: FloatArray) -> float:
        return in_order(np.sum(self._vectors * values[self._grains], axis=1).tolist())
