# SPDX-License-Identifier: GPL-3.0-or-later
"""Assessment of a calibration: remedies for missed targets, and undetermined keys.

How measures follow keys is read from the sets that were tried, as a plane through logarithms.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import numpy as np

from ..arrays import FloatArray
from ..files import Table, json_text, write_text

#: Name of the file in the folder of a calibration.
FILE = "verdict.json"
#: A key is at a bound within this part of the logarithm of its range [-].
_AT_BOUND = 0.01
#: A key stays open if the targets leave it more than this part of the scatter in its bounds [-],
#: that is half of the variance.
_OPEN = 0.5**0.5
#: No key moves a measure if twice each of them changes it by less than this [-].
_IDLE = 0.02


class Aim(Protocol):
    """A target."""

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def value(self) -> float: ...  # noqa: D102
    @property
    def tolerance(self) -> float: ...  # noqa: D102
    @property
    def least(self) -> bool: ...  # noqa: D102


class Tried(Protocol):
    """A set of values that was tried, with the means of its measures."""

    @property
    def values(self) -> Mapping[str, float]: ...  # noqa: D102
    @property
    def lost(self) -> Mapping[str, str]: ...  # noqa: D102
    def mean(self, name: str) -> float | None: ...  # noqa: D102
    def error(self, name: str) -> float | None: ...  # noqa: D102


@dataclass(frozen=True)
class Verdict:
    """How a calibration ended."""

    missed: list[str]  #: targets that are not met
    advice: list[str]  #: what to try, a line each
    #: by key the part of the scatter within its bounds that the targets leave it [-]
    left: dict[str, float] = field(default_factory=dict)
    #: by target: name, value, tolerance, mean, error, met, and what to change
    measures: list[Table] = field(default_factory=list)

    @property
    def open_keys(self) -> list[str]:
        """Free keys that the targets do not determine."""
        return [key for key, share in self.left.items() if share > _OPEN]

    def lines(self) -> list[str]:
        """All of it for a terminal."""
        return [*self.advice, *_of_open(self.open_keys)]

    def write(self, folder: Path) -> None:
        """Write ``verdict.json``, which the page is made from."""
        content = {
            "missed": self.missed,
            "advice": self.lines(),
            "left": self.left,
            "measures": self.measures,
        }
        write_text(folder / FILE, json_text(content))


def forget(folder: Path) -> None:
    """Remove the verdict of an earlier calibration."""
    (folder / FILE).unlink(missing_ok=True)


def slopes(tried: Sequence[Tried], keys: Sequence[str], aims: Sequence[Aim]) -> FloatArray:
    """Change of ln(measure) with ln(key) (targets, keys) [-], 0 where nothing was tried.

    Args:
        tried: Sets of values; a set without a measure tells nothing about that measure.
        keys: Free keys.
        aims: Targets.
    """
    found = np.zeros((len(aims), len(keys)))
    for row, aim in enumerate(aims):
        whole = _with_measure(tried, aim)
        if len(whole) < 2:
            continue
        x = np.log([[one.values[key] for key in keys] for one, _ in whole])
        y = np.log([mean for _, mean in whole])
        found[row] = np.linalg.lstsq(x - x.mean(axis=0), y - y.mean(), rcond=1e-6)[0]
    return found


def _with_measure(tried: Sequence[Tried], aim: Aim) -> list[tuple[Tried, float]]:
    """Return the sets of values for which the mean of a measure exists."""
    means = [(one, one.mean(aim.name)) for one in tried]
    return [(one, mean) for one, mean in means if mean is not None and mean > 0.0]


def left_open(
    slope: FloatArray, keys: Sequence[str], free: Mapping[str, tuple[float, float]], aims: list[Aim]
) -> dict[str, float]:
    """Part of the scatter of each key within its bounds that the targets leave [-].

    Logarithms of keys are taken as even within their bounds, targets as known to their tolerances;
    the standard deviation that is left follows by linear least squares.

    Args:
        slope: What ``slopes`` gives.
        keys: Free keys.
        free: Their bounds.
        aims: Targets.
    """
    scatter = np.array([math.log(free[key][1] / free[key][0]) for key in keys]) / math.sqrt(12.0)
    told = slope * scatter / np.array([[aim.tolerance] for aim in aims])
    covariance = np.linalg.inv(told.T @ told + np.eye(len(keys)))
    shares = np.sqrt(np.diag(covariance))
    return dict(zip(keys, shares.tolist(), strict=True))


def advice(
    missed: Sequence[Aim],
    best: Tried,
    slope: Mapping[str, Mapping[str, float]],
    free: Mapping[str, tuple[float, float]],
    *,
    used_up: bool,
    losses: Mapping[str, str] | None = None,
) -> list[str]:
    """Return a remedy for each reason why targets are missed.

    Args:
        missed: Targets that are missed.
        best: The set that was taken.
        slope: Change of ln(measure) with ln(key), by target and key [-].
        free: Bounds of the keys.
        used_up: Whether the search has ended with its evaluations.
        losses: By target, the sets of the search without its measure, as a text.
    """
    lines = []
    for aim in missed:
        mean, error = best.mean(aim.name), best.error(aim.name)
        if mean is None:
            why = best.lost.get(aim.name, "see history.csv and the messages in runs")
            lines.append(f"{aim.name}: not measured, {why}")
            continue
        if losses and aim.name in losses:
            lines.append(f"{aim.name}: {losses[aim.name]}")
            continue
        of_key = slope.get(aim.name, {})
        moving = [key for key, one in of_key.items() if abs(2.0**one - 1.0) >= _IDLE]
        wanted = math.copysign(1.0, aim.value - mean)
        stuck = [
            key for key in moving if _is_stuck(best.values[key], free[key], wanted, of_key[key])
        ]
        for key in stuck:
            low, high = free[key]
            side, bound = ("upper", high) if wanted * of_key[key] > 0.0 else ("lower", low)
            lines.append(
                f"{aim.name}: {key} = {best.values[key]:.4g} is at its {side} bound {bound:g}; "
                f"widen [free] {key}"
            )
        if of_key and not moving:
            lines.append(f"{aim.name}: no free key moves it; free another one, or drop the target")
        elif error is not None and error > abs(aim.value - mean):
            lines.append(
                f"{aim.name}: missed by less than the error of its mean, {error:.2g}; take more "
                "seeds in [verify]"
            )
        elif not stuck:
            lines.append(
                f"{aim.name}: raise evaluations, all were used"
                if used_up
                else f"{aim.name}: set against other targets; free another key, raise rounds or "
                "its tolerance, or give it more weight"
            )
    return list(dict.fromkeys(lines))


def _is_stuck(value: float, bounds: tuple[float, float], wanted: float, slope: float) -> bool:
    """Whether a key is at the bound beyond which the measure would come nearer."""
    low, high = (math.log(one) for one in bounds)
    place = (math.log(value) - low) / (high - low)
    return place > 1.0 - _AT_BOUND if wanted * slope > 0.0 else place < _AT_BOUND


def _of_open(keys: Sequence[str]) -> list[str]:
    if not keys:
        return []
    return [
        f"not determined by the targets: {', '.join(keys)}; leave one out of [free], narrow its "
        "bounds, or add a target that it moves"
    ]


def judge(
    aims: Sequence[Aim],
    free: Mapping[str, tuple[float, float]],
    parts: Sequence[tuple[Sequence[Tried], Sequence[str], Sequence[Aim]]],
    best: Tried,
    *,
    used_up: bool,
) -> Verdict:
    """Judge a calibration.

    Args:
        aims: All targets.
        free: Bounds of all free keys.
        parts: Searches that were made: sets that were tried, keys and targets of each.
        best: The set that was taken.
        used_up: Whether the last search has ended with its evaluations.
    """
    slope: dict[str, Table] = {}
    left: dict[str, float] = {}
    losses: dict[str, str] = {}
    for tried, keys, targets in parts:
        if not keys or not targets:
            continue
        found = slopes(tried, keys, targets)
        # a least value that is exceeded determines no key
        binding = [not (aim.least and is_met(aim, best.mean(aim.name))) for aim in targets]
        left |= left_open(found * np.array(binding)[:, None], keys, free, [*targets])
        rows = zip(targets, found.tolist(), strict=True)
        for aim, row in rows:  # both searches may have it
            if len(_with_measure(tried, aim)) > 1:
                slope.setdefault(aim.name, {}).update(zip(keys, row, strict=True))
        losses |= {aim.name: text for aim in targets if (text := _loss(tried, aim))}
    missed = [aim for aim in aims if not is_met(aim, best.mean(aim.name))]
    told = advice(missed, best, slope, free, used_up=used_up, losses=losses)
    measures = [_measure(aim, best, told) for aim in aims]
    return Verdict([aim.name for aim in missed], told, left, measures)


def _loss(tried: Sequence[Tried], aim: Aim) -> str:
    """Return a warning if most sets of a search had no value of a measure; else an empty text."""
    lost = [one for one in tried if one.mean(aim.name) is None]
    if 2 * len(lost) <= len(tried):
        return ""
    why = lost[-1].lost.get(aim.name, "see history.csv and the messages in runs")
    return f"the search measured it in {len(tried) - len(lost)} of {len(tried)} sets, {why}"


def _measure(aim: Aim, best: Tried, told: Sequence[str]) -> Table:
    """Return result and target of a measure, and a remedy."""
    mean, start = best.mean(aim.name), f"{aim.name}: "
    return {
        "name": aim.name,
        "target": aim.value,
        "tolerance": aim.tolerance,
        "least": aim.least,
        "mean": mean,
        "error": best.error(aim.name),
        "met": is_met(aim, mean),
        "advice": [line.removeprefix(start) for line in told if line.startswith(start)],
    }


def is_met(aim: Aim, mean: float | None) -> bool:
    """Whether a mean is within the tolerance of a target, or above a least value."""
    if mean is None:
        return False
    part = mean / aim.value - 1.0
    return (-part if aim.least else abs(part)) <= aim.tolerance
