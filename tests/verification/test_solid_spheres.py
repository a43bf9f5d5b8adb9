# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's own bonded models on solids: faces, lattices, single bonds, energy, bits, files."""

import math

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh
from step_clock import step_clock

import flexpm
from flexpm import Specimen
from flexpm.materials.material import Material
from flexpm.models.sphere_bonds import bonds_of, laws_of
from flexpm.models.sphere_faces import outer_faces, shared_faces
from flexpm.results.result import Result
from flexpm.rigs.solids.sphere_gauge import SphereGauge

MODELS = ["jcfpm", "cohfrict"]
SIZE = 1e-3  # of cubic grains [m]
K, ETA, TENSILE, COHESION = 5e13, 0.3, 8e6, 20e6
ROCK = Material.from_dict(
    {
        "tensile_strength": TENSILE,
        "cohesion": COHESION,
        "friction": 0.4,
        "tensile_fracture_energy": 20.0,
        "shear_fracture_energy": 800.0,
        "elastic": {"rigid": {"normal_stiffness": K, "shear_ratio": ETA}},
    }
)


def cubes(across, up):
    """Cubic grains in rows."""
    x, z = (SIZE * (np.arange(n) + 0.5) for n in (across, up))
    rows = [(a, b, c, 0.5 * SIZE) for c in z for b in x for a in x]
    sizes = {"width": across * SIZE, "depth": across * SIZE, "height": up * SIZE}
    return Specimen.from_spheres(rows, **sizes)


@pytest.fixture(scope="module")
def core():
    return Specimen.cylinder(0.009, 0.012, seed=2)


@pytest.fixture(scope="module")
def box():
    return Specimen.box(0.008, 0.008, 0.011, seed=3)


def built_of(specimen, model, material=ROCK, **options):
    return fresh(specimen, material, model, **options)


def pair_of(model):
    """Two cubic grains with nothing free to move by itself, and their bond."""
    built = built_of(cubes(1, 2), model)
    for body in built.ids:
        yade.O.bodies[body].state.blockedDOFs = "xyzXYZ"
    return built, next(iter(yade.O.interactions)), yade.O.bodies[built.ids[1]].state


def test_faces_have_the_areas_and_moments_of_polygons(core):
    square = shared_faces(cubes(2, 2))
    assert square.areas == pytest.approx(SIZE**2, rel=1e-9)
    assert square.moments == pytest.approx(SIZE**4 / 6.0, rel=1e-9)
    assert len(square.grains) == 12
    # cells of any shape: as the grains' own contacts; the outside is closed and holds the volume
    faces = shared_faces(core)
    state = built_of(core, "flexible", None).snapshot()
    assert faces.areas == pytest.approx(state.areas, rel=1e-9)
    assert np.array_equal(faces.grains, state.contact_grains)
    _, sides, vectors = outer_faces(core)
    ends = [vectors[sides == side].sum(axis=0) for side in (0, 2)]
    section = core.outline().volume / 0.012
    assert ends[0] == pytest.approx([0.0, 0.0, -section], abs=1e-6 * section)
    assert ends[1] == pytest.approx([0.0, 0.0, section], abs=1e-6 * section)
    assert np.abs(vectors.sum(axis=0)).max() < 1e-9 * section


@pytest.mark.parametrize("model", MODELS)
def test_bonds_stand_on_faces_and_beyond_neighbours_on_discs(core, model):
    laws = laws_of(core, ROCK, model)
    bonds, wider = bonds_of(core, laws), bonds_of(core, laws, 1.4)
    assert len(bonds) == core.cells.contacts < len(wider)
    assert bonds.normal_stiffness == pytest.approx(K * bonds.areas)
    assert bonds.tensile_strength == pytest.approx(TENSILE * bonds.areas)
    # a square's bending and twisting are those of its points
    square = bonds_of(cubes(2, 2), laws_of(cubes(2, 2), ROCK, model))
    assert square.bending_stiffness == pytest.approx(K * SIZE**4 / 12.0)
    assert square.twisting_stiffness == pytest.approx(ETA * K * SIZE**4 / 6.0)
    farther = wider.grains[len(bonds) :]
    assert np.array_equal(wider.grains[: len(bonds)], bonds.grains)
    apart = np.linalg.norm(np.diff(core.centres[farther], axis=1)[:, 0], axis=1)
    assert np.all(apart < 1.4 * core.radii[farther].sum(axis=1))
    smaller = core.radii[farther].min(axis=1)
    assert wider.areas[len(bonds) :] == pytest.approx(math.pi * smaller**2)
    state = built_of(core, model, interaction_range=1.4).snapshot()
    assert len(state.areas) == len(wider)
    assert state.section.triangles.size > 0


