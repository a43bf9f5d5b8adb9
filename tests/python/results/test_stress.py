# SPDX-License-Identifier: GPL-3.0-or-later
"""Stresses of a state: at points, along lines, in polar components, means of grains."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from refusals import refusal
from sample_snapshot import HEIGHT, STRESS, WIDTH, moved, wall
from scenes import fresh

import flexpm
from flexpm.results.snapshot import Snapshot, triangle_areas
from flexpm.results.stress.point_stress import OF_GRAINS, OF_TRIANGLES
from flexpm.results.stress.tensors import principal_stresses, turned_stresses


def varied(columns: int = 5, rows: int = 4) -> Snapshot:
    """A wall whose triangles have stresses of their own [Pa]."""
    state = wall(columns, rows)
    stress = np.random.default_rng(4).normal(size=state.triangle_stress.shape)
    return dataclasses.replace(state, triangle_stress=1e6 * stress)


def by_hand(state: Snapshot, places: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Mean stress of the triangles that have a point, each asked in turn."""
    found = []
    for corners, stress in zip(places[state.triangles], state.triangle_stress, strict=True):
        shares = np.linalg.solve(np.vstack([corners.T, np.ones(3)]), [*point, 1.0])
        if np.all(shares >= -1e-9):
            found.append(stress)
    return np.mean(found, axis=0) if found else np.full(3, np.nan)


def test_a_patch_has_its_stress_everywhere_to_round_off():
    state = wall(6, 4)
    points = np.random.default_rng(1).random((500, 2)) * [6 * WIDTH, 4 * HEIGHT]
    for places, was_moved in ((points, False), (moved(points), True)):
        found = state.stress_at(places, moved=was_moved)
        assert found.missing == 0
        np.testing.assert_allclose(found.stress, np.tile(STRESS, (500, 1)), rtol=1e-12)
    assert found.source == OF_TRIANGLES
    np.testing.assert_allclose(state.grain_stress, np.tile(STRESS, (24, 1)), rtol=1e-12)


def test_stresses_are_those_of_the_triangle_that_has_the_point():
    state = varied()
    points = np.random.default_rng(2).random((300, 2)) * [6 * WIDTH, 5 * HEIGHT]
    points = np.vstack([points, state.reference[:40]])  # corners are shared
    for places, was_moved in ((state.reference, False), (state.positions, True)):
        found = state.stress_at(points, moved=was_moved)
        wanted = np.array([by_hand(state, places, point) for point in points])
        np.testing.assert_allclose(found.stress, wanted, rtol=1e-12)
        assert found.missing == np.count_nonzero(np.isnan(wanted[:, 0])) > 50


def test_points_outside_in_holes_and_where_a_grain_is_gone_are_nan_and_counted():
    state = varied()
    kept = state.triangle_grain != 7  # third of the second row
    state = dataclasses.replace(
        state,
        triangles=state.triangles[kept],
        triangle_grain=state.triangle_grain[kept],
        triangle_stress=state.triangle_stress[kept],
    )
    points = [(-1e-6, HEIGHT), (2.5 * WIDTH, 1.5 * HEIGHT), (0.5 * WIDTH, HEIGHT), (1e9, 0.0)]
    found = state.stress_at(points)
    assert list(np.isnan(found.xx)) == [True, True, False, True]
    assert found.missing == 3
    assert repr(found) == f"PointStress(4 points, 3 without a grain; {OF_TRIANGLES})"
    assert np.all(np.isnan(state.grain_stress[7]))
    assert np.all(np.isfinite(np.delete(state.grain_stress, 7, axis=0)))
    one = state.stress_at((0.4 * WIDTH, 0.5 * HEIGHT))
    assert one.stress.shape == (1, 3)
    assert one.missing == 0


def test_grains_that_flew_off_and_numbers_of_a_run_that_diverged_hide_no_other_grain():
    state = varied()
    positions = state.positions.copy()
    positions[:5] += 1e12
    positions[5:10] = np.nan
    positions[10:15] *= 1e200
    far = dataclasses.replace(state, positions=positions)
    middles = state.positions[state.triangles].mean(axis=1)
    found = far.stress_at(middles, moved=True)
    np.testing.assert_array_equal(found.stress[12:], state.triangle_stress[12:])
    assert found.missing == 12
    whole = dataclasses.replace(state, positions=np.full_like(positions, np.nan))
    assert whole.stress_at(middles, moved=True).missing == len(middles)


