# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading rate of tests, end of tests, and criterion of quasi-static results. SI units.

Values that depend on test and model are in ``kinds``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import InputError
from ..kinds.model_names import BLOCK_MODELS
from ..kinds.rates import Rates
from ..kinds.registry import KINDS, OWN, kind_of
from ..kinds.test_kind import PLATEAU_STRAIN, STOP_RATIO
from ..require import Bounds, require_flag, require_number, require_one_of, require_text
from .likely import BRITTLE, Softening, likely_transits, slowing

#: Factors on the default loading rate that a test may have [-].
RATE = Bounds(above=0.0, at_least=1e-12, at_most=1e12)
#: How often a rate may be halved: at the last one a test takes a month.
HALVING_BOUNDS = Bounds(at_least=1, at_most=20)
#: Largest strains of a loading [-]; 0 for one that ends where it is.
_STRAIN = Bounds(at_least=0.0, at_most=1e6)
#: The rate of an adaptive loading is up to this k while the specimen is elastic [-].
FASTEST_CONSTANT = 0.04
#: Models whose loading can wait for cracks, and follow a measure.
WAITING_MODELS = BLOCK_MODELS
#: Slowest rate of a loading that waits over its fastest [-].
SLOWEST_WAIT = 0.01
#: Wave transits in which the velocity of ends with real masses doubles as their loading begins, up
#: to that of a constant loading. A sudden velocity sends a wave, which nothing damps, through the
#: specimen; one transit left rigid grains above their quasi-static limit.
RISE_TRANSITS = 4.0
#: Wave transits in which that velocity rises from ``SLOWEST_WAIT`` times itself.
_RISE = -math.log2(SLOWEST_WAIT) * RISE_TRANSITS
#: Traction of a plane of weak points grows by no more than this part of what it bears while a wave
#: crosses the specimen, as it begins to soften [-], deviation D58.
SOFTENING_GROWTH = 0.01
#: Part of the running shares for brittle contacts, of whose cracks only waves tell [-].
_BRITTLE_PART = 0.05
#: The same after the peak, where a specimen may take work for long without a crack that runs, as a
#: multiple [-].
_SHARE_AFTER_PEAK = 5.0
#: How a loading goes on: ``constant``: the ends move at one velocity; ``adaptive``: faster while
#: the specimen is elastic; ``waiting``: fast, and nearly still while a crack runs.
LOADINGS = ("constant", "adaptive", "waiting")
#: Largest part that can be asked for [-]: a smaller fall makes no peak (``measures.PEAK_DROP``).
LARGEST_STOP_RATIO = 0.9
#: A fall of the stress counts once this share of the lowest strength has been reached [-]: the
#: specimen may part where it is weakest.
_LEAST_PEAK = 0.2
#: Strain to which contacts that nothing breaks may put off the default end [-].
_STRONG_END = 0.15
#: Tests that rates are looked for in.
_RATED = (*KINDS.values(), OWN)
#: A strain [-] or stress [Pa] that no test reaches.
_NEVER = 1e300
#: Most steps of a test: a day for the smallest specimens, and numbers that a double counts.
_MOST_STEPS = 10**10


@dataclass(frozen=True)
class Loading:
    """Rate, start and end of the loading of a specimen.

    A loading ends when the deviator (axial stress minus least confining pressure) has dropped to
    `stop_ratio` of its peak, or at `max_strain`. The default `max_strain` is 8 times the strain of
    the reference strength; between parts it is at least 8 times the compression at which a specimen
    of that size fails as a unit. If the load still rises there, the status is ``no_peak``.

    Example:
        >>> loading = flexpm.Loading(rate=0.5, max_strain=2e-3)
        >>> loading.rate, loading.max_strain
        (0.5, 0.002)
    """

    rate: float = 1.0  #: factor on the default loading rate [-]
    kind: str = "constant"  #: one of ``LOADINGS``; others than constant are for grains
    #: begin at the elastic solution: between ends, with deformable grains, in 3D also rigid grains
    static: bool = False
    #: axial strain at which the test ends [-]; between parts the displacement over the `length` of
    #: `drive`: without a length the displacement itself [m], or an angle [rad]; None: the default,
    #: and under a confining pressure also a plateau of the deviator ends it
    max_strain: float | None = None
    #: part of its peak to which the deviator falls in the end [-]: axial stress minus the least
    #: confining pressure
    stop_ratio: float = STOP_RATIO
    #: column of the record that is to grow at the rate, whatever the ends must do for it: a gauge,
    #: ``load``, ``lateral_strain``; empty: the ends themselves go at the rate
    control: str = ""

    def __post_init__(self) -> None:
        """Reject numbers out of range, an unknown type, and a static start under control."""
        require_number("Loading: rate", self.rate, RATE)
        if self.max_strain is not None:
            require_number("Loading: max_strain", self.max_strain, _STRAIN)
        bounds = Bounds(at_least=0.0, at_most=LARGEST_STOP_RATIO)
        require_number("Loading: stop_ratio", self.stop_ratio, bounds)
        require_one_of("Loading: kind", self.kind, LOADINGS)
        require_flag("Loading: static", self.static)
        require_text("Loading: control", self.control)
        if self.control and self.static:
            raise InputError(
                f"Loading: static = True, must be False under control of {self.control}; leave it "
                "out"
            )


