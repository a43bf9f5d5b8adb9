# SPDX-License-Identifier: GPL-3.0-or-later
"""Radii of the discs of a fracture network [m]: laws of trace lengths, uniform and exponential.

All laws but ``constant`` have cut-offs on both sides, which hold for the number of discs.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from scipy import stats

from ..arrays import FloatArray
from ..require import LENGTH
from . import trace_lengths
from .laws import Law, number


@dataclass(frozen=True)
class Radii(Law):
    """Base of the laws of radii."""

    @property
    @abstractmethod
    def mean_square(self) -> float:
        """Mean of the squares [m2]."""

    @property
    @abstractmethod
    def longest(self) -> float:
        """No radius is larger [m]."""

    @property
    @abstractmethod
    def shortest(self) -> float:
        """No radius is smaller [m]."""

    @abstractmethod
    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate radii [m]."""


@dataclass(frozen=True)
class Constant(trace_lengths.Constant, Radii):
    """One radius."""

    @property
    def mean_square(self) -> float:
        """Square of the radius [m2]."""
        return self.value**2

    @property
    def shortest(self) -> float:
        """The radius [m]."""
        return self.value


@dataclass(frozen=True)
class Lognormal(trace_lengths.Lognormal, Radii):
    """Lognormal law between cut-offs."""

    @property
    def mean_square(self) -> float:
        """Mean of the squares, between the cut-offs [m2]."""
        low, high = self._bounds()
        spread = self._spread
        whole = math.exp(2.0 * self._middle + 2.0 * spread**2)
        moved = trace_lengths.normal_share(low - 2.0 * spread, high - 2.0 * spread)
        return whole * moved / trace_lengths.normal_share(low, high)

    @property
    def shortest(self) -> float:
        """Lower cut-off [m]."""
        return self.smallest


@dataclass(frozen=True)
class Power(trace_lengths.Power, Radii):
    """Power law between cut-offs: the density is proportional to the radius to the -exponent."""

    @property
    def mean_square(self) -> float:
        """Mean of the squares, between the cut-offs [m2]."""
        steep, flat = self.exponent - 1.0, self.exponent - 3.0
        span = self._span
        share = span if flat == 0.0 else -math.expm1(-flat * span) / flat
        return steep * self.smallest**2 * share / -math.expm1(-steep * span)

    @property
    def shortest(self) -> float:
        """Lower cut-off [m]."""
        return self.smallest


@dataclass(frozen=True)
class _Between(Radii):
    """Base of laws between cut-offs."""

    smallest: float = number(LENGTH, "m")
    largest: float = number(LENGTH, "m")

    def broken(self) -> str:
        """Reject reversed cut-offs."""
        return trace_lengths.reversed_cutoffs(self.smallest, self.largest)

    @property
    def longest(self) -> float:
        """Upper cut-off [m]."""
        return self.largest

    @property
    def shortest(self) -> float:
        """Lower cut-off [m]."""
        return self.smallest


@dataclass(frozen=True)
class Uniform(_Between):
    """Uniform law between two radii.

    Attributes:
        smallest: Smallest radius [m].
        largest: Largest radius [m].
    """

    @property
    def mean_square(self) -> float:
        """Mean of the squares [m2]."""
        low, high = self.smallest, self.largest
        return (low * low + low * high + high * high) / 3.0

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate radii [m]."""
        found: FloatArray = generator.uniform(self.smallest, self.largest, count)
        return found


@dataclass(frozen=True)
class Exponential(_Between):
    """Exponential law between cut-offs.

    Attributes:
        smallest: Lower cut-off [m].
        largest: Upper cut-off [m].
        mean: Mean of the law before it is cut off [m].
    """

    mean: float = number(LENGTH, "m")

    @property
    def mean_square(self) -> float:
        """Mean of the squares, between the cut-offs [m2]."""
        # integrals of r^n exp(-r / mean) from the lower cut-off, which is taken out of them
        low, span, scale = self.smallest, (self.largest - self.smallest) / self.mean, self.mean
        whole, end = -math.expm1(-span), math.exp(-span)
        first = (whole - span * end) / whole
        second = (2.0 * whole - (span * span + 2.0 * span) * end) / whole
        if span < 1e-3:  # nearly uniform: the differences have few digits
            return Uniform(self.smallest, self.largest).mean_square
        return low * low + 2.0 * low * scale * first + scale * scale * second

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate radii [m]."""
        span = (self.largest - self.smallest) / self.mean
        law = stats.truncexpon(span, loc=self.smallest, scale=self.mean)
        found: FloatArray = law.rvs(count, random_state=generator)
        return np.clip(found, self.smallest, self.largest)


#: Laws of radii by the name that a file has.
RADII: dict[str, type[Radii]] = {
    "constant": Constant,
    "uniform": Uniform,
    "exponential": Exponential,
    "lognormal": Lognormal,
    "power": Power,
}
