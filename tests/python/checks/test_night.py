# SPDX-License-Identifier: GPL-3.0-or-later
"""The driver of long checks: what has passed is not repeated, what failed is."""

from __future__ import annotations

import importlib.util
import sys
from importlib.machinery import SourceFileLoader
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[3] / "scripts" / "night"


@pytest.fixture
def night(tmp_path, monkeypatch):
    """The driver with two stages that only count how often they run."""
    loader = SourceFileLoader("night", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("night", loader))
    monkeypatch.setitem(sys.modules, "night", module)
    loader.exec_module(module)
    (tmp_path / "scripts").mkdir()
    setup = tmp_path / "scripts" / "setup"
    setup.write_text("#!/bin/sh\n")
    setup.chmod(0o755)
    stages = {
        "good": module.Stage("passes", [["sh", "-c", "echo good >> count"]]),
        "bad": module.Stage("fails", [["sh", "-c", "echo bad >> count; exit 5"], ["touch", "end"]]),
    }
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "OUT", tmp_path / "night-out")
    monkeypatch.setattr(module, "RECORD", tmp_path / "night.csv")
    monkeypatch.setattr(module, "STAGES", stages)
    monkeypatch.setattr(module, "sources", lambda: "abc")
    return module


def test_a_stage_that_has_passed_is_skipped_until_the_sources_change(night, tmp_path, monkeypatch):
    for _ in range(2):
        assert night.main([]) == 1
    assert (tmp_path / "count").read_text().split() == ["good", "bad", "bad"]
    assert not (tmp_path / "end").exists()
    rows = night.read()
    assert rows["good"][:2] == ("good", "abc")
    assert rows["bad"].result.startswith("failed: exit code 5 of sh")
    monkeypatch.setattr(night, "sources", lambda: "def")
    assert night.main(["good"]) == 0
    monkeypatch.setattr(night, "sources", lambda: "def+")
    assert night.main(["good"]) == 0  # nobody knows what was changed
    assert (tmp_path / "count").read_text().split().count("good") == 3
    assert [row.stage for row in night.read().values()] == ["good", "bad"]


def test_stages_are_listed_and_an_unknown_one_is_refused(night, capsys):
    assert night.main(["--list"]) == 0
    assert "passes" in capsys.readouterr().out
    with pytest.raises(SystemExit):
        night.main(["nosuch"])
    assert "stage = 'nosuch', must be one of good, bad" in capsys.readouterr().err
