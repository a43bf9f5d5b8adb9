# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast tests are driven, when they end and when they count as quasi-static. SI units.

The rates (paper Sec. 4.1, D5) come from halving them on three packings until the mean peak stood
still: of the paper's size for flexible and rigid grains. The tables and the command are in the
documentation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import InputError
from ..require import Bounds, require_flag, require_number, require_one_of, require_text

#: Factors on the default loading rate that a test may have [-].
RATE = Bounds(above=0.0, at_least=1e-12, at_most=1e12)
#: Largest strains of a loading [-]; 0 for one that ends where it is.
_STRAIN = Bounds(at_least=0.0, at_most=1e6)

#: k of the loading rate by model and test [-]: the mean strain grows by k times the reference
#: strain while a wave crosses the specimen once. Halving it moved the mean peak by less than 2 %.
RATE_CONSTANT = {
    "flexible": {
        **{"uniaxial": 0.005, "tension": 0.01, "biaxial": 0.0025, "brazilian": 0.01},
        **{"bending": 0.01, "shear": 0.01, "own": 0.01},
    },
    "rigid": {
        **{"uniaxial": 0.01, "tension": 0.02, "biaxial": 0.01, "brazilian": 0.01},
        **{"bending": 0.01, "shear": 0.01, "own": 0.01},
    },
    # halved on small specimens, as those of YADE's models
    "inner": {"uniaxial": 0.01, "tension": 0.01, "biaxial": 0.01, "brazilian": 0.01},
    "jcfpm": {"uniaxial": 0.0025, "tension": 0.01, "biaxial": 0.0025, "brazilian": 0.0025},
    "cohfrict": {"uniaxial": 0.0025, "tension": 0.01, "biaxial": 0.0025, "brazilian": 0.0025},
}
#: The rate of an adaptive loading is up to this k while the specimen is elastic [-].
FASTEST_CONSTANT = 0.04
#: The rate of a loading that waits for cracks is up to this k [-].
WAITING_CONSTANT = 0.16
#: The same where another one suits: at 0.16 a joint that begins to slide has carried 3 % too much,
#: half a disc of deformable grains as well.
_OTHER_WAITING_CONSTANTS = {
    **{("shear", model): 0.04 for model in ("flexible", "rigid")},
    ("scb", "flexible"): 0.08,
}
#: Cracks run where damage and friction take more than this share of what a waiting loading would
#: supply at its fastest [-], by model and test.
RUNNING_SHARE = {
    "flexible": {
        **{"uniaxial": 0.002, "tension": 0.01, "biaxial": 0.003, "brazilian": 0.01},
        **{"bending": 0.01, "shear": 0.04, "own": 0.01},
    },
    "rigid": {
        **{"uniaxial": 0.005, "tension": 0.02, "biaxial": 0.0075, "brazilian": 0.006},
        **{"bending": 0.01, "shear": 0.04, "own": 0.01},
    },
}
#: Slowest rate of a loading that waits over its fastest [-].
SLOWEST_WAIT = 0.01
#: Traction of a plane of weak points grows by no more than this part of what it bears while a wave
#: crosses the specimen, as it begins to soften [-], deviation D58.
SOFTENING_GROWTH = 0.01
#: Wave crossings that a test with a loading that waits takes, about, between half the paper's size
#: and the whole of it [-]. Bending and scb: geometric means of two packings of half the default
#: size and of the whole, beams with and without a notch; they took 0.3 to 2.9 times as many. Shear
#: has none: it goes all its way.
_LIKELY_CROSSINGS = {
    "flexible": {
        **{"uniaxial": 60, "tension": 19, "biaxial": 125, "brazilian": 42},
        **{"bending": 100, "scb": 400, "own": 60},
    },
    "rigid": {
        **{"uniaxial": 130, "tension": 58, "biaxial": 130, "brazilian": 100},
        **{"bending": 155, "scb": 180, "own": 60},
    },
}
#: They fall with this power of the rate: twice the rate saves a third of the steps, roughly, as
#: cracks take their time; nearly half of them where a test ends with all of its cracks open.
_LIKELY_POWER = 0.5
_OTHER_LIKELY_POWERS = {"bending": 0.85}
#: Part of these shares for brittle contacts, of whose cracks only waves tell [-].
_BRITTLE_PART = 0.05
#: The same after the peak, where a specimen may take work for long without a crack that runs, as a
#: multiple [-].
_SHARE_AFTER_PEAK = 5.0
#: A test whose median unbalanced-force ratio up to its peak exceeds this is not quasi-static [-]:
#: about what the fastest rate gives at which halving still moves the mean peak by less than 2 %, or
#: the fastest that was tried.
QUASISTATIC_RATIO = {
    "flexible": {
        **{"uniaxial": 0.0015, "tension": 0.0045, "biaxial": 0.001, "brazilian": 0.008},
        **{"bending": 0.005, "scb": 0.006, "shear": 0.01},
    },
    "rigid": {
        **{"uniaxial": 0.004, "tension": 0.005, "biaxial": 0.003, "brazilian": 0.012},
        **{"bending": 0.0015, "scb": 0.003, "shear": 0.01},
    },
    "inner": {"uniaxial": 0.005, "tension": 0.005, "biaxial": 0.005, "brazilian": 0.005},
    # a bond that breaks at once leaves its whole force unbalanced, however slow the test is
    "jcfpm": {"uniaxial": 0.02, "tension": 0.02, "biaxial": 0.02, "brazilian": 0.02},
    "cohfrict": {"uniaxial": 0.02, "tension": 0.02, "biaxial": 0.02, "brazilian": 0.02},
}
#: The same of a loading that waits for cracks, for the ratio that a fifth of the loading exceeds
#: (``measures.unbalanced_under_way``) [-], with softening and with brittle contacts: between what
#: the rate in use and four times that rate give; that of shear is of rock, not measured if brittle.
_WAITING_RATIO = {
    "flexible": {
        "uniaxial": (0.0025, 0.06),
        "tension": (0.005, 0.6),
        "biaxial": (0.0017, 0.045),
        "brazilian": (0.033, 0.028),
        "bending": (0.004, 0.012),
        "scb": (0.0055, 0.012),
        "shear": (0.06, 0.1),
    },
    "rigid": {
        "uniaxial": (0.02, 0.15),
        "tension": (0.017, 0.1),
        "biaxial": (0.022, 0.1),
        "brazilian": (0.09, 0.06),
        "bending": (0.002, 0.004),
        "scb": (0.006, 0.02),
        "shear": (0.09, 0.1),
    },
}
#: How a loading goes on: ``constant``: the ends move at one velocity; ``adaptive``: faster while
#: the specimen is elastic; ``waiting``: fast, and nearly still while a crack runs.
LOADINGS = ("constant", "adaptive", "waiting")
#: Part of its peak to which the stress falls before a test ends, unless told otherwise [-].
STOP_RATIO = 0.5
#: The same of tests whose work counts up to the end.
_OTHER_STOP_RATIOS = {"bending": 0.1}
#: Largest part that can be asked for [-]: a smaller fall makes no peak (``measures.PEAK_DROP``).
LARGEST_STOP_RATIO = 0.9
#: A test ends at this multiple of the reference strain unless told otherwise [-]: bonds that soften
#: slowly, and the interlocking edges of inner particles, carry more than the reference.
_LARGEST_STRAINS = 8.0
#: The same where another one suits: plates press into discs, which softening lets carry more; a
#: beam is bent until it is broken through.
_OTHER_LARGEST_STRAINS = {"brazilian": 16.0, "bending": 20.0}
#: A fall of the stress counts once this share of the reference strength has been reached [-].
_LEAST_PEAK = 0.2
#: Most steps of a test: a day for the smallest specimens, and numbers that a double counts.
_MOST_STEPS = 10**10
#: Models that are driven like another one.
_LIKE = {"inner-un": "inner"}
#: Tests that are driven like another one.
_TEST_LIKE = {"scb": "bending"}


