#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The schema of result.json, made from the classes whose fields are its keys.

Types are those of the fields, words those of their documentation, units and choices those of the
tables of materials and options. ``result_schema_tables`` adds the tables within a result. The
directive ``result-schema`` shows the schema on a page, and a build of the site writes
``result.schema.json`` beside the pages.
"""

from __future__ import annotations

import dataclasses
import importlib
import inspect
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from result_schema_tables import TABLES
from sphinx.ext.napoleon import Config, GoogleDocstring
from sphinx.pycode import ModuleAnalyzer

NAME = "result.schema.json"
TYPES = {
    **{"int": "integer", "float": "number", "str": "string", "bool": "boolean", "None": "null"},
    **{"Table": "object", "list[Table]": "array"},
}
NUMBER, TEXT = {"type": "number"}, {"type": "string"}
#: What a tuple holds, by the type of a field.
TUPLES = {
    "tuple[float, float]": {"items": NUMBER, "minItems": 2, "maxItems": 2},
    "tuple[str, ...]": {"items": TEXT},
    "tuple[Table, ...]": {},
}


def words_of(cls: type) -> dict[str, str]:
    """What is said of the fields of a class: in its docstring, or in comments at the fields."""
    found = {}
    analyzer = ModuleAnalyzer.for_module(cls.__module__)
    for (owner, name), lines in analyzer.find_attr_docs().items():
        if owner == cls.__name__:
            found[name] = " ".join(lines).strip()
    # an option of the library; the style of a docstring is Google's
    text = GoogleDocstring(inspect.getdoc(cls) or "", Config(napoleon_use_ivar=True)).lines()
    for entry in re.findall(r"^:ivar (\w+): (.*(?:\n +.*)*)", "\n".join(text), re.MULTILINE):
        found[entry[0]] = " ".join(entry[1].split())
    return {name: capital(said.rstrip(".")) for name, said in found.items()}


def capital(text: str) -> str:
    """A text with a capital at its beginning, and JSON's word for nothing."""
    text = re.sub(r"\bNone\b", "null", text.replace("``", "`"))
    return text[:1].upper() + text[1:]


def typed(annotation: str) -> dict[str, object]:
    """Type of a field as a schema has it; empty for one that is a table of its own."""
    names, rules = [], {}
    for name in annotation.split(" | "):
        if name not in {*TUPLES, *TYPES}:
            return {}
        if name in TUPLES:
            rules |= TUPLES[name]
        names.append("array" if name in TUPLES else TYPES[name])
    return {"type": names[0] if len(names) == 1 else names, **rules}


def fields_of(cls: type, without: Iterable[str] = ()) -> dict[str, dict[str, object]]:
    """Keys of a table whose fields are those of a class."""
    words = {}
    for base in reversed(cls.__mro__[:-1]):
        words |= words_of(base)
    return {
        one.name: typed(str(one.type)) | described(words.get(one.name, ""))
        for one in dataclasses.fields(cls)
        if one.name not in without
    }


def described(words: str) -> dict[str, str]:
    """Entry of the schema with what is said of a key, if anything is."""
    return {"description": words} if words else {}


def numbers(units: Mapping[str, str | None], choices: Mapping[str, Iterable[str]]) -> Any:
    """Keys of a table of parameters."""
    return {
        key: {"enum": [*choices[key]]}
        if key in choices
        else {"type": ["number", "null"], "description": f"[{unit or '-'}]"}
        for key, unit in units.items()
    }


