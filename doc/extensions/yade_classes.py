# SPDX-License-Identifier: GPL-3.0-or-later
"""Directive ``yade-class``: a class of the plugin as the built plugin describes itself.

YADE's macros put the documentation of a class and of its attributes into Python docstrings, with
marks for default, type and flags. The directive turns these into an entry of the Python domain.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

_MARK = re.compile(r"\s*:y(default|attrtype|attrflags):`([^`]*)`")
_STATIC = re.compile(r"\.\. ystaticattr:: \w+\.(\w+)\(=(.*)\)\s*\n\s*(\S.*)")
#: Defaults that are calls in C++.
_VECTOR = re.compile(r"Vector(\d)r::(Zero|Ones)\(\)")
_ARGUMENT = re.compile(r"\((\w+)\)(\w+)(?:=([^\s,\]]+))?")
#: Of YADE's flags: the attribute is read only from Python.
_READ_ONLY = 2


class YadeClass(SphinxDirective):
    """One class with its own attributes and methods, without those of its base."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Describe the class in reStructuredText and let Sphinx read that."""
        import flexpm

        made = getattr(flexpm, self.arguments[0])
        text = StringList(list(_class(made)), source=f"<{made.__name__}>")
        found = nodes.section()
        found.document = self.state.document
        self.state.nested_parse(text, self.content_offset, found)
        return found.children


def _class(made: type) -> Iterator[str]:
    import flexpm

    base = made.__mro__[1]
    about, *static = re.split(r"(?=\.\. ystaticattr::)", made.__doc__ or "")
    yield f".. py:class:: flexpm.{made.__name__}"
    yield ""
    owner = "" if base.__name__ in flexpm.__all__ else "YADE's "
    yield from _indented(f"{_plain(about).strip()} Derived from {owner}``{base.__name__}``.")
    for text in static:
        name, default, words = _STATIC.match(text).groups()
        if vector := _VECTOR.fullmatch(default):
            entry = {"Zero": "0", "Ones": "1"}[vector[2]]
            default = f"({', '.join([entry] * int(vector[1]))})"
        about = f"{words} Common to all. Default: ``{default}``."
        yield from map("   {}".format, [f".. py:attribute:: {name}", "", *_indented(about)])
    for name in sorted(set(vars(made)) - set(dir(base))):
        member = vars(made)[name]
        if name.startswith("_") or member.__doc__ is None:
            continue
        yield from map("   {}".format, _attribute(name, member) or _method(name, member))


def _attribute(name: str, member: Any) -> list[str]:
    if callable(member):
        return []
    marks = dict(_MARK.findall(member.__doc__))
    lines = [f".. py:attribute:: {name}"]
    if "attrtype" in marks:
        lines.append(f"   :type: {_python_type(marks['attrtype'])}")
    own = isinstance(member, property) and member.fset is None  # of a property that we define
    read_only = bool(int(marks.get("attrflags", "0")) & _READ_ONLY) or (own and not marks)
    about = _plain(member.__doc__) + (" Read only." if read_only else "")
    if marks.get("default") and not read_only:
        about += f" Default: ``{marks['default']}``."
    return [*lines, "", *_indented(about)]


def _method(name: str, member: Any) -> list[str]:
    signature, _, about = member.__doc__.strip().partition(":\n")
    arguments = [
        argument + (f"={default}" if default else "")
        for _, argument, default in _ARGUMENT.findall(signature)[1:]
    ]
    result = signature.rpartition("->")[2].strip()
    return [f".. py:method:: {name}({', '.join(arguments)}) -> {result}", "", *_indented(about)]


def _plain(text: str | None) -> str:
    """Text without YADE's marks; its cross references as literals."""
    return re.sub(r":yref:`([^`]*)`", r"``\1``", _MARK.sub("", text or ""))


def _python_type(name: str) -> str:
    known = {"Real": "float", "bool": "bool", "int": "int", "string": "str"}
    name = re.sub(r"^shared_ptr<(.*)>$", r"\1", name)
    return known.get(name, "list" if name.startswith("vector") else name.rpartition(":")[2])


def _indented(text: str) -> list[str]:
    lines = [line.strip() for line in _plain(text).strip().splitlines()]
    return [*(f"   {line}" for line in lines), ""]


def setup(app: Any) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("yade-class", YadeClass)
    return {"parallel_read_safe": True}
