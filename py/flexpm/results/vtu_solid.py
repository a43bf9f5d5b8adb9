# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView files of solids: grains as tetrahedra, contacts as polygons, in one .vtu. SI units."""

from __future__ import annotations

from collections.abc import Sequence
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
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from ..arrays import FloatArray, IntArray
from ..files import whole_file
from .vtu import CONTACT, GRAIN, written


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
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
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
    arrays = {
        "kind": np.repeat(np.array([GRAIN, CONTACT], dtype=np.int32), count),
        "grain": np.concatenate((shape.grains, shape.pairs[:, 0])).astype(np.int32),
        "neighbour": np.concatenate((np.full(len(shape.tetrahedra), -1), shape.pairs[:, 1])).astype(
            np.int32
        ),
    }
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        grid.GetCellData().AddArray(array)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToLZ4()
    content = written(writer)
    with whole_file(path) as temporary:
        temporary.write_bytes(content)