@dataclass(frozen=True)
class Scales:
    """Sizes and stiffnesses that determine the loading rate and the end of a test."""

    crossing_steps: float  #: steps in which a wave crosses the specimen
    modulus: float  #: stress over strain of the record, roughly [Pa]
    strength: float  #: that the contacts which connect the grains alone would give [Pa]
    height: float  #: [m]
    width: float  #: [m]
    damage_share: float = 0.0  #: least part of a fracture energy that damage takes; 0: brittle [-]
    #: strain at which the specimen would fail as a whole, where the strength follows from the first
    #: contact point that softens; 0: else [-]
    failure_strain: float = 0.0
    lowest_strength: float = 0.0  #: the same of the weakest contacts [Pa]; 0: all are alike


@dataclass(frozen=True)
class Schedule:
    """Velocity and largest displacement of a test."""

    velocity: float  #: of the moving end at factor 1 [m/step, or m/s with real masses]
    fastest: float  #: largest factor on the velocity [-]
    #: dissipated share of the fastest work above which the loading waits, before and after the peak
    #: [-]; None: it does not wait
    running_shares: tuple[float, float] | None
    reference_strain: float  #: strain of the reference strength [-]
    max_strain: float  #: at which the test ends [-]
    stop_ratio: float  #: part of its peak to which the deviator falls in the end [-]
    least_peak: float  #: stress above the confinement before which no fall counts [Pa]
    steps: int  #: up to the largest strain at the slowest
    likely_steps: int  #: as most tests have
    min_strain: float = -_NEVER  #: at which the test ends, too [-]
    control: str = ""  #: column of the record that a servo makes grow at the rate
    fastest_ends: float = 1.0  #: largest factor on the velocity of ends under control [-]
    #: largest speed of what comes down undamped from the peak: that which a wave gives to grains as
    #: it takes the reference strength off them [m/step, or m/s with real masses]
    fastest_descent: float = math.inf
    #: largest growth of a plane's traction in a crossing as it begins to soften, where the loading
    #: looks ahead [-]
    softening_growth: float = 0.0
    #: strain over which a constant deviator ends the test [-]; 0: a plateau does not end it
    plateau_strain: float = 0.0
    #: steps in which ends with real masses come to their velocity; 0: they have it from the first
    rise_steps: int = 0


def prescribed(velocity: float) -> Schedule:
    """Return the schedule of one endless velocity: a boundary condition, which needs no scales.

    Args:
        velocity: Velocity of the driven parts [m/step, or m/s with real masses].
    """
    return Schedule(
        velocity,
        fastest=1.0,
        running_shares=None,
        reference_strain=0.0,
        max_strain=_NEVER,
        stop_ratio=STOP_RATIO,
        least_peak=_NEVER,
        steps=0,
        likely_steps=0,
    )


def rates_of(test: str, model: str, *, solid: bool = False) -> Rates:
    """Return the rates of a test on a model, of a 2D or 3D specimen.

    Raises:
        InputError: for a test that has no rate for the model.
    """
    variants = {kind.name: kind.variant_in(solid=solid) for kind in _RATED}
    known = {name: one.rates for name, one in variants.items() if one and model in one.rates}
    require_one_of(f"test of model {model}", test, tuple(known))
    return known[test][model]


def fastest_factor(test: str, model: str, rate: float = 1.0, *, solid: bool = False) -> float:
    """Return the largest factor on the velocity [-]: ratio of the fastest to the constant rate.

    A lower `rate` slows the entire test; a higher `rate` does not raise the fastest rate.
    """
    constant = rates_of(test, model, solid=solid).constant
    return max(FASTEST_CONSTANT * min(rate, 1.0) / (rate * constant), 1.0)


def _waiting(rates: Rates, model: str, damage_share: float) -> tuple[float, tuple[float, float]]:
    """Return the largest factor and the running shares of a crack-controlled loading [-]."""
    if rates.running_share is None:
        raise InputError(
            f"Loading: kind = waiting, must be adaptive or constant for model {model}; waiting is "
            f"for {' and '.join(WAITING_MODELS)} grains"
        )
    share = max(damage_share, _BRITTLE_PART) * rates.running_share
    return rates.waiting_constant / rates.constant, (share, _SHARE_AFTER_PEAK * share)


