# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands `flexpm run`, `rerun` and `elastic`: one test or static solution. SI units."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .._version import __version__
from ..errors import InputError, SimulationError
from ..files import Table, json_text, load_json, write_text
from ..kinds.registry import ELASTIC, KINDS, TESTS
from ..materials.material import Material
from ..report import tables
from ..require import require_known
from ..runs.asked import differences, read_inputs, read_own
from ..runs.output import Output, refuse_other_result
from ..runs.run_inputs import RunInputs
from ..runs.run_spec import RunSpec
from ..text import name_of
from . import inputs, packings, terminal
from . import options as cli_options
from .solids import cylinder_diameter, shape_options, solve_shape_options

if TYPE_CHECKING:
    from ..specimens.files.source import AnySpecimen


_discard_option = click.option(
    "--discard-checkpoint",
    is_flag=True,
    help="Start again if the folder has results or a checkpoint of another run, or damaged files.",
)


@click.command(
    help="Run a laboratory test and write its files.\n\nTEST is one of:\n\n"
    + "\n\n".join(f"{name}: {KINDS[name].about}." for name in TESTS)
)
@click.argument("test", metavar="TEST")
@cli_options.model_options
@shape_options
@cli_options.rectangle_options
@cli_options.disc_options
@cli_options.own_options
@cli_options.packing_options
@cli_options.seeds_options
@cli_options.specimen_option
@cli_options.cut_options
@cli_options.confinement_option
@cli_options.loading_options
@cli_options.range_option
@cli_options.threads_option
@cli_options.out_option
@_discard_option
@cli_options.report_option
@cli_options.frames_options
@cli_options.quiet_option
def run(test: str, out: Path, quiet: bool, discard_checkpoint: bool, **options: Any) -> None:
    """Run a laboratory test and write its files."""
    require_known("test", test, TESTS)
    source = inputs.source(test, options)
    chosen = inputs.material(options, source.plain.kind)
    spec = inputs.run_spec(test, options, chosen, source)
    if several := packings.asked(options):
        asked = options | {"discard_checkpoint": discard_checkpoint}
        packings.carry_out({"": spec}, several, asked, out=out, quiet=quiet)
        return
    options |= {"quiet": quiet, "discard_checkpoint": discard_checkpoint}
    folder = inputs.locked_folder(out, "run")

    def specimen(shown: terminal.Progress) -> AnySpecimen:
        return inputs.resumed(source, folder, shown, spec)

    _simulate(spec, chosen, specimen, folder, options)


@click.command(short_help="Repeat a run from its result.json.")
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE")
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=Path("flexpm-rerun"),
    metavar="DIR",
    show_default=True,
    help="Folder for the files.",
)
@cli_options.threads_option
@_discard_option
@cli_options.report_option
@cli_options.frames_options
@cli_options.quiet_option
def rerun(file: Path, out: Path, **options: Any) -> None:
    """Repeat the run or custom test of FILE, its result.json or its folder.

    FILE has all inputs of a run, and all calls of a custom test. A specimen that is not a plain
    packing is read from grains.json in the same folder. At the end the numbers are compared with
    the numbers in FILE.
    """
    file = file / "result.json" if file.is_dir() else file
    before = load_json(file, "result")
    if own := read_own(file):
        _repeat(file, own, inputs.locked_folder(out, "run"), options)
        return
    spec, chosen = read_inputs(file)
    folder = inputs.locked_folder(out, "run")

    def specimen(shown: terminal.Progress) -> AnySpecimen:
        inputs.load_yade()
        from ..runs.kept_packing import difference
        from ..specimens.files import given

        made = given.load(spec.specimen, file.parent, shown)
        if line := difference(file.parent, made):
            shown.tell(line)
        return made

    try:
        if spec.kind.is_solve:
            _solve(spec, chosen, specimen, folder, options["quiet"])
        else:
            _simulate(spec, chosen, specimen, folder, options)
    finally:  # also of a run that fails again
        _tell_differences(file, before, folder)


@click.command(short_help="Compute the elastic constants with one static solution.")
@cli_options.model_options
@solve_shape_options
@cli_options.rectangle_options
@cylinder_diameter
@cli_options.packing_options
@cli_options.specimen_option
@cli_options.cut_options
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Write result.json into this folder.",
)
@cli_options.quiet_option
def elastic(out: Path | None, **options: Any) -> None:
    """Compute Young's modulus and Poisson's ratio of a specimen with one static solution."""
    source = inputs.source(ELASTIC, options)
    chosen = inputs.material(options, source.plain.kind)
    spec = inputs.run_spec(ELASTIC, options, chosen, source)
    folder = None if out is None else inputs.locked_folder(out, "run")
    _solve(spec, chosen, lambda shown: inputs.made(source, shown, [spec]), folder, options["quiet"])


