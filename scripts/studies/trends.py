# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare flexible and rigid grains at equal strengths: the runs behind the paper's Sec. 4.3.

Runs tests on rectangles of half the paper's size and discs of its full size, with the strengths of
Table 2, and writes one CSV row a run. Smaller discs are stronger: rigid and bilinear, 12.7 MPa at
40 mm and 9.7 MPa at 80 mm. SI units. Start it from a checkout that scripts/setup has built
(within an hour on one core). Rows whose key is not that of their run any more are outdated: one
line tells their number, and they are run again.

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/trends.py trends.csv
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import flexpm
from flexpm.files import csv_text, write_text
from flexpm.materials import load
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.spec import SpecimenSpec

MODELS = ("flexible", "rigid")
MATERIALS = ("augig-table2-bilinear", "augig-table2-brittle")
SEEDS = (1, 2, 3)
#: Friction angles scatter more than strengths: three packings do not tell them apart.
COMPRESSION_SEEDS = (*SEEDS, 4, 5, 6, 7, 8)
#: Test and confinement [Pa]; compression is asked of the bilinear material only.
TENSION = (("tension", 0.0), ("brazilian", 0.0))
COMPRESSION = (("uniaxial", 0.0), ("biaxial", 4e6), ("biaxial", 12e6))


Arguments = tuple[str, str, str, float, int]


class Run(NamedTuple):
    """What one run is and what it found."""

    material: str
    model: str
    test: str
    confinement: float  #: [Pa]
    seed: int
    peak_stress: float  #: [Pa]
    peak_strain: float  #: [-]
    tangent_modulus_ratio: float  #: modulus around 80 % of the peak over that around 20 % [-]
    tensile_cracks: int
    shear_cracks: int
    steps: int
    status: str
    key: str  #: of the run's inputs and results number


def spec_of(material: str, model: str, test: str, confinement: float, seed: int) -> RunSpec:
    """Describe a run on the paper's disc, or on its rectangle at half the lengths."""
    if test == "brazilian":
        specimen = SpecimenSpec("disc", diameter=0.08, thickness=0.08, seed=seed)
    else:
        specimen = SpecimenSpec("rectangle", width=0.04, height=0.08, thickness=0.08, seed=seed)
    law = described(load(material), model)
    return RunSpec(test, specimen, law, model, confinement=confinement)


def run(
    material: str, model: str, test: str, confinement: float, seed: int, keep: Path | None = None
) -> Run:
    """Do one run; its files go into a folder of `keep`."""
    name = f"{material}-{model}-{test}-{confinement:g}-{seed}"
    spec = spec_of(material, model, test, confinement, seed)
    result = flexpm.run(
        test,
        flexpm.Specimen.pack(spec.specimen),
        material=material,
        model=model,
        confinement=confinement,
        out=None if keep is None else keep / name,
    )
    return Run(
        material,
        model,
        test,
        confinement,
        seed,
        result.peak_stress or float("nan"),
        result.peak_strain or float("nan"),
        result.tangent_modulus_ratio if result.tangent_modulus_ratio is not None else float("nan"),
        result.tensile_cracks,
        result.shear_cracks,
        result.steps,
        result.status,
        spec.key(),
    )


def plan() -> Iterator[Arguments]:
    """Arguments of all runs."""
    for material in MATERIALS:
        for model in MODELS:
            for test, confinement in TENSION:
                for seed in SEEDS:
                    yield material, model, test, confinement, seed
    for model in MODELS:
        for test, confinement in COMPRESSION:
            for seed in COMPRESSION_SEEDS:
                yield MATERIALS[0], model, test, confinement, seed


def read(table: Path) -> dict[Arguments, Sequence[Any]]:
    """Rows of a table by the arguments of their runs; none if there is no table yet."""
    if not table.exists():
        return {}
    with table.open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    return {(*row[:3], float(row[3]), int(row[4])): row for row in rows}


def main() -> None:
    """Do all runs that the table does not hold yet, or of which the results have changed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("--keep", type=Path, help="folder for the files of all runs")
    parser.add_argument("--dry", action="store_true", help="run nothing: tell what is outdated")
    options = parser.parse_args()
    keys = {arguments: spec_of(*arguments).key() for arguments in plan()}
    rows = read(options.table)
    outdated = [which for which, row in rows.items() if row[-1] != keys.get(which)]
    if outdated:
        print(f"trends: {len(outdated)} rows are of an older results number and are run again")
    waiting = [which for which in keys if which not in rows or which in outdated]
    for arguments in [] if options.dry else waiting:
        rows[arguments] = run(*arguments, options.keep)
        write_text(options.table, csv_text(Run._fields, rows.values()))


if __name__ == "__main__":
    main()