@pytest.mark.parametrize("model", MODELS)
def test_a_lattice_has_the_modulus_of_its_bonds(model):
    for test in ("uniaxial", "tension"):
        result = flexpm.run(test, cubes(2, 4), ROCK, model, rate=0.02, max_strain=2e-5)
        curve = result.curve
        modulus = curve["axial_stress"][-1] / curve["axial_strain"][-1]
        assert modulus == pytest.approx(K * SIZE, rel=2e-3)
        assert np.abs(curve["lateral_strain"]).max() < 1e-3 * curve["axial_strain"][-1]


@pytest.mark.parametrize("model", MODELS)
def test_a_bond_breaks_at_its_strengths(model):
    area = SIZE**2
    for axis, strength, stiffness in ((2, TENSILE, K), (0, COHESION, ETA * K)):
        built, bond, upper = pair_of(model)
        limit = strength / stiffness
        steps, forces, phys = 200, [], bond.phys
        speed = np.zeros(3)
        speed[axis] = 1.5 * limit / steps
        upper.vel = tuple(speed)
        for _ in range(steps):
            built.run(1)
            built.cracks.look()
            if sum(built.cracks.counts):
                break
            force = phys.normalForce + phys.shearForce
            forces.append(force.norm())
        assert max(forces) == pytest.approx(strength * area, rel=2.0 / steps * 1.5)
        assert max(forces) <= strength * area * (1.0 + 1e-9)
        assert built.cracks.counts == ((1, 0) if axis == 2 else (0, 1))
        place = built.snapshot().crack_position[0]
        assert place == pytest.approx([0.5 * SIZE, 0.5 * SIZE, SIZE], abs=1e-2 * SIZE)


def test_a_bond_of_cohfrict_bends_and_twists_as_its_face():
    for axis, stiffness in ((0, K * SIZE**4 / 12.0), (2, ETA * K * SIZE**4 / 6.0)):
        built, bond, upper = pair_of("cohfrict")
        spin = np.zeros(3)
        spin[axis] = 1e-9
        upper.angVel = tuple(spin)
        built.run(100)
        moment = bond.phys.moment_bending if axis == 0 else bond.phys.moment_twist
        # the angle of the geometry is that of one step before, or of this one
        assert moment.norm() == pytest.approx(stiffness * 1e-7, rel=0.02)


@pytest.mark.parametrize("model", MODELS)
def test_stress_slip_and_places_of_a_snapshot(box, model):
    built = built_of(box, model)
    state = built.snapshot()
    nodes, _, grains = box.tetrahedra()
    assert state.positions == pytest.approx(nodes, abs=1e-15)
    assert np.array_equal(state.tetrahedron_grain, grains)
    assert not state.fragments.labels.any()
    assert np.all(state.surface_side[state.surface_grain >= 0] >= 0)
    # turned as one body all is as before
    angle, way = 0.3, np.array([1e-3, -2e-3, 3e-3])
    turn = np.array(
        [[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]]
    )
    for body, centre in zip(built.ids, box.centres, strict=True):
        yade.O.bodies[body].state.pos = tuple(turn @ centre + way)
        state_now = yade.O.bodies[body].state
        state_now.ori = type(state_now.ori)((0, 0, 1), angle)
    moved = built.snapshot()
    assert moved.positions == pytest.approx(nodes @ turn.T + way, abs=1e-15)
    assert moved.corners == pytest.approx(state.corners @ turn.T + way, abs=1e-15)
    assert np.abs(moved.point_opening).max() < 1e-15


def test_the_lateral_strain_is_that_of_the_waist():
    along_x, along_y, along_z = 3e-4, 1e-4, -5e-4
    for specimen in (Specimen.box(0.012, 0.012, 0.024, seed=3), cubes(3, 6)):
        height, centres = specimen.dimensions["height"], np.array(specimen.centres)
        even = centres * [along_x, along_y, along_z] + [1e-3, -2e-3, 0.0]
        expected = (along_z, 0.5 * (along_x + along_y))
        gauge = SphereGauge(specimen)
        assert gauge.strains(centres, even) == pytest.approx(expected, rel=1e-9)
        ends = np.abs(centres[:, 2] / height - 0.5) > 0.4
        even[ends, :2] = 0.1 * centres[ends, :2]
        assert gauge.strains(centres, even)[1] == pytest.approx(expected[1], rel=1e-9)


