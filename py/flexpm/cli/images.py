# SPDX-License-Identifier: GPL-3.0-or-later
"""Command that makes specimens of images: ``flexpm specimen image``. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..errors import InputError
from ..files import Table, json_text, write_text
from ..report import tables
from ..require import POSITIVE
from ..specimens.spec import GRAINS_FILE
from ..text import words_of
from . import inputs, terminal
from . import options as cli_options
from .options import length_option
from .parameters import Count, Quantity

if TYPE_CHECKING:
    from ..specimens.specimen import Specimen

_UNITS = {"diameter": (1e3, "mm"), "length": (1e3, "mm"), "edge": (1e3, "mm")}


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--pixel", type=Quantity("m", POSITIVE), required=True, help="Side of a pixel [m].")
@click.option(
    "--phases",
    type=click.Path(path_type=Path),
    help="TOML file: label or colour = mineral, or hole.  [default: labels are of grains]",
)
@length_option("--thickness", 0.08, "Thickness out of plane", sizes=False)
@click.option(
    "--edge",
    type=Quantity("m", POSITIVE),
    help="Way between corners of boundaries [m].  [default: a quarter of the mean diameter]",
)
@click.option(
    "--smallest",
    type=Count(1),
    default=4,
    show_default=True,
    help="Regions with fewer pixels go to a neighbour.",
)
@cli_options.out_option
@cli_options.quiet_option
def image(
    file: Path,
    pixel: float,
    phases: Path | None,
    thickness: float,
    edge: float | None,
    smallest: int,
    out: Path,
    quiet: bool,
) -> None:
    """The grains of an image: PNG, TIFF or NPY, a label or a colour for each grain or phase."""
    from ..specimens.labels import picture

    read = picture.read(file)
    names: list[str] = []
    minerals = None
    if phases is not None:
        names, minerals = picture.indices(picture.read_phases(phases, read))
    folder = inputs.locked_folder(out)
    with terminal.Progress(quiet):
        inputs.load_yade()
        from ..specimens.specimen import Specimen

        made = Specimen.from_labels(
            read.labels, pixel, thickness, minerals=minerals, edge=edge, smallest=smallest
        )
    _describe(made, folder, names)


def _describe(made: Specimen, folder: Path, names: Sequence[str]) -> None:
    """Print the figures of the grains and write them with the specimen and its picture."""
    from ..report import maps
    from ..specimens.labels.measures import of_grains

    if made.grains is None:
        raise InputError("specimen = no grains, must come of an image")
    found = of_grains(made.tessellation, made.grains, made.minerals, names)
    found |= {"cells": made.tessellation.cells, "contacts": len(made.tessellation.shared_edges)}
    found["image"] = made.regions
    write_text(folder / "specimen.json", json_text(found))
    made.save(folder / GRAINS_FILE)
    caption = f"{found['grains']} grains, {found['contacts']} contacts"
    drawn = folder / "specimen.png"
    polygons = maps.cell_polygons(made.tessellation)
    kinds = made.grains if made.minerals is None else made.minerals
    maps.grain_picture(drawn, polygons, kinds, names, caption)
    terminal.say(tables.table(_rows(found)))
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
        elif isinstance(value, int):
            rows.append((label, str(value)))
        else:
            ends = (one for part, one in _UNITS.items() if part in key)
            factor, unit = next(ends, (1.0, ""))
            rows.append((label, f"{factor * value:.4g} {unit}".rstrip()))
    return rows
