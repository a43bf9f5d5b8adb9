# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of other programs, whole and broken at random: an answer or one line."""

from __future__ import annotations

import io
import json
import struct
import warnings
import zlib

import numpy as np
import pytest
from ebsd_files import ang_text, ctf_text
from fuzz_child import drawing
from hypothesis import given
from hypothesis import strategies as st
from neper_files import tesr_bytes, tesr_text, tess_text
from neper_solids import bricks, prism
from neper_solids import tess_text as solid_text
from PIL import Image

from flexpm.errors import InputError
from flexpm.joints import geojson
from flexpm.specimens.labels import ebsd, picture, tesr
from flexpm.specimens.specimen import Specimen

CORNERS = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.5, 0.0), (0.5, 1.0)]
PHASE = np.array([[1, 1, 2], [1, 0, 2], [1, 2, 2]])
ANGLES = 30.0 * np.arange(27.0).reshape(3, 3, 3)
PHASES = [("a", "-3m"), ("b", "2/m")]
LINES = [[0.0, 0.0], [1.0, 1.0], [2.0, 1.0]]
FEATURES = [
    {"type": "Feature", "properties": {"name": "a"}, "geometry": {"type": kind, "coordinates": to}}
    for kind, to in (("LineString", LINES), ("MultiLineString", [LINES, LINES]), ("Point", [0, 0]))
]
CRS = {"type": "name", "properties": {"name": "EPSG:25832"}}
MAP = {"type": "FeatureCollection", "crs": CRS, "features": FEATURES}
GOOD = {
    "a.tess": tess_text(CORNERS, [[0, 4, 5, 3], [4, 1, 2, 5]], [(0.25, 0.5, 0), (0.75, 0.5, 0)]),
    "b.tess": solid_text(*bricks((2, 1, 2)), [(0.3, 0.5, z, 0.1) for z in (0.3, 0.4, 0.6, 0.7)]),
    "c.tess": solid_text(*prism(17, 2)),
    "s.tess": tess_text(
        CORNERS,
        [[0, 4, 5, 3], [4, 1, 2, 5]],
        [(0.25, 0.5, 0, 0.1), (0.75, 0.5, 0, 0.1)],
        place=lambda x, y, away: (x + 0.6 * away, 0.8 * y - 0.6 * away, 0.6 * y + 0.8 * away),
    ),
    "a.tesr": tesr_text(PHASE),
    "b.tesr": tesr_bytes(PHASE, "binary8", "u1").decode(),
    "a.ctf": ctf_text(PHASE, ANGLES, PHASES),
    "a.ang": ang_text(PHASE, ANGLES, PHASES),
    "h.ang": ang_text(PHASE, ANGLES, PHASES, (1.0, 0.866), hexagonal=True),
    "a.geojson": json.dumps(
        {"type": "FeatureCollection", "crs": CRS, "features": FEATURES}, indent=1
    ),
}
READERS = {
    "a.tess": lambda path: Specimen.from_tess(path, 0.01),
    "b.tess": lambda path: Specimen.from_tess_solid(path),
    "c.tess": lambda path: Specimen.from_tess_solid(path),
    "s.tess": lambda path: Specimen.from_tess(path, 0.01),
    "a.tesr": tesr.read,
    "b.tesr": tesr.read,
    "a.ctf": lambda path: ebsd.grains(ebsd.read(path)),
    "a.ang": lambda path: ebsd.grains(ebsd.read(path)),
    "h.ang": lambda path: ebsd.grains(ebsd.read(path), unindexed="hole"),
    "a.geojson": geojson.read,
}
WORDS = st.sampled_from(
    [
        *("0", "-1", "1e300", "-1e300", "nan", "inf", "1e-300", "99999999999999999999", "0.5", "2"),
        *(
            "",
            "a",
            "**vertex",
            "*seed",
            "*file",
            "binary16",
            "***end",
            "#",
            "\x00",
            "\u00e9",
            "[]",
            "{}",
            '"',
            "null",
        ),
    ]
)


