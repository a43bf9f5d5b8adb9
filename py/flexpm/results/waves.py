# SPDX-License-Identifier: GPL-3.0-or-later
"""Speed of a plane pulse between two sections of a specimen: deviation D49. SI units."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from .record import Curve

#: Columns of the mean displacement of the lower and of the upper section [m], and of the time [s].
DISPLACEMENTS = ("near_displacement", "far_displacement")
TIME = "time"
#: Share of the largest velocity of a section that may be left once a pulse has passed it [-]: else
#: what it has gone through has scattered it.
_LARGEST_REST = 0.05
#: Least displacement of the upper section over that of the lower one [-]: less is what an open
#: joint lets through.
_LEAST_PASSED = 0.1


def modulus(wave: str, young: float, poisson: float) -> float:
    """Stress over strain in a plane wave whose sides are held across its motion [Pa].

    Args:
        wave: ``p`` or ``s``.
        young: Young's modulus in the plane [Pa].
        poisson: Poisson's ratio in the plane [-].
    """
    if wave == "p":
        return young / (1.0 - poisson**2)
    return young / (2.0 * (1.0 + poisson))


def solid_modulus(wave: str, young: float, poisson: float) -> float:
    """The same of a solid [Pa].

    Args:
        wave: ``p`` or ``s``.
        young: Young's modulus [Pa].
        poisson: Poisson's ratio [-].
    """
    if wave == "p":
        return young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
    return young / (2.0 * (1.0 + poisson))


def velocities(curve: Curve) -> tuple[FloatArray, FloatArray]:
    """Mean velocities of the lower and of the upper section [m/s]."""
    time = curve[TIME]
    near, far = (np.gradient(curve[name], time) for name in DISPLACEMENTS)
    return near, far


def centre(time: FloatArray, displacement: FloatArray) -> float:
    """Return the mean time of a pulse, weighted by the velocity [s].

    This is the time at which the longest waves pass, independently of the dispersion of shorter
    waves by grains. Integration by parts avoids the velocity: T - integral of u / u(T) from 0 to T.
    """
    t, u = (np.concatenate([[0.0], column]) for column in (time, displacement))
    area = float(0.5 * (u[1:] + u[:-1]) @ np.diff(t))
    return float(t[-1]) - area / float(u[-1])


def speed(curve: Curve, distance: float) -> float | None:
    """Return the speed from the travel time of the pulse centre between both sections [m/s].

    None if a section still moves at the end of the record, or if the upper section has barely
    moved: the pulse was scattered.

    Args:
        curve: With the columns of the displacements and of the time.
        distance: Distance of the sections [m].
    """
    if len(curve) < 3 or not np.all(np.isfinite(curve[DISPLACEMENTS[1]])):
        return None
    if not all(_has_passed(one) for one in velocities(curve)):
        return None
    lower, upper = (abs(float(curve[name][-1])) for name in DISPLACEMENTS)
    if upper < _LEAST_PASSED * lower:
        return None
    near, far = (centre(curve[TIME], curve[name]) for name in DISPLACEMENTS)
    return distance / (far - near) if far > near else None


def _has_passed(velocity: FloatArray) -> bool:
    largest = float(np.max(np.abs(velocity)))
    return largest > 0.0 and abs(float(velocity[-1])) <= _LARGEST_REST * largest


def name_of(wave: str) -> str:
    """Name of the speed of a wave in result.json."""
    return {"p": "vp", "s": "vs"}[wave]
