# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm calibrate`: a material for a rock. SI units."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Unpack

import click

from ..errors import InputError, SimulationError
from ..materials.material import load
from ..materials.mixing import value_of
from ..report import tables
from ..require import quoted
from ..text import name_of
from . import inputs, terminal
from . import options as cli_options
from .parameters import Name

if TYPE_CHECKING:
    from ..studies.pool import PoolOptions


def _write_calibration(
    file: Path | None, rock: str, model: str | None, shape: str | None, out: Path | None
) -> None:
    """Write the file of a calibration for a rock."""
    if file is not None:
        raise InputError(
            f"FILE = {quoted(str(file))}, must not be given with --new; give the new file as --out"
        )
    if out is None:
        raise InputError("--out is missing; give the file that --new writes, such as my-rock.toml")
    from ..studies.proposals import written

    made = written.write(rock, out, model or "flexible", shape or "rectangle")
    terminal.say(f"{name_of(made.plan.name)}, {made.plan.model} model, written for {name_of(rock)}")
    for line in written.lines(made):
        terminal.say(line)


@click.command(short_help="Fit a material to a rock.")
@click.argument("file", type=click.Path(path_type=Path), metavar="[FILE]", required=False)
@click.option(
    "--new",
    "rock",
    metavar="ROCK",
    help="Only write the file of a calibration for a rock or rock file (TOML), as --out FILE.toml, "
    "and print how many runs it takes.",
)
@click.option(
    "--model",
    type=Name("flexible", "rigid"),
    metavar="flexible|rigid",
    help="With --new: model.  [default: flexible]",
)
@click.option(
    "--shape",
    type=Name("rectangle", "box", "cylinder"),
    metavar="rectangle|box|cylinder",
    help="With --new: shape of the compressed specimens.  [default: rectangle]",
)
@cli_options.many_runs_out_option
@cli_options.pool_options
@cli_options.report_option
@cli_options.quiet_option
def calibrate(
    file: Path | None,
    rock: str | None,
    model: str | None,
    shape: str | None,
    out: Path | None,
    quiet: bool,
    report: bool,
    **options: Unpack[PoolOptions],
) -> None:
    """Find the material that meets the targets of FILE; write it as a preset, with a figure."""
    if rock is not None:
        for name, value in options.items():
            if value is not None:
                raise InputError(
                    f"--{name} = {value}, must not be given with --new, which runs no test; leave "
                    "it out"
                )
        _write_calibration(file, rock, model, shape, out)
        return
    for name, given in (("model", model), ("shape", shape)):
        if given is not None:
            raise InputError(
                f"--{name} = {given}, must be given with --new only; write it into the file"
            )
    if file is None:
        raise click.UsageError("Missing argument 'FILE', or --new ROCK to write one.")
    from ..studies import (
        calibration_problem,
        calibration_report,
        calibration_search,
        calibration_verdict,
        pages,
    )

    plan = calibration_problem.read(file)
    start = load(plan.material_file, plan.model, solid=plan.is_solid)
    values = {key: value_of(start, key, plan.model) for key in plan.free}
    for key, (low, high) in plan.free.items():
        value = values[key]
        if isinstance(value, int | float) and not low <= value <= high:
            terminal.say(
                f"{key} = {value:g} in the material, starts at {min(max(value, low), high):g}"
            )
    folder = inputs.locked_folder(out or Path(file.stem), "calibrate")
    calibration_verdict.forget(folder)
    with terminal.Progress(quiet, unit="sets") as progress:
        found = calibration_search.run(plan, folder, start=values, progress=progress, **options)
    preset, picture = folder / f"{plan.name}.toml", folder / "calibration.png"
    calibration_report.write_preset(preset, start, plan, found)
    calibration_report.picture(picture, plan, found)
    found.verdict.write(folder)
    if report:
        pages.write(folder)
    terminal.say(
        tables.table(
            calibration_report.table_rows(plan, found), f"{name_of(plan.name)}, {plan.model} model"
        )
    )
    for line in found.verdict.lines():
        terminal.say(f"  {line}")
    terminal.say(f"  files  {preset}, {picture}, {folder / 'history.csv'}")
    missed = [name for name, met in found.met.items() if not met]
    if missed:
        raise SimulationError(
            f"targets = {', '.join(missed)}, not met; see {picture}, and change the targets or "
            "free more keys"
        )
