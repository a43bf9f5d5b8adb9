# SPDX-License-Identifier: GPL-3.0-or-later
"""Scorecards of materials, as scripts make them. SI units."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict, Unpack

from ...errors import InputError
from ...files import FolderLock, Table, output_folder
from ...materials.material import load as load_material
from ...progress import Progress
from ...require import quoted, require_known, require_whole
from ...runs.output import refuse_other_kind
from .. import jobs
from ..pool import Pool
from ..tables import table as runs_table
from ..tables import write_table
from . import output, rock, runs
from .runs import Plan, Size
from .verdict import NOT_KNOWN, NOT_MET, Row, judge_all

#: Seeds that no calibration of a preset has used.
SEEDS = (41, 42, 43, 44, 45)


class ScorecardOptions(TypedDict, total=False):
    """Keywords of `scorecard`."""

    model: str | None
    shape: str | None
    seeds: Sequence[int]
    size: str | Size
    rock: Path | str | None
    report: bool
    progress: Progress | None
    workers: int | None
    scheduler: str | None
    cluster: str | None


@dataclass(frozen=True)
class Scorecard:
    """A material beside a rock.

    Attributes:
        plan: Material, rock, model, specimens and seeds.
        rows: A row for each measure.
        pairs: Shares of cracks in compression by pair of minerals; empty without minerals.
        lost: Runs that diverged or failed without a result: seed, name and message of each.
    """

    plan: Plan
    rows: Sequence[Row]
    pairs: Sequence[Table]
    lost: Sequence[str] = ()

    @property
    def runs(self) -> int:
        """Number of runs."""
        return sum(map(len, self.plan.jobs.values()))

    @property
    def missed(self) -> list[str]:
        """Names of the measures that decide and are not met."""
        return output.names_of(self.rows, NOT_MET)

    @property
    def unknown(self) -> list[str]:
        """Names of the measures that decide and are not known."""
        return output.names_of(self.rows, NOT_KNOWN)

    @property
    def failed(self) -> list[str]:
        """Names of the measures that decide and are not met, or not known with full specimens."""
        return output.failed(self.rows, full=self.plan.size.full)

    def row(self, measure: str) -> Row:
        """Return the row of a measure by its name.

        Raises:
            InputError: for an unknown name.
        """
        rows = {one.measure.name: one for one in self.rows}
        require_known("scorecard: measure", measure, [*rows])
        return rows[measure]

    def __str__(self) -> str:
        return output.table(self.plan, self.rows, self.pairs)


def scorecard(
    material: Path | str, out: Path | str = "scorecard", **options: Unpack[ScorecardOptions]
) -> Scorecard:
    """Run laboratory tests with a material, and compare the results with measured values of a rock.

    The runs are those of a study: finished runs are not repeated, interrupted runs resume.

    Args:
        material: Name of a preset, or TOML file.
        out: Folder for ``scorecard.json``, ``scorecard.csv``, ``scorecard.png``, ``report.html``,
            ``runs.csv`` and the runs.
        options: By these names:

            - ``model``: ``flexible`` or ``rigid``. Default: the model of the material's
              calibration.
            - ``shape``: ``rectangle``, ``box`` or ``cylinder``. Default: by the dimension of the
              material's calibration.
            - ``seeds``: seeds of the packings. Default: 41 to 45.
            - ``size``: ``small`` or ``full``. Default: ``small``.
            - ``rock``: name of a rock or TOML file. Default: the rock that the material is named
              after.
            - ``report``: whether to write the report. Default: True.
            - ``progress``: function that is called with (runs done, runs expected, text).
            - ``workers``, ``scheduler``, ``cluster``: as for a study.

    Returns:
        ``rows`` with ``mean``, ``verdict`` and ``reasons``, ``row(name)``; the names of measures
        that decide and are ``missed`` or ``unknown``, ``failed``, and the runs that are ``lost``.

    Raises:
        InputError: for an unknown material, rock or option, or a folder with other results.

    Example:
        A material file beside Augig granite::

            found = flexpm.scorecard("my-rock/my-rock.toml", "card", rock="augig", seeds=[41])
            print(found.row("compressive_strength").mean, found.missed, found.unknown)
    """
    made = plan_of(material, options)
    folder = output_folder(out)
    refuse_other_kind(folder, "scorecard")
    lock = FolderLock(folder)
    try:
        return carry_out(made, folder, options)
    finally:
        lock.release()


def plan_of(material: Path | str, options: ScorecardOptions) -> Plan:
    """Check what was asked for, before anything runs.

    Raises:
        InputError: for a value that is wrong.
    """
    for name in options:
        require_known("scorecard: option", name, [*ScorecardOptions.__annotations__])
    loaded = load_material(material)
    made = runs.plan(
        loaded,
        str(material),
        model=options.get("model"),
        shape=options.get("shape"),
        seeds=_seeds(options.get("seeds")),
        size=options.get("size", "small"),
        rock=rock.load(options.get("rock"), loaded.name),
    )
    _ = made.jobs  # refuses what no run could do
    return made


def _seeds(given: object) -> tuple[int, ...]:
    """Seeds as whole numbers; None: the usual ones."""
    if given is None:
        return SEEDS
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise InputError(
            f"scorecard: seeds = {quoted(given)}, must be whole numbers in a list; put them in "
            "brackets"
        )
    return tuple(require_whole("scorecard: seeds", one) for one in given)


def foresight(plan: Plan, folder: Path) -> str:
    """Say how many runs a scorecard has, how many are finished, and how large they are."""
    wanted = [job for of_packing in plan.jobs.values() for job in of_packing.values()]
    done = sum(jobs.finished(job, folder / "runs") is not None for job in wanted)
    grains = float(f"{plan.grains:.2g}")
    return (
        f"{len(wanted)} runs, {done} of them finished; about {grains:g} grains in each compressed "
        "specimen"
    )


def carry_out(plan: Plan, folder: Path, options: ScorecardOptions) -> Scorecard:
    """Carry out the unfinished runs and write all files.

    Args:
        plan: Material, rock, model, specimens and seeds.
        folder: Folder of the scorecard, which exists.
        options: Keywords of `scorecard`.
    """
    by_seed = plan.jobs
    wanted = [job for of_packing in by_seed.values() for job in of_packing.values()]
    place = folder / "runs"
    chosen = {name: options.get(name) for name in ("workers", "scheduler", "cluster")}
    with Pool(place, **chosen) as pool:  # type: ignore[arg-type]  # by their names
        outcomes = pool.run(wanted, options.get("progress"))
    write_table(runs_table(wanted, outcomes), folder / "runs")
    told = iter(outcomes)
    packings = [
        {name: runs.ended(next(told), place / job.folder) for name, job in of_packing.items()}
        for of_packing in by_seed.values()
    ]
    values = [runs.values_of(one, solid=plan.solid) for one in packings]
    rows = judge_all(values, plan.rock.entries, full=plan.size.full)
    pairs = runs.pairs_of(packings)
    output.write(folder, plan, rows, pairs)
    if options.get("report", True):
        from .. import pages  # what draws them loads long

        pages.write(folder)
    lost = [
        f"seed {seed} {name}: {' '.join(one.message.split())}"
        for seed, of_packing in zip(by_seed, packings, strict=True)
        for name, one in of_packing.items()
        if one.message and (one.result is None or one.result.status == "diverged")
    ]
    return Scorecard(plan, rows, pairs, lost)
