# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of a test on several packings with the mean peak. SI units; labels in MPa and %."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from .style import CYCLE, Axes, drawing
from .words import words_of_test

#: Strains [-] and stresses [Pa] beyond this are not drawn.
_LARGEST = 1e30


@dataclass(frozen=True)
class Group:
    """Runs that differ in the packing alone.

    Attributes:
        label: Model and confinement.
        curves: Plotted quantities, such as axial stress [Pa] over axial strain [-], x first, and
            whether the run counts in the means.
        peak: Mean strain [-] and stress [Pa] of the peaks, nan without any.
        scatter: Their standard deviations, nan for fewer than two peaks.
        count: How many of the runs count, in words.
    """

    label: str
    curves: Sequence[tuple[FloatArray, FloatArray, bool]]
    peak: tuple[float, float]
    scatter: tuple[float, float]
    count: str


def packings_picture(path: Path | str, test: str, groups: Sequence[Group]) -> None:
    """Draw the records of all packings and the mean peaks with their standard deviations.

    Failed runs are dotted; runs that cannot be plotted are left out.

    Args:
        path: Picture to write.
        test: For the caption.
        groups: One colour each.
    """
    names = words_of_test(test)
    with drawing(path, (6.2, 4.4)) as axes:
        for number, group in enumerate(groups):
            colour = CYCLE[number % len(CYCLE)]
            for strain, stress, counts in group.curves:
                if not np.any(np.abs([strain, stress]) > _LARGEST):
                    style = "-" if counts else ":"
                    places = names.x.factor * strain, names.y.factor * stress
                    axes.plot(*places, color=colour, lw=0.8, alpha=0.55, ls=style)
            if "peak_stress" in names.measures:
                _draw_mean(axes, group, colour)
            else:
                axes.plot([], [], color=colour, label=f"{group.label} ({group.count} runs)")
        axes.set_xlabel(names.x.label)
        axes.set_ylabel(names.y.label)
        axes.set_xlim(left=0.0)
        axes.set_ylim(bottom=0.0)
        peaks = (
            "mean and standard deviation of the peaks" if "peak_stress" in names.measures else None
        )
        axes.legend(frameon=False, title=peaks)
        axes.set_title(f"{test}, several packings", fontsize=9.5, loc="left")


def _draw_mean(axes: Axes, group: Group, colour: str) -> None:
    if not math.isfinite(group.peak[1]):
        axes.plot([], [], color=colour, label=f"{group.label}: no peak ({group.count} runs)")
        return
    bars = [0.0 if math.isnan(value) else value for value in group.scatter]
    said = "" if math.isnan(group.scatter[1]) else f" ± {1e-6 * group.scatter[1]:.3g}"
    axes.errorbar(
        100.0 * group.peak[0],
        1e-6 * group.peak[1],
        xerr=100.0 * bars[0],
        yerr=1e-6 * bars[1],
        color=colour,
        marker="o",
        ms=6.0,
        mfc="white",
        mew=1.4,
        lw=1.6,
        capsize=4.0,
        zorder=5,
        label=f"{group.label}: {1e-6 * group.peak[1]:.4g}{said} MPa ({group.count} runs)",
    )
