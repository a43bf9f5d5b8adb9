# SPDX-License-Identifier: GPL-3.0-or-later
"""Compression of a 3D specimen under lateral pressures, which act first. Deviations D93, D94."""

from __future__ import annotations

from collections.abc import Mapping

from ...errors import InputError
from ...require import Bounds
from ..option import END_FRICTION, Asked, Option, Value, end_friction_of
from ..rates import Rates
from ..test_kind import Stage, TestKind, Variant

_PRESSURE = Bounds(at_least=0.0, at_most=1e15)


def _settle(asked: Asked) -> Mapping[str, Value]:
    friction = end_friction_of(asked)
    second = asked.values.get("second_confinement")
    if second is None:
        return friction
    pressure = asked.number("second_confinement", 0.0, _PRESSURE, "Pa")
    if "depth" not in asked.sizes:
        raise InputError(
            f"run: second_confinement = {pressure:g} Pa, must be left out for a cylinder, whose "
            "lateral surface is one side; use a box"
        )
    return {"second_confinement": pressure, **friction}


_RATES = {
    "flexible": Rates(0.005, 0.0015, (0.0025, 0.06), 0.002, likely_crossings=115),
    "rigid": Rates(0.01, 0.003, (0.022, 0.1), 0.0075, likely_crossings=200),
}

KIND = TestKind(
    name="triaxial",
    order=10,
    about="compression of a cylinder or a box under a confining pressure, which acts all around "
    "first; two pressures on a box make the test true triaxial",
    variants={
        "cylinder": Variant(_RATES, static_models=("flexible", "rigid")),
        "box": Variant(_RATES, static_models=("flexible", "rigid")),
    },
    other_hint="; use biaxial for 2D specimens",
    confined=True,
    stages=(Stage.CONFINE, Stage.LOAD),
    options=(
        Option(
            "second_confinement",
            "Pressure on the front and back faces of a box, along y",
            "Pa",
            _PRESSURE,
            default="the confining pressure",
            open="the confining pressure",
        ),
        END_FRICTION,
    ),
    settle=_settle,
    falls_freely=True,
    is_core=True,
    envelope=True,
    scored="confined",
)
