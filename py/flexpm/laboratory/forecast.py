# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a compression of a specimen will probably take, told before there is a run."""

from __future__ import annotations

import dataclasses
import time

import yade

from ..models.grains import build
from ..rigs.fitting import rig
from ..runs.loading_rate import Loading
from ..specimens.specimen import Specimen

#: Steps that are timed, after some that are not.
_STEPS, _FIRST = 40, 5


def forecast(specimen: Specimen) -> tuple[int, float] | None:
    """Steps of a compression of flexible grains, and their time on this machine [s].

    The material is the default one, so that a specimen needs none; YADE's scene is emptied. A
    guess, from what tests of packings take.

    Args:
        specimen: A rectangle or a disc; None is returned for any other.
    """
    if specimen.kind not in ("rectangle", "disc"):
        return None
    yade.O.reset()
    try:
        held = rig(build(dataclasses.replace(specimen, minerals=None)))
        steps = held.likely_steps(Loading(kind="waiting"))
        for _ in range(_FIRST):
            yade.O.step()
        start = time.perf_counter()
        for _ in range(_STEPS):
            yade.O.step()
        return steps, steps * (time.perf_counter() - start) / _STEPS
    finally:
        yade.O.reset()
