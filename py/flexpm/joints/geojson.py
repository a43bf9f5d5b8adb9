# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of joints from a map: GeoJSON with LineString and MultiLineString. Lengths in metres."""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from ..errors import InputError
from ..files import Table, read_text
from ..require import quoted
from .lines import Line, Lines, Point, check_name, checked

#: Ends of the names of such files.
SUFFIXES = (".geojson", ".json")
#: Property that names the joint, if there is one; else all lines are of one joint.
_PROPERTY, _ONE_JOINT = "name", "joint"
_KINDS = ("LineString", "MultiLineString")
#: Codes of EPSG that are angles: most geographic systems, and later ones.
_GEOGRAPHIC = (*range(4001, 5000), 6318, 6319, 6668, 6697, 7843, 7844, 7912, 9000, 9755)
_ANGLES = re.compile(r"CRS-?(84|83|27)|WGS.?84$", re.IGNORECASE)
#: Geometries within geometries.
_DEEPEST = 50


@dataclass(frozen=True)
class JointMap:
    """Lines that were read from a map.

    Attributes:
        lines: Lines of each joint, by its name, relative to the origin [m].
        origin: Point of the map at the origin of the specimen [m].
        notes: Remarks for the user, a line each.
    """

    lines: Lines
    origin: Point
    notes: tuple[str, ...]


def read(path: Path, name: str | None = None, origin: Point | None = None) -> JointMap:
    """Read the lines of a map.

    Args:
        path: The file, at most 64 MB.
        name: Property whose value names the joint of a line; None: ``name`` where all lines have
            it, else all are one joint.
        origin: Point of the map [m] at the origin of the specimen; None: the lower left corner of
            the lines.

    Raises:
        InputError: if it cannot be read, is no GeoJSON, has angles for coordinates, no lines, a
            line without the property, or a coordinate that is no number.
    """
    label = f"joints = {quoted(str(path))}"
    content = _content(label, path)
    notes = _system(label, content.get("crs"))
    found: list[tuple[str, object, Line]] = []
    others: Counter[str] = Counter()
    for number, (geometry, properties) in enumerate(_geometries(label, content), 1):
        kind = geometry.get("type")
        if kind not in _KINDS:
            others[str(kind)[:40]] += 1
            continue
        where = f"{label}, geometry {number}"
        lines = [geometry.get("coordinates")]
        if kind == "MultiLineString":
            lines = lines[0] if isinstance(lines[0], list) else [None]
        value = properties.get(_PROPERTY if name is None else name)
        found += [(where, value, _line(where, line)) for line in lines]
    if not found:
        raise InputError(f"{label}, lines = 0, must be >= 1; give LineString or MultiLineString")
    if others:
        told = ", ".join(f"{count} {kind}" for kind, count in sorted(others.items()))
        notes.append(f"joints: {told} left out, which are no lines")
    x, y = zip(*(point for _, _, line in found for point in line), strict=True)
    low = (min(x), min(y)) if origin is None else origin
    corner = " (lower left corner of the lines)" if origin is None else ""
    notes.append(f"joints: origin = {low[0]:.12g},{low[1]:.12g} m of the map{corner}")
    named = name is not None or all(value is not None for _, value, _ in found)
    joints: Lines = {}
    for where, value, line in found:
        joint = _name(where, name or _PROPERTY, value) if named else _ONE_JOINT
        joints.setdefault(joint, []).append([(x - low[0], y - low[1]) for x, y in line])
    return JointMap(checked(joints), low, tuple(notes))


def _content(label: str, path: Path) -> Table:
    reason = ""
    try:
        content = json.loads(read_text(path), parse_constant=_refuse)
    except OSError as error:
        raise InputError(f"{label}, cannot be read ({error.strerror}); give a map") from None
    except (ValueError, RecursionError) as error:
        content, reason = None, f" ({str(error).splitlines()[0]})"
    if not isinstance(content, dict):
        raise InputError(f"{label}, is not GeoJSON{reason}; give a map of lines")
    return content


def _refuse(name: str) -> NoReturn:
    raise ValueError(f"{name} is not a finite number")


def _system(label: str, crs: object) -> list[str]:
    """Reject angles; return a note if the file does not state its coordinate system."""
    if crs is None:
        return ["joints: crs is missing in the map, its numbers are taken as metres"]
    properties = crs.get("properties") if isinstance(crs, Mapping) else None
    name = properties.get("name") if isinstance(properties, Mapping) else None
    if not isinstance(name, str):
        raise InputError(f"{label}, crs = {quoted(crs)}, must have a name; save it projected")
    code = re.search(r"(\d+)\s*$", name)
    is_epsg = code is not None and "EPSG" in name.upper() and len(code[1]) < 9
    if _ANGLES.search(name) or (is_epsg and code is not None and int(code[1]) in _GEOGRAPHIC):
        raise InputError(
            f"{label}, crs = {quoted(name)}, is in degrees, must be in metres; save it projected"
        )
    return []


def _geometries(label: str, content: Table) -> Iterator[tuple[Table, Table]]:
    """Geometries and properties of their features, also within collections."""
    waiting: list[tuple[object, Table, int]] = [(content, {}, 0)]
    while waiting:
        one, properties, depth = waiting.pop()
        if not isinstance(one, dict) or depth > _DEEPEST:
            raise InputError(
                f"{label}: feature = {quoted(one)}, must be a GeoJSON feature; repair it"
            )
        within = {"FeatureCollection": "features", "GeometryCollection": "geometries"}
        key = within.get(str(one.get("type")))
        if key is not None:
            inner = one.get(key)
            if not isinstance(inner, list):
                raise InputError(f"{label}: {key} = {quoted(inner)}, must be a list; repair it")
            waiting += [(part, properties, depth + 1) for part in reversed(inner)]
        elif one.get("type") == "Feature":
            own = one.get("properties")
            if one.get("geometry") is not None:
                own = own if isinstance(own, dict) else {}
                waiting.append((one["geometry"], own, depth + 1))
        else:
            yield one, properties


def _line(where: str, given: object) -> Line:
    if not isinstance(given, list) or len(given) < 2:
        raise InputError(f"{where}: line = {quoted(given)}, must be two points or more; repair it")
    return [_point(where, one) for one in given]


def _point(where: str, given: object) -> Point:
    """A point, whose height is left out."""
    if isinstance(given, list) and len(given) >= 2:
        x, y = given[:2]
        numbers = all(isinstance(one, int | float) and not isinstance(one, bool) for one in (x, y))
        if numbers and abs(x) < 1e300 and abs(y) < 1e300 and math.isfinite(x + y):
            return float(x), float(y)
    raise InputError(f"{where}: point = {quoted(given)}, must be numbers x, y; repair it")


def _name(where: str, key: str, value: object) -> str:
    """Name of a joint; spaces become hyphens."""
    if value is None or isinstance(value, bool | list | dict):
        raise InputError(
            f"{where}: property {quoted(key)} = {quoted(value)}, must be a text or a number; "
            "choose another by name"
        )
    joint = "-".join(str(value).split())
    check_name(joint, f"{where}: property {quoted(key)}")
    return joint
