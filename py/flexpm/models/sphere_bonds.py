# SPDX-License-Identifier: GPL-3.0-or-later
"""Bonds of YADE's own bonded models on the edges that grains share: the mapping rule. SI units.

A bond represents a shared edge of length L and area A = L t. Its parameters follow from the
material's rigid elastic set and strengths:

    k_n = K_n A,  k_s = eta k_n,  k_b = K_n A L^2 / 12  (bending; CohFrict only),
    F_t = sigma_t A,  F_s = c A + mu F_n  (F_n compressive positive).

A single bond thus carries in tension and in shear the sum of the contact points of its edge. A bond
in 3D represents a shared face with its area A and its polar moment J about the centroid. Its
bending stiffness is K_n J / 2, the mean over all axes of the face, and its twisting stiffness is
eta K_n J. Deviation D92. Both models break suddenly: fracture energies are not used. Strengths are
forces and magnitudes.

Grains of several minerals have the law of their pair, as in the other models (deviation D27).

If an interaction range is given, pairs within this range are also bonded (deviation D61). In 2D
they get an edge across their middle, with the diameter of the smaller disc as its length. In 3D
they get a disc with the diameter of the smaller sphere.
"""

from __future__ import annotations

import operator
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial, reduce

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import InputError
from ..materials.material import Law, Material
from ..materials.mixing import description, mineral_materials, pair_materials
from ..specimens.mineral_map import minerals_of
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import AnySpecimen, Specimen
from .sphere_faces import Faces, outer_faces, shared_faces

#: Smallest part of a disc or sphere that may be left of it between outline and neighbours [-].
SMALLEST_SPHERE = 1e-6


@dataclass(frozen=True)
class Laws:
    """Effective parameters of grains and of their pairs, from ``Material.law``."""

    minerals: IntArray  #: of each grain
    grains: Sequence[Law]  #: of each mineral, of the rock if grains are alike
    pairs: Sequence[Law]  #: of contacts of minerals i and j, at i times their number plus j

    @property
    def are_alike(self) -> bool:
        """Whether all grains have the same law."""
        return len(self.grains) == 1

    def of_grains(self, key: str) -> FloatArray:
        """Return the value of a key for each grain, (n,)."""
        values: FloatArray = _values(self.grains, key)[self.minerals]
        return values

    def of_contacts(self, key: str, grains: IntArray) -> FloatArray:
        """Return the value of a key for each contact, (n,), with the grains (n, 2)."""
        first, second = self.minerals[grains].T
        values: FloatArray = _values(self.pairs, key)[first * len(self.grains) + second]
        return values

    def mean(self, key: str) -> float:
        """Return the mean of a key over the grains; the exact value if all grains are equal."""
        if self.are_alike:
            return float(_values(self.grains, key)[0])
        return float(np.mean(self.of_grains(key)))


def laws_of(specimen: AnySpecimen, material: Material, model: str) -> Laws:
    """Return the effective parameters of the minerals of a specimen and of their pairs.

    Args:
        specimen: The grains.
        material: Material of the rock.
        model: Name of the model.

    Raises:
        InputError: for minerals that the model does not support or that are not consistent.
    """
    description(material, model)
    found = minerals_of(specimen, material)
    if found is None:
        found = np.zeros(len(specimen.radii), dtype=np.int32)
    grains, pairs = mineral_materials(material), pair_materials(material, model)
    return Laws(found, [one.law(model) for one in grains], [one.law(model) for one in pairs])


def _values(laws: Sequence[Law], key: str) -> FloatArray:
    return np.array([{**law}[key] for law in laws], dtype=float)


@dataclass(frozen=True)
class Bonds:
    """Properties of all bonds, one row for each bond."""

    grains: IntArray  #: (n, 2)
    ends: FloatArray  #: ends of the shared edges, (n, 2, 2), middles of the faces, (n, 1, 3) [m]
    areas: FloatArray  #: A [m2]
    normal_stiffness: FloatArray  #: k_n [N/m]
    shear_stiffness: FloatArray  #: k_s [N/m]
    bending_stiffness: FloatArray  #: k_b [N m]
    twisting_stiffness: FloatArray  #: k_t [N m]
    tensile_strength: FloatArray  #: F_t [N]
    shear_strength: FloatArray  #: F_s without friction [N]
    friction: FloatArray  #: mu [-]

    def __len__(self) -> int:
        return len(self.grains)

    def chosen(self, rows: BoolArray) -> Bonds:
        """Return the bonds whose rows are true, (n,)."""
        return Bonds(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})


