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

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / "scripts" / "checks" / "releases"


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


@pytest.mark.skipif(shutil.which("git") is None, reason="needs git")
def test_both_roots_have_the_same_sources_whatever_is_edited_meanwhile(
    releases, tmp_path, monkeypatch
):
    unpacked = []

    class Root:
        def __init__(self, tarball: Path, sources: bytes, log: Path) -> None:
            unpacked.append(sources)
            self.path = tmp_path / f"root-{len(unpacked)}"
            (self.path / "src").mkdir(parents=True)
            (self.path / "out").mkdir()
            (self.path / "out" / "flexpm_1_amd64.deb").touch()

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def run(self, command, must=True):
            (tmp_path / "it.py").write_text("edited")
            facts = "2025.2.0 14.2.0 3.13.5" if "dpkg-query" in command else ""
            return subprocess.CompletedProcess(command, 0, stdout=facts)

    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    (tmp_path / "it.py").write_text("first")
    monkeypatch.setattr(releases, "Root", Root)
    monkeypatch.setattr(releases, "bare_root", lambda *_: tmp_path / "root.tar")
    assert releases.try_release("13")["result"].startswith("failed: reference commands")
    first, second = unpacked
    assert first == second
    assert b"first" in first


def test_wrong_names_of_releases_are_refused(releases, capsys):
    with pytest.raises(SystemExit):
        releases.main(["11"])
    assert re.search(r"choose from '?12'?, '?13'?, '?sid'?", capsys.readouterr().err)
