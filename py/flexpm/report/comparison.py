# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of several runs: curves (paper Figs. 8, 9), crack maps (Fig. 10), envelope (Fig. 11).

Input in SI units; labels in MPa, % and mm.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..arrays import FloatArray
from ..materials.references import Reference
from ..results.cracks import SHEAR, TENSILE
from ..results.result import Result
from ..results.solids.state import drawn_state
from ..results.strength import Envelope, MohrCoulomb
from ..text import label_of
from .curves import fits_a_picture, peak_place
from .maps import draw_cracks, draw_joints
from .style import CYCLE, MODE_NAMES, STYLE, can_be_drawn, save
from .words import words_of_result

Runs = Sequence[tuple[str, Result]]

#: One colour for each model, then one dash for each confinement.
_DASHES = ("-", (0, (6, 2)), (0, (3, 2)), (0, (1, 1.5)), (0, (6, 2, 1, 2)), (0, (10, 3)))
_MARKERS = "osD^vP"
_MAPS_A_ROW = 4


def curves_picture(path: Path | str, runs: Runs) -> None:
    """Draw stress over strain of all runs, and below it their cracked points.

    Args:
        path: Picture to write.
        runs: Labels and results, without results that cannot be plotted.
    """
    runs = [(label, result) for label, result in runs if fits_a_picture(result.curve)]
    if not runs:
        return
    with rc_context(STYLE):
        figure = Figure(figsize=(6.2, 6.0), layout="constrained")
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(1.6, 1.0))
        for (label, result), (colour, dash) in zip(runs, _styles(runs), strict=True):
            names = words_of_result(result)
            over = names.x.of(result.curve)
            upper.plot(over, names.y.of(result.curve), color=colour, ls=dash, lw=1.4, label=label)
            if (place := peak_place(result)) is not None:
                upper.plot(*place, "o", ms=4.0, mfc="white", mec=colour, mew=1.1)
            cracks = result.curve["tensile_cracks"] + result.curve["shear_cracks"]
            lower.plot(over, cracks, color=colour, ls=dash, lw=1.4)
        names = words_of_result(runs[0][1])
        upper.set_ylabel(names.y.label)
        upper.legend(frameon=False, loc="best")
        upper.set_title(_caption(runs), fontsize=9.5, loc="left")
        lower.set_ylabel("cracked contact points [-]")
        lower.set_xlabel(names.x.label)
        for axes in (upper, lower):
            axes.set_xlim(left=0.0)
            axes.set_ylim(bottom=0.0)
        save(figure, path)


