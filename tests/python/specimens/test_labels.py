# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens from images of labels: areas, lines and neighbours of the raster; what is refused."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest
from drawn_images import (
    LIMITS,
    PIXEL,
    THICKNESS,
    circles,
    drawn,
    figures_of,
    smallest_of,
    voronoi,
)
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from neper_files import tesr_text
from PIL import Image
from refusals import refusal
from scipy.ndimage import gaussian_filter
from work import growth_of

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.laboratory.forecast import forecast
from flexpm.specimens.labels.given import divide
from flexpm.specimens.specimen import Specimen


def made(labels, **options):
    return Specimen.from_labels(labels, PIXEL, THICKNESS, **options)


def require_as_the_raster(labels, smallest):
    found = figures_of(labels, smallest=smallest)
    beyond = {name: getattr(found, name) for name in LIMITS}
    assert all(beyond[name] <= most for name, most in LIMITS.items()), beyond


@pytest.mark.parametrize("seed", range(12))
def test_drawn_images_keep_areas_and_neighbours(seed):
    require_as_the_raster(drawn(seed, 40), smallest_of(seed))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(100))
def test_more_drawn_images(seed):
    """Those of 512 x 512 pixels are a table that scripts/night makes."""
    require_as_the_raster(drawn(seed), smallest_of(seed))


def test_a_circle():
    y, x = np.mgrid[:64, :64] + 0.5
    for seed in range(5):
        a, b = 32.0 + np.random.default_rng(seed).random(2)
        specimen = made(((x - a) ** 2 + (y - b) ** 2 < 400.0).astype(int))
        cells, grains = specimen.tessellation, specimen.grains
        pairs = cells.shared_edges
        ends = cells.vertices[pairs[:, 2:]]
        rim = grains[pairs[:, 0]] != grains[pairs[:, 1]]
        length = np.hypot(*(ends[rim, 1] - ends[rim, 0]).T).sum()
        inside = cells.cell_areas[grains == grains[pairs[rim][0, :2]].max()].sum()
        assert inside == pytest.approx(math.pi * 400.0 * PIXEL**2, rel=0.005)
        assert length == pytest.approx(40.0 * math.pi * PIXEL, rel=0.02)
        radii = np.hypot(*(ends[rim].reshape(-1, 2) / PIXEL - (a, 64.0 - b)).T)
        assert np.abs(radii - 20.0).max() < 1.5


def test_straight_layers_stay_straight_and_their_corners_are_an_edge_apart():
    labels = np.repeat(np.arange(4), 10)[:, None] * np.ones(40, dtype=int)
    specimen = made(labels, edge=5 * PIXEL)
    lines = specimen.tessellation.vertices[specimen.tessellation.shared_edges[:, 2:]]
    assert np.all(lines[:, 0, 1] == lines[:, 1, 1])
    assert np.hypot(*(lines[:, 1] - lines[:, 0]).T) == pytest.approx(5 * PIXEL)
    # row 0 is the top
    top = specimen.centres[specimen.grains == specimen.grains[np.argmax(specimen.centres[:, 1])]]
    assert specimen.dimensions == {"width": 40 * PIXEL, "height": 40 * PIXEL}
    assert divide(labels, PIXEL).labels[specimen.grains[np.argmax(specimen.centres[:, 1])]] == 0
    assert len(top) == 1


def test_small_regions_go_to_the_longest_line_and_to_their_own_mineral_first():
    labels = np.zeros((12, 12), dtype=int)
    labels[:, 6:] = 1
    labels[4, 5:8] = 2  # one pixel in 0, two in 1: 4 sides to 1, 4 to 0 with the end
    labels[9, 2] = 3
    found = divide(labels, PIXEL, smallest=4)
    assert found.counts["small_regions"] == 2
    assert sorted(found.labels.tolist()) == [0, 1]
    assert found.pixels.sum() == 144
    by_length = found.pixels[found.labels.tolist().index(1)]
    assert by_length == 72 + 1  # the longer line is that to 1: five sides to three
    alike = divide(labels, PIXEL, smallest=4, minerals={0: 0, 1: 1, 2: 0, 3: 1})
    assert alike.pixels[alike.labels.tolist().index(0)] == 72 + 2


