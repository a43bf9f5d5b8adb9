# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a solid: its outside as it is now, and its section coloured by stress. SI units."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from ..arrays import FloatArray
from ..files import remove_earlier
from ..results.solid_snapshot import SolidSnapshot
from ..text import label_of
from .maps import crack_segments, draw_scale_bar
from .outside import draw_faces
from .style import COLOURS, STYLE, can_be_drawn, save

#: Part of the stresses that the colours leave out at each end: singular ones [%].
_BEYOND = 2.0


def draw_solid(path: Path | str, snapshot: SolidSnapshot, caption: str = "") -> None:
    """Draw the outside of a solid beside its section, which is coloured by the stress along z.

    A state that has no place, of a run that has diverged, is not drawn.

    Args:
        path: Picture to write.
        snapshot: The state.
        caption: Line above the picture.
    """
    if not can_be_drawn(snapshot.positions):
        remove_earlier(path)
        return
    with rc_context(STYLE):
        figure = Figure(figsize=(7.2, 5.2), layout="constrained")
        outside, cut = figure.subplots(1, 2)
        draw_faces(
            outside,
            snapshot.positions,
            list(snapshot.surface),
            snapshot.surface_grain,
            edges=False,
        )
        _draw_section(figure, cut, snapshot)
        figure.suptitle(label_of(caption), fontsize=9.5)
        save(figure, path)


def _draw_section(figure: Figure, axes: Axes, snapshot: SolidSnapshot) -> None:
    section = snapshot.section
    stress = 1e-6 * section.triangle_stress[:, 1]
    low, high = np.percentile(stress, (_BEYOND, 100.0 - _BEYOND)) if len(stress) else (0.0, 1.0)
    corners: FloatArray = 1e3 * section.positions[section.triangles]
    triangles = PolyCollection(list(corners), array=stress, cmap="viridis", edgecolors="face")
    triangles.set(clim=(low, max(high, low + 1e-9)), linewidth=0.2)
    axes.add_collection(triangles)
    for mode, segments in crack_segments(section).items():
        axes.add_collection(LineCollection(1e3 * segments, colors=COLOURS[mode], linewidths=1.2))
    axes.autoscale_view()
    draw_scale_bar(axes)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title("section, with its cracks", fontsize=9.5)
    figure.colorbar(triangles, ax=axes, shrink=0.7, label="stress along z [MPa], tension > 0")
