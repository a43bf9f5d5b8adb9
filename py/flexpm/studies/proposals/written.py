# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibration files for a rock: targets, free keys, bounds, specimens and a start. SI units."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...dimensions import is_solid
from ...errors import InputError
from ...files import Table, write_text
from ...kinds.option import JAW_RADIUS
from ...kinds.registry import ELASTIC, KINDS
from ...materials.keys import ELASTIC_KEYS
from ...materials.made_for import dimension_of
from ...require import quoted, require_known
from .. import calibration_problem
from ..calibration_measures import runs_of, without_pressure
from ..calibration_problem import Calibration
from ..calibration_report import content_of, toml_text
from ..calibration_search import ELASTIC_FITS, jobs_of, started
from ..scorecards import rock as rocks
from ..scorecards.exponents import Exponents
from ..scorecards.runs import JAWS, SHAPES, SIZES, grains_of
from . import aims as targets
from . import beginning
from .aims import Aims, rounded
from .beginning import Start

_MODELS = ("flexible", "rigid")
#: Keys of the search that a target frees: the first one that no other target has freed.
_FREED = {
    "compressive_strength": ("cohesion",),
    "indirect_tensile_strength": ("tensile_strength", "tensile_fracture_energy"),
    "direct_tensile_strength": ("tensile_strength", "tensile_fracture_energy"),
    "direct_indirect_ratio": ("tensile_fracture_energy", "tensile_strength"),
    targets.TOUGHNESS: ("tensile_fracture_energy",),
    "cohesion": ("cohesion", "shear_fracture_energy"),
    "friction_angle": ("friction",),
    "hoek_brown_m": ("friction", "shear_fracture_energy"),
    "peak": ("friction", "shear_fracture_energy"),
    "drop": ("shear_fracture_energy", "friction"),
    "crack_initiation": ("weibull",),
}
#: Exponent from which a key is freed for a target [-].
_CLEAR = 0.15
#: Targets that the share of the contacts in the compliance moves.
_OF_COMPLIANCE = ("crack_initiation", "crack_damage")
#: Bounds of free keys over their start, and the limits that they stay within.
_FACTORS = {
    **dict.fromkeys(("tensile_strength", "cohesion"), 3.0),
    **dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 6.0),
    **dict.fromkeys(("friction", "normal_stiffness", "weibull"), 4.0),
    **dict.fromkeys(("young", "shear_ratio"), 2.5),
    "poisson": 2.0,
}
_LIMITS = {
    "friction": (0.02, 2.0),
    "shear_ratio": (0.03, 0.95),
    "poisson": (0.02, 0.45),
    "weibull": (2.0, 100.0),
}
#: Bounds of cohesion over tensile strength, over their quotient at the start.
_RATIO = (0.4, 2.5)
#: Sets of a search: so many, and so many more for each key.
_SETS, _SETS_OF_KEY = 10, 4
_ROUNDS, _CANDIDATES, _STOP_RATIO = 2, 1, 0.9
_SCREENED, _VERIFIED = (1, 2), tuple(range(11, 17))
#: Discs scatter more, and take less time.
_DISCS = tuple(range(11, 23))


@dataclass(frozen=True)
class Cost:
    """Most runs of a calibration."""

    small: int  #: of the search
    full: int  #: of the verification
    solves: int  #: of the elastic solution
    grains: tuple[int, int]  #: of the largest small and full specimens


@dataclass(frozen=True)
class Proposal:
    """A calibration that was written for a rock.

    Attributes:
        plan: The calibration, as its file is read.
        aims: Targets and measures that are none.
        start: Material from which it begins.
        cost: Most runs.
        modulus_known: Whether the rock file has Young's modulus.
        files: The file of the calibration, and that of the start.
        keyless: Targets that free no key: keys of other targets move them.
    """

    plan: Calibration
    aims: Aims
    start: Start
    cost: Cost
    modulus_known: bool
    files: tuple[Path, Path]
    keyless: tuple[str, ...]


