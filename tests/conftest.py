# SPDX-License-Identifier: GPL-3.0-or-later
"""Common to all Python tests: one thread, and a clean scene for each test."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import hypothesis
import pytest

# must be set before YADE is loaded; scripts/test sets it too
os.environ.setdefault("OMP_NUM_THREADS", "1")

# an example takes as long as a busy machine needs; they are drawn by night and are the same each
# time by day, so that a change is judged by what it has changed
hypothesis.settings.register_profile("day", deadline=None, derandomize=True)
hypothesis.settings.register_profile("night", deadline=None)
hypothesis.settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE") or "day")

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(autouse=True)
def _clean_scene() -> Iterator[None]:
    yield
    if "yade" in sys.modules:
        sys.modules["yade"].wrapper.Omega().reset()


@pytest.fixture(scope="session")
def package_parent() -> Path:
    """Folder that holds the package under test, for the PYTHONPATH of child processes."""
    import flexpm

    return Path(flexpm.__file__).parent.parent


@pytest.fixture(scope="session")
def build_folder(package_parent: Path) -> Path:
    """The build under test, for tests of building and installing."""
    if not (package_parent.parent / "CMakeCache.txt").is_file():
        pytest.skip("flexpm is installed, needs a build folder")
    return package_parent.parent


@pytest.fixture(scope="session")
def launcher(package_parent: Path) -> list[str]:
    """The command flexpm of the package under test, as a user starts it."""
    build = package_parent.parent
    if (build / "CMakeCache.txt").is_file():
        return ["env", f"FLEXPM_BUILD_DIR={build}", str(ROOT / "scripts" / "flexpm")]
    command = shutil.which("flexpm")
    assert command is not None, "flexpm is installed without its command"
    return [command]
