# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints in pictures, pages, tables and files of runs, in 2D and in 3D. SI units."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import result_schema_file
from browser import opened, shown, slide
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from processes import wait_for
from sample_snapshot import read_vtu, wall
from scenes import fresh

import flexpm
from flexpm.report import comparison, film, joint_colours, outside
from flexpm.report.pages import page_run, page_solid
from flexpm.results.joint_states import MEASURES, joint_states
from flexpm.results.result import Result
from flexpm.results.vtu import read_state, write_vtu

SIDE, HEIGHT = 0.01, 0.02
MIDDLE = (0.5 * SIDE, 0.5 * SIDE, 0.5 * HEIGHT)
DIP = 50.0
#: Contacts that slide at once.
LAW = {
    "normal_stiffness": 1e13,
    "shear_stiffness": 5e12,
    "friction": 0.1,
    "cohesion": 0.0,
    "tensile_strength": 0.0,
}
#: Axial strain at the end of a run.
STRAIN = 5e-4
PLANES = {
    "fault": {"point": MIDDLE, "dip": DIP, "dip_direction": 90.0},
    "bedding": {"point": MIDDLE, "dip": 30.0, "dip_direction": 40.0},
}


def rock(names, *, solid, **changes):
    """Rock with joints, for any size of grains."""
    law = {**LAW, **changes}
    preset = flexpm.materials.load("augig3d-calibrated" if solid else "augig-calibrated", solid)
    keys = {f"joint.{name}.{key}": value for name in names for key, value in law.items()}
    return dataclasses.replace(preset, made_for=None).with_set(keys)


def normal(plane):
    dip, direction = math.radians(plane["dip"]), math.radians(plane["dip_direction"])
    return np.array(
        [
            math.sin(dip) * math.sin(direction),
            math.sin(dip) * math.cos(direction),
            math.cos(dip),
        ]
    )


@pytest.fixture(scope="module")
def crossing():
    """A state of a box with two bonded joints that cross, and its specimen."""
    cut = flexpm.Specimen.box(SIDE, SIDE, HEIGHT).with_joints(PLANES)
    assert set(cut.joint_deviations().values()) == {0.0}
    return fresh(cut, rock(PLANES, solid=True, cohesion=5e6, tensile_strength=1e6)).snapshot(), cut


@pytest.fixture(scope="module")
def slid(tmp_path_factory) -> Path:
    """Folder of a run of a grain that a joint cuts in two, and which slides on it."""
    folder = tmp_path_factory.mktemp("slid") / "solid"
    whole = flexpm.Specimen.from_spheres(
        [(*MIDDLE, 0.5 * SIDE)], width=SIDE, depth=SIDE, height=HEIGHT
    )
    cut = whole.with_joints({"fault": PLANES["fault"]})
    pressed = {"confinement": 1e6, "rate": 2.0, "max_strain": STRAIN}
    flexpm.run("triaxial", cut, rock(["fault"], solid=True), out=folder, **pressed)
    return folder


@pytest.fixture(scope="module")
def slid_plane(tmp_path_factory) -> Path:
    """Folder of the same run of a rectangle of many grains."""
    folder = tmp_path_factory.mktemp("slid") / "plane"
    half = 0.5 * SIDE * math.tan(math.radians(DIP))
    line = [(0.0, 0.5 * HEIGHT - half), (SIDE, 0.5 * HEIGHT + half)]
    cut = flexpm.Specimen.rectangle(SIDE, HEIGHT, 0.01, seed=1).with_joints({"fault": line})
    pressed = {"confinement": 1e6, "rate": 2.0, "max_strain": STRAIN}
    flexpm.run("biaxial", cut, rock(["fault"], solid=False), out=folder, **pressed)
    return folder


