# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths of the traces of a fracture network [m]: constant, lognormal, or a power law.

The last two have cut-offs on both sides. Their logarithms are drawn, which are a truncated normal
and a truncated exponential variable of scipy.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from scipy import stats

from ..arrays import FloatArray
from ..require import LENGTH, Bounds
from .laws import Law, number

#: Least share of a lognormal law between its cut-offs [-]: what is left of its far tails is no law.
_LEAST_SHARE = 1e-6


@dataclass(frozen=True)
class Lengths(Law):
    """Base of the laws of lengths."""

    @property
    @abstractmethod
    def expected(self) -> float:
        """Mean length, between the cut-offs [m]."""

    @property
    @abstractmethod
    def longest(self) -> float:
        """No trace is longer [m]."""

    @abstractmethod
    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Draw lengths [m]."""


@dataclass(frozen=True)
class Constant(Lengths):
    """One length.

    Attributes:
        value: The length [m].
    """

    value: float = number(LENGTH, "m")

    @property
    def expected(self) -> float:
        """The length [m]."""
        return self.value

    @property
    def longest(self) -> float:
        """The length [m]."""
        return self.value

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """The length, as often as is asked for [m]."""
        return np.full(count, self.value)


def reversed_cutoffs(smallest: float, largest: float) -> str:
    """The rule that cut-offs break, empty if none."""
    if smallest < largest:
        return ""
    return (
        f"smallest = {smallest:g} m, must be < largest = {largest:g} m; exchange the cut-offs, or "
        "take law constant"
    )


@dataclass(frozen=True)
class Lognormal(Lengths):
    """Lognormal between cut-offs.

    Attributes:
        mean: Mean of the law before it is cut off [m].
        deviation: Its standard deviation [m].
        smallest: Lower cut-off [m].
        largest: Upper cut-off [m].
    """

    mean: float = number(LENGTH, "m")
    deviation: float = number(LENGTH, "m")
    smallest: float = number(LENGTH, "m")
    largest: float = number(LENGTH, "m")

    def broken(self) -> str:
        """Refuse cut-offs that are reversed, or between which hardly any length lies."""
        if rule := reversed_cutoffs(self.smallest, self.largest):
            return rule
        low, high = self._bounds()
        share = normal_share(low, high)
        if share < _LEAST_SHARE:
            return (
                f"share between the cut-offs = {share:.3g}, must be >= {_LEAST_SHARE:g}; move the "
                "mean between them"
            )
        return ""

    @property
    def expected(self) -> float:
        """Mean length, between the cut-offs [m]."""
        low, high = self._bounds()
        spread = self._spread
        moved = normal_share(low - spread, high - spread)
        return self.mean * moved / normal_share(low, high)

    @property
    def longest(self) -> float:
        """Upper cut-off [m]."""
        return self.largest

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Draw lengths [m]."""
        low, high = self._bounds()
        scores = stats.truncnorm(low, high).rvs(count, random_state=generator)
        found: FloatArray = np.exp(self._middle + self._spread * scores)
        return np.clip(found, self.smallest, self.largest)

    @property
    def _spread(self) -> float:
        """Standard deviation of the logarithm [-]."""
        return math.sqrt(math.log1p((self.deviation / self.mean) ** 2))

    @property
    def _middle(self) -> float:
        """Mean of the logarithm of the length over 1 m [-]."""
        return math.log(self.mean) - 0.5 * self._spread**2

    def _bounds(self) -> tuple[float, float]:
        """Cut-offs of the logarithm, from its mean, over its standard deviation [-]."""
        ends = (math.log(end) for end in (self.smallest, self.largest))
        low, high = ((end - self._middle) / self._spread for end in ends)
        return low, high


def normal_share(low: float, high: float) -> float:
    """Share of a normal law between two scores, from the tail in which it is not lost."""
    if low > 0.0:
        low, high = -high, -low
    return float(stats.norm.cdf(high) - stats.norm.cdf(low))


@dataclass(frozen=True)
class Power(Lengths):
    """Power law between cut-offs: the density is proportional to the length to the -exponent.

    Attributes:
        exponent: Above 2 [-]: otherwise the upper cut-off determines the mean.
        smallest: Lower cut-off [m].
        largest: Upper cut-off [m].
    """

    exponent: float = number(Bounds(at_most=100.0))
    smallest: float = number(LENGTH, "m")
    largest: float = number(LENGTH, "m")

    def broken(self) -> str:
        """Refuse an exponent without a mean, and cut-offs that are reversed."""
        if self.exponent <= 2.0:
            return (
                f"exponent = {self.exponent:g}, must be > 2: otherwise the law has a mean only by "
                "its upper cut-off; give a larger exponent"
            )
        return reversed_cutoffs(self.smallest, self.largest)

    @property
    def expected(self) -> float:
        """Mean length, between the cut-offs [m]."""
        span, steep = self._span, self.exponent - 1.0
        flat = steep - 1.0
        share = math.expm1(-flat * span) / math.expm1(-steep * span)
        return steep / flat * self.smallest * share

    @property
    def longest(self) -> float:
        """Upper cut-off [m]."""
        return self.largest

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Draw lengths [m]."""
        steep = self.exponent - 1.0
        law = stats.truncexpon(steep * self._span, scale=1.0 / steep)
        found: FloatArray = self.smallest * np.exp(law.rvs(count, random_state=generator))
        return np.clip(found, self.smallest, self.largest)

    @property
    def _span(self) -> float:
        """Logarithm of the upper over the lower cut-off [-]."""
        return math.log(self.largest / self.smallest)


#: Laws of lengths by the name that a file has.
LENGTHS: dict[str, type[Lengths]] = {
    "constant": Constant,
    "lognormal": Lognormal,
    "power": Power,
}