def test_holes_and_what_is_loose():
    labels = voronoi(60, 12, 1)
    labels[20:30, 25:40] = 99
    labels[23:26, 30:34] = 50  # a grain in the hole
    minerals = {label: 0 for label in np.unique(labels).tolist()} | {99: None}
    specimen = made(labels, minerals=minerals)
    assert len(specimen.holes) == 1
    assert specimen.regions["loose_pixels"] == 12
    area = (3600 - 150) * PIXEL**2
    assert specimen.tessellation.cell_areas.sum() == pytest.approx(area, rel=1e-9)
    flexpm.elastic(specimen.with_minerals(specimen.minerals), mineral_rock())


def test_a_small_hole_goes_to_the_longest_line_and_to_no_mineral_by_its_number():
    labels = np.full((20, 20), 1)
    labels[:, 10:] = 2
    labels[5, 9:12] = 3  # three pixels of a hole, of which one lies in the first grain
    found = divide(labels, PIXEL, minerals={1: 0, 2: 1, 3: None})
    assert found.counts["small_holes"] == 1
    assert found.pixels[found.labels.tolist().index(2)] == 200 + 1


def mineral_rock():
    base = {"young": 50e9, "poisson": 0.2, "normal_stiffness": 1e14, "shear_ratio": 0.3}
    strengths = {"tensile_strength": 8e6, "cohesion": 30e6, "friction": 0.4, "softening": "brittle"}
    kinds = [{"name": name, "fraction": 0.5} for name in ("quartz", "mica")]
    return {**strengths, "elastic": {"flexible": base}, "mineral": kinds}


def test_a_specimen_of_an_image_is_saved_cut_and_run(tmp_path):
    labels = circles(40, voronoi(40, 9, 2), 3, 2)
    kinds = {label: label % 2 for label in np.unique(labels).tolist()}
    specimen = made(labels, minerals=kinds)
    assert specimen.grains.max() + 1 < len(specimen.discs)  # some go round others
    cut = specimen.with_joints({"one": [(-1e-3, 1.03e-3), (1e-2, 1.09e-3)]})
    for number, one in enumerate((specimen, cut)):
        one.save(tmp_path / f"{number}.json")
        again = Specimen.load(tmp_path / f"{number}.json")
        assert again.spec == one.spec
        assert np.array_equal(again.grains, one.grains)
        assert np.array_equal(again.minerals, one.minerals)
    result = flexpm.run("tension", specimen, mineral_rock(), rate=4.0, max_strain=1e-4)
    assert result.grains == len(specimen.discs)


@pytest.mark.parametrize("seed", [0, 7, 59])
def test_rims_that_are_nearly_straight_at_a_corner_are_read_back(tmp_path, seed):
    field = gaussian_filter(np.random.default_rng(seed).random((60, 60)), 4)
    labels = np.where(field < np.quantile(field, 0.25), 0, voronoi(60, 25, seed) + 1)
    specimen = made(labels, minerals={0: None} | dict.fromkeys(range(1, 30), 0))
    specimen.save(tmp_path / "a.json")
    assert Specimen.load(tmp_path / "a.json").spec == specimen.spec


@pytest.mark.parametrize("source", ["image", "packing"])
def test_a_compression_takes_what_is_told_before_it_runs(source):
    specimen = Specimen.rectangle(0.02, 0.04, 0.01, seed=2)
    if source == "image":
        specimen = Specimen.from_labels(voronoi(60, 20, 8)[:, :30], 2e-4, THICKNESS)
    told = forecast(specimen)
    fewest, most = told.steps
    # the fifteen grains of the image lock after their peak, which ends the test here
    assert fewest <= flexpm.run("uniaxial", specimen, stop_ratio=0.9).steps <= most
    assert most == pytest.approx(5.0 * fewest, rel=1e-3)
    assert told.seconds[1] / told.seconds[0] == pytest.approx(most / fewest)
    sawn = Specimen.half_disc(0.02, 0.01)
    assert forecast(sawn) is None