def _fastest_ends(rates: Rates, model: str, rate: float) -> float:
    """Return the largest velocity factor of servo-driven ends [-], as of a waiting loading."""
    if rates.running_share is None:
        raise InputError(
            f"Loading: control, must be left out for model {model}; it is for "
            f"{' and '.join(WAITING_MODELS)} grains"
        )
    return _waiting(rates, model, 1.0)[0] / min(rate, 1.0)


def quasistatic_ratio(
    test: str, model: str, *, waiting: bool = False, brittle: bool = False, solid: bool = False
) -> float:
    """Return the largest unbalanced-force ratio of a quasi-static test on a model [-].

    The ratio is the median, or the ratio while a crack-controlled loading moves.
    """
    rates = rates_of(test, model, solid=solid)
    ratio = rates.quasistatic
    if waiting:
        ratio = None if rates.waiting_ratios is None else rates.waiting_ratios[brittle]
    assert ratio is not None, (test, model)
    return ratio


def schedule(
    test: str,
    model: str,
    loading: Loading,
    scales: Scales,
    *,
    confinement: float = 0.0,
    dt: float = 1.0,
    solid: bool = False,
    softening: Softening = BRITTLE,
    dynamic: bool = False,
) -> Schedule:
    """Return loading rate and end of a test.

    v = k eps_ref H / T, where T is the number of steps in which a wave of the scaled masses crosses
    the height, and eps_ref is the strain of the lowest strength. The end follows the strength of
    the contacts that connect the grains: after the weakest contacts have broken, the test continues
    as long as the stress does not drop.

    Args:
        test: Name of the test, which selects the constant k.
        model: Name of the model, which also selects k.
        loading: Requested rate and end.
        scales: Scales of the specimen.
        confinement: Confining pressure [Pa].
        dt: Time step [s], or 1 with scaled masses.
        solid: Whether the specimen is 3D.
        softening: Softening of its contacts, from which the likely steps follow.
        dynamic: Whether masses are real: the velocity then rises slowly from the first step.

    Raises:
        InputError: for a test that would never end.
    """
    kind, rates = kind_of(test), rates_of(test, model, solid=solid)
    # each pascal of confinement adds at least one to the strength of a frictional contact
    reference = (scales.strength + confinement) / scales.modulus
    crossing_time = scales.crossing_steps * dt
    lowest = scales.lowest_strength or scales.strength
    slowest_strain = (lowest + confinement) / scales.modulus
    velocity = loading.rate * rates.constant * slowest_strain / crossing_time * scales.height
    # under a stress concentration a first point softens long before the specimen fails
    end = kind.largest_strain * max(reference, scales.failure_strain)
    if lowest < scales.strength:
        end = min(end, max(kind.largest_strain * slowest_strain, _STRONG_END))
    largest = loading.max_strain or end
    steps = largest * scales.height / (velocity * dt)
    if not steps <= _MOST_STEPS:
        raise InputError(
            f"run: steps = {steps:.3g} up to the largest strain, must be <= {_MOST_STEPS:g}; "
            "raise the rate or lower max_strain"
        )
    fastest, shares, slowest, growth = 1.0, None, 1.0, 0.0
    if loading.kind == "adaptive":
        fastest = fastest_factor(test, model, loading.rate, solid=solid)
    elif loading.kind == "waiting":
        fastest, shares = _waiting(rates, model, scales.damage_share)
        slowest = min(SLOWEST_WAIT * fastest, 1.0)
        growth = SOFTENING_GROWTH * loading.rate
    if loading.kind == "waiting":
        displacement = reference * scales.height
        if rates.likely_crossings is None:
            slower = slowing(rates, softening, displacement=displacement, strength=scales.strength)
            likely = slower * steps / fastest
        else:
            transits = likely_transits(
                *(kind, rates, softening),
                displacement=displacement,
                confined=confinement / scales.strength,
                stop_ratio=loading.stop_ratio,
            )
            likely = transits / loading.rate**kind.likely_power * scales.crossing_steps
    else:
        # most tests end well before the largest strain: up to that of the reference strength they
        # go at the fastest rate, then about as far at the slowest
        likely = (1.0 + 1.0 / fastest) * reference / largest * steps
    rise = math.ceil(_RISE * scales.crossing_steps) if dynamic else 0
    return Schedule(
        velocity,
        fastest,
        shares,
        reference,
        largest,
        loading.stop_ratio,
        _LEAST_PEAK * lowest,
        math.ceil(steps / slowest) + rise,
        math.ceil(min(likely, steps / slowest)) + rise,
        control=loading.control,
        fastest_ends=_fastest_ends(rates, model, loading.rate) if loading.control else 1.0,
        # deviation D57
        fastest_descent=reference / crossing_time * scales.height,
        softening_growth=growth,
        plateau_strain=PLATEAU_STRAIN if confinement > 0.0 and loading.max_strain is None else 0.0,
        rise_steps=rise,
    )
