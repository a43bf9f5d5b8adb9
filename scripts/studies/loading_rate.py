# SPDX-License-Identifier: GPL-3.0-or-later
"""Halve the loading rate of a test until its peak stands still: the study that fixed RATE_CONSTANT.

Runs TEST with MODEL on packings of half the paper's size at falling rates and writes one CSV row a
run: seed, rate factor, peak stress [Pa], strain at peak [-], Young's modulus [Pa], unbalanced-force
ratio [-], steps. Start it from a checkout with scripts/flexpm set up:

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/loading_rate.py uniaxial rates.csv
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import flexpm

FIELDS = (
    "seed",
    "rate",
    "peak_stress",
    "peak_strain",
    "youngs_modulus",
    "unbalanced_ratio",
    "steps",
)


def specimen_for(test: str, scale: float, seed: int) -> flexpm.Specimen:
    """Make the paper's specimen of a test, its lengths times `scale`, with the same grains."""
    if test == "brazilian":
        return flexpm.Specimen.disc(diameter=0.08 * scale, thickness=0.08, seed=seed)
    return flexpm.Specimen.rectangle(0.08 * scale, 0.16 * scale, thickness=0.08, seed=seed)


def main() -> None:
    """Run the study."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("test")
    parser.add_argument("table", type=Path, help="CSV file to write")
    parser.add_argument("--model", default="flexible")
    parser.add_argument("--scale", type=float, default=0.5, help="lengths over the paper's [-]")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--rates", type=float, nargs="+", default=[2.0, 1.0, 0.5, 0.25])
    options = parser.parse_args()
    with options.table.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(FIELDS)
        for seed in options.seeds:
            specimen = specimen_for(options.test, options.scale, seed)
            for rate in options.rates:
                result = flexpm.run(options.test, specimen, model=options.model, rate=rate)
                row = [getattr(result, name, None) for name in FIELDS[2:]]
                writer.writerow([seed, rate, *row])
                file.flush()


if __name__ == "__main__":
    main()
