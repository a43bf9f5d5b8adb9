# SPDX-License-Identifier: GPL-3.0-or-later
"""Sketches of the set-up of each test, in arbitrary units of length.

Each public function plots one sketch for the page of its test, where a ``plot`` directive calls it.
"""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Ellipse, Polygon, Rectangle, Wedge

ROCK = {"facecolor": "#f4efe6", "edgecolor": "#8a7f70", "linewidth": 1.2}
STEEL = {"facecolor": "#b8bec4", "edgecolor": "#5b6268", "linewidth": 1.0}
LOAD, MEASURE, DARK = "#b03a2e", "#1f5f99", "#444444"

Point = tuple[float, float]


def _axes(width: float, height: float, panels: int = 1) -> list[Axes]:
    """Axes without frame, side by side, of a size in inches."""
    found = plt.figure(figsize=(width, height)).subplots(1, panels, squeeze=False)[0]
    for one in found:
        one.set_aspect("equal")
        one.axis("off")
    return list(found)


def _finish(axes: Sequence[Axes], titles: Sequence[str] = ()) -> None:
    """Fit the limits and write the titles."""
    for one, title in zip(axes, titles, strict=False):
        one.set_title(title, fontsize=9, color=DARK, pad=12)
    for one in axes:
        one.autoscale_view()
        one.margins(0.04)
    plt.tight_layout(pad=0.3)


def _text(ax: Axes, at: Point, text: str, color: str = DARK, **more: object) -> None:
    where = {"ha": "center", "va": "center", "fontsize": 9} | more
    ax.text(*at, text, color=color, **where)


