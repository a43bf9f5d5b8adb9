# SPDX-License-Identifier: GPL-3.0-or-later
"""The .vtu file, read back by VTK's own reader, holds the values of the snapshot."""

import dataclasses
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal
from sample_snapshot import GRADIENT, STRESS, read_vtu, wall
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_TRIANGLE

from flexpm.results.vtu import CONTACT, GRAIN, principal_stresses, write_vtu
from flexpm.results.vtu import read_vtu as state_of


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    snapshot = wall()
    path = tmp_path_factory.mktemp("vtu") / "final.vtu"
    write_vtu(path, snapshot)
    assert [file.name for file in path.parent.iterdir()] == ["final.vtu"]
    return snapshot, *read_vtu(path)


def test_geometry_is_the_deformed_specimen(written):
    snapshot, grid, _, cells = written
    points = vtk_to_numpy(grid.GetPoints().GetData())
    nodes, triangles = len(snapshot.positions), len(snapshot.triangles)
    contacts = len(snapshot.contact_grains)
    assert np.array_equal(points[:nodes, :2], snapshot.positions)
    assert np.array_equal(points[nodes:, :2].reshape(-1, 2, 2), snapshot.contact_ends)
    assert np.all(points[:, 2] == 0.0)
    types = [grid.GetCellType(cell) for cell in range(grid.GetNumberOfCells())]
    assert types == [VTK_TRIANGLE] * triangles + [VTK_LINE] * contacts
    assert np.array_equal(cells["kind"], np.repeat([GRAIN, CONTACT], [triangles, contacts]))
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    assert np.array_equal(connectivity[: 3 * triangles].reshape(-1, 3), snapshot.triangles)
    assert np.array_equal(connectivity[3 * triangles :], nodes + np.arange(2 * contacts))


def test_displacement_follows_the_gradient_at_nodes_and_contact_ends(written):
    _, grid, points, _ = written
    places = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
    reference = places @ np.linalg.inv(np.eye(2) + GRADIENT).T
    assert points["displacement"].shape == (len(places), 3)
    assert np.allclose(points["displacement"][:, :2], reference @ GRADIENT.T, rtol=0, atol=1e-15)
    assert np.all(points["velocity"] == [0.0, -1e-8, 0.0])


def test_stress_of_the_grains(written):
    snapshot, _, _, cells = written
    triangles = len(snapshot.triangles)
    xx, yy, xy = STRESS
    assert np.all(cells["stress"][:triangles] == [xx, yy, 0.0, xy, 0.0, 0.0])
    assert np.all(np.isnan(cells["stress"][triangles:]))
    eigenvalues = np.linalg.eigvalsh([[xx, xy], [xy, yy]])
    assert np.allclose(cells["principal_stress_1"][:triangles], eigenvalues[1], rtol=1e-14)
    assert np.allclose(cells["principal_stress_2"][:triangles], eigenvalues[0], rtol=1e-14)
    assert np.array_equal(cells["grain"][:triangles], snapshot.triangle_grain)
    assert np.all(cells["grain"][triangles:] == -1)