def write(
    rock: Path | str, file: Path, model: str = "flexible", shape: str = "rectangle"
) -> Proposal:
    """Write the calibration of a rock and the material from which it begins.

    Args:
        rock: Name of a rock of the scorecards, or rock file.
        file: File of the calibration, which must not exist. The start is written beside it.
        model: ``flexible`` or ``rigid``.
        shape: Shape of the compressed specimens.

    Raises:
        InputError: for an unknown rock, model or shape, a rock on which no measure decides, or a
            file that exists.
    """
    require_known("calibrate: model", model, _MODELS)
    require_known("calibrate: shape", shape, SHAPES)
    first = file.with_name(f"{file.stem}-start.toml")
    if file.suffix != ".toml":
        raise InputError(f"calibrate: out = {quoted(str(file))}, must end in .toml; add it")
    for one in (file, first):
        if one.exists():
            raise InputError(f"calibrate: out = {quoted(str(one))}, exists; give another name")
    found = rocks.load(rock, "")
    aims = targets.of_rock(found)
    if not aims.found:
        raise InputError(
            f"rock {quoted(found.name)} has no measure that decides; set decides = true for the "
            "measures that the material should meet"
        )
    source = beginning.origin(dimension_of(solid=is_solid(shape)), model)
    known_keys = beginning.similar(source.material, model, 1, 1)
    elastic, searched, keyless = _free(aims, model, source.exponents, known_keys)
    start = beginning.start(source, model, found, aims.found, searched)
    bounds = {key: _bounds(key, start.values[key]) for key in (*elastic, *searched)}
    start.values.update(
        {k: rounded(min(max(start.values[k], a), b)) for k, (a, b) in bounds.items()}
    )
    content = _text(found.name, file.stem, first.name, model, shape, aims, elastic, bounds, start)
    file.parent.mkdir(parents=True, exist_ok=True)
    try:
        write_text(first, _material(f"{file.stem}-start", model, start))
        write_text(file, content)
        plan = calibration_problem.read(file)
    except InputError as error:  # of targets without keys, for example
        for one in (first, file):
            one.unlink(missing_ok=True)
        raise InputError(f"rock {quoted(found.name)}: {error}") from None
    young = found.entries.get("youngs_modulus")
    known = young is not None and young.value is not None
    return Proposal(plan, aims, start, cost(plan, start.values), known, (file, first), keyless)


def _free(
    aims: Aims, model: str, known: Exponents | None, keys: Container[str]
) -> tuple[list[str], list[str], tuple[str, ...]]:
    """Return the keys of the elastic targets, those of the search, and targets that free no key.

    Args:
        aims: The targets.
        model: Name of the model.
        known: Exponents about the start, which has stiff grains, so that contacts determine the
            modulus; None: a usual material.
        keys: Keys of the material.
    """
    names = [without_pressure(one.target.name) for one in aims.found]
    of_contacts = known is not None or model == "rigid"
    fitted = dict(
        zip(
            ("youngs_modulus", "poissons_ratio"),
            ("normal_stiffness", "shear_ratio") if of_contacts else ("young", "poisson"),
            strict=True,
        )
    )
    elastic = [key for name, key in fitted.items() if name in names]
    searched: list[str] = []
    keyless: list[str] = []
    for one, name in zip(aims.found, names, strict=True):
        if name in fitted:
            continue
        able = (key for key in _freed(name, one.measure, known) if key in keys)
        free = next((key for key in able if key not in searched), None)
        if free is None:
            keyless.append(one.target.name)
        else:
            searched.append(free)
    moved = [name for name in _OF_COMPLIANCE if name in names]
    # the modulus stays while its share of the contacts moves
    if moved and elastic and keyless and model == "flexible":
        searched.append("young" if of_contacts else "normal_stiffness")
        keyless = [name for name in keyless if name != moved[0]]
    return elastic, searched, tuple(keyless)


