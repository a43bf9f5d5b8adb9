# SPDX-License-Identifier: GPL-3.0-or-later
"""Angles of the traces of a fracture network: constant, von Mises, or Fisher cut by the section.

Angles are measured from the x axis, counter-clockwise [degree]. A trace has no sense, so angles
range from -90 to below 90.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from scipy import integrate, stats
from scipy.spatial.transform import Rotation

from ..arrays import FloatArray
from ..require import Bounds
from .laws import Law, number, word

_ANGLE = Bounds(at_least=-360.0, at_most=360.0)
#: Concentrations [-]: 1e4 is a scatter of half a degree.
_CONCENTRATION = Bounds(at_least=1e-3, at_most=1e4)
#: Colatitudes over which the density of a Fisher law is summed, and angles for its whole.
_SUMMED, _AROUND = 2001, 721


def folded(angles: FloatArray) -> FloatArray:
    """Angles of lines without a sense, from -90 to below 90 [degree]."""
    found: FloatArray = np.mod(angles + 90.0, 180.0) - 90.0
    return found


@dataclass(frozen=True)
class Angles(Law):
    """Base of the laws of angles."""

    @abstractmethod
    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate angles [degree]."""

    @abstractmethod
    def density(self, angles: FloatArray) -> FloatArray | None:
        """Return the density of angles from -90 to 90 [1/degree]; None if all angles are equal."""


@dataclass(frozen=True)
class Constant(Angles):
    """One angle.

    Attributes:
        angle: The angle [degree].
    """

    angle: float = number(_ANGLE, "degree")

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Return `count` times the angle [degree]."""
        return folded(np.full(count, self.angle))

    def density(self, angles: FloatArray) -> None:
        """None: all traces have one angle."""


@dataclass(frozen=True)
class VonMises(Angles):
    """Von Mises' law in 2D: the density is proportional to exp(concentration cos(a - mean)).

    Attributes:
        angle: Mean [degree].
        concentration: The higher, the narrower [-].
    """

    angle: float = number(_ANGLE, "degree")
    concentration: float = number(_CONCENTRATION)

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate angles [degree]."""
        found = stats.vonmises(self.concentration).rvs(count, random_state=generator)
        return folded(self.angle + np.degrees(found))

    def density(self, angles: FloatArray) -> FloatArray:
        """Density of both senses of a trace [1/degree]."""
        law, off = stats.vonmises(self.concentration), np.radians(angles - self.angle)
        found: FloatArray = np.radians(law.pdf(off) + law.pdf(off + np.pi))
        return found


@dataclass(frozen=True)
class Fisher(Angles):
    """Planes in 3D whose poles follow Fisher's law, cut by the section of the specimen.

    The probability that a plane meets the section is proportional to the sine of the angle between
    their poles. With ``weight = "sine"`` the law describes all planes in the rock, weighted by this
    sine; with ``"none"`` it describes the planes that the section cuts.

    Attributes:
        dip: Dip of the mean plane [degree].
        dip_direction: Clockwise from above, from the x axis [degree]: 0 dips towards +x, 90 out of
            the section towards the viewer, 180 towards -x.
        concentration: The higher, the narrower [-].
        weight: ``sine`` or ``none``.
    """

    dip: float = number(Bounds(at_least=0.0, at_most=90.0), "degree")
    dip_direction: float = number(_ANGLE, "degree")
    concentration: float = number(_CONCENTRATION)
    weight: str = word("sine", "none")

    def draw(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate angles [degree]."""
        found: list[FloatArray] = []
        missing = count
        while missing > 0:
            poles = self._poles(generator, missing)
            if self.weight == "sine":
                sines = np.hypot(poles[:, 0], poles[:, 1])
                poles = poles[generator.random(missing) < sines]
            found.append(folded(np.degrees(np.arctan2(-poles[:, 0], poles[:, 1]))))
            missing -= len(poles)
        return np.concatenate(found) if found else np.empty(0)

    def density(self, angles: FloatArray) -> FloatArray:
        """Density, summed over the poles that have one trace [1/degree]."""
        around = np.linspace(-90.0, 90.0, _AROUND)
        whole = integrate.trapezoid(self._crowd(around), x=around)
        found: FloatArray = self._crowd(angles) / whole
        return found

    def _crowd(self, angles: FloatArray) -> FloatArray:
        """The density times a number that is the same for all angles."""
        colatitude = np.linspace(0.0, np.pi, _SUMMED)
        sine, cosine = np.sin(colatitude), np.cos(colatitude)
        surface = sine * sine if self.weight == "sine" else sine
        x, y, z = self._mean()
        turned = np.radians(angles)[:, None]
        along, up = sine * (y * np.cos(turned) - x * np.sin(turned)), cosine * z
        both = sum(np.exp(self.concentration * (s * along + up - 1.0)) for s in (-1.0, 1.0))
        found: FloatArray = integrate.trapezoid(surface * both, x=colatitude, axis=1)
        return found

    def _mean(self) -> FloatArray:
        """Mean pole, upwards; x to the right, y up, z towards the viewer."""
        found: FloatArray = self._turn().apply([0.0, 1.0, 0.0])
        return found

    def _turn(self) -> Rotation:
        """Turns the pole of a level plane into the mean pole."""
        return Rotation.from_euler("zy", [-self.dip, -self.dip_direction], degrees=True)

    def _poles(self, generator: np.random.Generator, count: int) -> FloatArray:
        """Generate poles of Fisher's law: 1 - cos (angle from the mean) is exponential, cut at 2.

        The azimuth about the mean is uniform.
        """
        law = stats.truncexpon(2.0 * self.concentration, scale=1.0 / self.concentration)
        cosine = 1.0 - law.rvs(count, random_state=generator)
        sine = np.sqrt(np.maximum(1.0 - cosine * cosine, 0.0))
        azimuth = generator.uniform(0.0, 2.0 * np.pi, count)
        about = np.column_stack((sine * np.cos(azimuth), cosine, sine * np.sin(azimuth)))
        poles: FloatArray = self._turn().apply(about)
        return poles


#: Laws of angles by the name that a file has.
ANGLES: dict[str, type[Angles]] = {
    "constant": Constant,
    "von-mises": VonMises,
    "fisher": Fisher,
}
