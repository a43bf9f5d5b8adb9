# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView files of a specimen: grains as triangles, contacts as lines, in one .vtu. SI units.

Stress, traction and opening are positive in tension. The arrays are listed in the documentation.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_LINE,
    VTK_TRIANGLE,
    vtkCellArray,
    vtkDataSetAttributes,
    vtkUnstructuredGrid,
)

from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..files import read_bytes
from ..require import quoted
from .arrays.vtu_arrays import (
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
from .arrays.vtu_arrays import UNITS as UNITS
from .arrays.vtu_reader import Arrays, Grid, grid_of
from .snapshot import Snapshot, triangle_areas
from .solids.state import AnySnapshot, SolidSnapshot
from .solids.vtu import state_of_grid, write_solid_state
from .stress.tensors import means_by
from .stress.tensors import principal_stresses as principal_stresses  # scripts know it here

#: Coordinates [m] beyond this are nowhere; nan is, too.
_FARTHEST = 1e100

#: Share of a contact's area that each of its points stands for, by number of points.
_SHARES = {1: (1.0,), 2: (0.5, 0.5), 3: (1 / 6, 4 / 6, 1 / 6)}


def write_vtu(
    path: Path | str,
    snapshot: AnySnapshot,
    about: Mapping[str, object] | None = None,
) -> None:
    """Write `snapshot` as one VTK unstructured grid, completely or not at all.

    Args:
        path: Name of the file, ending in .vtu.
        snapshot: The state, 2D or 3D.
        about: Field data that describe the state, by name; numbers and texts, None is left out.

    Raises:
        InputError: for a value that is not a state, such as the plain arrays of
            ``solver.snapshot()``.

    Example:
        >>> import tempfile
        >>> path = tempfile.mkdtemp() + "/state.vtu"
        >>> flexpm.export.write_vtu(path, flexpm.build(specimen).snapshot())
        >>> len(flexpm.export.read_vtu(path).grain_areas)
        37
    """
    if isinstance(snapshot, SolidSnapshot):
        write_solid_state(path, snapshot, about)
        return
    if not isinstance(snapshot, Snapshot):
        raise InputError(
            f"write_vtu: snapshot = {quoted(snapshot)}, must be a snapshot; call write_vtu(file, "
            "built.snapshot())"
        )
    grid = vtkUnstructuredGrid()
    _set_geometry(grid, snapshot)
    for name, array in point_arrays(snapshot).items():
        add(grid.GetPointData(), name, array)
    for name, array in cell_arrays(snapshot).items():
        add(grid.GetCellData(), name, array)
    for name, value in (about or {}).items():
        describe(grid.GetFieldData(), name, value)
    grid.GetPointData().SetActiveVectors("displacement")
    grid.GetCellData().SetActiveAttribute("stress", vtkDataSetAttributes.TENSORS)
    write_grid(path, grid)


def read_vtu(path: Path | str) -> Snapshot:
    """Read the state that ``write_vtu`` has written, without the positions of cracks.

    A 3D file returns the section through its middle, see ``read_state``.

    Raises:
        InputError: if the file cannot be read or has no state of flexpm.
    """
    return read_state(path).drawn


def read_state(path: Path | str) -> AnySnapshot:
    """Read the complete state that ``write_vtu`` has written; 3D: points of a contact are equal.

    Raises:
        InputError: as for ``read_vtu``.
    """
    name = f"state = {str(path)!r}"
    try:
        content = read_bytes(Path(path))
    except (OSError, ValueError):
        raise InputError(f"{name}, cannot be read; give a .vtu file of a run") from None
    try:
        grid = grid_of(content)
        return state_of_grid(grid) if "neighbour" in grid.cells else _snapshot_of(grid)
    except (ValueError, LookupError, ElementTree.ParseError):
        raise InputError(f"{name}, is damaged or has no grains of flexpm; give a run's") from None


def _snapshot_of(grid: Grid) -> Snapshot:
    """Return the state of a grid.

    Raises:
        ValueError, LookupError: if it has no grains of flexpm.
    """
    cells, points, corners = grid.cells, grid.points, grid.corners
    places = grid.places[:, :2]
    count = int(np.count_nonzero(cells["kind"] == GRAIN))
    nodes = len(places) - 2 * (len(cells["kind"]) - count)
    _require_grid(cells, places, corners, count)
    grains = {name: values[:count] for name, values in cells.items()}
    contacts = {name: values[count:] for name, values in cells.items()}
    by_point = {
        name: values.ravel() for name, values in contacts.items() if name.startswith("point_")
    }
    damage, bonds = by_point["point_damage"], len(cells["kind"]) - count
    each = _points_of(cells)
    traction = by_point["point_normal_traction"], by_point["point_shear_traction"]
    mineral = np.zeros(int(np.max(grains["grain"], initial=-1)) + 1, dtype=int)
    mineral[grains["grain"]] = grains["mineral"]
    return Snapshot(
        positions=places[:nodes],
        reference=(places - points["displacement"][:, :2])[:nodes],
        velocities=points["velocity"][:nodes, :2],
        triangles=corners[: 3 * count].reshape(-1, 3),
        triangle_grain=grains["grain"],
        triangle_stress=grains["stress"][:, [0, 1, 3]],
        triangle_stress_zz=grains["stress"][:, 2],
        triangle_particle=grains["particle"],
        contact=contacts["contact"],
        contact_grains=np.column_stack([contacts["grain_a"], contacts["grain_b"]]),
        contact_ends=places[nodes:].reshape(-1, 2, 2),
        point_contact=np.repeat(np.arange(bonds), each),
        point_share=np.tile(np.array(_SHARES[each]), bonds),
        point_opening=by_point["point_opening"],
        point_slip=by_point["point_slip"],
        point_damage=damage,
        point_traction=np.stack(traction, axis=-1),
        crack_step=by_point["point_crack_step"],
        crack_mode=by_point["point_crack_mode"],
        crack_position=np.full((len(damage), 2), np.nan),
        grain_mineral=mineral if mineral.any() else None,
        contact_joint=contacts.get("joint"),
    )


def _require_grid(cells: Arrays, places: FloatArray, corners: IntArray, count: int) -> None:
    """Reject invalid indices of nodes and grains, in a file that was changed."""
    kinds, contacts = cells["kind"], len(cells["kind"]) - count
    nodes, grains = len(places) - 2 * contacts, int(np.max(cells["grain"], initial=-1)) + 1
    whole = np.array_equal(kinds, np.repeat([GRAIN, CONTACT], [count, contacts]))
    whole = whole and count > 0 and len(corners) == 3 * count + 2 * contacts and nodes > 0
    if not (whole and _are_numbers(corners[: 3 * count], nodes) and np.all(np.isfinite(places))):
        raise ValueError("cells")
    pairs = np.append(cells["grain_a"][count:], cells["grain_b"][count:])
    if not (_are_numbers(cells["grain"][:count], count) and _are_numbers(pairs, grains)):
        raise ValueError("grains")
    if not (_are_numbers(cells["mineral"][:count], count) and np.ptp(places, axis=0).all()):
        raise ValueError("minerals or positions")
    if _points_of(cells) not in _SHARES:
        raise ValueError("points")


def _points_of(cells: Arrays) -> int:
    """Return the number of points of a contact, which is equal for all contacts in 2D."""
    return int(np.prod(cells["point_damage"].shape[1:], dtype=int))


def _are_numbers(values: IntArray, count: int) -> bool:
    return bool(np.all((values >= 0) & (values < count)))


def point_arrays(snapshot: Snapshot) -> dict[str, Named]:
    """Return the arrays over points: the N nodes, then the two ends of each contact.

    An end of a contact moves with the nearest node.
    """
    nearest = _nearest_nodes(snapshot)
    displacement = snapshot.positions - snapshot.reference
    found: dict[str, Named] = {
        name: (_three(np.concatenate([values, values[nearest]])), VECTOR)
        for name, values in (
            ("displacement", displacement),
            ("velocity", snapshot.velocities),
        )
    }
    nodal = _mean_by(snapshot, snapshot.triangles, len(snapshot.positions))
    return found | {"nodal_stress": (np.concatenate([nodal, nodal[nearest]]), TENSOR)}


def cell_arrays(snapshot: Snapshot) -> dict[str, Named]:
    """Arrays over cells: the M triangles, then the C contacts; nan or -1 where undefined."""
    return joined(_grain_arrays(snapshot), _contact_arrays(snapshot))


def _grain_arrays(snapshot: Snapshot) -> dict[str, Named]:
    stress, tensor = snapshot.triangle_stress, _tensors(snapshot)
    largest, smallest = principal_stresses(stress)
    grain, particle = snapshot.triangle_grain, snapshot.triangle_particle
    means = _mean_by(snapshot, grain[:, None], int(np.max(grain, initial=-1)) + 1)
    return {
        "kind": (np.full(len(stress), GRAIN), ()),
        "grain": (grain, ()),
        "particle": (grain if particle is None else particle, ()),
        "mineral": (_minerals(snapshot)[grain], ()),
        "fragment": (snapshot.fragments.labels[grain], ()),
        "stress": (tensor, TENSOR),
        "grain_stress": (means[grain], TENSOR),
        "principal_stress_1": (largest, ()),
        "principal_stress_2": (smallest, ()),
    }


def _tensors(snapshot: Snapshot) -> FloatArray:
    """Stress of each triangle in the order of a tensor's components, (M, 6) [Pa]."""
    tensor = np.zeros((len(snapshot.triangle_stress), 6))
    tensor[:, [0, 1, 3]] = snapshot.triangle_stress
    if snapshot.triangle_stress_zz is not None:
        tensor[:, 2] = snapshot.triangle_stress_zz
    return tensor


def _mean_by(snapshot: Snapshot, owners: IntArray, count: int) -> FloatArray:
    """Return the mean stress of the triangles of each owner, weighted by area, (count, 6) [Pa].

    Args:
        snapshot: The state.
        owners: Indices of the owners of each triangle, (M, K).
        count: Number of owners; an owner without a triangle gets nan.
    """
    return means_by(_tensors(snapshot), triangle_areas(snapshot), owners, count)


def _minerals(snapshot: Snapshot) -> IntArray:
    """Return the mineral of each grain; 0 without minerals."""
    if snapshot.grain_mineral is not None:
        return snapshot.grain_mineral
    return np.zeros(int(np.max(snapshot.triangle_grain, initial=-1)) + 1, dtype=int)


def _contact_arrays(snapshot: Snapshot) -> dict[str, Named]:
    count = len(snapshot.contact)
    points = len(snapshot.point_contact) // count if count else 1  # all have as many in the plane
    opening, slip, damage, step, mode, normal, shear = (
        values.reshape(count, points)
        for values in (
            *(snapshot.point_opening, snapshot.point_slip, snapshot.point_damage),
            *(snapshot.crack_step, snapshot.crack_mode, *snapshot.point_traction.T),
        )
    )
    shares = np.resize(snapshot.point_share, points)
    names = tuple(f"point {number}" for number in range(points))
    last = np.take_along_axis(mode, np.argmax(step, axis=1)[:, None], axis=1)[:, 0]
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
    if snapshot.contact_joint is not None:
        arrays["joint"] = snapshot.contact_joint
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
    """Return the node nearest to each end of each contact; the first node for an end of nan."""
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
