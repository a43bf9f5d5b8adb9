# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of a rock that a calibration can aim at, and the runs that tell them. SI units, degrees.

A run is named by its test and its confining pressure [Pa].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..dimensions import is_solid
from ..errors import InputError
from ..files import Table
from ..kinds.registry import ELASTIC, KINDS, TESTS, names
from ..kinds.test_kind import TestKind
from ..results import strength

#: Test and confining pressure [Pa].
Run = tuple[str, float]

#: Measures of the elastic solution.
ELASTIC_MEASURES = tuple(KINDS[ELASTIC].calibrates)
#: Measures of one test: the test and its key of result.json, or the two keys of a quotient.
_TOLD = {
    name: (test, keys)
    for test in (ELASTIC, *TESTS)
    for name, keys in KINDS[test].calibrates.items()
}
#: Quotients of two of them.
QUOTIENTS = {"direct_indirect_ratio": ("direct_tensile_strength", "indirect_tensile_strength")}
#: Measures of runs at several confining pressures.
_OF_ENVELOPE = ("cohesion", "friction_angle", "hoek_brown_strength", "hoek_brown_m")
#: Measures of one run at a confining pressure: their tables in a file, and keys of result.json.
AT_PRESSURE = {"peaks": "peak", "drops": "drop"}
_KEYS_AT_PRESSURE = {"peak": "peak_stress", "drop": "drop_after_peak"}
#: Measures of which a rock has the least value; runs go on past their peaks for them.
_LEAST = ("drop",)
#: All measures that have one value.
MEASURES = (*_TOLD, *QUOTIENTS, *_OF_ENVELOPE)
_AT = "_at_"


def name_at(measure: str, pressure: float) -> str:
    """Name of a measure at a confining pressure [Pa], such as ``peak_at_10_MPa``."""
    return f"{measure}{_AT}{1e-6 * pressure:g}_MPa"


def without_pressure(name: str) -> str:
    """Name of a measure without the confining pressure."""
    return name.partition(_AT)[0]


def is_stress(name: str) -> bool:
    """Whether a measure is a stress, unless its key of result.json says otherwise."""
    return without_pressure(name) in (*MEASURES, *_KEYS_AT_PRESSURE) and len(keys_of(name)) == 1


def is_least(name: str) -> bool:
    """Whether the target of a measure is its least value, which any larger value meets."""
    return without_pressure(name) in _LEAST


def keys_of(name: str) -> tuple[str, ...]:
    """Keys of result.json of a measure of one test; else the name of the measure."""
    keys = _TOLD[name][1] if name in _TOLD else _KEYS_AT_PRESSURE.get(without_pressure(name), name)
    return (keys,) if isinstance(keys, str) else keys


def tests_of(name: str) -> tuple[str, ...]:
    """Tests that a measure needs; none for measures of runs at confining pressures."""
    return tuple(_TOLD[one][0] for one in QUOTIENTS.get(name, (name,)) if one in _TOLD)


def runs_of(
    name: str, confinements: Sequence[float], *, pressure: float | None, solid: bool
) -> list[Run]:
    """Runs that a measure needs.

    Args:
        name: Name of the measure.
        confinements: Confining pressures of an envelope [Pa].
        pressure: Confining pressure of the measure [Pa]; None for measures without.
        solid: Whether the specimens are 3D.
    """
    if pressure is None and name not in _OF_ENVELOPE:
        return [(test, 0.0) for test in tests_of(name)]
    pressures = confinements if pressure is None else [pressure]
    return [(_test_under(one, solid=solid), one) for one in pressures]


def _test_under(pressure: float, *, solid: bool) -> str:
    """The test of a strength envelope under a confining pressure [Pa]."""

    def fits(kind: TestKind) -> bool:
        return kind.envelope and (bool(kind.solids) if solid else not is_solid(kind.shape))

    return next(test for test in names(fits) if KINDS[test].confined == bool(pressure))


def entries(name: str, runs: Sequence[Run]) -> list[tuple[Run, str]]:
    """Return the run and the key of result.json of each number that a measure needs."""
    parts = QUOTIENTS.get(name, (name,))
    if all(part in _TOLD for part in parts):
        return [((_TOLD[one][0], 0.0), key) for one in parts for key in keys_of(one)]
    key = _KEYS_AT_PRESSURE.get(without_pressure(name), "peak_stress")
    return [(run, key) for run in runs]


def measured(name: str, runs: Sequence[Run], found: Mapping[Run, Table]) -> float | None:
    """Return a measure of a packing; None if a number is missing.

    Args:
        name: Name of the measure.
        runs: Runs that it needs, as of `runs_of`.
        found: Results of the packing by their run.
    """
    values = [found[run].get(key) for run, key in entries(name, runs)]
    known: list[float] = [value for value in values if value is not None]
    if len(known) < len(values):
        return None
    if name in _OF_ENVELOPE:
        try:
            return of_envelope(name, [pressure for _, pressure in runs], known)
        except InputError:  # the peaks follow no criterion
            return None
    if len(known) == 1:
        return known[0]
    return strength.tensile_ratio(*known) if name in QUOTIENTS else known[0] / known[1]


def of_envelope(name: str, confinements: Sequence[float], peaks: Sequence[float]) -> float:
    """Return a constant of a strength envelope.

    Args:
        name: ``cohesion`` or ``hoek_brown_strength`` [Pa], ``friction_angle`` [degrees] or
            ``hoek_brown_m`` [-].
        confinements: Confining pressures [Pa].
        peaks: Axial stress at the peak under each pressure [Pa].

    Raises:
        InputError: if the peaks follow no criterion.
    """
    if name.startswith("hoek_brown"):
        fitted = strength.hoek_brown(confinements, peaks)
        return fitted.m_i if name == "hoek_brown_m" else fitted.sigma_ci
    line = strength.mohr_coulomb(confinements, peaks)
    return line.cohesion if name == "cohesion" else line.friction_angle
