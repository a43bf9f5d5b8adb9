# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView files of a specimen: grains as triangles, contacts as lines, in one .vtu. SI units.

Stress, traction and opening are positive in tension. The arrays are listed in the documentation.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_LINE,
    VTK_TRIANGLE,
    vtkCellArray,
    vtkDataSetAttributes,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import InputError
from ..files import whole_file
from .snapshot import POINT_SHARES, Snapshot

#: Coordinates [m] beyond this are nowhere; nan is, too.
_FARTHEST = 1e100

GRAIN, CONTACT = 0, 1  #: values of the cell array `kind`

_TENSOR = ("XX", "YY", "ZZ", "XY", "YZ", "XZ")
_VECTOR = ("X", "Y", "Z")

#: An array and the names of its components.
Named = tuple[FloatArray | IntArray, tuple[str, ...]]


class Drawing(NamedTuple):
    """What a drawing of a specimen needs: M triangles and C contacts of P points."""

    positions: FloatArray  #: of the nodes, then of the ends of the contacts, (N, 2) [m]
    triangles: IntArray  #: nodes of each triangle, (M, 3)
    triangle_grain: IntArray  #: (M,)
    triangle_mineral: IntArray  #: of its grain, (M,)
    contact: IntArray  #: number of each contact, (C,)
    contact_grains: IntArray  #: (C, 2)
    contact_ends: FloatArray  #: (C, 2, 2) [m]
    bonded: BoolArray  #: whether each point holds, (C, P)


def write_vtu(path: Path | str, snapshot: Snapshot) -> None:
    """Write `snapshot` as one VTK unstructured grid, whole or not at all.

    Args:
        path: Name of the file, ending in .vtu.
        snapshot: The state.
    """
    grid = vtkUnstructuredGrid()
    _set_geometry(grid, snapshot)
    for name, array in point_arrays(snapshot).items():
        _add(grid.GetPointData(), name, array)
    for name, array in cell_arrays(snapshot).items():
        _add(grid.GetCellData(), name, array)
    grid.GetPointData().SetActiveVectors("displacement")
    grid.GetCellData().SetActiveAttribute("stress", vtkDataSetAttributes.TENSORS)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToLZ4()
    content = _written(writer)
    with whole_file(path) as temporary:
        temporary.write_bytes(content)


def _written(writer: vtkXMLUnstructuredGridWriter) -> bytes:
    """What VTK writes, by way of the memory: it does not tell that a disk refused a part."""
    with os.fdopen(os.memfd_create("flexpm"), "rb") as file:
        writer.SetFileName(f"/proc/self/fd/{file.fileno()}")
        if writer.Write() != 1:
            raise MemoryError("VTK could not write a grid into memory")
        return file.read()


def read_drawing(path: Path | str) -> Drawing:
    """Read from a file of ``write_vtu`` what a drawing of the specimen needs.

    Raises:
        InputError: if the file cannot be read or is no such file.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(f"specimen = {str(path)!r}, cannot be read; give the folder of a run")
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    cells = {
        grid.GetCellData().GetArrayName(number): vtk_to_numpy(grid.GetCellData().GetArray(number))
        for number in range(grid.GetCellData().GetNumberOfArrays())
    }
    if not {"kind", "grain", "contact", "grain_a", "grain_b", "point_damage"} <= cells.keys():
        raise InputError(f"specimen = {str(path)!r}, has no grains of flexpm; give that of a run")
    places = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    grains, contacts = cells["kind"] == GRAIN, cells["kind"] == CONTACT
    count = 3 * np.count_nonzero(grains)
    damage = cells["point_damage"][contacts].reshape(np.count_nonzero(contacts), -1)
    return Drawing(
        positions=places,
        triangles=corners[:count].reshape(-1, 3),
        triangle_grain=cells["grain"][grains],
        triangle_mineral=cells["mineral"][grains],
        contact=cells["contact"][contacts],
        contact_grains=np.column_stack([cells["grain_a"], cells["grain_b"]])[contacts],
        contact_ends=places[corners[count:]].reshape(-1, 2, 2),
        bonded=damage < 1.0,
    )


def point_arrays(snapshot: Snapshot) -> dict[str, Named]:
    """Arrays over points: the N nodes, then the two ends of each contact.

    An end of a contact moves with the node that is nearest to it.
    """
    nearest = _nearest_nodes(snapshot)
    displacement = snapshot.positions - snapshot.reference
    return {
        name: (_three(np.concatenate([values, values[nearest]])), _VECTOR)
        for name, values in (
            ("displacement", displacement),
            ("velocity", snapshot.velocities),
        )
    }


def cell_arrays(snapshot: Snapshot) -> dict[str, Named]:
    """Arrays over cells: the M triangles, then the C contacts; nan or -1 where undefined."""
    return _joined(_grain_arrays(snapshot), _contact_arrays(snapshot))


def principal_stresses(stress: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Larger and smaller principal stress of the plane [Pa] from xx, yy, xy, shape (M, 3)."""
    xx, yy, xy = np.asarray(stress, dtype=float).T
    middle, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    return middle + radius, middle - radius


def _grain_arrays(snapshot: Snapshot) -> dict[str, Named]:
    stress = snapshot.triangle_stress
    tensor = np.zeros((len(stress), 6))
    tensor[:, [0, 1, 3]] = stress
    if snapshot.triangle_stress_zz is not None:
        tensor[:, 2] = snapshot.triangle_stress_zz
    largest, smallest = principal_stresses(stress)
    grain, particle = snapshot.triangle_grain, snapshot.triangle_particle
    return {
        "kind": (np.full(len(stress), GRAIN), ()),
        "grain": (grain, ()),
        "particle": (grain if particle is None else particle, ()),
        "mineral": (_minerals(snapshot)[grain], ()),
        "fragment": (snapshot.fragments.labels[grain], ()),
        "stress": (tensor, _TENSOR),
        "principal_stress_1": (largest, ()),
        "principal_stress_2": (smallest, ()),
    }


