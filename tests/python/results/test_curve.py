# SPDX-License-Identifier: GPL-3.0-or-later
"""A record as scripts handle it: its columns by name, its line, its table of pandas."""

from __future__ import annotations

import sys

import numpy as np
from refusals import refusal

from flexpm.results.record import COLUMNS, Curve


def test_a_record_is_a_mapping_of_columns_with_a_line_that_tells_it():
    record = Curve(own=["load"])
    assert repr(record).startswith("Curve(no rows; step, ")
    for step in (10, 25):
        record.append(**dict.fromkeys(record.keys(), 0.5 * step) | {"step": step})
    assert record.keys() == record.columns == tuple(record)
    assert "load" in record
    assert "lode" not in record
    columns = dict(record)
    assert list(columns) == list(record.columns)
    np.testing.assert_array_equal(columns["load"], [5.0, 12.5])
    assert repr(record).startswith("Curve(2 rows, steps 10 to 25; step, axial_strain, ")


def test_a_record_becomes_a_table_of_pandas():
    record = Curve()
    for step in (10, 25):
        record.append(**dict.fromkeys(COLUMNS, 0.5 * step) | {"step": step})
    table = record.to_pandas()
    assert tuple(table.columns) == COLUMNS
    assert [str(kind) for kind in table.dtypes[:2]] == ["int64", "float64"]
    np.testing.assert_array_equal(table["axial_stress"], record["axial_stress"])
    table.loc[0, "axial_stress"] = 1.0  # a copy
    assert record["axial_stress"][0] == 5.0


def test_without_pandas_a_record_says_so_in_one_line(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    refusal("pandas is not installed; install", lambda: Curve().to_pandas())