def test_traces_lie_on_their_plane_and_on_the_surface(crossing):
    state, specimen = crossing
    traces, expected = state.joint_traces(), specimen.joint_traces()
    assert [*traces] == [*PLANES]
    vertices = specimen.cells.vertices
    for name, plane in PLANES.items():
        ends = state.reference[traces[name]]
        off = np.abs((ends - MIDDLE) @ normal(plane))
        assert off.max() < 1e-9 * HEIGHT
        away = np.minimum(ends, (SIDE, SIDE, HEIGHT) - ends).min(axis=2)
        assert away.max() < 1e-9 * HEIGHT
        # the grains on both sides have the edge
        assert len(ends) == 2 * len(expected[name]) > 0
        length = np.linalg.norm(np.diff(ends, axis=1), axis=2).sum()
        edges = np.linalg.norm(np.diff(vertices[expected[name]], axis=1), axis=2)
        assert length == pytest.approx(2.0 * edges.sum(), rel=1e-9)
    # around a box: a section perpendicular to y, with two sides in x and z and two that rise
    across = 2.0 * SIDE + 2.0 * SIDE / math.cos(math.radians(DIP))
    ends = state.reference[traces["fault"]]
    length = np.linalg.norm(np.diff(ends, axis=1), axis=2).sum()
    assert length == pytest.approx(2.0 * across, rel=1e-9)


def test_the_outside_has_all_traces_that_face_the_viewer(crossing, tmp_path, monkeypatch):
    state, _ = crossing
    figures = []
    monkeypatch.setattr(outside, "save", lambda figure, _: figures.append(figure))
    outside.draw_solid(tmp_path / "outside.png", state)
    surface, cut = figures[0].axes[:2]
    (drawn,) = surface.collections
    colours = np.array([to_hex(one) for one in drawn.get_edgecolor()])
    eye, axes = outside._view()
    corners = state.positions[state.surface]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = state.surface[normals @ eye > 0.0]
    sides = {tuple(sorted(row[:k] + row[k + 1 :])) for row in seen.tolist() for k in range(3)}
    for number, (name, edges) in enumerate(state.joint_traces().items()):
        expected = [pair for pair in edges.tolist() if tuple(sorted(pair)) in sides]
        own = np.flatnonzero(colours == joint_colours.joint_colour(number))
        lines = np.array([drawn.get_paths()[k].vertices[:2] for k in own])
        assert len(lines) == len(expected) > 0, name
        places = 1e3 * state.positions[np.array(expected)] @ axes
        assert np.sort(lines.mean(axis=1), axis=0) == pytest.approx(
            np.sort(places.mean(axis=1), axis=0)
        )
    told = [one.get_text() for one in surface.get_legend().get_texts()]
    assert told == ["joint fault", "joint bedding"]
    section = [
        one for one in cut.collections if to_hex(one.get_edgecolor()[0]) in joint_colours.JOINTS
    ]
    assert len(section) == 2
    fault = np.concatenate(section[0].get_segments())
    off = np.abs((1e-3 * fault - np.array(MIDDLE)[[0, 2]]) @ normal(PLANES["fault"])[[0, 2]])
    assert off.max() < 1e-9 * HEIGHT


def test_a_trace_behind_other_faces_is_hidden():
    """Two walls one behind the other: the nearer one is drawn after the trace of the other."""
    square = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 0.0, 1.0), (0.0, 0.0, 1.0)])
    behind = square + np.array([0.0, 2.0, 0.0])
    faces = [np.arange(4), np.arange(4, 8)]
    axes = Figure().add_subplot()
    traces = {"far": np.array([(4, 5)]), "near": np.array([(1, 0)])}
    outside.draw_faces(
        axes, np.vstack((square, behind)), faces, np.array([0, 1]), edges=False, traces=traces
    )
    (drawn,) = axes.collections
    corners = [len(one.vertices) for one in drawn.get_paths()]
    assert corners == [5, 3, 5, 3]
    edges = [to_hex(one) for one in drawn.get_edgecolor()]
    assert [edges[1], edges[3]] == [*map(joint_colours.joint_colour, (0, 1))]


@pytest.mark.parametrize("name", ["slid", "slid_plane"])
def test_films_and_maps_of_several_runs_have_joints(name, request, tmp_path, monkeypatch):
    image = pytest.importorskip("PIL.Image")
    folder, figures = request.getfixturevalue(name), []
    result = Result.read(folder)
    assert (result.joint_names, result.notches) == (("fault",), [])
    film.write_film(tmp_path / "film.gif", result, [(folder / "final.vtu", 0.0, 0.0)])
    pixels = np.asarray(image.open(tmp_path / "film.gif").convert("RGB"), dtype=float) / 255.0
    colour = joint_colours.joint_colour(0)
    assert np.count_nonzero(np.abs(pixels - to_rgb(colour)).max(axis=-1) < 0.1) > 200
    monkeypatch.setattr(comparison, "save", lambda figure, _: figures.append(figure))
    state = dataclasses.replace(read_state(folder / "final.vtu"), joint_names=result.joint_names)
    result.snapshot = state
    comparison.cracks_picture(tmp_path / "maps.png", [("one", result), ("two", result)])
    (figure,) = figures
    told = [one.get_text() for one in figure.legends[0].get_texts()]
    assert told == ["tensile cracks", "shear cracks", "joint fault"]
    for axes in figure.axes[:2]:
        colours = [to_hex(one.get_edgecolor()[0]) for one in axes.collections]
        assert colours.count(colour) == 1