def made() -> dict[str, Any]:
    """The schema."""
    importlib.import_module("flexpm")
    from flexpm.joints.planes import PlanesCut
    from flexpm.kinds.registry import ELASTIC, TESTS, options
    from flexpm.materials.interface import KEYS
    from flexpm.materials.keys import CHOICES, JOINT_UNITS, UNITS
    from flexpm.models.options import MESHES, MODELS, POINTS
    from flexpm.renamed import ATTRIBUTES
    from flexpm.results.result import OF_SOLIDS, Result
    from flexpm.results.result_checks import STATUSES
    from flexpm.runs.groups import DECLARED, OWN_OPTIONS, STARTS
    from flexpm.runs.run_inputs import RunInputs
    from flexpm.specimens.space.spec import SIZES as SOLIDS
    from flexpm.specimens.space.spec import SolidSpec
    from flexpm.specimens.spec import SIZES, SpecimenSpec

    result = fields_of(Result, ("curve", "cracks", "emission", "snapshot", "resumed_at"))
    for old, new in ATTRIBUTES["Result"].items():
        result[old] = result[new] | described(f"Old name of `{new}`, removed in 0.4")
    result["warnings"] = {"type": "array", "items": TEXT}
    run = fields_of(RunInputs, ("own",))
    for name, one in DECLARED.items():
        default = f"; default: {one.default}" if one.default else ""
        run[name] |= described(capital(f"{one.phrase}{default}".replace("--", "")))
    for name in OWN_OPTIONS:
        run[name] = run.get(name, dict(NUMBER)) | option([*options()[name].values()])
    plane, solid = fields_of(SpecimenSpec), fields_of(SolidSpec)
    for place, name, choices in (
        (result, "test", [*TESTS, ELASTIC, "own"]),
        (result, "model", MODELS),
        (result, "status", STATUSES),
        (run, "test", [*TESTS, ELASTIC]),
        (run, "model", MODELS),
        (run, "mesh", MESHES),
        (run, "points", POINTS),
        (run, "start", ["", *STARTS]),
        (plane, "kind", SIZES),
        (solid, "kind", SOLIDS),
    ):
        place[name]["enum"] = [*choices]
    words = numbers(UNITS, CHOICES)
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "result.json of flexpm",
        "type": "object",
        "properties": result,
        "additionalProperties": False,
        "required": [name for name in result if name not in OF_SOLIDS],
        "$defs": {
            "run_spec": table(run, ("test", "specimen", "material")),
            "specimen": table(plane),
            "solid": table(solid, solid),
            "material": {"type": "object", "properties": dict(words)},
            "mineral": {"type": "object", "properties": dict(words)},
            "joint": table({"name": TEXT, **numbers(JOINT_UNITS, {})}, ("name",)),
            "interface": table({key: words[key] for key in KEYS}, KEYS),
            "planes_cut": table(planes := fields_of(PlanesCut), planes),
        },
    }
    whole = joined(schema, TABLES)
    whole["$defs"]["own_inputs"]["properties"]["model"]["enum"] = [*MODELS]
    whole["$defs"]["loading"]["properties"]["status"]["enum"] = [
        one for one in STATUSES if one != "unfinished"
    ]
    whole["$defs"]["interface"]["required"] = ["pair", *KEYS]
    return whole


def option(of: Sequence[Any]) -> dict[str, object]:
    """What is said of an option that some tests have, by those tests."""
    first = of[0]
    unit = f" [{first.unit}]" if first.unit else ""
    said = {"description": f"{first.help}{unit}; null for tests that have none"}
    choices = dict.fromkeys(word for one in of for word in one.choices)
    return said | ({"enum": [*choices, None]} if choices else {})


def table(keys: Mapping[str, object], required: Iterable[str] = ()) -> dict[str, Any]:
    """A table that has these keys alone."""
    return {
        "type": "object",
        "properties": dict(keys),
        "additionalProperties": False,
        "required": [*required],
    }


def joined(one: Any, other: Any) -> Any:
    """One table with what another says of its keys."""
    if not (isinstance(one, dict) and isinstance(other, dict)):
        return other
    both = {key: joined(value, other[key]) if key in other else value for key, value in one.items()}
    return both | {key: value for key, value in other.items() if key not in one}


def as_json() -> str:
    """Return the schema as JSON."""
    return json.dumps(made(), indent=2, ensure_ascii=False) + "\n"


class ResultSchema(Directive):
    """The schema as a listing."""

    def run(self) -> list[nodes.Node]:
        """Return a block of JSON."""
        return [nodes.literal_block(as_json(), as_json(), language="json")]


def write(app: Any, exception: Exception | None) -> None:
    """Write the schema beside the pages of a site that has been built."""
    if exception is None and app.builder.format == "html":
        (Path(app.outdir) / NAME).write_text(as_json(), encoding="utf-8")


def setup(app: Any) -> None:
    """Register the directive and the file."""
    app.add_directive("result-schema", ResultSchema)
    app.connect("build-finished", write)
