# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps that a test will probably take under a loading that waits for cracks. SI units.

A loading that waits goes at its fastest rate while the specimen is elastic, which takes some ten
wave transits, and slows by the power 0.8 of the dissipated share of the work. Most steps are those
in which contacts soften. Their number grows with the displacement over which a contact softens,
compared with the displacement at the strength: 2 G E / (f^2 H) with G the fracture energy, f the
strength, E the modulus and H the height. `scripts/studies/step_counts.py` makes the table of runs.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..kinds.rates import Rates
from ..kinds.test_kind import TestKind

#: Softening slips over the displacement at the strength beyond which compression takes no longer
#: [-]: the rock between the first cracks carries the rest.
_HALF_SLIP = 0.6
#: Growth of the steps with the confining pressure over the strength [-].
_CONFINED = 10.0


@dataclass(frozen=True)
class Softening:
    """Mean contact of a test, which softens."""

    opening: float = 0.0  #: at which it has lost its tensile strength [m]
    slip: float = 0.0  #: at which it has lost its cohesion [m]
    cohesion: float = 0.0  #: [Pa]


#: Contacts that break at once.
BRITTLE = Softening()


def likely_transits(
    kind: TestKind,
    rates: Rates,
    softening: Softening,
    *,
    displacement: float,
    confined: float,
    stop_ratio: float,
) -> float:
    """Wave transits of a test that ends when its stress has fallen, at the default rate [-].

    Args:
        kind: The test.
        rates: Its rates on the model, with a number of transits.
        softening: Softening of the contacts.
        displacement: Displacement of the driven end at the reference strength [m].
        confined: Confining pressure over the strength [-].
        stop_ratio: Part of its peak to which the stress falls before the test ends [-].
    """
    assert rates.likely_crossings is not None
    if kind.pulls or kind.pulled:
        ratio = (1.0 - stop_ratio) * softening.opening / displacement
    else:
        ratio = _slip_ratio(softening, displacement)
    return (rates.likely_crossings + rates.likely_softening * ratio) * (1.0 + _CONFINED * confined)


def slowing(rates: Rates, softening: Softening, *, displacement: float, strength: float) -> float:
    """Steps of a test that goes all its way, over those at its fastest rate [-].

    Args:
        rates: Its rates on the model.
        softening: Softening of the contacts of the rock.
        displacement: Displacement of the driven end at the reference strength [m].
        strength: The reference strength, that of a joint if the test has one [Pa]: without
            cohesion nothing softens.
    """
    cohesive = min(strength, softening.cohesion) / (softening.cohesion or 1.0)
    return 1.0 + rates.likely_softening * cohesive * _slip_ratio(softening, displacement)


def _slip_ratio(softening: Softening, displacement: float) -> float:
    """Slip over which contacts soften against a displacement [-], from 0 to 1."""
    ratio = softening.slip / displacement
    return ratio / (ratio + _HALF_SLIP)
