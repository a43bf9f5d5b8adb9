# SPDX-License-Identifier: GPL-3.0-or-later
"""The state for ParaView of a solid: what it names is there, and VTK makes its pieces."""

from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
from solid_state import sample
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCutter, vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkClipDataSet
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from flexpm import Specimen
from flexpm.report import paraview
from flexpm.results.vtu import read_state, write_vtu

STEPS = (5, 9)


@pytest.fixture(scope="module")
def core():
    return Specimen.cylinder(0.01, 0.016, seed=1)


@pytest.fixture(scope="module")
def folder(core, tmp_path_factory):
    """Two frames and the state that shows them; the second bears more."""
    made = tmp_path_factory.mktemp("run")
    (made / "frames").mkdir()
    frames = []
    for step in STEPS:
        state = sample(core, strain=-1e-3 * step, cracked=0.3)
        state.tetrahedron_stress[:] *= -float(step)
        frames.append((made / "frames" / f"frame-{step:010d}.vtu", step, 1e6 * step))
        write_vtu(frames[-1][0], state)
    with pytest.MonkeyPatch.context() as patch:
        for words in ("test_text", "size_text"):
            patch.setattr(paraview, words, lambda result: "a core")
        paraview.write_state(made / "frames.pvsm", SimpleNamespace(test="uniaxial"), frames)
    return made


@pytest.fixture(scope="module")
def objects(folder):
    """Values of the properties of all objects of the state, by type."""
    found = {}
    for proxy in ElementTree.parse(folder / "frames.pvsm").getroot().iter("Proxy"):
        if proxy.get("type"):
            values = {
                one.get("name"): [value.get("value") for value in one]
                for one in proxy.iter("Property")
            }
            found.setdefault(proxy.get("type"), []).append({"id": proxy.get("id"), **values})
    return found


def numbers(values):
    return np.array([float(one) for one in values])


def piece(grid, name, low, high):
    """Cells of a grid with an array between two values, as ParaView's Threshold has them."""
    part = vtkThreshold()
    part.SetInputData(grid)
    part.SetInputArrayToProcess(0, 0, 0, 1, name)
    part.SetLowerThreshold(low)
    part.SetUpperThreshold(high)
    part.Update()
    return part.GetOutput()


@pytest.fixture(scope="module")
def last(folder):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "frames" / f"frame-{STEPS[-1]:010d}.vtu"))
    reader.Update()
    return reader.GetOutput()


@pytest.fixture(scope="module")
def plane(objects):
    """The plane of the state, as VTK's."""
    (one, other) = objects["Plane"]
    assert one["Origin"] == other["Origin"] and one["Normal"] == other["Normal"]
    made = vtkPlane()
    made.SetOrigin(numbers(one["Origin"]))
    made.SetNormal(numbers(one["Normal"]))
    return made


def test_the_state_cuts_grains_and_cracks_and_looks_at_the_section(core, objects):
    everything = {one["id"] for group in objects.values() for one in group}
    for kind in ("Clip", "Cut"):
        (cut,) = objects[kind]
        assert {cut["Input"][0], cut[f"{kind}Function"][0]} <= everything
    (view,) = objects["RenderView"]
    camera, focus = numbers(view["CameraPosition"]), numbers(view["CameraFocalPoint"])
    corners = core.cells.vertices
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    assert focus == pytest.approx(middle, abs=1e-12)
    assert np.linalg.norm(camera - focus) > 0.016 and camera[1] < focus[1]
    assert numbers(view["CameraViewUp"]).tolist() == [0.0, 0.0, 1.0]
    assert view["ViewTime"] == [str(STEPS[-1])]
    shown = [one["ColorArrayName"][-1] for one in objects["UnstructuredGridRepresentation"]]
    assert shown == ["principal_stress_3", "crack_mode"]
    (colours, _) = objects["PVLookupTable"]
    # the sample's stress, -z 1e9 Pa/m times the step
    assert numbers(colours["RGBPoints"])[[0, -4]] == pytest.approx((-9e9 * 0.0155, 0.0), rel=0.05)


def test_the_pieces_are_the_back_of_the_grains_and_lines_of_cracks(core, last, plane):
    grains = piece(last, "kind", 0, 0)
    assert grains.GetNumberOfCells() == core.statistics()["tetrahedra"]
    clip = vtkClipDataSet()
    clip.SetInputData(grains)
    clip.SetClipFunction(plane)
    clip.InsideOutOn()
    clip.Update()
    low, high = np.array(clip.GetOutput().GetBounds()).reshape(3, 2).T
    assert low[1] == pytest.approx(plane.GetOrigin()[1], abs=1e-9)
    assert high[1] == pytest.approx(grains.GetBounds()[3], abs=1e-9)
    cracks = piece(last, "crack_mode", 1, 2)
    assert 0.2 < cracks.GetNumberOfCells() / core.statistics()["contacts"] < 0.4
    cut = vtkCutter()
    cut.SetInputData(cracks)
    cut.SetCutFunction(plane)
    cut.Update()
    assert cut.GetOutput().GetNumberOfLines() > 3
    modes = vtk_to_numpy(cut.GetOutput().GetCellData().GetArray("crack_mode"))
    assert set(modes) <= {1, 2}


def test_principal_stresses_are_those_of_the_tensor(folder):
    state = read_state(folder / "frames" / f"frame-{STEPS[0]:010d}.vtu")
    state.tetrahedron_stress[0] = (1.0, 2.0, 3.0, 0.0, 0.0, 0.5)
    mean, half = 1.5, np.hypot(0.5, 0.5)
    assert state.principal_stresses[0] == pytest.approx((mean - half, mean + half, 3.0))
    state.tetrahedron_stress[1, 2] = np.nan
    assert np.isnan(state.principal_stresses).all()
