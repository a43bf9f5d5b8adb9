# SPDX-License-Identifier: GPL-3.0-or-later
"""Common parts of the tests in which a part slides along another. Deviations D46 and D65."""

from __future__ import annotations

from ..require import Bounds
from .option import Asked, Option, Value
from .rates import Rates
from .words import Drawn

WAY = Option(
    "max_displacement",
    "Displacement at which the test ends",
    "m",
    default="8 times the displacement at the reference strength",
    open="from the reference strength",
)
#: At 0.16 a joint that begins to slide has carried 3 % too much; brittle ones are not measured.
RATES = {
    "flexible": Rates(0.01, 0.01, (0.06, 0.1), 0.04, waiting_constant=0.04, likely_softening=1.15),
    "rigid": Rates(0.01, 0.01, (0.09, 0.1), 0.04, waiting_constant=0.04, likely_softening=1.15),
}
#: The same of solids: halving moves peaks of three by 1.1 % and less.
SOLID_RATES = {
    "flexible": Rates(0.01, 0.01, (0.04, 0.1), 0.04, waiting_constant=0.04, likely_softening=1.15),
    "rigid": Rates(0.01, 0.01, (0.25, 0.25), 0.04, waiting_constant=0.04, likely_softening=1.15),
}
DRAWN = Drawn("displacement", "displacement", 1e6, "µm")


def way(asked: Asked, size: float) -> dict[str, Value]:
    """Return the final displacement of the test if it is given [m]; it must be below `size`."""
    if asked.values.get(WAY.name) is None:
        return {}
    return {WAY.name: asked.number(WAY.name, 0.0, Bounds(above=0.0, below=size))}
