# SPDX-License-Identifier: GPL-3.0-or-later
"""A plane pulse through a rectangle or a 3D specimen, from bottom to top. D48, D49, D98."""

from __future__ import annotations

from collections.abc import Mapping

from ...errors import InputError
from ..model_names import BLOCK_MODELS
from ..option import Asked, Option, Value
from ..pulse import FREE, HELD, SIDES, WAVES, require_pulse
from ..test_kind import Rig, Stage, TestKind, Variant
from ..words import Drawn, Words


def _settle(asked: Asked) -> Mapping[str, Value]:
    if asked.diameter is not None:
        require_pulse(asked.sizes["height"], asked.diameter)
    wave, sides = asked.word("wave", WAVES), asked.word(SIDES, (HELD, FREE))
    if sides == FREE and wave != WAVES[0]:
        raise InputError(
            f"run: {SIDES} = {FREE}, must be {HELD} for wave = {wave}: the speed of a bending wave "
            "depends on its wavelength; leave it out"
        )
    return {"wave": wave, SIDES: None if sides == HELD else sides}


KIND = TestKind(
    name="sonic",
    order=9,
    about="a plane pulse through a 2D or 3D specimen from its bottom to its top, with real "
    "masses and without damping, for the wave velocity",
    variants={
        "rectangle": Variant(
            only_models=BLOCK_MODELS,
            results=dict.fromkeys(BLOCK_MODELS, 2),  # a cosine that is the same on all machines
        ),
        "box": Variant(
            only_models=BLOCK_MODELS,
            sizes={"width": 0.01, "depth": 0.01, "height": 0.16},
        ),
        "cylinder": Variant(only_models=BLOCK_MODELS, sizes={"diameter": 0.012, "height": 0.16}),
    },
    options=(
        Option("wave", "Pressure or shear wave", choices=WAVES, default=WAVES[0]),
        Option(
            SIDES,
            "Sides: fixed perpendicular to the motion of the grains, or free as in a thin bar",
            choices=(HELD, FREE),
            default=HELD,
            open=HELD,
        ),
    ),
    without=(
        *("rate", "max_strain", "stop_ratio", "dynamic", "gravity", "damping", "start", "loading"),
    ),
    settle=_settle,
    dynamic=True,  # a wave in scaled masses has another speed
    rig=Rig.WAVE,
    stages=(Stage.SEND,),
    needs_peak=False,
    quasi_static=False,
    words=Words(
        Drawn("time", "time", 1e6, "µs"),
        Drawn("far_displacement", "displacement of the upper section", 1e9, "nm"),
        measures=("vp", "vs"),
    ),
    rows=("grains, contacts", "energy error", "steps", "status"),
)
