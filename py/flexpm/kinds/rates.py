# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading rates of a test with a model, and the ratios below which it is quasi-static.

The rates (paper Sec. 4.1, D5) were halved on three packings until the mean peak no longer changed.
The packings have the size of the paper for flexible and rigid grains. The documentation has the
tables and the command.
"""

from __future__ import annotations

from dataclasses import dataclass

#: The rate of a loading that waits for cracks is up to this k [-].
WAITING_CONSTANT = 0.16


@dataclass(frozen=True)
class Rates:
    """Rates of a test with a model; None for a loading that the test does not have."""

    #: k of the loading rate [-]: the mean strain grows by k times the reference strain while a wave
    #: crosses the specimen once. Halving it moved the mean peak by less than 2 %.
    constant: float
    #: A test whose median unbalanced-force ratio up to its peak exceeds this is not quasi-static
    #: [-]: about what the fastest rate gives at which halving still moves the mean peak by less
    #: than 2 %, or the fastest that was tried.
    quasistatic: float | None = None
    #: The same of a loading that waits for cracks, for the ratio that a fifth of the loading
    #: exceeds (``measures.unbalanced_under_way``) [-], with softening and with brittle contacts:
    #: between what the rate in use and four times that rate give.
    waiting_ratios: tuple[float, float] | None = None
    #: Cracks run where damage and friction take more than this share of what a waiting loading
    #: would supply at its fastest [-].
    running_share: float | None = None
    #: The fastest k of a loading that waits for cracks [-].
    waiting_constant: float = WAITING_CONSTANT
    #: Wave transits that a test with a loading that waits takes with brittle contacts [-]; None:
    #: it goes all its way.
    likely_crossings: float | None = None
    #: Transits that the softening of the contacts adds for each unit of its ratio, see
    #: ``runs.likely`` [-].
    likely_softening: float = 0.0
