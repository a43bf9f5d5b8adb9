# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of a scorecard: the runs that they need, and how they follow from results. SI units.

Angles are in degrees. Each measure is a pure function of the results of a packing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

from ...errors import InputError
from ...files import Table
from ...kinds.registry import kind_of
from ...require import POSITIVE, Bounds
from ...results import descent, doubts
from ...results.result import Result
from ..calibration_measures import of_envelope

#: Runs of a packing by their names; the roles of their tests are in ``kinds``.
SOLVED, COMPRESSED, CONTROLLED = "solved", "compressed", "controlled"
PULLED, SPLIT, NOTCHED = "pulled", "split", "notched"
#: Confining pressures over the compressive strength of the rock [-], by the percentage that names
#: their runs and measures.
PRESSURES = {3: 0.03, 10: 0.1, 30: 0.3, 50: 0.5}
#: Percentages of the peak at which the secant Poisson's ratio is read.
SECANTS = (25, 50, 90)
#: Pressures of an envelope by its name: from 0 up to these percentages.
ENVELOPES = {"low": (3,), "wide": (3, 10)}
#: Reasons of numbers that the results do not yield.
ENDS_EARLY, NO_CRITERION, NO_ANGLE = "ends early", "no criterion fits", "D <= 0"


def confined(percent: int) -> str:
    """Name of the run under a percentage of the compressive strength."""
    return f"confined_{percent}"


@dataclass(frozen=True)
class Ended:
    """One run of a packing that has ended.

    Attributes:
        result: Its result, or None: of the direct solve, or of a run that failed.
        numbers: Numbers of its result.json.
        message: Why it failed; empty if it did not.
    """

    result: Result | None = None
    numbers: Table = field(default_factory=dict)
    message: str = ""


#: Runs of a packing by name.
Runs = Mapping[str, Ended]


@dataclass(frozen=True)
class Value:
    """A measure of a packing.

    Attributes:
        number: The measure; None: the runs do not yield it.
        reason: Why it does not count; empty: it counts.
    """

    number: float | None
    reason: str = ""


@dataclass(frozen=True)
class Measure:
    """A row of a scorecard."""

    name: str
    words: str
    unit: str  #: ``Pa``, ``Pa m^0.5``, ``degrees`` or ``-``
    runs: tuple[str, ...]  #: whose status decides whether the measure counts
    of: Callable[[Runs, bool], float | str | None]  #: runs, and whether 3D; a text: a reason
    about: str  #: for the manual
    bounds: Bounds = POSITIVE  #: of values in a rock file
    needs_peak: bool = True  #: does not count for a run without a peak
    after_peak: bool = False  #: does not count where grains overlap
    needs_size: bool = False  #: does not count on small specimens
    reason_key: str = ""  #: key of ``null_reasons`` of the first run

    def measured(self, runs: Runs, *, solid: bool) -> Value:
        """Return the measure of a packing, or why it has none.

        Args:
            runs: Results of the packing.
            solid: Whether they are 3D.
        """
        used = [runs.get(name, Ended(message="missing")) for name in self.runs]
        if any(one.message and one.result is None for one in used):
            return Value(None, "run failed")
        found = self.of(runs, solid)
        number, missing = (None, found) if isinstance(found, str) else (found, "")
        results = [one.result for one in used if one.result is not None]
        for reason in self._flaws(results, solid=solid):
            return Value(number, reason)
        return Value(number, "" if number is not None else missing or self._missing(results))

    def _flaws(self, results: Sequence[Result], *, solid: bool) -> Iterator[str]:
        """Reasons why a number of these results does not count."""
        statuses = [one.status for one in results]
        if "diverged" in statuses:
            yield "diverged"
        if self.needs_peak and any(one.peak_stress is None for one in results):
            yield "no peak"
        if "not_quasistatic" in statuses:
            yield "not quasi-static"
        overlaps = [one.largest_clearance or 0.0 for one in results]
        if solid and self.after_peak and max(overlaps, default=0.0) > doubts.LARGEST_CLEARANCE:
            yield "overlap"
        for one in results:
            splits = kind_of(one.test).splits
            if doubts.of_first_cracks(one.first_crack_distance, None, None, notched=not splits):
                yield f"first cracks {'at the plates' if splits else 'far from the notch'}"

    def _missing(self, results: Sequence[Result]) -> str:
        """Reason of a missing number."""
        for one in results:
            if self.reason_key and (why := (one.null_reasons or {}).get(self.reason_key)):
                return str(why)
        return ENDS_EARLY if self.after_peak else "not reached"


def _result(runs: Runs, name: str) -> Result | None:
    return runs.get(name, Ended()).result


