# SPDX-License-Identifier: GPL-3.0-or-later
"""Label volumes in all formats: the same labels, sizes and phases; what is refused."""

from __future__ import annotations

import os
import struct
import sys
import tracemalloc

import numpy as np
import pytest
from PIL import Image
from refusals import refusal
from volume_files import (
    FORMATS,
    drawn,
    dream3d,
    image,
    npy,
    slices,
    tesr,
    tiff,
    vti,
    vtk,
    write,
)

from flexpm.specimens.label_volumes import label_volume, volume_file
from flexpm.specimens.label_volumes.label_volume import LabelVolume
from flexpm.specimens.label_volumes.reading import read
from flexpm.specimens.labels import picture

LABELS = drawn()
SIZES, CORNER = (0.5, 0.25, 2.0), (1.0, -2.0, 0.5)


def require_h5py(name):
    if name.endswith(".dream3d"):
        pytest.importorskip("h5py")


@pytest.mark.parametrize("name", FORMATS)
def test_all_formats_of_a_volume_are_the_same_labels(tmp_path, name):
    require_h5py(name)
    path, options = write(tmp_path, name, LABELS)
    found = read(path, voxel=(1e-3, 2e-3, 3e-3), **options)
    assert np.array_equal(found.ids, np.unique(LABELS))
    assert np.array_equal(found.ids[found.labels], LABELS)
    assert found.labels.dtype == np.int32 and found.labels.flags.c_contiguous
    assert found.counts == (7, 6, 5)
    assert found.spacing == (1e-3, 2e-3, 3e-3) and found.origin == (0.0, 0.0, 0.0)
    assert found.source == name and found.phases is None and not found.has_voids
    assert np.array_equal(found.voxels, np.bincount(LABELS.ravel())[1:])


@pytest.mark.parametrize("name", FORMATS)
def test_permuted_axes_show_in_the_sizes(tmp_path, name):
    require_h5py(name)
    labels = np.ascontiguousarray(LABELS.transpose(2, 0, 1))
    path, options = write(tmp_path, name, labels)
    found = read(path, voxel=1e-3, **options)
    assert found.counts == (6, 5, 7)
    assert np.array_equal(found.ids[found.labels], labels)


def framed(path, name):
    """Write a volume with sizes and a corner."""
    if name.endswith(".dream3d"):
        dream3d(path / name, LABELS.astype(np.int32), int(name[0]), SIZES, CORNER)
    else:
        given = {"spacing": SIZES, "origin": CORNER}
        made = {
            "a.tesr": lambda: tesr(LABELS, **given),
            "cells.vti": lambda: vti(LABELS, **given),
            "points.vti": lambda: vti(LABELS, of_points=True, **given),
            "cells.vtk": lambda: vtk(LABELS, **given),
            "points.vtk": lambda: vtk(LABELS, of_points=True, **given),
        }
        (path / name).write_bytes(made[name]())
    return path / name


FRAMED = ("a.tesr", "6.dream3d", "7.dream3d", "8.dream3d")
FRAMED = (*FRAMED, "cells.vti", "points.vti", "cells.vtk", "points.vtk")


@pytest.mark.parametrize("name", FRAMED)
def test_sizes_and_corner_are_in_the_unit_that_is_stated(tmp_path, name):
    require_h5py(name)
    path = framed(tmp_path, name)
    for unit, metres in (("m", 1.0), ("mm", 1e-3), ("um", 1e-6)):
        found = read(path, unit=unit)
        assert found.spacing == pytest.approx(np.array(SIZES) * metres, rel=1e-15)
        assert found.origin == pytest.approx(np.array(CORNER) * metres, rel=1e-12)
    # another size stretches the way to the corner, too
    found = read(path, voxel=0.01)
    assert found.spacing == (0.01, 0.01, 0.01)
    assert found.origin == pytest.approx((0.02, -0.08, 0.0025), rel=1e-12)
    words = "spacing = 0.5 x 0.25 x 2 along x, y, z has no unit; give unit, one of m, mm, um, or vo"
    refusal(words, read, path)
    refusal("unit = mm, has no use: voxel is in metres", read, path, unit="mm", voxel=0.1)
    refusal("unit = 'km', must be one of m, mm, um", read, path, unit="km")