def cracks_picture(path: Path | str, runs: Runs) -> None:
    """Draw the crack maps of all runs in one scale; confinements of a model stand in a row."""
    drawn = [
        (label, one, state)
        for label, one in runs
        if (state := drawn_state(one.snapshot)) is not None and can_be_drawn(state.positions)
    ]
    if not drawn:
        return
    a_model = sum(result.model == drawn[0][1].model for _, result, _ in drawn)
    columns = min(len(drawn), a_model if a_model > 1 else _MAPS_A_ROW)
    rows = -(-len(drawn) // columns)
    places = 1e3 * np.concatenate([snapshot.positions for *_, snapshot in drawn])
    low, high = places.min(axis=0), places.max(axis=0)
    width, height = high - low
    margin = 0.08 * height  # below, for the scale bar
    size = (2.6 * columns, (2.6 * (height + margin) / width + 0.45) * rows + 0.4)
    with rc_context(STYLE):
        figure = Figure(figsize=size, layout="constrained")
        grid = figure.subplots(rows, columns, squeeze=False).ravel()
        for axes in grid:
            axes.set_axis_off()
        joints: list[Line2D] = []
        for axes, (label, result, snapshot) in zip(grid, drawn, strict=False):
            axes.set(aspect="equal", xlim=(low[0], high[0]), ylim=(low[1] - margin, high[1]))
            handles = draw_cracks(axes, snapshot)
            joints = draw_joints(axes, snapshot, result.notches) or joints
            counts = f"{result.tensile_cracks} tensile, {result.shear_cracks} shear"
            axes.set_title(f"{label}\n{counts}", fontsize=8.5)
        names = [MODE_NAMES[mode] for mode in (TENSILE, SHEAR)]
        names += [str(one.get_label()) for one in joints]
        legend = 0.3 * math.ceil(len(names) / 2) / size[1]  # keeps room for it
        figure.get_layout_engine().set(rect=(0.0, legend, 1.0, 0.99 - legend))
        handles = [*handles[:2], *joints]
        figure.legend(handles, names, loc="lower center", ncols=2, frameon=False)
        save(figure, path)


def envelope_picture(
    path: Path | str,
    envelopes: Sequence[Envelope],
    rock: Reference | None = None,
    title: str = "",
    runs: Sequence[tuple[float, float | None, str]] = (),
) -> None:
    """Draw the peaks over the confinements with both criteria.

    Args:
        path: Picture to write.
        envelopes: One for each model.
        rock: Measured properties, whose line is drawn, too.
        title: Line above the picture.
        runs: Confinement [Pa], peak [Pa] or None, and status of each run. Peaks of runs that are
            not ``ok`` are crossed out, and runs without a peak are counted.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=(5.8, 4.6), layout="constrained")
        axes = figure.add_subplot()
        widest = max(max(one.confinements) for one in envelopes)
        confinements = np.linspace(0.0, 1.04 * widest, 200)
        for number, one in enumerate(envelopes):
            _draw_envelope(axes, one, confinements, number)
        if rock is not None:
            line = MohrCoulomb(rock.cohesion, rock.friction_angle)
            stress = 1e-6 * line.strength(confinements)
            label = f"{rock.name}, measured: {_line_text(line)}"
            axes.plot(
                1e-6 * confinements, stress, color="black", lw=1.0, ls=(0, (1, 1.5)), label=label
            )
        _draw_doubtful(axes, runs)
        missing = sum(peak is None for _, peak, _ in runs)
        note = f"{missing} of {len(runs)} runs have no peak and are not plotted" if missing else ""
        lines = [line for line in (label_of(title), note) if line]
        axes.set_title("\n".join(lines), fontsize=9.5, loc="left")
        axes.set_xlabel("confining pressure [MPa]")
        axes.set_ylabel("largest axial stress [MPa]")
        axes.set_xlim(left=-0.02 * 1e-6 * widest)
        axes.set_ylim(bottom=0.0)
        axes.legend(frameon=False, loc="lower right")
        save(figure, path)


def _draw_envelope(axes: Axes, one: Envelope, confinements: FloatArray, number: int) -> None:
    colour = CYCLE[number % len(CYCLE)]
    marker = _MARKERS[number % len(_MARKERS)]
    places = 1e-6 * np.array([one.confinements, one.peaks])
    label = f"{one.model}: peaks"
    axes.plot(*places, marker, color=colour, ms=5.0, mfc="white", mew=1.3, label=label)
    if one.mohr_coulomb is not None:
        stress = one.mohr_coulomb.strength(confinements)
        label = f"{one.model}: {_line_text(one.mohr_coulomb)}"
        axes.plot(1e-6 * confinements, 1e-6 * stress, color=colour, lw=1.3, label=label)
    if one.hoek_brown is not None:
        label = (
            f"{one.model}: $\\sigma_{{ci}}$ = {1e-6 * one.hoek_brown.sigma_ci:.1f} MPa, "
            f"$m_i$ = {one.hoek_brown.m_i:.1f}"
        )
        stress = one.hoek_brown.strength(confinements)
        axes.plot(
            1e-6 * confinements, 1e-6 * stress, color=colour, lw=1.0, ls=(0, (5, 3)), label=label
        )


def _draw_doubtful(axes: Axes, runs: Sequence[tuple[float, float | None, str]]) -> None:
    """Cross out the peaks of runs with a status other than ``ok``."""
    statuses = dict.fromkeys(status for _, peak, status in runs if peak is not None)
    for status, marker in zip((one for one in statuses if one != "ok"), "x+12", strict=False):
        places = [(c, peak) for c, peak, one in runs if peak is not None and one == status]
        x, y = 1e-6 * np.array(places).T
        axes.plot(x, y, marker, color="black", ms=7.0, mew=1.2, ls="none", label=status)


def _line_text(line: MohrCoulomb) -> str:
    return f"c = {1e-6 * line.cohesion:.1f} MPa, $\\varphi$ = {line.friction_angle:.1f}°"


def _styles(runs: Runs) -> list[tuple[str, object]]:
    models = list(dict.fromkeys(result.model for _, result in runs))
    seen = dict.fromkeys(models, 0)
    found: list[tuple[str, object]] = []
    for _, result in runs:
        colour = CYCLE[models.index(result.model) % len(CYCLE)]
        found.append((colour, _DASHES[seen[result.model] % len(_DASHES)]))
        seen[result.model] += 1
    return found


def _caption(runs: Runs) -> str:
    first = runs[0][1]
    tests = " and ".join(dict.fromkeys(result.test for _, result in runs))
    seed = "" if first.seed is None else f", seed {first.seed}"
    materials = dict.fromkeys(label_of(result.material.get("name", "")) for _, result in runs)
    return f"{tests}, one packing of {first.grains} grains{seed}; {', '.join(materials)}"
