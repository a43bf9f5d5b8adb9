# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibration files: targets, free values, and the runs that measure them. SI units, degrees.

A calibration has targets (measures of a rock), free keys of a material with their bounds, and the
specimens on which the search is made and on which its best sets are verified.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..dimensions import is_solid
from ..errors import InputError
from ..files import Table, load_toml
from ..kinds.registry import KINDS, TESTS
from ..materials import interface
from ..materials.keys import ELASTIC_KEYS, ELASTIC_SET, UNITS
from ..materials.made_for import MadeFor, dimension_of
from ..require import (
    NOT_NEGATIVE,
    POSITIVE,
    Bounds,
    quoted,
    require_file_name,
    require_known,
    require_list,
    require_number,
    require_table,
    require_tables,
    require_text,
    require_whole,
)
from ..runs import input_names
from ..specimens.checks import DIAMETERS, require_seed
from . import calibration_measures as measures_of
from . import past_peak
from .calibration_measures import AT_PRESSURE, ELASTIC_MEASURES, MEASURES, Run
from .study import MOST_RUNS, flat

_TABLES = ("calibration", "common", "screen", "verify", "target", "free", "ratio")
_ABOUT = (
    *("name", "model", "material", "tied"),
    *("evaluations", "rounds", "candidates", "confinements"),
)
_DEFAULTS = {"model": "flexible", "evaluations": 40, "rounds": 2, "candidates": 2}
#: Options of the runs; the others are the search's own.
_OPTIONS = [
    *(key for key in input_names.OPTIONS if key not in ("model", "confinement", "seed")),
    *(f"set.{key}" for key in UNITS),
]
#: Confinements of an envelope [Pa].
CONFINEMENTS = (0.0, 2e6, 4e6, 8e6, 12e6)


@dataclass(frozen=True)
class Target:
    """One measure of the rock."""

    name: str
    value: float
    tolerance: float = 0.05  #: relative deviation that counts as met [-]
    weight: float = 1.0  #: of its squared deviation in tolerances [-]
    pressure: float | None = None  #: confining pressure that the measure is of [Pa]

    @property
    def least(self) -> bool:
        """Whether the value is a least value, which any larger one meets."""
        return self.pressure is not None and measures_of.is_least(self.name)

    def residual(self, found: float) -> float:
        """Weighted deviation in tolerances [-]; 0 above a least value."""
        part = found / self.value - 1.0
        return math.sqrt(self.weight) * (min(part, 0.0) if self.least else part) / self.tolerance

    def corrected(self, small: float | None, full: float | None) -> Target:
        """Return the target of small specimens with which full specimens should meet theirs.

        A least value stays: beyond it values of small and full specimens differ at will.
        """
        if small is None or full is None or self.least:
            return self
        return replace(self, value=self.value * small / full)


@dataclass(frozen=True)
class Ratio:
    """Bounds of the quotient of two free keys."""

    of: str
    to: str
    bounds: tuple[float, float]


@dataclass(frozen=True)
class Runs:
    """Options and packings of the search or of the verification."""

    options: Table
    seeds: Sequence[int]
    disc_seeds: Sequence[int]  #: of the measures that discs alone tell
    of_test: Mapping[str, Table] = field(default_factory=dict)  #: other options, by the test

    def shape_of(self, test: str) -> str:
        """Shape of the specimens of a test."""
        options = {**self.options, **self.of_test.get(test, {})}
        return input_names.shape_of(test, options.get("shape"), options.get("depth"))

    def seeds_of(self, target: Target) -> Sequence[int]:
        """Return the seeds of the packings on which a measure is taken."""
        tests = measures_of.tests_of(target.name)
        discs = bool(tests) and all(KINDS[test].shape == "disc" for test in tests)
        return self.disc_seeds if discs else self.seeds


