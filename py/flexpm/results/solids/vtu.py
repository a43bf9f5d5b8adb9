# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView files of solids: tetrahedra of grains, polygons of contacts, points of pairs. SI units.

Stress, traction and opening are positive in tension.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import VTK_POLYGON, VTK_TETRA, VTK_VERTEX

from ...arrays import FloatArray, IntArray
from ..arrays.vtu_arrays import CONTACT, GRAIN, PAIR, TENSOR, VECTOR, Named, made
from ..arrays.vtu_in_turn import GridInTurn, write_in_turn
from ..arrays.vtu_reader import Arrays, Grid
from .pairs import PressingPairs
from .state import SolidSnapshot

#: Components xx, yy, zz, yz, xz, xy in the order of a tensor's: XX, YY, ZZ, XY, YZ, XZ.
_ORDER = [0, 1, 2, 5, 3, 4]
#: Arrays of pairs besides their grains and positions.
_PAIR_ARRAYS = [one.name for one in fields(PressingPairs)][2:]


@dataclass(frozen=True)
class SolidShape:
    """Tetrahedra of grains, which share no node, contacts between them, and pairs that press.

    Attributes:
        nodes: Places of the nodes of all grains (n, 3) [m].
        tetrahedra: Four nodes each (m, 4).
        grains: Grain of each tetrahedron (m,).
        vertices: Places of the corners of contacts (k, 3) [m].
        corners: Vertices of contact after contact, counter-clockwise from outside its first grain.
        ends: First corner of each contact, and the end (c + 1,).
        grains_of_contacts: Both grains of each contact (c, 2).
        pairs: Pairs that press without a common face, q.
    """

    nodes: FloatArray
    tetrahedra: IntArray
    grains: IntArray
    vertices: FloatArray
    corners: IntArray
    ends: IntArray
    grains_of_contacts: IntArray
    pairs: PressingPairs = field(default_factory=PressingPairs.none)

    @property
    def cells(self) -> tuple[int, int, int]:
        """Numbers of tetrahedra, contacts and pairs."""
        return len(self.tetrahedra), len(self.grains_of_contacts), len(self.pairs)


def write_solid_vtu(
    path: Path | str,
    shape: SolidShape,
    minerals: IntArray | None = None,
    names: Sequence[str] = (),
) -> None:
    """Write a 3D specimen as one VTK unstructured grid, completely or not at all.

    Cell arrays: ``kind``, 0 for a tetrahedron and 1 for a contact; ``grain``, the grain of a
    tetrahedron or the first grain of a contact; ``neighbour``, the second grain of a contact, -1
    for a tetrahedron; with minerals ``mineral`` of a tetrahedron, -1 for a contact.

    Args:
        path: Name of the file, ending in .vtu.
        shape: The solid.
        minerals: Index of each grain's mineral; None without minerals.
        names: Names of the minerals, which are field data ``minerals``.
    """

    def of_grains() -> Iterator[vtkDataArray]:
        if minerals is None:
            return
        found = _blank(sum(shape.cells), minerals)
        found[: len(shape.grains)] = minerals[shape.grains]
        yield made("mineral", (found, ()))

    about = {"minerals": ", ".join(names)} if names else {}
    write_in_turn(path, _grid_of(shape, iter(()), of_grains()), about)


def write_solid_state(
    path: Path | str, snapshot: SolidSnapshot, about: Mapping[str, object] | None = None
) -> None:
    """Write the state of a solid, see ``write_vtu``; doc/files lists the arrays."""
    shape = SolidShape(
        snapshot.positions,
        snapshot.tetrahedra,
        snapshot.tetrahedron_grain,
        snapshot.corners,
        np.arange(len(snapshot.corners)),
        snapshot.corner_offsets,
        snapshot.contact_grains,
        snapshot.pairs,
    )
    grid = _grid_of(shape, _over_points(snapshot), _over_cells(snapshot, sum(shape.cells)))
    write_in_turn(path, grid, about or {})


