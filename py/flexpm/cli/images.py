# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that make specimens of files of others: ``flexpm specimen image``, ``ebsd``, ``tess``.

SI units.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError
from ..files import Table, json_text, write_text
from ..report import tables
from ..require import POSITIVE, Bounds
from ..specimens.checks import SHORT_EDGE
from ..specimens.grain_source import traced
from ..specimens.space.spec import SHORT_EDGE as SOLID_SHORT_EDGE
from ..specimens.spec import GRAINS_FILE
from ..text import words_of
from . import inputs, solids, terminal
from . import options as cli_options
from .options import length_option
from .parameters import Count, Name, Quantity

if TYPE_CHECKING:
    from ..specimens.specimen import Specimen

_UNITS = {"diameter": (1e3, "mm"), "length": (1e3, "mm"), "edge": (1e3, "mm")}

#: Ratio of the edges within grains to the boundaries above which a message is printed [-].
_ADDED = 0.1
#: Out of plane [m].
_THICKNESS = 0.08
_thickness = length_option("--thickness", _THICKNESS, "Thickness out of plane", sizes=False)
_edge = click.option(
    "--edge",
    type=Quantity("m", POSITIVE),
    help="Spacing of vertices along smoothed grain boundaries [m].  [default: a quarter of the "
    "mean diameter]",
)
_smallest = click.option(
    "--smallest",
    type=Count(1),
    default=4,
    show_default=True,
    help="Smallest number of pixels of a grain; smaller regions are merged with a neighbour.",
)


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--pixel", type=Quantity("m", POSITIVE), required=True, help="Side of a pixel [m].")
@click.option(
    "--phases",
    type=click.Path(path_type=Path),
    help="TOML file: label or colour = mineral, or hole.  [default: each label is a grain]",
)
@click.option(
    "--minerals",
    type=click.Path(path_type=Path),
    help="Mineral of each grain: CSV file with columns id and mineral, or a second image of the "
    "same size with the phase of each pixel, which --phases then names.",
)
@_thickness
@_edge
@_smallest
@cli_options.out_option
@cli_options.quiet_option
def image(
    file: Path,
    pixel: float,
    phases: Path | None,
    minerals: Path | None,
    thickness: float,
    edge: float | None,
    smallest: int,
    out: Path,
    quiet: bool,
) -> None:
    """Make the grains of an image: PNG, TIFF, NPY or a .tesr file of Neper.

    Each label or colour is a grain. With --phases each is a phase, and the connected regions of a
    phase are grains. With --minerals each is a grain whose mineral is in a second file.
    """
    from ..specimens.labels import mineral_table, picture

    read = picture.read(file)
    if phases is None and minerals is None and read.has_voids:
        raise InputError("image label = 0, is void in a tesr file; give phases with 0 = hole")
    names: list[str] = []
    kinds = None
    if minerals is not None:
        names, kinds = mineral_table.of_image(minerals, read, phases)
    elif phases is not None:
        names, kinds = picture.indices(picture.read_phases(phases, read))
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet):
        inputs.load_yade()
        from ..specimens.specimen import Specimen

        made = Specimen.from_labels(
            read.labels, pixel, thickness, minerals=kinds, edge=edge, smallest=smallest
        )
    made = traced(made, file.name, pixel_size=[pixel])
    _describe(replace(made, mineral_names=tuple(names)), folder)


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--scale",
    type=Quantity("m", POSITIVE),
    default=1.0,
    show_default=True,
    help="Length of the unit of the file [m].",
)
@length_option("--thickness", _THICKNESS, "Thickness out of plane")
@click.option(
    "--short-edge",
    type=Quantity("", Bounds(at_least=0.0, below=0.5)),
    metavar="F",
    help="Collapse edges shorter than this share of the mean diameter; 0: none [-]. In 2D for "
    f"Laguerre cells only.  [default: 2D: {SHORT_EDGE:.3f}; 3D: {SOLID_SHORT_EDGE:.2f}]",
)
@cli_options.out_option
@cli_options.quiet_option
def tess(
    file: Path,
    scale: float,
    thickness: float | None,
    short_edge: float | None,
    out: Path,
    quiet: bool,
) -> None:
    """Make the cells of a tessellation of Neper, a 2D or 3D .tess file."""
    from ..specimens.files.neper_text import Words, tess_dimension

    given: Table = {} if short_edge is None else {"short_edge": short_edge}
    solid = tess_dimension(Words(file, "tess")) == 3
    if solid and thickness is not None:
        raise InputError(f"thickness = {thickness} m, must not be given for 3D cells; leave it out")
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet):
        inputs.load_yade()
        from ..specimens.specimen import Specimen

        if solid:
            made = Specimen.from_tess_solid(file, scale=scale, **given)
        else:
            flat = _THICKNESS if thickness is None else thickness
            plane = Specimen.from_tess(file, flat, scale=scale, **given)
    if solid:
        inputs.tell_lengths(made.extent, (made.mean_diameter,))
        solids.describe(made, folder)
    else:
        _describe(plane, folder)


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--misorientation",
    type=Quantity("degree", Bounds(above=0.0, at_most=180.0)),
    default=10.0,
    metavar="A",
    show_default=True,
    help="Smallest misorientation between two grains [degree].",
)
@click.option(
    "--unindexed",
    type=Name("fill", "hole"),
    default="fill",
    metavar="fill|hole",
    show_default=True,
    help="Treatment of points that were not indexed: assign to the most frequent neighbour, or "
    "make holes.",
)
@click.option(
    "--phases",
    type=click.Path(path_type=Path),
    help="TOML file: phase of the map = mineral, or hole.  [default: each phase is a mineral]",
)
@_thickness
@_edge
@_smallest
@cli_options.out_option
@cli_options.quiet_option
def ebsd(file: Path, thickness: float, out: Path, quiet: bool, **options: Any) -> None:
    """Make the grains of an EBSD map: .ctf, or .ang of a square or hexagonal grid."""
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet):
        inputs.load_yade()
        from ..specimens.specimen import Specimen

        made = Specimen.from_ebsd(file, thickness, **options)
    _describe(made, folder)


