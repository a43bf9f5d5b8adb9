# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast and how far a test is driven, paper Sec. 4.1. SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass

import yade

from .loading_rate import fastest_pace, rate_constant
from .run_spec import RunSpec

#: A test ends at this multiple of the reference strain unless told otherwise [-]: bonds that soften
#: slowly, and the interlocking edges of inner particles, carry more than the reference.
DEFAULT_STRAINS = 8.0
#: The same for discs: plates press into them, and softening lets them carry more.
DISC_STRAINS = 16.0


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


def schedule(scales: dict[str, float], spec: RunSpec) -> Schedule:
    """Loading rate and end of a test from the scales that the recorder names.

    v = k eps_ref H / T with T the steps in which a wave of the scaled masses crosses the height
    and eps_ref the strain of the reference strength.

    Args:
        scales: ``AxialRecorder.scales()``.
        spec: Test and model, which have constants of their own, rate and end.

    Returns:
        Velocity and end.
    """
    test, model = spec.test, spec.model
    # each pascal of confinement adds at least one to the strength of a frictional contact
    reference = (scales["strength"] + spec.confinement) / scales["modulus"]
    crossing = scales["crossing_steps"]
    dt = yade.O.dt
    strain_rate = spec.rate * rate_constant(test, model) * reference / (crossing * dt)
    velocity = strain_rate * scales["height"]
    largest = spec.max_strain or end_strains(test) * reference
    fastest = fastest_pace(test, model, spec.rate) if spec.loading == "adaptive" else 1.0
    return Schedule(velocity, reference, largest, scales["height"], dt, spec.stop_ratio, fastest)