def test_states_of_joints_are_means_by_length():
    snapshot = wall(columns=3, rows=2)  # contacts k have slip -k nm, opening k nm at first points
    joints = np.full(len(snapshot.contact), -1)
    joints[[1, 3]], joints[5] = 0, 2
    assert joint_states(snapshot) is None
    with_joints = dataclasses.replace(
        snapshot, contact_joint=joints, joint_names=("a", "none", "c")
    )
    found = joint_states(with_joints)
    assert [*found] == ["a", "c"]
    lengths = np.linalg.norm(np.diff(snapshot.contact_ends, axis=1)[:, 0], axis=1)
    assert found["a"]["length"] == pytest.approx(lengths[1] + lengths[3], rel=1e-12)
    first = lengths[[1, 3]] / 6.0 @ np.array([1.0, 3.0]) / lengths[[1, 3]].sum()
    assert found["a"]["slip"] == pytest.approx(1e-9 * first, rel=1e-12)
    assert found["a"]["opening"] == pytest.approx(1e-9 * first, rel=1e-12)
    assert found["a"]["damage"] == pytest.approx(first / len(joints), rel=1e-12)
    assert found["a"]["largest_slip"] == pytest.approx(3e-9, rel=1e-12)
    assert found["a"]["largest_opening"] == pytest.approx(3e-9, rel=1e-12)
    assert found["a"]["cracked"] == 0.0
    assert found["c"]["slip"] == pytest.approx(5e-9 / 6.0, rel=1e-12)
    broken = dataclasses.replace(with_joints, point_damage=1.0 * (snapshot.point_number == 1))
    assert joint_states(broken)["c"]["cracked"] == pytest.approx(2.0 / 3.0, rel=1e-12)


def test_a_joint_of_a_solid_has_the_slip_of_its_ends(slid):
    """The upper half moves down by u along the dip: slip u / sin(dip), less what is elastic."""
    found = Result.read(slid).joint_states["fault"]
    assert found["area"] == pytest.approx(SIDE**2 / math.cos(math.radians(DIP)), rel=1e-9)
    assert found["cracked"] == found["damage"] == 1.0
    strain = Result.read(slid).curve["axial_strain"][-1]
    slip = strain * HEIGHT / math.sin(math.radians(DIP))
    assert 0.9 * slip < found["slip"] < slip
    assert found["slip"] <= found["largest_slip"] < 1.05 * found["slip"]
    assert found["opening"] <= found["largest_opening"] < 0.0


def test_a_joint_of_the_plane_slides_as_far(slid_plane):
    found = Result.read(slid_plane).joint_states["fault"]
    cut = Result.read(slid_plane).joint_cuts["fault"]["cut"]
    assert cut == pytest.approx(SIDE / math.cos(math.radians(DIP)), rel=1e-6)
    assert found["length"] == pytest.approx(cut, rel=1e-9)  # bonded, though faces have slid off
    assert found["cracked"] == 1.0
    strain = Result.read(slid_plane).curve["axial_strain"][-1]
    assert found["slip"] == pytest.approx(strain * HEIGHT / math.sin(math.radians(DIP)), rel=0.1)
    assert found["largest_opening"] >= found["opening"]


@pytest.mark.parametrize("name", ["slid", "slid_plane"])
def test_files_tell_the_joint_of_each_contact(name, request):
    folder = request.getfixturevalue(name)
    grid, _, cells = read_vtu(folder / "final.vtu")
    contacts = cells["kind"] == 1
    assert np.all(cells["joint"][~contacts] == -1)
    assert set(cells["joint"][contacts].tolist()) <= {-1, 0}
    state = read_state(folder / "final.vtu")
    assert np.array_equal(state.contact_joint, cells["joint"][contacts])
    named = dataclasses.replace(state, joint_names=("fault",))
    found, expected = joint_states(named)["fault"], Result.read(folder).joint_states["fault"]
    size = named.contact_size_name  # a file of the plane has the length that is still opposite
    assert found[size] == pytest.approx(expected[size], rel=1e-9 if size == "area" else 0.05)
    assert found["damage"] == pytest.approx(expected["damage"], rel=1e-9)
    joints = grid.GetFieldData().GetAbstractArray("joints")
    assert joints.GetValue(0) == "fault"


