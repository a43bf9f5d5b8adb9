# SPDX-License-Identifier: GPL-3.0-or-later
"""States of solids: the plane through them, what hangs together, files and tables with z."""

import dataclasses

import numpy as np
import pytest
import yade
from solid_state import sample
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import VTK_VERTEX
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import flexpm
from flexpm import Specimen
from flexpm.results.arrays import vtu_arrays
from flexpm.results.cracks import cracks_csv, cracks_from_snapshot, read_cracks
from flexpm.results.emission import EventRule, events_csv, find_events, read_events
from flexpm.results.record import Curve
from flexpm.results.snapshot import triangle_areas
from flexpm.results.solids import state as solid_state_module
from flexpm.results.solids.pairs import PressingPairs
from flexpm.results.vtu import read_state, read_vtu, write_vtu


@pytest.fixture(scope="module")
def box():
    return Specimen.box(0.012, 0.013, 0.018, seed=2)


def test_a_section_has_the_area_of_the_plane_and_the_stresses_there(box):
    section = sample(box).section
    areas = triangle_areas(section)
    assert areas.min() >= 0.0
    assert areas.sum() == pytest.approx(0.012 * 0.018, rel=1e-9)
    # the stress of the sample grows with z: its mean is that at half the height
    mean = np.sum(areas * section.triangle_stress[:, 1]) / areas.sum()
    assert mean == pytest.approx(0.009 * 1e9, rel=0.02)
    assert not section.triangle_stress[:, [0, 2]].any()


def test_a_section_cuts_contacts_where_the_grains_meet(box):
    state = sample(box)
    section = state.section
    assert 50 < len(section.contact) < len(state.contact)
    # both ends of a cut lie on the section, within the box
    assert section.contact_ends.min() > -1e-12
    assert section.contact_ends[..., 0].max() < 0.012 + 1e-12
    assert section.contact_ends[..., 1].max() < 0.018 + 1e-12
    shares = np.bincount(section.point_contact, section.point_share)
    assert shares == pytest.approx(np.ones(len(section.contact)))
    # each cut contact has all of its points
    assert np.array_equal(
        np.bincount(section.point_contact), np.diff(state.point_offsets)[section.contact]
    )


def test_fragments_are_measured_by_volume(box):
    whole = sample(box).fragments
    assert len(whole) == 1
    assert whole.areas[0] == pytest.approx(0.012 * 0.013 * 0.018)
    apart = sample(box, cracked=1.1)
    assert len(apart.fragments) == box.cells.cells
    assert whole.csv("volume").startswith("fragment,grains,volume\n")


def test_parting_is_that_of_the_centres(box):
    assert sample(box).parting == 0.0
    state = sample(box, strain=0.01)
    first, second = state.contact_grains.T
    before = state.reference[state.node_offsets[1:] - 1]
    longest = np.abs(before[second, 2] - before[first, 2]).max()
    assert 0.0 < state.parting <= 0.01 * longest * (1.0 + 1e-9)


def test_a_file_of_a_state_reads_back(box, tmp_path):
    state = sample(box, strain=-0.01, scatter=1e-5, cracked=0.3)
    write_vtu(tmp_path / "a.vtu", state, {"seed": 2})
    found = read_state(tmp_path / "a.vtu")
    assert np.array_equal(found.positions, state.positions)
    assert found.reference == pytest.approx(state.reference, abs=1e-15)
    assert np.array_equal(found.tetrahedra, state.tetrahedra)
    assert np.array_equal(found.contact_grains, state.contact_grains)
    assert np.array_equal(found.tetrahedron_stress, state.tetrahedron_stress)
    assert found.volumes == pytest.approx(state.volumes)
    cracked = np.add.reduceat(state.crack_step >= 0, state.point_offsets[:-1])
    assert np.array_equal(np.add.reduceat(found.crack_step >= 0, found.point_offsets[:-1]), cracked)
    # what reads files of the plane sees the section
    plane = read_vtu(tmp_path / "a.vtu")
    assert triangle_areas(plane).sum() == pytest.approx(0.012 * 0.018, rel=1e-9)


def drawn_pairs(state, count=7):
    """Pairs with drawn values, between the centres of grains without a common face."""
    draw = np.random.default_rng(3)
    grains = np.column_stack((np.arange(count), 30 + np.arange(count)))
    rows = [draw.random(count) for _ in range(5)]
    return PressingPairs(
        grains, state.centres[grains].mean(axis=1), draw.normal(size=(count, 3)), *rows
    )


