# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion of options to arguments of the library; loads YADE if needed. SI units."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, cast

import click

from .. import _plugin
from ..dimensions import SOLIDS, is_solid, refused
from ..errors import InputError
from ..files import FolderLock, Table, output_folder
from ..materials.material import Material, load, unused
from ..materials.mixing import description
from ..results import doubts
from ..runs.input_names import PACKING, SIZE_NAMES, UNUSED, shape_of, with_unit
from ..runs.output import refuse_other_kind
from ..runs.run_spec import RunSpec
from ..specimens.files.source import SpecimenSource
from ..specimens.space.any_spec import SIZES, AnySpec
from ..specimens.space.spec import SolidSpec
from ..specimens.spec import SpecimenSpec
from . import signals, terminal

if TYPE_CHECKING:
    from ..results.result import Result
    from ..specimens.files.source import AnySpecimen
    from ..specimens.space.specimen import SolidSpecimen
    from ..specimens.specimen import Specimen


def load_yade() -> None:
    """Load YADE and the plugin's classes; a signal in the midst of this would end in an abort.

    YADE's temporary folder, which nothing here uses, would outlive a process that is killed.
    """
    with signals.waiting():
        _plugin.load()
        import yade

        with contextlib.suppress(OSError):
            Path(yade.O.tmpFilename()).parent.rmdir()


def locked_folder(path: Path, kind: str = "") -> Path:
    """Make the folder of the command's files and lock it until the command ends.

    Incomplete files of killed processes are removed.

    Args:
        path: The folder.
        kind: Type of its results, see ``KINDS``; empty for none.

    Raises:
        InputError: if it cannot be made, or has results of another type.
    """
    folder = output_folder(path)
    if kind:
        refuse_other_kind(folder, kind)
    # at the end of the command, not when nothing refers to it: frames of a picture may, for a while
    click.get_current_context().find_root().call_on_close(FolderLock(folder).release)
    return folder


def material(options: Table, shape: str) -> Material:
    """Return the material of the options with its changes, checked for their model.

    A warning names changes that have no effect on the model.

    Args:
        options: Options of the command.
        shape: Shape of the specimen, which the default material depends on.
    """
    model = options["model"]
    for line in unused(_keys(options), model):
        _warn(line)
    return _changed(options, load(options["material"], model, solid=is_solid(shape)), model)


def shared_material(options: Table, models: Sequence[str]) -> dict[str, Material]:
    """Return the material of models that are compared, with the changes that each of them uses.

    A warning names changes that have no effect on any of them.

    Args:
        options: Options of the command, with a material.
        models: Names of the models.
    """
    keys = [key for key in _keys(options) if all(unused([key], model) for model in models)]
    for key in keys:
        _warn(f"set {key} has no effect, none of {', '.join(models)} uses it")
    chosen = load(options["material"])
    return {model: _changed(options, chosen, model) for model in models}


def _keys(options: Table) -> list[str]:
    """Keys of the changes of the material."""
    return [one.partition("=")[0].strip() for one in options["assignments"]]


def _changed(options: Table, chosen: Material, model: str) -> Material:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # changes without effect have been named
        found = chosen.with_set(options["assignments"], model)
    description(found, model)
    return found


def source(test: str, options: Table) -> SpecimenSource:
    """The specimen that the options describe, with its files, which are read once."""
    file, solid = options["specimen_file"], options.get("shape")
    shape = shape_of(test, solid, options.get("depth") if file is None else None)
    if is_solid(shape):
        _refuse_plane(shape)
    if file is None:
        refuse_other_sizes(shape)
    else:
        refuse_packing()
    packed = RunSpec.packed(test, options) if file is None else None
    found = _source(packed, file, options)
    if solid not in (None, found.plain.kind):
        raise InputError(
            f"specimen = {str(file)!r}, is a {found.plain.kind}, must be a {solid} as in shape; "
            "leave out specimen or shape"
        )
    return found


def _source(packed: AnySpec | None, file: Path | None, options: Table) -> SpecimenSource:
    """A specimen with the lines that the options cut it by."""
    names = ("joints_file", "network_file", "network_seed")
    found = SpecimenSource.read(
        packed,
        file,
        *(options[name] for name in names),
        joint_name=options["joint_name"],
        joint_origin=options["joint_origin"],
        joint=options["joint"],
    )
    for line in found.notes:
        terminal.say(line)
    return found


def side_pressures(options: Table) -> Table:
    """Return both pressures of a box by their names, if one option has them separated by a comma.

    Raises:
        InputError: if the second pressure is given twice.
    """
    first, *second = options["confinement"]
    given = options["second_confinement"]
    if second and given is not None:
        raise InputError(
            f"second_confinement = {given:g} Pa, must not be given with confinement = "
            f"{first:g},{second[0]:g} Pa; leave out one of them"
        )
    return {"confinement": first, "second_confinement": second[0] if second else given}


def run_spec(test: str, options: Table, chosen: Material, specimen: SpecimenSource) -> RunSpec:
    """The run that the options describe."""
    if isinstance(options.get("confinement"), tuple):
        options = options | side_pressures(options)
    given = options | {"points": int(options["points"])}
    spec = RunSpec.from_options(test, given, chosen, specimen.spec)
    refuse_unused(test)
    for line in doubts.of_inputs(spec.to_json()):
        _warn(line)
    return spec


def _warn(line: str) -> None:
    """Show a warning, once in a command."""
    told = click.get_current_context().meta.setdefault("flexpm.doubts", set())
    if line not in told:
        told.add(line)
        terminal.say(f"warning: {line}")


