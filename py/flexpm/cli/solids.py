# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that make 3D specimens, such as ``flexpm specimen box``, and their options."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..dimensions import SOLIDS
from ..files import Table, json_text, write_text
from ..kinds.registry import ELASTIC, KINDS, names
from ..report import tables
from ..runs.output import ROSE
from ..specimens.space.spec import SIZES
from . import inputs, terminal
from . import options as cli_options
from .options import combined, length_option
from .parameters import Name

if TYPE_CHECKING:
    from ..specimens.space.specimen import SolidSpecimen

_BOX, _CYLINDER = SIZES["box"], SIZES["cylinder"]
box_options = combined(
    length_option("--width", _BOX["width"], "Width, along x"),
    length_option("--depth", _BOX["depth"], "Depth, along y"),
    length_option("--height", _BOX["height"], "Height, along z"),
)


def _told(shape: str, sizes: Mapping[str, float]) -> str:
    return f"{shape} " + ", ".join(f"{name} {value:g}" for name, value in sizes.items())


def _shape_options(shapes: Sequence[str], of: str) -> cli_options.Decorator:
    """Return the options that select a 3D specimen of one of the shapes."""
    sizes = "; ".join(_told(shape, SIZES[shape]) for shape in shapes)
    for name, kind in KINDS.items() if len(shapes) > 1 else ():
        for shape in kind.solids:
            if own := kind.sizes_of(shape):
                sizes += f"; of {name}: {_told(shape, own)}"
    return combined(
        click.option(
            "--shape",
            type=Name(*shapes),
            metavar="|".join(shapes),
            help=f"Shape of a 3D specimen{of}. Default sizes [m]: {sizes}.  [default: the 2D shape "
            "of the test; with --depth solid-disc for a disc, solid-half-disc for half a disc, box "
            "for a beam; cylinder for tests that are available in 3D only]",
        ),
        length_option("--depth", _BOX["depth"], "Depth of a box, a disc or a half disc, along y"),
    )


#: Options that select a 3D specimen for a test.
shape_options = _shape_options(SOLIDS, f", in {', '.join(names(lambda kind: bool(kind.solids)))}")
#: Options that select a 3D specimen for the static solution.
solve_shape_options = _shape_options(KINDS[ELASTIC].solids, "")
#: Options that select a 3D specimen for a benchmark.
bench_options = combined(
    click.option(
        "--shape",
        type=Name("box"),
        metavar="box",
        help="Time the models on a 3D box instead of a rectangle.",
    ),
    length_option("--depth", _BOX["depth"], "Depth of a box, along y"),
)
cylinder_diameter = length_option("--diameter", _CYLINDER["diameter"], "Diameter of a cylinder")
cylinder_options = combined(
    cylinder_diameter,
    length_option("--height", _CYLINDER["height"], "Height, along z"),
)


def _disc_options(sizes: Mapping[str, float]) -> cli_options.Decorator:
    return combined(
        length_option("--diameter", sizes["diameter"], "Diameter of the disc"),
        length_option("--depth", sizes["depth"], "Depth, along y"),
    )


def _command(kind: str, sizes: cli_options.Decorator, about: str) -> click.Command:
    """Return the command that makes a shape of given sizes."""

    @click.command(kind, help=about)
    @sizes
    @cli_options.grain_options
    @cli_options.cut_options
    @cli_options.out_option
    @cli_options.quiet_option
    def made(out: Path, quiet: bool, **options: Any) -> None:
        folder = inputs.locked_folder(out)
        source = inputs.packed_solid(kind, options)
        with terminal.Progress(quiet) as progress:
            specimen = inputs.made_solid(source, progress)
        describe(specimen, folder)

    return made


box = _command("box", box_options, "Make a box of polyhedral grains.")
cylinder = _command("cylinder", cylinder_options, "Make an upright cylinder of polyhedral grains.")
solid_disc = _command(
    "solid-disc",
    _disc_options(SIZES["solid-disc"]),
    "Make a disc of polyhedral grains about the y axis.",
)
solid_half_disc = _command(
    "solid-half-disc",
    _disc_options(SIZES["solid-half-disc"]),
    "Make the upper half of a disc of polyhedral grains about the y axis.",
)


def describe(made: SolidSpecimen, folder: Path, source: Table | None = None) -> None:
    """Print the statistics and write them with the specimen, its mesh and its picture.

    Args:
        made: The specimen.
        folder: Folder of the files.
        source: Figures of the source of the specimen, which are written, too.
    """
    from ..report.outside import outside_picture
    from ..results.solids.vtu import SolidShape, write_solid_vtu

    found, cells = made.statistics(), made.cells
    pairs, outer = cells.faces[: cells.contacts, :2], cells.faces[cells.contacts :, 0]
    ends = cells.face_offsets[: cells.contacts + 1]
    corners = cells.face_vertices[: ends[-1]]
    shape = SolidShape(*made.tetrahedra(), cells.vertices, corners, ends, pairs)
    write_text(folder / "specimen.json", json_text(found | (source or {})))
    made.save(folder / "solid.json")
    write_solid_vtu(folder / "specimen.vtu", shape, made.minerals, made.mineral_names)
    caption = f"{found['grains']} grains, {found['contacts']} contacts"
    picture = folder / "specimen.png"
    shown = outer if made.minerals is None else made.minerals[outer]
    outside_picture(
        picture, cells.vertices, made.outer_polygons(), shown, caption, made.joint_traces()
    )
    names = ["specimen.png", "specimen.json", "solid.json", "specimen.vtu"]
    if made.spec.networks:
        from ..report.stereonet import stereonet_picture

        names.append(ROSE)
        stereonet_picture(folder / ROSE, made)
    terminal.say(tables.statistics_table(found))
    terminal.say(f"  files  {', '.join(str(folder / name) for name in names)}")
