# SPDX-License-Identifier: GPL-3.0-or-later
"""Files are whole or absent, their folders can be written to; cracks of a snapshot in order."""

import dataclasses

import numpy as np
import pytest
from refusals import refusal
from sample_rows import row
from sample_snapshot import FIRST, wall

from flexpm.files import output_folder, whole_file
from flexpm.results.cracks import cracks_csv, cracks_from_snapshot
from flexpm.results.record import Curve


def test_cracks_of_a_snapshot_come_in_the_order_of_their_steps():
    steps, modes = np.array([30, -1, 10, -1, -1, 20]), np.array([1, 0, 2, 0, 0, 1])
    places = np.arange(12.0).reshape(6, 2)
    record = Curve()
    for step in (0, 100):
        record.append(**row(step=step, axial_strain=step / 1000))
    snapshot = dataclasses.replace(
        wall(),
        point_contact=np.repeat([0, 1], 3),
        crack_step=steps,
        crack_mode=modes,
        crack_position=places,
    )
    cracks = cracks_from_snapshot(snapshot, record)
    assert [(c.step, c.contact, c.point, c.mode) for c in cracks] == [
        (10, FIRST, 2, 2),
        (20, FIRST + 1, 2, 1),
        (30, FIRST, 0, 1),
    ]
    assert [c.strain for c in cracks] == pytest.approx([0.01, 0.02, 0.03])
    assert (cracks[0].x, cracks[0].y) == (4.0, 5.0)
    assert len(cracks_csv(cracks).splitlines()) == 4


def test_erased_bonds_stand_among_the_cracks():
    record = Curve()
    for step in (0, 100):
        record.append(**row(step=step, axial_strain=step / 1000))
    snapshot = dataclasses.replace(
        wall(),
        erased_contact=np.array([7]),
        erased_point_bond=np.array([0, 0, 0]),
        erased_crack_step=np.array([5, 15, 15]),
        erased_crack_mode=np.array([1, 3, 3]),
        erased_crack_position=np.ones((3, 2)),
    )
    cracks = cracks_from_snapshot(snapshot, record)
    assert [(c.step, c.contact, c.point, c.mode) for c in cracks if c.contact == 7] == [
        (5, 7, 0, 1),
        (15, 7, 1, 3),
        (15, 7, 2, 3),
    ]
    assert [crack.step for crack in cracks] == sorted(crack.step for crack in cracks)
    assert cracks_csv(cracks).count("erased") == 2
    assert len(cracks) == 3 + np.count_nonzero(snapshot.crack_step >= 0)


def test_a_file_is_whole_or_keeps_its_old_content(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def interrupted():
        with whole_file(path) as temporary:
            temporary.write_text("half of the n")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
    with whole_file(path) as temporary:
        assert temporary.suffix == ".txt"
        temporary.write_text("new")
    assert path.read_text() == "new"


@pytest.mark.parametrize("name", ["file", "file/below", "/proc/flexpm"])
def test_a_folder_that_cannot_be_written_to_is_refused_in_one_line(tmp_path, name):
    (tmp_path / "file").write_text("")
    refusal("must be a folder that can be written to", output_folder, tmp_path / name)