def new_warnings(result: Result) -> list[str]:
    """Return the warnings of a result that have not been shown for its inputs."""
    known = doubts.of_inputs(result.inputs) if result.inputs is not None else []
    told = click.get_current_context().meta.get("flexpm.doubts", ())
    return [line for line in result.warnings if line not in known and line not in told]


def tell_warnings(result: Result) -> None:
    """Show the warnings of a result that have not been shown for its inputs."""
    for line in new_warnings(result):
        terminal.say(f"warning: {line}")


def tell_each_once(found: Mapping[str, Sequence[str]]) -> None:
    """Show each warning of several runs once, with the runs that have it.

    Args:
        found: Warnings by the name of their run.
    """
    for line in dict.fromkeys(line for lines in found.values() for line in lines):
        names = [name for name, lines in found.items() if line in lines]
        every = len(names) == len(found) > 1
        terminal.say(f"warning: {'all runs' if every else ', '.join(names)}: {line}")


def tell_lengths(sizes: Mapping[str, float], diameters: Sequence[float] | None) -> bool:
    """Warn of lengths that are probably in another unit.

    Args:
        sizes: Sizes of a specimen by their names [m].
        diameters: Diameters of its grains [m]; None if they are unknown.

    Returns:
        Whether there are such lengths.
    """
    lines = doubts.of_lengths(sizes, diameters or ())
    for line in lines:
        _warn(line)
    return bool(lines)


def packed(kind: str, options: Table) -> SpecimenSource:
    """The packing that the options describe, which are all for its shape, with its joints."""
    names = (*SIZES[kind], "thickness", "diameters", "porosity", "seed")
    spec = SpecimenSpec(kind, **{name: options[name] for name in names})
    tell_lengths({**spec.sizes, "thickness": spec.thickness}, spec.diameters)
    spec.require_memory()
    return _source(spec, None, options)


def packed_solid(kind: str, options: Table) -> SpecimenSource:
    """The packing of a 3D specimen that the options describe, with its joints."""
    names = (*SIZES[kind], "diameters", "porosity", "seed")
    spec = SolidSpec(kind, **{name: options[name] for name in names})
    tell_lengths(spec.sizes, spec.diameters)
    spec.require_memory()
    return _source(spec, None, options)


def made_solid(specimen: SpecimenSource, progress: terminal.Progress) -> SolidSpecimen:
    """Make the specimen, which must be 3D."""
    found = made(specimen, progress)
    assert found.spec.kind in SOLIDS
    return cast("SolidSpecimen", found)


def made_plane(specimen: SpecimenSource, progress: terminal.Progress) -> Specimen:
    """Make the specimen, which must be 2D."""
    found = made(specimen, progress)
    assert found.spec.kind not in SOLIDS
    return cast("Specimen", found)


def made(
    specimen: SpecimenSource, progress: terminal.Progress, runs: Sequence[RunSpec] = ()
) -> AnySpecimen:
    """Pack or load a specimen and cut it by its joints.

    Args:
        specimen: Where it comes from.
        progress: Shows how far a packing is.
        runs: Runs of the specimen, whose materials may be of grains of another size.
    """
    load_yade()
    found = specimen.make(progress)
    if specimen.plain.diameters is None:  # those of a packing have been looked at
        odd = tell_lengths(found.extent, (found.mean_diameter,))
        # pieces of grains beside joints are no grains
        for run in runs if found.grains is None and not odd else ():
            of_run = (run.material, run.model, found.mean_diameter)
            for line in doubts.of_grain_size(*of_run, solid=run.is_solid):
                _warn(line)
    cut = (specimen.lines, specimen.network, specimen.planes or None, specimen.discs)
    if any(one is not None for one in cut):
        for line in doubts.of_cuts({name: one.to_json() for name, one in found.told_cuts.items()}):
            _warn(line)
    return found


def resumed(
    specimen: SpecimenSource, folder: Path, progress: terminal.Progress, run: RunSpec
) -> AnySpecimen:
    """Return the specimen of a run: the specimen in its folder, if a checkpoint there names it.

    Args:
        specimen: Source of the specimen otherwise.
        folder: Folder of the run.
        progress: Shows the progress of a packing.
        run: The run.
    """
    load_yade()
    from ..runs.kept_packing import kept

    if specimen.file is None:
        found, why = kept(folder, specimen.spec)
        if found is not None:
            return found
        if why:
            terminal.say(why)
    return made(specimen, progress, [run])


def _refuse_plane(shape: str) -> None:
    """Reject options of 2D specimens for a 3D specimen."""
    context = click.get_current_context()
    for name in ("thickness", "points", "mesh"):
        if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE:
            told = with_unit(name, context.params.get(name))
            raise refused(f"{told}, must not be given for a {shape}", name)


def refuse_packing() -> None:
    """Reject options of a packing together with a specimen that is read from a file."""
    context = click.get_current_context()
    for name in (*SIZE_NAMES, *PACKING, "seeds"):
        if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE:
            raise InputError(
                f"{name} = {context.params.get(name)}, must not be given with specimen, whose file "
                "contains it; leave out one of them"
            )


def refuse_unused(test: str) -> None:
    """Reject options that a test does not use, whether or not they have their defaults."""
    context = click.get_current_context()
    for name in UNUSED[test]:
        if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE:
            told = with_unit(name, context.params.get(name))
            raise InputError(f"{told}, must not be given for {test}; leave it out")


def refuse_other_sizes(shape: str) -> None:
    """Reject sizes of a shape other than the specimen's, which would have no effect."""
    context = click.get_current_context()
    for name in (size for sizes in SIZES.values() for size in sizes):
        given = context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE
        if given and name not in SIZES[shape]:
            raise InputError(
                f"{name} = {context.params.get(name)} m, must not be given for a {shape}; "
                "leave it out"
            )
