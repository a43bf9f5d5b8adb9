# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of solids, from the packing to the files: numbers, same bits, restart, repetition."""

import csv
import json

import numpy as np
import pytest
from refusals import refusal
from scenes import fresh
from stopped_runs import same

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.models.solids import solver_of
from flexpm.results.result import Result
from flexpm.results.vtu import read_state

#: A few dozen grains: a test takes some seconds.
SIZES = {"diameter": 0.01, "height": 0.016}
BOX = {"width": 0.009, "depth": 0.009, "height": 0.014}
#: Breaks soon; the start of a test is the same.
FAST = {"rate": 4.0}


@pytest.fixture(scope="module")
def core():
    return Specimen.cylinder(**SIZES, seed=1)


@pytest.fixture(scope="module")
def broken(core, tmp_path_factory):
    folder = tmp_path_factory.mktemp("core")
    return flexpm.run("uniaxial", core, out=folder, frames=4, **FAST), folder


@pytest.mark.long
def test_a_cylinder_breaks_and_its_energies_sum(core, broken):
    result, _ = broken
    assert result.peak_stress > 50e6
    assert result.energy_error < 0.01
    assert result.tensile_cracks > 20
    stress = result.curve["axial_stress"]
    assert stress[-1] <= 0.5 * stress.max()
    assert result.fragments >= 1
    assert result.tetrahedra == core.statistics()["tetrahedra"]
    # the load is along z, on the area of the prism
    heights = np.array([one.z for one in result.cracks])
    assert 0.0 <= heights.min() < heights.max() <= 0.0161
    counted = sum(one.mode == 1 for one in result.cracks)
    assert counted == result.tensile_cracks


@pytest.mark.long
def test_the_elastic_part_is_that_of_the_static_solve(core):
    solved = flexpm.elastic(core, "augig-table7")
    result = flexpm.run("uniaxial", core, "augig-table7", max_strain=2e-4)
    tested, start = result.curve, result.start_moduli
    assert start[0] == pytest.approx(solved["youngs_modulus"], rel=0.002)
    _, waist = solver_of(core, flexpm.materials.load("augig-table7"), "flexible").elasticConstants()
    assert start[1] == pytest.approx(waist, rel=2e-3)
    modulus = tested["axial_stress"][-1] / tested["axial_strain"][-1]
    assert modulus == pytest.approx(solved["youngs_modulus"], rel=0.002)
    ratio = tested["lateral_strain"][-1] / tested["axial_strain"][-1]
    assert ratio == pytest.approx(waist, rel=0.01)
    assert waist == pytest.approx(solved["poissons_ratio"], rel=0.02)  # over the whole height


@pytest.mark.long
def test_a_rigid_solid_has_the_constants_of_its_static_solve(core):
    solved = flexpm.elastic(core, model="rigid")
    tested = flexpm.run("uniaxial", core, model="rigid", max_strain=2e-4).curve
    modulus = tested["axial_stress"][-1] / tested["axial_strain"][-1]
    assert modulus == pytest.approx(solved["youngs_modulus"], rel=0.005)
    ratio = tested["lateral_strain"][-1] / tested["axial_strain"][-1]
    assert ratio == pytest.approx(solved["poissons_ratio"], rel=0.03)


