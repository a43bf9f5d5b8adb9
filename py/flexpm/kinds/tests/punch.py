# SPDX-License-Identifier: GPL-3.0-or-later
"""Punch-through shear: the middle of a rectangle is pushed out between two bridges. Deviation D65.

After T. Backers, O. Stephansson: ISRM suggested method for the determination of mode II fracture
toughness. Rock Mechanics and Rock Engineering 45 (2012) 1011-1022, in 2D.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...errors import InputError
from ...require import NOT_NEGATIVE, Bounds
from .. import slid
from ..layout import LEFT, RIGHT, Frame, Layout, Lines, Plate
from ..model_names import BLOCK_MODELS
from ..option import Asked, Option, Value
from ..part_measures import residual, work
from ..test_kind import Rig, Stage, TestKind, Variant
from ..words import CRACKS, Columns, Words, stress

#: Depth of a notch over the height, distance of the pairs over the width, unless given [-].
_NOTCH, _DISTANCE = 0.2, 0.4
#: Fewest grains along a bridge: notches go on to the ends of their last grains (D35).
_FEWEST_GRAINS = 4.0
#: Least distance of the pairs from each other and from the sides, in mean diameters [-].
_LEAST_DISTANCE = 3.0
#: Notches are slots whose faces carry no load: the bridges carry the whole normal force.
_SLOT = {"open": True, "friction": 0.0, "normal_stiffness": 1e6, "shear_stiffness": 1e6}


def _settle(asked: Asked) -> Mapping[str, Value]:
    width, height = asked.sizes["width"], asked.sizes["height"]
    bridge, apart = _FEWEST_GRAINS * asked.grain, _LEAST_DISTANCE * asked.grain
    long, far = (
        f"{what} at least {grains:g} mean grains of {asked.grain:g} m {where}; take smaller grains "
        "or a larger specimen"
        if asked.grain > 0.0
        else ""
        for what, grains, where in (
            ("a bridge between two notches has", _FEWEST_GRAINS, "along it"),
            ("pairs of notches lie", _LEAST_DISTANCE, "from each other and from the sides"),
        )
    )
    if not height > bridge:
        raise InputError(f"run: height = {height:g} m, must be > {bridge:g} m: {long}")
    deepest = 0.5 * (height - bridge)
    notch = asked.number("notch", _NOTCH * height, Bounds(at_least=0.0, below=deepest), why=long)
    bounds = Bounds(above=apart, below=width - 2.0 * apart)
    distance = asked.number("distance", _DISTANCE * width, bounds, why=far)
    found: dict[str, Value] = {"notch": notch, "distance": distance}
    return found | slid.way(asked, height)


def _places(frame: Frame) -> tuple[float, float]:
    """Return the coordinates of both pairs of notches along x [m]."""
    half = 0.5 * frame.number("distance")
    return frame.middle - half, frame.middle + half


def _cut(frame: Frame) -> Lines:
    depth = frame.number("notch")
    if not depth:
        return []
    return [
        [[x, edge], [x, edge + inwards * depth]]
        for x in _places(frame)
        for edge, inwards in ((frame.bottom, 1.0), (frame.top, -1.0))
    ]


def _bridges(frame: Frame) -> tuple[float, float]:
    """Return the lengths of both bridges as cut [m]."""
    half = 0.5 * (frame.bottom + frame.top)
    ends = [(float(x), float(y)) for x, y in frame.notch.reshape(-1, 2)]

    def of(side: float) -> float:
        heights = [y for x, y in ends if side * (x - frame.middle) > 0.0]
        low = max((y for y in heights if y < half), default=frame.bottom)
        high = min((y for y in heights if y > half), default=frame.top)
        return high - low

    return of(-1.0), of(1.0)


def _area(frame: Frame) -> float:
    return sum(_bridges(frame)) * frame.thickness


def _punched(frame: Frame) -> Layout:
    """Return the layout: platen on the middle, supports at the outer parts, walls if pressed."""
    left, right = _places(frame)
    pressure = frame.number("confinement")
    clear = 0.5 * frame.grain  # of a platen from a notch
    outer = 0.5 * (frame.width - frame.number("distance")) - clear
    plates = {
        name: Plate((x, frame.bottom), (0.0, 1.0), outer)
        for name, x in (("left", frame.left + 0.5 * outer), ("right", frame.right - 0.5 * outer))
    }
    # without walls the punch alone keeps all from drifting aside
    size, pinned = right - left - 2.0 * clear, not pressure > 0.0
    plates["punch"] = Plate((frame.middle, frame.top), (0.0, -1.0), size, pinned=pinned)
    if pressure > 0.0:
        plates |= {"wall": Plate(side=LEFT), "jack": Plate(side=RIGHT)}
    return Layout(
        plates=plates,
        driven=("punch",),
        direction=(0.0, -1.0),
        against=("left", "right"),
        area=_area(frame),
        length=frame.height,
        strength=frame.shear_strength(pressure),
        pressed="jack" if pressure > 0.0 else "",
        also={"shear_stress": "axial_stress"},
    )


def _measure(frame: Frame, record: Columns, _: float | None) -> Mapping[str, float | None]:
    load = record["load"]
    return {
        "peak_load": float(load.max()) if len(load) else None,
        "residual_strength": residual(record),
        "fracture_energy": work(record) / _area(frame) if len(load) else None,
        "notch_depth": 0.5 * (frame.height - 0.5 * sum(_bridges(frame))),
    }


KIND = TestKind(
    name="punch",
    order=8,
    about="punch-through shear: a platen pushes the part between two pairs of notches out of a "
    "rectangle, whose outer parts are on supports; its stress is the load divided by the area of "
    "both bridges",
    variants={
        "rectangle": Variant(
            rates=slid.RATES,
            sizes={"width": 0.08, "height": 0.04},
            results=dict.fromkeys(BLOCK_MODELS, 3),  # unbalanced_ratio of the jack, D103
        ),
        "box": Variant(slid.SOLID_RATES, sizes={"width": 0.06, "depth": 0.02, "height": 0.03}),
    },
    options=(
        Option(
            "notch",
            "Depth of each of the four notches, which form two pairs: one notch from above, the "
            "other from below",
            "m",
            NOT_NEGATIVE,
            default="0.2 of the height",
        ),
        Option(
            "distance", "Distance between the two pairs of notches", "m", default="0.4 of the width"
        ),
        slid.WAY,
    ),
    without=("stop_ratio", "max_strain"),
    settle=_settle,
    confined=True,
    rig=Rig.PARTS,
    stages=(Stage.PRESS, Stage.SLIDE),
    cut=_cut,
    notch_law=_SLOT,
    ligament=lambda frame: min(_bridges(frame)),
    layout=_punched,
    slides=True,
    needs_peak=False,
    no_constants=("youngs_modulus",),
    measure=_measure,
    words=Words(
        slid.DRAWN,
        stress("shear stress of the bridges"),
        "peak shear stress",
        ("peak_stress", "residual_strength", "fracture_energy", *CRACKS),
    ),
)
