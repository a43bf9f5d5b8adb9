# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean strains of a solid from the centres of its spheres. Extension positive."""

from __future__ import annotations

import math

import numpy as np

from ..._flexpm import StrainGauge
from ...arrays import FloatArray, IntArray
from ...models.sphere_faces import outer_faces, outer_reach
from ...specimens.space.specimen import SolidSpecimen
from ..rig import BOTTOM, TOP

#: Less of the distance between two sides than this part lies between the centres of a layer of one
#: grain; of grains side by side it is half or more.
_LAYER = 0.25


class SphereGauge:
    """Axial strain between bands of centres (D21), lateral strain at the waist (D80).

    A face counts by the part of its height that lies in the middle third.
    """

    def __init__(self, specimen: SolidSpecimen) -> None:
        """Find the faces of the mantle at the waist."""
        height, centres = specimen.dimensions["height"], np.array(specimen.centres)
        grains, sides, vectors = outer_faces(specimen)
        low, high = outer_reach(specimen)
        third = height / 3.0
        within = np.minimum(high[:, 2], 2.0 * third) - np.maximum(low[:, 2], third)
        waist = ~np.isin(sides, (BOTTOM, TOP)) & (within > 0.0)
        grains, middles = grains[waist], 0.5 * (low + high)[waist]
        shares = within[waist] / (high - low)[waist, 2]
        self._bands = StrainGauge(0.0, height, specimen.mean_diameter, [], [])
        self._across: list[tuple[int, StrainGauge]] = []
        for k in range(2):
            areas = shares * vectors[waist, k]
            between = _apart(areas, centres[grains, k]), _apart(areas, middles[:, k])
            if between[0] > _LAYER * between[1]:
                ends = (_owners(grains, sign * areas) for sign in (-1.0, 1.0))
                gauge = StrainGauge(0.0, height, specimen.mean_diameter, *ends)
                self._across.append((k, gauge))

    def strains(self, centres: FloatArray, ways: FloatArray) -> tuple[float, float]:
        """Axial strain, and the mean of both lateral strains [-].

        A layer of one grain has only the other one, a column of them nan.

        Args:
            centres: Where the centres were, (n, 3) [m].
            ways: Their displacements since, (n, 3) [m].
        """

        def found(gauge: StrainGauge, axis: int) -> tuple[float, float]:
            section = [axis, 2]
            return gauge.strains(
                np.ascontiguousarray(centres[:, section]), np.ascontiguousarray(ways[:, section])
            )

        lateral = [found(gauge, axis)[1] for axis, gauge in self._across]
        mean = sum(lateral) / len(lateral) if lateral else math.nan
        return found(self._bands, 0)[0], mean


def _owners(grains: IntArray, areas: FloatArray) -> list[tuple[int, float]]:
    """Grains and areas of the faces whose area is above 0."""
    there = areas > 0.0
    return list(zip(grains[there].tolist(), areas[there].tolist(), strict=True))


def _apart(areas: FloatArray, places: FloatArray) -> float:
    """Mean place where areas are above 0 less that where they are below, by areas [m]."""
    far, near = np.maximum(areas, 0.0), np.maximum(-areas, 0.0)
    return float(np.average(places, weights=far) - np.average(places, weights=near))
