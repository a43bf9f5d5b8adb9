# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of orientations: misorientations of each Laue group, grids, points without a phase."""

from __future__ import annotations

import itertools
import json
import math

import numpy as np
import pytest
from ebsd_files import ANG, CTF, ang_text, ctf_text
from refusals import refusal, refused_command
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.specimens.labels import ebsd, laue
from flexpm.specimens.specimen import Specimen

#: Turns about c that each group makes alike [degree], number of rotations, and what a turn of 60
#: and one of 90 degrees about c, and of 180 about x, are at least.
GROUPS = {
    "-1": (1, 60.0, 90.0, 180.0),
    "2/m": (2, 60.0, 90.0, 180.0),
    "mmm": (4, 60.0, 90.0, 0.0),
    "4/m": (4, 30.0, 0.0, 180.0),
    "4/mmm": (8, 30.0, 0.0, 0.0),
    "-3": (3, 60.0, 30.0, 180.0),
    "-3m": (6, 60.0, 30.0, 0.0),
    "6/m": (6, 0.0, 30.0, 180.0),
    "6/mmm": (12, 0.0, 30.0, 0.0),
    "m-3": (12, 60.0, 90.0, 0.0),
    "m-3m": (24, 30.0, 0.0, 0.0),
}


def angle(name, axis, turn, two_fold="x"):
    """Smallest angle of a turn about an axis of the crystal, seen from any orientation."""
    first = Rotation.random(5, random_state=1)
    second = first * Rotation.from_rotvec(math.radians(turn) * np.asarray(axis, dtype=float))
    group = laue.rotations(name, two_fold)
    return laue.misorientations(first.as_quat(), second.as_quat(), group)


@pytest.mark.parametrize("name", GROUPS)
def test_turns_that_a_group_makes_alike(name):
    count, about_c, quarter, half = GROUPS[name]
    assert len(laue.rotations(name)) == count
    z, x = (0, 0, 1), (1, 0, 0)
    if name == "2/m":  # its axis is b
        assert angle(name, (0, 1, 0), 180, "y") == pytest.approx(0.0, abs=1e-5)
        assert angle(name, z, 180, "y") == pytest.approx(180.0, abs=1e-5)
    else:
        assert angle(name, z, 60) == pytest.approx(about_c, abs=1e-5)
        assert angle(name, z, 90) == pytest.approx(quarter, abs=1e-5)
        assert angle(name, x, 180) == pytest.approx(half, abs=1e-5)
    assert angle(name, (0.6, 0.0, 0.8), 7) == pytest.approx(7.0, abs=1e-5)
    # the rotations are a group
    all_of = Rotation.from_quat(laue.rotations(name))
    for one, other in itertools.product(all_of, all_of):
        turns = (all_of.inv() * (one * other)).magnitude()
        assert turns.min() < 1e-6


def test_the_largest_angle_between_cubes():
    """Mackenzie's: 62.80 degrees about (1, 1, sqrt(2) - 1)."""
    axis = np.array([1.0, 1.0, math.sqrt(2.0) - 1.0])
    found = angle("m-3m", axis / np.linalg.norm(axis), 62.7994)
    assert found == pytest.approx(62.7994, abs=1e-3)
    one, other = (Rotation.random(5000, random_state=n).as_quat() for n in (1, 2))
    most = laue.misorientations(one, other, laue.rotations("m-3m")).max()
    assert 60.0 < most <= 62.8


def test_twofold_axes_of_quartz_lie_along_its_edges():
    """A half turn about a, and about what lies 60 degrees from it; not about a*."""
    for axis, first in (("x", 0.0), ("y", 90.0)):
        for more in (0.0, 60.0, 30.0):
            turn = math.radians(first + more)
            found = angle("-3m", (math.cos(turn), math.sin(turn), 0.0), 180.0, axis)
            assert found == pytest.approx(60.0 if more == 30.0 else 0.0, abs=1e-5)


