# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of other programs and people, whole and broken at random: an answer or one line."""

from __future__ import annotations

import struct
import warnings
import zlib

import pytest
from broken_files import broken_bytes, broken_text
from fuzz_child import drawing
from good_files import FILES, READERS, TEXTS
from hypothesis import given
from refusals import refusal

from flexpm.errors import InputError
from flexpm.specimens.labels import picture


def broken(name):
    return broken_text(TEXTS[name]) if name in TEXTS else broken_bytes(FILES[name])


@pytest.mark.parametrize("name", FILES)
def test_any_file_is_read_or_refused(tmp_path_factory, capfd, name):
    path = tmp_path_factory.getbasetemp() / name

    @given(broken(name))
    @drawing(40, by_night=50)
    def read(content):
        path.write_bytes(content)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                READERS[name](path)
            except InputError as error:
                assert "\n" not in str(error)

    read()
    assert capfd.readouterr().err == ""  # as libraries in C would write


@pytest.mark.parametrize("name", FILES)
def test_whole_files_are_read(tmp_path, name):
    (tmp_path / name).write_bytes(FILES[name])
    READERS[name](tmp_path / name)


@pytest.mark.parametrize("name", TEXTS)
def test_texts_of_any_system_are_read_alike(tmp_path, name):
    """A byte-order mark, other line ends, blanks at the ends of lines, empty last lines."""
    path, text = tmp_path / name, TEXTS[name]
    path.write_text(text)
    expected = READERS[name](path)
    for ends, trailing, after in (("\r\n", "", ""), ("\r", "  ", "\n"), ("\r\n", " \t", "\n \n\n")):
        changed = (text + after).replace("\n", trailing + "\n").replace("\n", ends)
        path.write_bytes(b"\xef\xbb\xbf" + changed.encode())
        assert READERS[name](path) == expected


def headed(wide, high):
    """A PNG that says its size and holds no pixels."""
    size = struct.pack(">IIBBBBB", wide, high, 8, 0, 0, 0, 0)
    parts = [(b"IHDR", size), (b"IDAT", zlib.compress(b"")), (b"IEND", b"")]
    blocks = [
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in parts
    ]
    return b"\x89PNG\r\n\x1a\n" + b"".join(blocks)


@pytest.mark.parametrize(("wide", "high"), [(5000, 5000), (20_000, 8000), (100_000, 100_000)])
def test_images_that_are_too_large_are_refused_by_their_head(tmp_path, wide, high):
    (tmp_path / "a.png").write_bytes(headed(wide, high))
    told = f"{wide} x {high} pixels|{wide * high} pixels"
    refusal(told, picture.read, tmp_path / "a.png")


@pytest.mark.parametrize("name", TEXTS)
def test_files_that_are_too_large_are_not_read(tmp_path, name):
    with (tmp_path / name).open("wb") as file:
        file.truncate(70_000_000)
    refusal("larger than 64 MB|cannot be read", READERS[name], tmp_path / name)