def _over_points(snapshot: SolidSnapshot) -> Iterator[vtkDataArray]:
    nodes, ends = len(snapshot.positions), len(snapshot.positions) + len(snapshot.corners)
    points = ends + len(snapshot.pairs)

    def displacement() -> FloatArray:
        found = np.empty((points, 3))
        np.subtract(snapshot.positions, snapshot.reference, out=found[:nodes])
        np.subtract(snapshot.corners, snapshot.corner_reference, out=found[nodes:ends])
        found[ends:] = snapshot.centre_displacements[snapshot.pairs.grains].mean(axis=1)
        return found

    def velocity() -> FloatArray:
        found = np.zeros((points, 3))
        found[:nodes] = snapshot.velocities
        return found

    yield made("displacement", (displacement(), VECTOR))
    yield made("velocity", (velocity(), VECTOR))


def _over_cells(snapshot: SolidSnapshot, cells: int) -> Iterator[vtkDataArray]:
    first = len(snapshot.tetrahedra)
    yield from _of_grains(snapshot, cells)
    for block in (_of_contacts(snapshot), _of_pairs(snapshot.pairs)):
        for name, (values, components) in block.items():
            found = _blank(cells, values, len(components))
            found[first : first + len(values)] = values
            yield made(name, (found, components))
        first += len(snapshot.contact)


def _blank(rows: int, values: FloatArray | IntArray, columns: int = 0) -> FloatArray | IntArray:
    """An array over all cells of the kind of `values`: nan, or -1 of integers."""
    shape = (rows, columns) if columns else (rows,)
    if np.issubdtype(values.dtype, np.integer):
        return np.full(shape, -1, dtype=np.int32)
    return np.full(shape, np.nan)


def state_of_grid(grid: Grid) -> SolidSnapshot:
    """State of a grid that ``write_solid_state`` has written; points of a contact are alike there.

    Raises:
        ValueError, LookupError: if it has no solid of flexpm.
    """
    cells, corners = grid.cells, grid.corners
    count, pairs = (int(np.count_nonzero(cells["kind"] == kind)) for kind in (GRAIN, PAIR))
    end = len(cells["kind"]) - pairs
    bonds = {name: values[count:end] for name, values in cells.items()}
    tetrahedra = corners[: 4 * count].reshape(-1, 4)
    if not (count and len(tetrahedra) == count and np.all(np.isfinite(grid.places))):
        raise ValueError("cells")
    nodes = int(tetrahedra.max()) + 1
    offsets = np.concatenate(([0], np.cumsum(np.diff(grid.ends[count - 1 : end]))))
    owner = cells["grain"][:count]
    ends = len(grid.places) - pairs
    reference = grid.places[:ends] - grid.points["displacement"][:ends]
    each = bonds["points"]
    points = np.concatenate(([0], np.cumsum(each)))
    row = np.repeat(np.arange(len(each)), each)
    cracked = np.arange(len(row)) - points[row] < bonds["cracked_points"][row]
    volumes = np.bincount(owner, _volumes(reference[tetrahedra])).astype(float, copy=False)
    if not (owner.min() >= 0 and len(volumes) <= count and offsets[-1] == len(reference) - nodes):
        raise ValueError("grains or contacts")
    blank = np.full((len(row), 3), np.nan)
    return SolidSnapshot(
        positions=grid.places[:nodes],
        reference=reference[:nodes],
        velocities=grid.points["velocity"][:nodes],
        forces=np.zeros((nodes, 3)),
        node_offsets=np.zeros(0, dtype=int),
        centres=np.zeros((0, 3)),
        volumes=volumes,
        tetrahedra=tetrahedra,
        tetrahedron_grain=owner,
        tetrahedron_stress=cells["stress"][:count][:, np.argsort(_ORDER)],
        surface=np.zeros((0, 3), dtype=int),
        surface_grain=np.zeros(0, dtype=int),
        surface_side=np.zeros(0, dtype=int),
        contact_grains=np.column_stack([bonds["grain"], bonds["neighbour"]]),
        corner_offsets=offsets,
        corner_reference=reference[nodes:],
        corners=grid.places[nodes:ends],
        areas=bonds["area"],
        point_offsets=points,
        point_area=bonds["area"][row] / each[row],
        point_position=blank,
        point_opening=bonds["opening"][row],
        point_slip=np.column_stack((bonds["slip"][row], np.zeros(len(row)))),
        point_damage=bonds["damage"][row],
        point_traction=np.column_stack(
            (bonds["normal_traction"][row], bonds["shear_traction"][row], np.zeros(len(row)))
        ),
        crack_step=np.where(cracked, 0, -1),
        crack_mode=np.where(cracked, bonds["crack_mode"][row], 0),
        crack_position=blank,
        crack_energy=np.full(len(row), np.nan),
        grain_mineral=_minerals_of(cells, owner, len(volumes)),
        pairs=_pairs_of(cells, end, grid.places[ends:]) if pairs else PressingPairs.none(),
        contact_joint=bonds.get("joint"),
    )


