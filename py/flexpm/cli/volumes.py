# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that make 3D specimens of volumes and tables: ``flexpm specimen volume``, ``table``.

SI units.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError
from ..files import Table, csv_text, write_text
from ..require import POSITIVE, Bounds
from ..specimens.space.spec import SHORT_EDGE
from ..text import words_of
from . import inputs, solids, terminal
from . import options as cli_options
from .parameters import Count, Name, Quantity, Several, Window

if TYPE_CHECKING:
    from ..specimens.space.specimen import SolidSpecimen
    from ..specimens.volumes.volume_report import VolumeReport

#: Grains that the command names; volume.csv has all.
_MOST_NAMED = 8
_short_edge = click.option(
    "--short-edge",
    type=Quantity("", Bounds(at_least=0.0, below=0.5)),
    default=SHORT_EDGE,
    metavar="F",
    show_default=True,
    help="Collapse edges shorter than this share of the mean diameter; 0: none [-].",
)
_unit = click.option(
    "--unit",
    type=Name("m", "mm", "um"),
    metavar="m|mm|um",
    help="Unit of the spacing in the file, for files that do not state it.",
)


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--voxel",
    type=Several(Quantity("m", POSITIVE), (1, 3)),
    metavar="H|HX,HY,HZ",
    help="Size of a voxel, or sizes along x, y and z [m].  [default: the spacing in the file]",
)
@_unit
@click.option(
    "--counts",
    type=Several(Count(1), (3,)),
    metavar="NX,NY,NZ",
    help="Number of voxels along x, y and z of a .raw file.",
)
@click.option("--dtype", metavar="T", help="Type of the numbers of a .raw file, e.g. uint16.")
@click.option("--array", metavar="NAME", help="Array of labels, for files with several arrays.")
@click.option(
    "--labels",
    type=Name("grains", "phases"),
    default="grains",
    metavar="grains|phases",
    show_default=True,
    help="Labels are grains, or phases whose connected regions are grains.",
)
@click.option(
    "--watershed",
    is_flag=True,
    help="Divide connected regions of a phase where they are narrow.",
)
@click.option(
    "--phases",
    type=click.Path(path_type=Path),
    help="TOML file: phase or label = mineral, or hole.",
)
@click.option(
    "--minerals",
    type=click.Path(path_type=Path),
    help="CSV table with the columns id and mineral, or a second volume of phases: the mineral of "
    "each grain.",
)
@click.option(
    "--least-voxels",
    type=Count(1),
    default=8,
    show_default=True,
    help="Smallest number of voxels of a grain; smaller regions are merged with a neighbour.",
)
@click.option(
    "--crop",
    type=Window(),
    metavar="X0:X1,Y0:Y1,Z0:Z1",
    help="Part of the volume: first voxel and the voxel after the last one along each axis.",
)
@click.option(
    "--coarsen",
    type=Count(1),
    default=1,
    show_default=True,
    help="Take every N-th voxel along each axis.",
)
@click.option(
    "--shape",
    type=Name("box", "cylinder", "solid-disc"),
    default="box",
    metavar="box|cylinder|solid-disc",
    show_default=True,
    help="The whole volume, or a cylinder about z or a disc about y from its middle.",
)
@click.option(
    "--diameter", type=Quantity("m", POSITIVE), help="Diameter of the cylinder or disc [m]."
)
@click.option(
    "--volumes",
    type=Name("fitted", "exact"),
    default="fitted",
    metavar="fitted|exact",
    show_default=True,
    help="exact: cells have the volumes of their grains, and agree with fewer voxels.",
)
@_short_edge
@cli_options.out_option
@cli_options.quiet_option
def volume(file: Path, out: Path, quiet: bool, **options: Any) -> None:
    """Make the grains of a label volume, such as a segmented micro-CT scan.

    Formats: a TIFF stack, a folder of slices, NPY, RAW, .tesr of Neper, .dream3d, .vti and .vtk.
    """
    labels, phases, minerals = (options.pop(name) for name in ("labels", "phases", "minerals"))
    names = ("voxel", "unit", "counts", "dtype", "array", "crop", "coarsen")
    reading: Table = {name: options.pop(name) for name in names}
    if options["watershed"] and labels == "grains":
        raise InputError("watershed, is for labels of phases; give --labels phases")
    if minerals is not None and labels == "phases":
        raise InputError("minerals, is for labels of grains; leave out --labels phases")
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet) as progress:
        inputs.load_yade()
        from ..specimens.label_volumes import reading as files
        from ..specimens.volumes import specimen_of_volume as made_of
        from ..specimens.volumes import volume_minerals

        chosen = made_of.VolumeOptions(**options)
        read = files.read(file, **reading)
        if minerals is not None:
            kinds = volume_minerals.kinds_of_minerals(minerals, read, reading, phases)
        elif phases is not None:
            kinds = volume_minerals.kinds_of_file(phases, read, labels)
        elif labels == "phases":
            kinds = volume_minerals.kinds_of_phases(read)
        else:
            kinds = made_of.kinds_of(read, None)
        made = made_of.specimen_of(read, kinds, chosen, progress)
    inputs.tell_lengths(made.extent, (made.mean_diameter,))
    _describe(made, read.source, folder)


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@cli_options.required_length("--width", "Width of the box, along x")
@cli_options.required_length("--depth", "Depth of the box, along y")
@cli_options.required_length("--height", "Height of the box, along z")
@click.option(
    "--unit",
    type=Name("m", "mm", "um"),
    default="m",
    metavar="m|mm|um",
    show_default=True,
    help="Unit of the lengths in the file.",
)
@_short_edge
@cli_options.out_option
@cli_options.quiet_option
def table(file: Path, out: Path, quiet: bool, **options: Any) -> None:
    """Make a box of grains with the volumes and centroids in a table.

    FILE is a CSV file with the columns id, x, y, z, volume and, optionally, phase.
    """
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet) as progress:
        inputs.load_yade()
        from ..specimens.specimen import Specimen

        made = Specimen.from_grain_table(file, **options, progress=progress)
    inputs.tell_lengths(made.extent, (made.mean_diameter,))
    solids.describe(made, folder)


