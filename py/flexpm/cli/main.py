# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm` with its subcommands. SI units; one line for each error.

Exit codes: 0 done, 1 the installation or the machine is not usable, 2 wrong input, 3 a simulation
failed, 130 interrupted, 143 terminated (129 if its terminal was closed).
"""

from __future__ import annotations

import contextlib
import errno
import os
import signal
import sys
import traceback
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import shell_complete

from .._version import __version__
from ..errors import InputError, SimulationError
from ..files import json_text, require_writable, write_text
from ..renamed import with_old_keys
from ..report import tables
from ..require import nearest
from ..runs.output import ROSE
from ..text import name_of
from . import calibrate as cli_calibrate
from . import compare as cli_compare
from . import images as cli_images
from . import inputs, runs, signals, terminal
from . import options as cli_options
from . import scorecard as cli_scorecard
from . import solids as cli_solids
from . import volumes as cli_volumes
from .parameters import Count

if TYPE_CHECKING:
    from ..specimens.specimen import Specimen


#: Set it to any text to see tracebacks.
_DEBUG = "FLEXPM_DEBUG"
#: Characters of an error that nobody has foreseen.
_LONGEST = 300
#: Errors of files and folders that the user has named; those of the machine are others.
_NAMED = (
    *(errno.ENOENT, errno.EACCES, errno.EPERM, errno.EISDIR, errno.ENOTDIR, errno.EEXIST),
    *(errno.ENAMETOOLONG, errno.ELOOP, errno.EROFS),
)
#: Errors of our own Python, although they derive from RuntimeError.
_OURS = (RecursionError, NotImplementedError)


class Commands(click.Group):
    """Group that answers an unknown command with the nearest known command."""

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        """Find the command, or raise InputError with the nearest known command."""
        if args and self.get_command(ctx, args[0]) is None and not args[0].startswith("-"):
            known = self.list_commands(ctx)
            raise InputError(
                f"command = {args[0]!r}, unknown{nearest(args[0], known)}; "
                f"known are {', '.join(known)}"
            )
        return super().resolve_command(ctx, args)


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, message="flexpm %(version)s")
def command() -> None:
    """Flexible particle model of rock for YADE (Azevedo, Farinha and Oliveira 2022).

    All quantities are in SI units.
    """


@command.group(cls=Commands, short_help="Make a specimen without a test.")
def specimen() -> None:
    """Make a specimen without a test, its plot and its statistics."""


@specimen.command()
@cli_options.rectangle_options
@cli_options.packing_options
@cli_options.cut_options
@cli_options.drawn_mesh_option
@cli_options.out_option
@cli_options.quiet_option
def rectangle(out: Path, quiet: bool, mesh: str | None, **options: Any) -> None:
    """Make a rectangular specimen, as in compression tests."""
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet) as progress:
        made = inputs.made_plane(inputs.packed("rectangle", options), progress)
    _describe(made, folder, mesh)


@specimen.command()
@cli_options.disc_options
@cli_options.packing_options
@cli_options.cut_options
@cli_options.drawn_mesh_option
@cli_options.out_option
@cli_options.quiet_option
def disc(out: Path, quiet: bool, mesh: str | None, **options: Any) -> None:
    """Make a disc, as in Brazilian tests."""
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet) as progress:
        made = inputs.made_plane(inputs.packed("disc", options), progress)
    _describe(made, folder, mesh)


specimen.add_command(cli_images.image)
specimen.add_command(cli_images.ebsd)
specimen.add_command(cli_images.tess)
specimen.add_command(cli_volumes.volume)
specimen.add_command(cli_volumes.table)
specimen.add_command(cli_solids.box)
specimen.add_command(cli_solids.cylinder)
specimen.add_command(cli_solids.solid_disc)
specimen.add_command(cli_solids.solid_half_disc)


@command.command(short_help="Time a step of each model.")
@click.option(
    "--steps",
    type=Count(1),
    default=2000,
    metavar="N",
    show_default=True,
    help="Steps to time for each model.",
)
@cli_solids.bench_options
@cli_options.rectangle_options
@cli_options.seed_option
@cli_options.threads_option
@click.option(
    "--scaling",
    is_flag=True,
    help="Time also 10 and 40 times the number of grains; with --shape box 7 times the number.",
)
@click.option(
    "--large",
    is_flag=True,
    help="With --scaling --shape box: time also 55 times the number of grains, whose packing takes "
    "minutes.",
)
@click.option(
    "--json",
    "json_file",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="Write the times also to this file.",
)
@cli_options.quiet_option
def bench(quiet: bool, json_file: Path | None, **options: Any) -> None:
    """Time a step of flexpm's models and of YADE's JCFpm and CohFrict on the same specimen.

    With --shape box the models of 3D specimens, with the time of the set-up and the memory.

    scripts/studies/lammps_bench.py times the bonded particles of LAMMPS, too.
    """
    if json_file is not None:
        require_writable(json_file)
    inputs.load_yade()
    from ..bench import timing

    with terminal.Progress(quiet) as progress:
        rows = timing.run(timing.Plan(**options), json_file, progress)
    terminal.say(tables.table(rows))


@command.command(short_help="Run all combinations of parameters in a file.")
@cli_options.many_runs_options
@cli_options.study_seeds_option
def study(file: Path, out: Path | None, quiet: bool, report: bool, **options: Any) -> None:
    """Carry out the unfinished runs of FILE; write a table and figures of all runs."""
    from ..studies import figures, pages
    from ..studies import study as studies

    plan = studies.read(file, options.pop("seeds"))
    folder = inputs.locked_folder(out or Path(file.stem), "study")
    with terminal.Progress(quiet, unit="runs") as progress:
        rows = studies.run(plan, folder, progress=progress, **options)
    pictures = figures.draw(plan, rows, folder)
    if report:
        pages.write(folder)
    failed = rows[rows["exit_code"] != 0]
    for _, row in failed.iterrows():
        terminal.say(f"failed: runs/{row['key']}: {' '.join(str(row['message']).split())}")
    terminal.say(f"{name_of(plan.name)}: {len(rows)} runs, {len(failed)} failed")
    terminal.say(f"  files  {', '.join(map(str, [folder / 'table.csv', *pictures]))}")
    if len(failed):
        raise SimulationError(f"runs = {len(failed)} of {len(rows)} failed; see the table")


@command.command(short_help="Rebuild report.html from the files of a run.")
@click.argument("folder", type=click.Path(path_type=Path), metavar="DIR")
def report(folder: Path) -> None:
    """Rebuild report.html in DIR, the folder of a run, compare, study, calibrate or
    scorecard.

    The report opens in any browser, without a network connection. It has inputs, results, curves,
    maps and warnings. For a run that is in progress or was stopped it has the results up to now.
    """
    from ..studies import pages

    if pages.has_ended(pages.require_results(folder)):
        inputs.locked_folder(folder)
    terminal.say(f"  files  {pages.write(folder)}")


@command.command()
@click.pass_context
def doctor(ctx: click.Context) -> None:
    """Check the installation: YADE, class layouts, libraries."""
    from .doctor import checks

    sound = True
    with signals.waiting():  # a check loads YADE
        found = list(checks())
    for name, ok, text in found:
        terminal.say(f"{'ok  ' if ok else 'FAIL'}  {name}: {text}")
        sound = sound and ok
    ctx.exit(0 if sound else 1)


for _one in (
    *(cli_compare.compare, cli_calibrate.calibrate, cli_scorecard.scorecard),
    *(runs.run, runs.rerun, runs.elastic),
):
    command.add_command(_one)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with `arguments` (None: arguments of the process); return its exit code."""
    terminal.prepare()
    os.environ["MPLBACKEND"] = "agg"  # pictures are files; a wrong name would stop the import
    signals.received.clear()
    given = list(sys.argv[1:] if arguments is None else arguments)
    if asked := os.environ.get("_FLEXPM_COMPLETE"):  # by the shell, for what may follow
        return shell_complete(command, {}, "flexpm", "_FLEXPM_COMPLETE", asked)
    try:
        signals.catch_signals()
        with _no_warnings(), command.make_context("flexpm", given) as context:
            command.invoke(context)
        return 0
    except click.exceptions.Exit as request:
        return request.exit_code
    except SystemExit:
        raise
    except BaseException as error:
        if os.environ.get(_DEBUG):
            traceback.print_exc()
        return _answer(error)


