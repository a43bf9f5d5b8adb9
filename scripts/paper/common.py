# SPDX-License-Identifier: GPL-3.0-or-later
"""Common to the scripts of the paper's figures: studies with their tables, derived measures.

A script does the runs of the study file of its name and writes ``paper-out/NAME/*.png``. It keeps
results in ``paper-out/NAME.csv`` and repeats no run of this table, but for those whose curves a
picture needs.
"""

from __future__ import annotations

import argparse
import contextlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas

import flexpm
from flexpm.cli.terminal import Progress
from flexpm.errors import InputError
from flexpm.report import comparison
from flexpm.results.result import Result
from flexpm.results.strength import Envelope
from flexpm.studies import figures, jobs, study

HERE = Path(__file__).parent
#: Runs after which their rows are kept, so that a night that ends early has lost little.
KEPT = 20


def options(about: str) -> argparse.Namespace:
    """Read the options that all scripts have."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--workers", type=int, help="runs at a time; default: one per core")
    parser.add_argument(
        "--out", type=Path, default=Path("paper-out"), help="folder of the tables and the runs"
    )
    parser.add_argument("--dry", action="store_true", help="run nothing: use what is there")
    return parser.parse_args()


def results(
    name: str,
    chosen: argparse.Namespace,
    drawn: Callable[[Mapping[str, Any]], bool] = lambda inputs: False,
    plan: study.Study | None = None,
) -> tuple[pandas.DataFrame, Path]:
    """Table of a figure's runs and the folder for its pictures.

    Args:
        name: Name of the table, and of the study file.
        chosen: The script's options.
        drawn: Tells by its inputs whether a run's curve is drawn.
        plan: The runs; None for those of the study file.
    """
    plan = plan or study.read(HERE / f"{name}.toml")
    table, folder = chosen.out / f"{name}.csv", chosen.out / name
    known = rows_of(table)
    done = set(known["key"])
    missing = [job for job in plan.jobs if job.key not in done]
    print(f"{name}: {len(plan.jobs)} runs, {len(missing)} of them not in {table.name}")
    if line := jobs.outdated(missing, done.__contains__):
        print(f"{name}: {line}")
    curves = [
        job
        for job in plan.jobs
        if job.key in done
        and drawn(job.inputs)
        and not (folder / "runs" / job.key / "curve.csv").exists()
    ]
    if curves:
        print(f"{name}: {len(curves)} runs more, whose curves are not in {folder}")
    missing += curves
    folder.mkdir(parents=True, exist_ok=True)
    if not chosen.dry:
        with Progress(unit="runs") as progress:
            for first in range(0, len(missing), KEPT):
                part = study.Study(plan.name, missing[first : first + KEPT])
                new = study.run(part, folder, workers=chosen.workers, progress=progress)
                done_now = new[new["exit_code"].isin([0, 3])]
                known = pandas.concat([known, done_now], ignore_index=True).drop_duplicates("key")
                _in_order(known, plan.jobs).to_csv(table, index=False)
    return _in_order(known, plan.jobs), folder


def rows_of(table: Path) -> pandas.DataFrame:
    """Rows of a table of runs; none if there is no such table."""
    if not table.exists():
        return pandas.DataFrame({"key": []})
    # pandas' own reader of numbers would change last digits at each writing
    return pandas.read_csv(table, float_precision="round_trip")


def _in_order(known: pandas.DataFrame, wanted: Sequence[jobs.Job]) -> pandas.DataFrame:
    """Row of each run; one of an older results number stands in for a run not done again yet."""
    there = set(known["key"])
    keys = [
        next((key for key in (job.key, *reversed(job.spec.older_keys())) if key in there), None)
        for job in wanted
    ]
    order = {key: number for number, key in enumerate(keys) if key is not None}
    found = known[known["key"].isin(order)]
    return found.sort_values("key", key=lambda names: names.map(order))


def macroscopic(rows: pandas.DataFrame, by: list[str]) -> pandas.DataFrame:
    """Measures of the rock for each packing, from the peaks of all its tests.

    Args:
        rows: Runs of the tests uniaxial, biaxial, tension and brazilian.
        by: Columns that tell the materials and models apart; packings are told apart by seed.

    Returns:
        Columns `by`, ``seed``, ``compressive_strength``, ``cohesion``, ``friction_angle``,
        ``hoek_brown_strength``, ``hoek_brown_m``, ``direct``, ``indirect`` (tensile strengths) and
        their ``ratio``, ``compression_over_direct``; missing where a run is.
    """
    made = []
    for values, group in rows.groupby([*by, "seed"], dropna=False, sort=False):
        peaks = group.set_index("test")["peak_stress"]
        compressed = group[group["test"].isin(["uniaxial", "biaxial"])]
        confinements = compressed["confinement"].fillna(0.0).astype(float).tolist()
        one = dict(zip([*by, "seed"], values, strict=True))
        one["compressive_strength"] = peaks.get("uniaxial")
        one["direct"], one["indirect"] = peaks.get("tension"), peaks.get("brazilian")
        one["ratio"] = flexpm.strength.tensile_ratio(one["direct"], one["indirect"])
        if one["compressive_strength"] and one["direct"]:
            one["compression_over_direct"] = one["compressive_strength"] / one["direct"]
        # a part of the confinements would be another envelope than that of the other packings
        if len(set(confinements)) > 1 and compressed["peak_stress"].notna().all():
            strengths = compressed["peak_stress"].astype(float).tolist()
            with contextlib.suppress(InputError):  # peaks that follow no criterion
                line = flexpm.strength.mohr_coulomb(confinements, strengths)
                one |= {"cohesion": line.cohesion, "friction_angle": line.friction_angle}
                curve = flexpm.strength.hoek_brown(confinements, strengths)
                one |= {"hoek_brown_strength": curve.sigma_ci, "hoek_brown_m": curve.m_i}
        made.append(one)
    return pandas.DataFrame(made)


#: Panels a to g of Figs. 12 and 13.
PANELS = (
    "compressive_strength",
    "friction_angle",
    "cohesion",
    "direct",
    "indirect",
    "ratio",
    "compression_over_direct",
)


def macroscopic_pictures(
    name: str, rows: pandas.DataFrame, folder: Path, keys: list[str], x: str
) -> list[Path]:
    """Draw panels a to g over the input `x`, a line for each value of the other `keys`.

    The measures go to ``NAME.csv`` in the folder.
    """
    found = macroscopic(rows, keys)
    found.to_csv(folder / f"{name}.csv", index=False)
    by = [key for key in keys if key != x]
    pictures = [
        {"x": x, "y": y, "by": by, "file": f"{name}{letter}.png", "title": f"{name} {letter}"}
        for letter, y in zip("abcdefg", PANELS, strict=True)
        if y in found and found[y].notna().any()
    ]
    return figures.draw(study.Study(name, [], pictures), found, folder)


def envelope_of(label: str, rows: pandas.DataFrame) -> Envelope:
    """Peaks of all packings under all confinements, with the criteria that describe them."""
    found = rows[rows["test"].isin(["uniaxial", "biaxial"])].dropna(subset="peak_stress")
    confinements = found["confinement"].fillna(0.0).astype(float).tolist()
    peaks = found["peak_stress"].astype(float).tolist()
    return Envelope.of(label, confinements, peaks)


def curves_of(rows: pandas.DataFrame, folder: Path) -> list[tuple[str, Result]]:
    """Labels and results, with their curves, of runs whose folders are still there."""
    found = []
    for _, row in rows.iterrows():
        run = folder / "runs" / row["key"]
        if not (run / "curve.csv").exists():
            continue
        result = Result.read(run)
        pressure = f", {1e-6 * result.confinement:g} MPa" if result.confinement else ""
        found.append((f"{result.model}{pressure}", result))
    return found


def of_first_packing(inputs: Mapping[str, Any]) -> bool:
    """The run is of the packing whose curves are drawn."""
    return inputs["seed"] == 1


def panels_of_laws(name: str, chosen: argparse.Namespace) -> list[Path]:
    """Draw the curves of the first packing: panel a with brittle contacts, b with bilinear."""
    rows, folder = results(name, chosen, of_first_packing)
    first = rows[[of_first_packing(row) for row in rows.to_dict("records")]]
    pictures = []
    for letter, law in (("a", "brittle"), ("b", "bilinear")):
        runs = curves_of(first[first["material"].str.endswith(law)], folder)
        if runs:
            comparison.curves_picture(folder / f"{name}{letter}.png", runs)
            pictures.append(folder / f"{name}{letter}.png")
    return pictures
