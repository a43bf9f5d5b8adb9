# SPDX-License-Identifier: GPL-3.0-or-later
"""Rock files: measured values of a rock, with bands, spreads and sources. SI units, degrees.

A file has a table ``[rock]``, and a table for each measure with its value, its band and its source.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ...errors import InputError
from ...files import Table, load_toml
from ...require import (
    NOT_NEGATIVE,
    Bounds,
    nearest,
    quoted,
    require_flag,
    require_known,
    require_list,
    require_name,
    require_number,
    require_one_of,
    require_table,
    require_text,
)
from .measures import MEASURES, Measure

#: Files that flexpm includes; the template is no rock.
_ROCKS, _TEMPLATE = Path(__file__).with_name("rocks"), "template"
#: Measure without whose value no confining pressure is known.
_STRENGTH = "compressive_strength"
_ABOUT = ("name", "presets", "note", "source")
_NUMBERS, _KEYS = ("value", "spread", "lower", "upper"), ("unit", "source", "decides", "general")
_BAND = ("lower", "upper", "source")


@dataclass(frozen=True)
class Band:
    """Range of a measure; None: open at this end."""

    lower: float | None = None
    upper: float | None = None
    source: str = ""

    def has(self, number: float) -> bool:
        """Whether a number lies in the band, the bounds included."""
        above = self.lower is None or number >= self.lower
        return above and (self.upper is None or number <= self.upper)

    def widened(self, centre: float) -> Band:
        """Return the band with twice the distance of each bound from a number."""
        lower, upper = (
            None if one is None else centre + 2.0 * (one - centre)
            for one in (self.lower, self.upper)
        )
        return Band(lower, upper, self.source)


@dataclass(frozen=True)
class Entry:
    """Measure of a rock."""

    value: float | None = None  #: None: not measured
    spread: float | None = None  #: standard deviation or half range of the specimens
    band: Band = field(default_factory=Band)
    decides: bool = False  #: whether a scorecard fails by it
    general: Band | None = None  #: band of rocks of this type, which decides nothing


@dataclass(frozen=True)
class Rock:
    """A rock file."""

    name: str
    presets: tuple[str, ...]  #: beginnings of the names of materials of the rock
    note: str
    source: str
    entries: Mapping[str, Entry]

    @property
    def compressive_strength(self) -> float:
        """Compressive strength, which confining pressures are shares of [Pa]."""
        value = self.entries[_STRENGTH].value
        assert value is not None  # the file was checked
        return value


def names() -> list[str]:
    """Return the names of the rocks that flexpm includes."""
    return sorted(path.stem for path in _ROCKS.glob("*.toml") if path.stem != _TEMPLATE)


def load(rock: str | Path | None, material: str) -> Rock:
    """Read a rock file.

    Args:
        rock: A text that ends in ``.toml`` is a file; any other text is the name of a rock. None:
            the rock that the material is named after.
        material: Name of the material.

    Raises:
        InputError: for an unknown rock, a file that cannot be read or a wrong value.
    """
    known = names()
    if rock is None:
        for name in known:
            found = read(_ROCKS / f"{name}.toml")
            if any(_is_named_after(material, one) for one in (name, *found.presets)):
                return found
        raise InputError(
            f"rock is missing, and material {quoted(material)} is named after none of "
            f"{', '.join(known)}; give a rock or its file"
        )
    if str(rock).endswith(".toml"):
        return read(Path(rock))
    if rock not in known:
        raise InputError(
            f"rock = {quoted(str(rock))}, unknown{nearest(str(rock), known)}; known are "
            f"{', '.join(known)}, or give a .toml file"
        )
    return read(_ROCKS / f"{rock}.toml")


def _is_named_after(material: str, preset: str) -> bool:
    """Whether a material has a name, or one that begins with it and a hyphen."""
    return material == preset or material.startswith(f"{preset}-")


def read(path: Path) -> Rock:
    """Read a rock file.

    Raises:
        InputError: for a key that is unknown or missing, or a value out of range.
    """
    content = load_toml(path, "rock")
    about = require_table("rock [rock]", content.pop("rock", {}))
    for key in about:
        require_known("rock [rock] key", key, _ABOUT)
    name = require_name("rock [rock] name", about.get("name", path.stem))
    presets = require_list("rock [rock] presets", about.get("presets", []))
    note, source = (require_text(f"rock [rock] {key}", about.get(key, "")) for key in _ABOUT[2:])
    for key in content:
        require_known("rock measure", key, [*MEASURES])
    entries = {key: _entry(MEASURES[key], one, source) for key, one in content.items()}
    if _STRENGTH not in entries or entries[_STRENGTH].value is None:
        raise InputError(
            f"rock [{_STRENGTH}] value is missing, of which the confining pressures are shares; "
            "give it [Pa]"
        )
    texts = tuple(require_text("rock [rock] presets", one) for one in presets)
    return Rock(name, texts, note, source, entries)


def _entry(measure: Measure, given: object, source: str) -> Entry:
    """Check the table of a measure, whose source is that of the file unless it has its own."""
    where = f"rock [{measure.name}]"
    table = require_table(where, given)
    for key in table:
        require_known(f"{where} key", key, (*_NUMBERS, *_KEYS))
    if "unit" in table:
        require_one_of(f"{where} unit", table["unit"], [measure.unit])
    decides = require_flag(f"{where} decides", table.get("decides", False))
    general = _general(measure, where, table["general"]) if "general" in table else None
    ends = {key: table[key] for key in _BAND if key in table}
    band = _band(measure, where, {"source": source, **ends})
    if "value" not in table:
        return _unmeasured(where, table, decides, general)
    value = require_number(f"{where} value", table["value"], measure.bounds, _unit(measure))
    spread = None
    if "spread" in table:
        spread = require_number(f"{where} spread", table["spread"], NOT_NEGATIVE, _unit(measure))
    if not ("lower" in table or "upper" in table):
        raise InputError(f"{where} has a value, but no band; give lower, upper or both")
    if not band.has(value):
        raise InputError(
            f"{where} value = {value:g}, must lie in its band, {text_of(band)}; correct one of them"
        )
    if decides and not band.source:
        raise InputError(f"{where} decides, but has no source; name it here or in [rock]")
    return Entry(value, spread, band, decides, general)


def _unmeasured(where: str, table: Table, decides: bool, general: Band | None) -> Entry:
    """Table of a measure without a value, which can only have a general band."""
    for key in ("spread", "lower", "upper"):
        if key in table:
            raise InputError(
                f"{where} {key} = {quoted(table[key])}, must not be given without a value; give "
                "the value, or the band of similar rocks as general"
            )
    if decides:
        raise InputError(f"{where} decides = true, must be false without a value; give the value")
    return Entry(general=general)


def _general(measure: Measure, where: str, given: object) -> Band:
    label = f"{where} general"
    table = require_table(label, given)
    for key in table:
        require_known(f"{label} key", key, _BAND)
    if not ("lower" in table or "upper" in table):
        raise InputError(f"{label} has no band; give lower, upper or both")
    return _band(measure, label, table)


def _band(measure: Measure, where: str, table: Table) -> Band:
    """Band of a table, in the unit of the measure."""
    ends = {
        key: require_number(f"{where} {key}", table[key], _of_band(measure), _unit(measure))
        for key in ("lower", "upper")
        if key in table
    }
    if len(ends) == 2 and not ends["lower"] < ends["upper"]:
        raise InputError(
            f"{where} lower = {ends['lower']:g}, must be < upper = {ends['upper']:g}; swap them"
        )
    return Band(**ends, source=require_text(f"{where} source", table.get("source", "")))


def _of_band(measure: Measure) -> Bounds:
    """Bounds of a band: an end may be 0 where a value may not."""
    bounds = measure.bounds
    return NOT_NEGATIVE if bounds.above == 0.0 else bounds


def _unit(measure: Measure) -> str:
    return "" if measure.unit == "-" else measure.unit


def text_of(band: Band, factor: float = 1.0) -> str:
    """Return a band as text, in a unit of this factor."""
    lower, upper = (
        None if one is None else f"{factor * one:.4g}" for one in (band.lower, band.upper)
    )
    if lower is None:
        return "-" if upper is None else f"<= {upper}"
    return f">= {lower}" if upper is None else f"{lower} to {upper}"
