# SPDX-License-Identifier: GPL-3.0-or-later
"""Neper in space: volumes, neighbours, centres; what the cells bear; what is refused."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from neper_solids import bricks, prism, tess_of, tess_text
from work import growth_of

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.materials.material import Material
from flexpm.specimens.space import tess

YOUNG, STIFF, RATIO = 30e9, 1e13, 0.3
ROCK = Material.from_dict(
    {
        "tensile_strength": 8.5e6,
        "cohesion": 30e6,
        "friction": 0.4,
        "tensile_fracture_energy": 20.0,
        "shear_fracture_energy": 800.0,
        "elastic": {
            "flexible": {
                "young": YOUNG,
                "poisson": 0.2,
                "normal_stiffness": STIFF,
                "shear_ratio": RATIO,
            },
            "rigid": {"normal_stiffness": STIFF, "shear_ratio": RATIO},
        },
    },
    "rock",
)
UNIT = {"width": 1.0, "depth": 1.0, "height": 1.0}


def laguerre(cells, seed, weights="squares"):
    """Cells of random seeds in the unit cube, and the seeds with weights of one meaning."""
    draw = np.random.default_rng(seed)
    rows = np.column_stack((draw.random((cells, 3)), np.full(cells, 0.5 / np.cbrt(cells))))
    if weights != "none":
        rows[:, 3] *= draw.uniform(0.9, 1.1, cells)
    made = Specimen.from_spheres(rows, **UNIT, short_edge=0.0, drop_hidden=True)
    given = {"squares": made.radii**2, "radii": made.radii, "none": 0.0 * made.radii}[weights]
    return made, np.column_stack((made.centres, given)).tolist()


def slices(count, slope):
    """A unit cube in slices between planes aslant, z = k / count + slope (x - 0.5)."""
    square = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    tilt = [0.0, *[slope] * (count - 1), 0.0]
    vertices = [
        [x, y, k / count + tilt[k] * (x - 0.5)] for k in range(count + 1) for x, y in square
    ]
    faces = [[4 * k + corner for corner in range(4)] for k in range(count + 1)]
    cells = []
    for k in range(count):
        sides = range(len(faces) + 1, len(faces) + 5)
        cells.append([-(k + 1), k + 2, *sides])
        for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
            faces.append([4 * k + a, 4 * k + b, 4 * k + 4 + b, 4 * k + 4 + a])
    return vertices, faces, cells


def require_as_the_file(path, scale):
    file = tess.read(path)
    made = Specimen.from_tess_solid(path, scale=scale, short_edge=0.0)
    volumes, _ = file.cells.measured()
    assert made.cells.volumes == pytest.approx(scale**3 * volumes, rel=1e-9)
    assert np.array_equal(made.cells.faces[: made.cells.contacts, :2], file.cells.neighbours)
    return made


@pytest.mark.parametrize("weights", ["squares", "radii", "none"])
def test_cells_of_seeds_have_the_seeds_as_centres(tmp_path, weights):
    source, seeds = laguerre(200, 3, weights)
    (tmp_path / "a.tess").write_text(tess_of(source, seeds))
    made = require_as_the_file(tmp_path / "a.tess", 0.05)
    assert made.centres == pytest.approx(0.05 * source.centres, rel=1e-12)
    assert made.spec.cells is None  # spheres: all models take them
    assert made.mean_diameter == pytest.approx((6.0 / np.pi * 0.05**3 / 200) ** (1 / 3), rel=0.03)


def test_other_cells_keep_their_shape_and_take_centroids(tmp_path):
    source, _ = laguerre(200, 4)
    wrong = np.random.default_rng(1).random((200, 4)).tolist()
    nodes, tetrahedra, grains = source.tetrahedra()
    volumes = source.meshes().volumes[:, None]
    sums = np.zeros((200, 3))
    np.add.at(sums, grains, volumes * nodes[tetrahedra].mean(axis=1))
    for number, seeds in enumerate((None, wrong)):
        (tmp_path / f"{number}.tess").write_text(tess_of(source, seeds))
        made = require_as_the_file(tmp_path / f"{number}.tess", 0.05)
        assert made.spec.cells is not None
        assert made.centres == pytest.approx(0.05 * sums / source.cells.volumes[:, None], rel=1e-9)


def test_faces_may_go_round_either_way_and_the_box_be_anywhere(tmp_path):
    vertices, faces, cells = bricks((2, 3, 2))
    moved = [[x - 7.0, y + 3.0, z + 1e-13] for x, y, z in vertices]
    turned = [ring[:: 1 - 2 * (k % 2)] for k, ring in enumerate(faces)]
    (tmp_path / "a.tess").write_text(tess_text(moved, turned, cells))
    made = require_as_the_file(tmp_path / "a.tess", 0.02)
    assert made.dimensions == pytest.approx({"width": 0.02, "depth": 0.02, "height": 0.02})
    assert made.cells.volumes == pytest.approx(np.full(12, 0.02**3 / 12))
    assert (made.cells.contacts, len(made.cells.faces)) == (20, 52)


def cylinder(stretch=1.0):
    """Cells in a cylinder of diameter and height 1 that was turned, moved and perhaps stretched."""
    draw = np.random.default_rng(8)
    rows = np.column_stack((draw.uniform(-0.35, 0.35, (40, 2)), draw.random(40), np.full(40, 0.15)))
    source = Specimen.from_spheres(rows, diameter=1.0, height=1.0, short_edge=0.0)
    cosine, sine = math.cos(0.3), math.sin(0.3)
    x, y, z = source.cells.vertices.T
    moved = np.column_stack((cosine * x - sine * y + 3.0, stretch * (sine * x + cosine * y), z - 1))
    return source, tess_of(source, vertices=moved.tolist())


def test_cells_in_an_upright_cylinder_make_one(tmp_path):
    source, text = cylinder()
    (tmp_path / "a.tess").write_text(text)
    made = require_as_the_file(tmp_path / "a.tess", 0.05)
    assert made.kind == "cylinder" and made.spec.cells is not None
    assert made.dimensions == pytest.approx({"diameter": 0.05, "height": 0.05}, rel=1e-9)
    assert made.cells.volumes == pytest.approx(0.05**3 * source.cells.volumes, rel=1e-9)
    assert made.outline().walls == pytest.approx(source.outline().walls * [1, 1, 1, 0.05], abs=1e-9)
    made.save(tmp_path / "a.json")
    again = Specimen.load_solid(tmp_path / "a.json")
    assert np.array_equal(again.cells.vertices, made.cells.vertices)
    same = Specimen.from_spheres(source.spheres * 0.05, diameter=0.05, height=0.05, short_edge=0.0)
    found, expected = (flexpm.elastic(one, ROCK)["youngs_modulus"] for one in (made, same))
    assert found == pytest.approx(expected, rel=2e-3)  # tetrahedra meet at other centres
    text = tess_text(*prism(16, 2))
    (tmp_path / "a.tess").write_text(text)
    area = 8.0 * math.sin(math.pi / 8.0)
    found = Specimen.from_tess_solid(tmp_path / "a.tess").dimensions
    assert found == pytest.approx({"diameter": 2.0 * math.sqrt(area / math.pi), "height": 2.0})


@pytest.mark.parametrize("kind", ["oval", "few facets"])
def test_other_prisms_are_refused(tmp_path, kind):
    text = cylinder(stretch=1.01)[1] if kind == "oval" else tess_text(*prism(15, 2))
    (tmp_path / "a.tess").write_text(text)
    with pytest.raises(
        InputError, match="must lie on a side; take cells of a box along x, y, z or"
    ):
        Specimen.from_tess_solid(tmp_path / "a.tess")


def test_bricks_are_springs_in_series(tmp_path):
    """Uniform stress along z, stacks of n bricks: 1 / E' = 1 / E + (n - 1) / (K_n L)."""
    (tmp_path / "a.tess").write_text(tess_text(*bricks((2, 3, 5))))
    made = Specimen.from_tess_solid(tmp_path / "a.tess", scale=0.02)
    expected = 1.0 / (1.0 / YOUNG + 4.0 / (STIFF * 0.02))
    assert flexpm.elastic(made, ROCK)["youngs_modulus"] == pytest.approx(expected, rel=1e-8)


