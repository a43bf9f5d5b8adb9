# SPDX-License-Identifier: GPL-3.0-or-later
"""A test that starts at the elastic solution, in 2D and 3D: the same measures; what it refuses."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from refusals import refusal
from yade import wrapper

import flexpm
from flexpm.errors import InputError
from flexpm.materials.material import load
from flexpm.results.result import Result
from flexpm.specimens.specimen import Specimen

MAKERS = {
    "rectangle": lambda: Specimen.rectangle(0.016, 0.032, 0.08, seed=2),
    "box": lambda: Specimen.box(0.009, 0.009, 0.018, seed=1),
    "cylinder": lambda: Specimen.cylinder(0.01, 0.02, seed=1),
}
#: Specimen, test, model.
PULLED = [
    ("rectangle", "tension", "flexible"),
    ("box", "tension", "flexible"),
    ("box", "tension", "rigid"),
]
CASES = [
    *PULLED,
    ("box", "uniaxial", "flexible"),
    ("box", "uniaxial", "rigid"),
    ("cylinder", "triaxial", "flexible"),
    ("cylinder", "triaxial", "rigid"),
]
PRESSURE = 2e6
O = wrapper.Omega()  # noqa: E741 - its name in YADE


@cache
def specimen_of(shape: str):
    return MAKERS[shape]()


@cache
def result_of(shape: str, test: str, model: str, start: str) -> Result:
    pressed = {"confinement": PRESSURE} if test == "triaxial" else {}
    return flexpm.run(test, specimen_of(shape), model=model, start=start, **pressed)


@pytest.fixture(scope="module")
def specimen():
    return specimen_of("rectangle")


def above_pressure(result: Result):
    return result.curve["axial_stress"] - result.curve["confinement"]


@pytest.mark.parametrize("case", CASES)
def test_strength_does_not_depend_on_the_start(case):
    # one small specimen: the last decimals of a cascade of cracks differ, by less than halving the
    # rate moves it
    static, rest = (result_of(*case, start) for start in ("static", "rest"))
    assert static.peak_stress == pytest.approx(rest.peak_stress, rel=0.02)
    assert static.tensile_cracks > 0
    assert static.status == rest.status


@pytest.mark.parametrize("case", CASES)
def test_the_elastic_branch_is_recorded_and_is_that_of_the_solve(case):
    shape, test, model = case
    found = flexpm.elastic(specimen_of(shape), model=model)
    result = result_of(*case, "static")
    assert not result.curve["unbalanced_ratio"][:20].any()  # nothing is free
    assert not result.curve["damage_energy"][:20].any()
    steps = np.diff(result.curve["step"][:20])
    assert (steps == 1).all()
    strain, stress = result.curve["axial_strain"][:20], above_pressure(result)[:20]
    # plates on rigid grains that a pressure has bent lie on a bit more of them
    slope = np.polyfit(strain, stress, 1)[0]
    assert slope == pytest.approx(found["youngs_modulus"], rel=5e-3)
    ratio = np.polyfit(strain, result.curve["lateral_strain"][:20], 1)[0]
    # solids: the waist's, of a whole height there
    rel = 5e-3 if shape == "rectangle" else 0.05
    assert ratio == pytest.approx(found["poissons_ratio"], rel=rel)


@pytest.mark.parametrize("start", ["static", "rest"])
@pytest.mark.parametrize("case", PULLED)
def test_points_soften_from_the_elastic_limit_of_the_solve_on(case, start):
    limit = result_of(*case, "static").curve["axial_stress"][19] / 0.9  # 20 steps lead to 0.9
    result = result_of(*case, start)
    first = int(np.argmax(result.curve["damage_energy"] > 0.0))
    onset = result.softening_onset * result.peak_stress
    assert onset == pytest.approx(result.curve["axial_stress"][first], rel=1e-12)
    assert 0.995 * result.curve["axial_stress"][first - 1] < limit < 1.005 * onset
    # rows of a small solid are farther apart
    assert onset < (1.04 if case[0] == "rectangle" else 1.2) * limit


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_points_that_cannot_soften_dissipate_nothing_at_all(specimen, model):
    strengths = ["softening=brittle", "tensile_strength=1e9", "cohesion=1e10"]
    material = load("augig-table7", model).with_set(strengths, model)
    options = {"rate": 0.02, "max_strain": 1e-3, "loading": "constant"}
    result = flexpm.run("uniaxial", specimen, material, model, **options)
    assert len(result.curve) > 20 and result.softening_onset is None
    assert not result.curve["damage_energy"].any()


@pytest.mark.parametrize("case", CASES)
def test_the_specimen_is_released_in_equilibrium_and_the_books_close(case):
    result = result_of(*case, "static")
    # one step of a compression at its full rate goes farther than the elastic limit
    least = 2e-3 if case[1] != "uniaxial" else 0.1
    assert 0.0 < result.curve["unbalanced_ratio"][20] < least
    assert result.energy_error < 1e-3


@pytest.mark.parametrize("case", PULLED)
def test_a_slow_loading_is_saved_most_steps_to_the_elastic_limit(case):
    shape, test, model = case
    largest = 1.2 * float(result_of(*case, "static").curve["axial_strain"][19])
    first = {}
    for start in ("static", "rest"):
        options = {"start": start, "loading": "constant", "max_strain": largest}
        curve = flexpm.run(test, specimen_of(shape), model=model, **options).curve
        assert curve["damage_energy"][-1] > 0.0
        first[start] = curve["step"][np.argmax(curve["damage_energy"] > 0.0)]
    # 20 steps and the last tenth
    assert first["static"] < 0.25 * first["rest"]


def test_static_is_the_default_of_tension_in_2d_only(specimen):
    static = result_of(*PULLED[0], "static")
    assert static.steps < 0.97 * result_of(*PULLED[0], "rest").steps
    assert flexpm.run("tension", specimen).steps == static.steps
    begun = flexpm.run("uniaxial", specimen, max_strain=1e-6).curve
    assert begun["step"][0] > 1  # no recorded steps of a way along the elastic solution
    begun = flexpm.run("tension", specimen_of("box"), max_strain=1e-6).curve
    assert begun["step"][0] > 1


@pytest.mark.parametrize("case", PULLED[:2])
def test_a_run_ends_at_the_largest_strain_also_on_the_way_to_the_elastic_limit(case):
    shape, test, model = case
    largest = 0.5 * result_of(*case, "static").curve["axial_strain"][19]
    result = flexpm.run(
        test, specimen_of(shape), model=model, start="static", max_strain=float(largest)
    )
    assert result.steps <= 20
    assert result.curve["axial_strain"][-1] == pytest.approx(largest, rel=0.2)


@pytest.mark.parametrize("case", [PULLED[0], PULLED[2], ("cylinder", "triaxial", "rigid")])
def test_a_scene_saved_on_the_way_to_the_elastic_limit_goes_on_to_the_same_bits(case, tmp_path):
    shape, test, model = case
    file = str(tmp_path / "scene.bin")
    O.reset()
    rig = flexpm.rig(flexpm.build(specimen_of(shape), model=model), tension=test == "tension")
    if test == "triaxial":
        rig.confine(PRESSURE)
    begun, ends = O.iter, []

    def look(_) -> None:
        if O.iter == begun + 10:
            O.save(file)
        if O.iter == begun + 30:
            ends.append(rig.built.solver.energies())

    rig.watch = look
    rig.load(flexpm.Loading(kind="constant", static=True, max_strain=5e-4))
    O.load(file)
    O.run(10, True)
    (loading,) = (one for one in O.engines if isinstance(one, wrapper.LoadingController))
    loading.release()
    O.run(10, True)
    (solver,) = (one for one in O.engines if isinstance(one, wrapper.GrainSolver))
    for name in ("elastic_energy", "boundary_work", "damping_energy"):
        assert solver.energies()[name] == ends[0][name] != 0.0
    O.reset()


@pytest.mark.parametrize(
    ("shape", "test", "options", "needs"),
    [
        ("rectangle", "biaxial", {}, "needs the flexible model and uniaxial or tension"),
        ("rectangle", "uniaxial", {"model": "rigid"}, "needs the flexible model"),
        ("rectangle", "tension", {"model": "jcfpm"}, "needs the flexible model"),
        (
            "box",
            "tension",
            {"model": "jcfpm"},
            "the flexible or rigid model and uniaxial or tension",
        ),
        ("box", "uniaxial", {"control": "lateral"}, "with control = lateral"),
    ],
)
def test_what_has_no_elastic_start_is_refused(shape, test, options, needs):
    rock = specimen_of(shape)
    refusal(
        f"start = static, must be rest.* {needs}", flexpm.run, test, rock, start="static", **options
    )


def test_an_unknown_start_is_refused(specimen):
    with pytest.raises(InputError, match="start = 'dynamic', must be one of rest, static"):
        flexpm.run("uniaxial", specimen, start="dynamic")
