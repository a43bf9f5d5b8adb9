# SPDX-License-Identifier: GPL-3.0-or-later
"""Stereonets of fracture networks in 3D: equal area, lower hemisphere."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from ..arrays import FloatArray
from ..joints.planes import normal_of
from ..specimens.space.specimen import SolidSpecimen
from ..text import label_of
from .style import CYCLE, STYLE, save

#: Size of the picture [inch].
_SIZE = (5.6, 4.2)
#: Steps of the grid, dips and dip directions [degree].
_DIPS, _AROUND = (30.0, 60.0), 30
#: Legend entries whose text fits.
_MOST_SETS = 12


def stereonet_picture(path: Path | str, specimen: SolidSpecimen) -> None:
    """Plot the poles of each set of the networks of a 3D specimen.

    Dots are the poles of the planes in the specimen, a cross is their mean pole, and a curve is the
    mean plane. North (y) is up, east (x) is right.

    Args:
        path: Picture to write.
        specimen: It has networks.
    """
    found = specimen.network_intensities()
    within = specimen.cells.joint_cuts[:, 0] > 0.0
    normals = np.array([one.normal for one in specimen.planes])
    names = np.array([one.name for one in specimen.planes])
    with rc_context(STYLE):
        figure = Figure(figsize=_SIZE, layout="constrained")
        axes = figure.add_subplot()
        _draw_net(axes)
        for number, (name, one) in enumerate(found.items()):
            colour = CYCLE[number % len(CYCLE)]
            poles = projected(normals[(names == name) & within])
            label = f"{label_of(name)}: {len(poles)} poles" if number < _MOST_SETS else None
            if "dip" in one:
                label = label and f"{label}\nmean {one['dip']:.0f} / {one['dip_direction']:.0f}°"
                mean = projected(np.array([normal_of(one["dip"], one["dip_direction"])]))
                axes.plot(*great_circle(one["dip"], one["dip_direction"]).T, color=colour, lw=1.0)
                axes.plot(*mean.T, "+", color=colour, ms=11, mew=1.8, zorder=4)
            axes.plot(*poles.T, "o", color=colour, ms=3.5, mew=0.0, alpha=0.6, label=label)
        axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False)
        axes.set_title(
            "Poles, equal area, lower hemisphere; mean dip / dip direction", fontsize=8.5
        )
        save(figure, path)


def projected(normals: FloatArray) -> FloatArray:
    """Return the points (n, 2) of unit normals (n, 3) in the net of radius 1.

    The equal-area projection of Lambert: the lower end of a normal at the angle a from the vertical
    lies at the distance sqrt(2) sin(a / 2) from the middle.
    """
    return _below(np.where(normals[:, 2:] > 0.0, -1.0, 1.0) * normals)


def great_circle(dip: float, dip_direction: float) -> FloatArray:
    """Return points (n, 2) of the lower half of a plane [degree] in the net."""
    angles = np.radians(np.linspace(0.0, 180.0, 91))
    around = math.radians(dip_direction)
    strike = np.array([math.cos(around), -math.sin(around), 0.0])
    down = np.array(normal_of(dip + 90.0, dip_direction))
    return _below(np.cos(angles)[:, None] * strike + np.sin(angles)[:, None] * down)


def _below(vectors: FloatArray) -> FloatArray:
    """Points of unit vectors that point downwards, but for round-off."""
    # 2 sin^2(a / 2) = 1 - cos(a), and x and y have the length sin(a)
    found: FloatArray = vectors[:, :2] / np.sqrt(1.0 - vectors[:, 2:])
    return found


def _draw_net(axes: Axes) -> None:
    """Draw the rim, circles of equal dip, and directions."""
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_xlim(-1.15, 1.15)
    axes.set_ylim(-1.15, 1.15)
    axes.add_patch(Circle((0.0, 0.0), 1.0, fill=False, lw=1.0))
    for dip in _DIPS:
        radius = math.sqrt(2.0) * math.sin(math.radians(0.5 * dip))
        axes.add_patch(Circle((0.0, 0.0), radius, fill=False, lw=0.4, color="0.75"))
    for direction in range(0, 360, _AROUND):
        x, y = math.sin(math.radians(direction)), math.cos(math.radians(direction))
        axes.plot([0.0, x], [0.0, y], lw=0.4, color="0.75", zorder=0)
        text = {0: "N (y)", 90: "E (x)", 180: "S", 270: "W"}.get(direction, f"{direction}°")
        axes.text(1.09 * x, 1.07 * y, text, ha="center", va="center", fontsize=7.5)