def test_pairs_are_points_of_the_file_and_read_back(box, tmp_path):
    state = sample(box, strain=-0.01, cracked=0.3)
    plain = dataclasses.replace(state)
    state = dataclasses.replace(state, pairs=drawn_pairs(state))
    write_vtu(tmp_path / "a.vtu", state)
    write_vtu(tmp_path / "plain.vtu", plain)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "a.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    kinds = vtk_to_numpy(grid.GetCellData().GetArray("kind"))
    assert np.bincount(kinds).tolist() == [len(state.tetrahedra), len(state.contact), 7]
    assert {grid.GetCellType(len(kinds) - 1 - k) for k in range(7)} == {VTK_VERTEX}
    force = grid.GetCellData().GetArray("pair_force")
    assert np.array_equal(vtk_to_numpy(force)[-7:], state.pairs.force)
    assert force.GetInformation().Get(vtkDataArray.UNITS_LABEL()) == "N"
    # the points move with both grains
    moved = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))[-7:]
    assert moved[:, 2] == pytest.approx(-0.01 * state.pairs.position[:, 2] / 0.99)
    found, without = read_state(tmp_path / "a.vtu"), read_state(tmp_path / "plain.vtu")
    for name in (one.name for one in dataclasses.fields(PressingPairs)):
        assert np.array_equal(getattr(found.pairs, name), getattr(state.pairs, name))
    assert len(without.pairs) == 0
    for name in ("positions", "corners", "corner_offsets", "areas", "volumes", "crack_step"):
        assert np.array_equal(getattr(found, name), getattr(without, name))


def test_a_file_is_written_in_turn_as_vtk_writes_it_at_once(box, tmp_path):
    """Array by array, to the byte: of numbers that are none, texts, and arrays without a unit."""
    state = sample(box, strain=0.01)
    draw = np.random.default_rng(2)
    state = dataclasses.replace(
        state,
        velocities=draw.normal(size=state.velocities.shape),
        tetrahedron_stress=draw.normal(size=state.tetrahedron_stress.shape),
        grain_mineral=np.arange(len(state.volumes)) % 3,
        pairs=drawn_pairs(state),
    )
    about = {"test": "uniaxial", "seed": 3, "confinement": 0.0, "none": None}
    for told in (about, {}):
        write_vtu(tmp_path / "in_turn.vtu", state, told)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(tmp_path / "in_turn.vtu"))
        reader.Update()
        assert (
            reader.GetOutput().GetNumberOfCells() == len(state.tetrahedra) + len(state.contact) + 7
        )
        vtu_arrays.write_grid(tmp_path / "at_once.vtu", reader.GetOutput())
        assert (tmp_path / "in_turn.vtu").read_bytes() == (tmp_path / "at_once.vtu").read_bytes()


def test_arrays_of_a_state_stay_when_its_solver_has_gone(box):
    built = flexpm.build(box)
    first, second = built.snapshot(), built.snapshot()
    kept = first.positions.copy()
    del built
    yade.O.reset()
    second.positions[:] = 0.0
    assert np.array_equal(first.positions, kept)
    assert first.positions.flags.writeable
    assert first.crack_step.dtype == np.int64


def test_principal_stresses_do_not_depend_on_how_many_are_taken_at_once(box, monkeypatch):
    state = sample(box, strain=0.01)
    state.tetrahedron_stress[:] = np.random.default_rng(2).normal(
        size=state.tetrahedron_stress.shape
    )
    whole = state.principal_stresses
    monkeypatch.setattr(solid_state_module, "_AT_ONCE", 7)
    assert np.array_equal(state.principal_stresses, whole)
    state.tetrahedron_stress[3, 2] = np.nan
    assert np.all(np.isnan(state.principal_stresses))


def test_tables_have_z_and_read_back(box, tmp_path):
    cracks = cracks_from_snapshot(sample(box, cracked=0.2), Curve())
    cracks = [one._replace(strain=0.01) for one in cracks]
    (tmp_path / "cracks.csv").write_text(cracks_csv(cracks))
    assert cracks_csv(cracks).startswith("step,strain,x,y,z,mode,contact,point,energy\n")
    assert read_cracks(tmp_path / "cracks.csv") == cracks
    events = find_events(cracks, EventRule(1e-3, 5.0))
    (tmp_path / "events.csv").write_text(events_csv(events))
    assert events_csv(events).startswith("step,strain,x,y,z,points,mode,energy,magnitude\n")
    assert read_events(tmp_path / "events.csv") == events
    # their centres are weighted by energy, which is alike here
    heights = np.array([one.z for one in cracks])
    weighted = sum(one.points * one.z for one in events) / len(cracks)
    assert weighted == pytest.approx(heights.mean())


def test_tables_of_the_plane_have_none():
    from flexpm.results.cracks import Crack

    text = cracks_csv([Crack(1, 0.1, 0.2, 0.3, 1, 4, 0, 1e-6)])
    assert text.splitlines()[0] == "step,strain,x,y,mode,contact,point,energy"
