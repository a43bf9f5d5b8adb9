# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of studies that grow by a row a run: what was done stays if the study is interrupted."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path
from typing import Any


def rows_of(table: Path) -> list[dict[str, str]]:
    """Rows that are there."""
    if not table.exists():
        return []
    with table.open(encoding="utf-8", newline="") as file:
        return [*csv.DictReader(file)]


def add_row(table: Path, columns: Iterable[str], row: Iterable[Any]) -> None:
    """Append a row to a CSV table, which begins with its columns if it is new."""
    new = not table.exists()
    with table.open("a", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(columns)
        writer.writerow(row)
