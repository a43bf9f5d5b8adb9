# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean strains of a 3D specimen from the centres of its spheres. Extension positive."""

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
    """Axial strain between bands of centres (D21), lateral strain in the central third (D80).

    The weight of a face is the share of its height within the central third.
    """

    def __init__(self, specimen: SolidSpecimen) -> None:
        """Find the faces of the lateral surface in the central third of the height."""
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
        """Return the axial strain, and the mean of both lateral strains [-].

        A layer with a thickness of a single grain has only the lateral strain of the other
        direction; for a column of single grains the lateral strain is nan.

        Args:
            centres: Initial centres, (n, 3) [m].
            ways: Displacements of the centres, (n, 3) [m].
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
    """Return grains and areas of the faces with an area above 0."""
    there = areas > 0.0
    return list(zip(grains[there].tolist(), areas[there].tolist(), strict=True))


def _apart(areas: FloatArray, places: FloatArray) -> float:
    """Return the difference of the area-weighted mean positions for areas above and below 0 [m]."""
    far, near = np.maximum(areas, 0.0), np.maximum(-areas, 0.0)
    return float(np.average(places, weights=far) - np.average(places, weights=near))
