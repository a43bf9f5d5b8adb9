# SPDX-License-Identifier: GPL-3.0-or-later
"""Solid specimens: packed, given and saved; what they fill, what is refused, and their files."""

import json
import math
import types

import numpy as np
import pytest
from refusals import refusal, refused_command
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import flexpm
from flexpm import Specimen
from flexpm.errors import InputError
from flexpm.specimens.joint_cutting import Excavatable


@pytest.fixture(scope="module")
def box():
    return Specimen.box(0.012, 0.013, 0.018, seed=2)


@pytest.fixture(scope="module")
def cylinder():
    return Specimen.cylinder(0.014, 0.02)


@pytest.mark.parametrize("name", ["box", "cylinder"])
def test_a_packing_fills_its_outline(name, request):
    made = request.getfixturevalue(name)
    found = made.statistics()
    assert found["cell_volume"] == pytest.approx(made.spec.volume, rel=1e-12)
    assert found["grains"] == len(made.spheres) == made.cells.cells
    mean_cube = 0.25 * (2e-3 + 4e-3) * (2e-3**2 + 4e-3**2)
    count = 0.9 * made.spec.volume / (math.pi / 6.0 * mean_cube)
    assert abs(found["grains"] + found["removed_spheres"] - count) <= 0.5
    assert found["removed_spheres"] == 0
    assert 7.0 < found["coordination"] < 12.0
    assert found["contacts"] < found["uncollapsed_contacts"]
    assert found["contact_points"] == found["contact_corners"] + found["contacts"]
    assert found["smallest_tetrahedron_volume"] > 0.0
    nodes, tetrahedra, grains = made.tetrahedra()
    a, b, c, d = (nodes[tetrahedra[:, k]] for k in range(4))
    volumes = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6.0
    assert np.bincount(grains, volumes) == pytest.approx(made.cells.volumes, rel=1e-11)
    # the centre of a grain is that of its sphere
    assert np.array_equal(nodes[tetrahedra[:, 0]], made.centres[grains])


def test_a_seed_gives_the_same_bits(box):
    again = Specimen.box(0.012, 0.013, 0.018, seed=2)
    assert np.array_equal(again.spheres, box.spheres)
    assert np.array_equal(again.cells.vertices, box.cells.vertices)
    assert np.array_equal(again.cells.face_vertices, box.cells.face_vertices)
    assert not np.array_equal(Specimen.box(0.012, 0.013, 0.018).spheres, box.spheres)


@pytest.mark.parametrize(
    ("name", "sizes"),
    [
        ("box", (0.012, 0.013, 0.018)),
        ("cylinder", (0.014, 0.02)),
        ("solid_disc", (0.03, 0.015)),
        ("solid_half_disc", (0.03, 0.015)),
    ],
)
def test_holes_are_cut_into_a_specimen(name, sizes):
    with pytest.raises(InputError, match=r"^Specimen[^\n]*holes = [^\n]* use with_holes[^\n]*$"):
        getattr(Specimen, name)(*sizes, holes=[[(0.004, 0.004), (0.006, 0.004), (0.005, 0.006)]])


def test_a_file_reads_back_to_the_same_bits(cylinder, tmp_path):
    cylinder.save(tmp_path / "solid.json")
    again = Specimen.load_solid(tmp_path / "solid.json")
    assert again.spec == cylinder.spec
    assert np.array_equal(again.spheres, cylinder.spheres)
    assert np.array_equal(again.cells.vertices, cylinder.cells.vertices)
    text = (tmp_path / "solid.json").read_text()
    (tmp_path / "changed.json").write_text(text.replace('"seed": 1', '"seed": 2'))
    refusal("was changed after it was saved", Specimen.load_solid, tmp_path / "changed.json")
    with pytest.raises(InputError, match=r"is 3D, must be 2D; .*Specimen.load_solid"):
        Specimen.load(tmp_path / "solid.json")


def test_spheres_of_a_text_file_with_six_digits(cylinder, tmp_path):
    path = tmp_path / "spheres.txt"
    lines = "\n".join(" ".join(f"{value:.6g}" for value in row) for row in cylinder.spheres)
    path.write_text("# x y z radius\n" + lines)
    made = Specimen.from_spheres(path, diameter=0.014, height=0.02)
    assert made.kind == "cylinder"
    assert np.allclose(made.spheres, cylinder.spheres, atol=1e-7)
    # an edge near the limit may be collapsed in one of them
    assert made.cells.volumes == pytest.approx(cylinder.cells.volumes, rel=0.05)
    assert made.statistics()["cell_volume"] == pytest.approx(made.spec.volume, rel=1e-12)
    assert Specimen.from_spheres(cylinder.spheres, diameter=0.014, height=0.02).cells.cells == len(
        cylinder.spheres
    )


