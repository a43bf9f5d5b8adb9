# SPDX-License-Identifier: GPL-3.0-or-later
"""Style of all pictures and how they are written. No window is opened, no display is needed."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes as Axes
from matplotlib.figure import Figure

from ..arrays import FloatArray
from ..files import whole_file
from ..results.cracks import ERASED, SHEAR, TENSILE

#: Apart for colour-blind readers (Okabe and Ito); one for each line of a picture.
CYCLE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
#: Colours of the modes of cracks, and of what scripts have erased.
COLOURS: dict[int, str] = {TENSILE: CYCLE[0], SHEAR: CYCLE[1], ERASED: "black"}
MODE_NAMES: dict[int, str] = {
    TENSILE: "tensile cracks",
    SHEAR: "shear cracks",
    ERASED: "erased bonds",
}
#: Colour of notches.
CUT = "#1c1c1c"
#: Part of the values that colours leave out at each end [%].
_BEYOND = 2.0
#: Settings of all pictures.
STYLE = {
    "font.size": 9.0,
    "axes.labelsize": 9.5,
    "legend.fontsize": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "savefig.dpi": 220,
    "lines.solid_capstyle": "round",
}

#: Coordinates beyond this are not drawn.
_LARGEST = 1e30
#: Sides of a picture of more than this ratio are not drawn [-].
_LONGEST = 100.0


@contextlib.contextmanager
def drawing(path: Path | str, size: tuple[float, float] = (5.6, 3.9)) -> Iterator[Axes]:
    """Axes to draw in, in the style of all pictures; written to `path` afterwards.

    Args:
        path: Picture to write.
        size: Width and height [inch].
    """
    with rc_context(STYLE):
        figure = Figure(figsize=size, layout="constrained")
        yield figure.add_subplot()
        save(figure, path)


def save(figure: Figure, path: Path | str) -> None:
    """Write a picture, whole or not at all."""
    with whole_file(path) as temporary, warnings.catch_warnings():
        # a name may have characters that the font lacks; they are drawn as boxes
        warnings.filterwarnings("ignore", "Glyph .* missing from", UserWarning)
        figure.savefig(temporary)


def colour_limits(values: FloatArray) -> tuple[float, float]:
    """Values between which colours go, without the singular ones; any if there is none."""
    known = values[np.isfinite(values)]
    if not len(known):
        return 0.0, 1.0
    low, high = np.percentile(known, (_BEYOND, 100.0 - _BEYOND)).tolist()
    return low, high


def can_be_drawn(places: FloatArray) -> bool:
    """Whether points (N, 2) fit into a picture; those of a run that diverged may not."""
    if not (len(places) and np.all(np.abs(places) < _LARGEST)):
        return False
    width, height = np.ptp(places, axis=0)
    return bool(0.0 < width < _LONGEST * height and height < _LONGEST * width)