def test_files_without_joints_have_no_such_array(tmp_path):
    made = flexpm.Specimen.box(0.008, 0.008, 0.008), flexpm.Specimen.rectangle(0.012, 0.012, 0.01)
    for specimen in made:
        write_vtu(tmp_path / "state.vtu", fresh(specimen).snapshot())
        assert "joint" not in read_vtu(tmp_path / "state.vtu")[2]
        assert read_state(tmp_path / "state.vtu").contact_joint is None


@pytest.mark.parametrize(("name", "title"), [("slid", "area [mm2]"), ("slid_plane", "length [mm]")])
def test_a_page_has_a_table_of_joints(name, title, request):
    folder = request.getfixturevalue(name)
    result = Result.read(folder)
    table = page_run._joints_table(result)
    assert table.header[:2] == ("joint", title)
    ((joint, _, cracked, damage, slip, *_),) = table.rows
    assert (joint, cracked, damage) == ("fault", "100.0", "1.000")
    assert float(slip) == pytest.approx(1e6 * result.joint_states["fault"]["slip"], rel=1e-3)
    text = (folder / "report.html").read_text()
    assert "<h2>Joints at the end</h2>" in text
    assert '<span class="key" style="border-color: #009e73">joint fault</span>' in text
    # a joint without strength is no notch
    assert 'class="notch"' not in text
    assert page_run._joints_table(dataclasses.replace(result, joint_states=None)) is None


def test_every_measure_is_in_the_table_and_the_file(slid):
    states = json.loads((slid / "result.json").read_text())["joint_states"]["fault"]
    assert [*states] == ["area", *MEASURES]
    assert len(page_run._joints_table(Result.read(slid)).header) == 2 + len(MEASURES)


@pytest.mark.parametrize("name", ["slid", "slid_plane"])
def test_states_of_joints_fit_the_schema(name, request):
    content = json.loads((request.getfixturevalue(name) / "result.json").read_text())
    validator = result_schema_file.validator()
    assert [one.message for one in validator.iter_errors(content)] == []
    content["joint_states"]["fault"]["slip"] = "far"
    assert any("joint_states" in one.path for one in validator.iter_errors(content))


def test_a_view_has_the_colours_of_joints(crossing, slid):
    state, _ = crossing
    colours = page_solid._joint_colours(state)
    assert colours.tolist() == np.where(state.contact_joint < 0, 255, state.contact_joint).tolist()
    assert {0, 1, 255} == set(colours.tolist())
    view = page_run.run_map(slid, Result.read(slid), "map", "", None, turns=True).view
    assert [*map(tuple, view.joints)] == [("fault", joint_colours.joint_colour(0))]


@pytest.fixture(scope="module")
def browser() -> Iterator[object]:
    """A browser that draws WebGL by its processor."""
    yield from opened("--use-angle=swiftshader", "--enable-unsafe-swiftshader")


def test_joints_alone_have_their_colour_in_the_view(browser, slid):
    shown(browser, slid / "report.html")
    wait_for(lambda: browser.execute_script("return Boolean(views['map-solid'])"), each=0.1)
    green = """
        const all = views['map-solid'].renderer.getContext(), size = all.drawingBufferWidth;
        const pixels = new Uint8Array(4 * size * size);
        all.readPixels(0, 0, size, size, all.RGBA, all.UNSIGNED_BYTE, pixels);
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4)
            if (pixels[i + 1] > 1.3 * pixels[i] && pixels[i + 1] > 1.05 * pixels[i + 2]) count++;
        return count / size / size;
    """
    lines = browser.execute_script(green)
    slide(browser, "map-solid-colour", "joint")
    slide(browser, "map-solid-show", "joints")
    faces = browser.execute_script(green)
    assert 0.0 < lines < 0.01 < faces
    assert browser.get_log("browser") == []
