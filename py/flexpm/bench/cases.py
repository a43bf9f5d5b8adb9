# SPDX-License-Identifier: GPL-3.0-or-later
"""The models whose steps are timed, each as a scene that is ready for its first step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
import yade

from ..models import grains, spheres
from ..models.options import DAMPING
from ..rigs.fitting import rig
from ..runs.loading_rate import Loading
from ..specimens.specimen import Specimen

#: Factor on the loading rate [-]: the steps of a measurement stay in the specimen's elastic range.
_RATE = 0.1


def build_own(
    specimen: Specimen, threads: int, model: str = "flexible", mesh: str = "refined"
) -> Mapping[str, int]:
    """A uniaxial or Brazilian test as `flexpm run` sets it up, just before its first step."""
    built = grains.build(specimen, None, model, mesh=mesh, threads=threads)
    assert isinstance(built, grains.Model), model
    rig(built).start(Loading(rate=_RATE, kind="adaptive"))
    return built.counts()


def _build_yade(specimen: Specimen, threads: int, model: str) -> Mapping[str, int]:
    """Bonded spheres squeezed at about the same rate, without plates and record."""
    built = spheres.build(specimen, None, model, damping=DAMPING, threads=threads)
    heights = specimen.centres[:, 1]
    rate = 1e-8 / np.ptp(heights)
    for body, height in zip(built.ids, heights.tolist(), strict=True):
        yade.O.bodies[body].state.vel = (0.0, -rate * height, 0.0)
    return built.counts()


#: Name, label and builder of each model, in the order of a turn.
BUILDERS: dict[str, tuple[str, Callable[[Specimen, int], Mapping[str, int]]]] = {
    "refined": (
        "flexible, refined, 3 points",
        lambda specimen, threads: build_own(specimen, threads, mesh="refined"),
    ),
    "fan": (
        "flexible, fan, 3 points",
        lambda specimen, threads: build_own(specimen, threads, mesh="fan"),
    ),
    **{
        name: (f"{name}, {points}", partial(build_own, model=name))
        for name, points in (
            ("rigid", "3 points"),
            ("inner", "1 point"),
            ("inner-un", "1 point"),
        )
    },
    "jcfpm": (
        "YADE JCFpm",
        lambda specimen, threads: _build_yade(specimen, threads, "jcfpm"),
    ),
    "cohfrict": (
        "YADE CohFrict",
        lambda specimen, threads: _build_yade(specimen, threads, "cohfrict"),
    ),
}