@contextlib.contextmanager
def _no_warnings() -> Iterator[None]:
    """Hide warnings of libraries unless the program is debugged."""
    with warnings.catch_warnings():
        if not os.environ.get(_DEBUG):
            warnings.simplefilter("ignore")
        yield


def _answer(error: BaseException) -> int:
    """Print the reason why the command ended in one line, and return the exit code."""
    asked = [number for number in signals.received if number != signal.SIGINT]
    if isinstance(error, signals.Terminated) or asked:
        number = asked[0] if asked else signal.SIGTERM
        return _failed("terminated; files that were written are whole", 128 + number)
    if isinstance(error, click.Abort | KeyboardInterrupt) or signals.received:
        return _failed("interrupted; files that were written are whole", 130)
    if isinstance(error, click.NoSuchOption):
        hint = nearest(error.option_name, error.possibilities or [])
        return _failed(f"option = {error.option_name!r}, unknown{hint}; see --help", 2)
    if isinstance(error, click.ClickException):
        return _failed(error.format_message(), 2)
    if isinstance(error, InputError):
        return _failed(error, 2)
    if isinstance(error, SimulationError):
        return _failed(error, 3)
    if isinstance(error, BrokenPipeError) and error.filename is None:  # nobody reads the help
        terminal.drop_output()
        return 0
    if isinstance(error, OSError):
        return _failed(error, 2 if error.errno in _NAMED else 1)
    if isinstance(error, ImportError):
        return _failed(error, 1)
    if isinstance(error, MemoryError):
        return _failed("memory = exhausted; take a smaller specimen or another machine", 1)
    if isinstance(error, RuntimeError | ArithmeticError) and not isinstance(error, _OURS):
        # the compiled part and YADE say so; numbers beyond the range of a double do, too
        return _failed(f"simulation failed: {error}; check the values of material and test", 3)
    about = f"{type(error).__name__}: {str(error)[:_LONGEST]}"
    return _failed(f"internal error: {about}; set {_DEBUG}=1 for the traceback", 1)


def _failed(text: object, code: int) -> int:
    terminal.error_line(str(text).removeprefix("flexpm: "))
    return code


def _describe(made: Specimen, folder: Path, mesh: str | None) -> None:
    """Print the statistics of a specimen and write them with its picture."""
    from ..report import maps

    found = made.statistics()
    write_text(folder / "specimen.json", json_text(with_old_keys(found)))
    caption = f"{found['grains']} grains, {found['contacts']} contacts"
    picture = folder / "specimen.png"
    triangles = maps.mesh_triangles(made.meshes(mesh)) if mesh else None
    polygons = maps.cell_polygons(made.tessellation)
    joints, names = made.joint_lines(), made.spec.joint_names or ()
    maps.specimen_picture(picture, polygons, triangles, caption, joints, names)
    files = [picture, folder / "specimen.json"]
    if made.spec.networks:
        from ..report.rose import rose_picture

        files.append(folder / ROSE)
        rose_picture(files[-1], made)
    terminal.say(tables.statistics_table(found))
    terminal.say(f"  files  {', '.join(map(str, files))}")
