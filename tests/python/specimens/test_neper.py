# SPDX-License-Identifier: GPL-3.0-or-later
"""Tessellations of Neper: areas, neighbours and centres of the file; what is refused."""

from __future__ import annotations

import json
import math
import os

import numpy as np
import pytest
from neper_files import tesr_bytes, tesr_text, tess_of, tess_text
from refusals import refusal
from work import growth_of

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.specimens.files import tess
from flexpm.specimens.labels import tesr
from flexpm.specimens.specimen import Specimen

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def laguerre(cells, seed, weights="squares"):
    """Cells of random seeds in the unit square, and the seeds with weights of one meaning."""
    draw = np.random.default_rng(seed)
    centres = draw.random((cells, 2))
    radii = np.full(cells, 0.5 / cells**0.5)
    if weights != "none":
        radii *= draw.uniform(0.9, 1.1, cells)
    made = Specimen.from_discs(centres, radii, SQUARE, 0.1, short_edge=0.0, drop_hidden=True)
    given = {"squares": made.radii**2, "radii": made.radii, "none": 0.0 * made.radii}[weights]
    return made, np.column_stack((made.centres, given)).tolist()


def pairs(specimen):
    return np.unique(np.sort(specimen.tessellation.shared_edges[:, :2], axis=1), axis=0)


def require_as_the_file(path, scale):
    file, made = tess.read(path), Specimen.from_tess(path, 0.01, scale=scale, short_edge=0.0)
    assert made.tessellation.cell_areas == pytest.approx(scale**2 * file.areas, rel=1e-9)
    assert np.array_equal(pairs(made), file.neighbours)
    return made


@pytest.mark.parametrize("weights", ["squares", "radii", "none"])
def test_cells_of_seeds_have_the_seeds_as_centres(tmp_path, weights):
    source, seeds = laguerre(200, 3, weights)
    (tmp_path / "a.tess").write_text(tess_of(source, seeds))
    made = require_as_the_file(tmp_path / "a.tess", 0.05)
    assert made.centres == pytest.approx(0.05 * source.centres, rel=1e-12)
    assert made.spec.cells is None  # discs: all models take them
    # the normal of a contact, between the centres, is that of its edge
    cells = made.tessellation
    edges = cells.shared_edges
    way = made.centres[edges[:, 1]] - made.centres[edges[:, 0]]
    along = cells.vertices[edges[:, 3]] - cells.vertices[edges[:, 2]]
    long = np.hypot(*along.T) > 1e-3 * made.mean_diameter
    cosine = np.sum(way * along, axis=1) / np.hypot(*way.T) / np.hypot(*along.T)
    assert np.abs(cosine[long]).max() < 1e-6
    assert made.mean_diameter == pytest.approx((4.0 / np.pi * 0.05**2 / 200) ** 0.5, rel=0.02)


def test_a_rectangle_is_one_wherever_the_file_begins(tmp_path):
    """Neper numbers vertices in any order, and writes twelve digits."""
    source, seeds = laguerre(40, 3)
    cells = source.tessellation
    order = np.random.default_rng(2).permutation(len(cells.vertices))
    rings = np.split(np.argsort(order)[cells.cell_vertices], cells.cell_offsets[1:-1])
    corners = cells.vertices[order] + 1e-12 * np.random.default_rng(3).normal(size=(len(order), 2))
    text = tess_text(corners.tolist(), [ring.tolist() for ring in rings], seeds)
    (tmp_path / "a.tess").write_text(text)
    made = Specimen.from_tess(tmp_path / "a.tess", 0.01, scale=0.05)
    assert made.kind == "rectangle" and made.spec.cells is None
    assert made.dimensions == pytest.approx({"width": 0.05, "height": 0.05}, rel=1e-9)


