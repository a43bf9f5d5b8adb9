# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast tests are driven, when they end and when they count as quasi-static. SI units.

The rates (paper Sec. 4.1, D5) come from halving them on three packings until the mean peak stood
still: of the paper's size for flexible and rigid grains. The tables and the command are in the
documentation.
"""

from __future__ import annotations

#: k of the loading rate by model and test [-]: the mean strain grows by k times the reference
#: strain while a wave crosses the specimen once. Halving it moved the mean peak by less than 2 %.
RATE_CONSTANT = {
    "flexible": {"uniaxial": 0.005, "tension": 0.01, "biaxial": 0.0025, "brazilian": 0.01},
    "rigid": {"uniaxial": 0.01, "tension": 0.02, "biaxial": 0.01, "brazilian": 0.01},
    # halved on small specimens, as those of YADE's models
    "inner": {"uniaxial": 0.01, "tension": 0.01, "biaxial": 0.01, "brazilian": 0.01},
    "jcfpm": {"uniaxial": 0.0025, "tension": 0.01, "biaxial": 0.0025, "brazilian": 0.0025},
    "cohfrict": {"uniaxial": 0.0025, "tension": 0.01, "biaxial": 0.0025, "brazilian": 0.0025},
}
#: The rate of a test with an adaptive pace is up to this k while the specimen is elastic [-].
FASTEST_CONSTANT = 0.04
#: A test whose median unbalanced-force ratio up to its peak exceeds this is not quasi-static [-]:
#: about what the fastest rate gives at which halving still moves the mean peak by less than 2 %.
QUASISTATIC_RATIO = {
    "flexible": {"uniaxial": 0.0015, "tension": 0.0045, "biaxial": 0.001, "brazilian": 0.008},
    "rigid": {"uniaxial": 0.004, "tension": 0.005, "biaxial": 0.003, "brazilian": 0.012},
    "inner": {"uniaxial": 0.005, "tension": 0.005, "biaxial": 0.005, "brazilian": 0.005},
    # a bond that breaks at once leaves its whole force unbalanced, however slow the test is
    "jcfpm": {"uniaxial": 0.02, "tension": 0.02, "biaxial": 0.02, "brazilian": 0.02},
    "cohfrict": {"uniaxial": 0.02, "tension": 0.02, "biaxial": 0.02, "brazilian": 0.02},
}
#: Part of its peak to which the stress falls before a test ends, unless told otherwise [-].
STOP_RATIO = 0.5
#: Largest part that can be asked for [-]: a smaller fall makes no peak (``measures.PEAK_DROP``).
LARGEST_STOP_RATIO = 0.9
#: Models that are driven like another one.
_LIKE = {"inner-un": "inner"}


def rate_constant(test: str, model: str) -> float:
    """The constant k of a test on a model [-]."""
    return RATE_CONSTANT[_LIKE.get(model, model)][test]


def fastest_pace(test: str, model: str, rate: float = 1.0) -> float:
    """Largest pace of a test [-]: the loading rate over that of the constant times `rate` [-].

    A lower `rate` slows the whole test; a higher one does not raise the fastest rate.
    """
    return max(FASTEST_CONSTANT * min(rate, 1.0) / (rate * rate_constant(test, model)), 1.0)


def quasistatic_ratio(test: str, model: str) -> float:
    """Largest median unbalanced-force ratio of a quasi-static test on a model [-]."""
    return QUASISTATIC_RATIO[_LIKE.get(model, model)][test]