def modulus_of_slices(count, slope, grains):
    """E' of such a cube of 20 mm: each contact opens and slips by its area vector."""
    angle = math.atan(slope)
    soft = math.cos(angle) * (math.cos(angle) ** 2 + math.sin(angle) ** 2 / RATIO) / STIFF
    return 1.0 / (grains + (count - 1) * soft / 0.02)


@pytest.mark.parametrize(("count", "slope"), [(2, 0.5), (6, 0.15)])
def test_the_law_has_the_normal_of_the_face(tmp_path, count, slope):
    (tmp_path / "a.tess").write_text(tess_text(*slices(count, slope)))
    made = Specimen.from_tess_solid(tmp_path / "a.tess", scale=0.02)
    way = made.centres[1] - made.centres[0]
    normal = np.array([-slope, 0.0, 1.0]) / math.hypot(1.0, slope)
    assert math.degrees(math.acos(way @ normal / np.linalg.norm(way))) > 4.0
    expected = modulus_of_slices(count, slope, 1.0 / YOUNG)
    assert flexpm.elastic(made, ROCK)["youngs_modulus"] == pytest.approx(expected, rel=1e-8)


def test_short_edges_are_collapsed_and_the_file_reads_back(tmp_path):
    source, _ = laguerre(60, 5)
    (tmp_path / "a.tess").write_text(tess_of(source))
    made = Specimen.from_tess_solid(tmp_path / "a.tess", scale=0.03)
    assert made.cells.contacts < made.cells.uncollapsed_contacts == source.cells.contacts
    assert made.statistics()["cell_volume"] == pytest.approx(0.03**3, rel=1e-12)
    made = made.with_minerals([k % 2 for k in range(60)])
    made.save(tmp_path / "a.json")
    again = Specimen.load_solid(tmp_path / "a.json")
    assert again.spec == made.spec and np.array_equal(again.minerals, made.minerals)
    assert np.array_equal(again.cells.vertices, made.cells.vertices)
    assert np.array_equal(again.cells.face_vertices, made.cells.face_vertices)
    again.save(tmp_path / "b.json")
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_the_law_of_a_running_test_has_that_normal_too(tmp_path):
    (tmp_path / "a.tess").write_text(tess_text(*slices(12, 0.08)))
    made = Specimen.from_tess_solid(tmp_path / "a.tess", scale=0.02, short_edge=0.0)
    how = {"rate": 0.5, "max_strain": 2e-4, "report": False}
    curve = flexpm.run("uniaxial", made, ROCK, **how).curve
    found = curve["axial_stress"][-1] / curve["axial_strain"][-1]
    # normals along the centre lines, which are upright, would give 1 % more
    assert found == pytest.approx(modulus_of_slices(12, 0.08, 1.0 / YOUNG), rel=3e-4)


