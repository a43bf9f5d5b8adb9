# SPDX-License-Identifier: GPL-3.0-or-later
"""Trends of solids: the runs behind the page on them, which can be stopped and started again.

Groups of runs, each of five packings of 3 mm grains unless told otherwise:

    models    flexible, rigid and JCFpm, bilinear and brittle: compression, tension, splitting, and
              compression under 2 and 4 MPa, from which the friction angle follows
    ends      height over diameter 1 to 3 of a core, ends smooth and with friction 0.1
    middle    true triaxial: the larger side pressure from 4 to 40 MPa beside 4 MPa
    sizes     grains over the diameter of a core, 5 to 16, and one packing with 25

Adds one CSV row a run and passes over rows that are there. SI units. Start it from a checkout that
scripts/setup has built; the second command prints means and standard errors, the third draws them:

    export PYTHONPATH=build/python
    /usr/bin/python3 scripts/studies/solid_trends.py solid_trends.csv ends
    /usr/bin/python3 scripts/studies/solid_trends.py solid_trends.csv --table
    /usr/bin/python3 scripts/studies/solid_trends.py solid_trends.csv --picture a.png
"""

from __future__ import annotations

import argparse
import csv
import math
import statistics
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple, get_type_hints

from growing_table import add_row, rows_of
from matplotlib import rc_context
from matplotlib.figure import Figure

import flexpm
from flexpm.errors import SimulationError
from flexpm.report.style import STYLE, save

SEEDS = (1, 2, 3, 4, 5)
#: Five grains of 3 mm over the core.
DIAMETER = 0.015
#: Strengths of granite's solids for all models; brittle without the energies of fracture.
MATERIAL, SOFTENINGS = "augig3d-calibrated", ("bilinear", "brittle")
LEAST, MIDDLES = 4e6, (4e6, 7e6, 10e6, 14e6, 20e6, 40e6)
RATIOS, FRICTIONS = (1.0, 1.5, 2.0, 3.0), (0.0, 0.1)
ACROSS = (5, 8, 12, 16, 25)
#: Two and a half times that of the peak without pressure.
MAX_STRAIN = 0.012


class Run(NamedTuple):
    """What tells runs apart."""

    group: str
    model: str
    softening: str
    test: str
    confinement: float  #: [Pa]
    second: float  #: on front and back of a box [Pa]; that of the others without
    ratio: float  #: height over diameter, or over width [-]
    friction: float  #: of the ends [-]
    across: int  #: grains over the diameter
    seed: int


FIELDS = (
    *Run._fields,
    *("peak_stress", "youngs_modulus", "crack_initiation_stress"),
    *("grains", "steps", "largest_overlap", "status"),
)


def plan(group: str) -> Iterator[Run]:
    """All runs of a group, in their order."""
    for seed in SEEDS:
        if group == "models":
            yield from _models(seed)
        for model in ("flexible", "rigid"):
            own = Run(group, model, SOFTENINGS[0], "uniaxial", 0.0, 0.0, 2.0, 0.0, 5, seed)
            if group == "ends":
                for ratio in RATIOS:
                    for friction in FRICTIONS:
                        yield own._replace(ratio=ratio, friction=friction)
            if group == "middle":
                for second in MIDDLES:
                    yield own._replace(test="triaxial", confinement=LEAST, second=second)
            if group == "sizes":
                for across in ACROSS:
                    if across < ACROSS[-1] or seed == SEEDS[0]:  # as long as all others of a seed
                        yield own._replace(across=across)


def _models(seed: int) -> Iterator[Run]:
    for softening in SOFTENINGS:
        for model in ("flexible", "rigid", "jcfpm"):
            own = Run("models", model, softening, "uniaxial", 0.0, 0.0, 2.0, 0.0, 5, seed)
            yield own
            yield own._replace(test="tension")
            if model == "jcfpm":  # it has no triaxial test and no disc in space
                continue
            yield own._replace(test="brazilian")
            if softening == SOFTENINGS[0]:
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


def material_of(run: Run) -> flexpm.Material:
    """The granite, for a model."""
    granite = flexpm.materials.load(MATERIAL)
    return granite.with_set({"softening": run.softening}, run.model)


def row_of(run: Run) -> list[object]:
    """Do a run."""
    options: dict[str, Any] = {"max_strain": MAX_STRAIN, "stop_ratio": 0.9}
    if run.confinement:
        options["confinement"] = run.confinement
    if run.group == "middle":
        options["second_confinement"] = run.second
    if run.friction:
        options["end_friction"] = run.friction
    specimen = specimen_of(run)
    try:
        found = flexpm.run(run.test, specimen, material_of(run), run.model, **options)
    except SimulationError as error:  # a specimen that does not bear its pressures
        return [*run, None, None, None, len(specimen.radii), None, None, str(error)[:60]]
    return [
        *run,
        found.peak_stress,
        found.youngs_modulus,
        getattr(found, "crack_initiation_stress", None),
        len(specimen.radii),
        found.steps,
        found.largest_overlap,
        found.status,
    ]