def map_of(rows, columns, grains, seed, steps=(1.0, 1.0), hexagonal=False):
    """Grains of random points, two phases, their orientations and noise of a degree."""
    draw = np.random.default_rng(seed)
    y, x = np.mgrid[:rows, :columns].astype(float)
    if hexagonal:
        x[1::2] += 0.5
    at = np.column_stack((x.ravel() * steps[0], y.ravel() * steps[1]))
    places = draw.random((grains, 2)) * (columns * steps[0], rows * steps[1])
    number = cKDTree(places).query(at)[1].reshape(rows, columns)
    mean = Rotation.random(grains, random_state=seed)
    turned = mean[number.ravel()] * Rotation.from_rotvec(
        np.radians(draw.normal(0.0, 0.5, (rows * columns, 3)))
    )
    angles = turned.as_euler("ZXZ", degrees=True).reshape(rows, columns, 3) % 360.0
    return number, number % 2 + 1, angles


PHASES = [("Quartz-new", "-3m"), ("Biotite", "2/m")]


def of(path, **options):
    return ebsd.grains(ebsd.read(path), **options)


@pytest.mark.parametrize("hexagonal", [False, True])
@pytest.mark.parametrize(("kind", "text"), [("ctf", ctf_text), ("ang", ang_text)])
def test_grains_are_those_that_were_drawn(tmp_path, kind, text, hexagonal):
    steps = (2.0, 3.0**0.5) if hexagonal else (2.0, 1.5)
    number, phase, angles = map_of(40, 50, 30, 3, steps, hexagonal)
    path = tmp_path / f"a.{kind}"
    path.write_text(text(phase, angles, PHASES, steps, hexagonal))
    found = of(path)
    assert found.counts["not_indexed"] == 0 and found.counts["missing"] == 0
    raster = ebsd.read(path).raster
    drawn = number.ravel()
    if hexagonal:
        late = np.arange(40) % 2 == 1
        drawn = np.concatenate([row[: 50 - end] for row, end in zip(number, late, strict=True)])
    drawn = drawn[raster]
    # each label is one drawn grain, each drawn grain that hangs together one label
    pairs = np.unique(np.stack((found.labels.ravel(), drawn.ravel())), axis=1)
    assert len(np.unique(pairs[0])) == pairs.shape[1]
    assert pairs.shape[1] <= len(np.unique(drawn)) + 2
    assert found.names == ["Quartz-new", "Biotite"]
    for label, of_drawn in pairs.T.tolist():
        assert found.minerals[label] == of_drawn % 2
    made = Specimen.from_ebsd(path, 0.01, smallest=1)
    area = 40 * 50 * steps[0] * steps[1] * 1e-12
    assert made.tessellation.cell_areas.sum() == pytest.approx(area, rel=1e-7)
    first = np.bincount(made.minerals, made.tessellation.cell_areas)[0]
    assert first == pytest.approx(area * (drawn % 2 == 0).mean(), rel=1e-6)


@pytest.mark.parametrize("group", ["-3m", "6/mmm", "m-3m", "-1"])
def test_a_boundary_is_one_from_the_misorientation_on(tmp_path, group):
    """Two halves 9.9 and 10.1 degrees apart, one of them told by an angle of the symmetry."""
    alike = {"-3m": 120.0, "6/mmm": 60.0, "m-3m": 90.0, "-1": 0.0}[group]
    phase = np.ones((6, 8), dtype=int)
    for turn, grains in ((9.9, 1), (10.1, 2)):
        angles = np.tile([20.0, 30.0, 40.0], (6, 8, 1))
        angles[:, 4:, 2] += turn + alike
        (tmp_path / "a.ctf").write_text(ctf_text(phase, angles, [("one", group)]))
        (tmp_path / "a.ang").write_text(ang_text(phase, angles, [("one", group)]))
        for end in ("ctf", "ang"):
            found = of(tmp_path / f"a.{end}")
            assert len(np.unique(found.labels)) == grains
    found = of(tmp_path / "a.ctf", misorientation=12.0)
    assert len(np.unique(found.labels)) == 1