def test_rigid_cells_are_compressed(tmp_path):
    """A contact gives way in each height of a brick."""
    (tmp_path / "a.tess").write_text(tess_text(*bricks((2, 2, 12))))
    made = Specimen.from_tess_solid(tmp_path / "a.tess", scale=0.02, short_edge=0.0)
    how = {"rate": 0.5, "max_strain": 2e-4, "report": False}
    result = flexpm.run("uniaxial", made, ROCK, "rigid", **how)
    found = result.curve["axial_stress"][-1] / result.curve["axial_strain"][-1]
    assert found == pytest.approx(STIFF * 0.02 / 12, rel=1e-3)
    assert result.inputs["specimen"]["cells"] == made.spec.cells


def test_spheres_of_other_models_are_refused(tmp_path):
    (tmp_path / "a.tess").write_text(tess_text(*bricks((2, 2, 2))))
    made = Specimen.from_tess_solid(tmp_path / "a.tess", scale=0.02)
    with pytest.raises(InputError, match="must be flexible or rigid for user-supplied cells"):
        flexpm.run("uniaxial", made, model="jcfpm", out=tmp_path / "run")


@pytest.mark.long
def test_the_work_of_reading_ten_thousand_cells_is_that_of_as_many_cells(tmp_path):
    def read(count):
        return Specimen.from_tess_solid(tmp_path / f"{count}.tess", scale=0.3, short_edge=0.0)

    sources = {count: laguerre(count, 6) for count in (2_500, 10_000)}
    for count, drawn in sources.items():
        (tmp_path / f"{count}.tess").write_text(tess_of(*drawn, version="2.0"))
    assert growth_of(read, 2_500, 10_000) < 4.4
    made, source = read(10_000), sources[10_000][0]
    assert made.cells.volumes == pytest.approx(0.3**3 * source.cells.volumes, rel=1e-9)
    assert np.array_equal(made.cells.faces[:, :2], source.cells.faces[:, :2])


