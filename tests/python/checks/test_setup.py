# SPDX-License-Identifier: GPL-3.0-or-later
"""The set-up says in one line what is missing and how to cure it, and keeps no half-made files."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest
from processes import captured

ROOT = Path(__file__).resolve().parents[3]


def version_of_headers() -> str:
    """The version of YADE whose headers this release takes, as the script itself finds it."""
    script = (ROOT / "scripts" / "yade-headers").read_text()
    (pinned,) = re.findall(r"^    version=(\S+) source_suite=", script, re.MULTILINE)
    if "VERSION_CODENAME=bookworm" in Path("/etc/os-release").read_text():
        return pinned
    command = ["dpkg-query", "-W", "-f", "${source:Upstream-Version}", "yade"]
    return captured(command, check=True).stdout


VERSION = version_of_headers()


def headers(cache: Path, fakes: Path | None = None) -> subprocess.CompletedProcess[str]:
    path = os.environ["PATH"] if fakes is None else f"{fakes}:{os.environ['PATH']}"
    command = [str(ROOT / "scripts/yade-headers"), str(cache)]
    environment = dict(os.environ, PATH=path)
    return captured(command, env=environment, timeout=600)


def unreachable_mirror(folder: Path) -> Path:
    """An apt-get that knows a mirror and delivers nothing, as on a machine without a network."""
    folder.mkdir()
    program = folder / "apt-get"
    program.write_text(
        '#!/bin/sh\n[ "$1" = indextargets ] && echo "Debian|main|mirror:/none|bookworm" && exit 0\n'
        'echo "E: Could not resolve the mirror" >&2\nexit 100\n'
    )
    program.chmod(0o755)
    return folder


def test_headers_in_the_cache_are_used(tmp_path: Path) -> None:
    scene = tmp_path / f"yade-{VERSION}" / "core" / "Scene.hpp"
    scene.parent.mkdir(parents=True)
    scene.write_text("")
    done = headers(tmp_path, unreachable_mirror(tmp_path / "bin"))
    assert (done.returncode, done.stdout.strip()) == (0, str(tmp_path / f"yade-{VERSION}"))


def test_unreachable_mirror_names_the_remedy(tmp_path: Path) -> None:
    done = headers(tmp_path / "cache", unreachable_mirror(tmp_path / "bin"))
    assert done.returncode == 1 and done.stdout == ""
    last = done.stderr.splitlines()[-1]
    assert last.startswith("setup: ") and "mirror:/none" in last and "YADE_SOURCE_DIR" in last


def test_damaged_archive_is_not_unpacked(tmp_path: Path) -> None:
    fakes = unreachable_mirror(tmp_path / "bin")
    archive = f"yade_{VERSION}.orig.tar.bz2"
    (fakes / "apt-get").write_text(
        f"""#!/bin/sh
case "$*" in
    indextargets*) echo "Debian|main|mirror:/one|bookworm" ;;
    *--print-uris*) echo "'mirror:/one/{archive}' {archive} 7 SHA256:{"0" * 64}" ;;
    *--download-only*) printf "cut off" > {archive} ;;
