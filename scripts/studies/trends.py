# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare flexible and rigid grains at equal strengths: the runs behind the paper's Sec. 4.3.

Runs tests on rectangles of half the paper's size and discs of its full size, with the strengths of
Table 2, and writes one CSV row a run. Smaller discs are stronger: rigid and bilinear, 12.7 MPa at
40 mm and 9.7 MPa at 80 mm. SI units. Start it from a checkout that scripts/setup has built
(within an hour on one core):

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/trends.py trends.csv
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import flexpm

MODELS = ("flexible", "rigid")
MATERIALS = ("augig-table2-bilinear", "augig-table2-brittle")
SEEDS = (1, 2, 3)
#: Friction angles scatter more than strengths: three packings do not tell them apart.
COMPRESSION_SEEDS = (*SEEDS, 4, 5, 6, 7, 8)
#: Test and confinement [Pa]; compression is asked of the bilinear material only.
TENSION = (("tension", 0.0), ("brazilian", 0.0))
COMPRESSION = (("uniaxial", 0.0), ("biaxial", 4e6), ("biaxial", 12e6))


class Run(NamedTuple):
    """What one run is and what it found."""

    material: str
    model: str
    test: str
    confinement: float  #: [Pa]
    seed: int
    peak_stress: float  #: [Pa]
    peak_strain: float  #: [-]
    late_modulus: float  #: modulus around 80 % of the peak over that around 20 % [-]
    tensile_cracks: int
    shear_cracks: int
    steps: int
    status: str


def specimen_for(test: str, seed: int) -> flexpm.Specimen:
    """Make the paper's disc, or its rectangle at half the lengths with the same grains."""
    if test == "brazilian":
        return flexpm.Specimen.disc(diameter=0.08, thickness=0.08, seed=seed)
    return flexpm.Specimen.rectangle(0.04, 0.08, thickness=0.08, seed=seed)


def run(
    material: str, model: str, test: str, confinement: float, seed: int, keep: Path | None = None
) -> Run:
    """Do one run; its files go into a folder of `keep`."""
    name = f"{material}-{model}-{test}-{confinement:g}-{seed}"
    result = flexpm.run(
        test,
        specimen_for(test, seed),
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
        result.late_modulus if result.late_modulus is not None else float("nan"),
        result.tensile_cracks,
        result.shear_cracks,
        result.steps,
        result.status,
    )


def plan() -> Iterator[tuple[str, str, str, float, int]]:
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


def main() -> None:
    """Do all runs that the table does not hold yet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("--keep", type=Path, help="folder for the files of all runs")
    options = parser.parse_args()
    table = options.table
    done = {tuple(row[:5]) for row in csv.reader(table.open())} if table.exists() else set()
    with table.open("a", newline="") as file:
        writer = csv.writer(file)
        if not done:
            writer.writerow(Run._fields)
        for arguments in plan():
            if tuple(str(value) for value in arguments) in done:
                continue
            writer.writerow(run(*arguments, options.keep))
            file.flush()


if __name__ == "__main__":
    main()