def test_a_triangle_that_is_stretched_far_costs_no_memory():
    state = varied()
    positions = state.positions.copy()
    positions[0] -= 1e3  # some billion squares of the others' size
    far = dataclasses.replace(state, positions=positions)
    middles = positions[state.triangles].mean(axis=1)
    found = far.stress_at(middles, moved=True)
    torn = (state.triangles == 0).any(axis=1)
    np.testing.assert_array_equal(found.stress[~torn][12:], state.triangle_stress[~torn][12:])
    assert not np.isnan(found.stress[torn]).any()


def test_a_line_has_even_points_and_their_distance():
    state = varied()
    first, last = (0.1 * WIDTH, 0.2 * HEIGHT), (4.9 * WIDTH, 3.3 * HEIGHT)
    line = state.stress_along(first, last, 7)
    np.testing.assert_allclose(line.points, np.linspace(first, last, 7), rtol=1e-12)
    whole = np.hypot(4.8 * WIDTH, 3.1 * HEIGHT)
    np.testing.assert_allclose(line.distance, np.linspace(0.0, whole, 7), rtol=1e-12)
    np.testing.assert_array_equal(line.stress, state.stress_at(line.points).stress)
    assert len(line) == 7


def test_polar_components_are_those_of_the_turned_axes():
    state, about = wall(), (0.7 * WIDTH, 1.3 * HEIGHT)
    points = np.array([(2.9 * WIDTH, 1.3 * HEIGHT), (0.7 * WIDTH, 3.0 * HEIGHT), about])
    found = state.stress_at(points).polar(about)
    xx, yy, xy = STRESS
    np.testing.assert_allclose([one[0] for one in found], [xx, yy, xy], rtol=1e-12)
    np.testing.assert_allclose([one[1] for one in found], [yy, xx, -xy], rtol=1e-12)
    assert all(np.isnan(one[2]) for one in found)


def test_turned_and_principal_stresses_are_those_of_the_tensor():
    draw = np.random.default_rng(3)
    stress, angle = draw.normal(size=(20, 3)), draw.uniform(-4.0, 4.0, 20)
    larger, smaller = principal_stresses(stress)
    for row, turn, found, low, high in zip(
        stress, angle, turned_stresses(stress, angle), smaller, larger, strict=True
    ):
        axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        tensor = np.array([[row[0], row[2]], [row[2], row[1]]])
        turned = axes @ tensor @ axes.T
        np.testing.assert_allclose(found, turned[[0, 1, 0], [0, 1, 1]], atol=1e-14)
        np.testing.assert_allclose([low, high], np.linalg.eigvalsh(tensor), atol=1e-14)


def test_the_angle_of_the_larger_principal_stress_turns_the_shear_away():
    found = varied().stress_at([(WIDTH * 0.5, HEIGHT * 0.2), (WIDTH * 2.2, HEIGHT * 1.4)])
    turned = turned_stresses(found.stress, found.principal_angle)
    np.testing.assert_allclose(turned[:, :2].T, found.principal, rtol=1e-12)
    np.testing.assert_allclose(turned[:, 2], 0.0, atol=1e-6)


def test_a_mean_of_a_grain_weighs_triangles_by_their_area():
    state = varied()
    areas = triangle_areas(state)
    own = state.triangle_grain == 3
    wanted = areas[own] @ state.triangle_stress[own] / areas[own].sum()
    np.testing.assert_allclose(state.grain_stress[3], wanted, rtol=1e-12)


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ([(0.0, 0.0, 0.0)], "must be x and y"),
        ("corner", "must be x and y"),
        ([(0.0, float("nan"))], "must be finite"),
        (None, "must be"),
    ],
)
def test_what_are_no_points_is_refused_in_one_line(points, said):
    refusal(said, lambda: wall().stress_at(points))
    refusal("count = 1, must be", lambda: wall().stress_along((0.0, 0.0), (1.0, 0.0), 1))


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_pressed_grains_bear_the_pressure_and_rigid_ones_say_that_it_is_a_mean(model):
    built = fresh(flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=3), model=model)
    rig = flexpm.rig(built)
    rig.confine(5e6)
    state = built.snapshot()
    assert state.stress_source == (OF_TRIANGLES if model == "flexible" else OF_GRAINS)
    means = state.grain_areas @ state.grain_stress / state.grain_areas.sum()
    np.testing.assert_allclose(means[:2], -5e6, atol=5e4)
    # plates of rigid grains do not turn, and may bear a little shear
    np.testing.assert_allclose(means, built.solver.balance()["mean_stress"], atol=5e3)
    middle = state.stress_at(state.reference.mean(axis=0))
    if model == "rigid":
        own = np.all(np.isclose(state.grain_stress, middle.stress[0], rtol=1e-12), axis=1)
        assert np.count_nonzero(own) == 1
