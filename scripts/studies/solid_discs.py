# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean elastic stresses of a prism in the middle of solid discs, over those of the plane's field.

Discs of 3 mm grains, contacts a hundred times as stiff as the rock's. The facet on top goes down
against that below; along x both are

    held    as by the plates of a Brazilian test
    free    as under the field's forces, which push along z alone

The prism is 0.2 D wide and high and goes through the thickness; its tetrahedra are clipped to it.
The field is that of two line forces; what strips as wide as a facet make of it stands beside it.
Stresses along y are over 2 P / (pi D t), in tension. Rows of seed 0 are homogeneous discs between
such facets, by quadratic finite elements: what grains would come to if they were fine.

Adds one CSV row a disc and passes over rows that are there. SI units. Start it from a checkout that
scripts/setup has built; the second command prints means and standard errors:

    export PYTHONPATH=build/python
    /usr/bin/python3 scripts/studies/solid_discs.py solid_discs.csv
    /usr/bin/python3 scripts/studies/solid_discs.py solid_discs.csv --table
"""

from __future__ import annotations

import argparse
import itertools
import math
import statistics
import time
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple, get_type_hints

import numpy as np
from growing_table import add_row, rows_of
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import cg

import flexpm
from flexpm.arrays import BoolArray, FloatArray, IntArray
from flexpm.results.solids.state import SolidSnapshot
from flexpm.specimens.space.specimen import SolidSpecimen

import yade  # isort: skip  (flexpm knows where it is)

DIAMETERS, RATIOS, SEEDS = (0.036, 0.050, 0.072), (0.25, 0.5, 1.0), (0, 1, 2, 3)
MATERIAL, STIFFER = "augig-table7", 100.0
#: Mean diameter of the default grains [m].
GRAIN = 0.003
#: Width of the prism over the diameter [-].
PRISM = 0.2
#: Points along an edge of a tetrahedron by which it is clipped, and of a finite element.
ALONG, EACH = 5, 5
#: Parts of the thickness, from 0 to 1.
LAYERS = {
    "whole": ((0.0, 1.0),),
    "middle": ((1.0 / 3.0, 2.0 / 3.0),),
    "faces": ((0.0, 1.0 / 6.0), (5.0 / 6.0, 1.0)),
}
AXES = {"across": 0, "along": 2, "through": 1}
RESULTS = tuple(f"{layer}_{axis}" for layer in LAYERS for axis in AXES)
FIELDS = (
    *("diameter", "ratio", "facet", "seed", *RESULTS, "strip_across", "strip_along"),
    *("facets", "grains", "seconds"),
)
#: Along what a facet under the plates is held, beside z.
FACETS = {"held": "x", "free": ""}


class Case(NamedTuple):
    """What tells discs apart."""

    diameter: float  #: [m]
    ratio: float  #: of the thickness to it [-]
    facet: str
    seed: int


class Load(NamedTuple):
    """What presses a disc."""

    diameter: float  #: [m]
    depth: float  #: [m]
    force: float  #: [N]


class Sampled(NamedTuple):
    """Stresses at places of a disc."""

    places: FloatArray  #: (N, 3) [m]
    volumes: FloatArray  #: that each stands for, to a factor, (N,)
    stress: FloatArray  #: xx, yy and zz, (N, 3) [Pa]


def line_forces(x: FloatArray, z: FloatArray, load: Load) -> tuple[FloatArray, FloatArray]:
    """Stresses xx and zz under two line forces along z [Pa]: Timoshenko and Goodier, sec. 41."""
    radius = 0.5 * load.diameter
    above, below = x * x + (radius - z) ** 2, x * x + (radius + z) ** 2
    scale = 2.0 * load.force / (math.pi * load.depth)
    even = 1.0 / load.diameter
    across = x * x * (radius - z) / above**2 + x * x * (radius + z) / below**2
    along = (radius - z) ** 3 / above**2 + (radius + z) ** 3 / below**2
    return scale * (even - across), scale * (even - along)


def strips(x: FloatArray, z: FloatArray, load: Load, half: float) -> tuple[FloatArray, FloatArray]:
    """The same under strips: pairs of forces that are turned by angles up to a half [rad]."""
    nodes, weights = np.polynomial.legendre.leggauss(5)
    across, along = np.zeros_like(x), np.zeros_like(x)
    for angle, weight in zip(half * nodes, 0.5 * weights, strict=True):
        cosine, sine = math.cos(angle), math.sin(angle)
        u, w = cosine * x - sine * z, sine * x + cosine * z
        radius = 0.5 * load.diameter
        above, below = u * u + (radius - w) ** 2, u * u + (radius + w) ** 2
        scale = 2.0 * load.force / (math.pi * load.depth)
        shear = scale * (u * (radius - w) ** 2 / above**2 - u * (radius + w) ** 2 / below**2)
        first, second = line_forces(u, w, load)
        across += weight * (first * cosine**2 + second * sine**2 + 2.0 * shear * sine * cosine)
        along += weight * (first * sine**2 + second * cosine**2 - 2.0 * shear * sine * cosine)
    return across, along


@lru_cache(maxsize=1)
def packed(diameter: float, depth: float, seed: int) -> SolidSpecimen:
    """A disc, kept for its other facets."""
    return flexpm.Specimen.solid_disc(diameter, depth, seed=seed)


def solved(specimen: SolidSpecimen, facet: str) -> tuple[SolidSnapshot, float]:
    """The elastic state of a disc between its facets below and on top, and its load [N]."""
    rock = flexpm.materials.load(MATERIAL)
    stiff = {"normal_stiffness": STIFFER * rock.law("flexible")["normal_stiffness"]}
    yade.O.reset()
    built = flexpm.build(specimen, rock.with_set(stiff, "flexible"))
    rig = flexpm.SolidPartRig(built)
    _, places = built.solver.nodePlaces(bonded=True)
    top, near = places[:, 2].max(), 1e-6 * specimen.dimensions["diameter"]
    low, high = (
        rig.hold(where=lambda x, y, z, at=at: np.abs(z - at) < near, axes=FACETS[facet] + "z")
        for at in (-top, top)
    )
    # what is left of a rigid body's motion
    free = {"front": "x", "back": "xy"} if facet == "free" else {"front": "y"}
    for side, axes in free.items():
        at = (0.0, specimen.dimensions["depth"] if side == "back" else 0.0, 0.0)
        nearest = places[np.argmin(np.sum((places - at) ** 2, axis=1))]
        rig.hold(ball=(tuple(nearest), near), axes=axes)
    rig.drive([high], (0.0, 0.0, -1.0), against=[low])
    state = rig.elastic(displacement=1e-9)
    return state, state.load


def sampled(state: SolidSnapshot, half: float) -> Sampled:
    """Stresses of the tetrahedra within half a width along x and z, at points all over each [m]."""
    corners = state.reference[state.tetrahedra]
    low, high = corners[..., (0, 2)].min(axis=1), corners[..., (0, 2)].max(axis=1)
    near = np.flatnonzero(np.all((low < half) & (high > -half), axis=1))
    corners = corners[near]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    steps = np.arange(ALONG)
    shares = np.array(
        [(i, j, k) for i in steps for j in steps[: ALONG - i] for k in steps[: ALONG - i - j]]
    )
    shares = np.column_stack((shares, ALONG - 1 - shares.sum(axis=1))) + 0.25
    places = np.einsum("pc,tci->tpi", shares / ALONG, corners).reshape(-1, 3)
    each = len(shares)
    stress = state.tetrahedron_stress[near, :3]
    return Sampled(places, np.repeat(volumes, each), np.repeat(stress, each, axis=0))


def shaped(at: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The 27 shapes of an element at places in it from -1 to 1, and their slopes."""
    values = [np.array([c * (c - 1.0) / 2.0, 1.0 - c * c, c * (c + 1.0) / 2.0]) for c in at]
    slopes = [np.array([c - 0.5, -2.0 * c, c + 0.5]) for c in at]
    along = []
    for axis in range(3):
        a, b, c = (slopes[k] if k == axis else values[k] for k in range(3))
        along.append(np.einsum("i,j,k->ijk", a, b, c).ravel())
    return np.einsum("i,j,k->ijk", *values).ravel(), np.array(along)


