# SPDX-License-Identifier: GPL-3.0-or-later
"""Direct shear: the lower half of a rectangle slides below the upper half. Deviation D46."""

from __future__ import annotations

from collections.abc import Mapping

from .. import slid
from ..layout import BOTTOM, TOP, Frame, Layout, Opening, Plate
from ..model_names import BLOCK_MODELS
from ..option import PRESSURE, Asked, Option, Value
from ..part_measures import residual
from ..test_kind import Rig, Stage, TestKind, Variant
from ..words import CRACKS, Columns, Words, stress

#: On the upper half unless it is given [Pa].
_NORMAL_STRESS = 1e6


def _settle(asked: Asked) -> Mapping[str, Value]:
    pressure = asked.number("normal_stress", _NORMAL_STRESS, PRESSURE, "Pa")
    return {"normal_stress": pressure, **slid.way(asked, asked.sizes["width"])}


def _between_boxes(frame: Frame) -> Layout:
    """Return the layout: each half in a box, the lower box driven."""
    length = 0.5 * (frame.height - frame.grain)
    middle = 0.5 * (frame.bottom + frame.top)
    heights = {"lower": frame.bottom + 0.5 * length, "upper": frame.top - 0.5 * length}
    ends = {
        f"{half} {side}": Plate((x, height), (inwards, 0.0), length, bonded=True)
        for half, height in heights.items()
        for side, x, inwards in (("left", frame.left, 1.0), ("right", frame.right, -1.0))
    }
    above, below = ((frame.middle, middle + side * 0.5 * frame.grain) for side in (1.0, -1.0))
    return Layout(
        plates={**ends, "base": Plate(side=BOTTOM, bonded=True), "lid": Plate(side=TOP)},
        driven=("lower left", "lower right"),
        direction=(1.0, 0.0),
        against=("upper left", "upper right"),
        area=frame.width * frame.thickness,
        length=frame.height,
        strength=frame.shear_strength(frame.number("normal_stress")),
        pressed="lid",
        openings={"shear_displacement": Opening(above, below, (1.0, 0.0))},
        ways={"dilation": ("lid", (0.0, 1.0))},
        also={"shear_stress": "axial_stress"},
    )


def _measure(_: Frame, record: Columns, __: float | None) -> Mapping[str, float | None]:
    return {"residual_strength": residual(record)}


KIND = TestKind(
    name="shear",
    order=7,
    about="the lower half of a rectangle slides below the upper half, to the largest displacement",
    variants={
        "rectangle": Variant(
            rates=slid.RATES,
            sizes={"width": 0.08, "height": 0.04},
            results=dict.fromkeys(BLOCK_MODELS, 5),  # unbalanced_ratio of the lid, D103
        ),
        "box": Variant(slid.SOLID_RATES, sizes={"width": 0.04, "depth": 0.02, "height": 0.02}),
    },
    options=(
        Option("normal_stress", "Normal stress on the upper half", "Pa", default="1e6"),
        slid.WAY,
    ),
    without=("stop_ratio", "max_strain"),
    settle=_settle,
    confine_hint="; give normal_stress, a run for each",
    rig=Rig.PARTS,
    stages=(Stage.PRESS, Stage.SLIDE),
    pressure="normal_stress",
    layout=_between_boxes,
    slides=True,
    needs_peak=False,
    no_constants=("youngs_modulus",),  # the slope of a box
    measure=_measure,
    words=Words(
        slid.DRAWN,
        stress("shear stress"),
        "peak shear stress",
        ("peak_stress", "residual_strength", *CRACKS),
    ),
)
