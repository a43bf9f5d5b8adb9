# SPDX-License-Identifier: GPL-3.0-or-later
"""Record of a test step by step. SI units.

Axial stress and strain are positive in the sense of the loading: compression in compression
tests, tension in tension tests. The lateral strain is positive as Poisson's effect: widening in
compression tests, narrowing in tension tests.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from ..errors import InputError
from ..files import csv_text, load_csv
from ..notebook import Shown
from ..renamed import COLUMNS as RENAMED
from ..renamed import present
from ..require import require_known

if TYPE_CHECKING:
    import pandas

#: Columns of the record: the columns of curve.csv.
COLUMNS = (
    "step",
    "axial_strain",
    "lateral_strain",
    "axial_stress",
    "confinement",
    "tensile_cracks",
    "shear_cracks",
    "unbalanced_ratio",
    "kinetic_energy",
    "elastic_energy",
    "damage_energy",
    "softened_energy",
    "friction_energy",
    "damping_energy",
    "drag_energy",
    "potential_energy",
    "boundary_work",
    "end_mismatch",
    "velocity_factor",
)
INTEGERS = ("step", "tensile_cracks", "shear_cracks")


class Curve(Shown):
    """Record of a test, a row for each measured step: ``curve["axial_stress"]``.

    Appending takes amortised constant time, and columns are numpy views. The length of the record
    is the number of rows. Its keys are the names of its columns, so that ``dict(curve)`` and
    ``"load" in curve`` work.

    Example:
        >>> curve = flexpm.run("tension", specimen, rate=6.0).curve
        >>> "axial_strain" in curve, len(curve["axial_stress"]) == len(curve)
        (True, True)
    """

    def __init__(self, own: Sequence[str] = ()) -> None:
        """Begin an empty record.

        Args:
            own: Names of the columns that this test has in addition to `COLUMNS`.
        """
        self.columns = (*COLUMNS, *own)
        self._data = np.empty((256, len(self.columns)))
        self._rows = 0

    def append(self, **values: float) -> None:
        """Add one row with a value for each column; nan if a quantity is not defined."""
        if values.keys() != set(self.columns):
            wrong = sorted(values.keys() ^ set(self.columns))
            raise TypeError(
                f"Curve.append: columns {wrong} are missing or unknown; give each column once"
            )
        if self._rows == len(self._data):
            self._data = np.concatenate([self._data, np.empty_like(self._data)])
        self._data[self._rows] = [values[name] for name in self.columns]
        self._rows += 1

    def __len__(self) -> int:
        return self._rows

    def __getitem__(self, column: str) -> FloatArray:
        """Return a view of one column; it stays valid, but does not grow with later rows.

        Raises:
            InputError: for a column that the record does not have, with the nearest name.
        """
        column = present(column, RENAMED, self.columns)
        require_known("record: column", column, self.columns)
        return self._data[: self._rows, self.columns.index(column)]

    def keys(self) -> tuple[str, ...]:
        """Return the names of the columns."""
        return self.columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __repr__(self) -> str:
        if not self._rows:
            return f"Curve(no rows; {', '.join(self.columns)})"
        ends = [f"{self._data[row, 0]:g}" for row in (0, self._rows - 1)]
        return f"Curve({self._rows} rows, steps {' to '.join(ends)}; {', '.join(self.columns)})"

    def to_pandas(self) -> pandas.DataFrame:
        """Return the record as a pandas table, a copy.

        Raises:
            InputError: if pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise InputError(
                "Curve.to_pandas: pandas is not installed; install python3-pandas, or use `array` "
                "and `columns`"
            ) from None
        whole = dict.fromkeys(INTEGERS, np.int64)
        return pandas.DataFrame(self.array.copy(), columns=list(self.columns)).astype(whole)

    @property
    def array(self) -> FloatArray:
        """All rows, in the order of `columns`."""
        return self._data[: self._rows]

    @classmethod
    def from_array(cls, array: FloatArray, own: Sequence[str] = ()) -> Curve:
        """Restore a record from `array` (rows, columns in the order of `COLUMNS`, then `own`)."""
        curve = cls(own)
        array = np.asarray(array, dtype=float).reshape(-1, len(curve.columns))
        curve._rows = len(array)
        curve._data = np.concatenate([array, curve._data])
        return curve

    @classmethod
    def from_columns(cls, names: Sequence[str], rows: FloatArray, own: Sequence[str] = ()) -> Curve:
        """Take the record's columns from `rows` (rows, columns) whose columns have `names`."""
        rows = np.asarray(rows, dtype=float).reshape(-1, len(names))
        places = [list(names).index(column) for column in (*COLUMNS, *own)]
        return cls.from_array(rows[:, places], own)

    @property
    def own(self) -> tuple[str, ...]:
        """Names of the columns in addition to `COLUMNS`."""
        return self.columns[len(COLUMNS) :]

    def until(self, row: int) -> Curve:
        """Return the rows of the record before a row."""
        return Curve.from_array(self.array[:row], self.own)

    @classmethod
    def read(cls, path: Path) -> Curve:
        """Read the text that ``csv`` returned; a column that an older flexpm did not have is nan.

        Raises:
            InputError: if the file cannot be read or has no record.
        """
        names, rows = load_csv(path, "record")
        try:
            found = np.array(rows, dtype=float).reshape(len(rows), len(names))
        except ValueError as error:
            raise InputError(
                f"record = {str(path)!r}, is not a table of numbers: {error}; give curve.csv of a "
                "run"
            ) from None
        names, found = _present(names, found)
        own = [name for name in names if name not in COLUMNS]
        columns = [
            found[:, names.index(name)] if name in names else np.full(len(rows), np.nan)
            for name in (*COLUMNS, *own)
        ]
        return cls.from_array(np.column_stack(columns), own)

    def csv(self) -> str:
        """Return the record as CSV text; numbers are written so that they read back unchanged."""
        old = {
            one: self.columns.index(new)
            for one, new in RENAMED.items()
            if new in self.columns and one not in self.columns
        }
        whole = [name in INTEGERS for name in (*self.columns, *old)]
        table = np.column_stack([self.array, *(self.array[:, [one]] for one in old.values())])
        rows = (
            [int(value) if integer else value for value, integer in zip(row, whole, strict=True)]
            for row in table.tolist()
        )
        return csv_text((*self.columns, *old), rows)


def _present(names: Sequence[str], found: FloatArray) -> tuple[list[str], FloatArray]:
    """Columns of a file under their present names alone.

    An old name belongs to the soft machine, which has its energy, too, or to a script's gauge.
    """
    names = [*names]
    for old, new in RENAMED.items():
        if old not in names:
            continue
        place = names.index(old)
        if new not in names and "machine_energy" in names:
            names[place] = new
        elif new in names and np.array_equal(
            found[:, place], found[:, names.index(new)], equal_nan=True
        ):
            del names[place]
            found = np.delete(found, place, axis=1)
    return names, found
