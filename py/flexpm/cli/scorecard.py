# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm scorecard`: a material beside a rock. SI units."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..errors import SimulationError
from . import inputs, terminal
from . import options as cli_options
from .parameters import Name, Seeds


@click.command(short_help="Compare a material with a rock, test by test.")
@click.argument("material", metavar="MATERIAL")
@click.option(
    "--model",
    type=Name("flexible", "rigid"),
    metavar="flexible|rigid",
    help="Model.  [default: the model of the material's calibration, else flexible]",
)
@click.option(
    "--shape",
    type=Name("rectangle", "box", "cylinder"),
    metavar="rectangle|box|cylinder",
    help="Shape of the compressed specimens.  [default: rectangle; box for a material that was "
    "calibrated in 3D]",
)
@click.option(
    "--seeds",
    type=Seeds(),
    default="41-45",
    metavar="N-M,...",
    show_default=True,
    help="Seeds of the packings.",
)
@click.option(
    "--size",
    type=Name("small", "full"),
    default="small",
    metavar="small|full",
    show_default=True,
    help="Size of the specimens. With small specimens at twice the loading rate some measures are "
    "not judged.",
)
@click.option(
    "--rock",
    metavar="NAME|FILE",
    help="Rock or rock file (TOML).  [default: the rock that the material is named after]",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=Path("scorecard"),
    metavar="DIR",
    show_default=True,
    help="Folder for the files.",
)
@cli_options.pool_options
@cli_options.report_option
@cli_options.quiet_option
def scorecard(material: str, out: Path, quiet: bool, **options: Any) -> None:
    """Run laboratory tests with MATERIAL, a preset or a TOML file, and judge them by a rock.

    Writes a table, a figure and a report. Finished runs are not repeated. The exit code is 3 if a
    measure that decides is not met, if with full specimens it is not known, or if a run failed.
    """
    from ..studies.scorecards import card

    plan = card.plan_of(material, options)  # type: ignore[arg-type]  # the same names
    folder = inputs.locked_folder(out, "scorecard")
    terminal.say(card.foresight(plan, folder))
    with terminal.Progress(quiet, unit="runs") as progress:
        given: Any = {**options, "progress": progress}
        found = card.carry_out(plan, folder, given)
    terminal.say(str(found))
    for line in found.lost:
        terminal.say(f"failed: {line}")
    terminal.say(f"  files  {folder}/")
    unknown = [name for name in found.unknown if name in found.failed]
    causes = [
        f"measures = {', '.join(names)}, {verdict}"
        for names, verdict in ((found.missed, "not met"), (unknown, "not known"))
        if names
    ]
    if found.lost:
        causes.append(f"runs = {len(found.lost)} of {found.runs} failed")
    if causes:
        raise SimulationError(f"{'; '.join(causes)}; see {folder / 'scorecard.csv'}")
