# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations in the programs yade and yade-batch, in plain Python, and in the 3D window."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from processes import captured

from flexpm._plugin import yade_folder

ROOT = Path(__file__).resolve().parents[2]

SPECIMEN = "flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)"
JOB = f"""
import flexpm
result = flexpm.run("tension", {SPECIMEN}, rate=8.0)
print("peak", repr(result.peak_stress), result.status)
"""


def run(command: list[str], package_parent: Path, folder: Path) -> subprocess.CompletedProcess[str]:
    environment = dict(os.environ, PYTHONPATH=str(package_parent), OMP_NUM_THREADS="1")
    environment.pop("DISPLAY", None)
    return captured(command, cwd=folder, env=environment, timeout=600)


@pytest.mark.long
def test_every_program_computes_the_same(package_parent: Path, tmp_path: Path) -> None:
    (tmp_path / "job.py").write_text(JOB)
    batch = (
        "from yade import *\nutils.readParamsFromTable(rate=1.0, noTableOk=True)\n"
        "from yade.params.table import *\n" + JOB.replace("rate=8.0", "rate=rate")
    )
    (tmp_path / "batch.py").write_text(batch)
    (tmp_path / "table").write_text("rate !OMP_NUM_THREADS\n8.0 1\n4.0 1\n")
    texts = []
    for command in (["/usr/bin/python3", "job.py"], ["yade", "-n", "-x", "job.py"]):
        done = run(command, package_parent, tmp_path)
        assert done.returncode == 0, done.stderr
        texts.append(done.stdout)
    command = ["yade-batch", "-j1", "--job-threads=1", "table", "batch.py"]
    done = run(command, package_parent, tmp_path)
    # the program's own exit code is 0 even if a job failed
    assert done.returncode == 0 and "FAILED" not in done.stdout, done.stdout
    logs = sorted(tmp_path.glob("batch.py.*.log"))
    assert len(logs) == 2
    texts += [next(log.read_text() for log in logs if "rate=8" in log.name)]
    peaks = [line for text in texts for line in text.splitlines() if line.startswith("peak")]
    assert len(peaks) == 3 and len(set(peaks)) == 1, peaks


def test_a_failing_script_fails_the_program(package_parent: Path, tmp_path: Path) -> None:
    # YADE tells of no failure that comes before it begins to wait: the first check comes late
    text = (
        f"import flexpm\nmodel = flexpm.build({SPECIMEN})\nmodel.solver.checkPeriod = 20000\n"
        "O.bodies[3].shape.velocities[0, 0] = float('nan')\nO.run(30000, True)\n"
    )
    (tmp_path / "fails.py").write_text(text)
    done = run(["yade", "-n", "-x", "fails.py"], package_parent, tmp_path)
    assert done.returncode == 1
    assert "is not a finite number at step" in done.stdout + done.stderr


WINDOW = f"""
import flexpm, time
from yade import qt
from PyQt5.QtWidgets import QApplication
model = flexpm.build({SPECIMEN})
for body in O.bodies:
    body.shape.color = (0.9, 0.5 + 0.5 * (body.id % 2), 0.2)
stretch = {{stretch}}
for body in O.bodies:
    cell = body.shape
    cell.displacements[:, 1] = 1e-6 * stretch * cell.positions[:, 1]
O.step()
flexpm.Gl1_LaguerreCell.scale = 1e6
flexpm.Gl1_LaguerreCell.mesh = {{mesh}}
view = qt.View()
view.axes = False
qt.Renderer().bgColor = (1, 1, 1)
shot = qt.SnapshotEngine(fileBase="shot-", iterPeriod=1, deadTimeout=600)
O.engines = O.engines + [shot]
view.viewDir = (0, 0, -1)
view.upVector = (0, 1, 0)
view.fitAABB((-0.004, -0.002, 0), (0.016, 0.034, 0))
O.run(2)
while O.running:
    QApplication.processEvents()
    time.sleep(0.01)
print("drawn", shot.snapshots)
"""


def picture(package_parent: Path, folder: Path, stretch: float, mesh: bool) -> np.ndarray:
    """The window's last picture of grains stretched upwards, as (rows, columns, 3)."""
    folder.mkdir()
    (folder / "window.py").write_text(WINDOW.format(stretch=stretch, mesh=mesh))
    screen = "-screen 0 800x600x24"
    done = run(["xvfb-run", "-a", "-s", screen, "yade", "-x", "window.py"], package_parent, folder)
    assert done.returncode == 0 and "drawn" in done.stdout, done.stdout + done.stderr
    # on the left stand the axes and the clock
    return imread(max(folder.glob("shot-*.png")))[:, 120:, :3]