def _arrow(ax: Axes, tail: Point, head: Point, color: str = LOAD, style: str = "-|>") -> None:
    """An arrow; a load by default."""
    made = {"arrowstyle": style, "color": color, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", xy=head, xytext=tail, arrowprops=made)
    ax.update_datalim([tail, head])


def _size(ax: Axes, first: Point, second: Point, text: str, off: Point) -> None:
    """A length between two points, with its name beside the middle."""
    _arrow(ax, first, second, MEASURE, "<->")
    middle = (0.5 * (first[0] + second[0]) + off[0], 0.5 * (first[1] + second[1]) + off[1])
    _text(ax, middle, text, MEASURE)


def _box(ax: Axes, corner: Point, width: float, height: float, style: dict = ROCK) -> None:
    ax.add_patch(Rectangle(corner, width, height, **style))


def _pressure(ax: Axes, edge: float, low: float, high: float, inwards: float) -> None:
    """Arrows of a pressure on a vertical edge."""
    for y in np.linspace(low, high, 6):
        _arrow(ax, (edge - 2.2 * inwards, y), (edge, y))


def _ends(ax: Axes, sign: float, driven: str, ends: str, across: str = "lateral strain") -> None:
    """A rectangle between two platens; sign is -1 for compression."""
    _box(ax, (0, 0), 8, 16)
    for y in (-1.2, 16):
        _box(ax, (-0.8, y), 9.6, 1.2, STEEL)
        _text(ax, (-1.2, y + 0.6), ends, ha="right")
    near, far = (1.4, 3.4) if sign > 0 else (3.4, 1.4)
    for x in (2, 4, 6):
        _arrow(ax, (x, 16 + near), (x, 16 + far))
        _arrow(ax, (x, -near), (x, -far), DARK)
    _text(ax, (9.4, 18.4), driven, LOAD, ha="left")
    _text(ax, (9.4, -2.4), "fixed end: reaction P", ha="left")
    _size(ax, (9.8, 0), (9.8, 16), "H", (0.9, 0))
    _size(ax, (0, 8), (8, 8), across, (0, 1.6 if "\n" in across else 0.8))
    _text(ax, (4, 3), "W, thickness t")


def uniaxial() -> None:
    """Compression between smooth platens."""
    (ax,) = _axes(5.2, 3.6)
    _ends(ax, -1.0, "driven end: velocity v, reaction P", "smooth")
    _finish([ax])


def tension() -> None:
    """Direct tension of bonded ends."""
    (ax,) = _axes(5.2, 3.6)
    _ends(ax, 1.0, "driven end: velocity v, reaction P", "bonded")
    _finish([ax])


def elastic() -> None:
    """Static solution for an extension of the ends."""
    (ax,) = _axes(5.2, 3.6)
    _ends(
        ax, 1.0, "small displacement u, reaction P", "smooth", "change of width:\nPoisson's ratio"
    )
    _finish([ax])


def biaxial() -> None:
    """Compression under a confining pressure on both sides."""
    first, second = axes = _axes(5.6, 3.4, 2)
    for ax in axes:
        _box(ax, (0, 0), 8, 16)
        _pressure(ax, 0.0, 1, 15, 1.0)
        _pressure(ax, 8.0, 1, 15, -1.0)
        _box(ax, (-0.8, -1.2), 9.6, 1.2, STEEL)
        _text(ax, (-3.0, 8), "p", LOAD)
        _text(ax, (11.0, 8), "p", LOAD)
    for x in np.linspace(0.8, 7.2, 5):
        _arrow(first, (x, 18.2), (x, 16))
    _text(first, (4, 19), "p", LOAD)
    _box(second, (-0.8, 16), 9.6, 1.2, STEEL)
    for x in (2, 4, 6):
        _arrow(second, (x, 19.6), (x, 17.4))
    _text(second, (4, 20.4), "velocity v, reaction P", LOAD)
    _finish(axes, ("1. confining pressure p", "2. axial loading"))


def _oblique(point: tuple[float, float, float]) -> Point:
    """Position of a point in space on the paper: x to the right, z up, y backwards."""
    x, y, z = point
    return x + 0.45 * y, z + 0.35 * y


def _solid_box(ax: Axes, sizes: tuple[float, float, float], base: float = 0.0) -> None:
    width, depth, height = sizes
    faces = (
        [(0, 0, 0), (width, 0, 0), (width, 0, height), (0, 0, height)],
        [(width, 0, 0), (width, depth, 0), (width, depth, height), (width, 0, height)],
        [(0, 0, height), (width, 0, height), (width, depth, height), (0, depth, height)],
    )
    for face, color in zip(faces, ("#f4efe6", "#e2dacb", "#faf7f1"), strict=True):
        corners = [_oblique((x, y, z + base)) for x, y, z in face]
        ax.add_patch(Polygon(corners, **(ROCK | {"facecolor": color})))


def triaxial() -> None:
    """A cylinder under one pressure, a box under two."""
    first, second = axes = _axes(5.8, 3.5, 2)
    first.add_patch(Ellipse((4, 0), 8, 2.6, **ROCK))
    _box(first, (0, 0), 8, 14, ROCK | {"edgecolor": "none"})
    first.plot([0, 0], [0, 14], [8, 8], [0, 14], color=ROCK["edgecolor"], linewidth=1.2)
    first.add_patch(Ellipse((4, 14), 8, 2.6, **(ROCK | {"facecolor": "#faf7f1"})))
    _pressure(first, 0.0, 1.5, 12.5, 1.0)
    _pressure(first, 8.0, 1.5, 12.5, -1.0)
    _text(first, (-3.1, 7), "p", LOAD)
    _text(first, (11.1, 7), "p", LOAD)
    _arrow(first, (4, 18), (4, 14.6))
    _text(first, (4, 18.8), "velocity v along z", LOAD)
    _solid_box(second, (8, 6, 14))
    for z in (3, 7, 11):
        _arrow(second, (-2.6, z), (0, z))
        _arrow(second, _oblique((4.6, -6, z)), _oblique((4.6, 0, z)))
    _text(second, (-3.6, 7), r"$p_x$", LOAD)
    _text(second, (1.2, 4.6), r"$p_y$", LOAD)
    _arrow(second, (5.3, 18.6), (5.3, 15.2))
    _text(second, (5.3, 19.4), "velocity v along z", LOAD)
    _finish(axes, ("cylinder: --confinement p", "box: --confinement px,py"))


def brazilian() -> None:
    """A disc between flat plates, and between curved jaws."""
    first, second = axes = _axes(5.4, 3.2, 2)
    for ax in axes:
        ax.add_patch(Circle((0, 0), 6, **ROCK))
        ax.plot([0, 0], [-4.6, 4.6], color=LOAD, linewidth=1.0, linestyle="--")
    for y in (-7.2, 6):
        _box(first, (-4, y), 8, 1.2, STEEL)
    _arrow(first, (0, 10), (0, 7.4))
    _text(first, (0.7, 9), "P, velocity v", LOAD, ha="left")
    _arrow(first, (0, -10), (0, -7.4), DARK)
    _text(first, (0.7, -9), "P", ha="left")
    _size(first, (-6, 0), (6, 0), "D", (1.4, 0.9))
    _text(first, (3.1, -2.6), "tensile\ncrack", LOAD, fontsize=8)
    for sign in (1, -1):
        angles = np.radians(90 * sign + np.linspace(-26, 26, 40))
        centre = -3.0 * sign
        inner = [(9 * np.cos(a), centre + 9 * np.sin(a)) for a in angles]
        edge = 8.6 * sign
        outer = [(inner[-1][0], edge), (inner[0][0], edge)]
        second.add_patch(Polygon([*inner, *outer], **STEEL))
    _arrow(second, (0, 11), (0, 8.8))
    _arrow(second, (0, -11), (0, -8.8), DARK)
    _arrow(second, (0, -3), (5.6, 4.05), MEASURE)
    _text(second, (3.9, -1.7), "jaw radius", MEASURE, fontsize=8)
    second.plot([0], [-3], marker=".", color=MEASURE)
    _finish(axes, ("flat plates", "curved jaws: --jaw-radius"))


def _rollers(ax: Axes, places: Sequence[float], bottom: float) -> None:
    for x in places:
        ax.add_patch(Circle((x, bottom - 0.7), 0.7, **STEEL))
        _arrow(ax, (x, bottom - 3.4), (x, bottom - 1.5), DARK)


def _mouth(ax: Axes, depth: float) -> None:
    """A notch up from the middle of the bottom, and its opening."""
    notch = [(-0.22, 0), (0.22, 0), (0.05, depth), (-0.05, depth)]
    ax.add_patch(Polygon(notch, facecolor="white", edgecolor=ROCK["edgecolor"]))
    for side in (-1, 1):
        _arrow(ax, (1.7 * side, -0.55), (0.3 * side, -0.55), MEASURE)
    _text(ax, (0, -1.5), "CMOD", MEASURE, fontsize=8)


def bending() -> None:
    """Three-point bending of a notched beam."""
    (ax,) = _axes(6.0, 2.4)
    _box(ax, (-11, 0), 22, 5)
    _rollers(ax, (-9.5, 9.5), 0.0)
    _mouth(ax, 1.6)
    ax.add_patch(Circle((0, 5.7), 0.7, **STEEL))
    _arrow(ax, (0, 8.8), (0, 6.5))
    _text(ax, (0.8, 7.8), "head: P, velocity v", LOAD, ha="left")
    _size(ax, (-9.5, -3.9), (9.5, -3.9), "span S", (0, -0.8))
    _size(ax, (12, 0), (12, 5), "H", (0.8, 0))
    _size(ax, (2.6, 0), (2.6, 1.6), "a", (0.7, 0))
    _text(ax, (-8.3, -1.9), "P/2", ha="left")
    _text(ax, (8.3, -1.9), "P/2", ha="right")
    _text(ax, (-5.5, 2.6), "length L, thickness t")
    _finish([ax])


def scb() -> None:
    """Half a disc on two rollers."""
    (ax,) = _axes(4.6, 2.9)
    ax.add_patch(Wedge((0, 0), 9, 0, 180, **ROCK))
    _rollers(ax, (-5.4, 5.4), 0.0)
    _mouth(ax, 4.5)
    ax.add_patch(Circle((0, 9.7), 0.7, **STEEL))
    _arrow(ax, (0, 12.8), (0, 10.5))
    _text(ax, (0.8, 11.8), "head: P, velocity v", LOAD, ha="left")
    _size(ax, (-5.4, -3.9), (5.4, -3.9), "span S", (0, -0.8))
    _size(ax, (1.4, 0), (1.4, 4.5), "a", (0.7, 0))
    _arrow(ax, (0, 0), (-6.36, 6.36), MEASURE)
    _text(ax, (-3.9, 2.6), "R", MEASURE)
    _text(ax, (4.9, 3.2), "thickness t")
    _finish([ax])


def shear() -> None:
    """Direct shear of a joint between two boxes."""
    (ax,) = _axes(5.6, 3.2)
    _box(ax, (0, 0), 16, 8)
    ax.plot([0, 16], [4, 4], color=LOAD, linewidth=1.4, linestyle="--")
    for x, y in ((-0.9, 0), (16, 0), (-0.9, 4.6), (16, 4.6)):
        _box(ax, (x, y), 0.9, 3.4, STEEL)
    _box(ax, (0, -0.9), 16, 0.9, STEEL)
    _box(ax, (0, 8), 16, 0.9, STEEL)
    for x in np.linspace(2, 14, 7):
        _arrow(ax, (x, 11), (x, 9.0))
    _text(ax, (8, 11.8), r"lid: normal stress $\sigma_n$, moves freely up and down", LOAD)
    _arrow(ax, (-4.6, 1.7), (-1.1, 1.7))
    _text(ax, (-3.2, 3.0), "lower box:\nvelocity v", LOAD)
    _arrow(ax, (20.6, 6.3), (17.1, 6.3), DARK)
    _text(ax, (19.4, 7.8), "upper box:\nreaction P")
    for y in (4.9, 3.1):
        ax.plot([8], [y], marker="o", color=MEASURE, markersize=4)
    _text(ax, (8.5, 5.5), "shear_displacement: relative motion of two points", MEASURE, fontsize=7)
    _text(ax, (3.6, 3.2), "joint", LOAD)
    _arrow(ax, (14.9, 7.0), (14.9, 10.2), MEASURE, "<->")
    _text(ax, (15.2, 9.7), "dilation", MEASURE, ha="left", fontsize=8)
    _size(ax, (0, -1.9), (16, -1.9), "W", (0, -0.8))
    _finish([ax])


def punch() -> None:
    """Punch-through shear between two pairs of notches."""
    (ax,) = _axes(5.4, 3.2)
    _box(ax, (0, 0), 16, 9)
    for x in (4.5, 11.5):
        for low, high in ((0, 2), (7, 9)):
            _box(ax, (x - 0.12, low), 0.24, high - low, {"facecolor": "white", "edgecolor": DARK})
        ax.plot([x, x], [2, 7], color=LOAD, linewidth=1.2, linestyle="--")
    _box(ax, (4.9, 9), 6.2, 1.0, STEEL)
    for x in (0, 11.9):
        _box(ax, (x, -1.0), 4.1, 1.0, STEEL)
        _arrow(ax, (x + 2, -3.4), (x + 2, -1.2), DARK)
    _arrow(ax, (8, 12.8), (8, 10.2))
    _text(ax, (8.6, 11.8), "platen: P, velocity v", LOAD, ha="left")
    _pressure(ax, 0.0, 0.8, 8.2, 1.0)
    _pressure(ax, 16.0, 0.8, 8.2, -1.0)
    _text(ax, (-3.2, 4.5), "p", LOAD)
    _text(ax, (19.2, 4.5), "p", LOAD)
    _size(ax, (4.5, -1.7), (11.5, -1.7), "distance", (0, -0.9))
    _size(ax, (3.6, 7), (3.6, 9), "a", (-0.6, 0))
    _text(ax, (8, 4.5), "bridges carry\nthe shear stress", LOAD, fontsize=8)
    _finish([ax])


def sonic() -> None:
    """A pulse that travels from the bottom to the top."""
    (ax,) = _axes(5.2, 3.6)
    _box(ax, (0, 0), 4, 20)
    for y, name in ((5, "lower section, H/4"), (15, "upper section, 3H/4")):
        _box(ax, (0, y - 0.4), 4, 0.8, {"facecolor": MEASURE, "alpha": 0.35})
        _text(ax, (5.6, y), name, MEASURE, ha="left")
    place = np.linspace(0, 8, 60)
    ax.plot(-1.2 - 1.3 * (1 - np.cos(np.pi * place / 4)), place, color=LOAD, linewidth=1.4)
    _text(ax, (-6.0, 4), "pulse of\nparticle\nvelocity", LOAD)
    _arrow(ax, (-2.4, 8.6), (-2.4, 12.6))
    _text(ax, (-3.2, 10.6), "v", LOAD)
    for x in (-0.35, 4.35):
        for y in (1.5, 3.5, 7, 9, 11, 13, 17, 19):
            ax.add_patch(Circle((x, y), 0.3, **STEEL))
    _text(ax, (5.6, 10), "sides held: no motion across\n(or --sides free)", ha="left")
    _text(ax, (5.6, 19.4), "free end", ha="left")
    _text(ax, (5.6, 0.6), "free end, where the pulse starts", ha="left")
    _finish([ax])


def axes_of_solids() -> None:
    """Position of the shapes of 3D specimens in the axes."""
    axes = _axes(6.4, 2.4, 4)
    _solid_box(axes[0], (6, 4, 9))
    cylinder = axes[1]
    cylinder.add_patch(Ellipse((0, 0), 6, 2, **ROCK))
    _box(cylinder, (-3, 0), 6, 9, ROCK | {"edgecolor": "none"})
    cylinder.plot([-3, -3], [0, 9], [3, 3], [0, 9], color=ROCK["edgecolor"], linewidth=1.2)
    cylinder.add_patch(Ellipse((0, 9), 6, 2, **(ROCK | {"facecolor": "#faf7f1"})))
    for ax, half in ((axes[2], False), (axes[3], True)):
        back = _oblique((0, 5, 0))
        dark = ROCK | {"facecolor": "#e2dacb"}
        if half:
            ax.add_patch(Wedge(back, 5, 0, 180, **dark))
            ax.add_patch(Wedge((0, 0), 5, 0, 180, **ROCK))
        else:
            ax.add_patch(Circle(back, 5, **dark))
            ax.add_patch(Circle((0, 0), 5, **ROCK))
    for ax in axes:
        for tip, name in (((4.2, 0, 0), "x"), ((0, 5.4, 0), "y"), ((0, 0, 4.6), "z")):
            end = _oblique(tip)
            _arrow(ax, (0.0, 0.0), end, MEASURE)
            _text(ax, (end[0] + 0.5, end[1] + 0.5), name, MEASURE, fontsize=8)
        ax.plot([0], [0], marker=".", color=MEASURE)
    _finish(axes, ("box", "cylinder", "solid-disc", "solid-half-disc"))
