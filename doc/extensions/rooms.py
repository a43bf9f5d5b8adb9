# SPDX-License-Identifier: GPL-3.0-or-later
"""Directives that show the rooms of the sources as scripts/checks/layers.toml lists them.

``rooms-picture`` draws one tree (kernel, yade or python) from its lowest room up; ``rooms-table``
gives one line for each room.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.ext.graphviz import graphviz

TABLE = Path(__file__).resolve().parents[2] / "scripts" / "checks" / "layers.toml"


def rooms_of(tree: str) -> dict[str, dict[str, Any]]:
    """Rooms of one tree by name, lowest first."""
    return tomllib.loads(TABLE.read_text(encoding="utf-8"))[tree]


def within(rooms: dict[str, dict[str, Any]]) -> dict[str, set[str]]:
    """Rooms of the same tree that each room uses."""
    return {name: {used for used in room["uses"] if used in rooms} for name, room in rooms.items()}


def shortest(uses: dict[str, set[str]]) -> set[tuple[str, str]]:
    """Arrows without those that other arrows imply: a room also sees what its neighbours use."""

    def reached(name: str) -> set[str]:
        return set().union(*({used} | reached(used) for used in uses[name]))

    return {
        (name, used)
        for name, direct in uses.items()
        for used in direct
        if not any(used in reached(other) for other in direct - {used})
    }


class RoomsPicture(Directive):
    """Rooms of a tree as boxes, with an arrow from each to those that it uses."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the picture as a graph that Graphviz lays out."""
        tree = self.arguments[0]
        rooms = rooms_of(tree)
        lines = [f'"{name}" -> "{used}";' for name, used in sorted(shortest(within(rooms)))]
        boxes = [f'"{name}";' for name in rooms]
        node = graphviz()
        node["code"] = (
            "digraph rooms { rankdir=TB; nodesep=0.25; ranksep=0.35;"
            ' node [shape=box, style="rounded,filled", fillcolor="#f4efe6", color="#8a7f70",'
            ' fontname="sans-serif", fontsize=12]; edge [color="#8a7f70", arrowsize=0.6];'
            f" {' '.join(boxes + lines)} }}"
        )
        node["options"] = {}
        node["alt"] = f"Rooms of {tree}: " + "; ".join(
            f"{name} uses {', '.join(sorted(used)) or 'none'}"
            for name, used in within(rooms).items()
        )
        return [node]


class RoomsTable(Directive):
    """One line for each room of a tree, highest first."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return a table: room, what lives there, what a change must keep."""
        group = nodes.tgroup(cols=3)
        group += [nodes.colspec(colwidth=width) for width in (12, 44, 44)]
        head, body = nodes.thead(), nodes.tbody()
        head += self._row(["room", "what lives there", "what a change must keep"])
        for name, room in reversed(rooms_of(self.arguments[0]).items()):
            body += self._row([name, room["holds"], room["keep"]])
        group += [head, body]
        table = nodes.table()
        table += group
        return [table]

    @staticmethod
    def _row(cells: list[str]) -> nodes.row:
        row = nodes.row()
        for text in cells:
            entry = nodes.entry()
            entry += nodes.paragraph("", text)
            row += entry
        return row


def setup(app: Any) -> dict[str, bool]:
    """Register the directives."""
    app.setup_extension("sphinx.ext.graphviz")
    app.add_directive("rooms-picture", RoomsPicture)
    app.add_directive("rooms-table", RoomsTable)
    return {"parallel_read_safe": True}