@pytest.mark.long
def test_the_command_solves_a_solid_and_repeats_it(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sizes = [f"--{name}={value}" for name, value in BOX.items()]
    for model in ("flexible", "rigid"):
        asked = ["elastic", "--shape", "box", *sizes, "--model", model, "--quiet"]
        assert cli.main([*asked, "--out", model]) == 0
        found = json.loads((tmp_path / model / "result.json").read_text())
        made = Specimen.box(**BOX)
        assert found["youngs_modulus"] == flexpm.elastic(made, model=model)["youngs_modulus"]
        assert found["inputs"]["specimen"]["kind"] == "box"
        capsys.readouterr()
        assert cli.main(["rerun", model, "--quiet", "--out", f"{model}-again"]) == 0
        assert "the same as in" in capsys.readouterr().out
    assert cli.main(["elastic", "--shape", "solid-disc", "--quiet"]) == 2
    assert "known are box, cylinder" in capsys.readouterr().err


@pytest.mark.long
def test_the_folder_has_what_a_run_leaves(core, broken):
    result, folder = broken
    names = {one.name for one in folder.iterdir()}
    assert {"result.json", "curve.csv", "cracks.csv", "events.csv", "fragments.csv"} <= names
    assert {"specimen.vtu", "final.vtu", "frames.pvd", "report.html", "outside.png"} <= names
    assert (folder / "outside.png").stat().st_size > 10_000
    read = Result.read(folder)
    assert read.cracks == result.cracks
    assert read.emission == result.emission
    assert same(read, result)
    assert read.tetrahedra == result.tetrahedra
    found = read_state(folder / "final.vtu")
    assert len(found.tetrahedra) == result.tetrahedra
    assert np.count_nonzero(found.crack_step >= 0) == len(result.cracks)
    inputs = json.loads((folder / "result.json").read_text())["inputs"]
    assert inputs["specimen"]["kind"] == "cylinder"
    assert "no map" not in (folder / "report.html").read_text()


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("test", ["uniaxial", "tension"])
def test_boxes_and_both_models_break(test, model):
    box = Specimen.box(**BOX, seed=2)
    result = flexpm.run(test, box, model=model, rate=4.0)
    assert result.peak_stress > 0.0
    assert result.status in ("ok", "not_quasistatic")
    assert result.energy_error < 0.02
    assert result.tensile_cracks + result.shear_cracks > 0


@pytest.mark.long
def test_studies_and_comparisons_take_solids(tmp_path):
    box = Specimen.box(**BOX, seed=2)
    found = flexpm.compare("tension", box, ("flexible", "rigid"), max_strain=2e-4)
    assert [(one.model, one.grains) for one in found.results] == [
        (model, box.cells.cells) for model in ("flexible", "rigid")
    ]
    sizes = "\n".join(f"{name} = {value}" for name, value in BOX.items())
    (tmp_path / "solids.toml").write_text(
        f'[common]\ntest = "tension"\nshape = "box"\nmax_strain = 2e-4\n{sizes}\n'
        "[grid]\nseed = [2]\n"
    )
    out = tmp_path / "out"
    assert cli.main(["study", str(tmp_path / "solids.toml"), "--out", str(out), "--quiet"]) in (
        0,
        3,
    )
    (row,) = csv.DictReader((out / "table.csv").open(encoding="utf-8"))
    assert int(row["grains"]) == box.cells.cells
    assert float(row["depth"]) == BOX["depth"]


@pytest.mark.long
def test_a_saved_solid_is_tested(core, tmp_path):
    core.save(tmp_path / "core.json")
    asked = ["run", "uniaxial", "--specimen", str(tmp_path / "core.json"), "--max-strain", "4e-4"]
    out = tmp_path / "out"
    assert cli.main([*asked, "--quiet", "--out", str(out), "--no-report"]) in (0, 3)
    assert Result.read(out).grains == core.cells.cells


def test_a_layer_of_prisms_between_planes_is_the_plane_in_plane_strain():
    rock = flexpm.materials.load("augig-table7").with_set(plane="strain")
    plane = Specimen.rectangle(0.009, 0.012, 2e-3, short_edge=0.0)
    x, y = plane.centres.T
    rows = np.column_stack((x, np.full(len(x), 1e-3), y, plane.radii))
    layer = Specimen.from_spheres(rows, width=0.009, depth=2e-3, height=0.012, short_edge=0.0)
    built = fresh(layer, rock)
    for side in (4, 5):
        built.solver.holdSide(side, y=True)
    rig = flexpm.rig(built)
    rig.load(flexpm.Loading(kind="waiting", max_strain=2e-4))
    assert built.solver.counts()["contacts"] == plane.statistics()["contacts"]
    expected = flexpm.elastic(plane, rock, mesh="fan")
    assert rig.stress / rig.strain == pytest.approx(expected["youngs_modulus"], rel=2e-3)
    # at the waist, the plane's over the whole height
    lateral = 2.0 * rig.record["lateral_strain"][-1] / rig.strain
    assert lateral == pytest.approx(expected["poissons_ratio"], rel=0.03)


def test_a_rigid_grain_alone_has_a_mass_and_no_strain_between_its_own_ends():
    alone = Specimen.from_spheres([[0.0, 0.0, 0.005, 0.005]], diameter=0.01, height=0.01)
    built = fresh(alone, model="rigid")
    built.run(20)
    assert np.all(np.isfinite(built.snapshot().positions))
    with pytest.raises(InputError, match="height between strain gauges = 0 m, must be > 0"):
        flexpm.run("uniaxial", alone, model="rigid", max_strain=1e-3)


def test_what_is_of_the_plane_is_refused_for_a_solid_and_pictures_show_its_section(core):
    built = fresh(core)
    refusal("run: specimen = cylinder, must be a .* for bending", flexpm.run, "bending", core)
    with pytest.raises(InputError, match="must be one number; give second_confinement"):
        flexpm.run("triaxial", core, confinement=(1e6, 3e6))
    for draw in (flexpm.plot.cracks, flexpm.plot.fragments, flexpm.plot.stress):
        assert draw(built.snapshot()).axes