def test_points_without_a_phase_go_to_most_of_their_neighbours_or_are_holes(tmp_path):
    _, phase, angles = map_of(20, 20, 2, 1)
    phase[:] = 1
    phase[:, 12:] = 2
    angles[:] = 10.0
    phase[5:9, 4:8] = 0
    phase[14, 12] = 0  # three of four neighbours are of the second phase
    lines = ctf_text(phase, angles, PHASES).splitlines()
    del lines[-3]  # a point that is not there
    (tmp_path / "a.ctf").write_text("\n".join(lines))
    found = of(tmp_path / "a.ctf")
    assert found.counts == {"points": 399, "not_indexed": 17, "missing": 1, "filled": 18}
    assert np.array_equal(found.labels, np.where(np.arange(20) < 12, 0, 1) * np.ones((20, 1)))
    holes = of(tmp_path / "a.ctf", unindexed="hole")
    assert np.count_nonzero(holes.labels == -1) == 18 and "filled" not in holes.counts
    made = Specimen.from_ebsd(tmp_path / "a.ctf", 0.01, unindexed="hole", smallest=2)
    assert len(made.holes) == 1
    assert made.regions["not_indexed"] == 17


def test_parts_of_a_grain_that_a_gap_parts_are_one_grain_once_it_is_filled(tmp_path):
    phase, angles = np.ones((8, 9), dtype=int), np.full((8, 9, 3), 10.0)
    angles[:, 6:, 0] = 50.0  # another grain
    phase[:, 3] = 0
    (tmp_path / "a.ctf").write_text(ctf_text(phase, angles, PHASES))
    found = of(tmp_path / "a.ctf")
    assert np.array_equal(found.labels, np.where(np.arange(9) < 6, 0, 1) * np.ones((8, 1)))
    holes = of(tmp_path / "a.ctf", unindexed="hole")
    assert len(np.unique(holes.labels)) == 4


@pytest.mark.parametrize("kind", ["ctf", "ang"])
@pytest.mark.parametrize("hexagonal", [False, True])
def test_steps_of_the_points_count_where_those_of_the_head_do_not_fit(tmp_path, kind, hexagonal):
    """As in maps that were thinned, or written by another program."""
    steps = (0.4, 0.35) if not hexagonal else (0.4, 0.3464)
    number, phase, angles = map_of(40, 50, 30, 3, steps, hexagonal)
    text = {"ctf": ctf_text, "ang": ang_text}[kind](phase, angles, PHASES, steps, hexagonal)
    path, wrong = tmp_path / f"a.{kind}", tmp_path / f"wrong.{kind}"
    path.write_text(text)
    wrong.write_text(text.replace(f"{steps[1]}\n", "0.1\n").replace("HexGrid", "SqrGrid"))
    one, other = ebsd.read(path), ebsd.read(wrong)
    assert np.array_equal(one.raster, other.raster)
    assert other.grid.sides == pytest.approx(one.grid.sides, rel=1e-6)
    assert one.grid.unlike_head == {}
    told = f"0.4 x {steps[1]} um by the points, not 0.4 x 0.1 um as in the head"
    assert of(wrong).counts["steps"] == told


@pytest.mark.parametrize("kind", ["ctf", "ang"])
@pytest.mark.parametrize("hexagonal", [False, True])
def test_a_map_that_ends_early_is_refused_with_both_numbers(tmp_path, kind, hexagonal):
    """The last rows are gone, whole or in part, or the last columns."""
    _, phase, angles = map_of(10, 40, 9, 3, (1.0, 0.866), hexagonal)
    text = {"ctf": ctf_text, "ang": ang_text}[kind](phase, angles, PHASES, (1.0, 0.866), hexagonal)
    path = tmp_path / f"a.{kind}"
    path.write_text(text)
    whole = of(path).counts
    assert whole["missing"] == 0 and "cells" not in whole
    lines = text.splitlines()
    points = 400 - 5 * hexagonal
    head = lines[:-points]
    assert len(lines) - len(head) == whole["points"] == points
    for rows, kept in ((6, 240 - 3 * hexagonal), (7, 250 - 3 * hexagonal)):
        path.write_text("\n".join(lines[: len(head) + kept]))
        refusal(rf"= 40 x 10 points, the file has 40 x {rows}; export", of, path)
    # within the last row points are missing, which are counted as before
    path.write_text("\n".join(lines[:-5]))
    assert of(path).counts["missing"] == 5
    # without the last column
    last = {f"{x:.4f}" if kind == "ctf" else f"{x:.5f}" for x in (39.0, 38.5)}
    place = 1 if kind == "ctf" else 3
    path.write_text(
        "\n".join([*head, *(p for p in lines[len(head) :] if p.split()[place] not in last)])
    )
    refusal(r"= 40 x 10 points, the file has 39 x 10", of, path)


