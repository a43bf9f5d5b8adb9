# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView files of solids: grains as tetrahedra, contacts as polygons, in one .vtu. SI units.

Stress, traction and opening are positive in tension.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_POLYGON,
    VTK_TETRA,
    vtkCellArray,
    vtkUnstructuredGrid,
)

from ...arrays import FloatArray, IntArray
from ..arrays.vtu_arrays import (
    CONTACT,
    GRAIN,
    TENSOR,
    VECTOR,
    Named,
    add,
    describe,
    joined,
    write_grid,
)
from ..arrays.vtu_reader import Arrays, Grid
from .state import SolidSnapshot

#: Components xx, yy, zz, yz, xz, xy in the order of a tensor's: XX, YY, ZZ, XY, YZ, XZ.
_ORDER = [0, 1, 2, 5, 3, 4]


@dataclass(frozen=True)
class SolidShape:
    """Tetrahedra of grains, which share no node, and contacts between them.

    Attributes:
        nodes: Places of the nodes of all grains (n, 3) [m].
        tetrahedra: Four nodes each (m, 4).
        grains: Grain of each tetrahedron (m,).
        vertices: Places of the corners of contacts (k, 3) [m].
        contacts: Vertices of each contact, counter-clockwise from outside its first grain.
        pairs: Both grains of each contact (c, 2).
    """

    nodes: FloatArray
    tetrahedra: IntArray
    grains: IntArray
    vertices: FloatArray
    contacts: Sequence[IntArray]
    pairs: IntArray


def write_solid_vtu(path: Path | str, shape: SolidShape) -> None:
    """Write a solid as one VTK unstructured grid, whole or not at all.

    Cell arrays: ``kind``, 0 of a tetrahedron and 1 of a contact; ``grain``, the grain of a
    tetrahedron and the first one of a contact; ``neighbour``, the second one, -1 of a tetrahedron.

    Args:
        path: Name of the file, ending in .vtu.
        shape: The solid.
    """
    write_grid(path, _grid_of(shape))


def write_solid_state(
    path: Path | str, snapshot: SolidSnapshot, about: Mapping[str, object] | None = None
) -> None:
    """Write the state of a solid, see ``write_vtu``; doc/files lists the arrays."""
    firsts = snapshot.corner_offsets
    own = [np.arange(*firsts[k : k + 2]) for k in range(len(firsts) - 1)]
    shape = SolidShape(
        snapshot.positions,
        snapshot.tetrahedra,
        snapshot.tetrahedron_grain,
        snapshot.corners,
        own,
        snapshot.contact_grains,
    )
    grid = _grid_of(shape)
    moved = (snapshot.positions - snapshot.reference, snapshot.corners - snapshot.corner_reference)
    still = np.zeros_like(snapshot.corners)
    add(grid.GetPointData(), "displacement", (np.concatenate(moved), VECTOR))
    add(grid.GetPointData(), "velocity", (np.concatenate((snapshot.velocities, still)), VECTOR))
    for name, array in joined(_of_grains(snapshot), _of_contacts(snapshot)).items():
        add(grid.GetCellData(), name, array)
    for name, value in (about or {}).items():
        describe(grid.GetFieldData(), name, value)
    write_grid(path, grid)


def state_of_grid(grid: Grid) -> SolidSnapshot:
    """State of a grid that ``write_solid_state`` has written; points of a contact are alike there.

    Raises:
        ValueError, LookupError: if it has no solid of flexpm.
    """
    cells, corners = grid.cells, grid.corners
    count = int(np.count_nonzero(cells["kind"] == GRAIN))
    bonds = {name: values[count:] for name, values in cells.items()}
    tetrahedra = corners[: 4 * count].reshape(-1, 4)
    if not (count and len(tetrahedra) == count and np.all(np.isfinite(grid.places))):
        raise ValueError("cells")
    nodes = int(tetrahedra.max()) + 1
    offsets = np.concatenate(([0], np.cumsum(np.diff(grid.ends[count - 1 :]))))
    owner = cells["grain"][:count]
    reference = grid.places - grid.points["displacement"]
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
        corners=grid.places[nodes:],
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


def _grid_of(shape: SolidShape) -> vtkUnstructuredGrid:
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.vstack((shape.nodes, shape.vertices)), deep=True))
    grid.SetPoints(points)
    own = [np.asarray(contact) + len(shape.nodes) for contact in shape.contacts]
    corners = np.concatenate([shape.tetrahedra.ravel(), *own])
    sizes = np.array([4] * len(shape.tetrahedra) + [len(one) for one in own])
    ends = np.concatenate(([0], np.cumsum(sizes)))
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(ends.astype(np.int64), deep=True),
        numpy_to_vtkIdTypeArray(corners.astype(np.int64), deep=True),
    )
    count = (len(shape.tetrahedra), len(own))
    types = np.repeat(np.array([VTK_TETRA, VTK_POLYGON], dtype=np.uint8), count)
    grid.SetCells(numpy_to_vtk(types, deep=True), cells)
    none = np.full(len(shape.tetrahedra), -1)
    arrays: dict[str, IntArray] = {
        "kind": np.repeat(np.array([GRAIN, CONTACT]), count),
        "grain": np.concatenate((shape.grains, shape.pairs[:, 0])),
        "neighbour": np.concatenate((none, shape.pairs[:, 1])),
    }
    for name, values in arrays.items():
        add(grid.GetCellData(), name, (values, ()))
    return grid


def _of_grains(snapshot: SolidSnapshot) -> dict[str, Named]:
    stress, grain = snapshot.tetrahedron_stress, snapshot.tetrahedron_grain
    mineral = snapshot.grain_mineral
    kinds: dict[str, Named] = {} if mineral is None else {"mineral": (mineral[grain], ())}
    principal = np.linalg.eigvalsh(_matrices(stress)) if np.all(np.isfinite(stress)) else stress
    return {
        "fragment": (snapshot.fragments.labels[grain], ()),
        "stress": (stress[:, _ORDER], TENSOR),
        "grain_stress": (snapshot.grain_stress[grain][:, _ORDER], TENSOR),
        "principal_stress_1": (principal[:, 2], ()),
        "principal_stress_2": (principal[:, 1], ()),
        "principal_stress_3": (principal[:, 0], ()),
        **kinds,
    }


def _matrices(stress: FloatArray) -> FloatArray:
    found: FloatArray = stress[:, [0, 5, 4, 5, 1, 3, 4, 3, 2]].reshape(-1, 3, 3)
    return found


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
    return {name: (values, ()) for name, values in arrays.items()}
