# SPDX-License-Identifier: GPL-3.0-or-later
"""Estimates before a run: its duration, and the compliance of the contacts."""

from __future__ import annotations

import dataclasses
import statistics
import time
from dataclasses import dataclass

import yade

from ..dimensions import is_solid
from ..materials import load
from ..models.grains import build
from ..rigs.fitting import rig
from ..runs.loading_rate import Loading
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import Specimen

#: Ratio of the compliances of contacts and grains above which a message is printed [-].
SOFT = 1.0
#: Steps that are timed, after some that are not.
_STEPS, _FIRST = 40, 5
#: Fewest and most steps of compressions over their likely number: seven images took 0.7 to 1.8
#: times that number, two small packings 0.6 and 1.0.
_RANGE = (0.45, 2.25)


@dataclass(frozen=True)
class Forecast:
    """Estimated cost of a test."""

    steps: tuple[int, int]  #: fewest and most
    seconds: tuple[float, float]  #: as many on this machine [s]


def forecast(specimen: Specimen) -> Forecast | None:
    """Steps of a compression of flexible grains, and their time on this machine.

    The default material is used, because a specimen has none; YADE's scene is emptied. The estimate
    is based on similar tests; a test without a peak continues to its largest strain.

    Args:
        specimen: A rectangle or a disc; None is returned for any other.
    """
    if specimen.kind not in ("rectangle", "disc"):
        return None
    yade.O.reset()
    try:
        held = rig(build(dataclasses.replace(specimen, minerals=None)))
        likely = held.likely_steps(Loading(kind="waiting"))
        times = []
        for _ in range(_FIRST + _STEPS):
            start = time.perf_counter()
            yade.O.step()
            times.append(time.perf_counter() - start)
        step = statistics.median(times[_FIRST:])  # a machine at work stops some for long
        fewest, most = (round(part * likely) for part in _RANGE)
        return Forecast((fewest, most), (fewest * step, most * step))
    finally:
        yade.O.reset()


def softness(specimen: Specimen | SolidSpecimen) -> float:
    """How much more way contacts give than grains, with the default material [-].

    Its stiffness is for grains of millimetres, where this is 0.05; among grains of micrometres
    contacts alone would give way.
    """
    chosen = load(solid=is_solid(specimen.kind)).elastic["flexible"]
    assert chosen.young is not None
    return chosen.young / (chosen.normal_stiffness * specimen.mean_diameter)
