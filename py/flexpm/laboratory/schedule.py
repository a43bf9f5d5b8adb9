# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user sets of a test, and how fast and how far it is driven, paper Sec. 4.1. SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass

import yade

from ..errors import InputError
from ..results.measures import PEAK_DROP
from .loading_rate import STOP_RATIO, fastest_pace, rate_constant

#: A test ends at this multiple of the reference strain unless told otherwise [-]: bonds that soften
#: slowly, and the interlocking edges of inner particles, carry more than the reference.
DEFAULT_STRAINS = 8.0
#: The same for discs: plates press into them, and softening lets them carry more.
DISC_STRAINS = 16.0
#: ``rest``: unloaded, with the velocities of the elastic solution; ``static``: at that solution,
#: where the first contact point is about to leave its elastic branch.
STARTS = ("rest", "static")
#: ``steady``: the ends move at one velocity; ``adaptive``: faster while the specimen is elastic.
PACES = ("steady", "adaptive")


@dataclass(frozen=True)
class Settings:
    """What a user may set of a test."""

    confinement: float = 0.0  #: lateral pressure [Pa]
    rate: float = 1.0  #: factor on the default loading rate [-]
    max_strain: float | None = None  #: axial strain at which the test ends [-]
    stop_ratio: float = STOP_RATIO  #: part of its peak to which the stress falls in the end [-]
    start: str = "rest"  #: how the loading begins, one of `STARTS`
    pace: str = "steady"  #: how the loading goes on, one of `PACES`

    def __post_init__(self) -> None:
        _require_positive("rate", self.rate)
        if self.max_strain is not None:
            _require_positive("max_strain", self.max_strain)
        most = 1.0 - PEAK_DROP
        if not 0.0 < self.stop_ratio <= most:
            raise InputError(
                f"run: stop_ratio = {self.stop_ratio}, must be above 0 and at most {most:g}"
            )
        if self.start not in STARTS:
            raise InputError(f"run: start = {self.start!r}, must be one of {', '.join(STARTS)}")
        if self.pace not in PACES:
            raise InputError(f"run: pace = {self.pace!r}, must be one of {', '.join(PACES)}")
        if not (math.isfinite(self.confinement) and self.confinement >= 0.0):
            raise InputError(f"run: confinement = {self.confinement} Pa, must not be below 0")

    def refuse_confinement(self, test: str) -> None:
        """Raise InputError if there is a lateral pressure, which `test` has no use for."""
        if self.confinement != 0.0:
            raise InputError(
                f"run: confinement = {self.confinement} Pa, must be 0 for {test}; use biaxial"
            )


@dataclass
class Schedule:
    """How fast and how far a test is driven."""

    velocity: float  #: of the moving end at pace 1, magnitude [m/step, or m/s with real masses]
    reference_strain: float  #: strain of the reference strength [-]
    max_strain: float  #: at which the test ends [-]
    height: float  #: [m]
    dt: float  #: [s], or 1 with scaled masses
    stop_ratio: float  #: part of its peak to which the stress falls in the end [-]
    fastest_pace: float = 1.0  #: largest velocity over `velocity` [-]

    @property
    def steps(self) -> int:
        """Steps up to the largest strain at pace 1."""
        return math.ceil(self.max_strain * self.height / (self.velocity * self.dt))


def end_strains(test: str) -> float:
    """Multiple of the reference strain at which a test ends unless told otherwise."""
    return DISC_STRAINS if test == "brazilian" else DEFAULT_STRAINS


def schedule(
    scales: dict[str, float], test: str, settings: Settings, model: str = "flexible"
) -> Schedule:
    """Loading rate and end of a test from the scales that the recorder names.

    v = k eps_ref H / T with T the steps in which a wave of the scaled masses crosses the height
    and eps_ref the strain of the reference strength.

    Args:
        scales: ``AxialRecorder.scales()``.
        test: Name of the test.
        settings: Rate factor, pace, confinement and largest strain.
        model: Name of the model, which has constants of its own.

    Returns:
        Velocity and end.
    """
    # each pascal of confinement adds at least one to the strength of a frictional contact
    reference = (scales["strength"] + settings.confinement) / scales["modulus"]
    crossing = scales["crossing_steps"]
    dt = yade.O.dt
    strain_rate = settings.rate * rate_constant(test, model) * reference / (crossing * dt)
    velocity = strain_rate * scales["height"]
    largest = settings.max_strain or end_strains(test) * reference
    fastest = fastest_pace(test, model, settings.rate) if settings.pace == "adaptive" else 1.0
    return Schedule(
        velocity, reference, largest, scales["height"], dt, settings.stop_ratio, fastest
    )


def _require_positive(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"run: {name} = {value}, must be above 0")