def test_figures_of_the_image_itself():
    y, x = np.mgrid[:64, :64] + 0.5
    found = made(((x - 32.3) ** 2 + (y - 32.1) ** 2 < 400.0).astype(int)).regions["source"]
    assert found["boundary_length"] == pytest.approx(40.0 * math.pi * PIXEL, rel=0.03)
    assert found["equal_area_diameter"]["smallest"] == pytest.approx(40.0 * PIXEL, rel=0.005)
    assert found["aspect_ratio"]["smallest"] == pytest.approx(1.0, abs=0.01)
    layers = np.repeat([0, 1, 2], [4, 20, 6])[:, None] * np.ones(40, dtype=int)
    layers[12, 12] = 0  # a pixel that goes to the layer around it
    kinds = {0: 0, 1: 1, 2: None}
    found = made(layers, minerals=kinds).regions["source"]
    assert found["grains"] == 3 and found["neighbours"] == pytest.approx(4.0 / 3.0)
    assert found["area_share"] == pytest.approx({0: 161 / 960, 1: 799 / 960})
    lengths = {(0, 1): 0.25 * math.pi * 44 * PIXEL}
    assert found["boundary_length_by_pair"] == pytest.approx(lengths)
    assert found["aspect_ratio"]["largest"] == pytest.approx(10.0, rel=1e-9)


WRONG = [
    (np.zeros((4, 4), int), {}, "labels = 1 region"),
    (np.zeros(4, int), {}, "must be rows of whole numbers"),
    (np.full((4, 4), 0.5), {}, "labels = 0.5 at row 0, column 0, must be whole numbers"),
    (np.full((4, 4), np.nan), {}, "labels = nan"),
    (np.array([["a", "b"], ["c", "d"]]), {}, "must be rows of whole numbers"),
    (np.eye(8, dtype=int), {"minerals": {0: None, 1: None}}, "all labels are holes"),
    (np.eye(8, dtype=int), {"minerals": {0: 0}}, "minerals of label 1 are missing: 8 pixels"),
    (np.eye(8, dtype=int), {"minerals": {0: 0, 1: -1}}, r"minerals\[1\] = -1"),
    (np.eye(8, dtype=int), {"minerals": 3}, "minerals = 3, must be indices by label"),
    (np.eye(8, dtype=int), {"smallest": 0}, "smallest = 0"),
    (np.eye(8, dtype=int), {"edge": PIXEL}, "edge = 5e-05"),
    (np.broadcast_to(np.int8(1), (30_000, 30_000)), {}, "30000 x 30000 pixels, must be <="),
]


@pytest.mark.parametrize(("labels", "options", "words"), WRONG)
def test_wrong_labels_are_refused_in_one_line(labels, options, words):
    refusal(words, made, labels, **options)


@settings(max_examples=40, deadline=None)
@given(
    arrays.arrays(
        st.sampled_from([np.uint8, np.int64, np.float64, bool]),
        st.tuples(st.integers(1, 14), st.integers(1, 14)),
        elements=st.integers(0, 1),
    )
    | arrays.arrays(np.int8, st.tuples(st.integers(2, 14), st.integers(2, 14))),
    st.sampled_from([1, 2, 4]),
    st.booleans(),
)
def test_any_image_gives_a_specimen_or_one_line(labels, smallest, with_hole):
    kinds = {label: 0 for label in np.unique(labels.astype(int)).tolist()}
    if with_hole:
        kinds[min(kinds)] = None
    try:
        specimen = made(labels, smallest=smallest, minerals=kinds)
    except InputError as error:
        assert "\n" not in str(error)
    else:
        assert specimen.grains.max() >= 1


COLOURS = np.array([(255, 0, 0), (0, 255, 0), (0, 0, 255)], dtype=np.uint8)
PHASES = '"#ff0000" = "quartz"\n"#00ff00" = "mica"\n"#0000ff" = "hole"\n'


def command(folder, file, *options):
    given = [str(folder / file), "--pixel", "5e-5", "--out", str(folder / "out")]
    return cli.main(["specimen", "image", *given, "--quiet", *options])