@pytest.mark.parametrize("times", [2, 3])
@pytest.mark.parametrize("kind", ["ctf", "ang"])
def test_a_map_that_was_thinned_tells_its_steps_and_points(tmp_path, kind, times):
    """Each second or third point of each such row, below the head of the whole map."""
    _, phase, angles = map_of(30, 40, 9, 3)
    make = {"ctf": ctf_text, "ang": ang_text}[kind]
    head = make(phase, angles, PHASES).splitlines()[:-1200]
    thin = np.s_[::times, ::times]
    own = make(phase[thin], angles[thin], PHASES, (float(times), float(times))).splitlines()
    count = phase[thin].size
    path = tmp_path / f"a.{kind}"
    path.write_text("\n".join([*head, *own[-count:]]))
    found = of(path)
    rows, columns = phase[thin].shape
    assert found.labels.shape == (rows, columns)
    assert found.counts["missing"] == 0
    assert (
        found.counts["steps"] == f"{times} x {times} um by the points, not 1 x 1 um as in the head"
    )
    assert found.counts["cells"] == f"{columns} x {rows} by the points, not 40 x 30 as in the head"
    # a thinned map that ends early, too, is refused
    path.write_text("\n".join([*head, *own[-count : -4 * columns]]))
    refusal(rf"= 40 x 30 points, the file has {columns} x {rows - 4}", of, path)


def test_heads_without_numbers_of_points_are_read_as_they_are(tmp_path):
    _, phase, angles = map_of(10, 12, 5, 3)
    for kind, make in (("ctf", ctf_text), ("ang", ang_text)):
        text = make(phase, angles, PHASES)
        kept = [row for row in text.splitlines() if "Cells" not in row and "NCOLS" not in row]
        path = tmp_path / f"a.{kind}"
        path.write_text(text)
        expected = of(path)
        path.write_text("\n".join(row for row in kept if "NROWS" not in row))
        found = of(path)
        assert np.array_equal(found.labels, expected.labels) and found.counts == expected.counts


def test_a_grid_of_another_kind_than_in_the_head_is_told_as_such(tmp_path):
    _, phase, angles = map_of(10, 12, 5, 3, (0.5, 0.5))
    text = ang_text(phase, angles, PHASES, (0.5, 0.5))
    (tmp_path / "a.ang").write_text(text.replace("SqrGrid", "HexGrid"))
    found = of(tmp_path / "a.ang").counts
    assert found["grid"] == "square by the points, not hexagonal as in the head"
    assert "steps" not in found and "cells" not in found
    six = (0.5, 0.433)
    _, phase, angles = map_of(10, 12, 5, 3, six, hexagonal=True)
    text = ang_text(phase, angles, PHASES, six, hexagonal=True)
    (tmp_path / "a.ang").write_text(text.replace("HexGrid", "SqrGrid"))
    found = of(tmp_path / "a.ang").counts
    assert found["grid"] == "hexagonal by the points, not square as in the head"
    assert "steps" not in found and "cells" not in found


def layered(text, layers):
    """A map of several layers, as programs for volumes write it."""
    lines = text.replace("YCells", f"ZCells\t{layers}\nYCells").splitlines()
    first = next(at for at, row in enumerate(lines) if row.startswith("Phase\t")) + 1
    lines[first - 1] = lines[first - 1].replace("Y\t", "Y\tZ\t")
    found = lines[:first]
    for layer in range(layers):
        for row in lines[first:]:
            cells = row.split("\t")
            found.append("\t".join([*cells[:3], f"{layer:.4f}", *cells[3:]]))
    return "\n".join(found)


