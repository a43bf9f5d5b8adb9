# SPDX-License-Identifier: GPL-3.0-or-later
"""The check of Debian's releases: its table, what it reports of a mirror that fails, its steps."""

from __future__ import annotations

import csv
import importlib.util
import re
import shutil
import subprocess
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]
SCRIPT = REPOSITORY / "scripts" / "checks" / "releases"


@pytest.fixture
def releases(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The script as a module, with its files below a temporary folder."""
    loader = SourceFileLoader("releases", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("releases", loader))
    # the compiled file would lie beside the script
    monkeypatch.setattr("sys.dont_write_bytecode", True)
    loader.exec_module(module)
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "LOGS", tmp_path / "build-releases")
    monkeypatch.setattr(module.os, "getuid", lambda: 0)
    monkeypatch.setattr(module.shutil, "which", lambda name: name)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return module


def test_a_mirror_that_fails_is_a_row_with_its_message_and_without_its_name(
    releases, tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(releases, "_mirror", lambda: "http://none.invalid/debian")
    error = "I: starting\nE: http://none.invalid/debian trixie: cannot be resolved\n"
    failed = subprocess.CompletedProcess([], 25, stdout="", stderr=error)
    monkeypatch.setattr(releases.subprocess, "run", lambda *_, **__: failed)
    table = tmp_path / "releases.csv"
    table.write_text(",".join(releases.FIELDS) + "\n" + ",".join(["12"] * len(releases.FIELDS)))
    assert releases.main(["13", "--table", str(table)]) == 75
    with table.open(newline="") as file:
        old, new = csv.DictReader(file)
    assert old["release"] == "12" and new["release"] == "13"
    assert new["result"] == (
        "not tried: root of trixie: E: mirror:/debian trixie: cannot be resolved"
    )
    assert "http://none.invalid" in capsys.readouterr().err


def test_a_bare_root_is_kept_for_a_week(releases, monkeypatch, tmp_path):
    monkeypatch.setattr(releases, "_mirror", lambda: "mirror:/debian")
    made = []

    def make(command, **_):
        made.append(command)
        Path(command[4]).write_text("root")
        return subprocess.CompletedProcess(command, 0, stdout="", stderr="")

    monkeypatch.setattr(releases.subprocess, "run", make)
    tarball = releases.bare_root("trixie")
    assert releases.bare_root("trixie") == tarball == tmp_path / "cache/flexpm/root-trixie.tar"
    assert len(made) == 1
    now = releases.time.time()
    monkeypatch.setattr(releases.time, "time", lambda: now + releases.WEEK + 1.0)
    releases.bare_root("trixie")
    assert len(made) == 2
    assert not any("Check-Valid-Until" in word for word in made[-1])
    # an index that has expired is taken only when asked for, and kept apart
    assert releases.bare_root("sid", stale=True).name == "root-sid-stale.tar"
    assert any("Check-Valid-Until" in word for word in made[-1])


def test_the_steps_are_those_of_the_dockerfile(releases):
    build, install = releases.docker_steps()
    assert any("scripts/package /out" in step for step in build)
    assert any("install" in step and "/out/flexpm_*.deb" in step for step in install)
    text = releases.DOCKERFILE.read_text()
    assert text.count("\nRUN ") == len(build) + len(install)


@pytest.fixture
def roots(releases, tmp_path, monkeypatch):
    """Roots that only note what is run in them, and the sources that each one gets."""
    made = []

    class Root:
        def __init__(self, tarball: Path, sources: bytes, log: Path) -> None:
            self.sources, self.commands = sources, []
            made.append(self)
            self.path = tmp_path / f"root-{len(made)}"
            (self.path / "src").mkdir(parents=True)
            (self.path / "out").mkdir()
            (self.path / "out" / "flexpm_1_amd64.deb").touch()

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def run(self, command, must=True):
            self.commands.append(command)
            (tmp_path / "it.py").write_text("edited")
            if "dpkg-query" in command:
                text = "2025.2.0 14.2.0 3.13.5"
            elif "scripts/test" in command:
                text = "12 passed, 3 skipped in 1.0s\ntest: all passed"
            elif "--collect-only" in command:
                text = "tests/test_one.py::test_one\n12 tests collected in 1.0s"
            elif "reference.py" in command:
                text = "reference: 9 runs, no change"
            else:
                text = ""
            return subprocess.CompletedProcess(command, 0, stdout=text)

    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    (tmp_path / "it.py").write_text("first")
    monkeypatch.setattr(releases, "Root", Root)
    monkeypatch.setattr(releases, "bare_root", lambda *_: tmp_path / "root.tar")
    return made


@pytest.mark.skipif(shutil.which("git") is None, reason="needs git")
def test_both_roots_have_the_same_sources_whatever_is_edited_meanwhile(releases, roots):
    assert releases.try_release("13")["result"] == "passed"
    first, second = roots
    assert first.sources == second.sources
    assert b"first" in first.sources


@pytest.mark.skipif(shutil.which("git") is None, reason="needs git")
def test_the_commands_of_the_readme_come_first_in_a_bare_root(releases, roots):
    row = releases.try_release("13")
    assert roots[0].commands[:2] == list(releases.README_COMMANDS)
    promised = (REPOSITORY / "README.md").read_text()
    for command in releases.README_COMMANDS:
        assert f"\n    {command.split()[0]} " in promised
    assert (row["sources"], row["fast tests"], row["result"]) == ("12 passed",) * 2 + ("passed",)
    assert "scripts/test --installed --fast" in roots[1].commands


@pytest.mark.skipif(shutil.which("git") is None, reason="needs git")
def test_a_clone_can_be_tried_without_a_package(releases, roots):
    row = releases.try_release("12", clone=True)
    (root,) = roots
    assert not any("scripts/package" in command for command in root.commands)
    assert not any("scripts/test" in command for command in root.commands)
    found = (row["sources"], row["doctor"], row["result"])
    assert found == ("12 tests collected in 1.0s", "-", "passed")


def test_wrong_names_of_releases_are_refused(releases, capsys):
    with pytest.raises(SystemExit):
        releases.main(["11"])
    assert re.search(r"choose from '?12'?, '?13'?, '?sid'?", capsys.readouterr().err)
