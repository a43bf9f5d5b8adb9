# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of label volumes, broken at random: an answer of bounded memory, or one line."""

from __future__ import annotations

import tracemalloc
import warnings

import numpy as np
import pytest
from broken_files import broken_bytes, broken_text
from fuzz_child import drawing
from hypothesis import given
from volume_files import drawn, write

from flexpm.errors import InputError
from flexpm.specimens.label_volumes.reading import read

LABELS = drawn((4, 3, 3), 5)
#: Files whose heads and bodies are changed, and whether as texts.
FILES = {
    **{"a.npy": False, "a.tif": False, "lzw.tiff": False},
    **{"a.tesr": True, "binary16.tesr": False},
    **{"6.dream3d": False, "8.dream3d": False},
    **{"a.vti": False, "ascii.vti": True, "binary.vti": True, "raw.vti": False},
    **{"a.vtk": False, "ascii.vtk": True},
}
#: Memory that a small broken file may take [byte]; heads of arrays and blocks of bytes have limits.
MOST = 20 * 10**6


@pytest.mark.parametrize("name", FILES)
def test_any_file_is_read_or_refused(tmp_path_factory, capfd, name):
    if name.endswith(".dream3d"):
        pytest.importorskip("h5py")
    folder = tmp_path_factory.mktemp("volumes")
    path, _ = write(folder, name, LABELS)
    whole = path.read_bytes()
    assert np.array_equal(read(path, voxel=1.0).labels, LABELS - 1)
    broken = broken_text(whole.decode()) if FILES[name] else broken_bytes(whole)

    @given(broken)
    @drawing(25, by_night=80)
    def read_one(content):
        path.write_bytes(content)
        tracemalloc.start()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                read(path, voxel=1.0)
            except InputError as error:
                assert "\n" not in str(error)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < MOST

    read_one()
    assert capfd.readouterr().err == ""  # as libraries in C would write
