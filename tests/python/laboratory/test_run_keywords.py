# SPDX-License-Identifier: GPL-3.0-or-later
"""Keywords of run(): declared once, listed in its help, refused in one line if unknown."""

import inspect
import re
from dataclasses import fields

import pytest
from refusals import refusal

import flexpm
from flexpm.cli.main import command
from flexpm.kinds.registry import TESTS, options
from flexpm.runs import groups
from flexpm.runs.run_inputs import RunInputs

GROUPS = (groups.GrainOptions, groups.LoadingOptions, groups.OutputOptions)
DECLARED = {name for group in GROUPS for name in groups.options_of(group)}


def test_typed_keywords_are_those_that_are_declared():
    typed = set(groups.RunOptions.__annotations__)
    assert typed == (DECLARED | set(groups.OWN_OPTIONS)) - {"model"}
    assert typed - set(groups.SharedOptions.__annotations__) == {"confinement"}


def test_each_field_of_a_run_is_of_one_group():
    of_groups = [one.name for group in (*GROUPS[:2], groups.TestOptions) for one in fields(group)]
    assert len(of_groups) == len(set(of_groups))
    ours = {one.name for one in fields(RunInputs)} - {"test", "specimen", "material"}
    assert ours == set(of_groups)
    of_tests = {one.name for one in fields(groups.TestOptions)}
    assert of_tests - {"own"} <= set(options())


def test_run_has_few_parameters_and_its_help_names_all_keywords():
    assert len(inspect.signature(flexpm.run).parameters) <= 12
    text = flexpm.run.__doc__
    for name in groups.RunOptions.__annotations__:
        assert (
            len(re.findall(rf"^        {name}: [^\n]+(?:\n            [^\n]+)*", text, re.M)) == 1
        )
    for test in TESTS:
        assert f"* ``{test}`` (" in text
    assert "{" not in text
    for name, unit in (("gravity", "m/s2"), ("span", "m"), ("normal_stress", "Pa")):
        entry = re.search(rf"^        {name}: (.*(?:\n            .*)*)", text, re.M)[1]
        assert f"[{unit}]" in entry and " Default: " in " ".join(entry.split())


def test_the_command_has_the_options_of_the_groups():
    there = {name for one in command.commands["run"].params for name in one.opts}
    asked = (DECLARED | set(options())) - {"report"}
    assert {f"--{name.replace('_', '-')}" for name in asked} <= there


@pytest.mark.parametrize(
    ("keyword", "told"),
    [
        ({"confinment": 1e6}, "run: option = 'confinment', unknown"),
        ({"points": None}, "points = None"),
        ({"start": "slow"}, "run: start = 'slow', must be one of rest, static"),
        ({"frames": -1}, "run: frames = -1, must be >= 0"),
    ],
)
def test_wrong_keywords_are_refused_in_one_line(keyword, told):
    specimen = flexpm.Specimen.rectangle(0.01, 0.02, 0.01, seed=1)
    refusal(rf"^[^\n]*{told}[^\n]*$", flexpm.run, "uniaxial", specimen, **keyword)


def test_options_that_follow_from_the_test_may_be_none():
    specimen = flexpm.Specimen.rectangle(0.008, 0.012, 0.01, seed=1)
    open_ones = {"start": None, "loading": None, "stop_ratio": None, "control": None}
    result = flexpm.run("tension", specimen, rate=16.0, max_strain=1e-5, **open_ones)
    assert result.inputs["start"] == "static"
    assert result.inputs["loading"] == "waiting"
    assert result.inputs["stop_ratio"] == 0.5