def in_order(values: Iterable[float]) -> float:
    """Return the sum of numbers from first to last, rounded after each addition.

    ``sum`` yields other bits since Python 3.12, which compensates rounding errors.
    """
    return reduce(operator.add, values, 0.0)


def bonds_of(specimen: AnySpecimen, laws: Laws, interaction_range: float | None = None) -> Bonds:
    """Return the bonds of a specimen.

    Args:
        specimen: The grains; each edge, in 3D each face, that two grains share has a bond.
        laws: Effective parameters.
        interaction_range: Ratio of the largest distance of bonded discs to the sum of their radii
            [-]; None: only discs that share an edge or a face are bonded.

    Returns:
        The bonds.
    """
    if isinstance(specimen, SolidSpecimen):
        return _bonds_of_solid(specimen, laws, interaction_range)
    cells = specimen.tessellation
    edges = np.array(cells.shared_edges, dtype=int).reshape(-1, 4)
    grains, ends = edges[:, :2], np.array(cells.vertices)[edges[:, 2:4]]
    if interaction_range is not None:
        farther = _farther_pairs(specimen, grains, interaction_range)
        farther = farther[~_meet_outline(specimen, specimen.centres[farther])]
        grains = np.concatenate((grains, farther))
        ends = np.concatenate((ends, _edges_across(specimen, farther)))
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    areas = lengths * specimen.thickness
    bonds = _bonds(laws, grains, ends, areas)
    bending = bonds.normal_stiffness * lengths**2 / 12.0
    # nothing twists in the plane, but YADE's energy divides by the stiffness
    return replace(bonds, bending_stiffness=bending, twisting_stiffness=bending)


def _bonds_of_solid(specimen: SolidSpecimen, laws: Laws, interaction_range: float | None) -> Bonds:
    faces = shared_faces(specimen)
    if interaction_range is not None:
        farther = _farther_pairs(specimen, faces.grains, interaction_range)
        added = _discs_across(specimen, farther)
        faces = Faces(*(np.concatenate(both) for both in zip(faces, added, strict=True)))
    bonds = _bonds(laws, faces.grains, faces.middles[:, None], faces.areas)
    bending = bonds.normal_stiffness / faces.areas * (0.5 * faces.moments)
    twisting = bonds.shear_stiffness / faces.areas * faces.moments
    return replace(bonds, bending_stiffness=bending, twisting_stiffness=twisting)


def _bonds(laws: Laws, grains: IntArray, ends: FloatArray, areas: FloatArray) -> Bonds:
    """Return bonds that do not resist rotations."""
    of_bonds = partial(laws.of_contacts, grains=grains)
    normal = of_bonds("normal_stiffness") * areas
    return Bonds(
        grains=grains,
        ends=ends,
        areas=areas,
        normal_stiffness=normal,
        shear_stiffness=of_bonds("shear_ratio") * normal,
        bending_stiffness=np.zeros(len(areas)),
        twisting_stiffness=np.zeros(len(areas)),
        tensile_strength=of_bonds("tensile_strength") * areas,
        shear_strength=of_bonds("cohesion") * areas,
        friction=of_bonds("friction"),
    )


def _farther_pairs(specimen: AnySpecimen, bonded: IntArray, interaction_range: float) -> IntArray:
    """Return the pairs of discs or spheres within a range that share no edge or face, (n, 2)."""
    from scipy.spatial import cKDTree

    centres, radii = specimen.centres, specimen.radii
    farthest = 2.0 * interaction_range * float(radii.max())
    pairs = cKDTree(centres).query_pairs(farthest, output_type="ndarray").astype(int)
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    apart = np.hypot.reduce(centres[pairs[:, 1]] - centres[pairs[:, 0]], axis=1)
    near = apart < interaction_range * radii[pairs].sum(axis=1)
    known = {(min(pair), max(pair)) for pair in bonded.tolist()}
    new = np.array([tuple(pair) not in known for pair in pairs.tolist()], dtype=bool)
    found: IntArray = pairs[near & new]
    return found