def _pairs_of(cells: Arrays, first: int, places: FloatArray) -> PressingPairs:
    """Pairs of a grid from its cell `first` on, whose points are `places`."""
    grains = np.column_stack([cells["grain"][first:], cells["neighbour"][first:]])
    return PressingPairs(
        grains, places, **{name: cells[f"pair_{name}"][first:] for name in _PAIR_ARRAYS}
    )


def _minerals_of(cells: Arrays, owner: IntArray, grains: int) -> IntArray | None:
    """Mineral of each grain of a grid; None if it tells of none."""
    if "mineral" not in cells:
        return None
    found = np.zeros(grains, dtype=int)
    found[owner] = cells["mineral"][: len(owner)]
    if found.min() < 0:
        raise ValueError("minerals")
    return found


def _volumes(corners: FloatArray) -> FloatArray:
    """Volume of tetrahedra by their corners, (M, 4, 3)."""
    a, b, c = (corners[:, k] - corners[:, 0] for k in (1, 2, 3))
    volumes: FloatArray = np.abs(np.einsum("ij,ij->i", a, np.cross(b, c))) / 6.0
    return volumes


def _grid_of(
    shape: SolidShape, points: Iterator[vtkDataArray], cells: Iterator[vtkDataArray]
) -> GridInTurn:
    """Return the grid of a shape, with additional arrays."""
    tetrahedra, _, pairs = shape.cells
    first_pair = len(shape.nodes) + len(shape.vertices)
    counts = (first_pair + pairs, sum(shape.cells))
    both = np.concatenate((shape.grains_of_contacts, shape.pairs.grains))

    def every_cell() -> Iterator[vtkDataArray]:
        kinds = np.array([GRAIN, CONTACT, PAIR], dtype=np.int32)
        yield made("kind", (np.repeat(kinds, shape.cells), ()))
        yield made("grain", (np.concatenate((shape.grains, both[:, 0])), ()))
        second = _blank(sum(shape.cells), both)
        second[tetrahedra:] = both[:, 1]
        yield made("neighbour", (second, ()))
        del second
        yield from cells

    def places() -> Iterator[vtkDataArray]:
        rows = (shape.nodes, shape.vertices, shape.pairs.position)
        yield _plain("Points", numpy_to_vtk(np.vstack(rows)))

    def corners() -> Iterator[vtkDataArray]:
        own = (shape.corners + len(shape.nodes), first_pair + np.arange(pairs))
        joint = np.concatenate((shape.tetrahedra.ravel(), *own)).astype(np.int64, copy=False)
        yield _plain("connectivity", numpy_to_vtk(joint))
        first = 4 * np.arange(1, tetrahedra + 1)
        ends = np.concatenate((first, 4 * tetrahedra + shape.ends[1:]))
        last = ends[-1] + np.arange(1, pairs + 1)
        ends = np.concatenate((ends, last)).astype(np.int64, copy=False)
        yield _plain("offsets", numpy_to_vtk(ends))
        types = np.array([VTK_TETRA, VTK_POLYGON, VTK_VERTEX], dtype=np.uint8)
        yield _plain("types", numpy_to_vtk(np.repeat(types, shape.cells)))

    return GridInTurn(counts, points, every_cell(), places(), corners())


