# SPDX-License-Identifier: GPL-3.0-or-later
"""Exponents d ln(measure) / d ln(key) of the measures of a scorecard, by central differences.

Each key of a material is changed by +-15 %, on two packings of the small specimens of a scorecard.
The ratio of shear to normal stiffness of contacts stays, so both change with `normal_stiffness`.
Keys that only change the elastic solution are varied in the elastic solve alone. The script can be
stopped and started again: runs that are finished are not repeated. The first command does the runs
and writes a row for each packing into a CSV table (SI units, angles in degrees); with `--finished`
it only writes the rows of the runs that are finished. The second command makes the table that
scorecards and `flexpm calibrate --new` read:

    export PYTHONPATH=build/python
    rows=scripts/studies/exponents.csv table=py/flexpm/studies/scorecards/exponents.toml
    /usr/bin/python3 scripts/studies/exponents.py $rows --runs exponents
    /usr/bin/python3 scripts/studies/exponents.py $rows --table $table --page doc/exponents.csv
"""

from __future__ import annotations

import argparse
import csv
import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import tomli_w

from flexpm import materials
from flexpm.materials.mixing import value_of
from flexpm.studies import jobs
from flexpm.studies.pool import Pool
from flexpm.studies.scorecards import measures, rock, runs

MATERIAL = Path(__file__).with_name("augig_stiff_start.toml")
MODEL, SHAPE, SIZE, SEEDS = "flexible", "rectangle", "small", (1, 2)
#: Relative change of a key.
STEP = 0.15
FACTORS = (1.0 + STEP, 1.0 - STEP)
KEYS = (
    *("tensile_strength", "cohesion", "friction", "shear_fracture_energy"),
    *("tensile_fracture_energy", "normal_stiffness", "weibull"),
)
#: Keys that are varied in the elastic solve alone.
ELASTIC = ("shear_ratio", "young", "poisson")
#: Runs, those first that tell most measures for their time; class II has no exponent.
GROUPS = (
    (measures.SOLVED, measures.COMPRESSED, measures.PULLED, measures.SPLIT),
    (measures.NOTCHED,),
    *((measures.confined(percent),) for percent in measures.PRESSURES),
)
#: Measures of the table in the manual.
SHOWN = (
    *("youngs_modulus", "poissons_ratio", "compressive_strength", "indirect_tensile_strength"),
    *("direct_tensile_strength", "direct_indirect_ratio", "compressive_indirect_ratio"),
    *("fracture_toughness", "crack_initiation", "crack_initiation_volumetric", "crack_damage"),
    *("cohesion_low", "friction_angle_low", "peak_ratio_10", "drop_10"),
)
FIELDS = ("key", "factor", "seed")


class Packing(NamedTuple):
    """A packing with a material of which one key is changed; no key: the material itself."""

    key: str
    factor: float
    seed: int


def packings() -> list[Packing]:
    """Return all packings, the material itself first."""
    changed = [("", 1.0), *((key, f) for key in (*KEYS, *ELASTIC) for f in FACTORS)]
    return [Packing(key, factor, seed) for key, factor in changed for seed in SEEDS]


def jobs_of(plan: runs.Plan, packing: Packing, names: Sequence[str]) -> dict[str, jobs.Job]:
    """Return some runs of a packing."""
    given = plan.jobs[packing.seed]
    if not packing.key:
        return {name: given[name] for name in names}
    value = value_of(materials.load(MATERIAL), packing.key, MODEL) * packing.factor
    change = {f"set.{packing.key}": float(f"{value:.6g}")}
    return {name: jobs.make({**given[name].inputs, **change}, Path()) for name in names}


def groups() -> Iterator[list[tuple[Packing, Sequence[str]]]]:
    """Yield the packings with the names of their runs, a list for each group of runs."""
    for names in GROUPS:
        yield [
            (one, names if one.key not in ELASTIC else (measures.SOLVED,))
            for one in packings()
            if one.key not in ELASTIC or measures.SOLVED in names
        ]


def _is_known(value: measures.Value) -> bool:
    """Whether a value counts: of runs that are too fast differences still do."""
    return value.number is not None and value.reason in ("", "not quasi-static")


def write_rows(plan: runs.Plan, folder: Path, file: Path) -> None:
    """Write the measures of all runs that are finished, a row for each packing."""
    known: dict[Packing, dict[str, measures.Ended]] = {}
    for group in groups():
        for packing, names in group:
            for name, job in jobs_of(plan, packing, names).items():
                outcome = jobs.finished(job, folder)
                if outcome is not None:
                    ended = runs.ended(outcome, folder / job.folder)
                    known.setdefault(packing, {})[name] = ended
    with file.open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow([*FIELDS, *measures.MEASURES])
        for packing, found in known.items():
            values = runs.values_of(found, solid=False).values()
            table.writerow(
                [
                    *packing,
                    *(f"{v.number:.6g}" if _is_known(v) else "" for v in values),
                ]
            )