@pytest.mark.parametrize("shift", [0.0, 0.02, 0.1])
def test_a_layer_of_one_sphere_has_no_strain_across(shift):
    rows = []
    for i, k in np.ndindex(4, 6):  # they do not lie equally deep
        off = shift * (1.0 if (i + k) % 2 else -1.0)
        rows.append((SIZE * (i + 0.5), SIZE * (0.5 + off), SIZE * (k + 0.5), 0.5 * SIZE))
    layer = Specimen.from_spheres(rows, width=4 * SIZE, depth=SIZE, height=6 * SIZE)
    centres = np.array(layer.centres)
    ways = centres * [3e-4, 1e-4, -5e-4]
    ways[:, 1] += 1e-7 * np.arange(len(ways))
    assert SphereGauge(layer).strains(centres, ways)[1] == pytest.approx(3e-4, rel=1e-6)
    column = cubes(1, 6)
    centres = np.array(column.centres)
    assert math.isnan(SphereGauge(column).strains(centres, 1e-4 * centres)[1])


@pytest.mark.parametrize("model", MODELS)
def test_the_stress_of_grains_is_that_of_the_load(box, model):
    result = flexpm.run("uniaxial", box, ROCK, model, rate=2.0, max_strain=1e-4)
    state = result.snapshot
    inner = np.setdiff1d(np.arange(box.cells.cells), outer_faces(box)[0])
    mean = np.average(state.grain_stress[:, 2], weights=state.volumes)
    # plates act on grains of the ends, whose bonds alone count
    assert mean == pytest.approx(-result.curve["axial_stress"][-1], rel=0.4)
    assert state.grain_stress[inner, 2].mean() < 0.5 * mean
    energy = result.curve["elastic_energy"][-1]
    assert energy == pytest.approx(result.curve["boundary_work"][-1], rel=0.05)


@pytest.mark.long
def test_a_core_breaks_and_leaves_its_files(core, tmp_path):
    result = flexpm.run("tension", core, ROCK, "cohfrict", rate=8.0, out=tmp_path, frames=2)
    assert result.peak_stress == pytest.approx(0.75 * TENSILE, rel=0.5)
    assert result.tensile_cracks > 5
    assert result.tetrahedra == core.statistics()["tetrahedra"]
    assert result.largest_overlap is None and result.energy_error is None
    read = Result.read(tmp_path)
    assert [one[:5] for one in read.cracks] == [one[:5] for one in result.cracks]
    assert {one.z for one in read.cracks} <= set(result.snapshot.crack_position[:, 2].tolist())
    names = {one.name for one in tmp_path.iterdir()}
    assert {"outside.png", "fragments.csv", "frames.pvd", "report.html", "final.vtu"} <= names
    assert "no map" not in (tmp_path / "report.html").read_text()


@pytest.mark.long
def test_a_run_that_is_stopped_goes_on_to_the_same_bits(core, tmp_path, monkeypatch):
    step_clock(monkeypatch.setattr, look=10)

    class StopError(Exception):
        pass

    def stop(done, expected, text):
        if (tmp_path / "checkpoint.json").exists():  # of a reload
            raise StopError

    asked = {"model": "jcfpm", "material": ROCK, "rate": 1.0, "max_strain": 4e-4}
    whole = flexpm.run("tension", core, **asked)
    with pytest.raises(StopError):
        flexpm.run("tension", core, out=tmp_path, progress=stop, **asked)
    again = flexpm.run("tension", core, out=tmp_path, report=False, **asked)
    assert 0 < again.resumed_at < whole.steps
    assert again.curve.csv() == whole.curve.csv()


def test_what_spheres_in_a_solid_do_not_have_is_refused(box):
    refusal("build: dynamic = True, must be False for", built_of, box, "jcfpm", dynamic=True)
    rig = flexpm.rig(built_of(box, "jcfpm"))
    refusal("confine: pressure = 1e.06 Pa, no pressure acts on 3D spheres", rig.confine, 1e6)
    refusal("balance: specimen = box, no pressure acts on 3D spheres", rig.balance)
