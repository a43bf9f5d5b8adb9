# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the command: quantities in SI units, checked before anything heavy is loaded."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from ..kinds.option import Option
from ..kinds.registry import KINDS, names, options
from ..kinds.test_kind import PLATEAU_STRAIN, TestKind
from ..models.options import MESHES, MODELS, POINTS, RANGE
from ..require import NOT_NEGATIVE, POSITIVE, Bounds
from ..runs.input_names import HALVINGS, STARTS
from ..runs.loading_rate import HALVING_BOUNDS, LOADINGS
from ..runs.output import FILMS, MOST_FRAMES
from ..runs.run_spec import RunSpec
from ..specimens.space.any_spec import SIZES
from ..specimens.spec import SpecimenSpec
from .parameters import Count, Name, Place, Quantity, Range, Rate, Seeds

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


def _by_test(value: Callable[[TestKind], float], option: str) -> str:
    """A default and the tests that have another one."""
    found: dict[float, list[str]] = {}
    for name, kind in KINDS.items():
        if option not in kind.without:
            found.setdefault(value(kind), []).append(name)
    usual, *others = found.items()
    return "; ".join(
        [f"{usual[0]:g}", *(f"{', '.join(tests)}: {number:g}" for number, tests in others)]
    )


rectangle_options = combined(
    length_option("--width", SIZES["rectangle"]["width"], "Width"),
    length_option("--height", SIZES["rectangle"]["height"], "Height"),
)


def _own_option(name: str, tests: dict[str, Option]) -> Decorator:
    """An option of some tests; where they differ the help tells of each."""
    first = next(iter(tests.values()))
    words = tuple(dict.fromkeys(word for one in tests.values() for word in one.choices))
    kind = Name(*words) if words else Quantity(first.unit, first.bounds)
    plain = "|".join(words) if words and len(tests) == 1 else "NAME" if words else ""
    return click.option(
        f"--{name.replace('_', '-')}",
        type=kind,
        metavar=plain or (first.unit or "x").upper(),
        help=_own_help(tests),
    )


def _own_help(tests: dict[str, Option]) -> str:
    """What an option is, for which tests, its unit, and what stands for it."""
    first = next(iter(tests.values()))
    unit = f" [{first.unit}]" if first.unit else ""
    what = _each({test: one.help for test, one in tests.items()})
    those = f", for {' and '.join(tests)}" if what == first.help else ""
    words = {test: ", ".join(one.choices) for test, one in tests.items()}
    choices = f": {_each(words)}" if first.choices and len(tests) > 1 else ""
    default = _each({test: one.default for test, one in tests.items()})
    return f"{what}{those}{choices}{unit}.  [default: {default}]"