def test_other_cells_keep_their_shape_and_take_centroids(tmp_path):
    source, _ = laguerre(200, 4)
    wrong = np.random.default_rng(1).random((200, 3)).tolist()
    for number, seeds in enumerate((None, wrong)):
        (tmp_path / f"{number}.tess").write_text(tess_of(source, seeds))
        made = require_as_the_file(tmp_path / f"{number}.tess", 0.05)
        assert made.spec.cells is not None
    start, end = made.tessellation.cell_offsets[7:9]
    corners = made.tessellation.vertices[made.tessellation.cell_vertices[start:end]]
    after = np.roll(corners, -1, axis=0)
    cross = corners[:, 0] * after[:, 1] - after[:, 0] * corners[:, 1]
    centroid = (cross[:, None] * (corners + after)).sum(axis=0) / (3.0 * cross.sum())
    assert made.centres[7] == pytest.approx(centroid, rel=1e-9)


@pytest.mark.parametrize("normal", [(1.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.2, -0.9, 0.4)])
def test_a_slice_is_its_plane_and_its_seeds_those_in_space(tmp_path, normal):
    """A seed off the plane by d has there a disc of r^2 = w^2 - d^2."""
    source, seeds = laguerre(60, 7, "radii")
    away = np.random.default_rng(1).uniform(0.0, 0.1, 60)
    lifted = [[x, y, math.hypot(w, d), d] for (x, y, w), d in zip(seeds, away, strict=True)]
    upwards = np.array(normal) / np.linalg.norm(normal)
    along = np.cross(upwards, [0.3, 0.5, 0.7] if normal[1] else [0.0, 1.0, 0.0])
    along /= np.linalg.norm(along)
    across = np.cross(upwards, along)

    def place(x, y, off):
        return (x * along + y * across + off * upwards + [3.0, 4.0, 5.0]).tolist()

    (tmp_path / "a.tess").write_text(tess_of(source, lifted, place=place))
    made = require_as_the_file(tmp_path / "a.tess", 0.05)
    assert made.spec.cells is None  # the seeds in space are Laguerre's in the plane, too
    areas = 0.05**2 * source.tessellation.cell_areas
    assert made.tessellation.cell_areas == pytest.approx(areas, rel=1e-9)
    ways = [one.centres[:, None] - one.centres for one in (made, source)]
    found, expected = (np.hypot(way[..., 0], way[..., 1]) for way in ways)
    assert found == pytest.approx(0.05 * expected, abs=1e-9)
    assert made.kind == ("polygon" if normal[1] else "rectangle")


def test_short_edges_are_collapsed_and_the_specimen_runs(tmp_path):
    source, seeds = laguerre(60, 5)
    (tmp_path / "a.tess").write_text(tess_of(source, seeds))
    made = Specimen.from_tess(tmp_path / "a.tess", 0.01, scale=0.03)
    ends = made.tessellation.vertices[made.tessellation.shared_edges[:, 2:]]
    least = np.hypot(*(ends[:, 1] - ends[:, 0]).T).min()
    assert least >= made.short_edge * made.mean_diameter
    assert made.dimensions == pytest.approx({"width": 0.03, "height": 0.03})
    made.save(tmp_path / "a.json")
    assert Specimen.load(tmp_path / "a.json").spec == made.spec
    assert flexpm.elastic(made)["youngs_modulus"] > 1e9


@pytest.mark.long
def test_the_work_of_reading_ten_thousand_cells_is_that_of_as_many_cells(tmp_path):
    def read(count):
        return Specimen.from_tess(tmp_path / f"{count}.tess", 0.01, scale=0.3, short_edge=0.0)

    for count in (2_500, 10_000):
        (tmp_path / f"{count}.tess").write_text(tess_of(*laguerre(count, 6), version="2.0"))
    assert growth_of(read, 2_500, 10_000) < 4.4
    require_as_the_file(tmp_path / "10000.tess", 0.3)


