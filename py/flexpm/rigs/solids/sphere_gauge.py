# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean strains of a solid from the centres of its spheres. Extension positive."""

from __future__ import annotations

import math

import numpy as np

from ..._flexpm import StrainGauge
from ...arrays import FloatArray
from ...models.sphere_faces import outer_faces, outer_heights
from ...specimens.space.specimen import SolidSpecimen
from ..rig import BOTTOM, TOP


class SphereGauge:
    """Axial strain between bands of centres (D21), lateral strain at the waist (D80).

    A face counts if it reaches into the middle third of the height.
    """

    def __init__(self, specimen: SolidSpecimen) -> None:
        """Find the faces of the mantle at the waist."""
        height = specimen.dimensions["height"]
        grains, sides, vectors = outer_faces(specimen)
        lowest, highest = outer_heights(specimen)
        at_waist = (highest > height / 3.0) & (lowest < 2.0 * height / 3.0)
        waist = ~np.isin(sides, (BOTTOM, TOP)) & at_waist
        grains, vectors = grains[waist], vectors[waist]

        def shares(areas: FloatArray) -> list[tuple[int, float]]:
            """Grains with their areas where these are above 0."""
            there = areas > 0.0
            return list(zip(grains[there].tolist(), areas[there].tolist(), strict=False))

        self._across = [
            StrainGauge(
                0.0, height, specimen.mean_diameter, shares(-vectors[:, k]), shares(vectors[:, k])
            )
            for k in range(2)
        ]

    def strains(self, centres: FloatArray, ways: FloatArray) -> tuple[float, float]:
        """Axial strain, and the mean of both lateral strains [-]; nan of a single column.

        Args:
            centres: Where the centres were, (n, 3) [m].
            ways: Their displacements since, (n, 3) [m].
        """
        axial, lateral = 0.0, []
        for k, gauge in enumerate(self._across):
            section = [k, 2]
            axial, across = gauge.strains(
                np.ascontiguousarray(centres[:, section]), np.ascontiguousarray(ways[:, section])
            )
            if math.isfinite(across):  # a layer of one grain has no strain across
                lateral.append(across)
        return axial, sum(lateral) / len(lateral) if lateral else math.nan
