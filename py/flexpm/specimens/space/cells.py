# SPDX-License-Identifier: GPL-3.0-or-later
"""Packed and given spheres, their cells, and figures of them. SI units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..._flexpm import (
    FanMeshes,
    Polyhedra,
    Solid,
    disc_radii,
    face_point_counts,
    polyhedra,
    sphere_count,
)
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...files import Table, read_text
from ...joints.planes import JointPlane
from ...progress import Progress
from ...require import quoted
from .. import packing
from ..files.rules import refuse
from ..kernel_input import call, checksum
from .cuts import kernel_holes, kernel_planes
from .frame import SolidFrame
from .spec import SolidSpec

_FEWEST_SPHERES = 8
#: A packing scales lengths and takes the scale back [-].
_ROUND_OFF = 1e-9
#: Shares of the edges that are shorter than the lengths given [-].
_SHARES = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)


def require_made_from(spec: SolidSpec, spheres: FloatArray, removed: int) -> None:
    """Check that the spheres of a file agree with its spec: their number and sizes.

    Raises:
        InputError: if they cannot.
    """
    if spec.spheres is not None:
        if checksum(spheres) != spec.spheres:
            raise refuse(f"spheres do not fit the checksum {quoted(spec.spheres)}")
        return
    assert spec.diameters is not None and spec.porosity is not None
    count = call(sphere_count, spec.volume, *spec.diameters, spec.porosity)
    if len(spheres) + removed != count:
        raise refuse(f"spheres = {len(spheres)} and {removed} removed, must be {count} in all")
    low, high = spec.diameters
    found = 2.0 * spheres[:, 3]
    if found.min() < (1.0 - _ROUND_OFF) * low or found.max() > (1.0 + _ROUND_OFF) * high:
        raise refuse(
            f"diameters = {found.min():g} to {found.max():g} m, must be {low:g} to {high:g} m"
        )


def packed_spheres(where: str, spec: SolidSpec, progress: Progress | None) -> FloatArray:
    """Rows x, y, z, radius [m] of spheres packed into the outline of a specimen."""
    assert spec.diameters is not None and spec.porosity is not None and spec.seed is not None
    spec.require_memory()
    smallest, largest = spec.diameters
    count = call(sphere_count, spec.volume, smallest, largest, spec.porosity)
    if count < _FEWEST_SPHERES:
        raise InputError(
            f"{where}: spheres = {count}, must be >= {_FEWEST_SPHERES} to fill the specimen; "
            "choose smaller diameters"
        )
    mean = 0.5 * (smallest + largest)
    radii = call(disc_radii, count, smallest, largest, spec.seed)
    frame = SolidFrame.of(spec, mean)
    centres, radii = call(packing.pack, frame, radii, mean, spec.seed, progress)
    return np.column_stack((centres, radii))


def cells_of(
    spheres: FloatArray,
    spec: SolidSpec,
    *,
    drop_hidden: bool,
    planes: Sequence[JointPlane] = (),
) -> tuple[FloatArray, Polyhedra]:
    """Spheres and their cells; hidden spheres, which have no cell, are dropped or refused."""
    joints, holes = kernel_planes(planes), kernel_holes(spec)
    while True:
        short = spec.short_edge * _mean_diameter(spheres)
        outline = outline_of(spheres, spec)
        cells = call(polyhedra, spheres, outline, short, drop_hidden, [], joints, holes)
        if len(cells.hidden_spheres) == 0:
            break
        spheres = np.ascontiguousarray(np.delete(spheres, cells.hidden_spheres, axis=0))
    spheres.setflags(write=False)
    return spheres, cells


def outline_of(spheres: FloatArray, spec: SolidSpec) -> Solid:
    """Return the outline of the cells; the facets of a cylinder depend on the grain size."""
    mean = _mean_diameter(spheres)
    grain = 0.5 * sum(spec.diameters) if spec.diameters is not None else mean
    # a sphere out of all sense is refused by its number, when the cells are made
    return SolidFrame.of(spec, grain if 0.0 < mean < math.inf else 1.0).solid()


def _mean_diameter(spheres: FloatArray) -> float:
    return 2.0 * float(np.mean(spheres[:, 3])) if len(spheres) else 0.0


def sphere_rows(given: npt.ArrayLike | Path | str) -> FloatArray:
    """Rows x, y, z, radius [m] from an array, or from a text file of such rows.

    Raises:
        InputError: if it is no table of four numbers a row, or the file cannot be read.
    """
    name = "Specimen.from_spheres: spheres"
    values: npt.ArrayLike
    if isinstance(given, Path | str):
        name = f"{name} = {str(given)!r}"
        try:
            text = read_text(Path(given))
        except (OSError, ValueError):
            raise InputError(f"{name}, cannot be read; give a text file of rows") from None
        lines = (line.partition("#")[0].replace(",", " ").split() for line in text.splitlines())
        values = [line for line in lines if line]
    else:
        values = given
    try:
        found = np.array(values, dtype=float, order="C")
    except (TypeError, ValueError):
        raise InputError(
            f"{name}: not numbers, must be rows x, y, z, radius [m]; correct it"
        ) from None
    if found.ndim != 2 or found.shape[1] != 4:
        raise InputError(
            f"{name}: array of shape {found.shape}, must be rows x, y, z, radius [m]; correct it"
        )
    return found


def polygons(cells: Polyhedra, first: int, last: int) -> list[IntArray]:
    """Vertices of each face from number `first` to before `last`."""
    ends = cells.face_offsets
    return [cells.face_vertices[ends[k] : ends[k + 1]] for k in range(first, last)]


def contact_points(cells: Polyhedra) -> tuple[int, int]:
    """Return the number of contact points, and of contacts with equal points.

    Raises:
        InputError: if a contact has no space for its points.
    """
    return call(face_point_counts, cells)


def figures(cells: Polyhedra, meshes: FanMeshes) -> Table:
    """Count and measure grains, contacts, edges and tetrahedra: volumes [m3], lengths [m]."""
    faces = polygons(cells, 0, cells.contacts or len(cells.faces))
    starts = np.concatenate(faces)
    ends = np.concatenate([np.roll(face, -1) for face in faces])
    places = cells.vertices
    lengths = np.sqrt(np.sum((places[ends] - places[starts]) ** 2, axis=1))
    corners = np.diff(cells.face_offsets[: cells.contacts + 1])
    points, equal = contact_points(cells)
    return {
        "grains": cells.cells,
        "contacts": cells.contacts,
        "uncollapsed_contacts": cells.uncollapsed_contacts,
        "boundary_faces": len(cells.faces) - cells.contacts,
        "contact_corners": int(corners.sum()),
        "contact_points": points,
        "contacts_of_equal_points": equal,
        "cell_volume": math.fsum(cells.volumes),
        "smallest_cell_volume": float(cells.volumes.min()),
        "edge_length": {f"{p:.2f}": float(np.quantile(lengths, p)) for p in _SHARES},
        "short_edges_left": cells.short_edges,
        "coordination": 2.0 * cells.contacts / cells.cells,
        "nodes": len(meshes.node_vertices),
        "tetrahedra": len(meshes.elements),
        "smallest_tetrahedron_volume": float(meshes.volumes.min()),
        "moved_centres": len(cells.moved_centres),
    }