def _meet_outline(specimen: Specimen, lines: FloatArray) -> BoolArray:
    """Return whether lines between inner points, (n, 2, 2) [m], intersect an outer edge."""
    cells = specimen.tessellation
    outer = np.array(cells.boundary_edges, dtype=int)[:, 1:3]
    start, end = np.moveaxis(np.array(cells.vertices)[outer], 1, 0)
    met = [
        np.any(
            (_side(a, b, start) != _side(a, b, end))
            & (_side(start, end, a) != _side(start, end, b))
        )
        for a, b in lines
    ]
    return np.array(met, dtype=bool)


def _side(start: FloatArray, end: FloatArray, point: FloatArray) -> BoolArray:
    """Return whether points are left of lines."""
    along, to = end - start, point - start
    left: BoolArray = along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0] > 0.0
    return left


def _edges_across(specimen: Specimen, pairs: IntArray) -> FloatArray:
    """Return the ends of the edges of pairs without a shared edge [m]; D61.

    The length of each edge is the diameter of the smaller disc.
    """
    centres, radii = specimen.centres[pairs], specimen.radii[pairs]
    along = centres[:, 1] - centres[:, 0]
    along /= np.hypot(*along.T)[:, None]
    gap = 0.5 * (centres[:, 0] + radii[:, :1] * along + centres[:, 1] - radii[:, 1:] * along)
    half = radii.min(axis=1)[:, None] * np.column_stack((-along[:, 1], along[:, 0]))
    return np.stack((gap - half, gap + half), axis=1)


def _discs_across(specimen: SolidSpecimen, pairs: IntArray) -> Faces:
    """Return discs with the smaller sphere's diameter between pairs without a shared face (D61)."""
    centres, radii = specimen.centres[pairs], specimen.radii[pairs]
    along = centres[:, 1] - centres[:, 0]
    along /= np.hypot.reduce(along, axis=1)[:, None]
    gap = 0.5 * (centres[:, 0] + radii[:, :1] * along + centres[:, 1] - radii[:, 1:] * along)
    smaller = radii.min(axis=1)
    areas = np.pi * smaller**2
    return Faces(pairs, gap, areas, 0.5 * areas * smaller**2)


def tributary_sizes(specimen: AnySpecimen, side: int) -> dict[int, float]:
    """Return the length [m], in 3D the area [m2], of a specimen side that belongs to each grain.

    Args:
        specimen: The grains.
        side: Index of the side; of a rectangle 0 bottom, 1 right, 2 top, 3 left; of a 3D specimen 0
            bottom, 2 top.

    Returns:
        Length or area by grain.
    """
    if isinstance(specimen, SolidSpecimen):
        grains, sides, vectors = outer_faces(specimen)
        sizes: dict[int, float] = {}
        for row in np.flatnonzero(sides == side).tolist():
            area = float(np.hypot.reduce(vectors[row]))
            sizes[int(grains[row])] = sizes.get(int(grains[row]), 0.0) + area
        return sizes
    cells = specimen.tessellation
    vertices = np.array(cells.vertices)
    lengths: dict[int, float] = {}
    for cell, start, end, edge_side in np.array(cells.boundary_edges, dtype=int).tolist():
        if edge_side == side:
            length = float(np.hypot(*(vertices[end] - vertices[start])))
            lengths[cell] = lengths.get(cell, 0.0) + length
    return lengths


