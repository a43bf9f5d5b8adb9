# SPDX-License-Identifier: GPL-3.0-or-later
"""Rotatable 3D view of an HTML report: faces, their cracks, and the stresses of the grains.

The faces belong to the undeformed grains. Their arrays are deflated whole numbers; the script of
the page has the same order. Cracks are read from cracks.csv, stresses from final.vtu.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...arrays import FloatArray, IntArray
from ...results.cracks import AnyCrack
from ...results.solids.state import SolidSnapshot
from ..joint_colours import JOINTS, joint_colour
from ..style import colour_limits
from .page import View, deflated

#: Steps of a coordinate along the longest side: 0.01 mm for a core of 100 mm.
_STEPS = 10_000
#: Crack position of a face that has not cracked, and colour of a face on no joint.
_NEVER = _NO_JOINT = 255
#: Number of grains above which only cracked faces, joints and the surface are written.
LARGEST_WHOLE = 20_000


class _Faces(NamedTuple):
    """Polygons between grains, and triangles on the outside."""

    vertices: FloatArray  #: (n, 3) [m]
    sizes: IntArray  #: corners of each face
    corners: IntArray  #: vertices, face after face
    grains: IntArray  #: first and second grain, -1 outside (F, 2)


def solid_view(
    name: str,
    specimen: SolidSnapshot,
    final: SolidSnapshot | None,
    cracks: Sequence[AnyCrack],
    at: IntArray,
    letters: Sequence[str],
) -> View:
    """Make the 3D view of a test.

    Args:
        name: Name of the map with the slider.
        specimen: The specimen before the test.
        final: The specimen after the test, for stresses; None: unknown.
        cracks: Cracks of the test.
        at: Slider position of each crack, from which on it is shown.
        letters: Colours of the fragments at each position, one letter per grain.
    """
    faces = _faces(specimen)
    contacts = len(specimen.contact_grains)
    time, mode = _crack_times(specimen, cracks, at)
    joint = _joint_colours(specimen)
    note = ""
    kept = np.ones(len(faces.sizes), dtype=bool)
    if len(specimen.volumes) > LARGEST_WHOLE:
        kept[:contacts] = (time < _NEVER) | (joint < _NO_JOINT)
        note = "Inner faces without cracks are not shown: a cut shows only cracks and joints."
    stress, limits = (None, ()) if final is None else _stresses(final)
    low, span = faces.vertices.min(axis=0), np.ptp(faces.vertices, axis=0)
    scale = _STEPS / float(span.max())
    owner = np.repeat(np.arange(len(faces.sizes)), faces.sizes)
    corners = faces.corners[kept[owner]]
    used, corners = np.unique(corners, return_inverse=True)
    places = np.rint((faces.vertices[used] - low) * scale).astype(int)
    codes = np.array([[ord(one) for one in row] for row in letters], dtype=np.uint8)
    arrays = (
        *(_varints(np.diff(places[:, axis], prepend=0)) for axis in range(3)),
        _bytes(faces.sizes[kept]),
        _varints(np.diff(corners, prepend=0)),
        _varints(np.diff(faces.grains[kept, 0], prepend=0)),
        _varints(faces.grains[kept, 1] - faces.grains[kept, 0]),
        _bytes(np.concatenate([time, np.full(len(faces.sizes) - contacts, _NEVER)])[kept]),
        _bytes(np.concatenate([mode, np.zeros(len(faces.sizes) - contacts, dtype=int)])[kept]),
        _bytes(np.concatenate([joint, np.full(len(faces.sizes) - contacts, _NO_JOINT)])[kept]),
        _bytes(np.zeros(len(specimen.volumes), dtype=int) if stress is None else stress),
        np.concatenate([codes[:1], codes[1:] ^ codes[:-1]]).tobytes(),
    )
    return View(
        name=f"{name}-solid",
        map=name,
        counts={
            "vertices": len(used),
            "faces": int(kept.sum()),
            "grains": len(specimen.volumes),
            "positions": len(letters),
            "steps": _STEPS,
        },
        size=[float(f"{1e3 * side:.6g}") for side in span],
        stress=[float(f"{1e-6 * one:.4g}") for one in limits],
        joints=[
            (name, joint_colour(number))
            for number, name in enumerate(specimen.joint_names)
            if specimen.contact_joint is not None and np.any(specimen.contact_joint == number)
        ],
        colours=JOINTS,
        data=deflated(b"".join(arrays)),
        note=note,
    )


def _faces(solid: SolidSnapshot) -> _Faces:
    """Return the contacts, in their order, then the triangles on the surface."""
    places, corner, node = solid.merged()
    outer = node[solid.tetrahedra[:, 1:]]
    flat = np.sort(outer, axis=1)
    _, which, count = np.unique(flat, axis=0, return_inverse=True, return_counts=True)
    alone = count[which.ravel()] == 1
    sizes = np.diff(solid.corner_offsets)
    owners = solid.tetrahedron_grain[alone]
    return _Faces(
        vertices=places,
        sizes=np.concatenate([sizes, np.full(int(alone.sum()), 3)]),
        corners=np.concatenate([corner, outer[alone].ravel()]),
        grains=np.concatenate(
            [solid.contact_grains, np.column_stack([owners, np.full(len(owners), -1)])]
        ),
    )


def _joint_colours(solid: SolidSnapshot) -> IntArray:
    """Index of the colour of the joint of each contact."""
    if solid.contact_joint is None:
        return np.full(len(solid.contact_grains), _NO_JOINT)
    return np.where(solid.contact_joint < 0, _NO_JOINT, solid.contact_joint % len(JOINTS))


def _crack_times(
    solid: SolidSnapshot, cracks: Sequence[AnyCrack], at: IntArray
) -> tuple[IntArray, IntArray]:
    """Return the position at which half of each contact has cracked, and its dominant mode."""
    contacts = len(solid.contact_grains)
    half = (np.diff(solid.point_offsets) + 1) // 2
    time, mode = np.full(contacts, _NEVER), np.zeros(contacts, dtype=int)
    count = np.zeros(contacts, dtype=int)
    modes = np.zeros((contacts, 3), dtype=int)
    for number in np.argsort(at, kind="stable").tolist():
        crack = cracks[number]
        if not 0 <= crack.contact < contacts:
            continue
        count[crack.contact] += 1
        modes[crack.contact, min(crack.mode, 2)] += 1
        if count[crack.contact] == half[crack.contact]:
            time[crack.contact] = min(int(at[number]), _NEVER - 1)
    cracked = time < _NEVER
    mode[cracked] = np.argmax(modes[cracked], axis=1)
    return time, mode


def _stresses(solid: SolidSnapshot) -> tuple[IntArray, tuple[float, float]]:
    """Mean stress of each grain along the load in 256 steps, and the limits of these [Pa]."""
    along = solid.grain_stress[:, 2]
    low, high = colour_limits(along)
    parts = np.nan_to_num((along - low) / max(high - low, 1e-9))
    return np.rint(255.0 * np.clip(parts, 0.0, 1.0)).astype(int), (low, high)


def _bytes(values: IntArray) -> bytes:
    return np.asarray(values).astype(np.uint8).tobytes()


def _varints(values: IntArray) -> bytes:
    """Whole numbers of either sign in as few bytes as they need, seven bits in each."""
    left = np.where(values < 0, -2 * values - 1, 2 * values).astype(np.int64)
    length = np.ones(len(left), dtype=int)
    for bits in (7, 14, 21, 28):
        length += left >= 1 << bits
    ends = np.cumsum(length)
    found = np.zeros(int(ends[-1]) if len(ends) else 0, dtype=np.uint8)
    for k in range(5):
        there = length > k
        more = length[there] > k + 1
        found[(ends - length)[there] + k] = ((left[there] >> (7 * k)) & 127) | (more * 128)
    return found.tobytes()
