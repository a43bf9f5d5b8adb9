# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens as JSON files, which read back to the same bits. SI units."""

from __future__ import annotations

import dataclasses
import hashlib
import itertools
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...files import Table, load_json, write_text
from ...joints.cuts import Cut
from ...joints.lines import checked
from ..space.file import FORMAT as SOLID
from .file_checks import require_sense, require_types
from .file_checks import spec_of as spec_of

_FORMAT = "flexpm specimen 1"


def write(path: Path, fields: Table) -> None:
    """Write a specimen, whole or not at all.

    Args:
        path: The file.
        fields: Its keys as doc/files has them, but format and checksum, as of ``fields_of``.
    """
    content = {"format": _FORMAT, **fields}
    content["checksum"] = _checksum(content)
    lines = [f"{json.dumps(key)}: {_text(value)}" for key, value in content.items()]
    write_text(path, "{\n" + ",\n".join(lines) + "\n}\n")


def fields_of(specimen: Mapping[str, Any]) -> Table:
    """Keys of a file but format and checksum, from fields of Specimen, which ``parts`` gives."""
    import numpy as np

    cells, outline = specimen["tessellation"], specimen["outline"]
    corners, ends = cells.cell_vertices.tolist(), cells.cell_offsets.tolist()
    edges, found = cells.shared_edges, specimen["edge_joints"]
    joints = [] if found is None else np.column_stack((edges[:, 2:], found))[found >= 0].tolist()
    names, spec = specimen["mineral_names"], specimen["spec"]
    return {
        "spec": dataclasses.asdict(spec),
        "outline": (
            outline.tolist() if hasattr(outline, "tolist") else dataclasses.asdict(outline)
        ),
        "holes": [hole.tolist() for hole in specimen["holes"]],
        "removed_discs": specimen["removed_discs"],
        "minerals": _list(specimen["minerals"]),
        **({"mineral_names": list(names)} if names else {}),
        "vertices": cells.vertices.tolist(),
        "cells": [corners[start:end] for start, end in itertools.pairwise(ends)],
        "discs": specimen["discs"].tolist(),
        **({} if spec.is_laguerre else {"laguerre": cells.laguerre.tolist()}),
        "sides": cells.boundary_edges[:, 1:].tolist(),
        "joints": joints,
        "lines": specimen["joints"],
        "cuts": {name: cut.to_json() for name, cut in specimen["joint_cuts"].items()},
        "strengths": _list(specimen["strengths"]),
        "grains": _list(specimen["grains"]),
    }


def _list(array: Any) -> list[Any] | None:
    return None if array is None else array.tolist()


def read(path: Path) -> Table:
    """Read the content of a file; nothing heavy is loaded.

    Raises:
        InputError: if it cannot be read, is no specimen, or was changed, or a value is none of a
            specimen.
    """
    name = f"specimen = {str(path)!r}"
    content = load_json(path, "specimen")
    if content.get("format") == SOLID:
        raise InputError(
            f"{name}, is 3D, must be 2D; use a function for 3D specimens, or Specimen.load_solid"
        )
    if content.get("format") != _FORMAT:
        raise InputError(
            f"{name}, is not a specimen file of this version; give a file of Specimen.save"
        )
    found = content.pop("checksum", None)
    if found != _checksum(content):
        raise InputError(
            f"{name}, was changed after it was saved; for other cells use Specimen.from_polygons"
        )
    require_types(content)
    return content


def parts(content: Table) -> Table:
    """Arguments of Specimen, from the content of a file.

    Raises:
        InputError: if they are no specimen: see ``file_checks``.
    """
    import numpy as np

    from ..._flexpm import cells_of_file
    from ..kernel_input import Circle, call

    def integers(key: str, columns: int) -> Any:
        return np.array(content[key], dtype=np.int32).reshape(-1, columns)

    discs, sides, spec = (
        np.array(content["discs"], dtype=float),
        integers("sides", 3),
        spec_of(content),
    )
    # files from before the marks hold either a packing or cells none of which is sure to be whole
    marks = content.get("laguerre", [int(spec.is_laguerre)] * len(discs))
    tiling = call(
        cells_of_file,
        np.array(content["vertices"], dtype=float),
        [np.array(cell, dtype=np.int32) for cell in content["cells"]],
        sides,
        integers("joints", 3),
        np.ascontiguousarray(discs[:, :2]),
        np.ascontiguousarray(discs[:, 2]),
        np.array(marks, dtype=np.int32),
    )
    outline = content["outline"]
    given = {key: content[key] for key in ("minerals", "grains") if content[key] is not None}
    found: Table = {
        "discs": discs,
        "outline": (
            Circle(**outline) if isinstance(outline, Mapping) else np.array(outline, dtype=float)
        ),
        "tessellation": tiling.tessellation,
        "spec": spec,
        "removed_discs": content["removed_discs"],
        "mineral_names": tuple(content.get("mineral_names", ())),
        "holes": tuple(np.array(hole, dtype=float) for hole in content["holes"]),
        "joints": checked(content["lines"], excavations=True) if content.get("lines") else {},
        "joint_cuts": {name: Cut.from_json(cut) for name, cut in content.get("cuts", {}).items()},
    }
    found |= {key: np.array(values, dtype=np.int32) for key, values in given.items()}
    if content["strengths"] is not None:
        found["strengths"] = np.array(content["strengths"], dtype=float)
    if content["joints"]:
        found["edge_joints"] = tiling.edge_joints
    require_sense(found, sides, len(content["joints"]), tiling)
    for array in (*found.values(), *found["holes"]):
        if isinstance(array, np.ndarray):
            array.setflags(write=False)
    return found


def _text(value: object) -> str:
    """JSON of a value; of a list of lists, a line each."""
    if isinstance(value, list) and value and isinstance(value[0], list):
        return "[\n" + ",\n".join(json.dumps(one, allow_nan=False) for one in value) + "\n]"
    return json.dumps(value, allow_nan=False)


def _checksum(content: Table) -> str:
    text = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]
