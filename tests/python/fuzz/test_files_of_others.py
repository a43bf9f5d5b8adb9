# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of other programs and people, whole and broken at random: an answer or one line."""

from __future__ import annotations

import struct
import warnings
import zlib

import pytest
from fuzz_child import drawing
from good_files import FILES, READERS, TEXTS
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal

from flexpm.errors import InputError
from flexpm.specimens.labels import picture

WORDS = st.sampled_from(
    [
        *("0", "-1", "1e300", "-1e300", "nan", "inf", "1e-300", "99999999999999999999", "0.5", "2"),
        *(
            "",
            "a",
            "a b",
            "**vertex",
            "*seed",
            "*file",
            "binary16",
            "***end",
            "#",
            "\x00",
            "\u00e9",
        ),
        *(
            "[]",
            "{}",
            '"',
            "null",
            "true",
            "=",
            ",",
            "\t",
            "excavation:a",
            "\ufeff",
            "\r",
            "[set.a]",
        ),
    ]
)


@st.composite
def broken_text(draw, text):
    """A text after a few changes: words, lines, ends, or bytes that are no text."""
    lines = text.split("\n")
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, max(len(lines) - 1, 0)))
        how = draw(st.sampled_from(["word", "word", "word", "drop", "twice", "swap", "cut"]))
        if how == "word" and lines[at].split():
            mark = "," if "," in lines[at] and draw(st.booleans()) else " "
            words = lines[at].split(mark)
            words[draw(st.integers(0, len(words) - 1))] = draw(WORDS)
            lines[at] = mark.join(words)
        elif how == "drop" and len(lines) > 1:
            del lines[at]
        elif how == "twice":
            lines.insert(at, lines[at])
        elif how == "swap":
            other = draw(st.integers(0, len(lines) - 1))
            lines[at], lines[other] = lines[other], lines[at]
        elif how == "cut":
            lines = lines[: at + 1]
    content = draw(st.sampled_from(["\n", "\n", "\n", "\r\n"])).join(lines).encode()
    return draw(broken_bytes(content)) if draw(st.integers(0, 9)) == 0 else content


@st.composite
def broken_bytes(draw, content):
    """Bytes after a few changes."""
    text = bytearray(content)
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, max(len(text) - 1, 0)))
        how = draw(st.sampled_from(["byte", "byte", "head", "cut", "more"]))
        if how == "cut" and at:
            del text[at:]
        elif how == "more":
            text[at:at] = draw(st.binary(min_size=1, max_size=8))
        elif text:
            at = at % 40 if how == "head" else at
            text[min(at, len(text) - 1)] = draw(st.integers(0, 255))
    return bytes(text)


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
