# SPDX-License-Identifier: GPL-3.0-or-later
"""A test on several packings: a run for each packing, then means and scatter. SI units.

The runs are jobs like the runs of a study; their folders are named by the seeds of the packings.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pandas

from ..errors import InputError
from ..files import Table, output_folder, read_json
from ..kinds.registry import kind_of
from ..materials.references import reference_of
from ..progress import Progress
from ..report.comparison import envelope_picture
from ..report.packings import Group, packings_picture
from ..report.tables import columns, envelope_table, scaled
from ..report.words import Words, words_of_test
from ..results.strength import Envelope
from ..runs.output import RESULT, Output
from ..runs.run_spec import RunSpec
from ..text import name_of
from . import jobs
from .jobs import Job
from .pool import Pool
from .tables import table, write_table

#: Inputs by which runs are told apart beside the packing.
_BY = ["model", "confinement"]
#: What is said of the runs of a group, by the ending of the column in means.csv.
_SAID = {"": "mean", "_deviation": "standard deviation", "_error": "standard error"}


def plan(
    spec: RunSpec, given: Table, seeds: Sequence[int], output: Output, place: str = ""
) -> list[Job]:
    """Return the runs of a test on the packings of several seeds.

    Args:
        spec: The run, of any of the seeds.
        given: Options by name that make this run, with ``set.KEY`` for the material.
        seeds: Seeds of the packings.
        output: Files that each run writes in addition to its results.
        place: Folder of these runs, relative to the folder of all runs.
    """
    about = {"test": spec.test, "model": spec.model, "confinement": spec.confinement}
    found = []
    for seed in seeds:
        inputs: Table = {**about, **given, **about, "seed": seed}
        options = {
            key: value
            for key, value in inputs.items()
            if key != "test" and jobs.has_use(key, spec.test, spec.model, spec.specimen.kind)
        }
        packed = replace(spec, specimen=replace(spec.specimen, seed=seed))
        folder = str(Path(place) / f"seed-{seed}")
        arguments = tuple(jobs.arguments(spec.test, options))
        found.append(Job(inputs, arguments, packed, folder, output))
    return found


def refuse_others(wanted: Sequence[Job], folder: Path) -> None:
    """Reject a folder in which a run has other inputs than its job.

    Raises:
        InputError: for such a folder.
    """
    for job in wanted:
        place = folder / job.folder
        ended = jobs.known(place)
        begun = _key_of(place / "checkpoint.json")
        if (ended is not None and ended.get("key") != job.key) or begun not in (None, job.key):
            raise InputError(f"out = {place}, has a run with other inputs; choose another folder")


def run(
    wanted: Sequence[Job],
    folder: Path,
    *,
    workers: int | None = None,
    progress: Progress | None = None,
) -> pandas.DataFrame:
    """Run all unfinished runs; write tables and pictures.

    Args:
        wanted: The runs.
        folder: For the folders of the runs, ``table.csv``, ``means.csv``, ``curves.png``, and
            ``envelope.csv`` and ``envelope.png`` with several confining pressures.
        workers: Number of simultaneous runs; None for one per core.
        progress: Function that is called when a run has ended.

    Returns:
        One row per run: inputs, ``exit_code``, ``message``, measures.
    """
    with Pool(output_folder(folder), workers) as pool:
        outcomes = pool.run(wanted, progress)
    rows = table(wanted, outcomes)
    rows.insert(1, "folder", [job.folder for job in wanted])
    rows = rows.reindex(columns=[*dict.fromkeys([*rows.columns, *_measures(rows), "status"])])
    write_table(rows, folder / "table")
    write_table(means(rows), folder / "means")
    _draw(wanted, rows, folder)
    return rows


def means(rows: pandas.DataFrame) -> pandas.DataFrame:
    """Return one row per model and confining pressure; means do not include failed runs.

    Args:
        rows: Rows of the runs.

    Returns:
        ``runs``, ``failed``, and of each measure the mean, under its name, the standard deviation
        of the packings (``_deviation``) and the standard error of the mean (``_error``); missing
        values if there are too few runs.
    """
    found = []
    for _, group in rows.groupby(_BY, sort=False):
        good = group[_counted(group)]
        row: Table = {name: group[name].iloc[0] for name in ("test", *_BY)}
        row |= {"runs": len(group), "failed": len(group) - len(good)}
        for name in _measures(rows):
            values = good[name].dropna().astype(float)
            deviation = values.std() if len(values) > 1 else math.nan
            row[name] = values.mean()
            row[f"{name}_deviation"] = deviation
            row[f"{name}_error"] = deviation / math.sqrt(max(len(values), 1))
        found.append(row)
    return pandas.DataFrame(found)


def failures(rows: pandas.DataFrame) -> dict[str, tuple[int | None, str]]:
    """Exit code, None of a run that was lost, and message of each run that failed, by folder."""
    return {
        row["folder"]: (
            None if pandas.isna(row["exit_code"]) else int(row["exit_code"]),
            str(row["message"]),
        )
        for _, row in rows[~_counted(rows)].iterrows()
    }


def text_table(wanted: Sequence[Job], rows: pandas.DataFrame) -> str:
    """Return one line per packing, then mean, standard deviation and standard error.

    With several models or confining pressures only the last three, for each of them.
    """
    groups = means(rows)
    header = [shown.heading for shown in words_of_test(wanted[0].spec.test).shown.values()]
    lines = []
    if len(groups) == 1:
        for _, row in rows.iterrows():
            status = row["status"] if isinstance(row["status"], str) else "failed"
            lines.append([f"seed {row['seed']}", *_cells(row, ""), status])
    for _, row in groups.iterrows():
        name = f"{_label(row)} " if len(groups) > 1 else ""
        count = f"{row['runs'] - row['failed']} of {row['runs']} runs"
        for ending, said in _SAID.items():
            lines.append([name + said, *_cells(row, ending), "" if ending else count])
    used = {job.spec.model: name_of(job.spec.material["name"]) for job in wanted}
    first = wanted[0].spec
    materials = ", ".join(f"{model} model, {name}" for model, name in used.items())
    return f"{first.test}, {materials}\n" + columns(["packing", *header, "status"], lines)


def envelopes(rows: pandas.DataFrame) -> list[Envelope]:
    """Return strength criteria of each model through the peaks of all packings."""
    found = []
    for model, group in rows[_counted(rows)].groupby("model", sort=False):
        peaks = group.dropna(subset=["peak_stress"])
        if peaks["confinement"].nunique() > 1:
            pressures = peaks["confinement"].astype(float).tolist()
            found.append(Envelope.of(model, pressures, peaks["peak_stress"].astype(float).tolist()))
    return found


def envelopes_text(wanted: Sequence[Job], rows: pandas.DataFrame) -> str:
    """Return a table of the strength criteria; empty without several confining pressures."""
    found = envelopes(rows)
    return envelope_table(found, reference_of(wanted[0].spec.material["name"])) if found else ""


def _counted(rows: pandas.DataFrame) -> pandas.Series:
    """Which runs are in the means: those that have not failed."""
    return rows["exit_code"].eq(0).fillna(False).astype(bool)


def _measures(rows: pandas.DataFrame) -> tuple[str, ...]:
    """Measures of which means are taken."""
    return words_of_test(rows["test"].iloc[0]).measures


def _cells(row: pandas.Series, ending: str) -> list[str]:
    cells = []
    for name, (factor, _, digits) in words_of_test(row["test"]).shown.items():
        value = row[f"{name}{ending}"]
        if pandas.isna(value):
            cells.append("-")
        elif isinstance(value, int):
            cells.append(str(value))
        else:
            cells.append(scaled(value, factor, "", digits))
    return cells


def _label(row: pandas.Series) -> str:
    pressure = f" {1e-6 * row['confinement']:g} MPa" if kind_of(row["test"]).confined else ""
    return f"{row['model']}{pressure}"


def _draw(wanted: Sequence[Job], rows: pandas.DataFrame, folder: Path) -> None:
    groups, names = [], words_of_test(wanted[0].spec.test)
    for (_, mean), (_, runs) in zip(
        means(rows).iterrows(), rows.groupby(_BY, sort=False), strict=True
    ):
        curves = [
            (one[names.x.column].to_numpy(), one[names.y.column].to_numpy(), counts)
            for place, counts in zip(runs["folder"], _counted(runs), strict=True)
            if (folder / place / RESULT).is_file()  # a killed run has a curve, too
            and (one := _curve(folder / place / "curve.csv", names)) is not None
        ]
        peak, scatter = _peak(mean, ""), _peak(mean, "_deviation")
        count = f"{mean['runs'] - mean['failed']} of {mean['runs']}"
        groups.append(Group(_label(mean), curves, peak, scatter, count))
    packings_picture(folder / "curves.png", wanted[0].spec.test, groups)
    if found := envelopes(rows):
        criteria = pandas.DataFrame([one.as_dict() for one in found])
        write_table(criteria, folder / "envelope")
        first = wanted[0].spec
        about = [(float(row["confinement"]), row) for _, row in rows.iterrows()]
        title = f"{first.test}, {name_of(first.material['name'])}, several packings"
        envelope_picture(
            folder / "envelope.png",
            found,
            reference_of(first.material["name"]),
            title,
            [(pressure, _peak_of(row), str(row["status"])) for pressure, row in about],
        )


def _peak_of(row: pandas.Series) -> float | None:
    """Peak of a run that counts [Pa], or None."""
    counts = row["exit_code"] == 0 and not pandas.isna(row["peak_stress"])
    return float(row["peak_stress"]) if counts else None


def _peak(mean: pandas.Series, ending: str) -> tuple[float, float]:
    """Strain and stress of the mean peak or their scatter; nan for a test without them."""
    strain, stress = (mean.get(f"peak_{one}{ending}", math.nan) for one in ("strain", "stress"))
    return float(strain), float(stress)


def _curve(path: Path, names: Words) -> pandas.DataFrame | None:
    try:
        return pandas.read_csv(path, usecols=[names.x.column, names.y.column])
    except (OSError, ValueError):  # a run that failed before its first row
        return None


def _key_of(checkpoint: Path) -> str | None:
    """Return the key of the run of a checkpoint; None if it is unknown."""
    try:
        content = read_json(checkpoint)
        return RunSpec.from_json(content["inputs"]).key()
    except (OSError, ValueError, LookupError, TypeError, RecursionError, InputError):
        return None