def _freed(name: str, measure: str, known: Exponents | None) -> Sequence[str]:
    """Return the keys that a target may free, the one that moves it most first."""
    usual = _FREED.get(name, ())
    of = {} if known is None else known.of.get(measure, {})
    searched = {key for keys in _FREED.values() for key in keys}
    clear = {key: abs(one.clear) for key, one in of.items() if key in searched}
    strong = sorted((key for key in clear if clear[key] >= _CLEAR), key=lambda key: -clear[key])
    return strong or usual


def _bounds(key: str, value: float) -> tuple[float, float]:
    low, high = _LIMITS.get(key, (0.0, float("inf")))
    factor = _FACTORS[key]
    return rounded(max(value / factor, low)), rounded(min(value * factor, high))


def _text(
    rock: str,
    name: str,
    material: str,
    model: str,
    shape: str,
    aims: Aims,
    elastic: Sequence[str],
    bounds: Mapping[str, tuple[float, float]],
    start: Start,
) -> str:
    """Return the file of the calibration."""
    searched = [key for key in bounds if key not in elastic]
    about: Table = {
        **{"name": name, "model": model, "material": material},
        **({"tied": [*elastic]} if any(key in ELASTIC_KEYS for key in searched) else {}),
        "evaluations": _SETS + _SETS_OF_KEY * len(searched),
        **{"rounds": _ROUNDS, "candidates": _CANDIDATES},
        **({"confinements": [*aims.confinements]} if aims.confinements else {}),
    }
    tests = _tests(aims, shape)
    tables: Table = {
        "calibration": about,
        "common": {"stop_ratio": _STOP_RATIO},
        "screen": {"seeds": [*_SCREENED], **_sizes("small", shape, tests)},
        "verify": {
            **{"seeds": [*_VERIFIED], "disc_seeds": [*_DISCS]},
            **_sizes("full", shape, tests),
        },
        "target": _targets(aims),
        "free": {key: [*ends] for key, ends in bounds.items()},
    }
    pair = ("cohesion", "tensile_strength")
    if all(key in searched for key in pair):
        quotient = start.values[pair[0]] / start.values[pair[1]]
        ends = [rounded(quotient * one) for one in _RATIO]
        tables["ratio"] = [{"of": pair[0], "to": pair[1], "bounds": ends}]
    head = (
        "# SPDX-License-Identifier: GPL-3.0-or-later\n"
        f"# Calibration of {' '.join(rock.split())}, written by flexpm calibrate --new. SI units, "
        "degrees.\n"
    )
    return head + toml_text(tables)


def _targets(aims: Aims) -> Table:
    """Tables of the targets; those at confining pressures are by pressure."""
    found: Table = {}
    for one in aims.found:
        target = one.target
        entry = {"value": target.value, "tolerance": target.tolerance}
        if target.pressure is None:
            found[target.name] = entry
        else:
            found.setdefault(f"{target.name}s", {})[f"{target.pressure:.6g}"] = entry
    return found


def _tests(aims: Aims, shape: str) -> list[str]:
    """Return the tests that the targets need."""
    tests: dict[str, None] = {}
    for one in aims.found:
        target = one.target
        pressure, solid = target.pressure, is_solid(shape)
        for test, _ in runs_of(target.name, aims.confinements, pressure=pressure, solid=solid):
            tests[test] = None
    return [*tests]


def _sizes(size: str, shape: str, tests: Sequence[str]) -> Table:
    """Return rate and sizes, with a table for each test on specimens of another shape."""
    chosen, solid = SIZES[size], is_solid(shape)
    rate = {} if chosen.rate == 1.0 else {"rate": chosen.rate}
    found: Table = {**rate, **({"shape": shape} if solid else {}), **chosen.sizes[shape]}
    for test in tests:
        kind = KINDS[test]
        if test == ELASTIC or shape in kind.variants:
            continue
        own = next(one for one in kind.shapes if is_solid(one) == solid)
        found[test] = {**({"shape": own} if solid else {}), **chosen.sizes[own]}
        if solid and kind.splits:
            found[test][JAW_RADIUS] = rounded(0.5 * JAWS * chosen.sizes[own]["diameter"])
    return found