@pytest.mark.parametrize(
    ("unit", "metres"), [("micron", 1e-6), ("\\u00B5m", 1e-6), ("mm", 1e-3), ("nm", 1e-9)]
)
def test_sizes_of_imagej_are_read(tmp_path, unit, metres):
    text = f"ImageJ=1.53t\nimages=5\nslices=5\nunit={unit}\nspacing=12.5\nloop=false\n"
    (tmp_path / "a.tif").write_bytes(tiff(LABELS, text, (0.5, 0.25)))
    found = read(tmp_path / "a.tif")
    assert found.spacing == pytest.approx((2.0 * metres, 4.0 * metres, 12.5 * metres), rel=1e-12)
    refusal("unit = mm, has no use: the file states its unit", read, tmp_path / "a.tif", unit="mm")
    for other in (text.replace(unit, "pixel"), text.replace("ImageJ", "Other"), None):
        (tmp_path / "b.tif").write_bytes(tiff(LABELS, other, (0.5, 0.25)))
        refusal("size of a voxel is missing in the file; give voxel", read, tmp_path / "b.tif")


def test_numbers_of_pages_whose_0_is_white_are_those_of_the_file(tmp_path):
    content, tag = tiff(LABELS), struct.pack("<HHI", 262, 3, 1)
    assert content.count(tag + b"\x01") == len(LABELS)
    (tmp_path / "a.tif").write_bytes(content.replace(tag + b"\x01", tag + b"\x00"))
    found = read(tmp_path / "a.tif", voxel=1.0)
    assert np.array_equal(found.ids[found.labels], LABELS)


def test_unsigned_pages_of_32_bits_are_read_as_such(tmp_path):
    """Pillow writes 32 bits with a sign only; the tag of the sign is 339."""
    content, tag = tiff(LABELS.astype(np.int32) - 3), struct.pack("<HHI", 339, 3, 1)
    assert content.count(tag + b"\x02") == len(LABELS)
    (tmp_path / "a.tif").write_bytes(content.replace(tag + b"\x02", tag + b"\x01"))
    found = read(tmp_path / "a.tif", voxel=1.0)
    assert np.array_equal(found.ids[found.labels], (LABELS.astype(int) - 3) % 2**32)


@pytest.mark.parametrize("kind", ["u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8"])
@pytest.mark.parametrize("order", "<>")
def test_numbers_of_all_types_are_the_same_labels(tmp_path, kind, order):
    values = LABELS.astype(order + kind)
    assert np.array_equal(LabelVolume.of(values, (1.0, 1.0, 1.0)).labels, LABELS - 1)
    (tmp_path / "a.npy").write_bytes(npy(values))
    assert np.array_equal(read(tmp_path / "a.npy", voxel=1.0).labels, LABELS - 1)
    values.tofile(tmp_path / "a.raw")
    found = read(tmp_path / "a.raw", voxel=1.0, counts=[7, 6, 5], dtype=order + kind)
    assert np.array_equal(found.labels, LABELS - 1)


def test_ids_may_have_gaps_and_grains_one_voxel():
    draw = np.random.default_rng(3)
    for ids in (
        np.sort(draw.choice(np.arange(1, 65537), 8000, replace=False)),
        np.sort(draw.integers(-(2**62), 2**62, 8000)),
        np.array([-(2**63) + 1, 0, 2**63 - 1]),
    ):
        values = np.concatenate((ids, draw.choice(ids, 8000 - len(ids) % 8000)))[:8000]
        values = draw.permutation(values).reshape(40, 20, 10)
        found = LabelVolume.of(values, (1.0, 1.0, 1.0))
        assert np.array_equal(found.ids, ids)
        assert np.array_equal(found.ids[found.labels], values)
    assert found.voxels.sum() == 8000
    assert LabelVolume.of(values, 0.1).spacing == (0.1, 0.1, 0.1)
    refusal("voxel along z = 0.0 m, must be > 0", LabelVolume.of, values, (1.0, 1.0, 0.0))
    refusal(
        "labels = int64 array of shape (10, 20, 40, 1), must be",
        LabelVolume.of,
        values.T[..., None],
        1.0,
    )
    alone = LabelVolume.of(np.arange(8000).reshape(20, 20, 20)[::-1], (1.0, 1.0, 1.0))
    assert (alone.voxels == 1).all() and alone.labels[0, 0, 0] == 7600


