# SPDX-License-Identifier: GPL-3.0-or-later
"""`--seeds` of the commands run and compare: the same test on several packings. SI units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import click

from ..errors import InputError, SimulationError
from ..files import Table, load_json
from ..results import doubts
from ..runs import input_names
from ..runs.output import Output
from ..runs.run_spec import RunSpec
from . import inputs, terminal


def asked(options: Table) -> Sequence[int]:
    """Seeds of the packings that are asked for, none without `--seeds`."""
    seeds: Sequence[int] = options["seeds"] or ()
    if seeds and _is_given("seed"):
        raise InputError(
            f"seed = {options['seed']}, must not be given with seeds; leave out one of them"
        )
    if seeds and options["threads"] != 1:
        raise InputError(
            f"threads = {options['threads']}, must be 1 with seeds; packings run side by side"
        )
    if options["workers"] and not seeds:
        raise InputError(f"workers = {options['workers']}, needs seeds; give them, or leave it out")
    return seeds


def carry_out(
    placed: Mapping[str, RunSpec], seeds: Sequence[int], options: Table, *, out: Path, quiet: bool
) -> None:
    """Carry out the unfinished runs, print the means, and write tables and figures.

    Args:
        placed: The runs, of any packing, by their folder below `out`.
        seeds: Seeds of the packings.
        options: Options of the command.
        out: Folder of all runs.
        quiet: Show no progress.

    Raises:
        SimulationError: if a run failed.
    """
    folder = inputs.locked_folder(out, "packings")
    from ..studies import packings

    given = _given(options)
    output = Output(False, options["frames"], options["film"])
    wanted = [
        job
        for place, spec in placed.items()
        for job in packings.plan(spec, given, seeds, output, place)
    ]
    if not options.get("discard_checkpoint"):
        packings.refuse_others(wanted, folder)
    with terminal.Progress(quiet, unit="runs") as progress:
        rows = packings.run(wanted, folder, workers=options["workers"], progress=progress)
    terminal.say(packings.text_table(wanted, rows))
    if criteria := packings.envelopes_text(wanted, rows):
        terminal.say(criteria)
    failed = packings.failures(rows)
    good = [job.folder for job in wanted if job.folder not in failed]
    inputs.tell_each_once({place: _warnings(folder / place) for place in good})
    if options["report"]:
        from ..studies import pages

        pages.write(folder)
    terminal.say(f"  files  {folder}/")
    _report_failures(failed, len(wanted))


def _given(options: Table) -> Table:
    """Options of a run that differ from their defaults, by name; the material as in a study."""
    names = (*input_names.OPTIONS, "material")
    found = {name: options[name] for name in names if name in options and _is_given(name)}
    if options["material"] is not None:
        found["material"] = options["material"]  # also that of a comparison, which none has given
    if options["joints_file"] is not None:
        found["joints"] = str(options["joints_file"].resolve())  # runs have folders of their own
    if options["network_file"] is not None:
        found["network"] = str(options["network_file"].resolve())
    for name in ("joint_name", "joint_origin", "joint", "network_seed"):
        if options[name] is not None:
            found[name] = options[name]
    parts = (one.partition("=") for one in options["assignments"])
    return found | {f"set.{key.strip()}": value.strip() for key, _, value in parts}


def _is_given(name: str) -> bool:
    source = click.get_current_context().get_parameter_source(name)
    return source is click.core.ParameterSource.COMMANDLINE


def _warnings(folder: Path) -> list[str]:
    """Return the warnings of a run that have not been shown for its inputs."""
    content = load_json(folder / "result.json", "result")
    known = doubts.of_inputs(content["inputs"])
    return [line for line in content["warnings"] if line not in known]


def _report_failures(failed: Mapping[str, tuple[int | None, str]], runs: int) -> None:
    """End with an error if runs failed, which the means leave out."""
    if not failed:
        return
    why = next(message for _, message in failed.values())
    if len(failed) == runs and {code for code, _ in failed.values()} == {2}:
        raise InputError(why)  # what all packings refuse is wrong input
    names = ", ".join(failed)
    raise SimulationError(
        f"runs = {names}, {len(failed)} of {runs} failed and are not part of the means; {why}"
    )
