# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures taken from the record of a test, paper Sec. 4. SI units, signs as in the record."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ..arrays import FloatArray
from ..kinds.test_kind import PLATEAU_STRAIN
from .doubts import SET_POINT_OFF
from .record import Curve

ENERGIES = (
    "kinetic_energy",
    "elastic_energy",
    "damage_energy",
    "friction_energy",
    "damping_energy",
    "drag_energy",
    "potential_energy",
)

#: E and nu are fitted between these fractions of the peak.
ELASTIC_WINDOW = (0.05, 0.25)
#: The largest stress counts as a peak once the stress has fallen by this fraction of it.
PEAK_DROP = 0.10
_SEATED = 0.2
#: End of the strain over which a stress that grows by more than so much of its largest still rises:
#: one that stands creeps on by less, a straight line grows by a tenth [-].
_LAST_PART, _STANDS = 0.1, 0.02
#: Part of the loading in which a test is at least as well balanced as `unbalanced_under_way` [-].
_UNDER_WAY = 0.8
#: Shares of the peak between which the early and the late modulus are taken.
_EARLY, _LATE = (0.15, 0.25), (0.75, 0.85)
#: Cracking has set in once this share of all cracked points of a mode have cracked.
ONSET_SHARE = 0.05


def differential_stress(curve: Curve) -> FloatArray:
    """Return the deviator [Pa]: axial stress minus confining pressure."""
    return curve["axial_stress"] - curve["confinement"]


def peak_row(curve: Curve) -> int | None:
    """Row of the largest axial stress, or None while no peak has been passed."""
    stress = differential_stress(curve)
    if len(stress) == 0 or not np.any(np.isfinite(stress)):
        return None
    row = int(np.nanargmax(stress))
    if not stress[row] > 0.0 or not np.nanmin(stress[row:]) <= (1.0 - PEAK_DROP) * stress[row]:
        return None
    return row


def still_rises(curve: Curve) -> bool:
    """Whether the stress had no peak and still rose over the last tenth of the strain."""
    stress, strain = differential_stress(curve), curve["axial_strain"]
    if len(stress) == 0 or not np.all(np.isfinite(stress)) or peak_row(curve) is not None:
        return False
    before = np.flatnonzero(strain <= (1.0 - _LAST_PART) * strain[-1])
    largest = float(stress.max())
    if not (len(before) and strain[-1] > 0.0 and largest > 0.0):
        return False
    return bool(stress[-1] - stress[before[-1]] > _STANDS * largest)


def plateau_stress(curve: Curve) -> float:
    """Return the mean axial stress of the plateau that ended a test [Pa], from the last rows."""
    strain = curve["axial_strain"]
    return float(np.mean(curve["axial_stress"][strain >= strain[-1] - PLATEAU_STRAIN]))


def until_regained(curve: Curve) -> Curve:
    """Return the record until the stress regains a peak from which it had dropped by 10 %.

    A disc that has split may carry more than before: its strength is the peak at which it split.
    Drops below a fifth of the largest stress, while plates come into contact, do not count.
    """
    stress = differential_stress(curve)
    if len(stress) == 0 or not np.all(np.isfinite(stress)):
        return curve
    largest = np.maximum.accumulate(stress)
    fallen = (stress <= (1.0 - PEAK_DROP) * largest) & (largest >= _SEATED * largest[-1])
    first = int(np.argmax(fallen))
    regained = np.flatnonzero(fallen[first] & (stress[first:] > largest[first]))
    return curve.until(first + int(regained[0])) if len(regained) else curve


def regained_peak(curve: Curve) -> float | None:
    """Axial stress of the first peak that has been left by 10 % and regained [Pa]; None without."""
    first = until_regained(curve)
    return None if len(first) == len(curve) else float(np.max(first["axial_stress"]))


def elastic_rows(curve: Curve) -> slice:
    """Rows of the loading branch between 5 and 25 % of the largest stress."""
    stress = differential_stress(curve)
    if len(stress) == 0 or not np.nanmax(stress, initial=0.0) > 0.0:
        return slice(0, 0)
    low, high = (fraction * np.nanmax(stress) for fraction in ELASTIC_WINDOW)
    end = int(np.argmax(stress > high))  # the first row above the window
    below = np.flatnonzero(stress[:end] < low)
    return slice(int(below[-1]) + 1 if len(below) else 0, end)


def youngs_modulus(curve: Curve) -> float | None:
    """Slope of stress over axial strain in the elastic window [Pa], by least squares."""
    rows = elastic_rows(curve)
    return _slope(curve["axial_strain"][rows], differential_stress(curve)[rows])


def poissons_ratio(curve: Curve) -> float | None:
    """Slope of lateral over axial strain in the elastic window [-], by least squares."""
    rows = elastic_rows(curve)
    return _slope(curve["axial_strain"][rows], curve["lateral_strain"][rows])


