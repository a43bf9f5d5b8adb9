# SPDX-License-Identifier: GPL-3.0-or-later
"""A state of a solid without a test: its cells, moved grain by grain, some points cracked."""

from __future__ import annotations

import numpy as np

from flexpm.results.solids.state import SolidSnapshot


def sample(specimen, *, strain=0.0, scatter=0.0, cracked=0.0):
    """State of a specimen.

    Args:
        specimen: The solid.
        strain: Along z, as of the centres; grains move as bodies [-].
        scatter: Standard deviation of the way of each grain [m].
        cracked: Share of the contacts that have cracked.
    """
    random = np.random.default_rng(1)
    nodes, tetrahedra, owner = specimen.tetrahedra()
    cells, meshes = specimen.cells, specimen.meshes()
    firsts = np.asarray(meshes.node_offsets)
    polygons = specimen.contact_polygons()
    corners = np.concatenate([cells.vertices[one] for one in polygons])
    sizes = np.array([len(one) for one in polygons])
    row = np.repeat(np.arange(len(sizes)), sizes + 1)
    broken = (random.random(len(sizes)) < cracked)[row]
    mode = np.where(broken, random.integers(1, 3, len(row)), 0)
    centres = nodes[firsts[1:] - 1]
    way = scatter * random.standard_normal(centres.shape) + strain * centres * (0.0, 0.0, 1.0)
    grain = np.repeat(np.arange(len(centres)), np.diff(firsts))
    stress = np.zeros((len(tetrahedra), 6))
    stress[:, 2] = nodes[tetrahedra].mean(axis=1)[:, 2] * 1e9
    places = np.concatenate(
        [np.vstack((cells.vertices[one], cells.vertices[one].mean(axis=0))) for one in polygons]
    )
    areas = np.full(len(sizes), 1e-6)
    return SolidSnapshot(
        positions=nodes + way[grain],
        reference=nodes,
        velocities=np.zeros_like(nodes),
        forces=np.zeros_like(nodes),
        node_offsets=firsts,
        centres=centres + way,
        volumes=np.bincount(owner, np.asarray(meshes.volumes)),
        tetrahedra=tetrahedra,
        tetrahedron_grain=owner,
        tetrahedron_stress=stress,
        surface=np.zeros((0, 3), dtype=int),
        surface_grain=np.zeros(0, dtype=int),
        surface_side=np.zeros(0, dtype=int),
        contact_grains=cells.faces[: cells.contacts, :2],
        corner_offsets=np.concatenate(([0], np.cumsum(sizes))),
        corner_reference=corners,
        corners=corners,
        areas=areas,
        point_offsets=np.concatenate(([0], np.cumsum(sizes + 1))),
        point_area=areas[row] / (sizes[row] + 1),
        point_position=places,
        point_opening=np.zeros(len(row)),
        point_slip=np.zeros((len(row), 2)),
        point_damage=(mode > 0).astype(float),
        point_traction=np.zeros((len(row), 3)),
        crack_step=np.where(mode > 0, 10, -1),
        crack_mode=mode,
        crack_position=places,
        crack_energy=np.full(len(row), 1e-6),
    )
