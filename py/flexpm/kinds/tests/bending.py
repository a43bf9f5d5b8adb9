# SPDX-License-Identifier: GPL-3.0-or-later
"""Three-point bending of a beam on two supports. Deviation D39."""

from __future__ import annotations

from collections.abc import Mapping

from ...require import NOT_NEGATIVE, Bounds
from .. import bent
from ..layout import Frame
from ..model_names import BLOCK_MODELS
from ..option import Asked, Option, Value
from ..rates import Rates
from ..test_kind import Rig, TestKind, Variant
from ..toughness import bending_toughness, require_span
from ..words import Columns

#: Span over the height, and at most over the length, unless it is given [-].
_SPAN, _LARGEST_SPAN = 4.0, 8.0 / 9.0


def _settle(asked: Asked) -> Mapping[str, Value]:
    width, height = asked.sizes["width"], asked.sizes["height"]
    usual = min(_SPAN * height, _LARGEST_SPAN * width)
    span = bent.span_of(asked, usual, width)
    notch = asked.number("notch", 0.0, Bounds(at_least=0.0, below=height))
    require_span(span, height, notch)
    return {"span": span, "notch": notch}


def _measure(frame: Frame, record: Columns, peak: float | None) -> Mapping[str, float | None]:
    def toughness(load: float) -> float | None:
        return bending_toughness(
            load,
            span=frame.number("span"),
            height=frame.height,
            thickness=frame.thickness,
            notch=frame.notch_depth,
        )

    return bent.measured(frame, record, peak, toughness)


_RATES = {
    "flexible": Rates(0.01, 0.005, (0.004, 0.012), 0.01, likely_crossings=10, likely_softening=680),
    "rigid": Rates(0.01, 0.0015, (0.002, 0.004), 0.01, likely_crossings=17, likely_softening=600),
}

_SOLID_RATES = {
    "flexible": Rates(
        0.01, 0.005, (0.004, 0.012), 0.01, likely_crossings=10, likely_softening=1050
    ),
    "rigid": Rates(0.01, 0.0015, (0.002, 0.004), 0.01, likely_crossings=17, likely_softening=1100),
}

KIND = TestKind(
    name="bending",
    order=5,
    about="a beam on two supports, loaded in the middle",
    variants={
        "rectangle": Variant(
            rates=_RATES,
            sizes={"width": 0.18, "height": 0.04},
            results=dict.fromkeys(BLOCK_MODELS, 4),
        ),
        "box": Variant(_SOLID_RATES, sizes={"width": 0.09, "depth": 0.02, "height": 0.02}),
    },
    options=(
        Option("length", "Length of a beam", "m", default="0.18; its height: 0.04", size="width"),
        Option(
            "span",
            "Distance between the supports",
            "m",
            default="4 times the height, or 8/9 of the length",
        ),
        Option("notch", "Depth of a notch in the middle", "m", NOT_NEGATIVE, default="none"),
        bent.CONTROL,
    ),
    settle=_settle,
    controls=bent.CONTROLS,
    rig=Rig.PARTS,
    cut=bent.notch,
    takes_notch=True,
    layout=bent.on_rollers,
    stop_ratio=0.1,  # its work counts up to the end
    largest_strain=20.0,  # it is bent until it is broken through
    likely_power=0.85,  # it ends with all of its cracks open
    pulled=True,
    no_constants=("youngs_modulus",),  # the slope of a beam
    measure=_measure,
    words=bent.WORDS,
    calibrates={"beam_toughness": "fracture_toughness"},
)
