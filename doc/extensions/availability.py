# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests and features by dimension, from the tables that the package makes its refusals from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive

#: Text of a cell, or names of the interface.
Cell = str | tuple[str, ...]


def table_of(
    head: Sequence[Cell], rows: Iterator[Sequence[Cell]], widths: Sequence[int]
) -> nodes.table:
    """A table with a head."""
    group = nodes.tgroup(cols=len(widths))
    group += [nodes.colspec(colwidth=width) for width in widths]
    group += [nodes.thead("", _row(head)), nodes.tbody("", *map(_row, rows))]
    return nodes.table("", group, classes=["colwidths-given"])


def _row(cells: Sequence[Cell]) -> nodes.row:
    return nodes.row("", *(nodes.entry("", _paragraph(one)) for one in cells))


def _paragraph(cell: Cell) -> nodes.paragraph:
    if isinstance(cell, str):
        return nodes.paragraph("", cell)
    names = nodes.paragraph()
    for number, name in enumerate(cell):
        names += [nodes.Text(", ")] * (number > 0) + [nodes.literal(name, name)]
    return names


class TestsByDimension(Directive):
    """Shapes and models of each test in 2D and in 3D."""

    def run(self) -> list[nodes.Node]:
        """Return a table with a line for each test."""
        head = ("Test", "2D: shapes", "2D: models", "3D: shapes", "3D: models")
        return [table_of(head, self._rows(), (12, 14, 28, 20, 26))]

    @staticmethod
    def _rows() -> Iterator[Sequence[str]]:
        from flexpm.dimensions import is_solid
        from flexpm.kinds.registry import KINDS

        for name, kind in KINDS.items():
            cells = [name]
            for solid in (False, True):
                shapes = [one for one in kind.shapes if is_solid(one) == solid]
                models = kind.models_of(shapes[0]) if shapes else ()
                cells += [", ".join(shapes), ", ".join(models)] if shapes else ["not available"] * 2
            yield cells


class FeaturesByDimension(Directive):
    """Features that are available in 2D or in 3D only, and what to do instead."""

    def run(self) -> list[nodes.Node]:
        """Return a table with a line for each feature."""
        head = ("Feature", "Requested by", "Available in", "In the other dimension")
        return [table_of(head, self._rows(), (20, 34, 10, 36))]

    @staticmethod
    def _rows() -> Iterator[Sequence[Cell]]:
        from flexpm.dimensions import FEATURES

        for one in FEATURES.values():
            yield one.words, one.asked, f"{one.dimension}D", one.instead


def setup(app: Any) -> dict[str, bool]:
    """Register the directives."""
    app.add_directive("tests-by-dimension", TestsByDimension)
    app.add_directive("features-by-dimension", FeaturesByDimension)
    return {"parallel_read_safe": True}