def _minerals(snapshot: Snapshot) -> IntArray:
    """Mineral of each grain; 0 if all grains are alike."""
    if snapshot.grain_mineral is not None:
        return snapshot.grain_mineral
    return np.zeros(int(np.max(snapshot.triangle_grain, initial=-1)) + 1, dtype=int)


def _contact_arrays(snapshot: Snapshot) -> dict[str, Named]:
    opening, slip = snapshot.point_opening, snapshot.point_slip
    damage, traction = snapshot.point_damage, snapshot.point_traction
    step, mode = snapshot.crack_step, snapshot.crack_mode
    count, points = opening.shape
    shares = np.array(POINT_SHARES[points])
    names = tuple(f"point {number}" for number in range(points))
    last = np.take_along_axis(mode, np.argmax(step, axis=1)[:, None], axis=1)[:, 0]
    normal, shear = traction[..., 0], traction[..., 1]
    arrays: dict[str, FloatArray | IntArray] = {
        "kind": np.full(count, CONTACT),
        "contact": snapshot.contact,
        "grain_a": snapshot.contact_grains[:, 0],
        "grain_b": snapshot.contact_grains[:, 1],
        "damage": damage @ shares,
        "opening": _largest(opening),
        "slip": _largest(slip),
        "normal_traction": normal @ shares,
        "shear_traction": shear @ shares,
        "cracked_points": np.count_nonzero(step >= 0, axis=1),
        "crack_mode": np.where(np.any(step >= 0, axis=1), last, 0),
    }
    by_point: dict[str, FloatArray | IntArray] = {
        "point_damage": damage,
        "point_opening": opening,
        "point_slip": slip,
        "point_normal_traction": normal,
        "point_shear_traction": shear,
        "point_crack_mode": mode,
        "point_crack_step": step,
    }
    found: dict[str, Named] = {name: (values, ()) for name, values in arrays.items()}
    return found | {name: (values, names) for name, values in by_point.items()}


def _joined(first: dict[str, Named], second: dict[str, Named]) -> dict[str, Named]:
    """Stack the arrays of two blocks of cells; a block without an array gets nan, or -1."""
    lengths = [len(next(iter(block.values()))[0]) for block in (first, second)]
    joined = {}
    for name in [*first, *(name for name in second if name not in first)]:
        given = first.get(name) or second[name]
        values, components = given
        blank = -1 if np.issubdtype(values.dtype, np.integer) else np.nan
        parts = [
            block[name][0] if name in block else np.full((length, *values.shape[1:]), blank)
            for block, length in zip((first, second), lengths, strict=True)
        ]
        joined[name] = (np.concatenate(parts), components)
    return joined


def _set_geometry(grid: vtkUnstructuredGrid, snapshot: Snapshot) -> None:
    triangles = np.asarray(snapshot.triangles, dtype=np.int64)
    ends = snapshot.contact_ends
    nodes = len(snapshot.positions)
    lines = nodes + np.arange(2 * len(ends), dtype=np.int64).reshape(-1, 2)
    places = vtkPoints()
    places.SetDataTypeToDouble()
    corners = np.concatenate([snapshot.positions, ends.reshape(-1, 2)])
    places.SetData(numpy_to_vtk(_three(corners), deep=True))
    sizes = np.repeat([3, 2], [len(triangles), len(lines)])
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_to_vtkIdTypeArray(np.concatenate([triangles.ravel(), lines.ravel()]), deep=True),
    )
    types = np.repeat(np.array([VTK_TRIANGLE, VTK_LINE], np.uint8), [len(triangles), len(lines)])
    grid.SetPoints(places)
    grid.SetCells(numpy_to_vtk(types, deep=True), cells)


def _nearest_nodes(snapshot: Snapshot) -> IntArray:
    """Node nearest to each end of each contact; the first for an end that is nowhere."""
    ends = snapshot.contact_ends.reshape(-1, 2)
    found = np.zeros(len(ends), dtype=int)
    # numbers of a run that has diverged may be not finite, or too large to be squared
    known = np.flatnonzero(_is_somewhere(snapshot.positions))
    placed = _is_somewhere(ends)
    if len(known) and placed.any():
        found[placed] = known[cKDTree(snapshot.positions[known]).query(ends[placed])[1]]
    return found


def _is_somewhere(places: FloatArray) -> NDArray[np.bool_]:
    there: NDArray[np.bool_] = np.all(np.abs(places) < _FARTHEST, axis=1)
    return there


def _largest(values: FloatArray) -> FloatArray:
    """Value of largest magnitude in each row, with its sign."""
    return np.take_along_axis(values, np.argmax(np.abs(values), axis=1)[:, None], axis=1)[:, 0]


def _three(plane: FloatArray) -> FloatArray:
    return np.column_stack([np.asarray(plane, dtype=float), np.zeros(len(plane))])


def _add(data: vtkDataSetAttributes, name: str, array: Named) -> None:
    values, components = array
    if np.issubdtype(values.dtype, np.integer):
        values = values.astype(np.int32)
    made = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    made.SetName(name)
    for number, component in enumerate(components):
        made.SetComponentName(number, component)
    data.AddArray(made)