esac
"""
    )
    cache = tmp_path / "cache"
    done = headers(cache, fakes)
    assert done.returncode == 1 and not (cache / f"yade-{VERSION}").exists()
    last = done.stderr.splitlines()[-1]
    assert last.startswith(f"setup: checksum of {archive} = wrong") and "YADE_SOURCE_DIR" in last


# needs the build, since the set-up would install what is missing for one
@pytest.mark.usefixtures("build_folder")
def test_wrong_source_folder_is_refused(tmp_path: Path) -> None:
    environment = dict(os.environ, YADE_SOURCE_DIR=str(tmp_path), FLEXPM_BUILD_DIR=str(tmp_path))
    command = [str(ROOT / "scripts/setup")]
    done = captured(command, env=environment, timeout=600)
    assert done.returncode == 1
    assert f"YADE_SOURCE_DIR = {tmp_path}" in done.stderr.splitlines()[-1]


@pytest.mark.parametrize(
    "script",
    ["setup", "test", "quickstart", "package", "yade-headers"]
    + [f"checks/{name}" for name in ("sanitize", "compilers", "format", "types")],
)
def test_a_script_that_is_asked_for_help_does_nothing_else(script: str, tmp_path: Path) -> None:
    done = captured([ROOT / "scripts" / script, "--help"], cwd=tmp_path, timeout=600)
    assert (done.returncode, done.stderr, list(tmp_path.iterdir())) == (0, "", [])
    text = (ROOT / "scripts" / script).read_text()
    assert len(done.stdout.splitlines()) >= 3
    assert all(f"# {line}".rstrip() in text for line in done.stdout.splitlines())
    assert "set -euo" not in done.stdout


def test_the_quickstart_names_what_a_run_leaves() -> None:
    text = (ROOT / "scripts" / "quickstart").read_text()
    named = re.findall(r"^describe (\S+) ", text, re.MULTILINE)
    assert named[0] == "report.html"
    assert {"result.json", "curve.csv", "cracks.png", "fragments.png", "events.png"} <= {*named}


def test_flexpm_is_installed_below_any_prefix_and_removed_again(
    tmp_path: Path, build_folder: Path
) -> None:
    manifest = build_folder / "install_manifest.txt"
    before = manifest.read_text() if manifest.exists() else None
    try:
        command = ["cmake", "--install", str(build_folder), "--prefix", str(tmp_path)]
        subprocess.run(command, check=True, capture_output=True)
        (tmp_path / "manifest").write_text(manifest.read_text())
    finally:
        manifest.unlink() if before is None else manifest.write_text(before)
    plain = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    found = captured([tmp_path / "bin" / "flexpm", "--version"], env=plain)
    assert (found.returncode, found.stdout.split()[0]) == (0, "flexpm"), found.stderr
    script = ROOT / "cmake" / "Uninstall.cmake"
    removal = ["cmake", f"-DMANIFEST={tmp_path / 'manifest'}", "-P", str(script)]
    subprocess.run(removal, check=True, capture_output=True)
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]
    assert subprocess.run(removal, capture_output=True).returncode != 0


def test_a_package_is_not_compiled_without_its_optimiser(tmp_path: Path) -> None:
    """PyPI is asked before the compiler, which takes minutes, and no folder is configured."""
    surroundings = {
        **os.environ,
        "FLEXPM_BUILD_DIR": str(tmp_path / "build"),
        "FLEXPM_NEEDS_OPTIMISER": "1",
        "PIP_INDEX_URL": "http://127.0.0.1:9/simple",
        "PIP_RETRIES": "0",
        "PIP_NO_CACHE_DIR": "1",
    }
    done = captured([str(ROOT / "scripts/setup")], env=surroundings, timeout=600)
    assert done.returncode == 1
    assert "setup: optimiser = DFO-LS" in done.stderr.splitlines()[-1]
    assert not (tmp_path / "build" / "CMakeCache.txt").exists()
    assert "FLEXPM_NEEDS_OPTIMISER=1" in (ROOT / "scripts/package").read_text()


def test_a_package_has_the_study_files_that_pages_name() -> None:
    rules = (ROOT / "cmake" / "FlexpmPackage.cmake").read_text()
    (rule,) = re.findall(r"install\(DIRECTORY [^)]*scripts/studies[^)]*\)", rules)
    patterns = [one for one in re.findall(r'PATTERN "([^"]*)"', rule) if one != "__pycache__"]
    pages = "".join(page.read_text() for page in (ROOT / "doc").rglob("*.rst"))
    named = set(re.findall(r"scripts/studies/([\w.]+\.(?:toml|table))", pages))
    named |= {"cohesion.table", "cohesion_batch.py"}
    assert {"augig_flexible.toml", "cohesion.toml"} <= named
    for name in named:
        assert (ROOT / "scripts" / "studies" / name).is_file()
        assert any(Path(name).match(pattern) for pattern in patterns), name
