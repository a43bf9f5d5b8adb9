# SPDX-License-Identifier: GPL-3.0-or-later
"""All tests of solids with all models that take them, on small packings.

Three seeds, YADE's bonded spheres the first of them alone. Materials are the calibrated ones of the
model; spheres have that of flexible grains.
Adds one CSV row a run and passes over rows that are there; what is refused has its line as status.
SI units. The second command prints means:

    export PYTHONPATH=build/python
    /usr/bin/python3 scripts/studies/solid_tests.py solid_tests.csv
    /usr/bin/python3 scripts/studies/solid_tests.py solid_tests.csv --table
"""

from __future__ import annotations

import argparse
import statistics
from pathlib import Path
from typing import Any

from growing_table import add_row, rows_of

import flexpm
from flexpm.errors import InputError

SEEDS = (1, 2, 3)
GRAIN_MODELS = ("flexible", "rigid")
MATERIALS = {
    "flexible": "augig3d-calibrated",
    "rigid": "augig3d-calibrated-rigid",
    "jcfpm": "augig3d-calibrated",
    "cohfrict": "augig3d-calibrated",
}
BOX = {"width": 0.015, "depth": 0.015, "height": 0.030}
#: Name of a case: the test, its specimen, its options, and what is told of it.
CASES: dict[str, tuple[str, str, dict[str, float], dict[str, float], str]] = {
    "uniaxial": ("uniaxial", "box", BOX, {}, "peak_stress"),
    "tension": ("tension", "box", BOX, {}, "peak_stress"),
    "triaxial, 4 MPa": (
        *("triaxial", "box", BOX, {"confinement": 4e6, "stop_ratio": 0.9}),
        "peak_stress",
    ),
    "brazilian": (
        *("brazilian", "solid_disc", {"diameter": 0.030, "depth": 0.015}, {}),
        "peak_stress",
    ),
    "bending": (
        *("bending", "box", {"width": 0.036, "depth": 0.008, "height": 0.008}, {"span": 0.032}),
        "peak_stress",
    ),
    "scb": (
        *("scb", "solid_half_disc", {"diameter": 0.030, "depth": 0.010}, {}),
        "fracture_toughness",
    ),
    "shear, 1 MPa": (
        *("shear", "box", {"width": 0.020, "depth": 0.010, "height": 0.012}),
        *({"normal_stress": 1e6}, "peak_stress"),
    ),
    "punch, 5 MPa": (
        *("punch", "box", {"width": 0.036, "depth": 0.008, "height": 0.020}),
        *({"confinement": 5e6, "notch": 0.003}, "peak_stress"),
    ),
    "sonic": ("sonic", "box", {"width": 0.009, "depth": 0.009, "height": 0.160}, {}, "vp"),
}
FIELDS = ("case", "model", "seed", "quantity", "value", "status", "steps")


def row_of(case: str, model: str, seed: int) -> list[object]:
    """Do a run."""
    test, shape, sizes, options, quantity = CASES[case]
    specimen: Any = getattr(flexpm.Specimen, shape)(**sizes, seed=seed)
    material = flexpm.materials.load(MATERIALS[model])
    try:
        found = flexpm.run(test, specimen, material, model, **options)
    except InputError as error:
        return [case, model, seed, quantity, None, f"refused: {error}", None]
    return [case, model, seed, quantity, getattr(found, quantity), found.status, found.steps]


def read(table: Path) -> dict[tuple[str, str, int], dict[str, str]]:
    """Rows that are there."""
    return {(row["case"], row["model"], int(row["seed"])): row for row in rows_of(table)}


def main() -> None:
    """Do the runs, or print what they have found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("--table", action="store_true", dest="show", help="print the means")
    options = parser.parse_args()
    rows = read(options.table)
    for case in CASES:
        for model in MATERIALS:
            if not options.show:
                for seed in SEEDS if model in GRAIN_MODELS else SEEDS[:1]:
                    if (case, model, seed) not in rows:
                        add_row(options.table, FIELDS, row_of(case, model, seed))
                continue
            own = [rows[case, model, seed] for seed in SEEDS if (case, model, seed) in rows]
            values = [float(row["value"]) for row in own if row["value"]]
            told = f"{statistics.mean(values):.4g}" if values else "-"
            print(case, model, own[0]["quantity"], told, [row["status"][:70] for row in own])


if __name__ == "__main__":
    main()