@pytest.mark.long
@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="needs xvfb-run (package xvfb)")
def test_the_window_draws_deformed_grains(package_parent: Path, tmp_path: Path) -> None:
    plain = picture(package_parent, tmp_path / "plain", 0.0, mesh=False)
    stretched = picture(package_parent, tmp_path / "stretched", 0.25, mesh=True)

    def height(image: np.ndarray) -> int:
        coloured = (image.max(axis=2) - image.min(axis=2) > 0.3).any(axis=1)
        return int(np.count_nonzero(coloured))

    def ink(image: np.ndarray) -> float:
        dark = image.max(axis=2) < 0.3
        coloured = image.max(axis=2) - image.min(axis=2) > 0.3
        return np.count_nonzero(dark) / np.count_nonzero(coloured)

    assert height(plain) > 100
    assert height(stretched) / height(plain) == pytest.approx(1.25, abs=0.015)
    assert ink(plain) > 0.01
    assert ink(stretched) > 2.0 * ink(plain)


@pytest.mark.long
@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="needs xvfb-run (package xvfb)")
@pytest.mark.parametrize("shown", ["stress_yy", "forces"])
def test_the_window_shows_values_with_their_scale_cracks_and_forces(
    package_parent: Path, tmp_path: Path, shown: str
) -> None:
    script = str(ROOT / "scripts" / "tutorials" / "window.py")
    command = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24", "yade", "-x", script]
    done = run([*command, shown, "shot-"], package_parent, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    image = imread(max(tmp_path.glob("shot-*.png")))[:, :, :3]
    image = image[int(0.15 * len(image)) :]  # below the axes, which have these colours, too

    def seen(*colour: float) -> int:
        return int(np.count_nonzero(np.abs(image - colour).max(axis=2) < 0.05))

    assert seen(0.0, 0.447, 0.698) > 100, "tensile cracks"
    assert seen(0.835, 0.369, 0.0) > 50, "shear cracks"
    if shown == "forces":
        assert seen(0.0, 0.0, 0.0) > 5 * seen(0.85, 0.1, 0.1) > 0
        return
    low, high = map(float, done.stdout.partition("range ")[2].split(" to "))
    assert low < -1e8 < high
    beside = int(0.61 * image.shape[1])  # the specimen ends left of it
    scale = image[:, beside:].reshape(-1, 3)  # all colours from the dark end to the bright one
    assert len(np.unique(scale.round(2), axis=0)) > 50
    assert seen(0.993, 0.906, 0.144) > 100


@pytest.mark.long
@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="needs xvfb-run (package xvfb)")
@pytest.mark.parametrize("shown", ["stress_zz", "cracks"])
def test_the_window_lays_a_solid_open(package_parent: Path, tmp_path: Path, shown: str) -> None:
    script = str(ROOT / "scripts" / "tutorials" / "window_solid.py")
    command = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24", "yade", "-x", script]
    done = run([*command, shown, "shot-"], package_parent, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    image = imread(max(tmp_path.glob("shot-*.png")))[:, :, :3]

    def seen(*colour: float) -> int:
        return int(np.count_nonzero(np.abs(image - colour).max(axis=2) < 0.05))

    tensile, shear = seen(0.0, 0.447, 0.698), seen(0.835, 0.369, 0.0)
    ink = np.count_nonzero(image.min(axis=2) < 0.95)
    if shown == "cracks":
        assert tensile > 2000 and shear > 200
        return
    assert tensile > 200, "lines of cracks in the section"
    # the section has the colours of the scale, unshaded, and hides the faces of cracks
    low, high = map(float, done.stdout.partition("range ")[2].split(" to "))
    assert low < -1e8 < high
    assert tensile + shear < 0.2 * ink
    assert len(np.unique(image.reshape(-1, 3).round(2), axis=0)) > 80


@pytest.mark.parametrize(("wrong", "code"), [(None, 0), (", specimen)", 1)])
def test_yades_list_of_checks_runs_that_of_flexpm(
    package_parent: Path, tmp_path: Path, wrong: str | None, code: int
) -> None:
    """As ``yade --check`` does, from a folder that holds this check alone."""
    checks = tmp_path / "checks"
    checks.mkdir()
    script = (ROOT / "scripts" / "yade-check" / "checkFlexpm.py").read_text()
    if wrong is not None:
        assert wrong in script
        script = script.replace(wrong, ", specimen, rate=200.0)")
    (checks / "checkFlexpm.py").write_text(script)
    # what the program yade has at hand where it runs the list
    (tmp_path / "driver.py").write_text(
        "from types import SimpleNamespace\n"
        "opts = SimpleNamespace(checkall=False, threads=None, cores=None)\n"
        f"checksPath = {str(checks)!r}\n"
        f"exec(open({str(yade_folder() / 'py/yade/tests/checks/checkList.py')!r}).read())\n"
    )
    done = run(["yade", "-n", "-x", "driver.py"], package_parent, tmp_path)
    assert done.returncode == code, done.stdout + done.stderr
    assert "running:  checkFlexpm.py" in done.stdout
    assert ("YadeCheckError :  flexpm: " in done.stdout) == (wrong is not None), done.stdout
