# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of label volumes in each format, written by the library of the format if there is one."""

from __future__ import annotations

import io
import locale
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOLegacy import vtkStructuredPointsWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

#: Words for the data of .tesr files, and the types of their numbers.
TESR_FORMS = {
    **{"binary8": "u1", "binary16": "<i2", "binary16_big": ">i2"},
    **{"binary32": "<i4", "binary32_big": ">i4"},
}


def drawn(counts=(7, 6, 5), labels=9, seed=1):
    """Labels 1 to `labels` of blocks, (z, y, x), of so many voxels along x, y, z."""
    x, y, z = counts
    draw = np.random.default_rng(seed)
    points = draw.random((labels, 3)) * counts
    at = np.stack(np.meshgrid(*map(np.arange, (z, y, x)), indexing="ij"), axis=-1)[..., ::-1]
    nearest = np.linalg.norm(at[..., None, :] + 0.5 - points, axis=-1).argmin(axis=-1)
    return nearest.astype(np.uint8) + 1


def npy(labels):
    """Content of an array file."""
    file = io.BytesIO()
    np.save(file, labels)
    return file.getvalue()


def tiff(labels, description=None, resolution=None, **options):
    """A TIFF file with a page for each layer."""
    pages = [Image.fromarray(layer) for layer in labels]
    if description is not None:
        options["description"] = description
    if resolution is not None:
        options |= {"x_resolution": resolution[0], "y_resolution": resolution[1]}
    file = io.BytesIO()
    pages[0].save(file, format="TIFF", save_all=True, append_images=pages[1:], **options)
    return file.getvalue()


def slices(folder, labels, suffix=".tif", first=0):
    """A folder with a file for each layer, numbered without leading zeros."""
    folder.mkdir()
    for number, layer in enumerate(labels, first):
        Image.fromarray(layer).save(folder / f"scan 2_{number}{suffix}")


def tesr(labels, form="ascii", spacing=(1.0, 1.0, 1.0), origin=None, cell=""):
    """A raster tessellation of Neper in 3D."""
    counts = " ".join(map(str, labels.shape[::-1]))
    head = ["***tesr", " **format", "   2.2", " **general", "   3", f"   {counts}"]
    head.append("   " + " ".join(map(repr, spacing)))
    if origin is not None:
        head += ["  *origin", "   " + " ".join(map(repr, origin))]
    text = "\n".join([*head, cell]).rstrip() + f"\n **data\n   {form}\n"
    if form == "ascii":
        rows = labels.reshape(-1, labels.shape[2])
        data = ("\n".join(" ".join(map(str, row)) for row in rows.tolist()) + "\n").encode()
    else:
        data = labels.astype(TESR_FORMS[form]).tobytes() + b"\n"
    return text.encode() + data + b"***end\n"


def dream3d(
    path,
    labels,
    version=8,
    spacing=(1.0, 1.0, 1.0),
    origin=(0.0, 0.0, 0.0),
    name="FeatureIds",
    phases=None,
    phase_values=None,
    phase_names=(),
):
    """Write a file of DREAM3D; phases by feature from 0 on, or by voxel."""
    import h5py

    z, y, x = labels.shape
    with h5py.File(path, "w") as file:
        file.attrs["FileVersion"] = np.bytes_(f"{version}.0")
        group = file.create_group(f"{'DataStructure' if version == 8 else 'DataContainers'}/Image")
        values = {
            "DIMENSIONS": np.array([x, y, z], dtype="u8" if version == 8 else "i8"),
            "SPACING": np.array(spacing, dtype="f4"),
            "ORIGIN": np.array(origin, dtype="f4"),
        }
        if version == 8:
            group.attrs["ObjectType"] = np.bytes_("ImageGeom")
            for key, value in values.items():
                group.attrs[f"_{key}"] = value
        else:
            holder = group.create_group("_SIMPL_GEOMETRY") if version == 7 else group
            for key, value in values.items():
                holder[key] = value
        cells = group.create_group("CellData")
        cells[name] = labels[..., None]
        if phase_values is not None:
            cells["Phases"] = phase_values[..., None]
        if phases is not None:
            group["CellFeatureData/Phases"] = np.array(phases, dtype="i4")[:, None]
        if phase_names:
            text = h5py.string_dtype()
            group["CellEnsembleData/PhaseName"] = np.array(phase_names, dtype=text)


