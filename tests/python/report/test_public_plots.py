# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of a state that scripts draw with ``flexpm.plot``."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from matplotlib.collections import PolyCollection, TriMesh
from matplotlib.figure import Figure
from matplotlib.image import imread
from refusals import refusal
from sample_snapshot import GRADIENT, STRESS, wall

import flexpm
from flexpm.results.stress.point_stress import OF_GRAINS

MAPS = ("cracks", "fragments", "stress", "displacement")


@pytest.mark.parametrize("name", MAPS)
def test_each_map_is_a_figure_and_a_picture_if_it_has_a_path(name, tmp_path):
    figure = getattr(flexpm.plot, name)(wall(), caption="a wall")
    assert isinstance(figure, Figure)
    assert figure.axes[0].get_title(loc="left").startswith("a wall")
    assert list(tmp_path.iterdir()) == []
    getattr(flexpm.plot, name)(wall(), path=tmp_path / "map.png")
    assert imread(tmp_path / "map.png").std() > 0.01


def drawn(figure, kind):
    return next(one for one in figure.axes[0].collections if type(one) is kind)


@pytest.mark.parametrize(
    ("component", "wanted"),
    [
        ("xx", STRESS[0]),
        ("yy", STRESS[1]),
        ("xy", STRESS[2]),
        ("principal_1", np.linalg.eigvalsh([[STRESS[0], STRESS[2]], [STRESS[2], STRESS[1]]])[1]),
        ("principal_2", np.linalg.eigvalsh([[STRESS[0], STRESS[2]], [STRESS[2], STRESS[1]]])[0]),
    ],
)
def test_a_map_of_stress_has_each_triangle_in_mpa_and_a_scale_with_zero_in_its_middle(
    component, wanted
):
    figure = flexpm.plot.stress(wall(), component)
    cells = drawn(figure, PolyCollection)
    np.testing.assert_allclose(cells.get_array(), np.full(48, 1e-6 * wanted), rtol=1e-12)
    low, high = cells.get_clim()
    assert low == -high
    assert high == pytest.approx(1e-6 * abs(wanted))
    assert figure.axes[1].get_ylabel().endswith("[MPa]")


def test_a_map_of_stress_says_that_rigid_grains_have_means():
    rigid = dataclasses.replace(wall(), stress_source=OF_GRAINS)
    assert flexpm.plot.stress(rigid).axes[0].get_title(loc="left") == OF_GRAINS
    assert flexpm.plot.stress(wall()).axes[0].get_title(loc="left") == ""


@pytest.mark.parametrize("component", ["size", "x", "y"])
def test_a_map_of_displacement_has_each_node_in_micrometres(component):
    state = wall()
    figure = flexpm.plot.displacement(state, component)
    moved = 1e6 * state.reference @ GRADIENT.T
    wanted = {"size": np.hypot(*moved.T), "x": moved[:, 0], "y": moved[:, 1]}[component]
    np.testing.assert_allclose(drawn(figure, TriMesh).get_array(), wanted, atol=1e-9)


@pytest.mark.parametrize("name", MAPS)
def test_what_cannot_be_drawn_is_refused_in_one_line(name):
    draw = getattr(flexpm.plot, name)
    refusal("must be a state", draw, {"positions": 0})
    lost = dataclasses.replace(wall(), positions=np.full((60, 2), np.nan))
    refusal("are not finite", draw, lost)


def test_components_are_named_and_old_names_stay():
    refusal("must be one of xx, yy", flexpm.plot.stress, wall(), "zz")
    refusal("must be one of size, x, y", flexpm.plot.displacement, wall(), "z")
    for name in ("curve_picture", "peak_place", "places_of", "principal_stresses"):
        assert callable(getattr(flexpm.plot, name))
    assert flexpm.export.principal_stresses is flexpm.plot.principal_stresses