@dataclass(frozen=True)
class Calibration:
    """A calibration file."""

    name: str
    model: str
    material: str | None  #: preset or file that the search starts from; None for the default
    base: Path  #: folder that the material's path is relative to
    targets: Sequence[Target]
    free: Mapping[str, tuple[float, float]]  #: bounds of each free key
    ratios: Sequence[Ratio]
    screen: Runs  #: of the search
    verify: Runs  #: of the verification
    evaluations: int  #: most sets of strengths tried in a round
    rounds: int
    candidates: int  #: best sets of a round that are verified
    confinements: Sequence[float] = field(default=CONFINEMENTS)  #: of an envelope [Pa]
    #: Free elastic keys that follow from the elastic targets for each set of the other keys; empty:
    #: all free elastic keys are fitted once, before the search.
    tied: Sequence[str] = ()

    @property
    def material_file(self) -> str | None:
        """Preset, or path of the file, that the search starts from."""
        if self.material is None or not self.material.endswith(".toml"):
            return self.material
        return str(self.base / self.material)

    @property
    def is_solid(self) -> bool:
        """Whether the specimens are 3D."""
        tests = {test for target in self.targets for test, _ in self.tests(target)}
        return any(is_solid(self.screen.shape_of(test)) for test in tests)

    @property
    def elastic_keys(self) -> list[str]:
        """Free keys of the elastic solution."""
        return [key for key in self.free if _is_elastic(key)]

    @property
    def made_for(self) -> MadeFor | None:
        """Specimens and model of the calibration; None: unknown."""
        low, high = self.verify.options.get("diameters", DIAMETERS)
        return MadeFor(dimension_of(solid=self.is_solid), self.model, 0.5 * (low + high))

    def of_kind(self, elastic: bool) -> tuple[list[Target], list[str]]:
        """Return targets and keys of the elastic fit, or those of the search.

        With tied keys the search has the elastic targets, too, in case that no values of the tied
        keys meet them.
        """
        elastic_targets = [t for t in self.targets if t.name in ELASTIC_MEASURES]
        fitted = _fitted(self.tied, self.free)
        if elastic:
            return elastic_targets, fitted
        others = [t for t in self.targets if t not in elastic_targets or self.tied]
        return others, [key for key in self.free if key not in fitted]

    def tests(self, target: Target) -> list[Run]:
        """Return the tests with their confining pressures [Pa] that a measure needs."""
        return measures_of.runs_of(
            target.name,
            self.confinements,
            pressure=target.pressure,
            solid=is_solid(self.screen.options.get("shape", "")),
        )

    def ends(self, run: Run) -> Table:
        """Return the options by which a run goes on past its peak; none unless a drop needs it."""
        if not any(run in self.tests(target) for target in self.targets if target.least):
            return {}
        values = {target.name: target.value for target in self.targets}
        unconfined = values.get(measures_of.name_at("peak", 0.0))
        strength = values.get("compressive_strength", unconfined)
        return past_peak.ends(run[1], strength, values.get("youngs_modulus"))

    def entries(self, target: Target) -> list[tuple[Run, str]]:
        """Return test, confining pressure [Pa] and key of result.json of each part of a measure."""
        return measures_of.entries(target.name, self.tests(target))

    def measure(self, target: Target, found: Mapping[Run, Table]) -> float | None:
        """Return a measure of a packing from its results by test and pressure; None if missing."""
        return measures_of.measured(target.name, self.tests(target), found)


def _fitted(tied: Sequence[str], free: Mapping[str, object]) -> list[str]:
    """Free keys that the elastic targets determine."""
    return [*tied] or [key for key in free if _is_elastic(key)]


def _last(key: str) -> str:
    """A key without the pair that it is of."""
    return key.rpartition(".")[2]


def _is_elastic(key: str) -> bool:
    return _last(key) in ELASTIC_KEYS