def _each(texts: dict[str, str]) -> str:
    """A text of several tests, once if all have the same one."""
    found: dict[str, list[str]] = {}
    for test, text in texts.items():
        found.setdefault(text, []).append(test)
    if len(found) == 1:
        return next(iter(found))
    return "; ".join(f"{', '.join(tests)}: {text}" for text, tests in found.items())


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
        help="Test the packings of several seeds, such as 1-5 or 1,3,7-9; a table and a picture "
        "with mean and standard deviation.",
    ),
    click.option(
        "--workers",
        type=Count(1),
        metavar="N",
        help="Runs at a time, with --seeds.  [default: one per core]",
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
        help="Sets the number of grains [-].",
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
    help="Test a specimen of Specimen.save instead of packing one.",
)
joints_option = combined(
    click.option(
        "--joints",
        "joints_file",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Cut the specimen along the segments of a CSV file x1,y1,x2,y2,name [m], or the lines "
        "of a map, a .geojson file [m].",
    ),
    click.option(
        "--name",
        "joint_name",
        metavar="KEY",
        help="Property of the map that names the joint of a line.  [default: name, if all have it]",
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
        help="Cut the specimen along the traces of a fracture network, a TOML file.",
    ),
    click.option(
        "--network-seed",
        type=Count(0),
        metavar="N",
        help="Seed of the network.  [default: that of its file]",
    ),
)
#: Lines that cut a specimen.
cut_options = combined(joints_option, network_options)
disc_options = length_option(
    "--diameter", SIZES["disc"]["diameter"], "Diameter of the disc, or of half of one"
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
    click.option(
        "--points",
        type=Name(*map(str, POINTS)),
        default=str(RunSpec.points),
        metavar="1|2|3",
        show_default=True,
        help="Points in each contact.",
    ),
    click.option(
        "--mesh",
        type=Name(*MESHES),
        default=RunSpec.mesh,
        metavar="fan|refined",
        show_default=True,
        help="Triangles in each grain.",
    ),
)
model_options = combined(
    click.option(
        "--model",
        type=Name(*MODELS),
        default=RunSpec.model,
        metavar="NAME",
        show_default=True,
        help="Model of the grains.",
    ),
    material_options,
)
range_option = click.option(
    "--interaction-range",
    type=Quantity("", RANGE),
    metavar="G",
    help="For jcfpm and cohfrict: bond spheres nearer than G times the sum of their radii, too, 1 "
    "to 2 [-].  [default: only neighbours]",
)
loading_options = combined(
    click.option(
        "--rate",
        type=Rate("", POSITIVE),
        default=RunSpec.rate,
        metavar="F|auto",
        show_default=True,
        help="Factor on the loading rate [-]; auto: 1, and half of it again and again, up to "
        f"{HALVINGS} times, until the test is slow enough.",
    ),
    click.option(
        "--halvings",
        type=Count(*(int(one or 0) for one in (HALVING_BOUNDS.at_least, HALVING_BOUNDS.at_most))),
        metavar="N",
        help="Halve the rate at most N times: a test that ends not_quasistatic is loaded again "
        "until it is ok and the peaks of two rates agree within 1 %.  [default: never; "
        f"{HALVINGS} with --rate auto]",
    ),
    click.option(
        "--max-strain",
        type=Quantity("", POSITIVE),
        metavar="E",
        help="Axial strain at which the test ends [-]. Without it a test under a confining "
        f"pressure also ends on a plateau, once the deviator has been constant over "
        f"{100.0 * PLATEAU_STRAIN:g} % of strain.  [default: by the reference strength, times "
        f"{_by_test(lambda kind: kind.largest_strain, 'max_strain')}]",
    ),
    click.option(
        "--stop-ratio",
        type=Quantity("", POSITIVE),
        metavar="F",
        help="The test ends once the deviator, the axial stress minus the least confining "
        "pressure, has fallen to this part of its peak [-].  "
        f"[default: {_by_test(lambda kind: kind.stop_ratio, 'stop_ratio')}]",
    ),
    click.option("--dynamic", is_flag=True, help="Real masses and time instead of scaled masses."),
    click.option(
        "--gravity",
        type=Quantity("m/s2", NOT_NEGATIVE),
        default=RunSpec.gravity,
        metavar="G",
        show_default=True,
        help="Acceleration downwards, with --dynamic only [m/s2].",
    ),
    click.option(
        "--damping",
        type=Quantity("", Bounds(at_least=0.0, below=1.0)),
        metavar="A",
        help="Local damping of the loading [-]; what falls freely gains (1 - A) g.  [default: 0.7; "
        "0 with --dynamic]",
    ),
    click.option(
        "--start",
        type=Name(*STARTS),
        metavar="rest|static",
        help="static: from the elastic solution below the first crack, for the flexible model in "
        f"{' and '.join(names(lambda kind: bool(kind.static_models)))}; it is the default of "
        f"{' and '.join(names(lambda kind: kind.static_first))}.",
    ),
    click.option(
        "--loading",
        type=Name(*LOADINGS),
        metavar="constant|adaptive|waiting",
        help="waiting: load fast, and nearly stand still while a crack runs; the default of "
        "flexible and rigid grains with scaled masses. adaptive: load faster while the specimen is "
        "elastic; the default of inner particles unless contacts are brittle.",
    ),
)
drawn_mesh_option = click.option(
    "--mesh",
    type=Name(*MESHES),
    metavar="fan|refined",
    help="Draw this mesh in the grains.",
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
frames_options = combined(
    click.option(
        "--frames",
        type=Count(0, MOST_FRAMES),
        default=0,
        metavar="N",
        help="Write the state at even strains, N up to the strain of the reference strength, and "
        "around the peak, for ParaView; fewer if the test ends before or has fewer rows.",
    ),
    click.option(
        "--film",
        type=Name(*FILMS),
        metavar="gif|mp4",
        help="Write a film of the frames, 40 if their number is not given; mp4 needs ffmpeg.",
    ),
)
quiet_option = click.option("--quiet", is_flag=True, help="Show no progress.")
study_seeds_option = click.option(
    "--seeds",
    type=Seeds(),
    metavar="N-M,...",
    help="Values of seed in the place of those in FILE, such as 1-5 or 1,3,7-9.",
)
many_runs_options = combined(
    click.argument("file", type=click.Path(path_type=Path), metavar="FILE"),
    click.option(
        "--out",
        type=click.Path(path_type=Path),
        metavar="DIR",
        help="Folder.  [default: the file's name without .toml, in the working folder]",
    ),
    click.option(
        "--workers",
        type=Count(1),
        metavar="N",
        help="Runs at a time.  [default: one per core]",
    ),
    click.option(
        "--scheduler",
        metavar="ADDRESS",
        help="Give the runs to this running Dask scheduler.",
    ),
    click.option(
        "--cluster",
        metavar="KIND",
        help="Ask this batch system for workers: slurm, pbs, oar, ... (needs dask-jobqueue).",
    ),
    report_option,
    quiet_option,
)
