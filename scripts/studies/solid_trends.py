# SPDX-License-Identifier: GPL-3.0-or-later
"""Trends of solids: the runs behind the page on them, which can be stopped and started again.

Groups of runs, each of five packings of 3 mm grains unless told otherwise:

    models    flexible, rigid and JCFpm, bilinear and brittle: compression, tension, splitting, and
              compression under 2 and 4 MPa, from which the friction angle follows
    ends      height over diameter 1 to 3 of a core, ends smooth and with friction 0.5
    middle    true triaxial: the larger side pressure from 4 to 40 MPa beside 4 MPa
    sizes     grains over the diameter of a core, 5 to 16

Adds one CSV row a run and passes over rows that are there. SI units. Start it from a checkout that
scripts/setup has built; the second command prints means and standard errors:

    export PYTHONPATH=build/python
    /usr/bin/python3 scripts/studies/solid_trends.py scripts/studies/solid_trends.csv ends
    /usr/bin/python3 scripts/studies/solid_trends.py scripts/studies/solid_trends.csv --table
"""

from __future__ import annotations

import argparse
import csv
import math
import statistics
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import flexpm
from flexpm.errors import SimulationError

SEEDS = (1, 2, 3, 4, 5)
#: Five grains of 3 mm over the core.
DIAMETER = 0.015
#: Strengths of Table 2, bilinear and in the brittle limit, for all models.
MATERIALS = ("augig-table2-bilinear", "augig-table2-brittle")
LEAST, MIDDLES = 4e6, (4e6, 10e6, 20e6, 40e6)
RATIOS, FRICTIONS = (1.0, 1.5, 2.0, 3.0), (0.0, 0.5)
ACROSS = (5, 8, 12, 16)


class Run(NamedTuple):
    """What tells runs apart."""

    group: str
    model: str
    material: str
    test: str
    confinement: float  #: [Pa]
    second: float  #: on front and back of a box [Pa]; that of the others without
    ratio: float  #: height over diameter, or over width [-]
    friction: float  #: of the ends [-]
    across: int  #: grains over the diameter
    seed: int


FIELDS = (
    *Run._fields,
    *("peak_stress", "youngs_modulus", "crack_initiation_stress", "crack_damage_stress"),
    *("grains", "steps", "largest_overlap", "status"),
)


def plan(group: str) -> Iterator[Run]:
    """All runs of a group, in their order."""
    for seed in SEEDS:
        if group == "models":
            yield from _models(seed)
        for model in ("flexible", "rigid"):
            own = Run(group, model, MATERIALS[0], "uniaxial", 0.0, 0.0, 2.0, 0.0, 5, seed)
            if group == "ends":
                for ratio in RATIOS:
                    for friction in FRICTIONS:
                        yield own._replace(ratio=ratio, friction=friction)
            if group == "middle":
                for second in MIDDLES:
                    yield own._replace(test="triaxial", confinement=LEAST, second=second)
            if group == "sizes":
                for across in ACROSS:
                    yield own._replace(across=across)


def _models(seed: int) -> Iterator[Run]:
    for material in MATERIALS:
        for model in ("flexible", "rigid", "jcfpm"):
            own = Run("models", model, material, "uniaxial", 0.0, 0.0, 2.0, 0.0, 5, seed)
            yield own
            yield own._replace(test="tension")
            if model == "jcfpm":  # it has no triaxial test and no disc in space
                continue
            yield own._replace(test="brazilian")
            if material == MATERIALS[0]:
                for pressure in (2e6, 4e6):
                    yield own._replace(test="triaxial", confinement=pressure, second=pressure)


def specimen_of(run: Run) -> Any:
    """Pack the solid of a run."""
    diameter = DIAMETER * run.across / 5.0
    if run.test == "brazilian":
        return flexpm.Specimen.solid_disc(2.0 * DIAMETER, DIAMETER, seed=run.seed)
    if run.group == "middle":
        return flexpm.Specimen.box(diameter, diameter, run.ratio * diameter, seed=run.seed)
    return flexpm.Specimen.cylinder(diameter, run.ratio * diameter, seed=run.seed)


def row_of(run: Run) -> list[object]:
    """Do a run."""
    options: dict[str, Any] = {"confinement": run.confinement} if run.confinement else {}
    if run.group == "middle":
        options["second_confinement"] = run.second
    if run.friction:
        options["end_friction"] = run.friction
    specimen = specimen_of(run)
    try:
        found = flexpm.run(run.test, specimen, run.material, run.model, **options)
    except SimulationError as error:  # a specimen that does not bear its pressures
        return [*run, None, None, None, None, len(specimen.radii), None, None, str(error)[:60]]
    return [
        *run,
        found.peak_stress,
        found.youngs_modulus,
        getattr(found, "crack_initiation_stress", None),
        getattr(found, "crack_damage_stress", None),
        len(specimen.radii),
        found.steps,
        found.largest_overlap,
        found.status,
    ]


def read(table: Path) -> dict[Run, dict[str, str]]:
    """Rows that are there."""
    if not table.exists():
        return {}
    with table.open(encoding="utf-8", newline="") as file:
        rows = [*csv.DictReader(file)]
    kinds = Run.__annotations__
    numbers = {"float": float, "int": int, "str": str}
    return {Run(*(numbers[kinds[name]](row[name]) for name in Run._fields)): row for row in rows}


def print_table(rows: dict[Run, dict[str, str]]) -> None:
    """Print means over the packings, their standard errors, and how many passed a peak."""
    sets: dict[tuple[object, ...], list[Run]] = {}
    for run in rows:
        sets.setdefault(run[:-1], []).append(run)
    writer = csv.writer(sys.stdout, lineterminator="\n")
    told = ("peak_stress", "crack_initiation_stress")
    writer.writerow(
        (*Run._fields[:-1], *(f"{name}{part}" for name in told for part in ("", "_error")), "ok")
    )
    for key, runs in sets.items():
        cells: list[str] = []
        for name in told:
            values = [float(rows[run][name]) / 1e6 for run in runs if rows[run][name]]
            mean = statistics.mean(values) if values else math.nan
            error = (
                statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan
            )
            cells += [f"{mean:.2f}", f"{error:.2f}"]
        passed = sum(rows[run]["status"] == "ok" for run in runs)
        writer.writerow((*key, *cells, f"{passed} of {len(runs)}"))


def main() -> None:
    """Do the runs of groups, or print what they have found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("groups", nargs="*", help="models, ends, middle, sizes")
    parser.add_argument("--table", action="store_true", dest="show", help="print the means")
    options = parser.parse_args()
    rows = read(options.table)
    if options.show:
        print_table(rows)
        return
    for run in (run for group in options.groups for run in plan(group)):
        if run in rows:
            continue
        row = row_of(run)
        new = not options.table.exists()
        with options.table.open("a", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            if new:
                writer.writerow(FIELDS)
            writer.writerow(row)


if __name__ == "__main__":
    main()
