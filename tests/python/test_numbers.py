# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of users: anything that is none, or beyond sense, is refused in one line."""

from __future__ import annotations

import os

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused_command

import flexpm
from flexpm import InputError
from flexpm.cli import main as cli
from flexpm.materials import material as materials
from flexpm.materials.keys import UNITS
from flexpm.runs import loading_rate
from flexpm.runs.run_spec import RunSpec
from flexpm.specimens.spec import SpecimenSpec

NO_NUMBERS = [None, "1", True, 1j, np.complex128(1.0), np.timedelta64(1), [1.0], 10**400, 10**5000]
TINY = ["--width", "0.012", "--height", "0.024", "--quiet"]


@pytest.fixture(scope="module")
def small() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(0.012, 0.024, 0.01)


def one_line(call, *arguments, **options) -> str:
    with pytest.raises(InputError) as caught:
        call(*arguments, **options)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 600
    return str(caught.value)


@pytest.mark.parametrize("value", NO_NUMBERS, ids=lambda value: type(value).__name__)
def test_what_is_no_number_is_refused_everywhere(small, value):
    one_line(flexpm.Specimen.rectangle, 0.02, 0.04, value)
    one_line(flexpm.Specimen.rectangle, 0.02, 0.04, 0.01, porosity=value)
    one_line(flexpm.Specimen.rectangle, 0.02, 0.04, 0.01, diameters=(value, value))
    one_line(flexpm.Specimen.disc, 0.02, 0.01, seed=value)
    if value is not None:  # the default
        one_line(flexpm.build, small, damping=value)
    one_line(flexpm.build, small, threads=value)
    one_line(flexpm.build, small, points=value)
    for name in ("rate", "stop_ratio", "confinement", "gravity", "threads"):
        if name != "stop_ratio" or value is not None:  # that is the test's own
            one_line(flexpm.run, "biaxial", small, **{name: value})
    one_line(materials.load().with_set, young=value)


@pytest.mark.parametrize("key", [key for key, unit in UNITS.items() if unit])
@pytest.mark.parametrize("value", [1e-308, 1e308, 1e-41, 1e41])
def test_a_material_beyond_sense_is_refused(key, value):
    if not (key in ("friction", "poisson") and value < 1.0):
        one_line(materials.load("augig-table7").with_set, {key: value})


@pytest.mark.parametrize(
    ("name", "value"),
    [("rate", 1e-308), ("rate", 1e-320), ("max_strain", 1e-320), ("confinement", 1e300)],
)
def test_a_run_beyond_sense_is_refused(name, value):
    one_line(RunSpec, "biaxial", SpecimenSpec(), {}, **{name: value})


@pytest.mark.parametrize("arguments", ["--thickness 1e308", "--thickness 1e-300", "--width 1e99"])
def test_a_size_beyond_sense_is_refused(capsys, arguments):
    refused_command(capsys, "", "run", "uniaxial", *TINY, *arguments.split())


@pytest.mark.parametrize(
    "run", [("tension", "flexible"), ("uniaxial", "rigid"), ("tension", "jcfpm")]
)
def test_a_single_grain_that_needs_a_contact_is_refused(run):
    corners = [(0.0, 0.0), (0.01, 0.0), (0.01, 0.01), (0.0, 0.01)]
    alone = flexpm.Specimen.from_discs([(0.005, 0.005)], [0.004], corners, 0.01)
    assert "grains = 1, must be >= 2" in one_line(flexpm.run, run[0], alone, model=run[1])


def test_a_test_that_would_never_end_is_refused_with_its_steps(small):
    said = one_line(flexpm.run, "uniaxial", small, rate=1e-11)
    steps = float(said.removeprefix("run: steps = ").split(" ")[0])
    assert steps > loading_rate._MOST_STEPS


@pytest.mark.parametrize("threads", ["0", "-5", "5000", "100000000", "9" * 20, "1.5"])
def test_threads_are_those_of_the_machine(capsys, threads):
    refused_command(capsys, "threads", "run", "uniaxial", *TINY, "--threads", threads)
    assert os.cpu_count() < 5000


@pytest.mark.parametrize(
    "arguments",
    [
        {"specimen": None},
        {"points": 3.0},
        {"points": True},
        {"dynamic": "no"},
        {"mesh": np.zeros(3)},
        {"model": ["rigid"]},
    ],
)
def test_wrong_arguments_of_a_model_are_refused(small, arguments):
    one_line(flexpm.build, **{"specimen": small} | arguments)


def test_whole_numbers_of_numpy_are_taken(small):
    assert flexpm.build(small, points=np.int64(2), threads=np.int32(1)).solver.counts()["grains"]


@pytest.mark.parametrize("out", ["a\0b", "\udcff"])
def test_a_folder_of_no_valid_name_is_refused(small, out):
    one_line(flexpm.run, "uniaxial", small, out=out)


def test_values_of_a_material_are_given_in_four_ways():
    rock = materials.load()
    expected = rock.with_set(["friction=0.5", "cohesion=2e7"])
    assert rock.with_set({"friction": 0.5, "cohesion": 2e7}) == expected
    assert rock.with_set(friction=0.5, cohesion=2e7) == expected
    assert rock.with_set("friction=0.5").with_set("cohesion=2e7") == expected
    for wrong in (5, [5], {"frction": 1.0}, {5: 1.0}, "friction"):
        one_line(rock.with_set, wrong)


@given(
    st.lists(
        st.sampled_from(
            ["run", "elastic", "uniaxial", "biaxial", "--set", "young=1e9", "-1", "nan"]
        )
        | st.sampled_from(["--rate", "--threads", "--diameters", "--material", "--seed"])
        | st.text(max_size=6),
        max_size=6,
    )
)
def test_any_command_line_is_answered(arguments):
    """What is wrong has exit code 2; the option at the end keeps the right ones from running."""
    assert cli.main([*arguments, "--nothing"]) in (0, 2)
