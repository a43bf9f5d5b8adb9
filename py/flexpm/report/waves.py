# SPDX-License-Identifier: GPL-3.0-or-later
"""The pulse of a sonic test over time. Input in SI units; labels in µs and µm/s."""

from __future__ import annotations

from pathlib import Path

from matplotlib import rc_context
from matplotlib.figure import Figure

from ..files import remove_earlier
from ..results import waves
from ..results.result import Result
from .style import CYCLE, STYLE, save
from .tables import scaled, size_text, test_text

#: What the sections are called, the lower one first.
SECTIONS = ("lower section", "upper section")
#: Factors of a picture's units.
MICRO = 1e6


def wave_picture(path: Path | str, result: Result) -> None:
    """Draw the velocities of both sections and when the centre of the pulse passes each."""
    record = result.curve
    if len(record) < 3:
        remove_earlier(path)
        return
    with rc_context(STYLE):
        figure = Figure(figsize=(5.6, 3.9), layout="constrained")
        axes = figure.add_subplot()
        time = record[waves.TIME]
        drawn = zip(SECTIONS, waves.velocities(record), waves.DISPLACEMENTS, CYCLE, strict=False)
        for label, velocity, column, colour in drawn:
            axes.plot(MICRO * time, MICRO * velocity, color=colour, lw=1.4, label=label)
            middle = waves.centre(time, record[column])
            axes.axvline(MICRO * middle, color=colour, lw=1.0, ls=(0, (5, 3)))
        axes.set_xlabel("time [µs]")
        axes.set_ylabel("mean velocity [µm/s]")
        axes.set_xlim(left=0.0)
        axes.legend(frameon=False, loc="upper center", title=speed_text(result))
        axes.set_title(f"{test_text(result)}\n{size_text(result)}", fontsize=9.5, loc="left")
        save(figure, path)


def speed_text(result: Result) -> str:
    """Speed of the wave of a sonic test, for a picture."""
    name, speed = ("v_p", result.vp) if result.vs is None else ("v_s", result.vs)
    return f"${name}$ = {scaled(speed, 1.0, 'm/s', 5)}"