def elastic_poissons_ratio(curve: Curve) -> float | None:
    """Return the same slope before the first point softens, up to 25 % of the largest stress [-].

    Softening can begin below 5 % of the peak, so rows count from the first row on.
    """
    softened = np.flatnonzero(curve["damage_energy"] > 0.0)
    end = elastic_rows(curve).stop
    rows = slice(0, min(end, int(softened[0])) if len(softened) else end)
    return _slope(curve["axial_strain"][rows], curve["lateral_strain"][rows])


def start_moduli(curve: Curve) -> tuple[float | None, float | None]:
    """Young's modulus [Pa] and Poisson's ratio [-] between the first two rows.

    For tests that begin with the motion of the elastic solution, before contact points soften.
    """
    strain = curve["axial_strain"][:2]
    stress, lateral = differential_stress(curve)[:2], curve["lateral_strain"][:2]
    return _slope(strain, stress, fewest=2), _slope(strain, lateral, fewest=2)


def softening_slope(curve: Curve) -> float | None:
    """Slope of stress over strain from the peak to half of it, or to the end [Pa]."""
    peak = peak_row(curve)
    if peak is None:
        return None
    stress = differential_stress(curve)
    fallen = np.flatnonzero(stress[peak:] <= 0.5 * stress[peak])
    rows = slice(peak, peak + int(fallen[0]) + 1 if len(fallen) else len(stress))
    return _slope(curve["axial_strain"][rows], stress[rows], fewest=2)


def tangent_modulus_ratio(curve: Curve) -> float | None:
    """Tangent modulus around 80 % of the peak over that around 20 % [-], by least squares.

    1 is a straight line up to there; the paper's two slopes (Fig. 9) give less.
    """
    peak = peak_row(curve)
    if peak is None:
        return None
    strain, stress = curve["axial_strain"][: peak + 1], differential_stress(curve)[: peak + 1]
    moduli = []
    for low, high in (_EARLY, _LATE):
        rows = (stress >= low * stress[-1]) & (stress <= high * stress[-1])
        moduli.append(_slope(strain[rows], stress[rows]))
    early, late = moduli
    return late / early if early and late is not None else None


def softening_onset(curve: Curve) -> float | None:
    """Return the ratio to the peak stress at which the first point leaves its elastic branch [-].

    A point dissipates nothing on that branch, to the last bit, and dissipates in any step beyond
    it. The onset is therefore the first row whose damage energy is > 0. Both stresses exceed the
    confining pressure; 0 if points have softened before the loading. None without a peak.
    """
    peak = peak_row(curve)
    if peak is None:
        return None
    softened = np.flatnonzero(curve["damage_energy"][: peak + 1] > 0.0)
    if len(softened) == 0:
        return None
    stress = differential_stress(curve)
    return max(float(stress[softened[0]] / stress[peak]), 0.0)


def crack_onset(
    curve: Curve, steps: Sequence[int], share: float = ONSET_SHARE
) -> tuple[float | None, float | None]:
    """Axial strain [-] and stress [Pa] at which a share of the cracks were there.

    Args:
        curve: The record; values between its rows are interpolated in the step.
        steps: Step of each crack, in any order.
        share: Share of the cracks [-]; the first one counts at least, so 0 is the first crack.

    Returns:
        Strain and stress; None for both without a crack or a record.
    """
    if len(steps) == 0 or len(curve) == 0:
        return None, None
    number = max(1, math.ceil(share * len(steps)))
    step = np.sort(np.asarray(steps))[number - 1]
    strain, stress = (
        float(np.interp(step, curve["step"], curve[name]))
        for name in ("axial_strain", "axial_stress")
    )
    return strain, stress


def growth_before_peak(curve: Curve, crossing: float) -> float | None:
    """Growth of the stress while a wave last crossed the specimen before its peak [-], over it.

    So much the ends may bear more than the specimen does, which softens before they know. None
    where the stress still grows, or has just ceased to, and where nothing softens or slides as it
    turns: the load was taken back.

    Args:
        curve: The record.
        crossing: Steps in which a wave crosses the specimen.
    """
    stress, steps = differential_stress(curve), curve["step"]
    if len(stress) == 0 or not np.nanmax(stress, initial=0.0) > 0.0:
        return None
    peak = int(np.nanargmax(stress))
    if peak_row(curve) is None and steps[-1] - steps[peak] < crossing:
        return None
    around = steps[peak] + crossing * np.array([-1.0, 1.0])
    lost = np.interp(around, steps, curve["damage_energy"] + curve["friction_energy"])
    if not lost[1] > lost[0]:
        return None
    before = np.interp(around[0], steps, stress)
    return float(1.0 - before / stress[peak])


def energy_error(curve: Curve, initial: float | None = None) -> float | None:
    """Largest |work + initial energy - sum of the energies| over the largest |work| [-].

    Without work, as of a pulse that goes through a specimen, over the initial energy.

    Args:
        curve: The record.
        initial: Energy when the work began to count [J]; if None, as the first row has it.
    """
    work = curve["boundary_work"]
    total = np.sum([curve[name] for name in ENERGIES], axis=0)
    if len(work) == 0 or not np.all(np.isfinite(total + work)):
        return None
    largest = np.max(np.abs(work)) or abs(initial or 0.0)
    if not largest > 0.0:
        return None
    if initial is None:
        initial = total[0] - work[0]
    return float(np.max(np.abs(work + initial - total)) / largest)