def test_spheres_that_hide_others():
    rows = [(5e-3, 5e-3, 5e-3, 2e-3), (5e-3, 5.4e-3, 5e-3, 1e-4)]
    sizes = {"width": 0.01, "depth": 0.01, "height": 0.01}
    refusal(r"hidden spheres = 1 \(1\), must have a cell", Specimen.from_spheres, rows, **sizes)
    made = Specimen.from_spheres(rows, drop_hidden=True, **sizes)
    assert (made.removed_spheres, made.cells.cells) == (1, 1)
    assert made.statistics()["cell_volume"] == pytest.approx(1e-6)


CUBE = {"width": 0.01, "depth": 0.01, "height": 0.01}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Specimen.box(0.0, 0.01, 0.01), "width = 0.0 m, must be > 0"),
        (lambda: Specimen.box(0.01, math.nan, 0.01), "depth = nan m, must be finite"),
        (lambda: Specimen.box(0.01, 0.01, math.inf), "height = inf m, must be finite"),
        (lambda: Specimen.cylinder(-1.0, 0.01), "diameter = -1.0 m, must be > 0"),
        (lambda: Specimen.cylinder(0.007, 0.1), "must be <= half the specimen's smallest"),
        (lambda: Specimen.box(0.01, 0.01, 0.01, seed=-1), "seed = -1, must be >= 0"),
        (lambda: Specimen.box(0.01, 0.01, 0.01, porosity=1.0), "porosity = 1.0, must be < 1"),
        (lambda: Specimen.box(0.01, 0.01, 0.01, short_edge=0.5), "short_edge = 0.5, must be < 0.5"),
        (
            lambda: Specimen.cylinder(10.0, 20.0),
            r"grains = 9e\+10, need .* GB of memory, must be at most .* GB",
        ),
        (lambda: Specimen.from_spheres([[1, 2, 3]], **CUBE), r"shape \(1, 3\), must be rows"),
        (lambda: Specimen.from_spheres("nowhere.txt", **CUBE), "'nowhere.txt', cannot be read"),
        (lambda: Specimen.from_spheres([], **CUBE), "must be rows x, y, z, radius"),
        (
            lambda: Specimen.from_spheres([(0.02, 0.005, 0.005, 1e-3)], **CUBE),
            "sphere 0: centre = .* m, must lie inside",
        ),
        (
            lambda: Specimen.from_spheres([(0.005, 0.005, 0.005, 1e-3)] * 2, **CUBE),
            "sphere 1: centre = .* m, must not be that of sphere 0",
        ),
        (
            lambda: Specimen.from_spheres([(0.005, 0.005, 0.005, 0.0)], **CUBE),
            "sphere 0: radius = 0 m, must be finite and > 0",
        ),
        (
            lambda: Specimen.from_spheres([(0, 0, 0.005, 1e-3)], diameter=0.02, **CUBE),
            "must not be given for a cylinder",
        ),
    ],
)
def test_wrong_input_is_refused_in_one_line(make, message):
    refusal(message, make)


def test_a_solid_has_each_method_of_a_2d_specimen(box):
    """What it cannot do it refuses in one line: an AttributeError would name no remedy."""
    plane = vars(flexpm.Specimen) | vars(Excavatable)
    methods = [name for name, one in plane.items() if isinstance(one, types.FunctionType)]
    missing = [name for name in methods if name[0] != "_" and not hasattr(box, name)]
    assert missing == []


@pytest.mark.parametrize(
    ("use", "message"),
    [
        (lambda solid: flexpm.run("biaxial", solid), "rectangle for biaxial; use triaxial"),
        (lambda solid: flexpm.run("brazilian", solid), "must be a disc for brazilian"),
        (lambda solid: flexpm.compare("scb", solid), "must be a half-disc for scb"),
        (lambda solid: flexpm.run("uniaxial", solid, model="inner"), "one of flexible, rigid"),
        (lambda solid: flexpm.run("uniaxial", solid, points=1), "points = 1, must be left out"),
        (lambda solid: flexpm.build(solid, mesh="fan"), "must not be given for a 3D specimen"),
        (lambda solid: flexpm.build(solid, model="inner"), "one of flexible, rigid"),
        (lambda solid: solid.joints_from_geojson("a.geojson"), "must be 2D: maps of joints"),
        (lambda solid: solid.with_excavations({"a": ((0, 0), 1)}), "must be 2D: excavations"),
        (lambda solid: solid.excavation("a"), "must be 2D: excavations"),
        (lambda solid: solid.with_strengths([1.0]), "must be 2D: strengths of single contacts"),
        (lambda solid: solid.with_weibull_strengths(3.0), "with_weibull_strengths: specimen = box"),
    ],
)
def test_what_is_of_the_plane_alone_is_refused(use, message, box):
    refusal(message, use, box)


