# SPDX-License-Identifier: GPL-3.0-or-later
"""The timed models, each in a scene that is ready for its first step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
import yade

from ..kinds.registry import KINDS
from ..models import grains, spheres
from ..models.options import DAMPING, SPHERE_MODELS
from ..rigs.fitting import rig
from ..runs.loading_rate import Loading
from ..specimens.specimen import AnySpecimen

#: What a builder takes and gives: a specimen, threads; counts by name.
Builder = Callable[[AnySpecimen, int], Mapping[str, int]]

#: Factor on the loading rate [-]: the steps of a measurement stay in the specimen's elastic range.
_RATE = 0.1


def build_own(
    specimen: AnySpecimen, threads: int, model: str = "flexible", mesh: str = "refined"
) -> Mapping[str, int]:
    """Set up a uniaxial or Brazilian test like `flexpm run`, up to its first step.

    Args:
        specimen: The grains.
        threads: Threads of a step.
        model: Name of the model.
        mesh: Mesh of deformable grains.

    Returns:
        Counts by name.
    """
    built = grains.build(specimen, None, model, mesh=mesh, threads=threads)
    assert isinstance(built, grains.Model), model
    start(built)
    return built.counts()


def start(built: grains.Model | spheres.SphereModel) -> None:
    """Prepare a model for the first step of a test."""
    rig(built).start(Loading(rate=_RATE, kind="adaptive"))


def _build_yade(specimen: AnySpecimen, threads: int, model: str) -> Mapping[str, int]:
    """Set up bonded spheres compressed at about the same rate, without plates and record."""
    built = grains.build(specimen, None, model, damping=DAMPING, threads=threads)
    assert isinstance(built, spheres.SphereModel), model
    heights = specimen.centres[:, -1]
    rate = 1e-8 / np.ptp(heights)
    speeds = np.zeros((len(heights), 3))
    speeds[:, specimen.centres.shape[1] - 1] = -rate * heights
    for body, speed in zip(built.ids, speeds.tolist(), strict=True):
        yade.O.bodies[body].state.vel = tuple(speed)
    return built.counts()


#: Name, label and builder of each model, in the order of a turn.
BUILDERS: dict[str, tuple[str, Builder]] = {
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


def solid_builders(shape: str) -> dict[str, tuple[str, Builder]]:
    """Return name, label and builder of each model that is timed in 3D."""
    models = next(kind.models_of(shape) for kind in KINDS.values() if shape in kind.variants)
    return {
        name: BUILDERS[name]
        if name in SPHERE_MODELS
        else (f"{name}, corners and one inside", partial(build_own, model=name, mesh="refined"))
        for name in models
    }
