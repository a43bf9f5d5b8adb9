# SPDX-License-Identifier: GPL-3.0-or-later
"""Workers that run jobs, by Dask: of this machine, a running scheduler or a batch system."""

from __future__ import annotations

import logging
import os
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path
from subprocess import CompletedProcess
from typing import TYPE_CHECKING, Protocol, TypedDict

from ..errors import InputError
from ..files import Table
from ..progress import Progress
from ..require import Bounds, require_known, require_whole
from . import jobs
from .jobs import Task

if TYPE_CHECKING:
    from distributed import Client

_LOG = logging.getLogger("flexpm")
#: Most runs at a time for each core of this machine.
_MOST = 4


class PoolOptions(TypedDict, total=False):
    """Options of a pool by name."""

    workers: int | None  #: runs at a time; None for one per core, or what the scheduler has
    scheduler: str | None  #: address of a running Dask scheduler
    cluster: str | None  #: kind of batch system


def require_workers(workers: int, cores: int) -> None:
    """Refuse more runs at a time than this machine can bear: each is a process of its own.

    Raises:
        InputError: if there are more than a few for each core.
    """
    require_whole("workers", workers, Bounds(at_least=1))
    if workers > _MOST * cores:
        raise InputError(
            f"workers = {workers}, must be <= {_MOST * cores} on a machine of {cores} cores; use "
            "fewer, or a cluster"
        )


class _Cluster(Protocol):
    """Interface of the clusters of Dask and dask-jobqueue."""

    def scale(self, n: int) -> object: ...

    def close(self) -> object: ...


class Pool:
    """Runs jobs through Dask; a cluster is started when the first job needs it."""

    def __init__(
        self,
        folder: Path,
        workers: int | None = None,
        scheduler: str | None = None,
        cluster: str | None = None,
    ) -> None:
        """Take the options of a study; `folder` holds the folders of the jobs."""
        if scheduler is not None and cluster is not None:
            raise InputError(
                f"scheduler = {scheduler!r}, must not be given with cluster; leave out one of them"
            )
        if workers is not None and scheduler is None and cluster is None:
            require_workers(workers, len(os.sched_getaffinity(0)))
        self._folder, self._workers = folder.resolve(), workers
        self._scheduler, self._kind = scheduler, cluster
        self._client: Client | None = None
        self._cluster: _Cluster | None = None
        self._told = False

    def run(self, wanted: Sequence[Task], progress: Progress | None = None) -> list[Table]:
        """Outcomes of jobs in their order; those that have ended before are not run again."""
        known = {job.key: jobs.finished(job, self._folder) for job in wanted}
        outcomes = {key: outcome for key, outcome in known.items() if outcome is not None}
        waiting = [job for job in wanted if job.key not in outcomes]
        self._tell_outdated(waiting)
        report = progress or _silent
        done, failed = len(wanted) - len(waiting), 0
        report(done, len(wanted), "runs")
        for job, ended in self._ended(waiting):
            outcome = jobs.conclude(job, self._folder / job.folder, ended)
            outcomes[job.key] = outcome
            done, failed = done + 1, failed + (outcome["exit_code"] != 0)
            report(done, len(wanted), f"runs, {failed} failed" if failed else "runs")
        return [outcomes[job.key] for job in wanted]

    def _tell_outdated(self, waiting: Sequence[Task]) -> None:
        """Say once that there are finished runs of an older results number."""
        line = jobs.outdated(waiting, lambda key: jobs.known(self._folder / key) is not None)
        if line and not self._told:
            self._told = True
            _LOG.warning("flexpm: %s", line)

    def _ended(
        self, waiting: Sequence[Task]
    ) -> Iterator[tuple[Task, CompletedProcess[str] | BaseException]]:
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
                job.command(self._folder / job.folder, parent),
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

    def _started(self) -> Client:
        if self._client is None:
            from distributed import Client

            try:
                self._client = Client(self._scheduler or self._new_cluster())
            except (OSError, ValueError, TypeError) as error:
                if self._scheduler is None or isinstance(error, InputError):
                    raise
                raise InputError(
                    f"scheduler = {self._scheduler!r}, cannot be reached ({error}); give the "
                    "address of a running Dask scheduler"
                ) from None
        return self._client

    def _new_cluster(self) -> _Cluster:
        if self._kind is not None:
            cluster = self._cluster = _batch_cluster(self._kind)
            cluster.scale(self._workers or 1)
            return cluster
        from distributed import LocalCluster

        # workers only wait for processes, so threads do for them
        local: _Cluster = LocalCluster(
            n_workers=self._workers or len(os.sched_getaffinity(0)),
            threads_per_worker=1,
            processes=False,
            # any free port, as another study may run on this machine; workers have a page, too
            dashboard_address="127.0.0.1:0",
            worker_dashboard_address="127.0.0.1:0",
        )
        self._cluster = local
        return local

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *details: object) -> None:
        for part in (self._client, self._cluster):
            if part is not None:
                part.close()


def _batch_cluster(kind: str) -> _Cluster:
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
    require_known("cluster", kind, sorted(classes))
    cluster: _Cluster = classes[kind]()
    return cluster


def _silent(done: float, expected: float, text: str) -> None:
    """Show nothing."""
