# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints that have been cut into the cells of a 3D specimen, and measures of them (D107)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..._flexpm import Polyhedra
from ...arrays import FloatArray, IntArray
from ...files import Table
from ...joints.planes import JointPlane, PlanesCut, names_of
from . import holes
from .spec import SolidSpec

#: Plane of a joint as the kernel takes it: normal, offset, corners.
KernelPlane = tuple[tuple[float, float, float], float, FloatArray]
#: Below this share of the mean diameter a distance is round-off [-].
_STRAIGHT = 1e-9
#: Below this share of an area an area is round-off [-].
_NOTHING = 1e-9


def kernel_holes(spec: SolidSpec) -> list[list[KernelPlane]]:
    """Return the holes of a specimen as the kernel takes them: their facets."""
    return [kernel_planes(holes.facets_of(one, spec.corners)) for one in spec.holes or ()]


def kernel_planes(planes: Sequence[JointPlane]) -> list[KernelPlane]:
    """Return planes as the kernel takes them."""
    return [
        (one.normal, one.offset, np.array(one.corners, dtype=float).reshape(-1, 3))
        for one in planes
    ]


def contact_joints(cells: Polyhedra, planes: Sequence[JointPlane]) -> IntArray | None:
    """Index of the joint of each contact among ``names_of(planes)``, -1: none; None: no joints."""
    if not planes:
        return None
    names = names_of(planes)
    numbers = np.array([*(names.index(one.name) for one in planes), -1], dtype=np.int32)
    found: IntArray = numbers[cells.joints]
    return found


def outcomes(
    cells: Polyhedra, planes: Sequence[JointPlane], volume: float, grain: float
) -> dict[str, PlanesCut]:
    """Outcome of the cuts of each joint, by its name: areas [m2] as seen along the normals.

    Args:
        cells: The cells.
        planes: Planes of the joints, in the order in which they were cut.
        volume: Volume of the specimen [m3].
        grain: Mean diameter of the grains [m].
    """
    least = _NOTHING * volume ** (2.0 / 3.0)
    found: dict[str, PlanesCut] = {}
    if not planes:
        return found
    made, off = areas(cells, planes), deviations(cells, planes, grain)
    bent = _distances(cells, planes, grain) > 0.0
    around = np.linalg.norm(_area_vectors(cells)[bent], axis=1)
    detours = np.bincount(cells.joints[bent], around, len(planes))
    for name in names_of(planes):
        numbers = [number for number, one in enumerate(planes) if one.name == name]
        rows = cells.joint_cuts[numbers]
        within, _, taken, bridged, beyond, *_ = map(float, rows.sum(axis=0))
        radii = [
            radius
            for number in numbers
            if (radius := planes[number].radius) is not None and cells.joint_cuts[number, 0] > 0.0
        ]
        found[name] = PlanesCut(
            planes=len(rows),
            outside=int(np.count_nonzero(rows[:, 0] == 0.0)),
            idle=int(np.count_nonzero((rows[:, 0] > 0.0) & (made[numbers] <= least))),
            within=within,
            cut=float(made[numbers].sum()),
            taken=taken,
            bridged=bridged,
            beyond=beyond,
            detour=float(detours[numbers].sum()),
            deviation=off[name],
            crowding=within / volume * grain,
            smallest_disc=2.0 * min(radii) / grain if radii else None,
        )
    return found


def hole_outcomes(cells: Polyhedra, spec: SolidSpec, grain: float) -> list[holes.HoleCut]:
    """Outcome of the cut of each hole.

    Args:
        cells: The cells.
        spec: Inputs of the specimen.
        grain: Mean diameter of the grains [m].
    """
    found = []
    for number, hole in enumerate(spec.holes or ()):
        facets = holes.facets_of(hole, spec.corners)
        faces = np.flatnonzero(cells.faces[:, 2] == cells.first_hole + number)
        area, off = 0.0, 0.0
        normals = np.array([one.normal for one in facets])
        offsets = np.array([one.offset for one in facets])
        for face in faces:
            ends = cells.face_offsets[face : face + 2]
            corners = cells.vertices[cells.face_vertices[ends[0] : ends[1]]]
            arms = corners - corners[0]
            area += 0.5 * float(np.linalg.norm(np.cross(arms[1:-1], arms[2:]).sum(axis=0)))
            # distance from the polyhedron's surface, of corners inside and near it
            off = max(off, float(np.abs((corners @ normals.T - offsets).max(axis=1)).max()))
        off = off if off > _STRAIGHT * grain else 0.0
        volume = float(cells.hole_cuts[number, 0])
        found.append(holes.HoleCut(len(facets), volume, area, off))
    return found


def deviations(cells: Polyhedra, planes: Sequence[JointPlane], grain: float) -> dict[str, float]:
    """Largest distance of the contacts of each joint from their planes [m], by name.

    Args:
        cells: The cells.
        planes: Planes of the joints.
        grain: Mean diameter of the grains [m].
    """
    off = np.zeros(len(planes))
    distances, on = _distances(cells, planes, grain), cells.joints >= 0
    np.maximum.at(off, cells.joints[on], distances[on])
    return {
        name: float(max(off[k] for k, one in enumerate(planes) if one.name == name))
        for name in names_of(planes)
    }


