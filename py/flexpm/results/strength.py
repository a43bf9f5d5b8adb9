# SPDX-License-Identifier: GPL-3.0-or-later
"""Strength criteria from the peaks of several tests, paper Sec. 4.3.2. Compression positive, SI.

Mohr-Coulomb as a line through the peaks, sigma_1 = q + k sigma_3 with

    k = (1 + sin phi) / (1 - sin phi),  q = 2 c sqrt(k),

and Hoek-Brown of intact rock (s = 1, a = 1/2),

    sigma_1 = sigma_3 + sqrt(m_i sigma_ci sigma_3 + sigma_ci^2).

Errors are standard errors of the fit: they measure how well the criterion describes the peaks.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from scipy import optimize, stats

from ..arrays import FloatArray
from ..errors import InputError

Criterion = TypeVar("Criterion", "MohrCoulomb", "HoekBrown")


@dataclass(frozen=True)
class MohrCoulomb:
    """Line through peaks; errors are None for two peaks, which leave no residual."""

    cohesion: float  #: c [Pa]
    friction_angle: float  #: phi [degree]
    cohesion_error: float | None = None  #: [Pa]
    friction_angle_error: float | None = None  #: [degree]

    @property
    def slope(self) -> float:
        """k, increase of the strength per confining pressure [-]."""
        sine = math.sin(math.radians(self.friction_angle))
        return (1.0 + sine) / (1.0 - sine)

    @property
    def uniaxial_strength(self) -> float:
        """q, strength of the line without confining pressure [Pa]."""
        return 2.0 * self.cohesion * math.sqrt(self.slope)

    def strength(self, confinement: FloatArray | float) -> FloatArray | float:
        """Return the axial stress at failure [Pa] under a confining pressure [Pa]."""
        return self.uniaxial_strength + self.slope * confinement


@dataclass(frozen=True)
class HoekBrown:
    """Curve through peaks; errors are None for two peaks."""

    sigma_ci: float  #: uniaxial strength of the intact rock [Pa]
    m_i: float  #: [-]
    sigma_ci_error: float | None = None  #: [Pa]
    m_i_error: float | None = None  #: [-]

    def strength(self, confinement: FloatArray | float) -> FloatArray | float:
        """Return the axial stress at failure [Pa] under a confining pressure [Pa]."""
        return _hoek_brown(confinement, self.sigma_ci, self.m_i)


@dataclass
class Envelope:
    """Strength criteria of a model from its peaks under several confining pressures."""

    model: str
    confinements: list[float]  #: [Pa]
    peaks: list[float]  #: sigma_1 [Pa]
    mohr_coulomb: MohrCoulomb | None
    hoek_brown: HoekBrown | None

    @classmethod
    def of(cls, model: str, confinements: list[float], peaks: list[float]) -> Envelope:
        """Fit both criteria to peaks [Pa] at confining pressures [Pa]; None if a fit fails."""
        line = _fit(mohr_coulomb, confinements, peaks)
        return cls(model, confinements, peaks, line, _fit(hoek_brown, confinements, peaks))

    def as_dict(self) -> dict[str, str | float | None]:
        """Return a row of envelope.csv."""
        return {"model": self.model, "tests": len(self.peaks), **self.constants()}

    def constants(self) -> dict[str, float | None]:
        """Return the constants of both criteria and their errors, by name; None if a fit failed."""
        found: dict[str, float | None] = {}
        for name in ("cohesion", "friction_angle"):
            found[name] = getattr(self.mohr_coulomb, name, None)
            found[f"{name}_error"] = getattr(self.mohr_coulomb, f"{name}_error", None)
        for name in ("sigma_ci", "m_i"):
            found[name] = getattr(self.hoek_brown, name, None)
            found[f"{name}_error"] = getattr(self.hoek_brown, f"{name}_error", None)
        return found


def mohr_coulomb(confinements: Sequence[float], peaks: Sequence[float]) -> MohrCoulomb:
    """Fit cohesion and friction angle by linear regression of peaks on confining pressures.

    The errors of c and phi follow from the covariance of intercept and slope to first order.

    Args:
        confinements: sigma_3 of each test [Pa], >= 0, at least two different values.
        peaks: Largest axial stress of each test, sigma_1 [Pa].

    Returns:
        The line, with cohesion [Pa] and friction angle [degree].

    Raises:
        InputError: for too few or wrong values, or unless the line rises from a positive strength.

    Example:
        >>> line = flexpm.strength.mohr_coulomb([0.0, 10e6, 20e6], [100e6, 140e6, 180e6])
        >>> round(line.slope, 3), round(line.uniaxial_strength / 1e6, 3)
        (4.0, 100.0)
    """
    x, y = _checked("mohr_coulomb", confinements, peaks)
    line = stats.linregress(x, y)
    k, q = float(line.slope), float(line.intercept)
    if not (k > 0.0 and q > 0.0):
        raise InputError(
            f"mohr_coulomb: sigma_1 = {q:.4g} Pa + {k:.4g} sigma_3, must have a positive strength "
            "and slope; check the peaks"
        )
    root = math.sqrt(k)
    cohesion, angle = q / (2.0 * root), 2.0 * math.atan(root) - 0.5 * math.pi
    if len(x) < 3:
        return MohrCoulomb(cohesion, math.degrees(angle))
    var_k, var_q = line.stderr**2, line.intercept_stderr**2
    covariance = -float(np.mean(x)) * var_k
    by_q, by_k = 1.0 / (2.0 * root), -q / (4.0 * k * root)
    var_c = by_q**2 * var_q + 2.0 * by_q * by_k * covariance + by_k**2 * var_k
    angle_error = line.stderr / (root * (1.0 + k))
    return MohrCoulomb(
        cohesion, math.degrees(angle), math.sqrt(max(var_c, 0.0)), math.degrees(angle_error)
    )


def hoek_brown(confinements: Sequence[float], peaks: Sequence[float]) -> HoekBrown:
    """Fit sigma_ci and m_i of intact rock by least squares on the peaks.

    Args:
        confinements: sigma_3 of each test [Pa], >= 0, at least two different values.
        peaks: Largest axial stress of each test, sigma_1 [Pa].

    Returns:
        The curve, with sigma_ci [Pa] and m_i [-].

    Raises:
        InputError: for too few or wrong values, or peaks that do not rise with the confining
            pressure.

    Example:
        >>> curve = flexpm.strength.hoek_brown([0.0, 10e6, 20e6], [100e6, 170e6, 222e6])
        >>> 95e6 < curve.strength(0.0) < 105e6
        True
    """
    x, y = _checked("hoek_brown", confinements, peaks)
    scale = float(np.max(y))
    # (sigma_1 - sigma_3)^2 is linear in sigma_3: a start near the optimum
    line = stats.linregress(x, (y - x) ** 2)
    if not (line.slope > 0.0 and line.intercept > 0.0):
        raise InputError(
            f"hoek_brown: peaks = {', '.join(f'{peak:.4g}' for peak in y)} Pa, must increase "
            "faster than the confining pressure, from a positive strength; check the peaks"
        )
    start = math.sqrt(line.intercept)
    if len(x) < 3:
        return HoekBrown(start, float(line.slope) / start)
    values, covariance = optimize.curve_fit(
        _hoek_brown,
        x / scale,
        y / scale,
        p0=(start / scale, line.slope / start),
        bounds=(1e-12, np.inf),
        x_scale=(start / scale, line.slope / start),
        xtol=1e-14,
        ftol=1e-14,
        gtol=1e-14,
    )
    errors = np.sqrt(np.diag(covariance))
    return HoekBrown(
        scale * float(values[0]), float(values[1]), scale * float(errors[0]), float(errors[1])
    )


def tensile_ratio(direct: float | None, indirect: float | None) -> float | None:
    """Return the ratio of direct to Brazilian tensile strength [-]; None if either is missing."""
    return direct / indirect if direct is not None and indirect else None


def _fit(
    criterion: Callable[[Sequence[float], Sequence[float]], Criterion],
    confinements: Sequence[float],
    peaks: Sequence[float],
) -> Criterion | None:
    """Fit a criterion; None for peaks that it cannot describe."""
    try:
        return criterion(confinements, peaks)
    except InputError:
        return None


def _hoek_brown(confinement: FloatArray | float, sigma_ci: float, m_i: float) -> FloatArray | float:
    return confinement + np.sqrt(m_i * sigma_ci * confinement + sigma_ci**2)


def _checked(
    where: str, confinements: Sequence[float], peaks: Sequence[float]
) -> tuple[FloatArray, FloatArray]:
    x, y = np.asarray(confinements, dtype=float), np.asarray(peaks, dtype=float)
    if x.shape != y.shape or x.ndim != 1:
        raise InputError(
            f"{where}: peaks = {y.size} values, must be one per confining pressure, {x.size}; give "
            "arrays of equal length"
        )
    for name, values, at_least in (("confinements", x, 0.0), ("peaks", y, -math.inf)):
        wrong = values[~(np.isfinite(values) & (values >= at_least))]
        if len(wrong):
            raise InputError(
                f"{where}: {name} = {wrong[0]} Pa, must be finite and not negative; correct it"
            )
    if len(np.unique(x)) < 2:
        raise InputError(
            f"{where}: confinements = {x.tolist()} Pa, must have at least two different values; "
            "add a test at another confining pressure"
        )
    return x, y