@pytest.mark.parametrize("far", [1, 10**12])  # a table of labels, or a search
def test_the_memory_of_numbering_is_bounded(monkeypatch, tmp_path, far):
    values = far * np.random.default_rng(1).integers(0, 1000, (64, 128, 128))
    (tmp_path / "a.npy").write_bytes(npy(values))
    monkeypatch.setattr(label_volume, "_BLOCK", 2**14)
    read(tmp_path / "a.npy", voxel=1.0, coarsen=32)  # what is loaded with the first use
    tracemalloc.start()
    read(tmp_path / "a.npy", voxel=1.0)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2 * 4 * values.size


@pytest.mark.parametrize("step", [1, 2, 3])
def test_a_part_of_a_volume_has_its_corner_and_every_nth_voxel(tmp_path, step):
    labels = drawn((12, 11, 10), 60)
    whole = LabelVolume.of(labels, (0.1, 0.2, 0.3), (1.0, 2.0, 3.0), source="a.npy")
    part = whole.crop(((1, 10), (0, 8), (2, 10))).coarsen(step)
    middle = step // 2
    expected = labels[2:10, 0:8, 1:10][middle::step, middle::step, middle::step]
    expected = expected[: 8 // step, : 8 // step, : 9 // step]
    assert np.array_equal(part.ids[part.labels], expected)
    assert np.array_equal(part.ids, np.unique(expected))
    assert part.spacing == pytest.approx((0.1 * step, 0.2 * step, 0.3 * step))
    assert part.origin == pytest.approx((1.1, 2.0, 3.6))
    assert np.array_equal(whole.ids[whole.labels], labels)  # the whole is as it was
    (tmp_path / "a.npy").write_bytes(npy(labels))
    crop = ((1, 10), (0, 8), (2, 10))
    made = read(tmp_path / "a.npy", voxel=(0.1, 0.2, 0.3), crop=crop, coarsen=step)
    assert np.array_equal(made.labels, part.labels) and made.spacing == part.spacing
    assert made.origin == pytest.approx((0.1, 0.0, 0.6))


def test_phases_of_dream3d_are_those_of_features_or_of_most_voxels(tmp_path):
    pytest.importorskip("h5py")
    labels = LABELS.astype(np.int32)
    by_label = np.array([0, 1, 2, 2, 1, 1, 2, 1, 2, 2])
    names = ("Unknown", "quartz", "mica")
    for version in (6, 7, 8):
        path = tmp_path / f"{version}.dream3d"
        dream3d(path, labels, version, phases=by_label, phase_names=names)
        found = read(path, unit="mm")
        assert np.array_equal(found.phases, by_label[1:])
        assert found.phase_names == {1: "quartz", 2: "mica"}
        voxels = by_label[labels]
        voxels.flat[np.unique(labels, return_index=True)[1]] = 1  # one of each differs
        path.unlink()
        dream3d(path, labels, version, phase_values=voxels.astype(np.int32))
        assert np.array_equal(read(path, unit="mm").phases, by_label[1:])
    holes = np.where(labels == 1, 0, labels)
    dream3d(tmp_path / "holes.dream3d", holes)
    assert read(tmp_path / "holes.dream3d", unit="mm").has_voids


def test_cells_of_a_raster_have_identifiers_and_groups(tmp_path):
    path = tmp_path / "a.tesr"
    cell = " **cell\n   9\n  *id\n   11 12 13 14 15 16 17 18 8\n  *crysym\n   cubic\n"
    cell += "  *group\n   1 1 2 2 1 1 2 2 7\n"
    path.write_bytes(tesr(np.where(LABELS == 4, 0, LABELS), cell=cell, origin=CORNER))
    found = read(path, unit="mm")
    names = np.array([0, 11, 12, 13, 0, 15, 16, 17, 18, 8])
    assert np.array_equal(found.ids[found.labels], names[LABELS])
    assert found.has_voids
    assert dict(zip(found.ids.tolist(), found.phases.tolist(), strict=True)) == {
        **{0: 0, 11: 1, 12: 1, 13: 2, 15: 1, 16: 1, 17: 2, 18: 2, 8: 7}
    }
    assert found.crop(((0, 7), (0, 6), (0, 5))).has_voids
    path.write_bytes(tesr(0 * LABELS, cell=" **cell\n   0\n  *group\n"))
    assert read(path, unit="mm").phases is None
    plain = tesr(LABELS, cell=cell.replace("*group", "*phase").replace("11 12", "1 2"))
    path.write_bytes(plain)
    assert read(path, unit="mm").phases.tolist() == [1, 1, 7, 2, 2, 1, 1, 2, 2]
    (tmp_path / "cells.raw").write_bytes(LABELS.tobytes())
    text = tesr(LABELS)
    text = text[: text.index(b"ascii")] + b"binary8\n *file cells.raw\n***end\n"
    path.write_bytes(text)
    assert np.array_equal(read(path, unit="mm").labels, LABELS - 1)


def test_arrays_are_chosen_by_name(tmp_path):
    pytest.importorskip("h5py")
    made = image(LABELS)
    other = image(LABELS + 1, name="other").GetCellData().GetArray(0)
    made.GetCellData().AddArray(other)
    for name, content in (("a.vti", vti(made)), ("a.vtk", vtk(made)), ("b.vtk", vtk(made, True))):
        (tmp_path / name).write_bytes(content)
        for array, more in (("ids", 0), ("other", 1)):
            found = read(tmp_path / name, unit="mm", array=array)
            assert np.array_equal(found.ids[found.labels], LABELS + more)
        refusal("may be one of ids, other; give one", read, tmp_path / name, unit="mm")
        words = "array x is missing; arrays of one number for each cell or point = ids, other"
        refusal(words, read, tmp_path / name, unit="mm", array="x")
    dream3d(tmp_path / "a.dream3d", LABELS.astype(np.int32), name="Mine")
    for array in ("Mine", "/DataStructure/Image/CellData/Mine"):
        found = read(tmp_path / "a.dream3d", unit="mm", array=array)
        assert np.array_equal(found.labels, LABELS - 1)
    words = "FeatureIds or GrainIds of one number for each voxel is missing; give one of .*Mine"
    refusal(words, read, tmp_path / "a.dream3d", unit="mm")


def refused_files(folder):
    """Files that are refused: content, words of the error and options of `read`."""
    good = {"ascii.vti": vti(LABELS, "ascii"), "a.tesr": tesr(LABELS)}
    good |= {"t.vtk": vtk(LABELS, True), "b.vtk": vtk(LABELS)}
    half = LABELS + 0.5
    nan = np.where(LABELS == 1, np.nan, LABELS)
    first = np.argwhere(LABELS == 1)[0][::-1]
    at = "x {}, y {}, z {}".format(*first)
    flat = tesr(LABELS).replace(b"   7 6 5", b"   7 30 1")
    plane = tesr(LABELS).replace(b"   3\n", b"   2\n", 1)
    return [
        ("a.npy", npy(half), "labels = 1.5 at x|labels = .*5 at x 0, y 0, z 0, must be whole", {}),
        ("a.npy", npy(nan), f"labels = nan at {at}, must be whole numbers", {}),
        ("a.npy", npy(LABELS[0]), "give a single slice to flexpm specimen image", {}),
        ("a.npy", npy(LABELS[:1]), "must be >= 2 along z; give a volume, or one slice to", {}),
        ("a.npy", npy(LABELS.astype(complex)), "labels = complex128 array of shape", {}),
        ("a.npy", npy(np.array(["a"])), "must be numbers along z, y and x", {}),
        ("a.npy", npy(np.array([[[{}]]])), "must be an array of numbers: ", {}),
        ("a.npy", npy(LABELS)[:-1], "must be an array of numbers", {}),
        ("a.npy", npy(LABELS), "counts = (7, 6, 5), is for .raw files only", {"counts": (7, 6, 5)}),
        ("a.npy", npy(LABELS), "array = 'b', is for .dream3d, .vti, .vtk files", {"array": "b"}),
        ("a.raw", b"a" * 210, "counts and dtype: a .raw file has no head; give counts", {}),
        ("a.raw", b"a" * 210, "counts = 7, must be a list", {"counts": 7, "dtype": "u1"}),
        ("a.raw", b"a", "counts along y = 0, must be >= 1", {"counts": (7, 0, 5), "dtype": "u1"}),
        ("a.raw", b"a", "dtype = 'O', must be one of u1", {"counts": (7, 6, 5), "dtype": "O"}),
        (
            *("a.raw", b"a" * 200, "size = 200 bytes, must be 420 for 7 x 6 x 5 numbers of 2"),
            {"counts": (7, 6, 5), "dtype": "<u2"},
        ),
        ("a.tif", tiff(LABELS[:1]), "must be >= 2 along z; give a volume, or one slice", {}),
        ("a.tif", tiff(LABELS)[:300], "must be a TIFF stack or PNG slices of", {}),
        ("a.tif", b"II*\0", "must be a TIFF stack or PNG slices of", {}),
        (
            *("a.tif", tiff(LABELS[:1], "ImageJ=1\nimages=5\n")),
            *("pages = 1, must be 5 by ImageJ's description", {}),
        ),
        ("a.tif", tiff(np.zeros((3, 4, 5, 3), np.uint8)), "mode of page 1 = RGB, must be grey", {}),
        ("a.tesr", plane, "dimension = 2, must be 3: give a volume, or a raster in 2D to", {}),
        ("a.tesr", flat, "must be >= 2 along z; give a volume, or one slice to flexpm spec", {}),
        ("a.tesr", good["a.tesr"].replace(b"\n***end", b" 1\n***end"), "more than 210 voxels", {}),
        ("a.tesr", good["a.tesr"].replace(b" 1 ", b" x ", 1), "line .*cell of a voxel = 'x'", {}),
        ("a.tesr", good["a.tesr"][:-40], "cell of a voxel = '', must be a whole number", {}),
        ("a.tesr", tesr(LABELS, cell=" **cell\n 4"), "= 9, must be <= 4, the number of cells", {}),
        ("a.tesr", tesr(LABELS, spacing=(1.0, 0.0, 1.0)), "size of a voxel along y = 0, must", {}),
        (
            "b.tesr",
            tesr(LABELS, "binary8").replace(b"\n***end", b""),
            "\\*\\*\\*end|must be 210",
            {},
        ),
        ("a.vti", good["ascii.vti"].replace(b"ImageData", b"PolyData"), "must be ImageData", {}),
        ("a.vti", b"<VTKFile", "tags VTKFile = 0, must be one", {}),
        (
            *("a.vti", good["ascii.vti"].replace(b' Extent="0 7', b' Extent="0 6')),
            *("must be the whole extent; save the image in one piece", {}),
        ),
        (
            *("a.vti", good["ascii.vti"].replace(b'"1 0 0 0 1 0 0 0 1"', b'"0 1 0 1 0 0 0 0 1"')),
            *("Direction = '0 1 0 1 0 0 0 0 1', must be 1 0 0 0 1 0 0 0 1", {}),
        ),
        ("a.vti", vti(LABELS, "raw")[:-80], "array 'ids': data are broken: they have", {}),
        ("a.vti", vti(LABELS, "binary").replace(b"ZLib", b"Zip"), "compressor = 'vtkZip", {}),
        ("a.vtk", good["t.vtk"].replace(b"_POINTS", b"_GRID"), "must be DATASET STRUCTURED_P", {}),
        ("a.vtk", good["t.vtk"].replace(b"DIMENSIONS 8", b"DIMENSIONS 9"), "by DIMENSIONS", {}),
        ("a.vtk", good["t.vtk"][:-200], "array 'ids': number = '', must be one of 210 of type", {}),
        ("a.vtk", good["b.vtk"][:-200], "array 'ids' = less than 210 numbers, must be 210", {}),
        ("a.vtk", b"x", "must begin with # vtk DataFile", {}),
        ("a.raw", b"a" * 210, "array = 'b', is for .dream3d, .vti, .vtk files", {"array": "b"}),
        ("a.tesr", tesr(LABELS, origin=(1e9, 0.0, 0.0)), "origin along x = 1000000000.0 m", {}),
        ("a.xyz", b"", "must be a folder of slices or end in .tif", {}),
        ("a.npy", npy(LABELS), "voxel along y = 0 m, must be > 0", {"voxel": (1, 0, 1)}),
        ("a.npy", npy(LABELS), "voxel = (1, 2), must be one number or three", {"voxel": (1, 2)}),
        ("a.npy", npy(LABELS), "crop along x = 8, must be <= 7", {"crop": ((0, 8),) * 3}),
        ("a.npy", npy(LABELS), "voxels along x = 3 to 4, must be 2", {"crop": ((3, 4),) * 3}),
        ("a.npy", npy(LABELS), "crop = 5, must be a list", {"crop": 5}),
        ("a.npy", npy(LABELS), "must be two numbers along each of x", {"crop": ((0, 2, 1),) * 3}),
        ("a.npy", npy(LABELS), "voxels along x = 0 to 7 in steps of 4, must", {"coarsen": 4}),
    ]


def test_what_is_refused_is_told_in_one_line(tmp_path):
    for name, content, words, options in refused_files(tmp_path):
        (tmp_path / name).write_bytes(content)
        refusal(words, read, tmp_path / name, **{"voxel": 1.0, **options})
    refusal("'.*x.npy', is missing; give the file", read, tmp_path / "x.npy", voxel=1.0)
    os.mkfifo(tmp_path / "p.npy")  # nobody writes into it
    refusal("'.*p.npy', is not a file; give the file", read, tmp_path / "p.npy", voxel=1.0)
    refusal("is missing|cannot be read", read, "a\0.npy", voxel=1.0)


@pytest.mark.parametrize("name", ["a.raw", "a.dream3d", "a.vti", "a.vtk", "a.npy", "a.tif"])
def test_a_volume_given_as_an_image_is_sent_to_the_command_of_volumes(tmp_path, name):
    path = tmp_path / name
    path.write_bytes({"a.npy": npy(LABELS), "a.tif": tiff(LABELS)}.get(name, b"a"))
    refusal("flexpm specimen volume reads volumes; save one slice", picture.read, tmp_path)
    refusal("flexpm specimen volume reads volumes; save one slice", picture.read, path)


def test_folders_of_slices_that_are_not_whole_are_refused(tmp_path):
    slices(tmp_path / "a", LABELS, first=3)
    names = sorted(one.name for one in (tmp_path / "a").iterdir())
    assert names[0] == "scan 2_3.tif"
    (tmp_path / "a" / "notes.txt").write_text("7")
    assert read(tmp_path / "a", voxel=1.0).counts == (7, 6, 5)
    (tmp_path / "a" / names[1]).rename(tmp_path / "kept.tif")
    refusal("slice 4 is missing after scan 2_3.tif", read, tmp_path / "a", voxel=1.0)
    (tmp_path / "kept.tif").rename(tmp_path / "a" / names[1])
    (tmp_path / "a" / "other 7.tif").write_bytes((tmp_path / "a" / names[0]).read_bytes())
    refusal("slice 7 = other 7.tif and scan 2_7.tif", read, tmp_path / "a", voxel=1.0)
    (tmp_path / "a" / "other 7.tif").unlink()
    Image.fromarray(LABELS[0, :4]).save(tmp_path / "a" / names[2])
    refusal(
        "size of the slice = 7 x 4 pixels along x, y, must be 7 x 6",
        read,
        tmp_path / "a",
        voxel=1.0,
    )
    Image.fromarray(LABELS[0].astype(np.uint16)).save(tmp_path / "a" / names[2])
    refusal("type of the slice = uint16, must be uint8", read, tmp_path / "a", voxel=1.0)
    (tmp_path / "a" / "none.png").write_bytes(b"")
    refusal("name of a slice has no number", read, tmp_path / "a", voxel=1.0)
    (tmp_path / "empty").mkdir()
    refusal("slices = 0 files with .tif, .tiff, .png", read, tmp_path / "empty", voxel=1.0)


#: Files whose heads claim far more voxels than they have.
MANY = {
    "a.tesr": tesr(LABELS).replace(b"   7 6 5", b"   70000 60000 50000"),
    "b.tesr": tesr(LABELS, "binary8").replace(b"   7 6 5", b"   70000 60000 50000"),
    "a.vti": vti(LABELS).replace(b'"0 7 0 6 0 5"', b'"0 70000 0 60000 0 50000"'),
    "t.vti": vti(LABELS, "ascii").replace(b'"0 7 0 6 0 5"', b'"0 70000 0 60000 0 50000"'),
    "a.vtk": vtk(LABELS.astype(int))
    .replace(b"DIMENSIONS 8 7 6", b"DIMENSIONS 70001 60001 50001")
    .replace(b"CELL_DATA 210", b"CELL_DATA 210000000000000"),
}


@pytest.mark.parametrize("name", MANY)
def test_heads_are_checked_before_memory_is_taken(tmp_path, name):
    (tmp_path / name).write_bytes(MANY[name])
    tracemalloc.start()
    refusal("are more than a file of|less than 210000000000000", read, tmp_path / name, voxel=1.0)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10**6


def test_a_volume_beyond_the_free_memory_is_refused_with_both_numbers(tmp_path, monkeypatch):
    for name in ("a.npy", "a.tif", "a.tesr", "a.vti"):
        path, _ = write(tmp_path, name, LABELS)
        monkeypatch.setattr(volume_file, "available_memory", lambda: 150)
        words = r"voxels = 7 x 6 x 5 along x, y, z, need \S+ GB of memory, must be at most 1.5e-07"
        refusal(words, read, path, voxel=1.0)


def test_a_pickle_is_not_executed(tmp_path):
    class Harm:
        def __reduce__(self):
            return (os.mkdir, (str(tmp_path / "harm"),))

    (tmp_path / "a.npy").write_bytes(npy(np.array([[[Harm()]]], dtype=object)))
    refusal("must be an array of numbers", read, tmp_path / "a.npy", voxel=1.0)
    assert not (tmp_path / "harm").exists()


def test_files_that_lead_to_other_files_are_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    labels = LABELS.astype(np.int32)
    labels.tofile(tmp_path / "a.bin")
    dream3d(tmp_path / "a.dream3d", labels, name="Other")
    with h5py.File(tmp_path / "a.dream3d", "a") as file:
        group = file["DataStructure/Image/CellData"]
        group["FeatureIds"] = h5py.ExternalLink("b.dream3d", "/x")
        group.create_dataset(
            "GrainIds", (*labels.shape, 1), "i4", external=[(str(tmp_path / "a.bin"), 0, 840)]
        )
    refusal("GrainIds lies in other files, must not", read, tmp_path / "a.dream3d", unit="mm")
    (tmp_path / "b.dream3d").write_bytes(b"no")
    refusal("must be a file of DREAM3D: ", read, tmp_path / "b.dream3d", unit="mm")


def test_the_package_of_a_missing_library_is_named(tmp_path, monkeypatch):
    (tmp_path / "a.dream3d").write_bytes(b"\x89HDF\r\n\x1a\n")
    monkeypatch.setitem(sys.modules, "h5py", None)
    refusal("install the package python3-h5py", read, tmp_path / "a.dream3d", unit="mm")