def image(labels, spacing=(1.0, 1.0, 1.0), origin=(0.0, 0.0, 0.0), of_points=False, name="ids"):
    """An image of VTK with labels of its cells or points."""
    made = vtkImageData()
    made.SetDimensions(*(count + (not of_points) for count in labels.shape[::-1]))
    made.SetSpacing(*spacing)
    corner = [o + 0.5 * d * of_points for o, d in zip(origin, spacing, strict=True)]
    made.SetOrigin(*corner)
    array = numpy_to_vtk(np.ascontiguousarray(labels).ravel(), deep=True)
    array.SetName(name)
    (made.GetPointData() if of_points else made.GetCellData()).SetScalars(array)
    return made


def vti(labels, mode="appended", compressor="ZLib", **options):
    """An image of VTK in XML; modes are ascii, binary, appended and raw."""
    writer = vtkXMLImageDataWriter()
    writer.SetInputData(labels if isinstance(labels, vtkImageData) else image(labels, **options))
    {
        "ascii": writer.SetDataModeToAscii,
        "binary": writer.SetDataModeToBinary,
    }.get(mode, writer.SetDataModeToAppended)()
    writer.SetEncodeAppendedData(mode != "raw")
    getattr(writer, f"SetCompressorTypeTo{compressor}")()
    writer.SetBlockSize(64)
    return _written(writer, "vti")


def vtk(labels, as_text=False, **options):
    """A legacy file of VTK."""
    writer = vtkStructuredPointsWriter()
    writer.SetInputData(labels if isinstance(labels, vtkImageData) else image(labels, **options))
    (writer.SetFileTypeToASCII if as_text else writer.SetFileTypeToBinary)()
    return _written(writer, "vtk")


def _written(writer: Any, suffix: str) -> bytes:
    """Return the file of a writer of VTK, which changes the locale of the process."""
    before = locale.setlocale(locale.LC_ALL)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"a.{suffix}")
        writer.SetFileName(str(path))
        assert writer.Write() == 1
        locale.setlocale(locale.LC_ALL, before)
        return path.read_bytes()


def _h5(**options: Any) -> Callable[..., None]:
    return lambda path, labels: dream3d(path, labels.astype(np.int32), **options)


def _content(make: Callable[..., bytes], **options: Any) -> Callable[..., None]:
    return lambda path, labels: path.write_bytes(make(labels, **options)) and None


#: Writer of each format by the name of its file, and options of the reader. Sizes of voxels are 1.
FORMATS: dict[str, tuple[Callable[[Path, Any], None], dict[str, Any]]] = {
    "a.npy": (_content(npy), {}),
    "big.npy": (_content(lambda labels: npy(labels.astype(">i4"))), {}),
    "float.npy": (_content(lambda labels: npy(np.asfortranarray(labels, dtype=float))), {}),
    "a.tif": (_content(tiff), {}),
    "lzw.tiff": (_content(tiff, compression="tiff_lzw"), {}),
    "big.tif": (_content(lambda labels: tiff(labels.astype(">u2"))), {}),
    "words.tif": (_content(lambda labels: tiff(labels.astype(np.int32))), {}),
    "slices": (slices, {}),
    "pictures": (lambda path, labels: slices(path, labels, ".png", 8), {}),
    "a.raw": (
        lambda path, labels: path.write_bytes(labels.astype(">u2").tobytes()) and None,
        {"dtype": ">u2"},
    ),
    "a.tesr": (_content(tesr), {}),
    **{f"{form}.tesr": (_content(tesr, form=form), {}) for form in TESR_FORMS},
    **{f"{one}.dream3d": (_h5(version=one), {}) for one in (6, 7, 8)},
    "old.dream3d": (_h5(version=7, name="GrainIds"), {}),
    "a.vti": (_content(vti), {}),
    "ascii.vti": (_content(vti, mode="ascii"), {}),
    "binary.vti": (_content(vti, mode="binary"), {}),
    "lz4.vti": (_content(vti, mode="binary", compressor="LZ4"), {}),
    "lzma.vti": (_content(vti, mode="raw", compressor="LZMA"), {}),
    "raw.vti": (_content(vti, mode="raw", compressor="None"), {}),
    "plain.vti": (_content(vti, mode="binary", compressor="None"), {}),
    "points.vti": (_content(vti, of_points=True), {}),
    "a.vtk": (_content(vtk), {}),
    "ascii.vtk": (_content(vtk, as_text=True), {}),
    "words.vtk": (_content(lambda labels: vtk(labels.astype(np.int16))), {}),
    "points.vtk": (
        _content(lambda labels: vtk(labels.astype(np.int32), as_text=True, of_points=True)),
        {},
    ),
}


def write(folder, name, labels):
    """Write labels into the file `name` of a folder; returns its path and options of `read`."""
    make, options = FORMATS[name]
    make(folder / name, labels)
    if name.endswith(".raw"):
        options = {**options, "counts": labels.shape[::-1]}
    return folder / name, options
