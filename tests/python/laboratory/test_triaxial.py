# SPDX-License-Identifier: GPL-3.0-or-later
"""Compression of solids under pressures: their start, strength, same bits, and what is refused."""

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh
from stopped_runs import same, taken_up

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.materials.material import default_name
from flexpm.report import tables
from flexpm.report.curves import _caption
from flexpm.results.result import Result

SIZES = {"diameter": 0.01, "height": 0.016}
BOX = {"width": 0.009, "depth": 0.008, "height": 0.014}
FAST = {"rate": 4.0}
FAST_WORDS = ["--rate", "4"]


@pytest.fixture(scope="module")
def core():
    return Specimen.cylinder(**SIZES, seed=1)


@pytest.fixture(scope="module")
def box():
    return Specimen.box(**BOX, seed=2)


def confined(specimen, model, *pressures):
    rig = flexpm.rig(fresh(specimen, model=model))
    rig.confine(*pressures)
    return rig


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_start_stands_at_its_pressures(box, model):
    rig = confined(box, model, 10e6, 25e6)
    found = rig.built.solver.balance()
    # triangles of rigid grains keep their areas and overlap by what the contacts close
    closed = 8e-4 if model == "rigid" else 0.0
    stress = -np.array(found["mean_stress"][:3])
    assert stress == pytest.approx([10e6, 25e6, 25e6], rel=1e-3 + closed)
    assert found["outside_stress"][:3] == pytest.approx(-stress, rel=1e-3)
    assert max(map(abs, found["mean_stress"][3:])) < 1e-3 * 25e6
    assert np.hypot.reduce(found["missing_force"]) < 1e-3 * 10e6 * BOX["width"] * BOX["height"]
    assert rig.confinement == 10e6
    assert rig.balance().largest < 1e-3
    assert rig.kind == "triaxial"


@pytest.mark.long
def test_a_second_confinement_follows_on_the_first(core):
    rig = confined(core, "flexible", 5e6)
    first = rig.built.solver.energies()["elastic_energy"]
    rig.confine(10e6)
    # linear, so that the energy is four times as large
    assert rig.built.solver.energies()["elastic_energy"] == pytest.approx(4.0 * first, rel=0.01)
    assert rig.built.solver.balance()["mean_stress"][0] == pytest.approx(-10e6, rel=1e-3)
    rig.load(flexpm.Loading(max_strain=2e-4))
    refusal("must come before the load", rig.confine, 20e6)


def test_a_second_pressure_after_the_load_is_refused_and_adds_no_column(box):
    rig = confined(box, "rigid", 5e6)
    rig.load(flexpm.Loading(max_strain=2e-4))
    columns, stress = [*rig.record.columns], [*rig.record["axial_stress"]]
    refusal("must come before the load", rig.confine, 5e6, 9e6)
    assert [*rig.record.columns] == columns
    assert [*rig.record["axial_stress"]] == stress


@pytest.mark.long
def test_a_mirrored_box_under_exchanged_pressures_is_the_same(box):
    spheres = np.column_stack([box.spheres[:, 1], box.spheres[:, 0], box.spheres[:, 2:]])
    sizes = {"width": BOX["depth"], "depth": BOX["width"], "height": BOX["height"]}
    plain = Specimen.from_spheres(box.spheres, **BOX)
    mirrored = Specimen.from_spheres(spheres, **sizes)
    found = []
    for specimen, pressures in ((plain, (8e6, 20e6)), (mirrored, (20e6, 8e6))):
        rig = confined(specimen, "flexible", *pressures)
        rig.built.run(4000)
        stress = rig.built.solver.balance()["mean_stress"]
        found.append([rig.built.solver.energies()["elastic_energy"], stress[2]])
    # one in twenty tetrahedra is not mirrored: of fans that are as good the first is taken
    assert found[0] == pytest.approx(found[1], rel=1e-5)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_the_strength_rises_with_the_pressure(core, model):
    peaks = []
    for pressure in (0.0, 2e6):
        result = flexpm.run(
            "triaxial", core, default_name(model), model, confinement=pressure, **FAST
        )
        assert result.status in ("ok", "not_quasistatic")
        assert result.energy_error < 0.01
        assert result.confinement == pressure
        # strains count from the confined state
        slope = (result.curve["axial_stress"][0] - pressure) / result.curve["axial_strain"][0]
        assert slope == pytest.approx(result.youngs_modulus, rel=0.05)
        peaks.append(result.peak_stress)
    assert peaks[1] > peaks[0] + 2.0 * pressure
    volume = result.curve["axial_strain"] - 2.0 * result.curve["lateral_strain"]
    assert np.array_equal(result.curve["volumetric_strain"], volume)
    assert 0.0 < result.crack_initiation_stress < peaks[1] - pressure


@pytest.mark.long
def test_the_elastic_constants_are_those_without_a_pressure(core):
    solved = flexpm.elastic(core, "augig-table7")
    tested = flexpm.run("triaxial", core, "augig-table7", confinement=5e6, max_strain=4e-4).curve
    slope = np.ptp(tested["axial_stress"]) / np.ptp(tested["axial_strain"])
    assert slope == pytest.approx(solved["youngs_modulus"], rel=0.01)
    ratio = np.ptp(tested["lateral_strain"]) / np.ptp(tested["axial_strain"])
    assert ratio == pytest.approx(solved["poissons_ratio"], rel=0.02)