def areas(cells: Polyhedra, planes: Sequence[JointPlane]) -> FloatArray:
    """Area of the contacts on each plane, as seen along its normal [m2]."""
    vectors, plane = _area_vectors(cells), cells.joints
    on = plane >= 0
    normals = np.array([one.normal for one in planes])
    seen = np.einsum("ij,ij->i", vectors[on], normals[plane[on]])
    # a face around a grain may be seen from its other side: the sides of a joint face each other
    signed = _senses(cells, planes)[on] * seen
    return np.asarray(np.bincount(plane[on], signed, len(planes)), dtype=float)


def traces(cells: Polyhedra, planes: Sequence[JointPlane]) -> dict[str, IntArray]:
    """Return the edges (n, 2) at which the contacts of each joint meet the surface, by name."""
    edges, faces = _edges(cells)
    outer = edges[faces >= cells.contacts]
    found = {}
    for name in names_of(planes):
        numbers = [number for number, one in enumerate(planes) if one.name == name]
        of_joint = np.append(np.isin(cells.joints, numbers), False)
        own = edges[of_joint[np.minimum(faces, cells.contacts)]]
        found[name] = own[np.isin(_keys(own), _keys(outer))]
    return found


def _edges(cells: Polyhedra) -> tuple[IntArray, IntArray]:
    """Edges of all faces, the smaller vertex first, (n, 2), and their faces (n,)."""
    ends = cells.face_offsets
    after = np.arange(len(cells.face_vertices)) + 1
    after[ends[1:] - 1] = ends[:-1]
    pairs = np.column_stack((cells.face_vertices, cells.face_vertices[after]))
    return np.sort(pairs, axis=1), np.repeat(np.arange(len(ends) - 1), np.diff(ends))


def _keys(edges: IntArray) -> IntArray:
    """One number for each edge."""
    keys: IntArray = edges[:, 0].astype(np.int64) << 32 | edges[:, 1]
    return keys


def _area_vectors(cells: Polyhedra) -> FloatArray:
    """Area of each contact times its normal [m2]."""
    ends = cells.face_offsets[: cells.contacts + 1]
    face = np.repeat(np.arange(cells.contacts), np.diff(ends))
    corners = cells.face_vertices[: ends[-1]]
    after = np.arange(len(corners)) + 1
    last = ends[1:] - 1
    after[last] = ends[:-1]
    first = cells.vertices[cells.face_vertices[ends[:-1]]][face]
    here, there = cells.vertices[corners] - first, cells.vertices[corners[after]] - first
    doubled = np.cross(here, there)
    found = [0.5 * np.bincount(face, one, cells.contacts) for one in doubled.T]
    return np.column_stack(found)


def _distances(cells: Polyhedra, planes: Sequence[JointPlane], grain: float) -> FloatArray:
    """Largest distance of the corners of each contact from its plane [m]; 0 for other contacts."""
    ends = cells.face_offsets[: cells.contacts + 1]
    face = np.repeat(np.arange(cells.contacts), np.diff(ends))
    face_on = np.flatnonzero(cells.joints[face] >= 0)
    face = face[face_on]
    normals = np.array([one.normal for one in planes])[cells.joints[face]]
    offsets = np.array([one.offset for one in planes])[cells.joints[face]]
    places = cells.vertices[cells.face_vertices[face_on]]
    off = np.abs(np.einsum("ij,ij->i", places, normals) - offsets)
    off[off <= _STRAIGHT * grain] = 0.0
    found = np.zeros(cells.contacts)
    np.maximum.at(found, face, off)
    return found


def of_sets(
    cells: Polyhedra, planes: Sequence[JointPlane], sets: Mapping[str, Table], volume: float
) -> dict[str, Table]:
    """Measures of the sets of fracture networks; see ``SolidSpecimen.network_intensities``.

    Args:
        cells: The cells.
        planes: Planes of all joints.
        sets: Table of each set, by the name of its joint.
        volume: Volume of the specimen [m3].
    """
    found: dict[str, Table] = {}
    if not sets:
        return found
    from ...joints.poles import statistics

    made, within = areas(cells, planes), cells.joint_cuts[:, 0]
    normals = np.array([one.normal for one in planes])
    for name, table in sets.items():
        inside = np.array([one.name == name for one in planes]) & (within > 0.0)
        p10 = np.sum(np.abs(normals[inside]) * within[inside, None], axis=0) / volume
        found[name] = {
            "target": table.get("intensity"),
            "generated": float(np.sum(within[inside])) / volume,
            "cut": float(np.sum(made[inside])) / volume,
            **dict(zip(("p10_x", "p10_y", "p10_z"), p10.tolist(), strict=True)),
            "planes": int(np.count_nonzero(inside)),
        }
        if inside.any():
            found[name] |= vars(statistics(normals[inside]))
    return found


def _senses(cells: Polyhedra, planes: Sequence[JointPlane]) -> FloatArray:
    """1 for contacts whose first cell is on the lower side of their plane, else -1."""
    pairs = cells.faces[: cells.contacts, :2]
    joints = cells.joints
    normals = np.vstack(([one.normal for one in planes], np.zeros(3)))[joints]
    way = cells.centres[pairs[:, 1]] - cells.centres[pairs[:, 0]]
    return np.where(np.einsum("ij,ij->i", way, normals) < 0.0, -1.0, 1.0)