class Elements(NamedTuple):
    """An eighth of a disc with a radius of 1 about the y axis."""

    nodes: FloatArray  #: (N, 3)
    of: IntArray  #: nodes of each element, (M, 27)
    pressed: BoolArray  #: whether a node lies on the facet on top

    def strains(self, at: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Places, sizes, and strains by displacements, at a place in each element."""
        corners, (values, slopes) = self.nodes[self.of], shaped(at)
        jacobian = np.einsum("eni,jn->eij", corners, slopes)
        x, y, z = np.einsum("jn,eji->ien", slopes, np.linalg.inv(jacobian))
        found = np.zeros((len(corners), 6, 27, 3))
        found[:, 0, :, 0], found[:, 1, :, 1], found[:, 2, :, 2] = x, y, z
        found[:, 3, :, 1], found[:, 3, :, 2] = z, y
        found[:, 4, :, 0], found[:, 4, :, 2] = z, x
        found[:, 5, :, 0], found[:, 5, :, 1] = y, x
        sizes = np.abs(np.linalg.det(jacobian))
        places = np.einsum("n,eni->ei", values, corners)
        return places, sizes, found.reshape(len(corners), 6, 81)


def meshed(ratio: float, half: float) -> Elements:
    """Elements of a disc whose facets go over a half angle [rad]; fine where they press."""
    edge = math.sqrt(2.0) * math.sin(half)
    fine = np.array([0.0, 0.5, 1.0, 2.0, 4.0]) * edge
    rest = np.linspace(fine[-1], 1.0, 5)[1:]
    grids = [
        np.concatenate((fine, rest)),
        np.array([0.0, 0.2, 0.4, 0.6, 0.725, 0.85, 0.925, 1.0]) * ratio,
        1.0 - np.concatenate((fine, rest))[::-1],
    ]
    lines = [np.sort(np.concatenate((one, 0.5 * (one[1:] + one[:-1])))) for one in grids]
    a, y, b = np.meshgrid(*lines, indexing="ij")
    nodes = np.stack((a * np.sqrt(1.0 - 0.5 * b * b), y, b * np.sqrt(1.0 - 0.5 * a * a)), axis=-1)
    numbers = np.arange(a.size).reshape(a.shape)
    firsts = (range(0, len(one) - 1, 2) for one in lines)
    of = [
        numbers[i : i + 3, j : j + 3, k : k + 3].ravel() for i, j, k in itertools.product(*firsts)
    ]
    pressed = (b.ravel() == b.max()) & (a.ravel() < edge * (1.0 + 1e-9))
    return Elements(nodes.reshape(-1, 3), np.array(of), pressed)


def homogeneous(case: Case, half: float) -> tuple[Sampled, float]:
    """The back half of a homogeneous disc between facets of a half angle [rad], and its load [N].

    Young's modulus is 1 Pa.
    """
    poisson = flexpm.materials.load(MATERIAL).law("flexible")["poisson"]
    elastic = np.diag([1.0 / (1.0 + poisson)] * 3 + [0.5 / (1.0 + poisson)] * 3)
    elastic[:3, :3] += poisson / (1.0 + poisson) / (1.0 - 2.0 * poisson)
    mesh = meshed(case.ratio, half)
    places, weights = np.polynomial.legendre.leggauss(3)
    blocks = np.zeros((len(mesh.of), 81, 81))
    for i, j, k in itertools.product(range(3), repeat=3):
        _, sizes, strains = mesh.strains(places[[i, j, k]])
        sizes *= weights[[i, j, k]].prod()
        blocks += np.einsum("eki,kl,elj,e->eij", strains, elastic, strains, sizes, optimize=True)
    unknowns = (3 * mesh.of[:, :, None] + np.arange(3)).reshape(len(mesh.of), 81)
    rows, columns = np.repeat(unknowns, 81, axis=1), np.tile(unknowns, (1, 81))
    matrix = coo_matrix((blocks.ravel(), (rows.ravel(), columns.ravel()))).tocsr()
    held = mesh.nodes < 1e-12  # by symmetry
    held[mesh.pressed, 2] = True
    if case.facet == "held":
        held[mesh.pressed, 0] = True
    moved = np.zeros(held.shape)
    moved[mesh.pressed, 2] = -1.0
    free, ways = ~held.ravel(), moved.ravel()
    part = matrix[free][:, free]
    scale = diags(1.0 / part.diagonal())
    ways[free], status = cg(part, -(matrix @ ways)[free], tol=1e-7, maxiter=10_000, M=scale)
    assert status == 0
    load = -4.0 * float((matrix @ ways).reshape(-1, 3)[mesh.pressed, 2].sum())
    even = (np.arange(EACH) + 0.5) / EACH * 2.0 - 1.0
    parts = []
    for at in itertools.product(even, repeat=3):
        where, sizes, strains = mesh.strains(np.array(at))
        stress = np.einsum("ij,ejk,ek->ei", elastic, strains, ways[unknowns], optimize=True)
        parts.append((where, sizes, stress[:, :3]))
    where, sizes, stress = (np.concatenate(one) for one in zip(*parts, strict=True))
    radius = 0.5 * case.diameter
    where[:, 1] += case.ratio  # the middle lies at half the depth
    return Sampled(radius * where, sizes, stress), load * radius**2


def row_of(case: Case) -> list[object]:
    """Solve a disc."""
    began = time.process_time()
    diameter, depth = case.diameter, case.ratio * case.diameter
    half = 0.5 * PRISM * diameter
    # the mantle does not depend on the depth
    specimen = packed(diameter, depth if case.seed else 3.0 * GRAIN, case.seed)
    facets = len(specimen.outline().walls) - 2
    grains = len(specimen.radii) if case.seed else 0
    if case.seed:
        state, force = solved(specimen, case.facet)
        found = sampled(state, half)
    else:
        found, force = homogeneous(case, math.pi / facets)
    (x, y, z), load = found.places.T, Load(diameter, depth, force)
    prism = (np.abs(x) < half) & (np.abs(z) < half)
    fields = [*line_forces(x, z, load), np.full(len(x), 2.0 * force / math.pi / diameter / depth)]
    cells: list[float] = []
    for parts in LAYERS.values():
        chosen = np.zeros(len(x), dtype=bool)
        for begin, end in parts:
            chosen |= prism & (y >= begin * depth) & (y < end * depth)
        weights = found.volumes[chosen]
        for axis, field in zip(AXES.values(), fields, strict=True):
            told = np.average(field[chosen], weights=weights)
            cells.append(float(np.average(found.stress[chosen, axis], weights=weights) / told))
    spread = strips(x[prism], z[prism], load, math.pi / facets)
    weights = found.volumes[prism]
    for one, field in zip(spread, fields, strict=False):
        cells.append(float(np.average(one, weights=weights)))
        cells[-1] /= float(np.average(field[prism], weights=weights))
    seconds = round(time.process_time() - began)
    return [*case, *(round(cell, 5) for cell in cells), facets, grains, seconds]


def read(table: Path) -> dict[Case, dict[str, str]]:
    """Rows that are there."""
    kinds = get_type_hints(Case)
    return {Case(*(kinds[name](row[name]) for name in Case._fields)): row for row in rows_of(table)}


def print_table(rows: dict[Case, dict[str, str]]) -> None:
    """Print means over the packings and their standard errors; of homogeneous discs values."""
    names = [*RESULTS, "strip_across", "strip_along"]
    print("facet", "grains across", "ratio", "packings", *names, sep=", ")
    kinds: dict[Case, list[dict[str, str]]] = {}
    for case, row in rows.items():
        kinds.setdefault(case._replace(seed=min(case.seed, 1)), []).append(row)
    for kind, of in sorted(kinds.items(), key=lambda one: (one[0].facet, *one[0])):
        cells = []
        for name in names:
            values = [float(row[name]) for row in of]
            cells.append(f"{statistics.mean(values):.3f}")
            if len(of) > 1 and name in RESULTS:
                error = statistics.stdev(values) / math.sqrt(len(of))
                cells[-1] += f" ± {error:.4f}"
        across = round(kind.diameter / GRAIN)
        print(kind.facet, across, kind.ratio, len(of) if kind.seed else "-", *cells, sep=", ")


def main() -> None:
    """Solve discs, or print what was found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("diameters", nargs="*", type=float, default=DIAMETERS, help="of discs [m]")
    parser.add_argument("--ratios", nargs="*", type=float, default=RATIOS, help="of thickness")
    parser.add_argument("--table", action="store_true", dest="show", help="print the means")
    options = parser.parse_args()
    rows = read(options.table)
    if options.show:
        print_table(rows)
        return
    for diameter in options.diameters:
        for seed in SEEDS:
            for ratio in options.ratios:
                for case in (Case(diameter, ratio, facet, seed) for facet in FACETS):
                    if case not in rows:
                        add_row(options.table, FIELDS, row_of(case))


if __name__ == "__main__":
    main()
