# SPDX-License-Identifier: GPL-3.0-or-later
"""Halve the loading rate of solids: the study behind the rates of box and cylinder.

Runs each test on small packings, a box and a cylinder of the same section, at falling factors on
the rate. Adds one CSV row a run and passes over rows that are there. SI units. Start it from a
checkout that scripts/setup has built; the second command prints means and their changes:

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/solid_rates.py rates.csv tension
    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/solid_rates.py rates.csv --table
"""

from __future__ import annotations

import argparse
import csv
import statistics
import sys
from itertools import product
from pathlib import Path
from typing import NamedTuple

from growing_table import add_row

import flexpm
from flexpm.results import measures

SHAPES = ("box", "cylinder")
#: Five grains of 3 mm across; the sections of both are the same.
HEIGHT, DIAMETER, WIDTH = 0.03, 0.015, 0.0133
SEEDS = (1, 2, 3, 4, 5)
RATES = (4.0, 2.0, 1.0, 0.5, 0.25)


class Run(NamedTuple):
    """What tells runs apart."""

    test: str
    shape: str
    model: str
    material: str
    rate: float  #: factor on the rate of the test [-]
    seed: int


FIELDS = (
    *Run._fields,
    *("peak_stress", "youngs_modulus", "steps", "overlap", "error", "under_way", "status"),
)


def row_of(run: Run) -> list[object]:
    """Do a run."""
    made = (
        flexpm.Specimen.box(WIDTH, WIDTH, HEIGHT, seed=run.seed)
        if run.shape == "box"
        else flexpm.Specimen.cylinder(DIAMETER, HEIGHT, seed=run.seed)
    )
    found = flexpm.run(run.test, made, run.material, run.model, rate=run.rate)
    return [
        *run,
        found.peak_stress,
        found.youngs_modulus,
        found.steps,
        found.largest_overlap,
        found.energy_error,
        measures.unbalanced_under_way(found.curve),
        found.status,
    ]


def read(table: Path) -> dict[Run, list[str]]:
    """Rows that are there."""
    if not table.exists():
        return {}
    with table.open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    return {Run(*row[:4], float(row[4]), int(row[5])): row for row in rows}


def print_table(rows: dict[Run, list[str]]) -> None:
    """Peaks of each test, shape, model and rate, their mean, and its change from twice the rate."""
    sets: dict[tuple[str, ...], dict[float, list[Run]]] = {}
    for run in sorted(rows, key=lambda run: (run[:4], -run.rate, run.seed)):
        sets.setdefault(run[:4], {}).setdefault(run.rate, []).append(run)
    writer = csv.writer(sys.stdout, lineterminator="\n")
    names = ("rate", "peaks", "mean", "change", "steps", "overlap", "under_way", "ok")
    writer.writerow((*Run._fields[:4], *names))
    for key, rates in sets.items():
        before: dict[int, float] = {}
        for rate, runs in rates.items():
            peaks = {run.seed: float(rows[run][6]) / 1e6 for run in runs}
            both = [seed for seed in peaks if seed in before]
            change = (
                statistics.mean(peaks[s] for s in both) / statistics.mean(before[s] for s in both)
                - 1.0
                if both
                else float("nan")
            )
            writer.writerow(
                (
                    *key,
                    rate,
                    ", ".join(f"{peak:.2f}" for peak in peaks.values()),
                    f"{statistics.mean(peaks.values()):.2f}",
                    f"{100.0 * change:.2f} %",
                    round(statistics.median(int(rows[run][8]) for run in runs)),
                    f"{100.0 * max(float(rows[run][9]) for run in runs):.1f} %",
                    f"{max(float(rows[run][11]) for run in runs):.4f}",
                    sum(rows[run][-1] == "ok" for run in runs),
                )
            )
            before = peaks


def main() -> None:
    """Do the runs, or print what they have found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("tests", nargs="*", help="uniaxial, tension")
    parser.add_argument("--table", action="store_true", dest="show", help="print the means")
    parser.add_argument("--shapes", nargs="+", default=SHAPES)
    parser.add_argument("--models", nargs="+", default=["flexible", "rigid"])
    parser.add_argument("--material", default="augig-table7")
    parser.add_argument("--rates", type=float, nargs="+", default=RATES)
    options = parser.parse_args()
    rows = read(options.table)
    if options.show:
        print_table(rows)
        return
    named = (options.tests, options.shapes, options.models, [options.material])
    cases = product(*named, options.rates, SEEDS)
    for run in (Run(*case) for case in cases):
        if run in rows:
            continue
        add_row(options.table, FIELDS, row_of(run))


if __name__ == "__main__":
    main()
