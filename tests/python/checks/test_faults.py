# SPDX-License-Identifier: GPL-3.0-or-later
"""Disks that fail: a draw of the faults that scripts/checks/faults.py tries all of by night."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest
from processes import captured

import flexpm

SCRIPT = Path(__file__).parents[3] / "scripts" / "checks" / "faults.py"


@pytest.mark.long
@pytest.mark.skipif(shutil.which("strace") is None, reason="needs strace")
@pytest.mark.parametrize(
    ("campaign", "draw"),
    [("run", 3), ("core", 1), ("study", 1)],
)
def test_nothing_finished_is_lost_and_nothing_half_written_is_read(campaign, draw, build_folder):
    command = [sys.executable, SCRIPT, campaign, "--draw", str(draw), "--build", build_folder]
    done = captured(command)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    assert f"{draw} faults" in done.stdout


def test_a_grid_reaches_the_disk_by_way_of_python(tmp_path):
    """VTK does not tell that a disk refused a part of what it wrote."""
    small = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    flexpm.export.write_vtu(tmp_path / "grid.vtu", flexpm.build(small).snapshot())
    content = (tmp_path / "grid.vtu").read_bytes()
    assert content.startswith(b"<?xml") and content.endswith(b"</VTKFile>\n")


#: Writes a grid where no file may be longer than so many bytes.
LIMITED = """
import resource, sys
import flexpm
state = flexpm.build(flexpm.Specimen.{specimen}).snapshot()
resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))
flexpm.export.write_vtu(sys.argv[1], state)
"""


@pytest.mark.parametrize(
    ("specimen", "most"),
    [
        ("rectangle(0.012, 0.024, 0.01)", 1000),
        ("box(0.009, 0.009, 0.009)", 1000),
        ("box(0.009, 0.009, 0.009)", 60_000),  # some arrays have room
    ],
)
def test_a_grid_that_is_refused_leaves_no_file(package_parent, tmp_path, specimen, most):
    done = captured(
        [
            *(sys.executable, "-c", LIMITED.format(specimen=specimen, most=most)),
            str(tmp_path / "grid.vtu"),
        ],
        env={**os.environ, "PYTHONPATH": str(package_parent)},
    )
    assert "OSError: [Errno 27]" in done.stderr
    assert str(tmp_path / "grid.vtu") in done.stderr
    assert list(tmp_path.iterdir()) == []
