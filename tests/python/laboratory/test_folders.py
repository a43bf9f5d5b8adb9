# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders that hold results of others: refused in one line, and nothing there is replaced."""

from __future__ import annotations

import json

import pytest
from refusals import refused_command

from flexpm.cli import main as cli
from flexpm.runs.output import KINDS, RESULT

SIZE = ["--width", "0.012", "--height", "0.016", "--quiet"]
SOON = ["--max-strain", "1e-6", "--rate", "50"]
PLAN = '[common]\ntest = "elastic"\nwidth = 0.012\nheight = 0.016\n[grid]\nseed = [1]\n'


@pytest.fixture
def commands(tmp_path):
    (tmp_path / "plan.toml").write_text(PLAN)
    return {
        "run": ["run", "tension", *SIZE, *SOON],
        "packings": ["run", "tension", *SIZE, *SOON, "--seeds", "1-2"],
        "compare": ["compare", "tension", *SIZE, *SOON, "--models", "rigid"],
        "study": ["study", str(tmp_path / "plan.toml"), "--quiet"],
        "elastic": ["elastic", *SIZE],
    }


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}


@pytest.mark.parametrize("first", KINDS.values())
@pytest.mark.parametrize("then", ["run", "packings", "compare", "study", "elastic"])
def test_results_of_another_kind_are_not_replaced(capsys, tmp_path, commands, first, then):
    name = next(name for name, kind in KINDS.items() if kind == first)
    if first == {"elastic": "run"}.get(then, then):
        pytest.skip("the same kind")
    out = tmp_path / "out"
    out.mkdir()
    (out / name).write_text("{}")
    (out / "report.html").write_text("of others")
    refused_command(capsys, "has results of", *commands[then], "--out", out)
    assert contents(out) == {name: b"{}", "report.html": b"of others"}


def test_packings_do_not_go_into_the_folder_of_a_run_that_has_begun(capsys, tmp_path, commands):
    (tmp_path / "checkpoint.json").write_text("{}")
    refused_command(capsys, "has results of run", *commands["packings"], "--out", tmp_path)


@pytest.mark.parametrize("discard", [False, True])
@pytest.mark.parametrize("content", ['{"mine": 1}', "[1, 2]", '{"inputs": {}}'])
def test_a_result_of_another_program_is_not_replaced(capsys, tmp_path, commands, content, discard):
    (tmp_path / RESULT).write_text(content)
    options = ["--discard-checkpoint"] if discard else []
    assert cli.main([*commands["run"], *options, "--out", str(tmp_path)]) == 2
    assert "of another program, which would be replaced" in capsys.readouterr().err
    assert (tmp_path / RESULT).read_text() == content
    if not discard:
        assert cli.main([*commands["elastic"], "--out", str(tmp_path)]) == 2
        assert (tmp_path / RESULT).read_text() == content


def test_a_result_of_another_run_is_replaced_if_that_is_asked_for(capsys, tmp_path, commands):
    out = ["--out", str(tmp_path)]
    assert cli.main([*commands["elastic"], *out]) == 0
    assert cli.main([*commands["elastic"], *out]) == 0  # the same one again
    before = contents(tmp_path)
    refused_command(capsys, "", *commands["elastic"], "--model", "rigid", *out)
    refused_command(capsys, "of another run, which would be replaced", *commands["run"], *out)
    assert contents(tmp_path) == before
    assert cli.main([*commands["run"], "--discard-checkpoint", *out]) == 3
    assert json.loads((tmp_path / RESULT).read_text())["test"] == "tension"
    # what was cut is no result of others
    (tmp_path / RESULT).write_text('{"flexpm"')
    assert cli.main([*commands["run"], "--discard-checkpoint", *out]) == 3
    assert cli.main([*commands["run"], *out]) == 3
