# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the command: quantities in SI units, checked before anything heavy is loaded."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from ..kinds.option import Option, told_of
from ..kinds.registry import options
from ..models.options import MESHES
from ..require import NOT_NEGATIVE, POSITIVE, Bounds
from ..runs.groups import DECLARED, GrainOptions, LoadingOptions, OutputOptions, options_of
from ..specimens.space.any_spec import SIZES
from ..specimens.spec import SpecimenSpec
from .parameters import Count, Name, Place, Pressures, Quantity, Range, Rate, Seeds

#: Adds an option to the function of a command.
Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]


def combined(*options: Decorator) -> Decorator:
    """One decorator that adds several options, listed in the order given."""

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        for option in reversed(options):
            function = option(function)
        return function

    return decorate


def length_option(name: str, default: float, help_text: str, *, sizes: bool = True) -> Decorator:
    """A length; a size is left to the test, whose specimen may have another default."""
    return click.option(
        name,
        type=Quantity("m", POSITIVE),
        default=None if sizes else default,
        metavar="M",
        help=f"{help_text} [m].  [default: {default:g}]",
    )


def required_length(name: str, help_text: str) -> Decorator:
    """A length without a default."""
    return click.option(
        name, type=Quantity("m", POSITIVE), required=True, metavar="M", help=f"{help_text} [m]."
    )


rectangle_options = combined(
    length_option("--width", SIZES["rectangle"]["width"], "Width"),
    length_option("--height", SIZES["rectangle"]["height"], "Height"),
)


def _type_of(one: Option, words: Sequence[str]) -> click.ParamType:
    """Kind of the values of an option."""
    if words:
        return Name(*words)
    if one.whole:
        low, high = one.bounds.at_least, one.bounds.at_most
        return Count(int(low or 0), None if high is None else int(high))
    return Rate("", one.bounds) if one.name == "rate" else Quantity(one.unit, one.bounds)


def _own_option(name: str, tests: Mapping[str, Option]) -> Decorator:
    """An option of some tests; where they differ the help tells of each."""
    first = next(iter(tests.values()))
    words = tuple(dict.fromkeys(word for one in tests.values() for word in one.choices))
    plain = "|".join(words) if words and len(tests) == 1 else "NAME" if words else ""
    text, default = told_of(tests)
    return click.option(
        f"--{name.replace('_', '-')}",
        type=_type_of(first, words),
        metavar=plain or (first.unit or "x").upper(),
        help=f"{text}.  [default: {default}]",
    )


def _options(group: type, *chosen: str) -> Decorator:
    """Options that a group of a run declares, or some of them, in their order."""
    found = options_of(group)
    return combined(*(_option(group, found[name]) for name in chosen or found))


def _option(group: type, one: Option) -> Decorator:
    """An option of the command as a group of a run declares it."""
    name, usual = f"--{one.name.replace('_', '-')}", getattr(group, one.name)
    if usual is False:
        return click.option(name, is_flag=True, help=f"{one.phrase}.")
    found = bool(one.default) or usual in (None, "")  # by the run itself
    told = f"  [default: {one.default}]" if one.default else ""
    return click.option(
        name,
        type=_type_of(one, one.choices),
        default=None if found else str(usual) if one.choices else usual,
        metavar=one.metavar or "NAME",
        show_default=not found,
        help=f"{one.phrase}.{told}",
    )