def set_point_missed(curve: Curve, measure: str) -> float:
    """Part of the rows under control in which a measure is off its set point [-].

    Args:
        curve: The record, with a ``set_point``.
        measure: Column that was to follow it.
    """
    if "set_point" not in curve.columns:
        return 0.0
    wanted, there = curve["set_point"], curve[measure]
    rows = np.isfinite(wanted) & (wanted != 0.0)
    off = np.abs(there[rows] - wanted[rows]) > SET_POINT_OFF * np.abs(wanted[rows])
    return float(np.mean(off)) if len(off) else 0.0


def kinetic_shares(curve: Curve) -> dict[str, float]:
    """Return the ratios of kinetic energy to |boundary work| [-] at the peak and at the end.

    A ratio is left out if there is no peak, no work, or no record of the energies.
    """
    if not len(curve):
        return {}
    pressed = curve["confinement"][-1] > 0.0
    end = "at the end under a pressure" if pressed else "at the end"
    rows = {"at the peak": peak_row(curve), end: len(curve) - 1}
    shares = {}
    for place, row in rows.items():
        work = 0.0 if row is None else abs(float(curve["boundary_work"][row]))
        if work > 0.0:  # not where it is nan
            shares[place] = float(curve["kinetic_energy"][row]) / work
    return shares


def unbalanced_ratio(curve: Curve) -> float | None:
    """Return the largest unbalanced-force ratio from 5 % of the peak up to the peak [-].

    Below 5 % the contact forces, to which the ratio refers, are too small. Each crack unbalances
    its two grains for a moment at any loading rate, so this ratio measures how violently bonds
    break; `median_unbalanced_ratio` follows the rate.
    """
    return _while_loaded(curve, curve["unbalanced_ratio"], np.nanmax)


def median_unbalanced_ratio(curve: Curve) -> float | None:
    """Return the median unbalanced-force ratio over the same rows [-]; proportional to the rate.

    Rows at a faster rate count with the ratio at the slowest rate: the rate is faster where it does
    not matter. Rows of a preload, in which no node is free, do not count.
    """
    ratio = np.where(curve["unbalanced_ratio"] > 0.0, curve["unbalanced_ratio"], np.nan)
    return _while_loaded(curve, ratio / _faster(curve), np.nanmedian)


def unbalanced_under_way(curve: Curve) -> float | None:
    """Return the unbalanced-force ratio that a fifth of the loading up to the peak exceeds [-].

    For crack-controlled loadings: rows are weighted by their loading rate. Rows of a preload, in
    which no node is free, do not count.
    """
    rates = np.where(curve["unbalanced_ratio"] > 0.0, curve["velocity_factor"], 0.0)

    def quantile(rows: FloatArray) -> float:
        order = np.argsort(rows[:, 0])
        ratio, done = rows[order, 0], np.cumsum(rows[order, 1])
        return float(ratio[np.searchsorted(done, _UNDER_WAY * done[-1])])

    return _while_loaded(curve, np.column_stack((curve["unbalanced_ratio"], rates)), quantile)


def rows_while_loaded(curve: Curve) -> int:
    """Number of rows from 5 % of the largest stress up to it, by which a rate is judged."""
    number = _while_loaded(curve, np.ones(len(curve)), np.sum)
    return 0 if number is None else round(number)


def end_mismatch(curve: Curve) -> float | None:
    """Return the largest relative difference of both ends' reactions over the same rows [-]."""
    return _while_loaded(curve, curve["end_mismatch"], np.nanmax)


def median_end_mismatch(curve: Curve) -> float | None:
    """Median of the same differences [-]; rows at a faster rate count as in the median ratio."""
    return _while_loaded(curve, curve["end_mismatch"] / _faster(curve), np.nanmedian)


def _faster(curve: Curve) -> FloatArray:
    """Rate over the slowest, or 1 where a loading that waits for cracks is slower [-]."""
    return np.maximum(curve["velocity_factor"], 1.0)


def _while_loaded(
    curve: Curve, column: FloatArray, of: Callable[[FloatArray], float]
) -> float | None:
    """A number from the rows of a column from 5 % of the peak up to the peak."""
    stress = differential_stress(curve)
    if len(stress) == 0 or not np.nanmax(stress, initial=0.0) > 0.0:
        return None
    peak = int(np.nanargmax(stress))
    start = int(np.argmax(stress >= ELASTIC_WINDOW[0] * stress[peak]))
    values = column[start : peak + 1]
    return float(of(values)) if np.any(np.isfinite(values)) else None


def _slope(x: FloatArray, y: FloatArray, fewest: int = 3) -> float | None:
    """Least-squares slope of y over x, or None for too few or coincident points."""
    if len(x) < fewest or not np.all(np.isfinite(x) & np.isfinite(y)):
        return None
    centred = x - np.mean(x)
    spread = float(centred @ centred)
    return float(centred @ (y - np.mean(y))) / spread if spread > 0.0 else None
