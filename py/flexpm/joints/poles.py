# SPDX-License-Identifier: GPL-3.0-or-later
"""Poles of planes in 3D: constant or by Fisher's law, and their statistics. Angles in degrees.

A pole is a unit normal that points upwards; x is east, y north, z up.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..require import Bounds
from .laws import Law, number
from .planes import DIP, DIRECTION, normal_of

#: Concentrations [-]: 1e4 is a scatter of half a degree.
_CONCENTRATION = Bounds(at_least=1e-3, at_most=1e4)
#: Most rounds until the mean pole stays.
_ROUNDS = 100


@dataclass(frozen=True)
class Poles(Law):
    """Base of the laws of poles.

    Attributes:
        dip: Dip of the mean plane [degree].
        dip_direction: Its dip direction, clockwise from y [degree].
    """

    dip: float = number(DIP, "degree")
    dip_direction: float = number(DIRECTION, "degree")

    @property
    def mean(self) -> FloatArray:
        """Mean pole."""
        return np.array(normal_of(self.dip, self.dip_direction))

    @abstractmethod
    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate poles, (count, 3)."""


@dataclass(frozen=True)
class Constant(Poles):
    """One pole."""

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Return `count` times the pole."""
        return np.tile(self.mean, (count, 1))


@dataclass(frozen=True)
class Fisher(Poles):
    """Fisher's law about a mean pole.

    Attributes:
        concentration: The higher, the narrower [-].
    """

    concentration: float = number(_CONCENTRATION)

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate poles: the cosine of the angle from the mean has an exact inverse."""
        share = generator.random(count)
        kappa = self.concentration
        # 1 - share is above 0
        cosine = 1.0 + np.log((1.0 - share) + share * math.exp(-2.0 * kappa)) / kappa
        cosine = np.clip(cosine, -1.0, 1.0)
        sine = np.sqrt(1.0 - cosine * cosine)
        around = generator.uniform(0.0, 2.0 * np.pi, count)
        # up the dip, and along the strike
        up = np.array(normal_of(self.dip - 90.0, self.dip_direction))
        strike = np.cross(self.mean, up)
        found: FloatArray = (
            cosine[:, None] * self.mean
            + (sine * np.cos(around))[:, None] * up
            + (sine * np.sin(around))[:, None] * strike
        )
        return upwards(found)


def upwards(poles: FloatArray) -> FloatArray:
    """The same axes with poles that point upwards."""
    turned: FloatArray = np.where(poles[:, 2:] < 0.0, -poles, poles)
    return turned


@dataclass(frozen=True)
class PoleStatistics:
    """Fisher's statistics of axes.

    Attributes:
        dip: Dip of the mean plane [degree].
        dip_direction: Its dip direction, 0 to 360 [degree].
        concentration: Estimate of Fisher's concentration [-], too large below about 5, since poles
            have no sense; None for less than three poles, or equal poles.
    """

    dip: float
    dip_direction: float
    concentration: float | None


def statistics(poles: FloatArray) -> PoleStatistics:
    """Mean pole and concentration of axes; each pole takes the sense that is nearer to the mean.

    Args:
        poles: Unit normals in any sense, (n, 3), at least one.
    """
    _, axes = np.linalg.eigh(poles.T @ poles)
    mean = axes[:, -1]
    for _ in range(_ROUNDS):
        signs = np.where(poles @ mean < 0.0, -1.0, 1.0)
        total = signs @ poles
        length = float(np.linalg.norm(total))
        if np.array_equal(total / length, mean):
            break
        mean = total / length
    count, off = len(poles), len(poles) - length
    x, y, z = (mean if mean[2] >= 0.0 else -mean).tolist()
    found = count >= 3 and off > 1e-12 * count
    return PoleStatistics(
        math.degrees(math.atan2(math.hypot(x, y), z)),
        math.degrees(math.atan2(x, y)) % 360.0,
        _concentration(length / count, count) if found else None,
    )


def _concentration(mean: float, count: int) -> float:
    """Root of coth(k) - 1 / k = mean, without the bias of few poles."""
    kappa = 1.0 / (1.0 - mean)
    for _ in range(_ROUNDS):  # Newton's method; the function of large k is 1 - 1 / k
        turned = 1.0 / math.tanh(kappa)
        slope = 1.0 / kappa**2 - 1.0 / math.sinh(min(kappa, 300.0)) ** 2
        step = (turned - 1.0 / kappa - mean) / slope
        kappa = max(kappa - step, 0.1 * kappa)
        if abs(step) < 1e-12 * kappa:
            break
    return kappa * (count - 2) / count


#: Laws of poles by the name that a file has.
POLES: dict[str, type[Poles]] = {"constant": Constant, "fisher": Fisher}
