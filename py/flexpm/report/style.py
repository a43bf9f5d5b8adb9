# SPDX-License-Identifier: GPL-3.0-or-later
"""Style of all pictures and how they are written. No window is opened, no display is needed."""

from __future__ import annotations

import contextlib
import textwrap
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes as Axes
from matplotlib.figure import Figure
from matplotlib.text import Text

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

#: Room around what is drawn [inch].
_PAD = 0.08
#: Width of a title over that of its figure that always fits [-]; most trials to fit one.
_SHORT, _FITS = 0.6, 4
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
    """Write a picture, whole or not at all; a title that is too wide gets more lines."""
    with whole_file(path) as temporary, warnings.catch_warnings():
        # a name may have characters that the font lacks; they are drawn as boxes
        warnings.filterwarnings("ignore", "Glyph .* missing from", UserWarning)
        # and it may be longer than any picture
        warnings.filterwarnings("ignore", "constrained_layout not applied", UserWarning)
        if (engine := figure.get_layout_engine()) is not None:
            engine.set(w_pad=_PAD, h_pad=_PAD)
        _fit_titles(figure)
        figure.savefig(temporary)


def _fit_titles(figure: Figure) -> None:
    """Break titles where they would come nearer to the right edge of a figure than its pad."""
    titles = [title for axes in figure.axes for title in _titles_of(axes)]
    if all(title.get_window_extent().width < _SHORT * figure.bbox.width for title in titles):
        return
    for _ in range(_FITS):
        figure.draw_without_rendering()  # places the titles
        wide = [title for title in titles if _overhang(figure, title) > 0.0]
        for title in wide:
            box = title.get_window_extent()
            share = 1.0 - _overhang(figure, title) / box.width
            lines = title.get_text().split("\n")
            columns = max(int(share * max(map(len, lines))), 1)
            fitted = "\n".join(
                textwrap.fill(line, columns, break_long_words=False) for line in lines
            )
            title.set_text(fitted)
        if not wide:
            return


def _titles_of(axes: Axes) -> list[Text]:
    texts = {axes.get_title(loc) for loc in ("left", "center", "right")} - {""}
    found = [one for one in axes.get_children() if isinstance(one, Text)]
    return [one for one in found if one.get_text() in texts]


def _overhang(figure: Figure, title: Text) -> float:
    """Return the width of a title beyond the pad of a figure [pixel], on both sides if centred."""
    box, pad = title.get_window_extent(), _PAD * float(figure.dpi)
    right = float(box.x1 - (figure.bbox.width - pad))
    if title.get_ha() == "center":
        return 2.0 * max(right, float(pad - box.x0))
    return right


def colour_limits(values: FloatArray) -> tuple[float, float]:
    """Return the limits of a colour scale, without singular values; 0 and 1 without values."""
    known = values[np.isfinite(values)]
    if not len(known):
        return 0.0, 1.0
    low, high = np.percentile(known, (_BEYOND, 100.0 - _BEYOND)).tolist()
    return low, high


def can_be_drawn(places: FloatArray) -> bool:
    """Return whether points (N, 2) can be plotted; points of a diverged run may be too far."""
    if not (len(places) and np.all(np.abs(places) < _LARGEST)):
        return False
    width, height = np.ptp(places, axis=0)
    return bool(0.0 < width < _LONGEST * height and height < _LONGEST * width)