VERTICES, FACES, CELLS = bricks((2, 2, 1))
GOOD = tess_text(VERTICES, FACES, CELLS)


def moved(x, y, *vertices):
    """Four bricks with some vertices at other places."""
    places = [
        [x, y, z] if k in vertices else [*at] for k, at in enumerate(VERTICES) for z in at[2:]
    ]
    return tess_text(places, FACES, CELLS)


def with_cells(*cells):
    """The first of four bricks with other faces."""
    return tess_text(VERTICES, FACES, [*cells, *CELLS[len(cells) :]])


BROKEN = {
    "plane": (GOOD.replace("3 standard", "2 standard"), "line 5: dimension = 2, must be 3"),
    "old": (GOOD.replace("3.5", "1.9.2"), "line 4: format = 1.9.2, must be 2.0 or later"),
    "cut": (GOOD[: GOOD.index(" **polyhedron")], "section = '', must be **polyhedron"),
    "cut late": (GOOD.replace("***end", ""), "section = end of the file, must be ***end"),
    "number": (
        GOOD.replace("0.5 1.0 0.0", "0.5 nan 0.0"),
        "vertex 11: y = 'nan', must be a number",
    ),
    "many": (GOOD.replace("**cell\n  4", "**cell\n  200000"), "cells = '200000', must be"),
    "twice": (
        with_cells([*CELLS[0], CELLS[0][0]]),
        "polyhedron 1: face = 1, must belong to one or two polyhedra",
    ),
    "thrice": (with_cells([*CELLS[0], 3]), "line 156: polyhedron 1: face = 3, must be"),
    "empty": (with_cells([]), "polyhedron 1: faces = 0, is an empty cell; leave out its seed"),
    "open": (with_cells(CELLS[0][1:]), "polyhedra = 0, must be 1 or 2"),
    "hole": (with_cells(CELLS[0][:-1]), "face 14: polyhedra = 0, must be 1 or 2"),
    "bent": (moved(0.5, 0.4, 8), "cell 1, face 8: corners off its plane by = 0.0"),
    "hollow": (moved(0.2, 0.2, 8, 9), "must be convex, to"),
    "outside": (moved(1.2, 0.0, 12, 13), "must lie on a side; take cells"),
    "size": (moved(1e9, 0.0, 12), "width = 1000000000.0 m"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_files_are_one_line_with_the_place(tmp_path, name):
    text, words = BROKEN[name]
    (tmp_path / "a.tess").write_text(text)
    with pytest.raises(InputError) as error:
        Specimen.from_tess_solid(tmp_path / "a.tess")
    assert words in str(error.value) and "\n" not in str(error.value)


def test_the_command_writes_figures_and_the_solid(tmp_path, capsys):
    (tmp_path / "a.tess").write_text(tess_text(*bricks((2, 2, 3))))
    given = ["specimen", "tess", str(tmp_path / "a.tess"), "--scale", "0.03", "--quiet"]
    assert cli.main([*given, "--out", str(tmp_path / "out")]) == 0
    found = json.loads((tmp_path / "out/specimen.json").read_text())
    assert (found["grains"], found["contacts"]) == (12, 20)
    assert Specimen.load_solid(tmp_path / "out/solid.json").spec.cells is not None
    capsys.readouterr()
    assert cli.main([*given, "--thickness", "0.1", "--out", str(tmp_path / "out")]) == 2
    assert "thickness = 0.1 m, must not be given for 3D cells" in capsys.readouterr().err
