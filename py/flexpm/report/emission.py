# SPDX-License-Identifier: GPL-3.0-or-later
"""Acoustic emission of a run: a picture and a table. Input in SI units; labels in mm, MPa and %."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..arrays import FloatArray
from ..files import remove_earlier
from ..results.cracks import MODES, SHEAR, TENSILE
from ..results.emission import BIN, FEWEST, AnyEvent, binned, fits
from ..results.result import Result
from ..results.snapshot import Snapshot
from ..results.solids.state import drawn_state
from ..text import label_of
from .curves import fits_a_picture, places_of
from .maps import draw_grains
from .pages.page import Rows
from .style import COLOURS, STYLE, can_be_drawn, save
from .tables import scaled
from .words import words_of_result

#: Area of an event of the largest magnitude [point2]; one magnitude less has a tenth of it.
_LARGEST = 350.0
#: Area of the smallest events, which would not be seen otherwise [point2].
_SMALLEST = 1.5
#: Resolution: the page of a run has a copy of the picture and is to stay small.
_DPI = 130
#: Events that a page lists.
_LISTED = 10


def emission_picture(path: Path | str, result: Result, caption: str = "") -> None:
    """Draw the events on the grains, their number over strain and over magnitude.

    A run without events, or with numbers that a picture has no room for, is not drawn.

    Args:
        path: Picture to write.
        result: The run, with its final state.
        caption: Line above the picture.
    """
    snapshot, events = drawn_state(result.snapshot), result.emission
    drawable = snapshot is not None and can_be_drawn(snapshot.positions)
    if snapshot is None or not events or not drawable or not fits_a_picture(result.curve):
        remove_earlier(path)
        return
    with rc_context({**STYLE, "savefig.dpi": _DPI}):
        figure = Figure(figsize=(7.4, 4.6), layout="constrained")
        grid = figure.add_gridspec(2, 2, width_ratios=(1.0, 1.25))
        _draw_places(figure.add_subplot(grid[:, 0], aspect="equal"), snapshot, events)
        _draw_growth(figure.add_subplot(grid[0, 1]), result, events)
        _draw_frequencies(figure.add_subplot(grid[1, 1]), result, events)
        figure.suptitle(label_of(caption), fontsize=9.5, x=0.01, ha="left")
        save(figure, path)


def _draw_places(axes: Axes, snapshot: Snapshot, events: Sequence[AnyEvent]) -> None:
    draw_grains(axes, snapshot)
    places = 1e3 * np.array(
        [(one.x, one.y if one.z is None else one.z) for one in events]  # in a section x, z
    )
    magnitudes = _magnitudes(events)
    areas = _LARGEST * 10.0 ** (magnitudes - np.nanmax(magnitudes, initial=-np.inf))
    areas = np.fmax(areas, _SMALLEST)
    order = np.argsort(-areas)  # small ones over large ones
    colours = np.array([COLOURS[one.mode] for one in events])
    axes.scatter(
        *places[order].T,
        s=areas[order],
        c=colours[order],
        alpha=0.55,
        edgecolors="black",
        linewidths=0.3,
        zorder=3,
    )
    axes.set_axis_off()
    handles = [
        Line2D(
            [], [], ls="", marker="o", color=COLOURS[mode], alpha=0.55, label=_label(mode, events)
        )
        for mode in (TENSILE, SHEAR)
    ]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.02), frameon=False)


def _label(mode: int, events: Sequence[AnyEvent]) -> str:
    return f"{MODES[mode]} events ({sum(one.mode == mode for one in events)})"


def _draw_growth(axes: Axes, result: Result, events: Sequence[AnyEvent]) -> None:
    record, names = result.curve, words_of_result(result)
    places = places_of(result, np.sort([one.strain for one in events]))
    counts = axes.twinx()
    counts.step(places, np.arange(1, len(places) + 1), where="post", color=COLOURS[TENSILE])
    counts.set_ylabel("number of events [-]", color=COLOURS[TENSILE])
    counts.set_ylim(bottom=0.0)
    counts.spines["right"].set_visible(True)
    axes.set_zorder(counts.get_zorder() + 1)  # the curve lies over the counts
    axes.patch.set_visible(False)
    axes.plot(names.x.of(record), names.y.of(record), color="black", lw=1.2)
    axes.set_xlabel(names.x.label)
    axes.set_ylabel(names.y.label)
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)


def _draw_frequencies(axes: Axes, result: Result, events: Sequence[AnyEvent]) -> None:
    bins = binned(_magnitudes(events))
    axes.set_xlabel("magnitude M [-]")
    axes.set_ylabel("events of M or more [-]")
    if len(bins) == 0:
        return
    steps = np.arange(bins.min(), bins.max() + 1)
    numbers = np.array([np.count_nonzero(bins >= step) for step in steps])
    axes.semilogy(BIN * steps, numbers, "o", ms=3.0, color="0.35")
    least, b = result.completeness_magnitude, result.b_value
    if least is None or b is None:
        return
    number = np.count_nonzero(bins >= round(least / BIN))
    ends = np.array([least, BIN * bins.max()])
    line = number * 10.0 ** (-b * (ends - least))
    label = f"b = {b:.2f} ± {result.b_value_error:.2f}"
    axes.semilogy(ends, line, color="black", lw=1.2, label=label)
    axes.legend(frameon=False)


def emission_table(result: Result) -> Rows | None:
    """The largest events, for a page; None without events."""
    if not result.emission:
        return None
    largest = sorted(result.emission, key=lambda one: -one.energy)[:_LISTED]
    words = words_of_result(result)
    rows = [
        (
            scaled(float(places_of(result, one.strain)), 1.0, words.x.unit),
            _place(one),
            str(one.points),
            MODES[one.mode],
            scaled(one.energy, 1.0, "J", 3),
            scaled(one.magnitude, 1.0, "", 3),
        )
        for one in largest
    ]
    header = (words.over, "centre", "points", "mode", "energy", "magnitude")
    return Rows("Acoustic emission: the largest events", header, rows, _note(result))


def _place(event: AnyEvent) -> str:
    """Return the centre of an event: x, y and, in 3D, z."""
    places = [one for one in (event.x, event.y, event.z) if one is not None]
    return ", ".join(scaled(one, 1e3, "", 3) for one in places) + " mm"


def _note(result: Result) -> str:
    text = (
        f"{result.events} events are in events.csv. Points form one event if they crack within one "
        "mean grain diameter and within the time that a fracture needs to cross it. "
        "log10 E [J] = 1.5 M + 4.8, where E is the damage energy."
    )
    if result.b_value is None or result.b_value_error is None:
        return f"{text} No b value: {_without_line(result)}."
    return (
        f"{text} b = {result.b_value:.2f} ± {result.b_value_error:.2f} for magnitudes of at least "
        f"{result.completeness_magnitude:.1f}."
    )


def _without_line(result: Result) -> str:
    """Return the reason why there is no b value."""
    found = fits(_magnitudes(result.emission or []))
    if not found or found[0].number < FEWEST:
        return f"fewer than {FEWEST} events above the magnitude of completeness"
    lines = (f"{one.b_value:.2f} ± {one.b_error:.2f} above {one.least:.1f}" for one in found)
    return f"the event counts are not on a line; its slope would be {', '.join(lines)}"


def _magnitudes(events: Sequence[AnyEvent]) -> FloatArray:
    return np.array([one.magnitude for one in events])
