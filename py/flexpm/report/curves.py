# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of tests: stress over strain (paper Figs. 8, 15), the pulse of a sonic test over time.

Input in SI units; labels in MPa and %, µs and µm/s.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..arrays import FloatArray
from ..files import remove_earlier
from ..kinds.registry import kind_of
from ..materials.keys import is_used
from ..results import core, measures, waves
from ..results.cracks import SHEAR, TENSILE
from ..results.record import Curve
from ..results.result import Result
from ..text import label_of
from .style import COLOURS, CYCLE, MODE_NAMES, STYLE, save
from .tables import pressures_text, scaled, size_text, test_text
from .words import words_of_result

#: What the sections are called, the lower one first.
SECTIONS = ("lower section", "upper section")
#: Factors of a picture's units.
MICRO = 1e6
#: Strains [-] and stresses [Pa] beyond this are not drawn.
_LARGEST = 1e30

#: Share of the width near an axis in which the peak's label stands on the inner side of the peak.
_MARGIN = 0.12


class VolumeLine(NamedTuple):
    """A volumetric strain up to the peak."""

    label: str
    strain: FloatArray  #: [-]
    mark: int | None = None  #: row of the stress that is read off it
    dashed: bool = False


class Volumes(NamedTuple):
    """Volumetric strains of a core up to its peak: total, elastic, of cracks."""

    name: str
    title: str
    lines: Sequence[VolumeLine]


def fits_a_picture(record: Curve) -> bool:
    """Whether there is no number that a picture has no room for; nan leaves a gap."""
    drawn = np.abs([record["axial_strain"], record["axial_stress"]])
    return not np.any(drawn > _LARGEST)


def peak_place(result: Result) -> tuple[float, float] | None:
    """Where the peak lies in a picture of the record, in the units of its axes."""
    # a script's own test without an area has a load for stress
    peak = result.peak_load if result.peak_stress is None else result.peak_stress
    if peak is None or not len(result.curve):
        return None
    row = np.argmin(np.abs(result.curve["axial_stress"] - peak))
    names = words_of_result(result)
    return float(names.x.of(result.curve)[row]), float(names.y.of(result.curve)[row])


def places_of(result: Result, strain: float | FloatArray) -> FloatArray:
    """Where axial strains of a record lie along the axis x of a picture, in its unit."""
    axis = words_of_result(result).x
    if axis.column == "axial_strain":
        return axis.factor * np.asarray(strain)
    return np.interp(strain, result.curve["axial_strain"], axis.of(result.curve))


def volumes_of(result: Result) -> Volumes | None:
    """Return the volumetric strains of a core, or area strains in 2D; None if it has none.

    Without a peak and moduli only the total strain is returned.
    """
    record, solid = result.curve, result.tetrahedra is not None
    if not kind_of(result.test).is_core or not len(record):
        return None
    peak = measures.peak_row(record)
    end = len(record) if peak is None else peak + 1
    total = core.volumetric_strain(record, solid=solid)[:end]
    if not np.all(np.abs(total) < _LARGEST):
        return None
    deviator = measures.differential_stress(record)[:end]

    def line(label: str, strain: FloatArray, stress: float | None, read: str) -> VolumeLine:
        if stress is None:
            return VolumeLine(label, strain)
        return VolumeLine(f"{label}, {read}", strain, int(np.argmin(np.abs(deviator - stress))))

    damage, begun = "maximum: crack damage", "marker: crack initiation"
    lines = [line("total", total, result.crack_damage_stress, damage)]
    modulus, ratio = result.start_moduli
    if peak is not None and modulus is not None and ratio is not None:
        elastic = core.elastic_volumetric_strain(record, modulus, ratio, solid=solid)[:end]
        initiation = result.crack_initiation_stress_volumetric
        lines.append(VolumeLine("elastic strain", elastic, dashed=True))
        lines.append(line("crack strain", total - elastic, initiation, begun))
    name = "volumetric strain" if solid else "area strain"
    told = "" if peak is None else " up to the peak"
    return Volumes(name, f"{name.capitalize()}{told}{_state(result)}", lines)


def _state(result: Result) -> str:
    """Return whether E and nu are for plane stress or strain; empty in 3D and without triangles."""
    if result.tetrahedra is not None or not is_used("plane", result.model):
        return ""
    state = result.material.get("plane")
    return f", plane {state}" if state else ""


