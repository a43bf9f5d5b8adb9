# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots for scripts, ``flexpm.plot``: maps of a state and the curve of a result.

Each map is a matplotlib figure, which a notebook shows and ``savefig`` writes. If a path is given,
the figure is also written. States are in SI units; labels in mm, MPa and um.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from ..arrays import FloatArray
from ..errors import InputError
from ..require import quoted, require_one_of
from ..results.fragments import Fragments
from ..results.snapshot import Snapshot
from ..results.solids.state import AnySnapshot
from ..results.stress.point_stress import OF_GRAINS
from ..results.stress.tensors import principal_stresses as principal_stresses
from ..text import label_of
from .curves import curve_picture as curve_picture
from .curves import fits_a_picture as fits_a_picture
from .curves import peak_place as peak_place
from .curves import places_of as places_of
from .maps import crack_figure, draw_scale_bar, fragment_figure, map_figure
from .style import STYLE, can_be_drawn, save

#: What `stress` draws, and what stands beside its scale.
STRESSES = {
    "xx": "stress xx",
    "yy": "stress yy",
    "xy": "shear stress xy",
    "principal_1": "larger principal stress",
    "principal_2": "smaller principal stress",
}
#: What `displacement` draws.
DISPLACEMENTS = {
    "size": "displacement",
    "x": "displacement along x",
    "y": "displacement along y",
}
#: Share of the grains' triangles whose stress the scale covers; more have the colours of its ends.
_COVERED = 0.99


def cracks(snapshot: AnySnapshot, path: Path | str | None = None, *, caption: str = "") -> Figure:
    """Plot the deformed grains with their cracks by mode.

    Args:
        snapshot: The state, ``model.snapshot()``; of a 3D state its section is plotted.
        path: File of the figure; None writes no file.
        caption: Line above the map.

    Returns:
        The figure.

    Raises:
        InputError: for a value that is not a state, or a state without positions, of a run that
            has diverged.

    Example:
        >>> figure = flexpm.plot.cracks(flexpm.build(specimen).snapshot(), caption="Intact")
        >>> len(figure.axes) > 0
        True
    """
    snapshot, _ = _drawn("cracks", snapshot)
    return _kept(crack_figure(snapshot, caption), path)


def fragments(
    snapshot: AnySnapshot, path: Path | str | None = None, *, caption: str = ""
) -> Figure:
    """Plot the deformed grains in the colour of their fragment; see `cracks`."""
    snapshot, of = _drawn("fragments", snapshot)
    return _kept(fragment_figure(snapshot, caption, of), path)


def stress(
    snapshot: AnySnapshot,
    component: str = "yy",
    path: Path | str | None = None,
    *,
    caption: str = "",
) -> Figure:
    """Plot the stress in the deformed grains [MPa], tension positive; see `cracks`.

    Rigid grains have one colour each: the mean stress from the forces on them. A note in the figure
    states this.

    Args:
        snapshot: The state.
        component: ``xx``, ``yy``, ``xy``, ``principal_1`` (the larger stress) or ``principal_2``.
        path: File of the figure; None writes no file.
        caption: Line above the map.
    """
    snapshot, _ = _drawn("stress", snapshot)
    require_one_of("plot.stress: component", component, tuple(STRESSES))
    larger, smaller = principal_stresses(snapshot.triangle_stress)
    xx, yy, xy = snapshot.triangle_stress.T
    values = dict(zip(STRESSES, (xx, yy, xy, larger, smaller), strict=True))[component]
    by_forces = snapshot.stress_source == OF_GRAINS
    lines = [line for line in (label_of(caption), OF_GRAINS if by_forces else "") if line]
    with rc_context(STYLE):
        figure, axes = map_figure([snapshot.positions])
        drawn = PolyCollection(
            list(1e3 * snapshot.positions[snapshot.triangles]),
            array=1e-6 * values,
            cmap="RdBu_r",
            edgecolors="face",
            linewidths=0.1,
        )
        size = float(np.quantile(1e-6 * np.abs(values), _COVERED)) or 1.0
        drawn.set_clim(-size, size)
        axes.add_collection(drawn)
        draw_scale_bar(axes)
        _draw_scale(figure, axes, drawn, f"{STRESSES[component]} [MPa]")
        axes.set_title("\n".join(lines), fontsize=9.5, loc="left")
    return _kept(figure, path)


def displacement(
    snapshot: AnySnapshot,
    component: str = "size",
    path: Path | str | None = None,
    *,
    caption: str = "",
) -> Figure:
    """Plot the displacement of the grains since they were bonded [um]; see `cracks`.

    Args:
        snapshot: The state.
        component: ``size``, ``x`` or ``y``.
        path: File of the figure; None writes no file.
        caption: Line above the map.
    """
    snapshot, _ = _drawn("displacement", snapshot)
    require_one_of("plot.displacement: component", component, tuple(DISPLACEMENTS))
    moved = snapshot.positions - snapshot.reference
    values: FloatArray = np.hypot(*moved.T)
    if component != "size":
        values = moved[:, ("x", "y").index(component)]
    with rc_context(STYLE):
        figure, axes = map_figure([snapshot.positions])
        places = 1e3 * snapshot.positions
        drawn = axes.tripcolor(
            *places.T, 1e6 * values, triangles=snapshot.triangles, shading="gouraud"
        )
        draw_scale_bar(axes)
        _draw_scale(figure, axes, drawn, f"{DISPLACEMENTS[component]} [µm]")
        axes.set_title(label_of(caption), fontsize=9.5, loc="left")
    return _kept(figure, path)


def _drawn(name: str, state: object) -> tuple[Snapshot, Fragments]:
    """Return the plotted state (3D: its section) and the fragments of the entire state."""
    if not isinstance(state, AnySnapshot):
        raise InputError(
            f"plot.{name}: snapshot = {quoted(state)}, must be a state; pass built.snapshot()"
        )
    drawn = state.drawn
    if not can_be_drawn(drawn.positions):
        raise InputError(
            f"plot.{name}: the positions of the state are not finite; the run has diverged, plot "
            "an earlier state"
        )
    return drawn, state.fragments


def _draw_scale(figure: Figure, axes: Axes, drawn: ScalarMappable, label: str) -> None:
    figure.set_figwidth(figure.get_figwidth() + 0.9)
    figure.colorbar(drawn, ax=axes, label=label, shrink=0.7)


def _kept(figure: Figure, path: Path | str | None) -> Figure:
    """Return the figure; write it if a path is given."""
    if path is not None:
        with rc_context(STYLE):
            save(figure, path)
    return figure
