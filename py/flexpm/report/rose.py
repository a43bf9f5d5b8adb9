# SPDX-License-Identifier: GPL-3.0-or-later
"""Rose diagrams of fracture networks: requested, generated and cut traces."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from ..arrays import FloatArray
from ..joints.network import Network, TraceSet
from ..joints.trace_angles import folded
from ..specimens.specimen import Specimen
from ..text import label_of
from .style import CYCLE, STYLE, save

#: Width of a petal [degree].
_WIDTH = 10.0
#: Diagrams in a row, and size of each [inch].
_IN_A_ROW, _SIZE = 3, 3.1
#: Room for the legend below them [inch].
_LEGEND = 0.35
_CUT, _DRAWN, _ASKED = "#c9bfa8", CYCLE[0], CYCLE[1]


def rose_picture(path: Path | str, specimen: Specimen) -> None:
    """Draw a rose for each set of the networks of a specimen.

    A petal is the P21 [1/m] of its angles: of the contacts that were cut, of the traces that were
    drawn, and of the law that was asked for.

    Args:
        path: Picture to write.
        specimen: It has networks.
    """
    found = specimen.network_intensities()
    area = float(np.sum(specimen.tessellation.cell_areas))
    ends = dict(zip(specimen.spec.joint_names or (), specimen.joint_lines(), strict=True))
    none = np.empty((0, 2, 2))
    sets = {
        name: one
        for table in specimen.spec.networks or ()
        for name, one in Network.of(table).sets.items()
    }
    across = min(len(sets), _IN_A_ROW)
    up = math.ceil(len(sets) / across)
    with rc_context(STYLE):
        size = max(across * _SIZE, 1.5 * _SIZE), up * (_SIZE + 0.2) + _LEGEND
        legend = _LEGEND / size[1]
        layout = ConstrainedLayoutEngine(rect=(0.0, legend, 1.0, 1.0 - legend))
        figure = Figure(figsize=size, layout=layout)
        for number, (name, one) in enumerate(sets.items()):
            axes = figure.add_subplot(up, across, number + 1, projection="polar")
            traces = np.array(specimen.joints.get(name, none)).reshape(-1, 2, 2)
            # traces lie in the window about the specimen: those within count
            _draw(axes, one, (traces, found[name]["generated"]), ends.get(name, none), area)
            numbers = ", ".join(f"{key} {value:.3g}" for key, value in found[name].items())
            axes.set_title(f"{label_of(name)}\nP21 {numbers} 1/m", fontsize=8.5)
        handles = [
            Line2D([], [], color=_ASKED, lw=1.6, label="target"),
            Line2D([], [], color=_DRAWN, lw=1.2, label="generated"),
            Patch(facecolor=_CUT, label="cut"),
        ]
        figure.legend(handles=handles, loc="lower center", ncol=3, frameon=False)
        save(figure, path)


def _draw(
    axes: PolarAxes,
    one: TraceSet,
    drawn_of: tuple[FloatArray, float],
    contacts: FloatArray,
    area: float,
) -> None:
    """Draw one rose: petals over both senses of an angle; of traces and their P21 in all."""
    edges = np.arange(-90.0, 90.0 + _WIDTH, _WIDTH)
    around = np.radians(np.concatenate((edges, edges[1:] + 180.0)))
    cut, drawn = _petals(contacts, edges) / area, _petals(drawn_of[0], edges)
    drawn *= drawn_of[1] / max(drawn.sum(), np.finfo(float).tiny)
    axes.bar(
        around[:-1],
        np.tile(cut, 2),
        math.radians(_WIDTH),
        align="edge",
        color=_CUT,
        edgecolor="white",
        linewidth=0.4,
    )
    outline = np.repeat(np.tile(drawn, 2), 2)
    axes.plot(np.repeat(around, 2)[1:-1], outline, color=_DRAWN, lw=1.2)
    angles = np.linspace(-90.0, 90.0, 361)
    density = one.orientation.density(angles)
    if density is None:  # all traces have one angle
        angle = one.orientation.draw(np.random.default_rng(0), 1)[0]
        for sense in (0.0, 180.0):
            axes.plot(np.radians([angle + sense] * 2), [0.0, one.intensity], color=_ASKED, lw=1.6)
    else:
        line = np.tile(_WIDTH * one.intensity * density, 2)
        axes.plot(np.radians(np.concatenate((angles, angles + 180.0))), line, color=_ASKED, lw=1.6)
    axes.set_thetagrids(range(0, 360, 30))
    axes.tick_params(labelsize=7, pad=0)
    axes.set_rlabel_position(15.0)
    axes.yaxis.set_major_locator(MaxNLocator(3))
    axes.grid(lw=0.4)


def _petals(ends: FloatArray, edges: FloatArray) -> FloatArray:
    """Length of segments by their angles [m]."""
    way = ends[:, 1] - ends[:, 0]
    angles = folded(np.degrees(np.arctan2(way[:, 1], way[:, 0])))
    found: FloatArray = np.histogram(angles, edges, weights=np.hypot(*way.T))[0]
    return found
