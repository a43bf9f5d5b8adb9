# SPDX-License-Identifier: GPL-3.0-or-later
"""Solid specimens as JSON files, which read back to the same bits. SI units."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from ...errors import InputError
from ...files import Table, load_json, write_text

#: First entry of the files.
FORMAT = "flexpm solid 1"


def write(path: Path, fields: Table) -> None:
    """Write a specimen, whole or not at all; a line for each sphere."""
    content = {"format": FORMAT, **fields}
    rows = ",\n".join(json.dumps(row, allow_nan=False) for row in fields["spheres"])
    lines = [
        f"{json.dumps(key)}: {json.dumps(value, allow_nan=False)}"
        for key, value in content.items()
        if key != "spheres"
    ]
    lines += [f'"checksum": {json.dumps(_checksum(content))}', f'"spheres": [\n{rows}\n]']
    write_text(path, "{\n" + ",\n".join(lines) + "\n}\n")


def is_one(path: Path) -> bool:
    """Whether a file is that of a solid; one that cannot be read is none."""
    try:
        with path.open(encoding="utf-8") as file:
            return FORMAT in file.read(len(FORMAT) + 40)
    except (OSError, ValueError):
        return False


def read(path: Path) -> Table:
    """Read the content of a file.

    Raises:
        InputError: if it cannot be read, is no solid specimen, or was changed.
    """
    name = f"specimen = {str(path)!r}"
    content = load_json(path, "specimen")
    if content.get("format") != FORMAT:
        raise InputError(f"{name}, is no solid specimen of this flexpm; give a file of its save")
    if content.pop("checksum", None) != _checksum(content):
        raise InputError(
            f"{name}, was changed since it was saved; make own spheres by Specimen.from_spheres"
        )
    content["spec"]["diameters"] = _pair(content["spec"]["diameters"])
    return content


def _pair(values: list[float] | None) -> tuple[float, ...] | None:
    return None if values is None else tuple(values)


def _checksum(content: Table) -> str:
    text = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]
