# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin loads silently, once, in every program that runs YADE, and leaves nothing behind."""

from __future__ import annotations

import importlib
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest
from processes import captured

PYTHON = "/usr/bin/python3"
USE = "import flexpm, yade\nassert all(hasattr(yade, name) for name in flexpm.load())\n"


def run(
    command: list[str], package_parent: Path, folder: Path, display: str | None = None
) -> subprocess.CompletedProcess[str]:
    environment = dict(os.environ, PYTHONPATH=str(package_parent), OMP_NUM_THREADS="1")
    environment.pop("DISPLAY", None)
    if display is not None:
        environment["DISPLAY"] = display
    return captured(command, cwd=folder, env=environment, timeout=600)


def test_plain_python_prints_nothing(package_parent: Path, tmp_path: Path) -> None:
    done = run([PYTHON, "-W", "error::UserWarning", "-c", USE], package_parent, tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_plain_python_removes_yades_folder(package_parent: Path, tmp_path: Path) -> None:
    code = "import flexpm, yade; O = yade.wrapper.Omega(); print(O.tmpFilename())"
    done = run([PYTHON, "-c", code], package_parent, tmp_path)
    folder = Path(done.stdout.strip()).parent
    assert folder.name.startswith("yade-") and folder.parent == Path(tempfile.gettempdir())
    assert not folder.exists()


def test_program_yade_says_the_same_with_and_without(package_parent: Path, tmp_path: Path) -> None:
    outputs = []
    for name, text in (("without.py", "pass\n"), ("with.py", USE)):
        (tmp_path / name).write_text(text)
        done = run(["yade", "-n", "-x", name], package_parent, tmp_path)
        assert done.returncode == 0, done.stderr
        lines = (done.stdout + done.stderr).splitlines()
        # ports and cookies of YADE's own servers differ from run to run
        changing = (name, "localhost:", "cookie", "XMLRPC", "TCP python")
        outputs.append([line for line in lines if not any(word in line for word in changing)])
    assert outputs[0] == outputs[1]


def test_names_reach_a_script_of_yade(package_parent: Path, tmp_path: Path) -> None:
    text = "from flexpm import *\nimport flexpm\nassert set(flexpm.load()) <= set(globals())\n"
    (tmp_path / "names.py").write_text(text)
    done = run(["yade", "-n", "-x", "names.py"], package_parent, tmp_path)
    assert done.returncode == 0, done.stderr


def test_yade_batch(package_parent: Path, tmp_path: Path) -> None:
    (tmp_path / "job.py").write_text(
        "from yade import *\nutils.readParamsFromTable(a=1, noTableOk=True)\n"
        "from yade.params.table import *\n" + USE + "print('a is', a)\n"
    )
    (tmp_path / "table").write_text("a\n1\n2\n")
    command = ["yade-batch", "-j1", "--job-threads=1", "table", "job.py"]
    done = run(command, package_parent, tmp_path)
    # the program's own exit code is 0 even if a job failed
    assert done.returncode == 0 and "FAILED" not in done.stdout, done.stdout
    logs = "".join(log.read_text() for log in tmp_path.glob("job.py.*.log"))
    assert "a is 1" in logs and "a is 2" in logs
    assert "flexpm" not in logs.replace(str(package_parent), "")


@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="needs xvfb-run (package xvfb)")
def test_3d_window_that_existed_before(package_parent: Path, tmp_path: Path) -> None:
    text = (
        "import sys\nassert 'yade.qt' in sys.modules, 'no window'\n" + USE + "from yade import qt\n"
        "view = qt.View()\nfrom PyQt5.QtWidgets import QApplication\n"
        "O.bodies.append(utils.sphere((0, 0, 0), 1))\n"
        "for _ in range(20):\n    QApplication.processEvents()\nprint('drawn')\n"
    )
    (tmp_path / "window.py").write_text(text)
    screen = "-screen 0 640x480x24"
    command = ["xvfb-run", "-a", "-s", screen, "yade", "-x", "window.py"]
    done = run(command, package_parent, tmp_path)
    assert done.returncode == 0 and "drawn" in done.stdout, done.stdout + done.stderr


def test_loading_again_changes_nothing() -> None:
    import yade

    import flexpm

    before = flexpm.load()
    known = list(yade.__all__)
    assert importlib.reload(flexpm).load() == before
    assert yade.__all__ == known


def test_deferred_loading_waits_for_the_first_use(package_parent: Path, tmp_path: Path) -> None:
    code = (
        "import os, sys\nos.environ['FLEXPM_DEFER'] = '1'\n"
        "import flexpm, flexpm.cli.main\nassert 'yade' not in sys.modules\n"
        "assert 'FLEXPM_DEFER' not in os.environ\n"  # else programs started from here had it
        "flexpm.GrainSolver()\nassert 'yade' in sys.modules\n"
    )
    done = run([PYTHON, "-c", code], package_parent, tmp_path)
    assert done.returncode == 0, done.stderr


def test_ipython_is_imported_by_those_alone_who_use_it(
    package_parent: Path, tmp_path: Path
) -> None:
    code = (
        "import sys, flexpm, yade.runtime\n"
        "assert not [name for name in sys.modules if name.startswith('IPython')]\n"
        "import IPython\n"
        "major, minor = IPython.version_info[:2]\n"
        "assert yade.runtime.ipython_version == 100 * major + minor\n"
        "assert callable(IPython.embed)\n"
    )
    done = run([PYTHON, "-c", code], package_parent, tmp_path)
    assert done.returncode == 0, done.stderr


def test_public_names_can_be_completed(package_parent: Path, tmp_path: Path) -> None:
    names = (
        "run build elastic compare Specimen Material Model Result InputError SimulationError "
        "materials strength study plot export GrainSolver load"
    )
    code = (
        f"import flexpm\nnames = {names.split()}\n"
        "assert set(names) <= set(dir(flexpm))\n"
        "assert {'os', 'annotations', 'Any', 'TYPE_CHECKING'}.isdisjoint(dir(flexpm))\n"
        "for name in names: getattr(flexpm, name)\n"
    )
    done = run([PYTHON, "-c", code], package_parent, tmp_path)
    assert done.returncode == 0, done.stderr


def test_unknown_name_is_an_attribute_error() -> None:
    import flexpm

    with pytest.raises(AttributeError, match="NoSuchClass"):
        flexpm.NoSuchClass  # noqa: B018


def test_yade_is_not_shadowed_by_the_working_folder(package_parent: Path, tmp_path: Path) -> None:
    (tmp_path / "yade.py").write_text("raise RuntimeError('shadow')\n")
    (tmp_path / "use.py").write_text(USE)
    done = run([PYTHON, "-P", "use.py"], package_parent, tmp_path)
    assert done.returncode == 0, done.stderr