@pytest.mark.parametrize("kind", ["box", "cylinder"])
def test_the_command_writes_statistics_mesh_and_picture(kind, tmp_path, capsys):
    from flexpm.cli.main import main

    sizes = {"box": ["--width", "0.01", "--depth", "0.01"], "cylinder": ["--diameter", "0.01"]}
    out = tmp_path / "out"
    options = [*sizes[kind], "--height", "0.015", "--out", str(out), "--quiet"]
    assert main(["specimen", kind, *options]) == 0
    found = json.loads((out / "specimen.json").read_text())
    assert str(found["grains"]) in capsys.readouterr().out
    assert (out / "specimen.png").stat().st_size > 10_000
    made = Specimen.load_solid(out / "solid.json")
    assert made.cells.cells == found["grains"]

    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(out / "specimen.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    arrays = grid.GetCellData()
    shown, first, second = (
        vtk_to_numpy(arrays.GetArray(name)) for name in ("kind", "grain", "neighbour")
    )
    assert np.count_nonzero(shown == 0) == found["tetrahedra"]
    assert np.count_nonzero(shown == 1) == found["contacts"]
    assert np.array_equal(np.unique(first[shown == 0]), np.arange(found["grains"]))
    assert np.all(second[shown == 0] == -1)
    assert np.all(second[shown == 1] > first[shown == 1])
    assert grid.GetCellType(0) == 10
    assert grid.GetCellType(grid.GetNumberOfCells() - 1) == 7


def test_the_command_refuses_in_one_line(box, tmp_path, capsys):
    from flexpm.cli.main import main

    assert main(["specimen", "cylinder", "--diameter", "0.003"]) == 2
    assert "smallest dimension, 0.0015 m" in capsys.readouterr().err
    box.save(tmp_path / "solid.json")
    file = str(tmp_path / "solid.json")
    for command in (["run", "scb"], ["compare", "scb"]):
        assert main([*command, "--specimen", file, "--out", str(tmp_path / "out")]) == 2
        told = capsys.readouterr().err
        assert "specimen = box, must be a half-disc" in told
        assert told.count("\n") == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("uniaxial --shape cylinder --diameter 0.003", "smallest dimension, 0.0015 m"),
        ("uniaxial --shape cylinder --diameter nan", "must be finite"),
        ("uniaxial --shape box --depth -1", "must be > 0"),
        ("uniaxial --shape box --diameter 0.05", "must not be given for a box"),
        ("uniaxial --shape box --thickness 0.1", "thickness = 0.1 m, must not be given for a box"),
        ("uniaxial --depth 0.05", "must not be given for a rectangle"),
        ("triaxial --thickness 0.1", "thickness = 0.1 m, must not be given for a cylinder"),
        ("triaxial --joints a.geojson", "must be left out for a cylinder: maps of joints"),
        ("triaxial --joints a.csv --name b", "must be left out for a cylinder: maps of joints"),
        ("uniaxial --shape box --joints a.csv", "joints = 'a.csv', cannot be read"),
        ("uniaxial --shape box --network-seed 2", "needs a network"),
        ("uniaxial --shape box --notch 0.01", "must not be given for uniaxial"),
        ("uniaxial --shape box --model inner", "must be one of flexible, rigid"),
        ("uniaxial --shape box --model jcfpm --dynamic", "must be False for jcfpm grains in a box"),
        ("uniaxial --shape box --confinement 1e6", "must be 0 for uniaxial; use triaxial"),
        ("biaxial --shape cylinder --confinement 1e6", "use triaxial for 3D specimens"),
        ("triaxial --width 0.02", "must not be given for a cylinder"),
        ("triaxial --confinement 1e6,2e6", "second_confinement = 2e+06 Pa, must be left out for a"),
        ("triaxial --confinement 1e6,2e6,3e6", "must be one or two pressures; write P or P,P"),
        ("triaxial --confinement -1", "confinement = -1 Pa, must be >= 0"),
        ("triaxial --shape box --confinement 1,2 --second-confinement 3", "leave out one of them"),
        ("triaxial --shape box --second-confinement -3", "must be >= 0"),
        ("uniaxial --second-confinement 3", "second_confinement = 3.0 Pa, must not be given for"),
        ("uniaxial --shape cylinder --diameter 5 --height 10", "GB of memory, must be at most"),
    ],
)
def test_runs_refuse_in_one_line(options, message, tmp_path, capsys):
    refused_command(capsys, message, "run", *options.split(), "--out", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_plane_file_is_no_box(tmp_path, capsys):
    from flexpm.cli.main import main

    Specimen.rectangle(0.012, 0.016, 0.01, seed=1).save(tmp_path / "plane.json")
    asked = ["run", "uniaxial", "--shape", "box", "--specimen", str(tmp_path / "plane.json")]
    assert main([*asked, "--out", str(tmp_path / "out")]) == 2
    assert "is a rectangle, must be a box as in shape" in capsys.readouterr().err