own_options = combined(*(_own_option(name, tests) for name, tests in options().items()))
seed_option = click.option(
    "--seed",
    type=Count(0),
    default=SpecimenSpec.seed,
    metavar="N",
    show_default=True,
    help="Seed of the packing.",
)
seeds_options = combined(
    click.option(
        "--seeds",
        type=Seeds(),
        metavar="N-M,...",
        help="Test the packings of several seeds, such as 1-5 or 1,3,7-9. Writes a table and a "
        "figure with mean and standard deviation.",
    ),
    click.option(
        "--workers",
        type=Count(1),
        metavar="N",
        help="Number of simultaneous runs, with --seeds.  [default: one per core]",
    ),
)
threads_option = click.option(
    "--threads",
    type=Count(1, os.cpu_count()),
    default=1,
    metavar="N",
    show_default=True,
    help="Threads of the simulation.",
)
grain_options = combined(
    click.option(
        "--diameters",
        type=Range(),
        default=SpecimenSpec.diameters,
        metavar="DMIN,DMAX",
        help="Smallest and largest diameter of the grains [m].  [default: 0.002,0.004]",
    ),
    click.option(
        "--porosity",
        type=Quantity("", Bounds(at_least=0.0, below=1.0)),
        default=SpecimenSpec.porosity,
        metavar="N",
        show_default=True,
        help="Porosity of the packing, which sets the number of grains [-].",
    ),
    seed_option,
)
packing_options = combined(
    length_option("--thickness", SpecimenSpec.thickness, "Thickness out of plane", sizes=False),
    grain_options,
)
specimen_option = click.option(
    "--specimen",
    "specimen_file",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Load a specimen written by Specimen.save instead of packing grains.",
)
joints_option = combined(
    click.option(
        "--joints",
        "joints_file",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Cut a 2D specimen along the segments of a CSV file x1,y1,x2,y2,name [m], or the "
        "lines of a map, a .geojson file [m]; a 3D specimen along polygons name,x0,y0,z0,..., "
        "discs x,y,z,dip,dip_direction,radius,name, or whole planes, which have no radius "
        "[m, degree], or along the polygons of dfnWorks, a .dat file [m].",
    ),
    click.option(
        "--joint",
        "joint",
        metavar="NAME",
        help="Name of the joint of the polygons of dfnWorks, for a 3D specimen.",
    ),
    click.option(
        "--name",
        "joint_name",
        metavar="KEY",
        help="Property of the map with the name of the joint of each line.  [default: name, if all "
        "lines have it]",
    ),
    click.option(
        "--origin",
        "joint_origin",
        type=Place(),
        metavar="X,Y",
        help="Point of the map at the specimen's origin [m].  [default: lower left corner of the "
        "lines]",
    ),
)
network_options = combined(
    click.option(
        "--network",
        "network_file",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Cut the specimen along the traces, in 3D the discs or planes, of a fracture network, "
        "a TOML file.",
    ),
    click.option(
        "--network-seed",
        type=Count(0),
        metavar="N",
        help="Seed of the network.  [default: the seed in its file]",
    ),
)
#: Lines that cut a specimen.
cut_options = combined(joints_option, network_options)
disc_options = length_option(
    "--diameter", SIZES["disc"]["diameter"], "Diameter of the disc or half disc"
)
material_options = combined(
    click.option(
        "--material",
        metavar="NAME|FILE",
        help="Preset or TOML file.  [default: augig-table7 for the flexible model and in compare, "
        "else augig-table2-bilinear; in 3D augig3d-calibrated and augig3d-calibrated-rigid]",
    ),
    click.option(
        "--set",
        "assignments",
        multiple=True,
        metavar="KEY=VALUE",
        help="Change a value of the material; may be repeated.",
    ),
    _options(GrainOptions, "points", "mesh"),
)
model_options = combined(_options(GrainOptions, "model"), material_options)
range_option = _options(GrainOptions, "interaction_range")
loading_options = _options(
    LoadingOptions, *(name for name in options_of(LoadingOptions) if name != "confinement")
)
confinement_option = click.option(
    "--confinement",
    type=Pressures("Pa", NOT_NEGATIVE),
    default=str(LoadingOptions.confinement),
    metavar="PA[,PA]",
    show_default=True,
    help=f"{DECLARED['confinement'].help}. For a box, P,P sets the confining pressures across x "
    "and y (as --second-confinement) [Pa].",
)
drawn_mesh_option = click.option(
    "--mesh",
    type=Name(*MESHES),
    metavar="fan|refined",
    help="Mesh of the grains.",
)
out_option = click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=Path("flexpm-out"),
    metavar="DIR",
    show_default=True,
    help="Folder for the files.",
)
report_option = click.option(
    "--no-report",
    "report",
    is_flag=True,
    flag_value=False,
    default=True,
    help="Write no report.html.",
)
frames_options = _options(OutputOptions, "frames", "film")
quiet_option = click.option("--quiet", is_flag=True, help="Show no progress.")
study_seeds_option = click.option(
    "--seeds",
    type=Seeds(),
    metavar="N-M,...",
    help="Seeds that replace the seeds in FILE, such as 1-5 or 1,3,7-9.",
)
#: Options of runs that are distributed.
pool_options = combined(
    click.option(
        "--workers",
        type=Count(1),
        metavar="N",
        help="Number of simultaneous runs.  [default: one per core]",
    ),
    click.option(
        "--scheduler",
        metavar="ADDRESS",
        help="Send the runs to this running Dask scheduler.",
    ),
    click.option(
        "--cluster",
        metavar="KIND",
        help="Start workers by this batch system: slurm, pbs, oar, ... (needs dask-jobqueue).",
    ),
)
many_runs_out_option = click.option(
    "--out",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder for the files.  [default: the name of FILE without .toml, in the working folder]",
)
many_runs_options = combined(
    click.argument("file", type=click.Path(path_type=Path), metavar="FILE"),
    many_runs_out_option,
    pool_options,
    report_option,
    quiet_option,
)