def test_maps_of_several_layers_are_refused_by_what_they_are(tmp_path):
    _, phase, angles = map_of(10, 12, 5, 3)
    text = ctf_text(phase, angles, PHASES)
    path = tmp_path / "a.ctf"
    path.write_text(layered(text, 5))
    refusal("ZCells = 5, must be 1: stacks of maps are not read", of, path)
    path.write_text(layered(text, 5).replace("ZCells\t5\n", ""))
    refusal("Z = 5 layers, must be 1: stacks of maps are not read", of, path)
    path.write_text(text)
    expected = of(path)
    path.write_text(layered(text, 1))
    assert np.array_equal(of(path).labels, expected.labels)


@pytest.mark.parametrize("hexagonal", [False, True])
def test_a_head_may_leave_the_steps_to_the_points(tmp_path, hexagonal):
    steps = (0.4, 0.3464 if hexagonal else 0.35)
    _, phase, angles = map_of(20, 30, 9, 3, steps, hexagonal)
    text = ang_text(phase, angles, PHASES, steps, hexagonal)
    (tmp_path / "a.ang").write_text(text)
    lines = [row for row in text.splitlines() if "STEP" not in row]
    short = "\n".join(lines).replace("Grid\n", "Grid#\n")
    (tmp_path / "short.ang").write_text(short)
    one, other = ebsd.read(tmp_path / "a.ang"), ebsd.read(tmp_path / "short.ang")
    assert np.array_equal(one.raster, other.raster)
    told = f"0.4 x {steps[1]} um by the points, none in the head"
    assert of(tmp_path / "short.ang").counts["steps"] == told


def test_heads_as_other_programs_write_them(tmp_path):
    """Tabulators, groups in full, and phases that have no number; ``.ang`` files."""
    _, phase, angles = map_of(12, 12, 6, 2)
    text = ang_text(phase, angles, [("a", "m-3m"), ("b", "-3m")])
    (tmp_path / "a.ang").write_text(text)
    expected = of(tmp_path / "a.ang").labels
    for old, new in (
        ("# Symmetry              ", "# Symmetry\t\t"),
        ("# Symmetry              43", "# Symmetry 432"),
        ("# Symmetry              32", "# Symmetry  -3m"),
        ("# Phase 1\n", ""),
        ("# GRID: SqrGrid", "# GRID:\tSqrGrid"),
    ):
        changed = text.replace(old, new)
        (tmp_path / "a.ang").write_text(changed.replace("# Phase 2\n", "") if not new else changed)
        assert np.array_equal(of(tmp_path / "a.ang").labels, expected)
    for name in GROUPS:
        changed = text.replace("# Symmetry              43", f"# Symmetry {name}")
        (tmp_path / "a.ang").write_text(changed)
        assert len(ebsd.read(tmp_path / "a.ang").phases[0].rotations) == GROUPS[name][0]


def test_the_command_names_minerals_in_the_order_of_the_file(tmp_path, capsys):
    _, phase, angles = map_of(40, 40, 20, 2)
    (tmp_path / "a.ctf").write_text(ctf_text(phase, angles, PHASES).replace(".", ","))
    (tmp_path / "phases.toml").write_text('"Quartz-new" = "quartz"\n"Biotite" = "hole"\n')
    out = ["--out", str(tmp_path / "out"), "--quiet"]
    assert cli.main(["specimen", "ebsd", str(tmp_path / "a.ctf"), *out]) == 0
    told = capsys.readouterr().out
    assert "in this order: Quartz-new, Biotite" in told
    # 25.8 GPa / (1.8e14 Pa/m x 10 um)
    soft = float(told.partition("are ")[2].split()[0])
    mean = Specimen.load(tmp_path / "out/grains.json").mean_diameter
    assert soft == pytest.approx(25.8e9 / (1.8e14 * mean), rel=0.05)
    found = json.loads((tmp_path / "out/specimen.json").read_text())
    assert found["image"]["points"] == 1600
    given = [str(tmp_path / "a.ctf"), "--phases", str(tmp_path / "phases.toml"), *out]
    assert cli.main(["specimen", "ebsd", *given, "--smallest", "1"]) == 0
    assert Specimen.load(tmp_path / "out/grains.json").minerals is None
    (tmp_path / "phases.toml").write_text('"Quartz" = "quartz"\n')
    refused_command(capsys, "did you mean Quartz-new?", "specimen", "ebsd", *given)


