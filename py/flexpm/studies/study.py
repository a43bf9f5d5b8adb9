# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: many runs over tests, models, material keys and seeds, distributed by Dask. SI units.

Each run is a process in a folder named by the key of its inputs. A study that was stopped resumes
at its unfinished runs. Finished runs are not repeated, and failed runs are recorded.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pandas

from ..errors import InputError
from ..files import Table, load_toml, output_folder
from ..progress import Progress
from ..require import require_known, require_list, require_table, require_tables, require_text
from . import jobs, picture_spec, scripts
from .jobs import Task
from .pool import Pool
from .scripts import Script, parameters
from .tables import table, write_table

__all__ = ["Study", "combinations", "flat", "of", "parameters", "read", "run"]

_TABLES = ("study", "common", "grid", "case", "picture")
#: Combinations of a study; more are a mistake in a list.
MOST_RUNS = 100_000
_STUDY_KEYS = ("name", "title", "script", "limit")


@dataclass(frozen=True)
class Study:
    """Runs of a study file, in the order of the file.

    Attributes:
        name: Name for captions.
        jobs: Each run once.
        pictures: Tables ``[[picture]]``.
    """

    name: str
    jobs: Sequence[Task]
    pictures: Sequence[Table] = field(default_factory=list)


def read(path: Path | str, seeds: Sequence[int] | None = None) -> Study:
    """Read a study file.

    Args:
        path: The file.
        seeds: Values of ``seed`` that replace the values of the file; None: the file's.

    ``[common]`` has options of all runs, each ``[[case]]`` options of some runs, and ``[grid]``
    lists of values. All combinations of these values are run, for each case. Keys are the options
    of ``flexpm run``, with ``set.KEY`` for the material. Options that a test does not use (such as
    a disc's width) are left out; runs that are equal afterwards are merged. With a ``script`` in
    ``[study]`` the keys are its parameters, with any names.

    Raises:
        InputError: if the file cannot be read, or for an unknown key or a value out of range.
    """
    path = Path(path)
    content = load_toml(path, "study")
    for name in content:
        require_known("study table", name, _TABLES)
    about = require_table("study [study]", content.get("study", {}))
    for key, text in about.items():
        require_known("study [study] key", key, _STUDY_KEYS)
        if key != "limit":
            require_text(f"study [study] {key}", text)
    if seeds is not None:
        content["grid"] = require_table("study [grid]", content.get("grid", {})) | {
            "seed": [*seeds]
        }
    asked_for = list(combinations(content))
    made = _made(asked_for, about, path.parent)
    distinct = {job.key: job for job in made}
    asked = require_tables("study [[picture]]", content.get("picture", []))
    inputs = {key for job in distinct.values() for key in job.inputs}
    pictures = [picture_spec.checked(picture, inputs) for picture in asked]
    return Study(about.get("name", path.stem), [*distinct.values()], pictures)


def _made(asked_for: Sequence[Table], about: Table, base: Path) -> Sequence[Task]:
    """Runs of tests, or of a script."""
    if "script" in about:
        script = Script(base / about["script"], limit=about.get("limit"))
        checksum = script.checksum()
        return [scripts.make(script, inputs, checksum) for inputs in asked_for]
    if "limit" in about:
        raise InputError(
            f"study [study] limit = {about['limit']} s, must not be given without script; leave it "
            "out"
        )
    made = [jobs.make(inputs, base) for inputs in asked_for]
    _require_use(asked_for, made)
    return made


def of(
    function: Callable[..., object],
    grid: Mapping[str, Sequence[object]],
    *,
    limit: float | None = None,
) -> Study:
    """Make a study of a function of a script: ``run(of(beam, {"seed": [1, 2]}), "folder")``.

    Each run is a process that imports the script and calls the function with ``out``, the folder of
    the run, and a combination of the parameters. Begin the study below
    ``if __name__ == "__main__":``.

    Args:
        function: Function at the top level of the script.
        grid: Values of each parameter; all combinations are run.
        limit: Wall time of a run [s]; None for no limit.

    Raises:
        InputError: for a function that another process cannot import, or that does not take these
            parameters.
    """
    scripts.refuse_within()
    content = {"grid": {key: [*values] for key, values in grid.items()}}
    made = scripts.of_function(function, list(combinations(content)), limit)
    return Study(function.__name__, [*{job.key: job for job in made}.values()])


def run(
    study: Study,
    out: Path | str,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    cluster: str | None = None,
    progress: Progress | None = None,
) -> pandas.DataFrame:
    """Run all unfinished runs and write the table.

    Args:
        study: The runs.
        out: Folder of the study; the runs are in ``runs/KEY``. On a cluster all machines
            must reach it under this name.
        workers: Number of simultaneous runs; None for one per core, or the scheduler's number.
        scheduler: Address of a running Dask scheduler.
        cluster: Type of the batch system: ``slurm``, ``pbs``, ``oar``, ... as in dask-jobqueue,
            which reads its settings from Dask's own configuration.
        progress: Function that is called when a run has ended.

    Returns:
        One row per run: inputs, ``exit_code``, ``message``, measures. ``table.csv`` has the same
        rows.
    """
    scripts.refuse_within()
    folder = output_folder(out)
    with Pool(folder / "runs", workers, scheduler, cluster) as pool:
        outcomes = pool.run(study.jobs, progress)
    rows = table(study.jobs, outcomes)
    write_table(rows, folder / "table")
    return rows


def _require_use(asked: Sequence[Table], made: Sequence[jobs.Job]) -> None:
    """Reject keys for models that the study does not have."""
    keys = {jobs.spelt(key) for inputs in asked for key in inputs}
    given = {key for key in keys if key.startswith("set.") or key == "interaction_range"}
    for key in sorted(given.difference(*(job.inputs for job in made))):
        raise InputError(f"study {key}, is used by no model of the study; leave it out")


def combinations(content: Table) -> Iterator[Table]:
    """Return the inputs of each run that the tables of a study file request, in order."""
    common = flat("study [common]", content.get("common", {}))
    grid = flat("study [grid]", content.get("grid", {}))
    for key, values in grid.items():
        if not require_list(f"study [grid] {key}", values):
            raise InputError(
                f"study [grid] {key} = [], must be a list of values; give at least one"
            )
    cases = require_tables("study [[case]]", content.get("case", [{}]))
    count = len(cases) * math.prod(map(len, grid.values()))
    if count > MOST_RUNS:
        raise InputError(f"study runs = {count}, must be <= {MOST_RUNS}; make several studies")
    for number, case in enumerate(cases, 1):
        own = flat(f"study [[case]] {number}", case)
        for values in itertools.product(*grid.values()):
            yield {**common, **dict(zip(grid, values, strict=True)), **own}


def flat(label: str, entries: object) -> Table:
    """Return a table with the keys of its table ``set`` as ``set.KEY``."""
    plain = require_table(label, entries)
    changes = require_table(f"{label} set", plain.pop("set", {}))
    return plain | dict(_dotted("set", changes))


def _dotted(prefix: str, entries: Table) -> Iterator[tuple[str, object]]:
    """Return the entries of a table and of its tables: keys of joints are joint.NAME.KEY."""
    for key, value in entries.items():
        if isinstance(value, dict):
            yield from _dotted(f"{prefix}.{key}", value)
        else:
            yield f"{prefix}.{key}", value
