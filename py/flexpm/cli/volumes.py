# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that make 3D specimens of volumes and tables: ``flexpm specimen volume``, ``table``.

SI units.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError
from ..files import Table, csv_text, write_text
from ..report import tables
from ..require import POSITIVE, Bounds
from ..specimens.space.spec import SHORT_EDGE
from . import inputs, solids, terminal
from . import options as cli_options
from .parameters import Count, Name, Quantity, Several, Window

if TYPE_CHECKING:
    from ..specimens.space.specimen import SolidSpecimen
    from ..specimens.volumes.volume_report import VolumeReport

#: Grains that the command names; volume.csv has all.
_MOST_NAMED = 8
#: Share of the boundaries that divide regions of a label, above which a message is printed [-].
_DIVIDED = 0.1
#: Agreement from which nothing is said of a start that no fit has improved [-].
_GOOD = 0.9
_ZERO = 'label 0 is rock; if it is none, give a file with 0 = "hole" by --phases'
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
    "--minerals-dtype",
    metavar="T",
    help="Type of the numbers of a second volume that is a .raw file.  [default: as --dtype]",
)
@click.option(
    "--minerals-array",
    metavar="NAME",
    help="Array of phases in a second volume with several arrays.",
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
    type=Name("box", "cylinder", "disc", "solid-disc"),
    default="box",
    metavar="box|cylinder|disc",
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
    help="exact: cells have the volumes of their grains before short edges are collapsed.",
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
    second = {name: options.pop(f"minerals_{name}") for name in ("dtype", "array")}
    for name, value in second.items():
        if value is not None and minerals is None:
            raise InputError(f"minerals-{name} = {value}, is for a second volume; give --minerals")
    if options["watershed"] and labels == "grains":
        raise InputError(
            "watershed = True, must be used with labels of phases; give --labels phases, or leave "
            "it out"
        )
    if minerals is not None and labels == "phases":
        raise InputError(
            f"minerals = {str(minerals)!r}, must be used with labels of grains; leave it out, or "
            "give --labels grains"
        )
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet) as progress:
        inputs.load_yade()
        from ..specimens.label_volumes import reading as files
        from ..specimens.volumes import specimen_of_volume as made_of
        from ..specimens.volumes import volume_minerals

        chosen = made_of.VolumeOptions(**options)
        read = files.read(file, **reading)
        if minerals is not None:
            kinds = volume_minerals.kinds_of_minerals(minerals, read, reading, phases, **second)
        elif phases is not None:
            kinds = volume_minerals.kinds_of_file(phases, read, labels)
        else:
            kinds = volume_minerals.kinds_of(read, None, labels)
        made = made_of.specimen_of(read, kinds, chosen, progress)
    inputs.tell_lengths(made.extent, (made.mean_diameter,))
    named = (phases is not None or minerals is not None) and 0 in (kinds.minerals or {})
    zero = 0 in read.ids and 0 not in kinds.pores and not named
    _describe(made, read.source, folder, [_ZERO] if zero else [])


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
        from ..specimens.volumes import grain_table

        given = grain_table.read(file, options.pop("unit"))
        short_edge = options.pop("short_edge")
        made = grain_table.specimen_of(given, options, short_edge, progress)
    inputs.tell_lengths(made.extent, (made.mean_diameter,))
    off = grain_table.centroid_error(made, given)
    solids.describe(made, folder, {"centroid_error": off})
    share = off / made.mean_diameter
    terminal.say(f"  centroids are {100 * share:.2g} % of the mean diameter off, root mean square")


def _describe(made: SolidSpecimen, source: str, folder: Path, notes: list[str]) -> None:
    """Write and print the comparison with the volume, besides the files of any solid."""
    from ..report.volume_sections import volume_picture

    report = made.fit
    assert report is not None
    rows = zip(*report.columns.values(), strict=True)
    write_text(folder / "volume.csv", csv_text(report.columns, rows))
    volume_picture(folder / "volume.png", report)
    solids.describe(made, folder, {"volume": {"source": source, **report.totals}})
    terminal.say(tables.table(_figures(report.totals, made.mineral_names)))
    for line in notes + _notes(made, report):
        terminal.say(f"  note: {line}")
    if made.mineral_names:
        terminal.say(f"  minerals of the material, in this order: {', '.join(made.mineral_names)}")
    terminal.say(f"  files  {folder / 'volume.png'}, {folder / 'volume.csv'}")


def _figures(totals: Table, names: Sequence[str]) -> list[tuple[str, str]]:
    """Return the figures that are compared with the volume."""

    def shares(made: float, source: float) -> str:
        return f"{100 * made:.2f} %, of the voxels {100 * source:.2f} %"

    counts = " x ".join(map(str, totals["voxels"]))
    sizes = " x ".join(f"{1e3 * size:.4g}" for size in totals["voxel_size"])
    rows = [
        ("voxels along x, y, z", f"{counts}, each {sizes} mm"),
        ("voxels in the cell of their grain", f"{100 * totals['agreement']:.2f} %"),
        ("pores", shares(totals["pore_fraction"], totals["source_pore_fraction"])),
    ]
    for at, name in enumerate(names):
        made, source = (totals[f"{key}mineral_fractions"][at] for key in ("", "source_"))
        rows.append((name, shares(made, source)))
    return rows


def _notes(made: SolidSpecimen, report: VolumeReport) -> list[str]:
    from ..laboratory.forecast import SOFT, softness

    lines = []
    totals = report.totals
    if totals["stage"] == "start" and totals["agreement"] < _GOOD:
        lines.append("the fit found no better cells than its start: check the axes and the labels")
    if poor := report.poor_grains:
        lines.append(
            f"grains of which less than 80 % of the voxels are in the cell: {len(poor)}, in rows "
            f"{_named(poor)} of volume.csv, because they are small or far from convex"
        )
    if lost := totals["lost_grains"]:
        lines.append(f"grains without a cell: {len(lost)}, in rows {_named(lost)} of volume.csv")
    for name, what in (
        ("small_regions", "regions of fewer voxels than --least-voxels, merged with a neighbour"),
        ("small_pores", "pores of fewer voxels than --least-voxels, filled"),
        ("loose_grains", "grains that are not connected with the rest, removed"),
        ("grains_left_out", "grains of which the cells leave too little, left out"),
    ):
        if number := totals[name]:
            lines.append(f"{what}: {number}")
    if (divided := totals["divided_share"]) > _DIVIDED:
        lines.append(
            f"{100 * divided:.0f} % of the area of all boundaries divides regions of one label, "
            f"more than {100 * _DIVIDED:.0f} %: cracks may follow these boundaries; use labels "
            "of grains in place of --watershed"
        )
    soft = softness(made)
    if soft > SOFT:
        lines.append(
            f"contacts of the default material are {soft:.2g} times as compliant as grains of "
            "this size: give normal_stiffness and fracture energies for it"
        )
    return lines


def _named(rows: list[int]) -> str:
    shown = ", ".join(map(str, rows[:_MOST_NAMED]))
    return shown + (", ..." if len(rows) > _MOST_NAMED else "")