def _number(name: str, key: str, runs: Runs, _: bool = False) -> float | None:
    """Return a number of result.json."""
    value = runs.get(name, Ended()).numbers.get(key)
    return value if isinstance(value, int | float) and not isinstance(value, bool) else None


def _quotient(first: tuple[str, str], second: tuple[str, str], runs: Runs, _: bool) -> float | None:
    """Return the quotient of two numbers; None if either is missing."""
    above, below = _number(*first, runs), _number(*second, runs)
    return above / below if above is not None and below else None


def _secant(percent: int, runs: Runs, _: bool) -> float | None:
    result = _result(runs, COMPRESSED)
    return None if result is None else descent.secant_poissons_ratio(result.curve, 0.01 * percent)


def _tensile_share(runs: Runs, _: bool) -> float | None:
    result = _result(runs, COMPRESSED)
    return None if result is None else descent.tensile_share(result.curve)


def _is_class_two(runs: Runs, _: bool) -> float | None:
    """Return 1 for a class II curve, whose stress and strain fall together, else 0."""
    slope = _number(CONTROLLED, "softening_slope", runs)
    return None if slope is None else float(slope > 0.0)


def _peaks(percents: Sequence[int], runs: Runs) -> tuple[list[float], list[float]] | None:
    """Return confining pressures and peaks [Pa], from 0 on; None if one is missing."""
    pressures, peaks = [0.0], [_number(COMPRESSED, "peak_stress", runs)]
    for percent in percents:
        result = _result(runs, confined(percent))
        pressure = None if result is None else (result.inputs or {}).get("confinement")
        pressures.append(float(pressure if pressure is not None else 0.0))
        peaks.append(None if result is None else result.peak_stress)
    known = [peak for peak in peaks if peak is not None]
    return (pressures, known) if len(known) == len(peaks) else None


def _constant(name: str, percents: Sequence[int], runs: Runs, _: bool) -> float | str | None:
    """Return a constant of the envelope through the peaks at 0 and at some pressures."""
    found = _peaks(percents, runs)
    try:
        return None if found is None else of_envelope(name, *found)
    except InputError:
        return NO_CRITERION


def _peak_ratio(percent: int, runs: Runs, _: bool) -> float | None:
    return _quotient((confined(percent), "peak_stress"), (COMPRESSED, "peak_stress"), runs, False)


def _drop(percent: int, runs: Runs, _: bool) -> float | None:
    result = _result(runs, confined(percent))
    return None if result is None else descent.drop_after_peak(result.curve)


def _dilation(percent: int, runs: Runs, solid: bool) -> float | None:
    result = _result(runs, confined(percent))
    return None if result is None else descent.dilation_after_peak(result.curve, solid=solid)


def _dilation_angle(percent: int, runs: Runs, solid: bool) -> float | str | None:
    found = _dilation(percent, runs, solid)
    if found is None:
        return None
    return descent.dilation_angle(found) if found > 0.0 else NO_ANGLE


_STRESS = Bounds(at_least=1e4, at_most=1e12)
_SHARE = Bounds(at_least=0.0, at_most=1.0)
_ANGLE = Bounds(at_least=-90.0, below=90.0)
_RATIO = Bounds(at_least=0.0, at_most=1e3)


def _initiation(name: str, words: str, about: str) -> Measure:
    """A threshold of the compressed specimen over its strength."""
    return Measure(
        *(name, words, "-", (COMPRESSED,)),
        partial(_quotient, (COMPRESSED, about), (COMPRESSED, "peak_stress")),
        f"``{about}`` over the compressive strength",
        _SHARE,
        reason_key=about,
    )


def _peak(name: str, words: str, run: str, about: str, *, needs_size: bool = False) -> Measure:
    """A strength: the peak of one run."""
    of = partial(_number, run, "peak_stress")
    return Measure(name, words, "Pa", (run,), of, about, _STRESS, needs_size=needs_size)


def _under_pressure(percent: int) -> list[Measure]:
    """Measures of the run under a percentage of the compressive strength."""
    share, run = f"{PRESSURES[percent]:g}", confined(percent)
    past_the_peak = (
        (
            *("drop", "-", _drop, _SHARE),
            "part of the largest deviator that is lost within 0.5 % of axial strain after it",
        ),
        (
            *("dilation", "-", _dilation, Bounds(at_least=-1e3, at_most=1e3)),
            "D = 1 - dV/de over 0.5 % of axial strain after the largest deviator",
        ),
        (
            *("dilation angle", "degrees", _dilation_angle, _ANGLE),
            "psi with sin psi = (D - 1)/(D + 1)",
        ),
    )
    return [
        Measure(
            f"peak_ratio_{percent}",
            f"peak over strength at {share}",
            "-",
            (run, COMPRESSED),
            partial(_peak_ratio, percent),
            "axial stress at the peak over the compressive strength of the same packing",
            _RATIO,
        ),
        *(
            Measure(
                f"{words.replace(' ', '_')}_{percent}",
                f"{words} at {share}",
                unit,
                (run,),
                partial(of, percent),
                about,
                bounds,
                needs_peak=False,
                after_peak=True,
            )
            for words, unit, of, bounds, about in past_the_peak
        ),
    ]