def separate_radii(specimen: AnySpecimen) -> FloatArray:
    """Return radii [m] that are reduced until no discs overlap and none leaves the specimen.

    Radii are reduced disc by disc; the outline counts for a rectangle or a 3D specimen. CohFrict
    does not keep the reference distance of a broken bond, so that overlapping discs would fly
    apart. Each pair shares its distance in the ratio of its radii.

    Raises:
        InputError: for a disc whose radius becomes 0 because its centre is on the outline.
    """
    from scipy.spatial import cKDTree

    centres, radii = specimen.centres, specimen.radii
    pairs = cKDTree(centres).query_pairs(2.0 * float(radii.max()), output_type="ndarray")
    apart = np.hypot.reduce(centres[pairs[:, 0]] - centres[pairs[:, 1]], axis=1)
    share = np.minimum(1.0, apart / radii[pairs].sum(axis=1))
    factor = np.ones(len(radii))
    for column in (0, 1):
        np.minimum.at(factor, pairs[:, column], share)
    shrunk: FloatArray = factor * radii
    shrunk = np.minimum(shrunk, specimen.wall_distances())
    least = int(np.argmin(shrunk))
    if not shrunk[least] > SMALLEST_SPHERE * radii[least]:
        raise InputError(
            f"cohfrict: grain {least}: radius that leaves neither outline nor neighbours = "
            f"{shrunk[least]:g} m, must be at least {SMALLEST_SPHERE:g} of {radii[least]:g}; "
            "move its centre inwards or use jcfpm"
        )
    return shrunk


def stiffness_bounds(
    centres: FloatArray, radii: FloatArray, bonds: Bonds, bending: bool
) -> tuple[FloatArray, FloatArray]:
    """Return upper bounds of the row sums of the stiffness matrix, by grain.

    Rotations are scaled by the disc radius, so that both types of motion have the same unit. The
    lever arms of a bond divide the distance of its two centres.

    Args:
        centres: Centres of the spheres, (n, 2), in 3D (n, 3) [m].
        radii: Radii of the spheres, (n,) [m].
        bonds: Bonds of the spheres.
        bending: Whether bonds resist bending.

    Returns:
        Bounds for translations [N/m] and for rotations [N m], (n,) each.
    """
    first, second = bonds.grains.T
    apart = np.hypot.reduce(centres[second] - centres[first], axis=1)
    overlap = radii[first] + radii[second] - apart
    # levers over radii: what a unit of each grain's rotation moves at the contact point
    levers = [1.0 - 0.5 * overlap / radii[first], 1.0 - 0.5 * overlap / radii[second]]
    shares = levers[0] + levers[1]
    move, turn = np.zeros(len(radii)), np.zeros(len(radii))
    turning = np.maximum(bonds.bending_stiffness, bonds.twisting_stiffness)
    bend = turning if bending else np.zeros(len(bonds))
    for grain, other, lever in ((first, second, levers[0]), (second, first, levers[1])):
        np.add.at(
            move,
            grain,
            2.0 * np.maximum(bonds.normal_stiffness, bonds.shear_stiffness)
            + bonds.shear_stiffness * np.abs(shares),
        )
        row = bonds.shear_stiffness * np.abs(lever) * (2.0 + np.abs(shares)) * radii[grain] ** 2
        np.add.at(turn, grain, row + bend * (1.0 + radii[grain] / radii[other]))
    return move, turn


def touched_bounds(
    specimen: AnySpecimen,
    radii: FloatArray,
    bonds: Bonds,
    stiffness: FloatArray,
    bending: bool,
) -> tuple[FloatArray, FloatArray]:
    """Return upper bounds of the stiffness of each sphere, contacts with plates included.

    Args:
        specimen: The grains.
        radii: Radii of the spheres, (n,) [m].
        bonds: Properties of the bonds.
        stiffness: K_n of each grain, (n,) [Pa/m].
        bending: Whether bonds resist bending.

    Returns:
        Bounds for translations [N/m] and for rotations [N m], (n,) each.
    """
    move, turn = stiffness_bounds(specimen.centres, radii, bonds, bending)
    if isinstance(specimen, SolidSpecimen):
        outer = outer_faces(specimen)
        rim = np.unique(outer[0])
        sides = np.zeros(len(radii))
        np.add.at(sides, outer[0], np.hypot.reduce(outer[2], axis=1))
        # a plate touches it with the stiffness of its face there, or of its section
        move[rim] += 2.0 * stiffness[rim] * np.maximum(sides, 4.0 * radii**2)[rim]
        return move, turn
    rim = np.unique(np.array(specimen.tessellation.boundary_edges, dtype=int)[:, 0])
    # a plate touches a sphere of the rim with about the stiffness of its diameter
    move[rim] += 2.0 * stiffness[rim] * 2.0 * radii[rim] * specimen.thickness
    return move, turn
