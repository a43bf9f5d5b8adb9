# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm compare`: several models or confinements on one packing. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..dimensions import is_solid
from ..errors import InputError, SimulationError
from ..kinds.registry import TESTS, kind_of, names
from ..materials.material import default_name
from ..models.options import MODELS
from ..report import tables
from ..require import NOT_NEGATIVE, require_known
from ..runs.input_names import SIMULATION, ranges
from ..studies.jobs import place_of
from . import inputs, packings, terminal
from . import options as cli_options
from .parameters import Each, Name, Quantity
from .solids import shape_options

#: Options that all runs share, as ``flexpm.compare`` has them.
_SHARED = tuple(name for name in SIMULATION if name not in ("model", "points", "confinement"))

if TYPE_CHECKING:
    from ..studies.comparison import Case


@click.command(short_help="Compare several models on the same packings.")
@click.argument("test", metavar="TEST")
@click.option(
    "--models",
    type=Each(Name(*MODELS)),
    default="flexible,rigid",
    metavar="NAME,...",
    show_default=True,
    help="Models to compare.",
)
@click.option(
    "--confinements",
    type=Each(Quantity("Pa", NOT_NEGATIVE)),
    default="0",
    metavar="PA,...",
    show_default=True,
    help=f"Lateral pressures [Pa], for {' and '.join(names(lambda kind: kind.confined))}; two or "
    "more pressures yield c, phi, sigma_ci and m_i.",
)
@cli_options.material_options
@shape_options
@cli_options.rectangle_options
@cli_options.disc_options
@cli_options.own_options
@cli_options.packing_options
@cli_options.seeds_options
@cli_options.specimen_option
@cli_options.cut_options
@cli_options.loading_options
@cli_options.range_option
@cli_options.threads_option
@cli_options.out_option
@cli_options.report_option
@cli_options.frames_options
@cli_options.quiet_option
def compare(
    test: str,
    models: tuple[str, ...],
    confinements: tuple[float, ...],
    out: Path,
    quiet: bool,
    **options: Any,
) -> None:
    """Run a test with several models on the same packing or packings; write a table and a figure.

    TEST is as for run. All models have the same material, by default the material of flexible
    grains. Each run has its own folder below the output folder; finished runs are not repeated.
    """
    require_known("test", test, TESTS)
    kind = kind_of(test)
    if not kind.confined and any(confinements):
        raise InputError(
            f"confinements = {max(confinements):g} Pa, must be 0 for "
            f"{test}{kind.confine_hint or '; leave it out'}"
        )
    several = packings.asked(options)
    farthest = ranges(models, options["interaction_range"])
    source = inputs.source(test, options)
    options["material"] = options["material"] or default_name(solid=is_solid(source.plain.kind))
    chosen = inputs.shared_material(options, models)
    specs = [
        inputs.run_spec(
            test,
            options | {"model": model, "interaction_range": farthest[model]},
            material,
            source,
        )
        for model, material in chosen.items()
    ]
    if several:
        placed = {
            place_of(spec.model, pressure, len(confinements)): replace(spec, confinement=pressure)
            for spec in specs
            for pressure in confinements
        }
        packings.carry_out(placed, several, options, out=out, quiet=quiet)
        return
    folder = inputs.locked_folder(out, "compare")
    inputs.load_yade()
    from ..studies import comparison

    with terminal.Progress(quiet) as progress:
        found = comparison.compare(
            test,
            inputs.made(source, progress, specs),
            models,
            chosen,
            confinements=confinements,
            out=folder,
            progress=progress,
            threads=options["threads"],
            report=options["report"],
            frames=options["frames"],
            film=options["film"],
            points=specs[0].points,
            **{name: options[name] for name in _SHARED},
        )
    terminal.say(comparison.table(found.cases))
    if found.envelopes:
        terminal.say(tables.envelope_table(found.envelopes, found.reference))
    results = {case.name: case.result for case in found.cases if case.result is not None}
    inputs.tell_each_once({name: inputs.new_warnings(one) for name, one in results.items()})
    terminal.say(f"  files  {folder}/")
    _report_failures(found.cases)


def _report_failures(cases: Sequence[Case]) -> None:
    failed = [case for case in cases if case.failed]
    if failed:
        names = ", ".join(case.name for case in failed)
        why = next((f"; {case.error}" for case in failed if case.error), "")
        raise SimulationError(f"runs = {names}, gave no strength{why}; the other runs are complete")
