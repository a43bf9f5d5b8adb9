# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of a scorecard, from the table that the command makes its rows from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from availability import Cell, table_of
from docutils import nodes
from docutils.parsers.rst import Directive


class ScorecardMeasures(Directive):
    """Name, unit, run and meaning of each measure."""

    def run(self) -> list[nodes.Node]:
        """Return a table with a line for each measure."""
        head = ("Table of the rock file", "Unit", "Runs", "Meaning", "Not judged")
        return [table_of(head, self._rows(), (26, 9, 21, 30, 14))]

    @staticmethod
    def _rows() -> Iterator[Sequence[Cell]]:
        from flexpm.studies.scorecards.measures import MEASURES

        for one in MEASURES.values():
            small = ["small specimens"] * one.needs_size
            overlap = ["3D: grains overlap"] * one.after_peak
            about = one.about.replace("``", "")
            yield (one.name,), one.unit, one.runs, about, "; ".join([*small, *overlap])


def setup(app: Any) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("scorecard-measures", ScorecardMeasures)
    return {"parallel_read_safe": True}