def read(path: Path | str) -> Calibration:
    """Read a calibration file.

    Raises:
        InputError: if it cannot be read, or for an unknown key or a value out of range.
    """
    path = Path(path)
    content = load_toml(path, "calibration")
    for table in content:
        require_known("calibration table", table, _TABLES)
    about = _about(content, path)
    targets = [*_targets(_table(content, "target"))]
    free = free_of(_table(content, "free"))
    _require_tied(about["tied"], free, targets)
    ratios = require_tables("calibration [[ratio]]", content.get("ratio", []))
    return Calibration(
        base=path.parent,
        targets=targets,
        free=free,
        ratios=[*_ratios(ratios, free, _fitted(about["tied"], free))],
        screen=_runs(content, "screen", (1,)),
        verify=_runs(content, "verify", (11, 12, 13, 14, 15)),
        **about,
    )


def _targets(wanted: Table) -> Iterator[Target]:
    """Return the targets of a file, those at confining pressures included."""
    for name, entry in wanted.items():
        require_known("calibration [target] key", name, [*MEASURES, *AT_PRESSURE])
        if name not in AT_PRESSURE:
            yield target_of(name, entry)
            continue
        label = f"calibration [target] {name}"
        by_pressure = require_table(label, entry)
        _require(f"[target] {name}", by_pressure, bool(by_pressure), "a table with entries")
        known: set[str] = set()
        for text, one in by_pressure.items():
            pressure = _pressure(f"[target] {name}", text, one)
            found = measures_of.name_at(AT_PRESSURE[name], pressure)
            _require(f"[target] {name}", text, found not in known, "a pressure that differs")
            known.add(found)
            target = replace(target_of(found, one), pressure=pressure)
            is_share = target.value < 1.0 or not target.least
            _require(f"[target] {found}", target.value, is_share, "a part of the peak, below 1")
            yield target


