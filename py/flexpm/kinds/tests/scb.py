# SPDX-License-Identifier: GPL-3.0-or-later
"""Three-point bending of half a disc with a notch, loaded on top. Deviation D50."""

from __future__ import annotations

from collections.abc import Mapping

from ...require import NOT_NEGATIVE, Bounds
from .. import bent
from ..layout import Frame
from ..option import Asked, Option, Value
from ..rates import Rates
from ..test_kind import Rig, TestKind, Variant
from ..toughness import half_disc_toughness, require_half_disc
from ..words import Columns

#: Span over the diameter, notch over the radius, unless they are given [-].
_SPAN, _NOTCH = 0.6, 0.5


def _settle(asked: Asked) -> Mapping[str, Value]:
    diameter = asked.sizes["diameter"]
    span = bent.span_of(asked, _SPAN * diameter, diameter)
    bounds = Bounds(at_least=0.0, below=0.5 * diameter)
    notch = asked.number("notch", 0.5 * _NOTCH * diameter, bounds)
    require_half_disc(span, 0.5 * diameter, notch)
    return {"span": span, "notch": notch}


def _measure(frame: Frame, record: Columns, peak: float | None) -> Mapping[str, float | None]:
    def toughness(load: float) -> float | None:
        return half_disc_toughness(
            load,
            span=frame.number("span"),
            radius=0.5 * frame.width,
            thickness=frame.thickness,
            notch=frame.notch_depth,
        )

    return bent.measured(frame, record, peak, toughness)


_RATES = {
    "flexible": Rates(
        0.01,
        0.006,
        (0.0055, 0.012),
        0.01,
        waiting_constant=0.08,
        likely_crossings=23,
        likely_softening=400,
    ),
    "rigid": Rates(0.01, 0.003, (0.006, 0.02), 0.01, likely_crossings=30, likely_softening=150),
}

_SOLID_RATES = {
    "flexible": Rates(
        0.01,
        0.006,
        (0.0055, 0.012),
        0.01,
        waiting_constant=0.08,
        likely_crossings=23,
        likely_softening=930,
    ),
    "rigid": Rates(0.01, 0.003, (0.012, 0.02), 0.01, likely_crossings=30, likely_softening=1020),
}

KIND = TestKind(
    name="scb",
    order=6,
    about="half a disc with a notch on two supports, loaded on top",
    variants={
        "half-disc": Variant(_RATES, results={"flexible": 6, "rigid": 5}),
        "solid-half-disc": Variant(_SOLID_RATES),
    },
    options=(
        Option("span", "Distance between the supports", "m", default="0.6 of the diameter"),
        Option(
            "notch", "Depth of a notch in the middle", "m", NOT_NEGATIVE, default="half the radius"
        ),
        bent.CONTROL,
    ),
    settle=_settle,
    controls=bent.CONTROLS,
    rig=Rig.PARTS,
    cut=bent.notch,
    takes_notch=True,
    layout=bent.on_rollers,
    stop_ratio=0.1,
    largest_strain=20.0,
    likely_power=0.85,
    pulled=True,
    no_constants=("youngs_modulus",),
    measure=_measure,
    title="SCB",
    words=bent.WORDS,
    calibrates={"scb_toughness": "fracture_toughness"},
    scored="notched",
)