def test_contacts(written):
    snapshot, grid, _, cells = written
    triangles = len(snapshot.triangles)
    cells = {name: values[triangles:] for name, values in cells.items()}
    number = np.arange(len(snapshot.contact_grains))
    grains = np.stack([cells["grain_a"], cells["grain_b"]], axis=1)
    assert np.array_equal(grains, snapshot.contact_grains)
    assert np.array_equal(cells["contact"], snapshot.contact)
    # only the first point carries something, and it stands for a sixth of the contact
    assert np.allclose(cells["damage"], number / len(number) / 6, rtol=1e-14)
    assert np.allclose(cells["normal_traction"], 1e3 * number / 6, rtol=1e-14)
    assert np.allclose(cells["shear_traction"], -1e3 * number / 6, rtol=1e-14)
    assert np.allclose(cells["opening"], 1e-9 * number, rtol=1e-14)
    assert np.allclose(cells["slip"], -1e-9 * number, rtol=1e-14)
    assert np.array_equal(cells["cracked_points"], number % 2)
    assert np.array_equal(cells["crack_mode"], np.where(number % 2, 1 + number // 2 % 2, 0))
    for name in ("opening", "slip", "damage"):
        assert np.array_equal(cells[f"point_{name}"].ravel(), getattr(snapshot, f"point_{name}"))
    assert np.array_equal(cells["point_normal_traction"].ravel(), snapshot.point_traction[:, 0])
    assert np.array_equal(cells["point_crack_step"].ravel(), snapshot.crack_step)
    assert np.array_equal(cells["point_crack_mode"].ravel(), snapshot.crack_mode)
    array = grid.GetCellData().GetArray("point_damage")
    assert array.GetComponentName(2) == "point 2"


@pytest.mark.parametrize("points", [1, 2, 3])
def test_any_number_of_points(tmp_path, points):
    snapshot = wall(points=points)
    write_vtu(tmp_path / "a.vtu", snapshot)
    _, _, cells = read_vtu(tmp_path / "a.vtu")
    assert cells["point_opening"].reshape(len(cells["kind"]), -1).shape[1] == points


def test_a_specimen_without_contacts(tmp_path):
    write_vtu(tmp_path / "a.vtu", wall(columns=1, rows=1))
    grid, _, cells = read_vtu(tmp_path / "a.vtu")
    assert grid.GetNumberOfCells() == 4
    assert np.all(cells["kind"] == GRAIN)


def test_plane_strain_carries_its_out_of_plane_stress(tmp_path):
    snapshot = wall()
    normal = 0.23 * snapshot.triangle_stress[:, :2].sum(axis=1)
    snapshot = dataclasses.replace(snapshot, triangle_stress_zz=normal)
    write_vtu(tmp_path / "a.vtu", snapshot)
    _, _, cells = read_vtu(tmp_path / "a.vtu")
    triangles = len(snapshot.triangles)
    assert np.array_equal(cells["stress"][:triangles, 2], snapshot.triangle_stress_zz)


@given(stress=st.tuples(*3 * [st.floats(-1e9, 1e9)]))
def test_principal_stresses_are_the_eigenvalues(stress):
    xx, yy, xy = stress
    largest, smallest = principal_stresses(np.array([stress]))
    expected = np.linalg.eigvalsh([[xx, xy], [xy, yy]])
    scale = max(map(abs, stress))
    # the second term: below 1e-300 Pa there are no digits left to compare
    assert np.allclose([smallest[0], largest[0]], expected, rtol=0, atol=1e-14 * scale + 1e-300)


def test_what_is_no_snapshot_is_refused_in_one_line(tmp_path):
    for path, state in ((wall(), tmp_path / "it.vtu"), (tmp_path / "it.vtu", {"positions": []})):
        refusal("snapshot = .*, must be a snapshot", write_vtu, path, state)
    assert not list(tmp_path.iterdir())


def test_a_failed_write_leaves_the_old_file(tmp_path):
    path = tmp_path / "final.vtu"
    path.write_text("old")
    with pytest.raises(IndexError):
        write_vtu(path, dataclasses.replace(wall(), velocities=np.empty((1, 2))))
    assert path.read_text() == "old"


def test_a_file_is_xml_throughout(tmp_path):
    """Raw data in it would keep ParaView of an up-to-date Debian 12 from reading it."""
    write_vtu(tmp_path / "it.vtu", wall(), {"test": "tension <&>", "seed": 1, "none": None})
    root = ElementTree.parse(tmp_path / "it.vtu").getroot()
    assert root.get("type") == "UnstructuredGrid"
    assert root.find("AppendedData") is None
    names = [one.get("Name") for one in root.findall("UnstructuredGrid/FieldData/*")]
    assert names == ["test", "seed"]


def test_means_of_stress_are_weighted_by_the_triangles_areas(tmp_path):
    """A grain whose lower triangle is alone in carrying stress, and has half of its area."""
    snapshot = wall(columns=1, rows=2)
    stress = np.zeros((8, 3))
    stress[0] = STRESS  # the lower of the four triangles of the first grain
    reference = snapshot.reference.copy()
    reference[4] = [1e-3, 3e-3]  # its centre lies on its upper edge: the areas are 2, 1, 0 and 1
    changed = dataclasses.replace(snapshot, triangle_stress=stress, reference=reference)
    write_vtu(tmp_path / "it.vtu", changed)
    _, points, cells = read_vtu(tmp_path / "it.vtu")
    tensor = np.array([STRESS[0], STRESS[1], 0.0, STRESS[2], 0.0, 0.0])
    assert np.allclose(cells["grain_stress"][:4], 0.5 * tensor, rtol=1e-12)
    assert np.all(cells["grain_stress"][4:8] == 0.0)
    nodal = points["nodal_stress"]
    assert np.allclose(nodal[0], 2.0 / 3.0 * tensor, rtol=1e-12)  # beside one of area 1
    assert np.allclose(nodal[4], 0.5 * tensor, rtol=1e-12)
    assert np.all(nodal[2:4] == 0.0)


def test_a_state_is_read_back_as_it_was(tmp_path):
    snapshot = wall()
    write_vtu(tmp_path / "it.vtu", snapshot)
    read = state_of(tmp_path / "it.vtu")
    for field in dataclasses.fields(snapshot):
        before, after = (getattr(one, field.name) for one in (snapshot, read))
        if before is not None and field.name not in ("crack_position", "stress_source"):
            assert np.allclose(after, before, rtol=0.0, atol=1e-15), field.name
    assert np.array_equal(read.fragments.labels, snapshot.fragments.labels)


@pytest.mark.parametrize("content", [None, "no grid", "<VTKFile/>"])
def test_what_is_no_state_is_refused_in_one_line(tmp_path, content):
    path = tmp_path / "it.vtu"
    if content is not None:
        path.write_text(content)
    refusal(r"it\.vtu", state_of, path)
