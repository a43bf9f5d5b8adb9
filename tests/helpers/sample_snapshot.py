# SPDX-License-Identifier: GPL-3.0-or-later
"""A wall of rectangular grains under a known affine displacement, as the solver would report it."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from flexpm.results.snapshot import Snapshot

WIDTH, HEIGHT = 2e-3, 3e-3
GRADIENT = np.array([[-2e-4, 3e-4], [1e-4, -1e-3]])  #: displacement gradient [-]
STRESS = np.array([-1e6, -24e6, 2e6])  #: xx, yy, xy [Pa]
FIRST = 100  #: number of the first contact


def wall(columns=3, rows=4, points=3):
    """Snapshot of columns x rows grains, each with its centre and four corners as nodes.

    Contact k has number FIRST + k, opening k nm, slip -k nm, damage k over the number of contacts
    and tractions k and -k kPa at its first point; its other points carry nothing. Odd contacts
    have their first point cracked in step 10 k, in tension and in shear by turns.
    """
    corners = np.array([[0, 0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]], dtype=float)
    template = np.vstack([corners, corners.mean(axis=0)])
    fan = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    origins = [(WIDTH * i, HEIGHT * j) for j in range(rows) for i in range(columns)]
    reference = np.concatenate([template + origin for origin in origins])
    grains, ends = [], []
    for j in range(rows):
        for i in range(columns):
            grain, (x, y) = j * columns + i, origins[j * columns + i]
            if i + 1 < columns:
                grains.append((grain, grain + 1))
                ends.append([(x + WIDTH, y), (x + WIDTH, y + HEIGHT)])
            if j + 1 < rows:
                grains.append((grain, grain + columns))
                ends.append([(x + WIDTH, y + HEIGHT), (x, y + HEIGHT)])
    contacts = np.arange(len(grains))
    shares = {1: (1.0,), 2: (0.5, 0.5), 3: (1 / 6, 4 / 6, 1 / 6)}[points]
    bond, number = np.repeat(contacts, points), np.tile(np.arange(points), len(contacts))
    first = np.where(number == 0, bond, 0).astype(float)
    cracked = (bond % 2 == 1) & (number == 0)
    ends = np.reshape(ends, (-1, 2, 2))
    return Snapshot(
        positions=moved(reference),
        reference=reference,
        velocities=np.tile([0.0, -1e-8], (len(reference), 1)),
        triangles=np.concatenate([fan + 5 * grain for grain in range(len(origins))]),
        triangle_grain=np.repeat(np.arange(len(origins)), 4),
        triangle_stress=np.tile(STRESS, (4 * len(origins), 1)),
        contact=FIRST + contacts,
        contact_grains=np.reshape(grains, (-1, 2)).astype(int),
        contact_ends=moved(ends),
        point_contact=bond,
        point_share=np.tile(shares, len(contacts)),
        point_opening=1e-9 * first,
        point_slip=-1e-9 * first,
        point_damage=first / len(grains),
        point_traction=1e3 * np.stack([first, -first], axis=-1),
        crack_step=np.where(cracked, 10 * first.astype(int), -1),
        crack_mode=np.where(cracked, 1 + bond // 2 % 2, 0),
        crack_position=np.repeat(moved(ends).mean(axis=1), points, axis=0),
    )


def moved(places):
    """Deformed positions of `places`."""
    return places + places @ GRADIENT.T


def read_vtu(path):
    """Grid, arrays over points and arrays over cells of a file, by VTK's own reader."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    arrays = []
    for data in (grid.GetPointData(), grid.GetCellData()):
        arrays.append(
            {
                data.GetArrayName(number): vtk_to_numpy(data.GetArray(number))
                for number in range(data.GetNumberOfArrays())
            }
        )
    return grid, *arrays
