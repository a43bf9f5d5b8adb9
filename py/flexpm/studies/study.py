# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: many runs over tests, models, material keys and seeds, spread by Dask. SI units.

Each run is a process in a folder named by the key of its inputs. A study that was killed goes on
where it stopped; what is finished is not repeated, what failed is recorded.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pandas

from ..errors import InputError
from ..files import Table, load_toml, output_folder
from ..progress import Progress
from ..require import require_known
from . import jobs
from .jobs import Job
from .pool import Pool
from .tables import table, write_table

_TABLES = ("study", "common", "grid", "case", "picture")
_STUDY_KEYS = ("name", "title")


@dataclass(frozen=True)
class Study:
    """Runs of a study file, in the order of the file.

    Attributes:
        name: For captions.
        jobs: Each run once.
        pictures: Tables ``[[picture]]``.
    """

    name: str
    jobs: Sequence[Job]
    pictures: Sequence[Table] = field(default_factory=list)


def read(path: Path | str) -> Study:
    """Read a study file.

    ``[common]`` holds options of all runs, each ``[[case]]`` those of some runs, and ``[grid]``
    lists of values of which all combinations are run, for each case. Keys are the options of
    ``flexpm run``, with ``set.KEY`` for the material. Options that a test has no use for (a disc's
    width, say) are left out, and runs that are equal then are one.

    Raises:
        InputError: if the file cannot be read, or for an unknown key or a value out of range.
    """
    path = Path(path)
    content = load_toml(path, "study")
    for name in content:
        require_known("study table", name, _TABLES)
    about = content.get("study", {})
    for key in about:
        require_known("study [study] key", key, _STUDY_KEYS)
    made = [jobs.make(inputs, path.parent) for inputs in combinations(content)]
    distinct = {job.key: job for job in made}
    return Study(about.get("name", path.stem), [*distinct.values()], content.get("picture", []))


def run(
    study: Study,
    out: Path | str,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    cluster: str | None = None,
    progress: Progress | None = None,
) -> pandas.DataFrame:
    """Run what is not finished yet and write the table.

    Args:
        study: The runs.
        out: Folder of the study; ``runs/KEY`` are those of the runs. On a cluster all machines
            must see it under this name.
        workers: Runs at a time; None for one per core, or what the scheduler has.
        scheduler: Address of a running Dask scheduler.
        cluster: Kind of batch system: ``slurm``, ``pbs``, ``oar``, ... as in dask-jobqueue, which
            takes its settings from Dask's own configuration.
        progress: Called when a run has ended.

    Returns:
        One row a run: inputs, ``exit_code``, ``message``, measures. It is in ``table.csv``, too.
    """
    folder = output_folder(out)
    with Pool(folder / "runs", workers, scheduler, cluster) as pool:
        outcomes = pool.run(study.jobs, progress)
    rows = table(study.jobs, outcomes)
    write_table(rows, folder / "table")
    return rows


def combinations(content: Table) -> Iterator[Table]:
    """Inputs of each run that the tables of a study file ask for, in order."""
    common, grid = flat(content.get("common", {})), flat(content.get("grid", {}))
    for key, values in grid.items():
        if not (isinstance(values, list) and values):
            raise InputError(f"study [grid] {key} = {values!r}, must be a list of values")
    for case in content.get("case", [{}]):
        for values in itertools.product(*grid.values()):
            yield {**common, **dict(zip(grid, values, strict=True)), **flat(case)}


def flat(entries: Table) -> Table:
    """Entries with the keys of the table ``set`` as ``set.KEY``."""
    changes = entries.get("set", {})
    if not isinstance(changes, Mapping):
        raise InputError(
            f"study set = {changes!r}, must be a table; for example set.cohesion = 3e7"
        )
    plain = {key: value for key, value in entries.items() if key != "set"}
    return plain | {f"set.{key}": value for key, value in changes.items()}
