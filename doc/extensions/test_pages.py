# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the pages of tests that follow from the package, and links to numbered deviations.

``test-specimens`` lists the shapes, sizes and models of a test, ``test-options`` the options that
only some tests have. The role ``dev`` links to an entry of the page of deviations.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.roles import XRefRole

#: Name of the page of deviations.
PAGE = "deviations"


def _table(head: Sequence[str], rows: Iterator[Sequence[str]], widths: Sequence[int]) -> nodes.Node:
    """A table whose texts may hold literals in backquotes."""
    group = nodes.tgroup(cols=len(widths))
    group += [nodes.colspec(colwidth=width) for width in widths]
    group += [nodes.thead("", _row(head)), nodes.tbody("", *map(_row, rows))]
    return nodes.table("", group, classes=["colwidths-given"])


def _row(cells: Sequence[str]) -> nodes.row:
    return nodes.row("", *(nodes.entry("", _paragraph(text)) for text in cells))


def _paragraph(text: str) -> nodes.paragraph:
    found = nodes.paragraph()
    for number, part in enumerate(text.split("`")):
        found += nodes.literal(part, part) if number % 2 else nodes.Text(part)
    return found


def _kind(name: str) -> Any:
    from flexpm.kinds.registry import KINDS

    return KINDS[name]


class TestSpecimens(Directive):
    """Shapes of the specimens of a test, with their default sizes and their models."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return a table with a line for each shape."""
        head = ("Dimension", "Shape", "Sizes and defaults [m]", "Models")
        return [_table(head, self._rows(_kind(self.arguments[0])), (17, 19, 34, 30))]

    @staticmethod
    def _rows(kind: Any) -> Iterator[Sequence[str]]:
        from flexpm.dimensions import is_solid
        from flexpm.specimens.space.any_spec import SIZES
        from flexpm.specimens.spec import SpecimenSpec

        other = {one.size: one.name for one in kind.options if one.size}
        for shape, variant in kind.variants.items():
            sizes = SIZES[shape] | variant.sizes
            if not is_solid(shape):
                sizes |= {"thickness": SpecimenSpec.thickness}
            said = [f"`--{other.get(name, name)}` {value:g}" for name, value in sizes.items()]
            dimension = "3D" if is_solid(shape) else "2D"
            models = ", ".join(f"`{one}`" for one in variant.models)
            yield dimension, f"`{shape}`", ", ".join(said), models


class TestOptions(Directive):
    """Options of a test that only some tests have, as the test declares them."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return a table with a line for each option."""
        head = ("Option", "Unit", "Default", "Meaning")
        return [_table(head, self._rows(_kind(self.arguments[0])), (26, 8, 24, 42))]

    @staticmethod
    def _rows(kind: Any) -> Iterator[Sequence[str]]:
        from flexpm.runs.groups import DECLARED

        for one in kind.options:
            words = f": {', '.join(f'`{word}`' for word in one.choices)}" if one.choices else ""
            models = f" (models: {', '.join(one.models)})" if one.models else ""
            name = f"`--{one.name.replace('_', '-')}`"
            yield name, one.unit or "-", one.default, f"{one.help}{words}{models}."
        if kind.confined:
            confinement = DECLARED["confinement"]
            yield "`--confinement`", confinement.unit, "0", "Confining pressure."


class Deviation(XRefRole):
    """A link to an entry of the page of deviations, by its number."""

    def process_link(
        self, env: Any, refnode: Any, has_explicit_title: bool, title: str, target: str
    ) -> tuple[str, str]:
        """Refer to the label that `label_deviations` gives."""
        refnode["refdomain"], refnode["reftype"] = "std", "ref"
        refnode["refexplicit"] = True
        return title, target.lower()


def label_deviations(app: Any, doctree: nodes.document) -> None:
    """Give each numbered entry of the page of deviations a label, such as ``d35``."""
    if app.env.docname != PAGE:
        return
    domain = app.env.get_domain("std")
    for term in doctree.findall(nodes.term):
        if number := re.match(r"D\d+(?=, )", term.astext()):
            label = number[0].lower()
            term["ids"].append(label)
            domain.note_hyperlink_target(label, PAGE, label, term.astext())


def setup(app: Any) -> dict[str, bool]:
    """Register the directives, the role and the labels."""
    app.add_directive("test-specimens", TestSpecimens)
    app.add_directive("test-options", TestOptions)
    app.add_role("dev", Deviation(warn_dangling=True))
    app.connect("doctree-read", label_deviations)
    return {"parallel_read_safe": True}