def read(table: Path) -> dict[Run, dict[str, str]]:
    """Rows that are there."""
    kinds = get_type_hints(Run)
    return {Run(*(kinds[name](row[name]) for name in Run._fields)): row for row in rows_of(table)}


class Mean(NamedTuple):
    """What packings have in common."""

    of: float
    error: float  #: standard error


def mean_of(runs: list[dict[str, str]], name: str, unit: float) -> Mean:
    """Mean of what has a value."""
    values = [float(row[name]) / unit for row in runs if row[name]]
    if not values:
        return Mean(math.nan, math.nan)
    error = statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan
    return Mean(statistics.mean(values), error)


def sets_of(rows: dict[Run, dict[str, str]]) -> dict[Run, list[dict[str, str]]]:
    """Rows of the same case, by its run with the seed 0."""
    sets: dict[Run, list[dict[str, str]]] = {}
    for run, row in rows.items():
        sets.setdefault(run._replace(seed=0), []).append(row)
    return sets


def print_table(rows: dict[Run, dict[str, str]]) -> None:
    """Print means over the packings, their standard errors, and how many passed a peak."""
    writer = csv.writer(sys.stdout, lineterminator="\n")
    told = {"peak_stress": 1e6, "youngs_modulus": 1e9, "crack_initiation_stress": 1e6}
    names = (f"{name}{part}" for name in told for part in ("", "_error"))
    writer.writerow((*Run._fields[:-1], *names, "ok"))
    for run, of in sets_of(rows).items():
        means = (value for name, unit in told.items() for value in mean_of(of, name, unit))
        passed = sum(row["status"] == "ok" for row in of)
        cells = (f"{value:.2f}" for value in means)
        writer.writerow((*run[:-1], *cells, f"{passed} of {len(of)}"))


#: Title of a group's picture, its axis, the field along it and the factor to its unit.
PANELS = {
    "ends": ("compression", "height over diameter [-]", "ratio", 1.0),
    "middle": ("true triaxial, least pressure 4 MPa", "larger pressure [MPa]", "second", 1e-6),
    "sizes": ("compression", "grains over the diameter", "across", 1.0),
    "models": ("triaxial", "pressure [MPa]", "confinement", 1e-6),
}


def draw(rows: dict[Run, dict[str, str]], picture: Path) -> None:
    """Draw peaks of the groups over what they change, with standard errors."""
    groups = [group for group in PANELS if any(run.group == group for run in rows)]
    figure = Figure(figsize=(4.0 * len(groups), 3.2), layout="constrained")
    for axes, group in zip(figure.subplots(1, len(groups), squeeze=False)[0], groups, strict=True):
        title, label, field, factor = PANELS[group]
        lines: dict[str, list[tuple[float, Mean]]] = {}
        for run, of in sets_of(rows).items():
            if run.group != group or run.test not in ("uniaxial", "triaxial"):
                continue
            if group == "models" and (run.model == "jcfpm" or run.softening != SOFTENINGS[0]):
                continue
            name = run.model + (f", ends with friction {run.friction:g}" if run.friction else "")
            point = factor * getattr(run, field), mean_of(of, "peak_stress", 1e6)
            lines.setdefault(name, []).append(point)
        for name, points in lines.items():
            points.sort()
            x, means = zip(*points, strict=True)
            errors = [mean.error if mean.error > 0.0 else 0.0 for mean in means]  # of one: none
            axes.errorbar(x, [mean.of for mean in means], errors, marker="o", capsize=3, label=name)
        axes.set(title=title, xlabel=label, ylabel="largest stress [MPa]", ylim=(0.0, None))
        axes.legend(frameon=False)
    save(figure, picture)


def main() -> None:
    """Do the runs of groups, or print what they have found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("groups", nargs="*", help="models, ends, middle, sizes")
    parser.add_argument("--table", action="store_true", dest="show", help="print the means")
    parser.add_argument("--picture", type=Path, help="draw the means into this file")
    options = parser.parse_args()
    rows = read(options.table)
    if options.show:
        print_table(rows)
    if options.picture:
        with rc_context(STYLE):
            draw(rows, options.picture)
    for run in (run for group in options.groups for run in plan(group)):
        if run in rows:
            continue
        add_row(options.table, FIELDS, row_of(run))


if __name__ == "__main__":
    main()
