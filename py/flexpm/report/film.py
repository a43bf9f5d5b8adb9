# SPDX-License-Identifier: GPL-3.0-or-later
"""Film of a run: its deformed grains with their cracks, beside the curve. Input in SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from matplotlib import animation, rc_context
from matplotlib.figure import Figure

from ..files import whole_file
from ..results.result import Result
from ..results.vtu import read_vtu
from .curves import fits_a_picture, places_of
from .maps import draw_cracks, draw_joints
from .style import STYLE, can_be_drawn
from .tables import size_text, test_text
from .words import words_of_result

#: Frames a second.
_PACE = 8
#: Resolution [dots per inch].
_DOTS = 110
#: Room around the specimen as a part of its sides [-]: loose grains leave it.
_ROOM = 0.12


def has_ffmpeg() -> bool:
    """Whether the program that writes films of kind mp4 is there."""
    return bool(animation.FFMpegWriter.isAvailable())


def write_film(path: Path, result: Result, frames: Sequence[tuple[Path, float, float]]) -> None:
    """Write a film, whole or not at all.

    Args:
        path: The film; its ending is its kind.
        result: The run.
        frames: File, axial strain [-] and axial stress [Pa] of each frame.
    """
    states = [
        (replace(read_vtu(file), joint_names=result.joint_names), strain, stress)
        for file, strain, stress in frames
    ]
    states = [state for state in states if can_be_drawn(state[0].positions)]
    if not states or not fits_a_picture(result.curve):
        return
    places = 1e3 * states[0][0].reference
    low, high = places.min(axis=0), places.max(axis=0)
    room = _ROOM * (high - low)
    width, height = high - low + 2.0 * room
    with rc_context(STYLE), whole_file(path) as temporary:
        figure = Figure(figsize=(4.6 * width / height + 4.6, 5.2), layout="constrained")
        rock, curve = figure.subplots(1, 2, width_ratios=(width / height, 1.0))
        figure.suptitle(f"{test_text(result)}\n{size_text(result)}", fontsize=9.5)
        names = words_of_result(result)
        curve.plot(names.x.of(result.curve), names.y.of(result.curve), color="black", lw=1.4)
        curve.set(xlabel=names.x.label, ylabel=names.y.label, xlim=(0, None))
        curve.set_ylim(bottom=0.0)
        (now,) = curve.plot([], [], "o", ms=7.0, color="#d55e00")
        writer = _writer(path.suffix)
        with writer.saving(figure, str(temporary), _DOTS):
            for snapshot, at, stress in states:
                rock.clear()
                rock.set_axis_off()
                rock.set(aspect="equal", xlim=(low[0] - room[0], high[0] + room[0]))
                rock.set_ylim(low[1] - room[1], high[1] + room[1])
                draw_cracks(rock, snapshot)
                draw_joints(rock, snapshot, result.notches)
                now.set_data([places_of(result, at)], [names.y.factor * stress])
                writer.grab_frame()


def _writer(suffix: str) -> animation.AbstractMovieWriter:
    if suffix == ".mp4":
        return animation.FFMpegWriter(fps=_PACE)
    return animation.PillowWriter(fps=_PACE)