def curve_picture(path: Path | str, result: Result) -> None:
    """Plot stress and crack counts over strain, the line of Young's modulus, and the peak.

    For a core the volumetric strains are below. The record of a diverged run, with numbers out of
    any sensible range, is not plotted.
    """
    if not fits_a_picture(result.curve):
        remove_earlier(path)
        return
    with rc_context(STYLE):
        record, names = result.curve, words_of_result(result)
        volumes = volumes_of(result)
        rows, heights = (1, [4.3]) if volumes is None else (2, [4.0, 2.5])
        figure = Figure(figsize=(5.6, sum(heights)), layout="constrained")
        panels = figure.subplots(rows, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
        axes, lowest = panels[0], panels[-1]
        counts = axes.twinx()
        _draw_counts(counts, names.x.of(record), record)
        axes.set_zorder(counts.get_zorder() + 1)  # the curve lies over the counts
        axes.patch.set_visible(False)
        (line,) = axes.plot(names.x.of(record), names.y.of(record), color="black", lw=1.6)
        line.set_label(names.y.name)
        _draw_modulus(axes, result)
        lowest.set_xlabel(names.x.label)
        axes.set_ylabel(names.y.label)
        axes.set_xlim(left=0.0)
        if volumes is not None:
            _draw_volumes(lowest, names.x.of(record), volumes)
        _draw_peak(axes, result)
        axes.set_ylim(bottom=0.0, top=1.18 * axes.get_ylim()[1])  # room for the peak's label
        handles = [*axes.get_legend_handles_labels()[0], *counts.get_legend_handles_labels()[0]]
        # below the axes, where it covers neither the curve nor the peak's label
        under = (0.5, -0.16 if volumes is None else -0.06)
        axes.legend(
            handles=handles, loc="upper center", bbox_to_anchor=under, ncol=2, frameon=False
        )
        axes.set_title(_caption(result), fontsize=9.5, loc="left")
        save(figure, path)


def _draw_counts(axes: Axes, strain: FloatArray, record: Curve) -> None:
    for mode, column in ((TENSILE, "tensile_cracks"), (SHEAR, "shear_cracks")):
        axes.plot(strain, record[column], color=COLOURS[mode], lw=1.1, label=MODE_NAMES[mode])
    axes.set_ylabel("cracked contact points [-]")
    axes.set_ylim(bottom=0.0, top=max(1.0, 1.18 * axes.get_ylim()[1]))
    axes.spines["right"].set_visible(True)


def _draw_volumes(axes: Axes, strain: FloatArray, volumes: Volumes) -> None:
    colours = ("black", "0.45", CYCLE[2])
    axes.axhline(0.0, color="0.8", lw=0.8)
    for line, colour in zip(volumes.lines, colours, strict=False):
        over, values = strain[: len(line.strain)], 100.0 * line.strain
        dash = (0, (5, 3)) if line.dashed else "-"
        axes.plot(over, values, color=colour, ls=dash, lw=1.4, label=line.label)
        if line.mark is not None:
            place = over[line.mark], values[line.mark]
            axes.plot(*place, "o", ms=5.0, mfc="white", mec=colour, mew=1.2)
    axes.set_ylabel(f"{volumes.name} [%]")
    axes.set_title(volumes.title, fontsize=9.5, loc="left")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.28), ncol=2, frameon=False)


def _draw_modulus(axes: Axes, result: Result) -> None:
    rows = measures.elastic_rows(result.curve)
    if result.youngs_modulus is None or rows.stop <= rows.start:
        return
    strain = result.curve["axial_strain"]
    stress = result.curve["axial_stress"]
    middle = np.mean(strain[rows]), np.mean(stress[rows])
    top = np.nanmax(stress)
    ends = np.array([max(0.0, middle[1] - result.youngs_modulus * middle[0]), top])
    places = middle[0] + (ends - middle[1]) / result.youngs_modulus
    label = f"E = {1e-9 * result.youngs_modulus:.1f} GPa"
    names = words_of_result(result)
    across = names.x.factor if names.x.column == "axial_strain" else 100.0
    up = names.y.factor if names.y.column == "axial_stress" else 1e-6
    axes.plot(across * places, up * ends, color="0.45", lw=1.0, ls=(0, (5, 3)), label=label)


def _draw_peak(axes: Axes, result: Result) -> None:
    place = peak_place(result)
    if place is None:
        return
    axes.plot(*place, "o", ms=5.0, mfc="white", mec="black", mew=1.2)
    along = place[0] / axes.get_xlim()[1]
    side = "left" if along < _MARGIN else "right" if along > 1.0 - _MARGIN else "center"
    unit = words_of_result(result).y.unit
    text = f"{place[1]:.1f} MPa" if unit == "MPa" else f"{place[1]:.4g} {unit}"
    axes.annotate(text, place, (0, 7), textcoords="offset points", ha=side)


def _caption(result: Result) -> str:
    confined = pressures_text(result)
    name = label_of(result.material.get("name", ""))
    where = f", confining pressure {confined}" if confined else ""
    caption = f"{result.test}, {result.model} model, {name}{where}"
    if result.status != "ok":
        caption += f" ({result.status.replace('_', ' ')})"
    return f"{caption}\n{size_text(result)}"


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