def _pressure(label: str, text: str, entry: object) -> float:
    """Return the confining pressure [Pa] that is a key of a table."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    _require(label, text, number >= 0.0 and math.isfinite(number), "a table by pressures in Pa")
    # TOML reads a point in a key without quotes as that of a table
    whole = not isinstance(entry, Mapping) or "value" in entry
    _require(label, text, whole, "given a value; a pressure with a point stands in quotes")
    return number


def _require_tied(tied: Sequence[str], free: Mapping[str, object], targets: list[Target]) -> None:
    """Refuse tied keys that the elastic targets do not determine."""
    elastic = [key for key in free if _is_elastic(key)]
    for key in tied:
        require_known("calibration [calibration] tied", key, elastic)
    aims = [target.name for target in targets if target.name in ELASTIC_MEASURES]
    if tied:
        rule = f"as many keys as elastic targets ({len(aims)}), each once"
        _require("[calibration] tied", [*tied], len({*tied}) == len(tied) == len(aims), rule)
        _require(
            "[calibration] tied",
            [*tied],
            len(tied) < len(elastic),
            "fewer than the free elastic keys, which are fitted before the search without tied",
        )


def free_of(bounds: Mapping[str, object]) -> dict[str, tuple[float, float]]:
    """Return the free keys with their bounds.

    Raises:
        InputError: for an unknown key, and for invalid bounds.
    """
    free = {key: _bounds(f"[free] {key}", b) for key, b in bounds.items()}
    for key in free:
        name = _last(key) if interface.is_key(key) else key
        require_known("calibration [free] key", name, [name for name in UNITS if UNITS[name]])
    return free


def _about(content: Table, path: Path) -> Table:
    """The table ``[calibration]`` with its defaults."""
    given = require_table("calibration [calibration]", content.get("calibration", {}))
    about = {**_DEFAULTS, "name": path.stem, "material": None, "tied": [], **given}
    for key in given:
        require_known("calibration [calibration] key", key, _ABOUT)
    label = "calibration [calibration]"
    for key in ("evaluations", "rounds", "candidates"):
        require_whole(f"{label} {key}", about[key], Bounds(at_least=1, at_most=MOST_RUNS))
    require_file_name(f"{label} name", f"{about['name']}")  # that of the preset
    require_text(f"{label} name", about["name"])
    require_known(f"{label} model", about["model"], list(ELASTIC_SET))
    if about["material"] is not None:
        require_text(f"{label} material", about["material"])
    about["tied"] = tuple(require_list(f"{label} tied", about["tied"]))
    asked = require_list(f"{label} confinements", about.get("confinements", CONFINEMENTS))
    pressures = [require_number(f"{label} confinements", one, NOT_NEGATIVE, "Pa") for one in asked]
    if len(set(pressures)) != len(pressures) or len(pressures) < 2:
        raise InputError(
            f"{label} confinements = {asked}, must be two or more, each once; correct them"
        )
    return about | {"confinements": tuple(pressures)}


def _table(content: Table, name: str) -> Table:
    entries = require_table(f"calibration [{name}]", content.get(name, {}))
    _require(f"[{name}]", entries, bool(entries), "a table with entries")
    return entries


def target_of(name: str, entry: object) -> Target:
    """A target, from its value or a table with ``value``, ``tolerance`` and ``weight``."""
    given = entry if isinstance(entry, Mapping) else {"value": entry}
    for key in given:
        require_known(f"calibration [target] {name} key", key, ("value", "tolerance", "weight"))
    _require(f"[target] {name}", dict(given), "value" in given, "given a value")
    label = f"calibration [target] {name}"
    numbers = {key: require_number(f"{label} {key}", n, POSITIVE) for key, n in given.items()}
    return Target(name, **numbers)


def _ratios(
    entries: Sequence[Table], free: Mapping[str, object], fitted: Sequence[str]
) -> Iterator[Ratio]:
    """Return the bounds of quotients of keys that the search changes."""
    for entry in entries:
        for key in entry:
            require_known("calibration [[ratio]] key", key, ("of", "to", "bounds"))
        for key in ("of", "to"):
            require_known(f"calibration [[ratio]] {key}", entry.get(key), list(free))
            searched = entry[key] not in fitted
            _require(f"[[ratio]] {key}", entry[key], searched, "a key that the search changes")
        yield Ratio(entry["of"], entry["to"], _bounds("[[ratio]] bounds", entry.get("bounds")))


def _runs(content: Table, name: str, seeds: Sequence[int]) -> Runs:
    """Return the runs of ``[screen]`` or ``[verify]``, whose options override ``[common]``."""
    label = f"calibration [{name}]"
    tables = [("calibration [common]", content.get("common", {})), (label, content.get(name, {}))]
    options: Table = {}
    for where, given in tables:
        plain = require_table(where, given)
        of_tests = {test: plain.pop(test) for test in TESTS if test in plain}
        options |= {**flat(where, plain), **of_tests}
    own = {test: flat(f"{label} {test}", options.pop(test)) for test in TESTS if test in options}
    chosen = _seeds(f"[{name}] seeds", options.pop("seeds", list(seeds)))
    discs = _seeds(f"[{name}] disc_seeds", options.pop("disc_seeds", chosen))
    for where, given in ((label, options), *((f"{label} {test}", own[test]) for test in own)):
        for key in given:
            if not interface.is_key(key.removeprefix("set.")):
                require_known(f"{where} key", key.replace("-", "_"), _OPTIONS)
    return Runs(options, chosen, discs, own)


def _seeds(label: str, given: object) -> list[int]:
    seeds = require_list(f"calibration {label}", given)
    _require(label, seeds, bool(seeds), "a list of seeds")
    return [require_seed(f"calibration {label}", seed) for seed in seeds]


def _bounds(label: str, bounds: object) -> tuple[float, float]:
    given = bounds if isinstance(bounds, list) else []
    _require(label, bounds, len(given) == 2, "two numbers")
    low, high = (require_number(f"calibration {label}", one, POSITIVE) for one in given)
    _require(label, bounds, low < high, "two numbers, the smaller first")
    return low, high


def _require(label: str, value: object, holds: bool, rule: str) -> None:
    if not holds:
        raise InputError(f"calibration {label} = {quoted(value)}, must be {rule}; correct it")
