# SPDX-License-Identifier: GPL-3.0-or-later
"""Stress intensity in space, by the growth of the compliance of beams with a notch.

Beams on a span of 2.5 heights, with contacts a hundred times stiffer than the rock's that do not
break. The compliance of the elastic solution grows with the notch; fitted to that by the handbook's
K_I and by E / (1 - nu^2) of the same grains, its growth is the square of what is printed.

    layer    one layer of prisms between frictionless planes, and the plane with the same polygons
    beam     a beam of grains in space, of a thickness in grains

One CSV row a case; rows that are there are passed over. SI units. Start it from a checkout that
scripts/setup has built:

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/solid_notches.py table.csv layer 80
    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/solid_notches.py table.csv beam 16
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from growing_table import add_row, rows_of
from plane_in_space import BACK, FRONT, prisms

import flexpm
from flexpm.kinds import toughness
from flexpm.laboratory.part_tests import notch_depth
from flexpm.materials.material import Material
from flexpm.rigs.part_rig import PartRig
from flexpm.rigs.parts import HeldNodes
from flexpm.rigs.solids.part_rig import SolidPartRig
from flexpm.specimens.space.notch import notched
from flexpm.specimens.space.specimen import SolidSpecimen

import yade  # isort: skip  (flexpm knows where it is)

HEIGHT = 0.04
WIDTH, SPAN = 2.8 * HEIGHT, 2.5 * HEIGHT
#: Notches over the height of the beam.
RATIOS = np.linspace(0.2, 0.6, 5)
#: Grains over the thickness of a beam in space.
THICK = 8
FIELDS = ("kind", "across", "seed", "grains", "intensity", "of_plane", "modulus", "seconds")


class Found(NamedTuple):
    """What the notches of a specimen come to."""

    intensity: float  #: K_I over the handbook's [-]
    modulus: float  #: E / (1 - nu^2) of the specimen without a notch [Pa]


def rock() -> Material:
    """Rock whose grains deform nearly alone, in plane strain."""
    granite = flexpm.materials.load("augig-table7")
    stiff = {"normal_stiffness": 100.0 * granite.law("flexible")["normal_stiffness"]}
    return granite.with_set({**stiff, "plane": "strain"}, "flexible")


def on_nodes(rig: PartRig, deep: float | None) -> float:
    """Load over the way of a beam that the nodes nearest to the three places bear [N/m]."""
    _, places = rig.built.solver.nodePlaces(bonded=True)
    along, up = places[:, 0], places[:, -1]
    axis = "y" if deep is None else "z"

    def hold(x: float, height: float, axes: str) -> HeldNodes:
        there = np.abs(up - height) < 1e-9
        nearest = along[there][np.argmin(np.abs(along[there] - x))]
        return rig.hold(
            where=lambda x, *rest: (np.abs(x - nearest) < 1e-9)
            & (np.abs(rest[-1] - height) < 1e-9),
            axes=axes,
        )

    middle = 0.5 * WIDTH
    ends = [hold(middle + side * SPAN / 2, 0.0, axis) for side in (-1, 1)]
    head = hold(middle, HEIGHT, "x" + axis)
    down = (0.0, -1.0) if deep is None else (0.0, 0.0, -1.0)
    rig.drive([head], down, against=ends)
    return rig.scales().modulus


def on_rollers(rig: SolidPartRig, deep: float) -> float:
    """The same of a beam of solid grains between lines across its depth [N/m]."""
    middle = 0.5 * WIDTH
    ends = [rig.support((middle + side * SPAN / 2, 0.5 * deep, 0.0)) for side in (-1, 1)]
    head = rig.support((middle, 0.5 * deep, HEIGHT), pinned=True)
    rig.drive([head], (0.0, 0.0, -1.0), against=ends)
    solution = rig.elastic(displacement=1e-9)
    return solution.load / solution.way


def plane_beam(cut: flexpm.Specimen) -> float:
    """Load over the way of a beam in the plane [N/m]."""
    yade.O.reset()
    material = rock().with_set({"joint.notch.open": True}, "flexible")
    built = flexpm.build(cut, material, mesh="fan")
    # the contacts of the notch would bear what the first elastic solution presses on them
    on = set(np.flatnonzero(cut.edge_joints >= 0))
    for one in [one for one in yade.O.interactions if one.phys.contact in on]:
        yade.O.interactions.erase(one.id1, one.id2)
    return on_nodes(PartRig(built), None)


def built_in_space(specimen: SolidSpecimen, layer: bool) -> SolidPartRig:
    """A solid, whose front and back are held if it is a layer."""
    yade.O.reset()
    built = flexpm.build(specimen, rock())
    for side in (FRONT, BACK) if layer else ():
        built.solver.holdSide(side, y=True)
    return SolidPartRig(built)


def space_beam(cut: SolidSpecimen, layer: bool) -> float:
    """Load over the way of a beam in space [N/m]."""
    rig, deep = built_in_space(cut, layer), cut.dimensions["depth"]
    return on_nodes(rig, deep) if layer else on_rollers(rig, deep)


def between_platens(specimen: SolidSpecimen, layer: bool) -> float:
    """Modulus of a block between smooth platens [Pa]."""
    rig = built_in_space(specimen, layer)
    bottom, top = rig.platen(0), rig.platen(2)
    sizes = specimen.dimensions
    area = sizes["width"] * sizes["depth"]
    rig.drive([top], (0.0, 0.0, -1.0), against=[bottom], area=area, length=sizes["height"])
    return rig.scales().modulus


def squared(depth: float, thickness: float) -> float:
    """Square of the handbook's K_I under a unit load [Pa2 m / N2]."""
    sizes = {"span": SPAN, "height": HEIGHT, "thickness": thickness}
    return toughness.bending_toughness(1.0, notch=depth, **sizes) ** 2 if depth > 0.0 else 0.0