def read_rows(file: Path) -> dict[Packing, dict[str, float]]:
    """Return the measures of each packing that are known, by their names."""
    with file.open(encoding="utf-8", newline="") as stream:
        return {
            Packing(row["key"], float(row["factor"]), int(row["seed"])): {
                name: float(row[name]) for name in measures.MEASURES if row[name]
            }
            for row in csv.DictReader(stream)
        }


def exponents_of(
    rows: Mapping[Packing, Mapping[str, float]], measure: str, key: str
) -> list[float]:
    """Return the exponent of each packing that has the measure with both values of a key."""
    found = []
    for seed in SEEDS:
        pair = [rows.get(Packing(key, factor, seed), {}).get(measure, 0.0) for factor in FACTORS]
        if min(pair) > 0.0:
            found.append(math.log(pair[0] / pair[1]) / math.log(FACTORS[0] / FACTORS[1]))
    return found


def table_of(rows: Mapping[Packing, Mapping[str, float]]) -> dict[str, Any]:
    """Return the content of the table: exponents with standard errors, and the base."""
    base = [found for packing, found in rows.items() if not packing.key]
    means = {
        name: float(np.mean([one[name] for one in base]))
        for name in measures.MEASURES
        if name != "class_two" and all(name in one for one in base)
    }
    of: dict[str, dict[str, list[float]]] = {}
    for name in means:
        for key in (*KEYS, *ELASTIC):
            found = exponents_of(rows, name, key)
            if found:
                error = [np.std(found, ddof=1) / math.sqrt(len(found))] if len(found) > 1 else []
                numbers = [float(np.mean(found)), *map(float, error)]
                of.setdefault(name, {})[key] = [round(one, 3) for one in numbers]
    return {
        **{"model": MODEL, "dimension": "2D", "size": SIZE, "step": STEP, "seeds": [*SEEDS]},
        "material": tomllib.loads(MATERIAL.read_text(encoding="utf-8")),
        "measures": {name: float(f"{mean:.5g}") for name, mean in means.items()},
        "exponents": of,
    }


def write_page(of: Mapping[str, Mapping[str, Sequence[float]]], page: Path) -> None:
    """Write the table of the manual: exponents with their standard errors."""
    keys = [*KEYS, "shear_ratio", "young"]
    with page.open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, delimiter="|", lineterminator="\n")
        table.writerow(["", *(f"``{key}``" for key in keys)])
        for name in SHOWN:
            cells = [" ± ".join(f"{one:.2f}" for one in of.get(name, {}).get(k, ())) for k in keys]
            table.writerow([measures.MEASURES[name].words, *cells])


def write_table(rows: Path, table: Path, page: Path | None) -> None:
    """Write the table that scorecards read, and print the keys that measures miss."""
    content = table_of(read_rows(rows))
    of = content.pop("exponents")
    lines = [
        "# SPDX-License-Identifier: GPL-3.0-or-later",
        "# Made by scripts/studies/exponents.py: a material, its measures on small specimens (SI",
        "# units, degrees), and exponents d ln(measure) / d ln(key), each with its standard error.",
        tomli_w.dumps(content),
    ]
    for name, keys in of.items():
        lines += [f"[exponents.{name}]", *(f"{key} = {one}" for key, one in keys.items()), ""]
    table.write_text("\n".join(lines), encoding="utf-8")
    if page is not None:
        write_page(of, page)
    for name in measures.MEASURES:
        missing = [key for key in KEYS if key not in of.get(name, {})]
        if missing and name != "class_two":
            print(f"{name}: no exponent of {', '.join(missing)}")


def carry_out(plan: runs.Plan, folder: Path, file: Path) -> None:
    """Do the runs that are not finished, one at a time, and write their rows."""
    with Pool(folder, workers=1) as pool:
        for group in groups():
            for packing, names in group:
                pool.run([*jobs_of(plan, packing, names).values()])
            write_rows(plan, folder, file)


def main() -> None:
    """Do the runs, write their rows, or make the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rows", type=Path, help="rows (CSV)")
    parser.add_argument("--runs", type=Path, metavar="DIR", help="folder of the runs")
    parser.add_argument("--finished", action="store_true", help="only write rows of finished runs")
    parser.add_argument("--table", type=Path, metavar="FILE", help="make the table from the rows")
    parser.add_argument("--page", type=Path, metavar="FILE", help="also write that of the manual")
    asked = parser.parse_args()
    plan = runs.plan(
        materials.load(MATERIAL),
        str(MATERIAL.resolve()),
        model=MODEL,
        shape=SHAPE,
        seeds=SEEDS,
        size=SIZE,
        rock=rock.load("augig", ""),
    )
    if asked.runs and asked.finished:
        write_rows(plan, asked.runs, asked.rows)
    elif asked.runs:
        carry_out(plan, asked.runs, asked.rows)
    if asked.table:
        write_table(asked.rows, asked.table, asked.page)


if __name__ == "__main__":
    main()
