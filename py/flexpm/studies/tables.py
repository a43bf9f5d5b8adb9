# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of jobs with their inputs and measures, and the files they go to."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pandas

from ..files import Table, whole_file
from .jobs import Task


def table(wanted: Sequence[Task], outcomes: Sequence[Table]) -> pandas.DataFrame:
    """One row a job: key, inputs, exit code, message, measures."""
    return pandas.DataFrame(
        {
            "key": job.key,
            **{key: _cell(value) for key, value in job.inputs.items()},
            "exit_code": outcome["exit_code"],
            "message": outcome["message"],
            **outcome["result"],
        }
        for job, outcome in zip(wanted, outcomes, strict=True)
    ).convert_dtypes(convert_string=False)


def write_table(rows: pandas.DataFrame, stem: Path) -> None:
    """Write a table as CSV, and as Parquet if pandas finds a library for it."""
    with whole_file(stem.with_suffix(".csv")) as temporary:
        rows.to_csv(temporary, index=False)
    try:
        with whole_file(stem.with_suffix(".parquet")) as temporary:
            rows.to_parquet(temporary)
    except ImportError:
        pass  # neither pyarrow nor fastparquet is in Debian 12


def _cell(value: object) -> object:
    return " ".join(map(str, value)) if isinstance(value, list) else value
