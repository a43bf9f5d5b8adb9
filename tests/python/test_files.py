# SPDX-License-Identifier: GPL-3.0-or-later
"""Files are for those whom the umask allows, whole or absent."""

from __future__ import annotations

import os
import stat

import pytest

from flexpm.files import whole_file, write_text


@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002])
def test_a_file_is_for_those_whom_the_umask_allows(tmp_path, mask, monkeypatch):
    before = os.umask(mask)
    with monkeypatch.context() as held:
        held.setattr(os, "umask", None)  # nobody may change it, not for a moment
        write_text(tmp_path / "it.csv", "1\n")
    os.umask(before)
    assert stat.S_IMODE((tmp_path / "it.csv").stat().st_mode) == 0o666 & ~mask


def test_a_file_that_failed_leaves_the_one_before_and_nothing_else(tmp_path):
    write_text(tmp_path / "it.csv", "1\n")
    with pytest.raises(ZeroDivisionError), whole_file(tmp_path / "it.csv") as temporary:
        temporary.write_text("2")
        raise ZeroDivisionError
    assert [file.name for file in tmp_path.iterdir()] == ["it.csv"]
    assert (tmp_path / "it.csv").read_text() == "1\n"
