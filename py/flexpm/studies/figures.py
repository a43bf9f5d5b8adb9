# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of studies: a measure over an input, mean and spread over the packings. SI units.

Each table ``[[picture]]`` of a study file makes one: ``file``, ``x`` (an input), ``y`` (a measure),
``by`` (inputs that make one line each), ``where`` (inputs with the values to draw), ``title``.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas

from ..files import Table
from ..materials.keys import UNITS
from ..report.style import CYCLE, Axes, drawing
from ..text import label_of, name_of, words_of
from . import picture_spec
from .study import Study

#: Factor and unit of what is drawn in other units than SI's; the rest is drawn as it is.
_SHOWN = {
    "youngs_modulus": (1e-9, "GPa"),
    "peak_stress": (1e-6, "MPa"),
    "confinement": (1e-6, "MPa"),
    "peak_strain": (100.0, "%"),
    "compressive_strength": (1e-6, "MPa"),
    "cohesion": (1e-6, "MPa"),
    "direct": (1e-6, "MPa"),
    "indirect": (1e-6, "MPa"),
    "friction_angle": (1.0, "degrees"),
    "poissons_ratio": (1.0, "-"),
}
_LARGE = {"Pa": (1e-6, "MPa")}
#: Black first.
_COLOURS = ("#000000", *CYCLE)
_MARKERS = "osD^vP*"


def draw(study: Study, rows: pandas.DataFrame, folder: Path) -> list[Path]:
    """Draw the pictures of a study, or one of the strength if the file asks for none.

    Args:
        study: Its pictures and runs.
        rows: Its table.
        folder: For the pictures.

    Returns:
        The files.

    Raises:
        InputError: for an unknown key or column.
    """
    asked = study.pictures or _default(study, rows)
    for entries in asked:
        picture_spec.checked(entries, rows.columns)
    return [_picture(dict(entries), rows, folder, study.name) for entries in asked]


def _default(study: Study, rows: pandas.DataFrame) -> list[Table]:
    """Strength over the first number that varies, a line for each combination of the rest."""
    inputs = list(dict.fromkeys(key for job in study.jobs for key in job.inputs))
    varied = [key for key in inputs if key != "seed" and rows[key].nunique(dropna=False) > 1]
    numeric = [key for key in varied if pandas.api.types.is_numeric_dtype(rows[key])]
    measure = "peak_stress" if "peak_stress" in rows else "youngs_modulus"
    if measure in rows and not rows[measure].notna().any() and "peak_load" in rows:
        measure = "peak_load"  # of a script's own test without an area
    x = (numeric or varied or ["seed"])[0]
    if x not in rows or measure not in rows:
        return []
    return [{"x": x, "y": measure, "by": [key for key in varied if key != x]}]


def _picture(entries: Table, rows: pandas.DataFrame, folder: Path, name: str) -> Path:
    x, y, by = entries["x"], entries["y"], list(entries.get("by", []))
    where = entries.get("where", {})
    # what no run has given is a column without values
    rows = rows.reindex(columns=[*dict.fromkeys([*rows.columns, x, y, *by, *where])])
    chosen = rows
    for column, value in where.items():
        chosen = chosen[chosen[column].isin(value if isinstance(value, list) else [value])]
    path = folder / str(entries.get("file", f"{y}.png"))
    with drawing(path) as axes:
        _lines(axes, chosen, x, y, by)
        axes.set_xlabel(_label(x))
        axes.set_ylabel(_label(y))
        axes.set_title(label_of(entries.get("title", name)), fontsize=9.5, loc="left")
    return path


def _lines(axes: Axes, rows: pandas.DataFrame, x: str, y: str, by: Sequence[str]) -> None:
    drawn = rows.dropna(subset=[x, y])
    numbers = pandas.Series(0, index=drawn.index)
    if by:
        numbers = drawn.groupby(list(by), sort=False, dropna=False).ngroup()
    for number, group in drawn.groupby(numbers):
        label = ", ".join(_value(key, group[key].iloc[0]) for key in by)
        found = group.groupby(x)[y].agg(["mean", "std", "count"])
        places, style = found.index, ""
        if pandas.api.types.is_numeric_dtype(group[x]):  # names have nothing between them
            places, style = np.asarray(places, dtype=float) * _shown(x)[0], "-"
        axes.errorbar(
            places,
            _shown(y)[0] * found["mean"].to_numpy(dtype=float),
            _shown(y)[0] * found["std"].fillna(0.0).to_numpy(dtype=float),
            color=_COLOURS[number % len(_COLOURS)],
            marker=_MARKERS[number % len(_MARKERS)],
            ls=style,
            ms=4.0,
            lw=1.2,
            capsize=2.5,
            label=label_of(label) or None,
        )
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    if by and len(drawn):  # below, where no line can run through it
        axes.legend(
            loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=2, fontsize=8, frameon=False
        )


def _shown(column: str) -> tuple[float, str]:
    unit = UNITS.get(column.removeprefix("set.")) or ""
    return _SHOWN.get(column, _LARGE.get(unit, (1.0, unit)))


def _label(column: str) -> str:
    unit = _shown(column)[1]
    name = words_of(column.removeprefix("set."))
    return f"{name} [{unit}]" if unit else name


def _value(column: str, value: float | str) -> str:
    if isinstance(value, str):
        return name_of(value)
    factor, unit = _shown(column)
    name = words_of(column.removeprefix("set."))
    return f"{name} {factor * value:g}{' ' + unit if unit not in ('', '-') else ''}"