def _plain(name: str, array: vtkDataArray) -> vtkDataArray:
    array.SetName(name)
    return array


def _of_grains(snapshot: SolidSnapshot, rows: int) -> Iterator[vtkDataArray]:
    """Yield arrays of tetrahedra one by one, because all stresses are a tenth of a state."""
    grain, mineral = snapshot.tetrahedron_grain, snapshot.grain_mineral

    def scalar(name: str, values: FloatArray | IntArray) -> vtkDataArray:
        found = _blank(rows, values)
        found[: len(grain)] = values
        return made(name, (found, ()))

    def tensor(name: str, stress: FloatArray, owner: IntArray | None = None) -> vtkDataArray:
        found = _blank(rows, stress, len(TENSOR))
        for to, component in enumerate(_ORDER):
            values = stress[:, component]
            found[: len(grain), to] = values if owner is None else values[owner]
        return made(name, (found, TENSOR))

    yield scalar("fragment", snapshot.fragments.labels[grain])
    yield tensor("stress", snapshot.tetrahedron_stress)
    yield tensor("grain_stress", snapshot.grain_stress, grain)
    principal = snapshot.principal_stresses
    for number in (1, 2, 3):
        yield scalar(f"principal_stress_{number}", principal[:, 3 - number])
    if mineral is not None:
        yield scalar("mineral", mineral[grain])


def _of_contacts(snapshot: SolidSnapshot) -> dict[str, Named]:
    """Arrays of contacts: means by the areas of their points, the largest opening and slip."""
    row, count = snapshot.point_contact, len(snapshot.contact_grains)
    shares = snapshot.point_area / snapshot.areas[row]

    def mean(values: FloatArray) -> FloatArray:
        return np.bincount(row, shares * values, minlength=count).astype(float, copy=False)

    def largest(values: FloatArray) -> FloatArray:
        found = np.full(count, -np.inf)
        np.maximum.at(found, row, values)
        return found

    slip, shear = (
        np.linalg.norm(values, axis=1)
        for values in (snapshot.point_slip, snapshot.point_traction[:, 1:])
    )
    broken = snapshot.crack_step >= 0
    last = np.full(count, -1)
    np.maximum.at(last, row, snapshot.crack_step)
    latest = broken & (snapshot.crack_step == last[row])
    mode = np.zeros(count, dtype=int)
    np.maximum.at(mode, row[latest], snapshot.crack_mode[latest])
    arrays: dict[str, FloatArray | IntArray] = {
        "contact": snapshot.contact,
        "area": snapshot.areas,
        "points": np.diff(snapshot.point_offsets),
        "damage": mean(snapshot.point_damage),
        "opening": largest(snapshot.point_opening),
        "slip": largest(slip),
        "normal_traction": mean(snapshot.point_traction[:, 0]),
        "shear_traction": mean(shear),
        "cracked_points": np.bincount(row[broken], minlength=count),
        "crack_mode": mode,
    }
    if snapshot.contact_joint is not None:
        arrays["joint"] = snapshot.contact_joint
    return {name: (values, ()) for name, values in arrays.items()}


def _of_pairs(pairs: PressingPairs) -> dict[str, Named]:
    """Arrays of pairs, of files that have any: other states keep their files."""
    if not len(pairs):
        return {}
    components = {"force": VECTOR}
    return {
        f"pair_{name}": (getattr(pairs, name), components.get(name, ())) for name in _PAIR_ARRAYS
    }
