# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of .vtu files with their units and the names of their components. SI units."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkDataArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkFieldData, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from ...arrays import FloatArray, IntArray
from ...files import whole_file
from ...text import printable
from .vtu_reader import silence

GRAIN, CONTACT, PAIR = 0, 1, 2  #: values of the cell array `kind`; pairs only of 3D states

#: Unit of each array that has one.
UNITS = {
    "displacement": "m",
    "velocity": "m/s",
    **dict.fromkeys(("opening", "slip", "point_opening", "point_slip"), "m"),
    **dict.fromkeys(("stress", "grain_stress", "nodal_stress"), "Pa"),
    **dict.fromkeys(("principal_stress_1", "principal_stress_2"), "Pa"),
    **dict.fromkeys(("normal_traction", "shear_traction"), "Pa"),
    **dict.fromkeys(("point_normal_traction", "point_shear_traction"), "Pa"),
    **dict.fromkeys(("pair_force", "pair_normal_force"), "N"),
    **dict.fromkeys(("pair_depth", "pair_clearance"), "m"),
    "pair_friction_energy": "J",
}

TENSOR = ("XX", "YY", "ZZ", "XY", "YZ", "XZ")
VECTOR = ("X", "Y", "Z")

#: An array and the names of its components.
Named = tuple[FloatArray | IntArray, tuple[str, ...]]


def written(writer: vtkXMLUnstructuredGridWriter) -> bytes:
    """Return the output of VTK as text; for a file VTK does not report that a part was rejected."""
    writer.SetWriteToOutputString(True)
    with silence():
        done = writer.Write()
    if done != 1:
        raise MemoryError("VTK could not write a grid into memory")
    content: str = writer.GetOutputString()
    return content.encode()


def write_grid(path: Path | str, grid: vtkUnstructuredGrid) -> None:
    """Write a grid, whole or not at all."""
    content = content_of(grid)
    with whole_file(path) as temporary:
        temporary.write_bytes(content)


def content_of(grid: vtkUnstructuredGrid) -> bytes:
    """Content of the file of a grid."""
    return written(writer_of(grid))


def writer_of(grid: vtkUnstructuredGrid) -> vtkXMLUnstructuredGridWriter:
    """VTK's writer of a grid."""
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    # as text: raw data are no XML, and VTK up to 9.2 reads none with expat 2.6 or its backports
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToLZ4()
    return writer


def joined(first: dict[str, Named], second: dict[str, Named]) -> dict[str, Named]:
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


def describe(data: vtkFieldData, name: str, value: object) -> None:
    """Add one value that holds for the whole file."""
    if value is None:
        return
    if isinstance(value, int | float):
        made = numpy_to_vtk(np.array([value]), deep=True)
    else:
        made = vtkStringArray()
        made.InsertNextValue(printable(value))  # VTK reads no further than a NUL, or too far
    made.SetName(printable(name))
    data.AddArray(made)


def add(data: vtkDataSetAttributes, name: str, array: Named) -> None:
    """Add an array with its unit and the names of its components."""
    data.AddArray(made(name, array))


def made(name: str, array: Named) -> vtkDataArray:
    """VTK's array of a name, with its unit and the names of its components."""
    values, components = array
    if np.issubdtype(values.dtype, np.integer):
        values = values.astype(np.int32)
    found: vtkDataArray = numpy_to_vtk(np.ascontiguousarray(values))
    found.SetName(name)
    found.GetInformation().Set(vtkDataArray.UNITS_LABEL(), UNITS.get(name, "-"))
    for number, component in enumerate(components):
        found.SetComponentName(number, component)
    return found