@pytest.mark.long
def test_the_command_and_its_repetition(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sizes = [f"--{name}={value}" for name, value in BOX.items()]
    asked = ["triaxial", "--shape", "box", *sizes, "--confinement", "5e6,9e6", *FAST_WORDS]
    assert cli.main(["run", *asked, "--quiet", "--out", "box"]) in (0, 3)
    told = capsys.readouterr().out
    assert "crack initiation" in told and "granites 0.50 to 0.54" in told
    read = Result.read("box")
    assert (read.confinement, read.inputs["second_confinement"]) == (5e6, 9e6)
    assert read.second_confinement == 9e6
    assert set(read.curve["second_confinement"]) == {9e6}
    assert set(read.curve["confinement"]) == {5e6}
    (line,) = [line for line in told.splitlines() if "confining pressure" in line]
    assert line.split() == ["confining", "pressure", "5.000", "and", "9.000", "MPa"]
    assert "confining pressure 5 and 9 MPa" in _caption(read)
    assert tables.test_text(read).startswith("triaxial under 5 and 9 MPa, ")
    assert "crack initiation" in (tmp_path / "box" / "report.html").read_text()
    assert cli.main(["rerun", "box", "--quiet", "--out", "again", "--no-report"]) in (0, 3)
    assert "the same as in" in capsys.readouterr().out


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_ends_with_friction_hold_a_core_across(core, model, tmp_path, monkeypatch):
    asked = {"model": model, "confinement": 2e6, "max_strain": 1e-3}
    smooth, rough = (
        flexpm.run("triaxial", core, end_friction=friction, **asked) for friction in (0.0, 0.3)
    )
    assert smooth.inputs["specimen"] == rough.inputs["specimen"]
    # a plate begins at what the pressure was, the first row some steps later
    for one in (smooth, rough):
        line = np.polyfit(one.curve["axial_strain"][:2], one.curve["axial_stress"][:2], 1)
        assert line[1] == pytest.approx(2e6, rel=0.01)
    assert rough.energy_error < 0.01
    assert 1.0 < rough.curve["axial_stress"][-1] / smooth.curve["axial_stress"][-1] < 1.2
    # over the axial strain: rows end at other steps
    waist = [
        one.curve["lateral_strain"][-1] / one.curve["axial_strain"][-1] for one in (smooth, rough)
    ]
    assert waist[1] == pytest.approx(waist[0], rel=0.05)  # it hardly feels what holds the ends
    assert same(flexpm.run("triaxial", core, threads=2, end_friction=0.3, **asked), rough)

    asked["end_friction"] = 0.3
    again = taken_up(monkeypatch, tmp_path, rough.steps - 40, "triaxial", core, **asked)
    assert same(again, rough)


def test_friction_of_ends_is_refused_where_there_is_none(core):
    plane = Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
    with pytest.raises(InputError, match="end_friction = 0.2, must not be given for a rectangle"):
        flexpm.run("uniaxial", plane, end_friction=0.2)
    with pytest.raises(InputError, match="end_friction = 0.2, must be left out for model jcfpm"):
        flexpm.run("uniaxial", core, model="jcfpm", end_friction=0.2)
    with pytest.raises(InputError, match="run: end_friction = 11.0, must be <= 10"):
        flexpm.run("uniaxial", core, end_friction=11.0)
    yade.O.reset()
    with pytest.raises(InputError, match="roughen: friction = 0.1, must be 0 for ends that pull"):
        flexpm.rig(flexpm.build(core), tension=True).roughen(0.1)
    late = flexpm.rig(fresh(core))
    late.confine(1e5)
    late.roughen(0.1)
    with pytest.raises((InputError, ValueError), match="roughen the ends before a pressure acts"):
        late.load(flexpm.Loading(max_strain=1e-4))


@pytest.mark.long
def test_a_script_roughens_ends_and_its_folder_repeats_them(core, tmp_path):
    peaks = []
    for friction in (0.0, 0.3):
        rig = flexpm.rig(fresh(core), out=tmp_path / str(friction), report=False)
        rig.roughen(friction)
        rig.confine(1e6)
        rig.load(flexpm.Loading(max_strain=8e-4))
        rig.finish()
        peaks.append(rig.record["axial_stress"][-1])
    assert peaks[0] < peaks[1] < 1.2 * peaks[0]
    yade.O.reset()
    asked = ["rerun", str(tmp_path / "0.3"), "--quiet", "--out", str(tmp_path / "again")]
    assert cli.main([*asked, "--no-report"]) in (0, 3)
    again = Result.read(tmp_path / "again")
    assert again.curve["axial_stress"][-1] == peaks[1]


def test_what_does_not_fit_is_refused_in_one_line(core, box):
    plane = Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
    with pytest.raises(InputError, match="rectangle, must be a cylinder for triaxial; use biaxial"):
        flexpm.run("triaxial", plane, confinement=1e6)
    with pytest.raises(InputError, match="must be a rectangle for biaxial; use triaxial"):
        flexpm.run("biaxial", core, confinement=1e6)
    with pytest.raises(InputError, match="second_confinement = 1e.06 Pa, must be left out for a"):
        flexpm.run("triaxial", core, confinement=1e6, second_confinement=1e6)
    refusal("one of flexible, rigid", flexpm.run, "triaxial", box, model="inner")
    rig = flexpm.rig(fresh(core))
    refusal("confine: second = 1e.06 Pa, must be left out", rig.confine, 1e6, 1e6)
    refusal("confine: second = -1.0 Pa, must be >= 0", rig.confine, 1e6, -1.0)