def fitted(depths: list[float], stiffnesses: list[float], modulus: float, thick: float) -> float:
    """K_I over the handbook's, from the growth of compliances with the depth of the notch."""
    grid = np.linspace(0.0, 1.001 * max(depths), 2000)
    values = np.array([squared(float(depth), thick) for depth in grid])
    sums = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(grid))])
    theory = 2.0 * thick / modulus * np.interp(depths, grid, sums)
    slope, _ = np.polyfit(theory, 1.0 / np.array(stiffnesses), 1)
    return math.sqrt(slope)


def of_plane(specimen: flexpm.Specimen) -> Found:
    """A beam in plane strain."""
    depths, stiffnesses = [], []
    for ratio in RATIOS:
        line = [[0.5 * WIDTH, 0.0], [0.5 * WIDTH, ratio * HEIGHT]]
        cut = specimen.with_joints({"notch": line})
        depths.append(notch_depth(cut))
        stiffnesses.append(plane_beam(cut))
    modulus = flexpm.elastic(specimen, rock(), mesh="fan")["youngs_modulus"]
    return Found(fitted(depths, stiffnesses, modulus, specimen.thickness), modulus)


def of_space(specimen: SolidSpecimen, layer: bool) -> Found:
    """A beam in space."""
    depths, stiffnesses = [], []
    for ratio in RATIOS:
        cut = notched(specimen, [(0.5 * WIDTH, ratio * HEIGHT, False)])
        depths += cut.depths()
        stiffnesses.append(space_beam(cut, layer))
    modulus = between_platens(specimen, layer)
    if not layer:
        poisson = flexpm.elastic(specimen, rock())["poissons_ratio"]
        modulus /= 1.0 - poisson**2
    return Found(fitted(depths, stiffnesses, modulus, specimen.dimensions["depth"]), modulus)


def layer(across: int, seed: int) -> tuple[int, Found, Found]:
    """A layer as thick as one grain, and the plane with its polygons."""
    mean = HEIGHT / across
    grains = (2.0 / 3.0 * mean, 4.0 / 3.0 * mean)
    plane = flexpm.Specimen.rectangle(
        WIDTH, HEIGHT, mean, diameters=grains, seed=seed, short_edge=0.0
    )
    return len(plane.radii), of_space(prisms(plane, mean), True), of_plane(plane)


def beam(across: int, seed: int) -> tuple[int, Found, None]:
    """A beam of grains in space."""
    mean = HEIGHT / across
    solid = flexpm.Specimen.box(
        WIDTH, THICK * mean, HEIGHT, diameters=(2.0 / 3.0 * mean, 4.0 / 3.0 * mean), seed=seed
    )
    return len(solid.radii), of_space(solid, False), None


KINDS: dict[str, Callable[[int, int], tuple[int, Found, Found | None]]] = {
    "layer": layer,
    "beam": beam,
}


def main() -> None:
    """Do one case."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the row")
    parser.add_argument("kind", choices=KINDS, help="layer or beam")
    parser.add_argument("across", type=int, help="grains over the height")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    case = (options.kind, options.across, options.seed)
    if any(
        (row["kind"], int(row["across"]), int(row["seed"])) == case
        for row in rows_of(options.table)
    ):
        return
    began = time.process_time()
    grains, found, plane = KINDS[options.kind](options.across, options.seed)
    of = "" if plane is None else found.intensity / plane.intensity
    seconds = round(time.process_time() - began)
    add_row(options.table, FIELDS, (*case, grains, found.intensity, of, found.modulus, seconds))


if __name__ == "__main__":
    main()
