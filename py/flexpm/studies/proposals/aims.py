# SPDX-License-Identifier: GPL-3.0-or-later
"""Targets of a calibration from the measures that decide on a rock. SI units, degrees."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ...kinds.registry import KINDS
from ..calibration_problem import Target
from ..scorecards.measures import ENVELOPES, MEASURES, NOTCHED, PRESSURES
from ..scorecards.rock import Entry, Rock

#: Target of the toughness of a notched half disc.
TOUGHNESS = next(
    name
    for kind in KINDS.values()
    for name, key in kind.calibrates.items()
    if (kind.scored, key) == (NOTCHED, "fracture_toughness")
)
#: Measures of a scorecard that are targets under the same or another name.
_TARGETS = {
    **{
        name: name
        for name in (
            *("youngs_modulus", "poissons_ratio", "compressive_strength"),
            *("indirect_tensile_strength", "direct_tensile_strength", "direct_indirect_ratio"),
            *("crack_initiation", "crack_damage"),
        )
    },
    "fracture_toughness": TOUGHNESS,
}
#: Measures of envelopes with their target and the percentages of their pressures; a calibration has
#: one envelope, that of the first of them that decides.
_ENVELOPES = {
    **{
        f"{measure}_{name}": (measure, percents)
        for name, percents in ENVELOPES.items()
        for measure in ("cohesion", "friction_angle")
    },
    "hoek_brown_m": ("hoek_brown_m", tuple(PRESSURES)),
}
_PEAK, _DROP = "peak_ratio", "drop"
#: Tolerance of a least drop, and of a band that is open at both ends [-].
_TOLERANCE = 0.05
#: Digits of pressures and targets.
_DIGITS = 4


@dataclass(frozen=True)
class Aim:
    """A target, and the measure of a scorecard that it follows from."""

    target: Target
    measure: str
    measured: float  #: value of this measure in the rock


@dataclass(frozen=True)
class Aims:
    """Targets of a rock.

    Attributes:
        found: The targets.
        confinements: Confining pressures of the envelope [Pa]; empty without an envelope.
        left_out: Measures that decide and are no targets, each with its reason.
    """

    found: list[Aim] = field(default_factory=list)
    confinements: tuple[float, ...] = ()
    left_out: list[str] = field(default_factory=list)


def rounded(value: float) -> float:
    """Return a number with the digits of a calibration file."""
    return float(f"{value:.{_DIGITS}g}")


def of_rock(rock: Rock) -> Aims:
    """Return the targets of the measures that decide.

    The tolerance is the distance of the nearer bound of the band from the value. Peaks under
    pressure are targets in Pa, drops have their lower bound as the least value.
    """
    deciding = {name: one for name in MEASURES if (one := _deciding(rock, name)) is not None}
    envelope = next((_ENVELOPES[name][1] for name in deciding if name in _ENVELOPES), ())
    pressures = (0.0, *(_pressure(rock, percent) for percent in envelope)) if envelope else ()
    aims = Aims(confinements=pressures)
    for name, entry in deciding.items():
        told = [*_aims_of(rock, name, entry, envelope, {*deciding})]
        aims.found.extend(one for one in told if isinstance(one, Aim))
        aims.left_out.extend(one for one in told if isinstance(one, str))
    return aims


def _deciding(rock: Rock, name: str) -> Entry | None:
    entry = rock.entries.get(name)
    return entry if entry is not None and entry.decides and entry.value is not None else None


def _aims_of(
    rock: Rock, name: str, entry: Entry, envelope: tuple[int, ...], deciding: set[str]
) -> Iterator[Aim | str]:
    """Yield the target of a measure, or why it has none."""
    assert entry.value is not None
    value = entry.value
    if value == 0.0:
        yield f"{name} (0 has no relative tolerance)"
        return
    tolerance = _tolerance(entry)
    measure, _, percent = name.rpartition("_")
    if name in _TARGETS:
        yield Aim(Target(_TARGETS[name], rounded(value), tolerance), name, value)
    elif name in _ENVELOPES and _ENVELOPES[name][1] == envelope:
        yield Aim(Target(_ENVELOPES[name][0], rounded(value), tolerance), name, value)
    elif name in _ENVELOPES:
        yield f"{name} (a calibration has one envelope)"
    elif measure == _PEAK:
        strength = rounded(value * rock.compressive_strength)
        pressure = _pressure(rock, int(percent))
        yield Aim(Target("peak", strength, tolerance, pressure=pressure), name, value)
    elif measure == _DROP:
        least = value if entry.band.lower is None else entry.band.lower
        if least <= 0.0:
            yield f"{name} (its lower bound is met by any drop)"
            return
        # a target counts as met within its tolerance, and the bound of the rock has none
        least = rounded(least / (1.0 - _TOLERANCE))
        pressure = _pressure(rock, int(percent))
        yield Aim(Target("drop", least, _TOLERANCE, pressure=pressure), name, least)
    elif name == "compressive_indirect_ratio":
        if not deciding.issuperset({"indirect_tensile_strength", "compressive_strength"}):
            yield f"{name} (let compressive and indirect tensile strength decide)"
        # else it follows from two targets
    else:
        yield f"{name} (no target of calibrations)"


def _pressure(rock: Rock, percent: int) -> float:
    """Confining pressure of a percentage of the strength, as a scorecard has it [Pa]."""
    return rounded(PRESSURES[percent] * rock.compressive_strength)


def _tolerance(entry: Entry) -> float:
    """Relative distance of the nearer bound of a band from the value [-].

    A value on its bound has the default tolerance.
    """
    value = entry.value
    assert value is not None
    ends = [abs(one / value - 1.0) for one in (entry.band.lower, entry.band.upper) if one]
    nearest = min(ends, default=_TOLERANCE) or _TOLERANCE
    return float(f"{nearest:.2g}")
