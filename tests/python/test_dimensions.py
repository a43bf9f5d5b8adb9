# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of features by dimension names what exists, and 3D specimens refuse what it says."""

import re

import pytest

import flexpm
from flexpm.cli.main import command
from flexpm.dimensions import FEATURES, SOLIDS
from flexpm.kinds.registry import KINDS
from flexpm.runs.input_names import OF_THE_PLANE
from flexpm.specimens.one_dimension import PlaneOnly, SolidOnly
from flexpm.specimens.space.any_spec import SIZES
from flexpm.specimens.space.spec import SIZES as SOLID_SIZES

ASKED = [asked for feature in FEATURES.values() for asked in feature.asked]
REFUSED = [name for name, one in vars(PlaneOnly).items() if callable(one)]


def test_shapes_are_those_of_the_specimens():
    assert tuple(SOLID_SIZES) == SOLIDS
    assert {shape for kind in KINDS.values() for shape in kind.variants} <= set(SIZES)


def test_options_and_calls_that_ask_for_a_feature_exist():
    options = {name for one in command.commands["run"].params for name in one.opts}
    text = " ".join(ASKED)
    assert set(re.findall(r"--[\w-]+", text)) <= options
    calls = re.findall(r"(\w+)\.(\w+)", text)
    assert len(calls) >= 6
    assert all(hasattr(getattr(flexpm, name), call) for name, call in calls)
    assert set(OF_THE_PLANE) <= set(FEATURES)


@pytest.mark.parametrize("name", REFUSED)
def test_a_solid_refuses_the_calls_of_features_in_2d(name):
    (feature,) = (one for one in FEATURES.values() if f"Specimen.{name}" in one.asked)
    solid = flexpm.Specimen.box(0.008, 0.008, 0.01)
    told = f"Specimen.{name}: specimen = box, must be 2D: {feature.refusal}"
    with pytest.raises(flexpm.InputError, match=f"^{re.escape(told)}$"):
        getattr(solid, name)()


@pytest.mark.parametrize("name", [n for n, one in vars(SolidOnly).items() if callable(one)])
def test_a_plane_specimen_refuses_the_calls_of_features_in_3d(name):
    (feature,) = (one for one in FEATURES.values() if name in " ".join(one.asked))
    told = f"Specimen.{name}: specimen = disc, must be 3D: {feature.refusal}"
    with pytest.raises(flexpm.InputError, match=f"^{re.escape(told)}$"):
        getattr(flexpm.Specimen.disc(0.01, thickness=0.01, seed=1), name)([0])


def test_a_disc_refuses_the_jaws_of_a_named_test_as_the_table_says():
    disc = flexpm.Specimen.disc(0.01, thickness=0.01, seed=1)
    told = re.escape(FEATURES["jaw_radius"].refusal)
    with pytest.raises(flexpm.InputError, match=f"jaw_radius = 0.01 m, .* for a disc: {told}$"):
        flexpm.run("brazilian", disc, jaw_radius=0.01)
