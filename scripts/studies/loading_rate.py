# SPDX-License-Identifier: GPL-3.0-or-later
"""Halve the loading rate of tests until their peaks stand still: the study behind kinds' rates.

Runs each test on packings of the paper's size at falling constants k of the
loading rate and adds one CSV row a run. SI units; the confinement counts for biaxial tests only.
Start it from a checkout that scripts/setup has built:

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/loading_rate.py rates.csv tension
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from growing_table import add_row

import flexpm
from flexpm.results import measures
from flexpm.runs import loading_rate as rates

FIELDS = (
    "scale",
    "model",
    "test",
    "seed",
    "k",
    "peak_stress",
    "peak_strain",
    "youngs_modulus",
    "unbalanced_median",
    "energy_error",
    "steps",
    "status",
)


def specimen_for(test: str, scale: float, seed: int) -> flexpm.Specimen:
    """Make the paper's specimen of a test, its lengths times `scale`, with the same grains."""
    if test == "brazilian":
        return flexpm.Specimen.disc(diameter=0.08 * scale, thickness=0.08, seed=seed)
    return flexpm.Specimen.rectangle(0.08 * scale, 0.16 * scale, thickness=0.08, seed=seed)


def run_at(k: float, specimen: flexpm.Specimen, test: str, model: str, confinement: float) -> Any:
    """Run a test with the constant `k` of its loading rate [-] until its peak is well passed."""
    factor = k / rates.rates_of(test, model).constant
    pressure = confinement if test == "biaxial" else 0.0
    return flexpm.run(
        test,
        specimen,
        model=model,
        rate=factor,
        confinement=pressure,
        stop_ratio=0.8,
        loading="constant",
    )


def row_of(result: Any, seed: int, k: float, scale: float) -> list[Any]:
    """One row of the table."""
    found = {
        "k": k,
        "scale": scale,
        "seed": seed,
        "unbalanced_median": measures.median_unbalanced_ratio(result.curve),
    }
    return [found.get(name, getattr(result, name, None)) for name in FIELDS]


def main() -> None:
    """Run the study."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("tests", nargs="+")
    parser.add_argument("--model", default="flexible")
    parser.add_argument("--scale", type=float, default=1.0, help="lengths over the paper's [-]")
    parser.add_argument("--confinement", type=float, default=4e6, help="of biaxial tests [Pa]")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--k", type=float, nargs="+", default=[0.02, 0.01, 0.005])
    options = parser.parse_args()
    for test in options.tests:
        for seed in options.seeds:
            specimen = specimen_for(test, options.scale, seed)
            for k in options.k:
                result = run_at(k, specimen, test, options.model, options.confinement)
                add_row(options.table, FIELDS, row_of(result, seed, k, options.scale))


if __name__ == "__main__":
    main()
