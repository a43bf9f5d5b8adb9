# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibrated presets on packings that no calibration has looked at.

Seeds 31 to 40. Rectangles of 80 x 160 mm and discs of 80 mm in the plane, boxes of 25 x 25 x 50 mm
and discs of 50 x 25 mm in space, under the pressures of deviation D44. Adds one CSV row a run and
passes over rows that are there. SI units. The second command prints means and standard errors:

    export PYTHONPATH=build/python
    /usr/bin/python3 scripts/studies/fresh_packings.py fresh_packings.csv
    /usr/bin/python3 scripts/studies/fresh_packings.py fresh_packings.csv --table
"""

from __future__ import annotations

import argparse
import math
import statistics
from pathlib import Path
from typing import Any, NamedTuple

from growing_table import add_row, rows_of

import flexpm
from flexpm.results.strength import mohr_coulomb

SEEDS = range(31, 41)


class Preset(NamedTuple):
    """A preset, the model that it is for and the pressures that its line goes through [Pa]."""

    name: str
    model: str
    solid: bool
    pressures: tuple[float, ...]


_PLANE, _SPACE = (0.0, 2e6, 4e6, 8e6, 12e6), (0.0, 2e6, 4e6)
PRESETS = (
    Preset("augig3d-calibrated", "flexible", True, _SPACE),
    Preset("augig3d-calibrated-rigid", "rigid", True, _SPACE),
    Preset("augig-calibrated", "flexible", False, _PLANE),
    Preset("augig-calibrated-rigid", "rigid", False, _PLANE),
)


class Case(NamedTuple):
    """What tells runs apart."""

    preset: str
    confinement: float  #: [Pa]
    split: bool  #: a disc
    seed: int


FIELDS = ("preset", "test", "confinement", "seed", "strength", "youngs_modulus", "status", "steps")


def specimen_of(preset: Preset, seed: int, *, split: bool) -> Any:
    """Pack the specimen of a test."""
    if preset.solid and split:
        return flexpm.Specimen.solid_disc(0.050, 0.025, seed=seed)
    if preset.solid:
        return flexpm.Specimen.box(0.025, 0.025, 0.050, seed=seed)
    if split:
        return flexpm.Specimen.disc(0.080, 0.040, seed=seed)
    return flexpm.Specimen.rectangle(0.080, 0.160, 0.040, seed=seed)


def row_of(preset: Preset, confinement: float, seed: int, *, split: bool) -> list[object]:
    """Do a run."""
    test, options = "brazilian" if split else "uniaxial", {"stop_ratio": 0.9}
    if confinement:
        test = "triaxial" if preset.solid else "biaxial"
        options["confinement"] = confinement
    specimen, material = specimen_of(preset, seed, split=split), flexpm.materials.load(preset.name)
    found = flexpm.run(test, specimen, material, preset.model, **options)
    modulus = None if split or confinement else found.youngs_modulus
    return [
        preset.name,
        test,
        confinement,
        seed,
        found.peak_stress,
        modulus,
        found.status,
        found.steps,
    ]


def read(table: Path) -> dict[Case, dict[str, str]]:
    """Rows that are there."""
    return {
        Case(
            row["preset"],
            float(row["confinement"]),
            row["test"] == "brazilian",
            int(row["seed"]),
        ): row
        for row in rows_of(table)
    }


def print_means(preset: Preset, rows: dict[Case, dict[str, str]]) -> None:
    """Print what packings of a preset have in common."""
    print(preset.name)
    found = {case: row for case, row in rows.items() if case.preset == preset.name}
    peaks = {case[1:]: float(row["strength"]) for case, row in found.items() if row["strength"]}
    for split, name in ((False, "compressive strength"), (True, "indirect tensile strength")):
        values = [peaks[0.0, split, seed] for seed in SEEDS if (0.0, split, seed) in peaks]
        show(name, [1e-6 * value for value in values], "MPa")
    whole = [
        seed
        for seed in SEEDS
        if all((pressure, False, seed) in peaks for pressure in preset.pressures)
    ]
    lines = [
        mohr_coulomb(
            list(preset.pressures), [peaks[pressure, False, seed] for pressure in preset.pressures]
        )
        for seed in whole
    ]
    show("cohesion", [1e-6 * line.cohesion for line in lines], "MPa")
    show("friction angle", [line.friction_angle for line in lines], "degrees")
    moduli = [
        1e-9 * float(row["youngs_modulus"]) for row in found.values() if row["youngs_modulus"]
    ]
    show("Young's modulus of runs", moduli, "GPa")
    passed = sum(row["status"] == "ok" for row in found.values())
    print(f"  ok: {passed} of {len(found)}")


def show(name: str, values: list[float], unit: str) -> None:
    """Print a mean and its standard error."""
    if len(values) > 1:
        error = statistics.stdev(values) / math.sqrt(len(values))
        print(f"  {name:24} {statistics.mean(values):.4g} +- {error:.2g} {unit} ({len(values)})")


def main() -> None:
    """Do the runs of presets, all unless some are named, or print what they have found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("presets", nargs="*", help="names; all unless given")
    parser.add_argument("--table", action="store_true", dest="show", help="print the means")
    options = parser.parse_args()
    rows = read(options.table)
    for preset in PRESETS:
        if options.presets and preset.name not in options.presets:
            continue
        if options.show:
            print_means(preset, rows)
            continue
        for pressure, split in [(0.0, True), *((pressure, False) for pressure in preset.pressures)]:
            for seed in SEEDS:
                if Case(preset.name, pressure, split, seed) not in rows:
                    add_row(options.table, FIELDS, row_of(preset, pressure, seed, split=split))


if __name__ == "__main__":
    main()