def test_the_command_reads_colours_and_tells_figures(tmp_path, capsys):
    kinds = np.digitize(gaussian_filter(np.random.default_rng(5).random((60, 60)), 4), [0.5])
    kinds[20:34, 20:34] = 2
    Image.fromarray(COLOURS[kinds]).save(tmp_path / "thin.png")
    (tmp_path / "phases.toml").write_text(PHASES)
    assert command(tmp_path, "thin.png", "--phases", str(tmp_path / "phases.toml")) == 0
    found = json.loads((tmp_path / "out/specimen.json").read_text())
    assert sum(found["area_share"].values()) == pytest.approx(1.0)
    by_pair = found["boundary_length_by_pair"]
    assert sum(by_pair.values()) == pytest.approx(found["boundary_length"])
    specimen = Specimen.load(tmp_path / "out/grains.json")
    assert len(specimen.holes) == 1 and specimen.minerals is not None
    told = capsys.readouterr().out
    assert "in this order: quartz, mica" in told
    assert "area share, quartz" in told and " source " in told
    assert found["source"]["area_share"] == pytest.approx(found["area_share"], abs=0.01)


def test_a_material_has_the_minerals_of_an_image_in_their_order(tmp_path):
    Image.fromarray(COLOURS[np.arange(400).reshape(20, 20) // 200]).save(tmp_path / "thin.png")
    (tmp_path / "phases.toml").write_text(PHASES)
    assert command(tmp_path, "thin.png", "--phases", str(tmp_path / "phases.toml")) == 0
    specimen = Specimen.load(tmp_path / "out/grains.json")
    assert specimen.mineral_names == ("quartz", "mica")
    cut = specimen.with_joints({"one": [(-1e-3, 2e-4), (1e-2, 2e-4)]})
    cut.save(tmp_path / "cut.json")
    assert Specimen.load(tmp_path / "cut.json").mineral_names == ("quartz", "mica")
    rock = mineral_rock()
    flexpm.elastic(specimen, rock)
    turned = {**rock, "mineral": rock["mineral"][::-1]}
    refusal(
        "mineral 1 = quartz, is mineral 2 of .* order quartz, mica",
        flexpm.elastic,
        specimen,
        turned,
    )
    flexpm.elastic(specimen.with_minerals(specimen.minerals), turned)  # of no names
    for other in ("feldspar", "Quartz-new"):  # what the material does not have is told by its place
        rock["mineral"][0]["name"] = other
        flexpm.elastic(specimen, rock)


def test_an_image_is_read_before_yade_is_loaded():
    """As the command does: what is wrong with it is told at once."""
    code = "import sys, flexpm.specimens.labels.picture; assert 'yade' not in sys.modules"
    environment = {**os.environ, "FLEXPM_DEFER": "1"}
    subprocess.run([sys.executable, "-c", code], env=environment, check=True)


def test_volumes_of_labels_are_refused_by_what_they_are():
    with pytest.raises(InputError, match=r"shape \(2, 3, 4\), must be rows of one image: flexpm"):
        Specimen.from_labels(np.zeros((2, 3, 4), int), PIXEL, 0.01)


def test_images_that_cannot_be_read_are_refused_in_one_line(tmp_path, capfd):
    (tmp_path / "phases.toml").write_text(PHASES.replace('"#0000ff" = "hole"\n', ""))
    picture = COLOURS[np.arange(100).reshape(10, 10) // 34]
    Image.fromarray(picture).save(tmp_path / "colours.png")
    pages = [Image.fromarray(picture[..., 0]) for _ in range(2)]
    pages[0].save(tmp_path / "pages.tif", save_all=True, append_images=pages[1:])
    clear = np.dstack((picture, np.full((10, 10), 100, np.uint8)))
    Image.fromarray(clear).save(tmp_path / "clear.png")
    np.save(tmp_path / "objects.npy", np.array([{}, []], dtype=object), allow_pickle=True)
    np.save(tmp_path / "fractions.npy", np.full((5, 5), 0.25))
    np.save(tmp_path / "texts.npy", np.full((5, 5), "quartz"))
    np.save(tmp_path / "gaps.npy", np.full((5, 5), np.nan))
    np.save(tmp_path / "volume.npy", np.zeros((3, 5, 5), int))
    (tmp_path / "head.npy").write_bytes(b"\x93NUMPY\x02\x00" + b"\xff" * 4 + b"{" * 188)
    for kind in ("jpeg", "tiff_adobe_deflate"):  # no such data within
        Image.fromarray(picture[..., 0]).save(tmp_path / "a.tif", compression=kind)
        with Image.open(tmp_path / "a.tif") as image:
            (first,), (size,) = image.tag_v2[273], image.tag_v2[279]
        content = bytearray((tmp_path / "a.tif").read_bytes())
        content[first : first + size] = bytes(size)
        (tmp_path / f"{'jpeg' if kind == 'jpeg' else 'zip'}.tif").write_bytes(content)
    (tmp_path / "none.png").write_bytes(b"no image")
    for file, words in {
        "colours.png": "image colour = #0000ff of 32 pixels, one at row 6, column 8, is missing",
        "pages.tif": "image = 2 pages, must be 1: flexpm specimen volume reads volumes",
        "volume.npy": "array of shape (3, 5, 5), must be rows of one image: flexpm specimen",
        "jpeg.tif": "must be a PNG, TIFF, NPY or TESR file: JPEGLib: ",
        "zip.tif": "must be a PNG, TIFF, NPY or TESR file: ZIPDecode: ",
        "head.npy": "must be an array of numbers: head = 4294967295 bytes, must be <= 10000",
        "clear.png": "image opacity = 100 of 255 at row 0, column 0, must be full",
        "objects.npy": "must be an array of numbers",
        "fractions.npy": "labels = 0.25 at row 0, column 0, must be whole numbers",
        "texts.npy": "must be rows of whole numbers",
        "gaps.npy": "labels = nan at row 0, column 0, must be whole numbers",
        "none.png": "must be a PNG, TIFF, NPY or TESR file",
        "nowhere.png": "must be a PNG, TIFF, NPY or TESR file",
    }.items():
        named = ("colours.png", "texts.npy", "gaps.npy")
        phases = ["--phases", str(tmp_path / "phases.toml")] if file in named else []
        assert command(tmp_path, file, *phases) == 2, file
        lines = capfd.readouterr().err.strip().splitlines()
        assert len(lines) == 1 and words in lines[0], lines


def test_a_palette_is_its_indices(tmp_path):
    labels = voronoi(30, 5, 3).astype(np.uint8)
    image = Image.fromarray(labels, mode="P")
    image.putpalette(list(range(255, -1, -1)) * 3)
    image.save(tmp_path / "palette.png")
    assert command(tmp_path, "palette.png") == 0
    found = json.loads((tmp_path / "out/specimen.json").read_text())
    assert found["grains"] == divide(labels, PIXEL).pixels.size


@pytest.mark.long
def test_the_work_of_a_million_pixels_is_that_of_their_grains():
    """Four times the pixels and twice the grains: twice the loops of Python."""
    assert growth_of(lambda side: made(voronoi(side, 2 * side, 1)), 500, 1000) < 2.2


def two_images(folder):
    """Grains, their minerals, and files with these: a table and a second image with noise."""
    grains = drawn(6, 40, whole=True).astype(np.int64)
    ids = np.unique(grains)
    kinds = {label: number % 3 for number, label in enumerate(ids.tolist())}
    names = ["quartz", "mica", "hole"]
    rows = [f"{label},x,{names[kind]}" for label, kind in kinds.items()]
    (folder / "grains.csv").write_text("id,note,mineral\n" + "\n".join(rows) + "\n999999,,iron\n")
    second = np.vectorize(kinds.get)(grains).astype(np.uint8) + 4
    second.flat[np.unique(grains, return_index=True)[1]] = 4  # one pixel of each grain differs
    Image.fromarray(second).save(folder / "kinds.png")
    (folder / "kinds.toml").write_text('4 = "quartz"\n5 = "mica"\n6 = "hole"\n')
    np.save(folder / "grains.npy", grains)
    index = {label: (0, 1, None)[kind] for label, kind in kinds.items()}
    return grains, index


def test_minerals_of_a_table_and_of_a_second_image_are_those_by_label(tmp_path):
    grains, index = two_images(tmp_path)
    expected = Specimen.from_labels(grains, PIXEL, 0.01, minerals=index)
    for name, phases in (("grains.csv", None), ("kinds.png", "kinds.toml")):
        given = ["--minerals", str(tmp_path / name)]
        given += [] if phases is None else ["--phases", str(tmp_path / phases)]
        assert command(tmp_path, "grains.npy", *given) == 0
        found = Specimen.load(tmp_path / "out/grains.json")
        assert np.array_equal(found.minerals, expected.minerals)
        assert found.mineral_names == ("quartz", "mica")
        assert len(found.holes) == len(expected.holes)
    made = Specimen.from_labels(grains, PIXEL, 0.01, minerals=tmp_path / "grains.csv")
    assert np.array_equal(made.minerals, expected.minerals)
    assert made.mineral_names == ("quartz", "mica")
    rock = {label: (0, 1, 2)[(0, 1, None).index(kind)] for label, kind in index.items()}
    whole = Specimen.from_labels(grains, PIXEL, 0.01, minerals=rock)
    made = Specimen.from_labels(grains, PIXEL, 0.01, minerals=str(tmp_path / "kinds.png"))
    assert np.array_equal(made.minerals, whole.minerals)
    assert made.mineral_names == ("phase 4", "phase 5", "phase 6")


def test_files_of_minerals_that_do_not_fit_are_refused(tmp_path, capsys):
    grains, _ = two_images(tmp_path)
    first = int(grains.min())
    table = (tmp_path / "grains.csv").read_text()
    rows = table.splitlines()
    Image.fromarray(np.zeros((5, 6), np.uint8)).save(tmp_path / "small.png")
    many = np.arange(grains.size, dtype=np.int32).reshape(grains.shape)
    Image.fromarray(many).save(tmp_path / "many.tif")
    for name, text, words in (
        ("a.csv", table.replace("id,note", "label,note"), "must have id and mineral, each once"),
        ("a.csv", "", "must have id and mineral, each once, in the first row"),
        ("a.csv", "\n".join([rows[0], *rows[2:]]), f"id {first} of a grain is missing; add a row"),
        ("a.csv", rows[0], "of a grain is missing; so are"),
        ("a.csv", table + f"{first},,iron\n", f"id {first} = 'iron', was 'quartz' before, must"),
        ("a.csv", table + "x,,iron\n", "id = 'x', must be a whole number"),
        ("a.csv", table + "7\n", "cells = 1, must be 3; complete it"),
        ("a.csv", table + "888888,,\n", "mineral of id 888888 = '', must be a name"),
        ("no.csv", None, "cannot be read"),
        ("small.png", None, "of 6 x 5 pixels, must have"),
        ("many.tif", None, "different ones, must be <= 100; give an image or volume of phases"),
    ):
        if text is not None:
            (tmp_path / name).write_text(text)
        assert command(tmp_path, "grains.npy", "--minerals", str(tmp_path / name)) == 2
        line = capsys.readouterr().err
        assert line.count("\n") == 1 and words in line, line
    given = ["--minerals", str(tmp_path / "grains.csv"), "--phases", str(tmp_path / "kinds.toml")]
    assert command(tmp_path, "grains.npy", *given) == 2
    assert "must not be given with a table of minerals" in capsys.readouterr().err


def test_colours_of_grains_are_ids_and_void_stays_void(tmp_path):
    kinds = np.arange(400).reshape(20, 20) // 140
    Image.fromarray(COLOURS[kinds]).save(tmp_path / "thin.png")
    (tmp_path / "a.csv").write_text("mineral,id\nmica,#ff0000\nquartz,#00FF00\nmica,#0000ff\n")
    assert command(tmp_path, "thin.png", "--minerals", str(tmp_path / "a.csv")) == 0
    found = Specimen.load(tmp_path / "out/grains.json")
    assert found.mineral_names == ("mica", "quartz") and sorted(found.minerals) == [0, 0, 1]
    kinds[8:12, 8:12] = -1
    (tmp_path / "a.tesr").write_text(tesr_text(kinds + 1))
    Image.fromarray(np.full((20, 20), 3, np.uint8)).save(tmp_path / "one.png")
    assert command(tmp_path, "a.tesr", "--minerals", str(tmp_path / "one.png")) == 0
    found = Specimen.load(tmp_path / "out/grains.json")
    assert len(found.holes) == 1 and found.mineral_names == ("phase 3",)