def _material(name: str, model: str, start: Start) -> str:
    """Return the file of the material from which the search begins."""
    source = start.origin.material
    values = [f"{key}={value!r}" for key, value in start.values.items()]
    material = replace(source.with_set(values, model), name=name, made_for=None)
    note = f"# Start of a calibration, from {source.name}."
    head = f"# SPDX-License-Identifier: GPL-3.0-or-later\n{note}\n"
    return head + toml_text(content_of(material, model))


def cost(plan: Calibration, values: Mapping[str, object]) -> Cost:
    """Return the most runs of a calibration.

    Args:
        plan: The calibration.
        values: Values from which the search starts.
    """
    first = {key: started(plan, key, values) for key in plan.free}
    small, full = (
        [*jobs_of(plan, runs, first, plan.targets).values()] for runs in (plan.screen, plan.verify)
    )
    sets = (plan.rounds * (1 + plan.evaluations), plan.rounds * plan.candidates)
    solved = [sum(job.inputs["test"] == ELASTIC for job in jobs) for jobs in (small, full)]
    tied = ELASTIC_FITS * (1 + len(plan.tied)) if plan.tied else 0
    fitted = ELASTIC_FITS * (1 + len(plan.of_kind(elastic=True)[1]))
    solves = fitted * solved[1] + sum(
        number * solves * (tied or 1) for number, solves in zip(sets, solved, strict=True)
    )
    runs = [
        number * (len(jobs) - solves)
        for number, jobs, solves in zip(sets, (small, full), solved, strict=True)
    ]
    grains = max(map(grains_of, small)), max(map(grains_of, full))
    return Cost(runs[0], runs[1], solves, grains)


def lines(made: Proposal) -> Iterator[str]:
    """Yield the report of a calibration that was written, for a terminal."""
    plan, start, cost = made.plan, made.start, made.cost
    source = start.origin
    yield f"  targets  {', '.join(target.name for target in plan.targets)}"
    if made.aims.left_out:
        yield f"  decide, but are no targets  {', '.join(made.aims.left_out)}"
    yield f"  free     {', '.join(plan.free)}"
    if made.keyless:
        yield f"  targets that free no key  {', '.join(made.keyless)}"
    k, e = start.factors
    similar = f"strengths times {k:.3g}, moduli times {e:.3g}, energies times {k * k / e:.3g}"
    yield f"  start    {source.material.name}: {similar}"
    if not made.modulus_known:
        yield "  the rock file has no youngs_modulus: moduli are those of this material"
    if source.exponents is None:
        yield "  exponents of the measures were not measured for this model in this dimension"
    else:
        shown = ", ".join(f"{key} times {one:.3g}" for key, one in start.steps.items())
        yield f"  by exponents  {shown or 'no change'}"
        free = [key for key in plan.free if key not in plan.of_kind(elastic=True)[1]]
        left_out = beginning.without_exponents(source.exponents, made.aims.found, free)
        if left_out:
            yield f"  without exponents  {', '.join(left_out)}"
        step = source.exponents.step
        beyond = [key for key, one in start.steps.items() if not 1 - step <= one <= 1 + step]
        if beyond:
            yield (
                f"  outside the range of the exponents, +-{100.0 * step:g} %: {', '.join(beyond)}"
            )
    yield (
        f"  at most  {cost.small} runs of up to {cost.grains[0]} grains and {cost.full} of up to "
        f"{cost.grains[1]} grains; about {cost.solves} elastic solves"
    )
    yield f"  files    {', '.join(map(str, made.files))}"