def _repeat(
    file: Path, own: tuple[RunInputs, Material, list[Table]], folder: Path, options: Table
) -> None:
    """Repeat a custom test and print its results; arguments as for a simulation."""
    before = load_json(file, "result")
    output = Output(options["report"], options["frames"], options["film"])
    if options["discard_checkpoint"]:
        raise InputError(
            "discard_checkpoint: must be left out for a custom test; choose another folder"
        )
    inputs.load_yade()
    from ..laboratory.own_tests import repeat

    try:
        result = repeat(
            file,
            own,
            threads=options["threads"],
            out=folder,
            report=output.report,
            frames=output.frames,
            film=output.film,
        )
        terminal.say(tables.result_table(result))
        inputs.tell_warnings(result)
        terminal.say(f"  files                   {folder}/")
    finally:  # also of a test that fails again
        _tell_differences(file, before, folder)


def _tell_differences(file: Path, before: Table, folder: Path) -> None:
    """Print whether the numbers of a run are equal to its former numbers."""
    again = folder / "result.json"
    if not again.exists():
        return
    found = differences(before, load_json(again, "result"))
    told = f"different from {file}: {', '.join(found)}" if found else f"the same as in {file}"
    terminal.say(f"  numbers                 {told}")


def _simulate(
    spec: RunSpec,
    chosen: Material,
    make: Callable[[terminal.Progress], AnySpecimen],
    folder: Path,
    options: Table,
) -> None:
    """Run a test and print its results.

    Args:
        spec: The run.
        chosen: Its material.
        make: Makes its specimen.
        folder: Folder for its files.
        options: Options of the command.

    Raises:
        SimulationError: if the test has no strength.
    """
    output = Output(options["report"], options["frames"], options["film"])
    inputs.load_yade()
    from ..laboratory.carrying_out import carry_out
    from ..laboratory.plan import plan_run
    from ..rigs import frames
    from ..runs import checkpoint

    if options["discard_checkpoint"] and (why := checkpoint.discard_unusable(folder, spec)):
        terminal.say(f"starts again: {why}")
    with terminal.Progress(options["quiet"]) as progress:
        plan = plan_run(spec, make(progress), chosen, folder, output=output)
        foresee = None if options["quiet"] else progress.foresee
        announce = None if options["quiet"] else progress.tell
        result = carry_out(
            plan,
            threads=options["threads"],
            progress=progress,
            foresee=foresee,
            announce=announce,
        )
    terminal.say(tables.result_table(result))
    inputs.tell_warnings(result)
    terminal.say(f"  files                   {folder}/")
    if output.frames:
        number = len(frames.read(folder))
        terminal.say(f"  frames                  {number} in {folder / frames.COLLECTION}")
    if result.resumed_at is not None:
        again = "was complete" if result.resumed_at >= result.steps else "was resumed"
        terminal.say(f"  an earlier run there {again} at step {result.resumed_at}")
    if result.failed:
        raise SimulationError(
            f"status = {result.status} after {result.steps} steps, {result.without_peak}; the "
            f"results up to there are in {folder}"
        )


def _solve(
    spec: RunSpec,
    chosen: Material,
    make: Callable[[terminal.Progress], AnySpecimen],
    folder: Path | None,
    quiet: bool,
) -> None:
    """Compute and print the elastic constants; arguments as for a simulation."""
    if folder is not None:
        refuse_other_result(folder, spec)
    inputs.load_yade()
    from ..models import grains
    from ..specimens.files import given

    with terminal.Progress(quiet) as progress:
        specimen = make(progress)
        progress.close()
        found = grains.elastic(
            specimen, chosen, model=spec.model, points=spec.points, mesh=spec.mesh
        )
    if folder is not None:
        given.save(folder, specimen)
        asked = spec.to_json()
        about = {name: asked[name] for name in ("test", "model", "material")}
        about |= {"flexpm": __version__, "seed": spec.specimen.seed}
        write_text(folder / "result.json", json_text({**about, **found, "inputs": asked}))
    seed = "" if spec.specimen.seed is None else f", seed {spec.specimen.seed}"
    terminal.say(f"{spec.model} model, {name_of(chosen.name)}{seed}")
    terminal.say(tables.elastic_table(found))
