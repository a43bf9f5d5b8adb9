# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare ways of loading with the limit of slow loading, on the same packings.

Runs each test on several packings: at two slow constant rates, from which a straight line over the
rate gives the limit, and with each way of loading at some factors on its rate. Adds one CSV row a
run and passes over rows that are there. SI units. Start it from a checkout that scripts/setup has
built; the second command prints the table of the documentation:

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/slow_limit.py limit.csv uniaxial
    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/slow_limit.py limit.csv --table
    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/slow_limit.py limit.csv --ratios

The last one prints the table of the tests between parts with their unbalanced-force ratios:
beams, half discs, and joints without cohesion in direct shear.
"""

from __future__ import annotations

import argparse
import csv
import math
import statistics
import sys
from collections import defaultdict
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import NamedTuple

import flexpm
from flexpm.materials.material import default_name, load
from flexpm.materials.mixing import description, is_brittle
from flexpm.results import measures
from flexpm.runs.loading_rate import LOADINGS

PART_TESTS = ("bending", "scb", "shear")
TESTS = ("uniaxial", "tension", "biaxial", "brazilian", *PART_TESTS)
#: Factors on the constant rate, the slow ones; that of confined flexible grains and those of parts
#: are slow already.
SLOW = {
    ("biaxial", "flexible"): (1.0, 0.5),
    **{(test, model): (1.0, 0.5) for test in PART_TESTS for model in ("flexible", "rigid")},
}
SLOW_OTHERS = (0.5, 0.25)
#: Ways of loading and factors on their rates.
WAYS = (("adaptive", 1.0), ("waiting", 1.0), ("waiting", 2.0), ("waiting", 4.0))
WAYS_BRITTLE = (("constant", 1.0), ("waiting", 1.0), ("waiting", 2.0), ("waiting", 4.0))
WAYS_PARTS = (
    *((loading, rate) for loading in ("constant", "waiting") for rate in (1.0, 2.0, 4.0)),
)
#: On a joint in direct shear [Pa].
NORMAL_STRESS = 2e6


class Packing(NamedTuple):
    """What is tested, and how."""

    test: str
    model: str
    material: str
    confinement: float  #: [Pa]
    scale: float  #: lengths over the paper's [-]
    seed: int


class Run(NamedTuple):
    """What tells runs apart."""

    packing: Packing
    loading: str
    rate: float  #: factor on the rate of this way of loading [-]


FIELDS = (
    *(*Packing._fields, "loading", "rate"),
    *("peak_stress", "unbalanced_median", "steps", "status", "unbalanced_under_way"),
)


def runs_of(packing: Packing) -> Iterator[Run]:
    """All runs of a packing."""
    brittle = is_brittle(description(load(packing.material), packing.model))
    ways = WAYS_BRITTLE if brittle else WAYS
    ways = WAYS_PARTS if packing.test in PART_TESTS else ways
    slow = [("constant", rate) for rate in SLOW.get(packing[:2], SLOW_OTHERS)]
    for loading, rate in sorted({*ways, *slow}):
        yield Run(packing, loading, rate)


def done(run: Run) -> list[object]:
    """Row of a run."""
    packing = run.packing
    specimen, material, options = prepared(packing)
    result = flexpm.run(
        packing.test,
        specimen,
        material,
        model=packing.model,
        loading=run.loading,
        rate=run.rate,
        report=False,
        **options,
    )
    ratio = measures.median_unbalanced_ratio(result.curve)
    under_way = measures.unbalanced_under_way(result.curve)
    # a joint slides without a peak
    peak = float(result.curve["axial_stress"].max())
    peak = peak if packing.test == "shear" else result.peak_stress
    steps = result.steps
    return [*packing, run.loading, run.rate, peak, ratio, steps, result.status, under_way]


def prepared(packing: Packing) -> tuple[flexpm.Specimen, flexpm.Material, dict[str, float]]:
    """Specimen, material and options of the test."""
    material, kind = load(packing.material), flexpm.Specimen
    width, seed = 0.08 * packing.scale, {"seed": packing.seed}
    if packing.test == "brazilian":
        return kind.disc(width, 0.08, **seed), material, {}
    if packing.test == "scb":
        return kind.half_disc(width, 0.08, **seed), material, {"stop_ratio": 0.5}
    if packing.test == "bending":
        beam = kind.rectangle(0.18 * packing.scale, 0.04 * packing.scale, 0.08, **seed)
        return beam, material, {"notch": 0.016 * packing.scale, "stop_ratio": 0.5}
    if packing.test == "shear":
        block = kind.rectangle(width, 0.5 * width, 0.08, **seed)
        law = {"normal_stiffness": 1.8e13, "shear_stiffness": 5e12, "friction": 0.5}
        joint = {f"joint.plane.{key}": value for key, value in law.items()}
        cut = block.with_joints({"plane": [(0.0, 0.25 * width), (width, 0.25 * width)]})
        options = {"normal_stress": NORMAL_STRESS}
        return cut, material.with_set(joint, packing.model), options
    whole = kind.rectangle(width, 2.0 * width, 0.08, **seed)
    return whole, material, {"confinement": packing.confinement}


def read(table: Path) -> dict[Run, dict[str, str]]:
    """Rows of a table."""
    if not table.exists():
        return {}
    with table.open(newline="") as file:
        return {run_of(row): row for row in csv.DictReader(file)}


def run_of(row: dict[str, str]) -> Run:
    """What a row is of."""
    packing = Packing(
        row["test"],
        row["model"],
        row["material"],
        float(row["confinement"]),
        float(row["scale"]),
        int(row["seed"]),
    )
    return Run(packing, row["loading"], float(row["rate"]))


def limits(rows: dict[Run, dict[str, str]]) -> dict[Packing, float]:
    """Peak at a rate of zero of each packing [Pa]: the line through the two slowest rates."""
    constant: dict[Packing, list[tuple[float, float]]] = defaultdict(list)
    for run, row in rows.items():
        if run.loading == "constant":
            constant[run.packing].append((run.rate, float(row["peak_stress"])))
    found = {}
    for packing, pairs in constant.items():
        if len(pairs) >= 2:
            (r1, p1), (r2, p2) = sorted(pairs)[:2]
            found[packing] = p1 - r1 * (p2 - p1) / (r2 - r1)
    return found


#: Columns of the documentation's table: heading, way of loading and factor on its rate. What was in
#: use before is adaptive, of brittle contacts constant.
SHOWN = (
    ("before", (("adaptive", 1.0), ("constant", 1.0))),
    ("waiting", (("waiting", 1.0),)),
    ("waiting, rate 2", (("waiting", 2.0),)),
)


def table(rows: dict[Run, dict[str, str]]) -> Iterator[list[str]]:
    """Means of differences to the limit with their standard errors, and steps."""
    limit = limits(rows)
    groups: dict[tuple[object, ...], dict[tuple[str, float], list[tuple[float, float]]]] = {}
    for run, row in sorted(rows.items()):
        if run.packing in limit and run.packing.test not in PART_TESTS:
            difference = 100.0 * (float(row["peak_stress"]) / limit[run.packing] - 1.0)
            ways = groups.setdefault(run.packing[:-1], defaultdict(list))
            ways[run.loading, run.rate].append((difference, float(row["steps"])))
    yield [
        *("test", "packings"),
        *(f"{name}{what}" for name, _ in SHOWN for what in (" [%]", ", steps")),
    ]
    for key, ways in groups.items():
        test, model, material, confinement, _ = key
        words = [f"{model}, {test}"]
        words += [f"{1e-6 * float(confinement):g} MPa"] if confinement else []
        words += ["brittle"] if str(material).endswith("-brittle") else []
        line = [", ".join(words), str(len(ways["waiting", 1.0]))]
        for _, candidates in SHOWN:
            found = next((ways[way] for way in candidates if way in ways), [])
            differences, steps = zip(*found, strict=True) if found else ((), ())
            if len(found) < 2:
                line += ["", ""]
                continue
            error = statistics.stdev(differences) / len(found) ** 0.5
            line += [f"{statistics.mean(differences):.1f} ± {error:.1f}"]
            line += [f"{statistics.mean(steps):.0f}"]
        yield line


def ratios(rows: dict[Run, dict[str, str]]) -> Iterator[list[str]]:
    """Differences to the limit where it is known, and the ratios, of tests between parts.

    The ratio is the median under a constant loading, and that under way of one that waits.
    """
    limit = limits(rows)
    groups: dict[tuple[str, str, float], list[tuple[float, float]]] = defaultdict(list)
    for run, row in sorted(rows.items(), key=lambda row: (row[0].packing.scale, row[0])):
        packing = run.packing
        if packing.test not in PART_TESTS:
            continue
        peak = limit.get(packing, math.nan)
        difference = 100.0 * (float(row["peak_stress"]) / peak - 1.0)
        waits = run.loading == "waiting"
        ratio = float(row["unbalanced_under_way" if waits else "unbalanced_median"])
        words = [f"{packing.model}, {packing.test}"]
        words += ["brittle"] if packing.material.endswith("-brittle") else []
        words += [f"size {packing.scale:g}"] if packing.scale != 0.5 else []
        groups[", ".join(words), run.loading, run.rate].append((difference, ratio))
    yield ["test", "loading", "rate", "packings", "to the limit [%]", "unbalanced-force ratio"]
    for (test, loading, rate), found in groups.items():
        differences, unbalanced = zip(*found, strict=True)
        shown = ""
        if len(found) > 1 and not math.isnan(differences[0]):
            error = statistics.stdev(differences) / len(found) ** 0.5
            shown = f"{statistics.mean(differences):.1f} ± {error:.1f}"
        yield [
            *(test, loading, f"{rate:g}", str(len(found))),
            shown,
            f"{min(unbalanced):.2g} to {max(unbalanced):.2g}",
        ]


def main() -> None:
    """Run the study, or print its table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("tests", nargs="*", metavar="TEST", help=f"of {', '.join(TESTS)}")
    parser.add_argument("--table", dest="shown", action="store_true", help="print the means")
    parser.add_argument("--ratios", action="store_true", help="print those of tests of parts")
    parser.add_argument("--model", nargs="+", default=["flexible", "rigid"])
    parser.add_argument("--material", help="preset; the default of the model unless given")
    parser.add_argument("--confinement", type=float, default=4e6, help="of biaxial tests [Pa]")
    parser.add_argument("--scale", type=float, default=0.5, help="lengths over the paper's [-]")
    parser.add_argument("--loading", nargs="+", help="ways of loading; all unless given")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3, 4])
    options = parser.parse_args()
    if options.shown or options.ratios:
        lines = table if options.shown else ratios
        csv.writer(sys.stdout, lineterminator="\n").writerows(lines(read(options.table)))
        return
    for test, model, seed in product(options.tests, options.model, options.seeds):
        confinement = options.confinement if test == "biaxial" else 0.0
        material = options.material or default_name(model)
        for run in runs_of(Packing(test, model, material, confinement, options.scale, seed)):
            if run in read(options.table) or run.loading not in (options.loading or LOADINGS):
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