def _describe(made: Specimen, folder: Path) -> None:
    """Print the figures of the grains and write them with the specimen and its picture."""
    inputs.tell_lengths(made.extent, (made.mean_diameter,))
    import numpy as np

    from ..laboratory.forecast import SOFT, forecast, softness
    from ..report import maps
    from ..specimens.labels.measures import named, of_grains

    cells, names = made.tessellation, made.mineral_names
    grains = np.arange(cells.cells) if made.grains is None else made.grains
    found = of_grains(cells, grains, made.minerals, names)
    found |= {"cells": cells.cells, "contacts": len(cells.shared_edges)}
    found["sides_of_a_cell"] = float(np.diff(cells.cell_offsets).mean())
    source = named(made.regions.get("source", {}), names)
    counts = {key: one for key, one in made.regions.items() if key != "source"}
    if counts:
        found["image"] = counts
    write_text(folder / "specimen.json", json_text(found | {"source": source}))
    made.save(folder / GRAINS_FILE)
    cut = f" in {found['cells']} cells" if found["cells"] != found["grains"] else ""
    caption = f"{found['grains']} grains{cut}, {found['contacts']} contacts"
    drawn = folder / "specimen.png"
    polygons = maps.cell_polygons(cells)
    kinds = grains if made.minerals is None else made.minerals
    maps.grain_picture(drawn, polygons, kinds, names, caption)
    before = dict(_rows(source))
    rows = [
        (label, f"{value:14} source {before[label]}" if label in before else value)
        for label, value in _rows(found)
    ]
    terminal.say(tables.table(rows))
    expected = forecast(made)
    if expected is not None:
        steps = " to ".join(f"{float(f'{one:.2g}'):.0f}" for one in expected.steps)
        times = " to ".join(map(terminal.duration, expected.seconds))
        test = "compression" if made.kind == "rectangle" else "splitting"
        told = f"about {steps} steps, {times}"
        terminal.say(f"  its {test} with the default material, if it passes a peak: {told}")
    soft = softness(made)
    if soft > SOFT:
        terminal.say(
            f"  contacts of the default material are {soft:.2g} times as compliant as grains of "
            "this size: give normal_stiffness and fracture energies for it"
        )
    added = found["added_boundary_length"] / found["boundary_length"]
    if added > _ADDED:
        terminal.say(
            f"  cuts of grains into convex cells add {100 * added:.0f} % to the length of the "
            "boundaries, and cracks may follow them through a grain"
        )
    if names:
        terminal.say(f"  minerals of the material, in this order: {', '.join(names)}")
    files = (drawn, folder / "specimen.json", folder / GRAINS_FILE)
    terminal.say(f"  files  {', '.join(map(str, files))}")


def _rows(found: Table, before: str = "") -> list[tuple[str, str]]:
    rows = []
    for name, value in found.items():
        key = before or name
        label = f"{words_of(before)}, {words_of(name)}" if before else words_of(name)
        if isinstance(value, dict):
            rows += _rows(value, name)
        elif isinstance(value, int | str):
            rows.append((label, str(value)))
        else:
            ends = (one for part, one in _UNITS.items() if part in key)
            factor, unit = next(ends, (1.0, ""))
            rows.append((label, f"{factor * value:.4g} {unit}".rstrip()))
    return rows
