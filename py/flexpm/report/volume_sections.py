# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of a label volume beside the cells that were fitted to it. Input in SI units."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..arrays import BoolArray, FloatArray, IntArray
from ..specimens.volumes.volume_report import VolumeReport
from .style import STYLE, save

Voxels = TypeVar("Voxels", IntArray, BoolArray)
#: Axes of the sections, right and up, and the axis through which they cut: 0: x, 1: y, 2: z.
_SECTIONS = ((0, 2, 1), (1, 2, 0), (0, 1, 2))
_NAMES = "xyz"
_TINTS = np.array(
    [
        (0.85, 0.80, 0.72),
        (0.62, 0.69, 0.74),
        (0.78, 0.65, 0.63),
        (0.66, 0.73, 0.60),
        (0.93, 0.90, 0.84),
        (0.56, 0.54, 0.50),
        (0.80, 0.74, 0.82),
    ]
)
_PORE = (0.12, 0.12, 0.12)
_RIGHT, _WRONG = (0.95, 0.94, 0.91), (0.84, 0.37, 0.0)
#: Width of a column, and least and largest height of a row [inch].
_COLUMN, _LOW, _HIGH = 2.6, 1.2, 3.6


def volume_picture(path: Path | str, report: VolumeReport) -> None:
    """Plot three sections through the middle of a volume: labels, cells, and where they agree.

    Axes are those of the file [mm]. A dot marks the corner of the first voxel where a section has
    it at its rim.

    Args:
        path: File of the figure.
        report: The comparison.
    """
    grains = len(report.columns["label"])
    counts = np.array(report.regions.shape[::-1])
    sizes = 1e3 * counts * report.spacing
    corner = 1e3 * np.array(report.origin)
    heights = [
        float(np.clip(_COLUMN * sizes[up] / sizes[right], _LOW, _HIGH))
        for right, up, _ in _SECTIONS
    ]
    with rc_context(STYLE):
        figure = Figure(figsize=(3.0 * _COLUMN + 0.9, sum(heights) + 2.1), layout="constrained")
        rows = figure.subplots(3, 3, gridspec_kw={"height_ratios": heights})
        for row, (right, up, through) in zip(rows, _SECTIONS, strict=True):
            labels, cells = (_section(one, through) for one in (report.regions, report.cells))
            agree = _section(report.agree, through)
            ends = [corner[right], corner[right] + sizes[right]]
            ends += [corner[up], corner[up] + sizes[up]]
            at = corner[through] + (counts[through] // 2 + 0.5) * 1e3 * report.spacing[through]
            images = (_tinted(labels, grains), _tinted(cells, grains), _agreeing(agree))
            for axes, image in zip(row, images, strict=True):
                axes.imshow(image, origin="lower", extent=ends, interpolation="nearest")
                _mark(axes, _NAMES[right], _NAMES[up], (ends[0], ends[2]))
            row[0].set_title(f"labels, {_NAMES[through]} = {at:.3g} mm", fontsize=9, loc="left")
            row[1].set_title("cells", fontsize=9, loc="left")
            row[2].set_title(f"{100 * float(np.mean(agree)):.1f} % agree", fontsize=9, loc="left")
        agreement = report.totals["agreement"]
        figure.suptitle(
            f"{grains} grains, {100 * agreement:.1f} % of all voxels agree; dot: corner of the "
            "first voxel",
            fontsize=9.5,
        )
        save(figure, path)


def _section(voxels: Voxels, through: int) -> Voxels:
    """Return the middle layer of an array (z, y, x), with rows upwards."""
    layer: Voxels = np.take(voxels, voxels.shape[2 - through] // 2, axis=2 - through)
    return layer


def _tinted(regions: IntArray, grains: int) -> FloatArray:
    image: FloatArray = _TINTS[(regions * 5 + regions // 7) % len(_TINTS)]
    image[regions >= grains] = _PORE
    # boundaries are darker, so that neighbours of one tint are seen
    edge = np.zeros(regions.shape, dtype=bool)
    edge[:, 1:] |= regions[:, 1:] != regions[:, :-1]
    edge[1:] |= regions[1:] != regions[:-1]
    image[edge] *= 0.55
    return image


def _agreeing(agree: BoolArray) -> FloatArray:
    image: FloatArray = np.where(agree[..., None], _RIGHT, _WRONG)
    return image


def _mark(axes: Axes, right: str, up: str, first: tuple[float, float]) -> None:
    axes.plot(*first, "o", color="black", markersize=4, clip_on=False)
    axes.set_xlabel(f"{right} [mm]")
    axes.set_ylabel(f"{up} [mm]")
    axes.tick_params(labelsize=7.5)
