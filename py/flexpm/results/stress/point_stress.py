# SPDX-License-Identifier: GPL-3.0-or-later
"""Stresses at points of a specimen. SI units, tension positive."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...arrays import FloatArray
from ...errors import InputError
from ...require import quoted
from .tensors import principal_stresses, turned_stresses
from .triangle_search import triangles_at

#: Where stresses come from: the strain of each triangle, or the forces on each grain.
OF_TRIANGLES = "of each triangle, from its strain"
OF_GRAINS = "mean of each grain, from the forces on it"


class PolarStress(NamedTuple):
    """Components about a point, each (n,) [Pa]; nan at the point itself, which has no direction."""

    radial: FloatArray  #: along the line from the point
    hoop: FloatArray  #: across it
    shear: FloatArray  #: positive if radial and hoop are turned as x and y are with a positive xy


@dataclass(frozen=True, eq=False)
class PointStress:
    """Stresses at n points, nan without a grain: outside, in a hole, in an erased grain.

    A point on an edge of several triangles has their mean stress.

    Example:
        >>> state = flexpm.build(specimen).snapshot()
        >>> found = state.stress_along((0.006, 0.004), (0.006, 0.02), count=5)
        >>> found.yy.tolist()  # nothing loads the specimen yet
        [0.0, 0.0, 0.0, 0.0, 0.0]
    """

    points: FloatArray  #: (n, 2) [m]
    stress: FloatArray  #: xx, yy, xy, (n, 3) [Pa], tension positive
    source: str  #: what the stress is: of each triangle, or the mean of each grain

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"PointStress({len(self)} points, {self.missing} without a grain; {self.source})"

    @property
    def missing(self) -> int:
        """Number of points that are in no grain."""
        return int(np.count_nonzero(np.isnan(self.stress[:, 0])))

    @property
    def xx(self) -> FloatArray:
        """Normal stress along x, (n,) [Pa]."""
        return self.stress[:, 0]

    @property
    def yy(self) -> FloatArray:
        """Normal stress along y, (n,) [Pa]."""
        return self.stress[:, 1]

    @property
    def xy(self) -> FloatArray:
        """Shear stress, (n,) [Pa]."""
        return self.stress[:, 2]

    @property
    def distance(self) -> FloatArray:
        """Distance of each point from the first point, (n,) [m]."""
        x, y = (self.points - self.points[:1]).T
        distance: FloatArray = np.hypot(x, y)
        return distance

    @property
    def principal(self) -> tuple[FloatArray, FloatArray]:
        """Larger and smaller in-plane principal stress, (n,) each [Pa]."""
        return principal_stresses(self.stress)

    @property
    def principal_angle(self) -> FloatArray:
        """Angle from x to the larger principal stress, -pi/2 to pi/2, (n,) [rad]."""
        angle: FloatArray = 0.5 * np.arctan2(2.0 * self.xy, self.xx - self.yy)
        return angle

    def polar(self, about: Sequence[float]) -> PolarStress:
        """Return radial, hoop and shear stress about a point.

        Args:
            about: x and y of the point [m].

        Raises:
            InputError: for a value that is not a point.
        """
        x, y = (self.points - require_points("polar: about", about)[0]).T
        angle = np.where(np.hypot(x, y) > 0.0, np.arctan2(y, x), np.nan)
        return PolarStress(*turned_stresses(self.stress, angle).T)


def stress_of_points(
    corners: FloatArray, stress: FloatArray, points: FloatArray, source: str
) -> PointStress:
    """Return the stresses at points in triangles.

    Args:
        corners: Corners of each triangle, counter-clockwise, (M, 3, 2) [m].
        stress: xx, yy, xy of each triangle, (M, 3) [Pa].
        points: Positions, (n, 2) [m].
        source: Source of the stress.
    """
    point, triangle = triangles_at(corners, points)
    total, count = np.zeros((len(points), 3)), np.zeros(len(points))
    np.add.at(total, point, stress[triangle])
    np.add.at(count, point, 1.0)
    with np.errstate(invalid="ignore"):
        return PointStress(points, total / count[:, None], source)


def require_points(label: str, value: object) -> FloatArray:
    """Return x and y of points as an array (n, 2), one point as one row, or raise InputError."""
    try:
        found: FloatArray = np.atleast_2d(np.array(value, dtype=float))
    except (TypeError, ValueError):
        found = np.empty((0, 0))
    if found.ndim != 2 or found.shape[1] != 2:
        raise InputError(
            f"{label} = {quoted(value)}, must be x and y, or rows of x and y [m]; give (x, y)"
        )
    if not np.all(np.isfinite(found)):
        raise InputError(f"{label} = {quoted(value)}, must be finite numbers; correct them")
    return found