GOOD = tess_text([*SQUARE, (0.5, 0.0), (0.5, 1.0)], [[0, 4, 5, 3], [4, 1, 2, 5]])
BROKEN = {
    "no": ("", "line 1: section = '', must be ***tess"),
    "solid": (GOOD.replace("2 standard", "3 standard"), "line 5: dimension = 3, must be 2"),
    "raster": (GOOD.replace("***tess", "***tesr"), "flexpm specimen image reads it"),
    "old": (GOOD.replace("3.5", "1.9.2"), "line 4: format = 1.9.2, must be 2.0 or later"),
    "cut": (GOOD[: GOOD.index(" **face")], "section = '', must be **face"),
    "cut late": (GOOD.replace("***end", ""), "section = end of the file, must be ***end"),
    "number": (GOOD.replace("0.5 1.0 0.0", "0.5 nan 0.0"), "vertex 6: y = 'nan', must be a number"),
    "vertex": (GOOD.replace(" 1 4 1 5 6 4", " 1 4 1 5 9 4"), "face 1: vertex = '9', must be"),
    "twice": (GOOD.replace(" 1 4 1 5 6 4", " 1 4 1 5 5 4"), "face 1: a vertex is given twice"),
    "empty": (GOOD.replace(" 1 4 1 5 6 4", " 1 0"), "face 1: vertices = 0, is an empty cell"),
    "bent": (GOOD.replace("0.5 1.0 0.0 0", "0.5 1.0 0.1 0"), "must lie in one plane; cut a slice"),
    "many": (GOOD.replace("**cell\n  2", "**cell\n  200000"), "cells = '200000', must be"),
    "over": (GOOD.replace("0.5 1.0 0.0", "0.5 -1.0 0.0"), "polygon"),
    "size": (GOOD.replace("   3 1.0 1.0", "   3 1.0 1e9"), "size = 1000000000.0 m"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_files_are_one_line_with_the_place(tmp_path, name):
    text, words = BROKEN[name]
    (tmp_path / "a.tess").write_text(text)
    with pytest.raises(InputError) as error:
        Specimen.from_tess(tmp_path / "a.tess", 0.01)
    assert words in str(error.value) and "\n" not in str(error.value)


def test_a_raster_is_labels_from_below(tmp_path):
    labels = np.array([[1, 1, 2], [1, 2, 2], [3, 3, 2], [3, 3, 3]])
    (tmp_path / "a.tesr").write_text(tesr_text(labels))
    assert np.array_equal(tesr.read(tmp_path / "a.tesr"), labels)


LABELS = np.array([[1, 1, 200], [1, 2, 200], [3, 3, 2], [3, 3, 3]])
FORMS = {
    **{"binary8": "u1", "binary16": "<i2", "binary16_big": ">i2"},
    **{"binary32": "<i4", "binary32_big": ">i4"},
}


@pytest.mark.parametrize("kind", [*FORMS, "ascii"])
def test_cells_of_a_raster_are_bytes_or_in_a_file_of_their_own(tmp_path, kind):
    text, path = tesr_text(LABELS), tmp_path / "a.tesr"
    data = text[text.index("ascii\n") + 6 : text.index("***end")].encode()
    if kind in FORMS:
        path.write_bytes(tesr_bytes(LABELS, kind, FORMS[kind]))
        assert np.array_equal(tesr.read(path), LABELS)
        data = LABELS[::-1].astype(FORMS[kind]).tobytes()
        path.write_bytes(path.read_bytes().replace(data, data + data[:4]))
        refusal("data = more than 12 pixels, must be 12", tesr.read, path)
    (tmp_path / "cells.raw").write_bytes(data)
    path.write_text(text[: text.index("ascii")] + f"{kind}\n *file cells.raw\n***end\n")
    assert np.array_equal(tesr.read(path), LABELS)
    (tmp_path / "cells.raw").write_bytes(data + (b"1" if kind == "ascii" else data))
    refusal("data = (24|more than 12) pixels, must be 12", tesr.read, path)
    (tmp_path / "cells.raw").write_bytes(data[: len(data) // 2])
    refusal("data = 6 pixels, must be 12|cell of a pixel = ''", tesr.read, path)
    (tmp_path / "cells.raw").unlink()
    os.mkfifo(tmp_path / "cells.raw")  # nobody writes into it
    refusal("must be a file; put it there", tesr.read, path)


def test_bytes_of_orientations_follow_the_cells_of_a_raster(tmp_path):
    orientations = b" **oridata\n   rodrigues:active\n   binary16\n\xcf\x36\xff"
    text = tesr_text(LABELS).encode().replace(b"***end", orientations)
    (tmp_path / "a.tesr").write_bytes(text)
    assert np.array_equal(tesr.read(tmp_path / "a.tesr"), LABELS)
    old = (
        tesr_text(LABELS)
        .replace("   2.2\n", "   2.0\n   ascii\n")
        .replace(" **data\n   ascii", " **data")
    )
    (tmp_path / "a.tesr").write_text(old)
    assert np.array_equal(tesr.read(tmp_path / "a.tesr"), LABELS)
    (tmp_path / "a.tesr").write_bytes(
        text.replace(text[text.index(b" **data") : text.index(b" **ori")], b"")
    )
    refusal("data is missing|section = end of the file", tesr.read, tmp_path / "a.tesr")


def test_rasters_that_are_none_in_the_plane_are_refused(tmp_path, capsys):
    good = tesr_text(np.full((8, 8), 1))
    for text, words in (
        (
            good.replace("   2\n", "   3\n"),
            "dimension = 3, must be 2: flexpm specimen volume reads volumes",
        ),
        (good.replace("0.01 0.01", "0.01 0.02"), "pixel = 0.01 x 0.02, must be square"),
        (good.replace("ascii", "binary32"), "pixels, must be 64 by the size in"),
        (good.replace("ascii", "binary7"), "data format = 'binary7', must be ascii or one of"),
        (good.replace("ascii", "ascii *file a.raw"), "a.raw', must be a file; put it there"),
        (good.replace("**data", "**dada"), "**data is missing, the cell of each pixel"),
        (good.replace("8 8", "8 4"), "data = more than 32 pixels, must be 32 by the size in"),
        (
            good.replace(" **data", " **cell\n   3\n **data").replace("1 1 1", "1 4 1"),
            "= 4, must be <= 3",
        ),
        (good.replace("8 8", "80 80"), "cell of a pixel = '***end', must be a whole number"),
        (good.replace("8 8", "99999 99999"), "size = 99999 x 99999 pixels, must be <="),
        (good.replace("1 1 1", "1 0 1"), "image label = 0, is void"),
    ):
        (tmp_path / "a.tesr").write_text(text)
        out = ["--out", str(tmp_path / "out"), "--quiet"]
        given = [str(tmp_path / "a.tesr"), "--pixel", "1e-3", *out]
        assert cli.main(["specimen", "image", *given]) == 2
        lines = capsys.readouterr().err.strip().splitlines()
        assert len(lines) == 1 and words in lines[0], lines


def test_the_command_writes_figures_and_the_specimen(tmp_path, capsys):
    source, seeds = laguerre(60, 5)
    (tmp_path / "a.tess").write_text(tess_of(source, seeds))
    given = [str(tmp_path / "a.tess"), "--scale", "0.03", "--out", str(tmp_path / "out")]
    assert cli.main(["specimen", "tess", *given, "--quiet"]) == 0
    found = json.loads((tmp_path / "out/specimen.json").read_text())
    assert found["grains"] == 60 and "image" not in found
    told = capsys.readouterr().out
    steps = int(told.partition("if it passes a peak: about ")[2].split()[0])
    assert 1e3 < steps < 1e6
    assert found["source"]["shortest_edge"] < found["shortest_edge"]
    assert Specimen.load(tmp_path / "out/grains.json").spec.cells is None