def _of_envelope(name: str, percents: Sequence[int]) -> list[Measure]:
    """Cohesion and friction angle of the line through some of the peaks."""
    top = f"{PRESSURES[percents[-1]]:g}"
    runs = (COMPRESSED, *map(confined, percents))
    about = f"line through the peaks at 0 to {top} of the compressive strength"
    return [
        Measure(
            *(f"cohesion_{name}", f"cohesion, 0 to {top}", "Pa", runs),
            partial(_constant, "cohesion", percents),
            about,
            _STRESS,
        ),
        Measure(
            *(f"friction_angle_{name}", f"friction angle, 0 to {top}", "degrees", runs),
            partial(_constant, "friction_angle", percents),
            about,
            Bounds(at_least=0.0, below=90.0),
        ),
    ]


_ALL = (
    Measure(
        *("youngs_modulus", "Young's modulus", "Pa", (SOLVED,)),
        partial(_number, SOLVED, "youngs_modulus"),
        "direct solve",
        _STRESS,
    ),
    Measure(
        *("poissons_ratio", "Poisson's ratio", "-", (SOLVED,)),
        partial(_number, SOLVED, "poissons_ratio"),
        "direct solve",
        Bounds(above=-1.0, at_most=1.0),
    ),
    _peak(
        "compressive_strength",
        "compressive strength",
        COMPRESSED,
        "peak without confining pressure",
    ),
    _initiation("crack_initiation", "crack initiation by cracks", "crack_initiation_stress"),
    _initiation(
        "crack_initiation_volumetric",
        "crack initiation by volume",
        "crack_initiation_stress_volumetric",
    ),
    _initiation("crack_damage", "crack damage", "crack_damage_stress"),
    *(
        Measure(
            *(f"secant_poissons_ratio_{percent}", f"secant Poisson's ratio at {percent} %"),
            *("-", (COMPRESSED,)),
            partial(_secant, percent),
            f"lateral over axial strain when the stress first reaches {percent} % of the peak",
            Bounds(above=-1.0, at_most=10.0),
        )
        for percent in SECANTS
    ),
    Measure(
        *("tensile_share", "share of tensile cracks", "-", (COMPRESSED,)),
        _tensile_share,
        "tensile cracks over all cracks up to the peak",
        _SHARE,
    ),
    Measure(
        *("class_two", "class II", "-", (CONTROLLED,)),
        _is_class_two,
        "1 if axial stress and strain decrease together after the peak under control of the "
        "lateral strain, else 0; the mean is the share of such packings",
        _SHARE,
        after_peak=True,
    ),
    _peak(
        "direct_tensile_strength",
        "direct tensile strength",
        PULLED,
        "peak in direct tension",
    ),
    _peak(
        "indirect_tensile_strength",
        "indirect tensile strength",
        SPLIT,
        "peak of the disc; in 3D between jaws of 1.5 times its radius",
        needs_size=True,
    ),
    Measure(
        *("direct_indirect_ratio", "direct / indirect tension", "-", (PULLED, SPLIT)),
        partial(_quotient, (PULLED, "peak_stress"), (SPLIT, "peak_stress")),
        "direct over indirect tensile strength",
        _RATIO,
        needs_size=True,
    ),
    Measure(
        *("compressive_indirect_ratio", "compression / indirect tension", "-"),
        (COMPRESSED, SPLIT),
        partial(_quotient, (COMPRESSED, "peak_stress"), (SPLIT, "peak_stress")),
        "compressive over indirect tensile strength",
        _RATIO,
        needs_size=True,
    ),
    Measure(
        *("fracture_toughness", "fracture toughness", "Pa m^0.5", (NOTCHED,)),
        partial(_number, NOTCHED, "fracture_toughness"),
        "half disc with a notch",
        Bounds(at_least=1e3, at_most=1e9),
        needs_size=True,
    ),
    *(one for name, percents in ENVELOPES.items() for one in _of_envelope(name, percents)),
    Measure(
        *("hoek_brown_m", "Hoek-Brown m_i", "-"),
        (COMPRESSED, *map(confined, PRESSURES)),
        partial(_constant, "hoek_brown_m", tuple(PRESSURES)),
        "curve through all peaks",
        _RATIO,
    ),
    *(one for percent in PRESSURES for one in _under_pressure(percent)),
)
#: All measures by name, in the order of their rows.
MEASURES = {one.name: one for one in _ALL}
