# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm compare`: several models or confinements on one packing. SI units."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..errors import InputError, SimulationError
from ..files import output_folder
from ..materials.keys import ELASTIC_SET, check_name
from ..report import tables
from . import inputs as cli_library
from . import options as cli_options
from . import terminal
from .options import Each, Name, Quantity


@click.command(short_help="Several models on one packing.")
@click.argument("test", metavar="TEST")
@click.option(
    "--models",
    type=Each(Name(*ELASTIC_SET)),
    default="flexible,rigid",
    metavar="NAME,...",
    show_default=True,
    help="Models to compare.",
)
@click.option(
    "--confinements",
    type=Each(Quantity("Pa", at_least=0.0)),
    default="0",
    metavar="PA,...",
    show_default=True,
    help="Lateral pressures [Pa], for biaxial; two or more give c, phi, sigma_ci and m_i.",
)
@cli_options.material_options
@cli_options.rectangle_options
@cli_options.disc_options
@cli_options.packing_options
@cli_options.loading_options
@cli_options.threads_option
@cli_options.out_option
@cli_options.quiet_option
def compare(
    test: str, models: tuple, confinements: tuple, out: Path, quiet: bool, **options: Any
) -> None:
    """Run a test with several models on one packing: one table, one picture.

    TEST is as for run. Each model takes its default material unless one is given. Each run has a
    folder of its own below the output folder; what is finished there is not run again.
    """
    check_name("test", test, cli_options.TESTS)
    if test != "biaxial" and any(confinements):
        raise InputError(
            f"confinements = {max(confinements):g} Pa, must be 0 for {test}; use biaxial"
        )
    chosen = {model: cli_library.material(options, model) for model in models}
    folder = output_folder(out)
    cli_library.load_yade()
    from ..laboratory import protocols
    from ..models.grains import MODELS
    from ..studies import comparison

    for model in models:
        cli_library.require("model", model, MODELS)
        cli_library.require("test", test, protocols.tests_of(model))
    with terminal.Progress(quiet) as progress:
        found = comparison.compare(
            test,
            cli_library.specimen_for(test, options, progress),
            models,
            chosen,
            confinements=confinements,
            points=int(options["points"]),
            out=folder,
            progress=progress,
            mesh=options["mesh"],
            threads=options["threads"],
            **{name: options[name] for name in cli_options.LOADING},
        )
    click.echo(comparison.table(found.cases))
    if found.envelopes:
        click.echo(tables.envelope_table(found.envelopes, found.reference))
    click.echo(f"  files  {folder}/")
    _report_failures(found.cases)


def _report_failures(cases: Any) -> None:
    failed = [case for case in cases if case.failed]
    if failed:
        names = ", ".join(case.name for case in failed)
        why = next((f"; {case.error}" for case in failed if case.error), "")
        raise SimulationError(f"runs = {names}, found no strength{why}; the others are complete")
