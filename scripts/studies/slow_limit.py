# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare ways of loading with the limit of slow loading, on the same packings.

Runs each test on several packings: at two slow constant rates, from which a straight line over the
rate gives the limit, and with each way of loading at some factors on its rate. Adds one CSV row a
run and passes over rows that are there. SI units. Start it from a checkout that scripts/setup has
built; the second command prints the table of the documentation:

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/slow_limit.py limit.csv uniaxial
    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/slow_limit.py limit.csv --table
"""

from __future__ import annotations

import argparse
import csv
import statistics
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import flexpm
from flexpm.results import measures

TESTS = ("uniaxial", "tension", "biaxial", "brazilian")
#: Confinement of biaxial tests [Pa].
CONFINEMENT = 4e6
#: Factors on the constant rate, the slow ones; that of confined flexible grains is slow already.
SLOW = {("biaxial", "flexible"): (1.0, 0.5)}
SLOW_OTHERS = (0.5, 0.25)
#: Ways of loading and factors on their rates.
WAYS = (("adaptive", 1.0), ("waiting", 0.5), ("waiting", 1.0), ("waiting", 2.0))


class Run(NamedTuple):
    """What tells runs apart."""

    test: str
    model: str
    scale: float  #: lengths over the paper's [-]
    seed: int
    loading: str
    rate: float  #: factor on the rate of this way of loading [-]


FIELDS = (*Run._fields, "peak_stress", "unbalanced_median", "steps", "status")


def runs_of(test: str, model: str, scale: float, seeds: list[int]) -> Iterator[Run]:
    """All runs of a test."""
    slow = [("constant", rate) for rate in SLOW.get((test, model), SLOW_OTHERS)]
    for seed in seeds:
        for loading, rate in (*WAYS, *slow):
            yield Run(test, model, scale, seed, loading, rate)


def done(run: Run) -> list[object]:
    """Row of a run."""
    if run.test == "brazilian":
        specimen = flexpm.Specimen.disc(0.08 * run.scale, 0.08, seed=run.seed)
    else:
        width = 0.08 * run.scale
        specimen = flexpm.Specimen.rectangle(width, 2.0 * width, 0.08, seed=run.seed)
    result = flexpm.run(
        run.test,
        specimen,
        model=run.model,
        confinement=CONFINEMENT if run.test == "biaxial" else 0.0,
        loading=run.loading,
        rate=run.rate,
    )
    ratio = measures.median_unbalanced_ratio(result.curve)
    return [*run, result.peak_stress, ratio, result.steps, result.status]


def read(table: Path) -> dict[Run, dict[str, str]]:
    """Rows of a table."""
    if not table.exists():
        return {}
    with table.open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {
        Run(
            row["test"],
            row["model"],
            float(row["scale"]),
            int(row["seed"]),
            row["loading"],
            float(row["rate"]),
        ): row
        for row in rows
    }


def limits(rows: dict[Run, dict[str, str]]) -> dict[tuple[str, str, float, int], float]:
    """Peak at a rate of zero of each packing [Pa]: the line through the two slow rates."""
    slow: dict[tuple[str, str, float, int], list[tuple[float, float]]] = defaultdict(list)
    for run, row in rows.items():
        if run.loading == "constant":
            slow[run[:4]].append((run.rate, float(row["peak_stress"])))
    found = {}
    for packing, pairs in slow.items():
        if len(pairs) == 2:
            (r1, p1), (r2, p2) = sorted(pairs)
            found[packing] = p1 - r1 * (p2 - p1) / (r2 - r1)
    return found


def print_table(rows: dict[Run, dict[str, str]]) -> None:
    """Print means of differences to the limit with their standard errors, steps and ratios."""
    limit = limits(rows)
    groups: dict[tuple[str, ...], list[tuple[float, float, float]]] = defaultdict(list)
    for run, row in rows.items():
        if run[:4] not in limit:
            continue
        difference = 100.0 * (float(row["peak_stress"]) / limit[run[:4]] - 1.0)
        key = (run.model, run.test, f"{run.scale:g}", run.loading, f"{run.rate:g}")
        numbers = (difference, float(row["steps"]), float(row["unbalanced_median"]))
        groups[key].append(numbers)
    print(
        "model,test,scale,loading,rate,packings,difference_percent,standard_error,rms,steps,ratio"
    )
    for key in sorted(groups):
        differences, steps, ratios = zip(*groups[key], strict=True)
        count = len(differences)
        error = statistics.stdev(differences) / count**0.5 if count > 1 else float("nan")
        rms = (sum(d * d for d in differences) / count) ** 0.5
        print(
            *key,
            count,
            *(f"{statistics.mean(differences):.2f}", f"{error:.2f}", f"{rms:.2f}"),
            *(f"{statistics.mean(steps):.0f}", f"{statistics.mean(ratios):.2g}"),
            sep=",",
        )


def main() -> None:
    """Run the study, or print its table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("tests", nargs="*", metavar="TEST", help=f"of {', '.join(TESTS)}")
    parser.add_argument("--table", dest="shown", action="store_true", help="print the means")
    parser.add_argument("--model", nargs="+", default=["flexible", "rigid"])
    parser.add_argument("--scale", type=float, default=0.5, help="lengths over the paper's [-]")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3, 4])
    options = parser.parse_args()
    if options.shown:
        print_table(read(options.table))
        return
    for test in options.tests:
        for model in options.model:
            for run in runs_of(test, model, options.scale, options.seeds):
                if run in read(options.table):
                    continue
                new = not options.table.exists()
                row = done(run)
                with options.table.open("a", newline="") as file:
                    writer = csv.writer(file, lineterminator="\n")
                    if new:
                        writer.writerow(FIELDS)
                    writer.writerow(row)


if __name__ == "__main__":
    main()