def broken():
    phase, angles = np.ones((3, 4), dtype=int), np.zeros((3, 4, 3))
    ctf, ang = (make(phase, angles, PHASES) for make in (ctf_text, ang_text))
    last = ctf.splitlines()[-1]
    return [
        ("a.ctf", "", "line 1: must begin with Channel Text File"),
        ("a.ctf", ctf.replace("XStep\t1.0\n", ""), "XStep is missing"),
        ("a.ctf", ctf.replace("Mode\tGrid", "Mode\tInteractive"), "line 4: JobMode = Interactive"),
        ("a.ctf", ctf.replace("XStep\t1.0", "XStep\tx"), "line 7: XStep = 'x', must be a number"),
        ("a.ctf", ctf.replace("XCells\t4", "XCells\tx"), "line 5: XCells = 'x', must be a number"),
        (
            "a.ctf",
            ctf.replace("XCells\t4", "XCells\t4.5"),
            "XCells = '4.5', must be a whole number",
        ),
        ("a.ang", ang.replace("NROWS: 3", "NROWS: -3"), "NROWS = '-3', must be a whole number"),
        ("a.ctf", ctf.replace("1\t2.0000", "1\t2.3000"), "must be on the grid of steps 1 and 1"),
        ("a.ctf", ctf.replace("Biotite\t2", "Biotite\t12"), "Laue group = 12, must be 1 to 11"),
        ("a.ctf", ctf.replace("Phases\t2", "Phases\t3"), "line 16: Laue group = 'Bands', must"),
        ("a.ctf", ctf.replace("\tEuler3", ""), "columns Euler3 are missing"),
        ("a.ctf", ctf.replace(last, last.replace("2.0000", "oh", 1)), "column 3 = 'oh', must be"),
        ("a.ctf", ctf.replace(last, "9" + last[1:]), "point 12: Phase = 9"),
        ("a.ctf", ctf + last + "\n", "is given twice"),
        ("a.ctf", ctf.replace(last, "1\t2"), "columns = 2, must be >= 8"),
        ("a.ang", ang.replace("# GRID: SqrGrid\n", ""), "GRID is missing"),
        ("a.ang", ang.replace("SqrGrid", "Round"), "GRID = Round, must be SqrGrid or HexGrid"),
        ("a.ang", ang.replace("  32\n", "  33\n"), "Symmetry = 33, must be one of 1, 2,"),
        ("a.ang", ang.replace("0.900 1 ", "0.900 7 "), "phase = 7, must be one of 1, 2"),
        ("a.ang", ang.replace("0.900", "-1.000"), "points with a phase = 0"),
        ("a.h5", ctf, "must end in .ctf or .ang"),
    ]


@pytest.mark.parametrize(("file", "text", "words"), broken(), ids=[row[2] for row in broken()])
def test_broken_maps_are_one_line_with_the_place(tmp_path, file, text, words):
    (tmp_path / file).write_text(text)
    with pytest.raises(InputError) as error:
        Specimen.from_ebsd(tmp_path / file, 0.01)
    assert words in str(error.value) and "\n" not in str(error.value)


def test_orix_reads_the_same_map(tmp_path):
    io = pytest.importorskip("orix.io")
    _, phase, angles = map_of(10, 12, 5, 4)
    (tmp_path / "a.ctf").write_text(ctf_text(phase, angles, PHASES))
    (tmp_path / "a.ang").write_text(ang_text(phase, angles, PHASES))
    for end in ("ctf", "ang"):
        theirs, ours = io.load(str(tmp_path / f"a.{end}")), ebsd.read(tmp_path / f"a.{end}")
        assert np.array_equal(theirs.phase_id - 1, ours.phase)
        # theirs turn the sample into the crystal, w first
        turned = theirs.rotations.data.reshape(-1, 4)[:, [1, 2, 3, 0]] * (-1, -1, -1, 1)
        assert np.abs(np.sum(turned * ours.orientations, axis=1)) == pytest.approx(1.0)


def test_files_know_all_groups():
    assert set(CTF) == set(ANG) == set(laue.NAMES)