def _describe(made: SolidSpecimen, source: str, folder: Path) -> None:
    """Write and print the comparison with the volume, besides the files of any solid."""
    from ..report.volume_sections import volume_picture

    report = made.fit
    assert report is not None
    rows = zip(*report.columns.values(), strict=True)
    write_text(folder / "volume.csv", csv_text(report.columns, rows))
    volume_picture(folder / "volume.png", report)
    solids.describe(made, folder, {"volume": {"source": source, **report.totals}})
    for line in _warnings(made, report):
        terminal.say(f"  {line}")
    if made.mineral_names:
        terminal.say(f"  minerals of the material, in this order: {', '.join(made.mineral_names)}")
    terminal.say(f"  files  {folder / 'volume.png'}, {folder / 'volume.csv'}")


def _warnings(made: SolidSpecimen, report: VolumeReport) -> list[str]:
    from ..laboratory.forecast import SOFT, softness

    lines = []
    totals = report.totals
    if poor := report.poor_grains:
        lines.append(
            f"{len(poor)} grains agree with their cells in less than 80 % of their voxels, since "
            f"they are far from convex: {_named(poor)}"
        )
    if lost := totals["lost_grains"]:
        lines.append(f"{len(lost)} grains have no cell: {_named(lost)}")
    for name in ("small_regions", "small_pores", "loose_grains"):
        if number := totals[name]:
            lines.append(f"{words_of(name)}: {number}, see doc/volumes")
    soft = softness(made)
    if soft > SOFT:
        lines.append(
            f"contacts of the default material are {soft:.2g} times as compliant as grains of "
            "this size: use Material.at_grain_size"
        )
    return lines


def _named(labels: list[int]) -> str:
    shown = ", ".join(map(str, labels[:_MOST_NAMED]))
    return shown + (", ..." if len(labels) > _MOST_NAMED else "")