@dataclass(frozen=True)
class Loading:
    """How the ends of a specimen are driven, and when its test ends."""

    rate: float = 1.0  #: factor on the default loading rate [-]
    kind: str = "constant"  #: one of ``LOADINGS``; others than constant are for grains
    static: bool = False  #: begin at the elastic solution; for deformable grains between their ends
    max_strain: float | None = None  #: axial strain at which the test ends [-]; None: the default
    stop_ratio: float = STOP_RATIO  #: part of its peak to which the stress falls in the end [-]
    #: column of the record that is to grow at the rate, whatever the ends must do for it: a gauge,
    #: ``load``, ``lateral_strain``; empty: the ends themselves go at the rate
    control: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers out of range, an unknown kind, and a static start under control."""
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
                f"Loading: static = True, must be False under control of {self.control}"
            )


@dataclass(frozen=True)
class Scales:
    """What the loading rate and the end of a test follow from."""

    crossing_steps: float  #: steps in which a wave crosses the specimen
    modulus: float  #: stress over strain of the record, roughly [Pa]
    strength: float  #: that the contacts alone would give [Pa]
    height: float  #: [m]
    width: float  #: [m]
    damage_share: float = 0.0  #: least part of a fracture energy that damage takes; 0: brittle [-]


@dataclass(frozen=True)
class Schedule:
    """How fast and how far a test is driven."""

    velocity: float  #: of the moving end at factor 1 [m/step, or m/s with real masses]
    fastest: float  #: largest factor on the velocity [-]
    #: dissipated share of the fastest work above which the loading waits, before and after the peak
    #: [-]; None: it does not wait
    running_shares: tuple[float, float] | None
    reference_strain: float  #: strain of the reference strength [-]
    max_strain: float  #: at which the test ends [-]
    stop_ratio: float  #: part of its peak to which the stress falls in the end [-]
    least_peak: float  #: stress above the confinement before which no fall counts [Pa]
    steps: int  #: up to the largest strain at the slowest
    likely_steps: int  #: as most tests have
    min_strain: float = -1e300  #: at which the test ends, too [-]
    control: str = ""  #: column of the record that a servo makes grow at the rate
    fastest_ends: float = 1.0  #: largest factor on the velocity of ends under control [-]
    #: largest speed of what comes down undamped from the peak: that which a wave gives to grains as
    #: it takes the reference strength off them [m/step, or m/s with real masses]
    fastest_descent: float = math.inf
    #: largest growth of a plane's traction in a crossing as it begins to soften, where the loading
    #: looks ahead [-]
    softening_growth: float = 0.0


def default_stop_ratio(test: str) -> float:
    """Part of its peak to which the stress falls before a test ends, unless told otherwise [-]."""
    return _OTHER_STOP_RATIOS.get(_driven_like(test), STOP_RATIO)


def _driven_like(test: str) -> str:
    return _TEST_LIKE.get(test, test)


def rate_constant(test: str, model: str) -> float:
    """The constant k of a test on a model [-].

    Raises:
        InputError: for a test that the model has no constant for.
    """
    constants, like = RATE_CONSTANT[_LIKE.get(model, model)], _driven_like(test)
    require_one_of(f"test of model {model}", like, tuple(constants))
    return constants[like]


def fastest_factor(test: str, model: str, rate: float = 1.0) -> float:
    """Largest factor on the velocity [-]: the rate over that of the constant times `rate`.

    A lower `rate` slows the whole test; a higher one does not raise the fastest rate.
    """
    return max(FASTEST_CONSTANT * min(rate, 1.0) / (rate * rate_constant(test, model)), 1.0)


def _waiting(test: str, model: str, damage_share: float) -> tuple[float, tuple[float, float]]:
    """Largest factor and running shares of a loading that waits for cracks [-]."""
    if model not in RUNNING_SHARE:
        raise InputError(
            f"Loading: kind = waiting, must be another for model {model}; waiting is for "
            f"{' and '.join(RUNNING_SHARE)} grains"
        )
    share = max(damage_share, _BRITTLE_PART) * RUNNING_SHARE[model][_driven_like(test)]
    most = _OTHER_WAITING_CONSTANTS.get((test, model), WAITING_CONSTANT)
    fastest = most / rate_constant(test, model)
    return fastest, (share, _SHARE_AFTER_PEAK * share)


def _fastest_ends(test: str, model: str, rate: float) -> float:
    """Largest factor on the velocity of ends that a servo drives [-]: that of a waiting loading."""
    if model not in RUNNING_SHARE:
        raise InputError(
            f"Loading: control, must be left out for model {model}; it is for "
            f"{' and '.join(RUNNING_SHARE)} grains"
        )
    return _waiting(test, model, 1.0)[0] / min(rate, 1.0)


def quasistatic_ratio(
    test: str, model: str, *, waiting: bool = False, brittle: bool = False
) -> float:
    """Largest unbalanced-force ratio of a quasi-static test on a model [-].

    The median, or that under way of a loading that waits for cracks.
    """
    if waiting:
        return _WAITING_RATIO[model][test][brittle]
    return QUASISTATIC_RATIO[_LIKE.get(model, model)][test]


def schedule(
    test: str,
    model: str,
    loading: Loading,
    scales: Scales,
    *,
    confinement: float = 0.0,
    dt: float = 1.0,
) -> Schedule:
    """Loading rate and end of a test.

    v = k eps_ref H / T with T the steps in which a wave of the scaled masses crosses the height
    and eps_ref the strain of the reference strength.

    Args:
        test: Name of the test, which has a constant of its own.
        model: Name of the model, which has, too.
        loading: Rate and end as asked for.
        scales: Of the specimen.
        confinement: Lateral pressure [Pa].
        dt: Time step [s], or 1 with scaled masses.

    Raises:
        InputError: for a test that would never end.
    """
    own, test = test, _driven_like(test)
    # each pascal of confinement adds at least one to the strength of a frictional contact
    reference = (scales.strength + confinement) / scales.modulus
    crossing_time = scales.crossing_steps * dt
    velocity = loading.rate * rate_constant(test, model) * reference / crossing_time * scales.height
    multiple = _OTHER_LARGEST_STRAINS.get(test, _LARGEST_STRAINS)
    largest = loading.max_strain or multiple * reference
    steps = largest * scales.height / (velocity * dt)
    if not steps <= _MOST_STEPS:
        raise InputError(
            f"run: steps = {steps:.3g} up to the largest strain, must be <= {_MOST_STEPS:g}; "
            "raise the rate or lower max_strain"
        )
    fastest, shares, slowest, growth = 1.0, None, 1.0, 0.0
    if loading.kind == "adaptive":
        fastest = fastest_factor(test, model, loading.rate)
    elif loading.kind == "waiting":
        fastest, shares = _waiting(own, model, scales.damage_share)
        slowest = min(SLOWEST_WAIT * fastest, 1.0)
        growth = SOFTENING_GROWTH * loading.rate
    if loading.kind == "waiting":
        if crossings := _LIKELY_CROSSINGS[model].get(own):
            power = _OTHER_LIKELY_POWERS.get(test, _LIKELY_POWER)
            likely = crossings / loading.rate**power * scales.crossing_steps
        else:
            likely = steps / fastest
    else:
        # most tests end well before the largest strain: up to that of the reference strength they
        # go at the fastest rate, then about as far at the slowest
        likely = (1.0 + 1.0 / fastest) * reference / largest * steps
    return Schedule(
        velocity,
        fastest,
        shares,
        reference,
        largest,
        loading.stop_ratio,
        _LEAST_PEAK * scales.strength,
        math.ceil(steps / slowest),
        math.ceil(min(likely, steps / slowest)),
        control=loading.control,
        fastest_ends=_fastest_ends(own, model, loading.rate) if loading.control else 1.0,
        # deviation D57
        fastest_descent=reference / crossing_time * scales.height,
        softening_growth=growth,
    )
