# SPDX-License-Identifier: GPL-3.0-or-later
"""A history of a test: times and values, from arrays or from a CSV file. SI units."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...files import csv_rows, read_text
from ...require import quoted

#: What a unit that may stand in a history's row of units is in SI, by what it measures.
_UNITS = {
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0, "h": 3600.0, "": 1.0, "-": 1.0},
    "N": {"N": 1.0, "kN": 1e3, "MN": 1e6},
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6},
}
#: Most rows of a history.
_MOST_ROWS = 100_000


def history_of(times: object, values: object, unit: str) -> tuple[list[float], list[float]]:
    """Times and values as they were given to `follow`.

    Args:
        times: Times [s], or the path of a CSV file.
        values: Values, None with a file.
        unit: SI unit of the values, N or m.

    Raises:
        InputError: naming the row that is wrong: of a file its line, else counted from 1.
    """
    if isinstance(times, str | Path):
        if values is not None:
            raise InputError("follow: values and a file are given; leave out values")
        rows = _rows_of(Path(times), unit)
        where = f"follow: {Path(times).name}: line"
    else:
        first, second = _numbers("times", times), _numbers("values", values)
        if len(first) != len(second):
            raise InputError(
                f"follow: values = {len(second)}, must be as many as times, {len(first)}; give one "
                "value per time"
            )
        pairs = zip(first, second, strict=True)
        rows = [(number, *pair) for number, pair in enumerate(pairs, 1)]
        where = "follow: row"
    if not 2 <= len(rows) <= _MOST_ROWS:
        raise InputError(
            f"follow: rows = {len(rows)}, must be 2 to {_MOST_ROWS}; give more or fewer rows"
        )
    last = -math.inf
    for number, time, value in rows:
        if not (math.isfinite(time) and math.isfinite(value)):
            raise InputError(f"{where} {number}: {time:g}, {value:g}, must be finite; correct them")
        if not time > last:
            raise InputError(
                f"{where} {number}: time = {time:g} s, must be > {last:g} s; sort the rows by time"
            )
        last = time
    return [time for _, time, _ in rows], [value for _, _, value in rows]


def _numbers(name: str, given: object) -> list[float]:
    try:
        array = np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        array = np.zeros((0, 0))
    if given is None or array.ndim != 1:
        raise InputError(
            f"follow: {name} = {quoted(given)}, must be a list of numbers, or a file; give one of "
            "them"
        )
    return [float(number) for number in array]


def _rows_of(path: Path, unit: str) -> list[tuple[int, float, float]]:
    """Line, time and value of each row of a file, in SI units."""
    try:
        lines = list(csv_rows(read_text(path)))
    except OSError as error:
        raise InputError(
            f"follow: file = {str(path)!r}, cannot be read ({error.strerror}); give a CSV file"
        ) from None
    except UnicodeDecodeError:
        raise InputError(
            f"follow: file = {str(path)!r}, is not a CSV file in UTF-8; save it as UTF-8"
        ) from None
    except (ValueError, csv.Error) as error:
        raise InputError(
            f"follow: file = {str(path)!r}, is not a CSV file: {error}; correct the file"
        ) from None
    factors = (1.0, 1.0)
    rows: list[tuple[int, float, float]] = []
    heads = 0
    for number, row in lines:
        if len(row) < 2:
            raise InputError(
                f"follow: {path.name}: line {number}: columns = 1, must be >= 2; give time and "
                "value"
            )
        try:
            rows.append((number, float(row[0]), float(row[1])))
        except ValueError:
            if rows or heads > 1:
                raise InputError(
                    f"follow: {path.name}: line {number}: {quoted(','.join(row[:2]))}, must be "
                    "numbers below a row of names and at most one row of units; correct it"
                ) from None
            heads += 1
            if heads == 2:
                factors = (_factor(path, number, row[0], "s"), _factor(path, number, row[1], unit))
    return [(number, factors[0] * time, factors[1] * value) for number, time, value in rows]


def _factor(path: Path, line: int, text: str, unit: str) -> float:
    """SI units in a unit that a file names."""
    name = text.strip().strip("[]()")
    if name not in _UNITS[unit]:
        known = ", ".join(one for one in _UNITS[unit] if one)
        raise InputError(
            f"follow: {path.name}: line {line}: unit = {quoted(text)}, must be one of {known}; "
            "convert the column"
        )
    return _UNITS[unit][name]
