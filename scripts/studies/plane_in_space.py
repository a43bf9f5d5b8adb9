# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare the plane with itself in space: the same cells, extruded by one layer of prisms.

Spheres with their centres in a plane have the plane's cells as prisms. Between frictionless planes
in front and behind, which hold the nodes along y, they are in plane strain. Each packing is
compressed or pulled by the same loading three times: in the plane, in the plane with the normals of
the edges, as faces of space have them (D66), and in space. One CSV row for all three; rows that are
there are passed over. SI units. Start it from a checkout that scripts/setup has built; the second
command prints how far the peaks are apart:

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/plane_in_space.py both.csv uniaxial
    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/plane_in_space.py both.csv --table
"""

from __future__ import annotations

import argparse
import csv
from itertools import product
from pathlib import Path
from typing import NamedTuple
from unittest import mock

import numpy as np
from growing_table import add_row

import flexpm
from flexpm._flexpm import AssemblyInput
from flexpm.materials.material import load
from flexpm.models import assembly
from flexpm.runs.loading_rate import rates_of
from flexpm.specimens.space.specimen import SolidSpecimen

import yade  # isort: skip  (flexpm knows where it is)

FRONT, BACK = 4, 5
plane_input = assembly._input


class Run(NamedTuple):
    """What tells runs apart."""

    test: str
    width: float  #: half the height [m]
    depth: float  #: of the layer [m]
    rate: float  #: factor on the plane's default, of the layer, too [-]
    seed: int


class Found(NamedTuple):
    """What a test has found."""

    contacts: int
    modulus: float  #: below a quarter of the peak [Pa]
    peak: float  #: [Pa]
    steps: int


KINDS = ("plane", "edges", "space")
FIELDS = (*Run._fields, *(f"{kind}_{of}" for kind in KINDS for of in Found._fields))


def prisms(plane: flexpm.Specimen, depth: float) -> SolidSpecimen:
    """Extrude the cells of a rectangle: its y is z, its thickness along y."""
    x, y = plane.centres.T
    rows = np.column_stack((x, np.full(len(x), 0.5 * depth), y, plane.radii))
    sizes = plane.dimensions
    return flexpm.Specimen.from_spheres(
        rows, width=sizes["width"], depth=depth, height=sizes["height"], short_edge=0.0
    )


def with_edge_normals(grains: assembly.Grains) -> AssemblyInput:
    """The plane's input, whose contacts take the normals of their edges; no option asks for it."""
    cells = plane_input(grains)
    cells.outer = np.ones(len(grains.tessellation.shared_edges), dtype=np.int32)
    cells.edge_normals = True
    return cells


def tested(made: flexpm.Specimen | SolidSpecimen, run: Run, *, edges: bool = False) -> Found:
    """Compress or pull deformable grains past their peak."""
    yade.O.reset()
    own, plane = (
        rates_of(run.test, "flexible", solid=solid).constant
        for solid in (isinstance(made, SolidSpecimen), False)
    )
    material = load("augig-table7").with_set(plane="strain")
    if isinstance(made, SolidSpecimen):
        built = flexpm.build(made, material)
        for side in (FRONT, BACK):
            built.solver.holdSide(side, y=True)
    else:
        chosen = with_edge_normals if edges else plane_input
        with mock.patch.object(assembly, "_input", chosen):
            built = flexpm.build(made, material, mesh="fan")
    rig = flexpm.rig(built, tension=run.test == "tension")
    rig.load(flexpm.Loading(kind="waiting", rate=run.rate * plane / own))
    stress, strain = rig.record["axial_stress"], rig.record["axial_strain"]
    peak = int(np.argmax(stress))
    early = (stress > 0.05 * stress[peak]) & (stress < 0.25 * stress[peak])
    early &= np.arange(len(stress)) < peak
    modulus = float(np.polyfit(strain[early], stress[early], 1)[0])
    return Found(built.solver.counts()["contacts"], modulus, float(stress[peak]), yade.O.iter)


def row_of(run: Run) -> list[float | str]:
    """Do the three runs of a packing."""
    plane = flexpm.Specimen.rectangle(
        run.width, 2.0 * run.width, run.depth, seed=run.seed, short_edge=0.0
    )
    found = (
        tested(plane, run),
        tested(plane, run, edges=True),
        tested(prisms(plane, run.depth), run),
    )
    return [*run, *(value for one in found for value in one)]


def read(table: Path) -> dict[Run, list[str]]:
    """Rows that are there."""
    if not table.exists():
        return {}
    with table.open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    return {Run(row[0], *map(float, row[1:4]), int(row[4])): row for row in rows}


def print_table(rows: dict[Run, list[str]]) -> None:
    """Peaks in space over those of the plane, and over those with the normals of the edges."""
    sets: dict[tuple[object, ...], list[list[float]]] = {}
    for run, row in rows.items():
        peaks = [float(row[FIELDS.index(f"{kind}_peak")]) / 1e6 for kind in KINDS]
        sets.setdefault(run[:4], []).append(peaks)
    for key, peaks in sets.items():
        plane, edges, space = np.array(peaks).T
        print(*key, "peaks", *(f"{one.mean():.2f}" for one in (plane, edges, space)))
        for name, base in (("plane", plane), ("edges", edges)):
            each = ", ".join(f"{100.0 * (ratio - 1.0):+.1f}" for ratio in space / base)
            mean = 100.0 * (space.mean() / base.mean() - 1.0)
            print(f"   over {name}: {each} %, means {mean:+.2f} %")


def main() -> None:
    """Do the runs that are not in the table, or print what they have found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("tests", nargs="*", help="uniaxial, tension")
    parser.add_argument("--table", action="store_true", dest="show", help="print the ratios")
    parser.add_argument("--width", type=float, default=0.02, help="half the height [m]")
    parser.add_argument("--depths", type=float, nargs="+", default=[6e-3], help="of the layer [m]")
    parser.add_argument("--rate", type=float, default=0.25, help="factor on the default [-]")
    options = parser.parse_args()
    rows = read(options.table)
    if options.show:
        print_table(rows)
        return
    for test, depth, seed in product(options.tests, options.depths, (1, 2, 3, 4, 5)):
        run = Run(test, options.width, depth, options.rate, seed)
        if run in rows:
            continue
        add_row(options.table, FIELDS, row_of(run))


if __name__ == "__main__":
    main()