@st.composite
def broken(draw):
    """One of the files after a few changes: words, lines, ends, or bytes that are no text."""
    name = draw(st.sampled_from(sorted(GOOD)))
    lines = GOOD[name].split("\n")
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, max(len(lines) - 1, 0)))
        how = draw(st.sampled_from(["word", "word", "word", "drop", "twice", "cut"]))
        if how == "word" and lines[at].split():
            words = lines[at].split(" ")
            words[draw(st.integers(0, len(words) - 1))] = draw(WORDS)
            lines[at] = " ".join(words)
        elif how == "drop" and len(lines) > 1:
            del lines[at]
        elif how == "twice":
            lines.insert(at, lines[at])
        elif how == "cut":
            lines = lines[: at + 1]
    text = "\n".join(lines).encode()
    return name, text if draw(st.integers(0, 19)) else b"\xff" + text


@given(broken())
@drawing(300)
def test_any_file_is_read_or_refused(tmp_path_factory, drawn):
    name, content = drawn
    path = tmp_path_factory.getbasetemp() / name
    path.write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            READERS[name](path)
        except InputError as error:
            assert "\n" not in str(error)


@pytest.mark.parametrize("name", GOOD)
def test_whole_files_are_read(tmp_path, name):
    (tmp_path / name).write_text(GOOD[name])
    READERS[name](tmp_path / name)


def saved(save, *given, **options):
    """What a function writes into a file."""
    file = io.BytesIO()
    save(file, *given, **options)
    return file.getvalue()


COLOURS = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255]], dtype=np.uint8)[PHASE]
IMAGES = {
    "colours.png": saved(Image.fromarray(COLOURS).save, format="PNG"),
    "grey.png": saved(Image.fromarray(PHASE.astype(np.uint8)).save, format="PNG"),
    "grey.tif": saved(Image.fromarray(PHASE.astype(np.uint16)).save, format="TIFF"),
    "labels.npy": saved(np.save, PHASE),
    "parts.npy": saved(np.save, PHASE.astype(np.float32)),
}
TABLES = (
    '"#ff0000" = "quartz"\n"#00ff00" = "mica"\n"#0000ff" = "hole"\n',
    '0 = "hole"\n1 = "quartz"\n2 = "mica"\n',
)


@st.composite
def broken_image(draw):
    """An image and its phases after a few changes of bytes."""
    name = draw(st.sampled_from(sorted(IMAGES)))
    table = TABLES[not name.startswith("colours")]
    found = []
    for content in (IMAGES[name], table.encode()):
        text = bytearray(content)
        for _ in range(draw(st.integers(0, 3))):
            at = draw(st.integers(0, len(text) - 1))
            how = draw(st.sampled_from(["byte", "byte", "head", "cut", "more"]))
            if how == "cut" and at:
                del text[at:]
            elif how == "more":
                text[at:at] = draw(st.binary(min_size=1, max_size=8))
            else:
                at = at % 40 if how == "head" else at
                text[min(at, len(text) - 1)] = draw(st.integers(0, 255))
        found.append(bytes(text))
    return name, *found


@given(broken_image())
@drawing(300)
def test_any_image_and_its_phases_are_read_or_refused(tmp_path_factory, drawn):
    name, content, phases = drawn
    folder = tmp_path_factory.getbasetemp()
    (folder / name).write_bytes(content)
    (folder / "phases.toml").write_bytes(phases)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            found = picture.read(folder / name)
            names, kinds = picture.indices(picture.read_phases(folder / "phases.toml", found))
        except InputError as error:
            assert "\n" not in str(error)
        else:
            assert len(names) < len(kinds) + 1


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
    with pytest.raises(InputError, match=told) as error:
        picture.read(tmp_path / "a.png")
    assert "\n" not in str(error.value)


def test_files_that_are_too_large_are_not_read(tmp_path):
    for name in GOOD:
        with (tmp_path / name).open("wb") as file:
            file.truncate(70_000_000)
        with pytest.raises(InputError, match="larger than 64 MB"):
            READERS[name](tmp_path / name)
