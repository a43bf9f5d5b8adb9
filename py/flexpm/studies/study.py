# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: many runs over tests, models, material keys and seeds, spread by Dask. SI units.

Each run is a process in a folder named by a hash of its inputs. A study that was killed goes on
where it stopped; what is finished is not repeated, what failed is recorded.
"""

from __future__ import annotations

import itertools
import os
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas

from ..errors import InputError
from ..files import load_toml, output_folder, whole_file
from ..materials.keys import check_name
from ..progress import Progress
from . import jobs
from .jobs import Job

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
    pictures: Sequence[Mapping[str, Any]] = field(default_factory=list)


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
    for table in content:
        check_name("study table", table, _TABLES)
    about = content.get("study", {})
    for key in about:
        check_name("study [study] key", key, _STUDY_KEYS)
    made = [jobs.make(inputs, path.parent) for inputs in combinations(content)]
    distinct = {job.name: job for job in made}
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
        out: Folder of the study; ``runs/HASH`` are those of the runs. On a cluster all machines
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


class Pool:
    """Runs jobs through Dask; a cluster is started when the first job needs it."""

    def __init__(
        self,
        folder: Path,
        workers: int | None = None,
        scheduler: str | None = None,
        cluster: str | None = None,
    ) -> None:
        """Take the options of :func:`run`; `folder` holds the folders of the jobs."""
        if scheduler is not None and cluster is not None:
            raise InputError(
                f"scheduler = {scheduler!r}, must not be given with cluster; leave one out"
            )
        self._folder, self._workers = folder.resolve(), workers
        self._scheduler, self._kind = scheduler, cluster
        self._client: Any = None
        self._cluster: Any = None

    def run(self, wanted: Sequence[Job], progress: Progress | None = None) -> list[dict[str, Any]]:
        """Outcomes of jobs in their order; those that have ended before are not run again."""
        outcomes = {job.name: jobs.known(self._folder / job.name) for job in wanted}
        waiting = [job for job in wanted if outcomes[job.name] is None]
        report = progress or _silent
        done, failed = len(wanted) - len(waiting), 0
        report(done, len(wanted), "runs")
        for job, ended in self._ended(waiting):
            outcome = jobs.conclude(job, self._folder / job.name, ended)
            outcomes[job.name] = outcome
            done, failed = done + 1, failed + (outcome["exit_code"] != 0)
            report(done, len(wanted), f"runs, {failed} failed" if failed else "runs")
        return [outcomes[job.name] for job in wanted]

    def _ended(self, waiting: Sequence[Job]) -> Iterator[tuple[Job, Any]]:
        """Jobs with the processes they were, or the error of a worker, as they end."""
        if not waiting:
            return
        from distributed import as_completed

        client = self._started()
        parent = Path(__file__).parents[2].absolute()
        # a function of the standard library: workers need not import flexpm
        futures = {
            client.submit(
                subprocess.run,
                job.command(self._folder / job.name, parent),
                capture_output=True,
                text=True,
                stdin=subprocess.DEVNULL,
                pure=False,
            ): job
            for job in waiting
        }
        for future in as_completed(futures):
            error = future.exception()
            yield futures[future], error if error is not None else future.result()

    def _started(self) -> Any:
        if self._client is None:
            from distributed import Client

            self._client = Client(self._scheduler or self._new_cluster())
        return self._client

    def _new_cluster(self) -> Any:
        if self._kind is not None:
            self._cluster = _batch_cluster(self._kind)
            self._cluster.scale(self._workers or 1)
            return self._cluster
        from distributed import LocalCluster

        # workers only wait for processes, so threads do for them
        self._cluster = LocalCluster(
            n_workers=self._workers or len(os.sched_getaffinity(0)),
            threads_per_worker=1,
            processes=False,
            # any free port: another study may run on this machine
            dashboard_address="127.0.0.1:0",
        )
        return self._cluster

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *details: object) -> None:
        for part in (self._client, self._cluster):
            if part is not None:
                part.close()


def table(wanted: Sequence[Job], outcomes: Sequence[Mapping[str, Any]]) -> pandas.DataFrame:
    """One row a job: hash, inputs, exit code, message, measures."""
    return pandas.DataFrame(
        {
            "hash": job.name,
            **{key: _cell(value) for key, value in job.inputs.items()},
            "exit_code": outcome["exit_code"],
            "message": outcome["message"],
            **outcome["result"],
        }
        for job, outcome in zip(wanted, outcomes, strict=True)
    ).convert_dtypes(convert_string=False)


def write_table(rows: pandas.DataFrame, stem: Path) -> None:
    """Write a table as CSV, and as Parquet if pandas finds a library for it."""
    with whole_file(stem.with_suffix(".csv")) as temporary:
        rows.to_csv(temporary, index=False)
    try:
        with whole_file(stem.with_suffix(".parquet")) as temporary:
            rows.to_parquet(temporary)
    except ImportError:
        pass  # neither pyarrow nor fastparquet is in Debian 12


def combinations(content: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Inputs of each run that the tables of a study file ask for, in order."""
    common, grid = flat(content.get("common", {})), flat(content.get("grid", {}))
    for key, values in grid.items():
        if not (isinstance(values, list) and values):
            raise InputError(f"study [grid] {key} = {values!r}, must be a list of values")
    for case in content.get("case", [{}]):
        for values in itertools.product(*grid.values()):
            yield {**common, **dict(zip(grid, values, strict=True)), **flat(case)}


def flat(entries: Mapping[str, Any]) -> dict[str, Any]:
    """Entries with the keys of the table ``set`` as ``set.KEY``."""
    changes = entries.get("set", {})
    if not isinstance(changes, Mapping):
        raise InputError(
            f"study set = {changes!r}, must be a table; for example set.cohesion = 3e7"
        )
    plain = {key: value for key, value in entries.items() if key != "set"}
    return plain | {f"set.{key}": value for key, value in changes.items()}


def _cell(value: Any) -> Any:
    return " ".join(map(str, value)) if isinstance(value, list) else value


def _batch_cluster(kind: str) -> Any:
    try:
        import dask_jobqueue
    except ImportError:
        raise InputError(
            f"cluster = {kind!r}, needs the package dask-jobqueue; install it with pip"
        ) from None
    classes = {
        name.removesuffix("Cluster").lower(): value
        for name, value in vars(dask_jobqueue).items()
        if name.endswith("Cluster")
    }
    check_name("cluster", kind, sorted(classes))
    return classes[kind]()


def _silent(done: float, expected: float, text: str) -> None:
    """Show nothing."""
