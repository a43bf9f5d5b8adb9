# SPDX-License-Identifier: GPL-3.0-or-later
"""Common parts of the tests of a beam and half a disc on two supports. Deviations D39, D50."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ..errors import InputError
from ..require import Bounds
from .layout import Frame, Layout, Lines, Opening, Plate
from .option import Asked, control_of
from .part_measures import work
from .words import CRACKS, Columns, Words, strain, stress

CONTROLS = {"displacement": "", "cmod": "cmod"}
CONTROL = control_of(*CONTROLS)
WORDS = Words(
    strain("strain of the outer fibre"),
    stress("bending stress"),
    "peak bending stress",
    (
        *("peak_load", "fracture_toughness", "fracture_energy"),
        *("peak_stress", "peak_strain"),
        *CRACKS,
    ),
)


def span_of(asked: Asked, usual: float, size: float) -> float:
    """Return the distance between the supports [m], above a mean grain diameter and below `size`.

    Args:
        asked: Options of the run.
        usual: Default [m].
        size: Size of the specimen [m].

    Raises:
        InputError: for a distance out of range.
    """
    why = ""
    if asked.grain > 0.0:
        why = f"both supports are more than one mean grain of {asked.grain:g} m apart"
    return asked.number("span", usual, Bounds(above=asked.grain, below=size), why=why)


def notch(frame: Frame) -> Lines:
    """Return a vertical line from the middle of the bottom, or no line for a notch depth of 0."""
    depth = frame.number("notch")
    if not depth:
        return []
    return [[[frame.middle, frame.bottom], [frame.middle, frame.bottom + depth]]]


def on_rollers(frame: Frame) -> Layout:
    """Return the layout: two rollers at the bottom, and a driven head at the middle of the top.

    Raises:
        InputError: for a span that is not above a mean grain diameter.
    """
    span, middle = frame.number("span"), frame.middle
    if not span > frame.grain:  # of grains that were given
        raise InputError(
            f"run: span = {span:g} m, must be > {frame.grain:g} m, the mean grain diameter: both "
            "supports would touch the same grains; use a larger span or smaller grains"
        )
    ligament = frame.height - frame.notch_depth
    rollers = {
        name: Plate((middle + side * 0.5 * span, frame.bottom), (0.0, 1.0))
        for name, side in (("left", -1.0), ("right", 1.0))
    }
    head = Plate((middle, frame.top), (0.0, -1.0), pinned=True)
    mouth = Opening((middle - frame.grain, frame.bottom), (middle + frame.grain, frame.bottom))
    return Layout(
        plates={**rollers, "head": head},
        driven=("head",),
        direction=(0.0, -1.0),
        against=tuple(rollers),
        area=2.0 * frame.thickness * ligament**2 / (3.0 * span),
        length=span**2 / (6.0 * frame.height),
        strength=frame.tensile_strength,
        openings={"cmod": mouth},
    )


def measured(
    frame: Frame, record: Columns, peak: float | None, toughness: Callable[[float], float | None]
) -> Mapping[str, float | None]:
    """Return peak load, fracture energy and, with a notch, the `toughness` of the peak load."""
    notch = frame.notch_depth
    found: dict[str, float | None] = {"notch_depth": notch}
    if peak is None:
        return found
    load = float(record["load"].max())
    found |= {
        "peak_load": load,
        "fracture_energy": work(record) / (frame.thickness * (frame.height - notch)),
    }
    if notch > 0.0:
        found["fracture_toughness"] = toughness(load)
    return found
