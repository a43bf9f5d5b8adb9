# SPDX-License-Identifier: GPL-3.0-or-later
"""Solid specimens as JSON files, which read back to the same bits. SI units."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from pathlib import Path

from ...errors import InputError
from ...files import Table, load_json, write_text
from ..files.rules import (
    Rule,
    is_count,
    is_text,
    list_of,
    or_none,
    require_rules,
    row_of,
    spec_values,
)
from .holes import is_hole
from .spec import SolidSpec


def _is_index(value: object) -> bool:
    return value == -1 or is_count(value)


def is_plane(value: object) -> bool:
    """Whether a value holds the plane of a joint."""
    if not isinstance(value, Mapping) or not {"name", "kind", "normal", "offset"} <= value.keys():
        return False
    rules: dict[str, Rule] = {
        "name": is_text,
        "kind": is_text,
        "normal": row_of(3),
        "offset": lambda one: row_of(1)([one]),
        "corners": list_of(row_of(3), 3),
        "radius": lambda one: row_of(1)([one]),
    }
    return all(key in rules and rules[key](one) for key, one in value.items())


#: First entry of the files.
FORMAT = "flexpm solid 1"
#: What each key of a file holds.
_KEYS: dict[str, Rule] = {
    "spec": lambda value: isinstance(value, Mapping),
    "removed_spheres": is_count,
    "spheres": list_of(row_of(4), 1),
    "minerals": or_none(list_of(is_count, 1)),
    "vertices": list_of(row_of(3), 4),
    "faces": list_of(list_of(_is_index, 5), 4),
    "pore_spheres": list_of(row_of(4), 1),
    "mineral_names": list_of(is_text, 1),
    "planes": list_of(is_plane, 1),
}
#: Keys that a file need not have.
_LATER = ("minerals", "vertices", "faces", "pore_spheres", "mineral_names", "planes")
#: What each field of the spec holds; sizes and numbers of a packing it checks itself.
_SPEC: dict[str, Rule] = {
    "kind": is_text,
    "diameters": or_none(row_of(2)),
    "spheres": or_none(is_text),
    "cells": or_none(is_text),
    "minerals": or_none(is_text),
    "joints": or_none(is_text),
    "joint_names": or_none(list_of(is_text, 1)),
    "holes": or_none(list_of(is_hole, 1)),
    "networks": or_none(list_of(lambda value: isinstance(value, Mapping), 1)),
}


def write(path: Path, fields: Table) -> None:
    """Write a specimen, whole or not at all; a line for each sphere."""
    content = {"format": FORMAT, **fields}
    rows = ",\n".join(json.dumps(row, allow_nan=False) for row in fields["spheres"])
    lines = [
        f"{json.dumps(key)}: {json.dumps(value, allow_nan=False)}"
        for key, value in content.items()
        if key != "spheres"
    ]
    lines += [f'"checksum": {json.dumps(checksum(content))}', f'"spheres": [\n{rows}\n]']
    write_text(path, "{\n" + ",\n".join(lines) + "\n}\n")


def is_one(path: Path) -> bool:
    """Return whether a file is a 3D specimen; False if it cannot be read."""
    try:
        with path.open(encoding="utf-8") as file:
            return FORMAT in file.read(len(FORMAT) + 40)
    except (OSError, ValueError):
        return False


def read(path: Path) -> Table:
    """Read the content of a file: ``spec``, ``removed_spheres``, ``spheres`` and the like.

    The checksum detects changes of the file. It does not check that the content is valid.

    Raises:
        InputError: if it cannot be read, is no solid specimen, or was changed, or a value is none
            of a solid.
    """
    name = f"specimen = {str(path)!r}"
    content = load_json(path, "specimen")
    if content.get("format") != FORMAT:
        raise InputError(
            f"{name}, is not a 3D specimen file of this version; give a file that its save() wrote"
        )
    if content.pop("checksum", None) != checksum(content):
        raise InputError(
            f"{name}, was changed after it was saved; for other spheres use Specimen.from_spheres"
        )
    require_rules(content, _KEYS, _LATER)
    known = [field.name for field in dataclasses.fields(SolidSpec)]
    return content | {"spec": SolidSpec(**spec_values(content["spec"], known, _SPEC))}


def checksum(content: Table) -> str:
    """Return the checksum of the other content of a file."""
    text = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]
