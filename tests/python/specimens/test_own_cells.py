# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells given as polygons: checked tilings; specimens saved and loaded."""

import json
import math

import numpy as np
import pytest
from neper_files import tess_text
from refusals import refusal, refused_command

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.materials.material import Material
from flexpm.report.maps import cell_polygons
from flexpm.specimens.kernel_input import Circle
from flexpm.specimens.mineral_map import minerals_of
from flexpm.specimens.specimen import Specimen

#: Two courses of bricks: the joint of the upper ones lies on an edge of the lower one.
BRICKS = [
    [(0, 0), (2, 0), (2, 1), (0, 1)],
    [(0, 1), (1, 1), (1, 2), (0, 2)],
    [(1, 1), (2, 1), (2, 2), (1, 2)],
]


#: Two minerals, one of each half of the area.
TWO = Material.from_dict(
    {
        **{"tensile_strength": 8e6, "cohesion": 30e6, "friction": 0.4, "softening": "brittle"},
        "elastic": {"rigid": {"normal_stiffness": 1e14, "shear_ratio": 0.3}},
        "mineral": [{"name": name, "fraction": 0.5} for name in ("quartz", "mica")],
    }
)


def scaled(polygons, size=1e-3):
    return [size * np.array(polygon, dtype=float) for polygon in polygons]


def test_bricks():
    specimen = Specimen.from_polygons(scaled(BRICKS), 0.01)
    cells = specimen.tessellation
    assert cells.shared_edges[:, :2].tolist() == [[0, 1], [0, 2], [1, 2]]
    np.testing.assert_allclose(cells.cell_areas, [2e-6, 1e-6, 1e-6], rtol=1e-12)
    assert specimen.dimensions == {"width": 2e-3, "height": 2e-3}
    np.testing.assert_allclose(specimen.discs[0], [1e-3, 0.5e-3, math.sqrt(2e-6 / math.pi)])
    assert sorted(set(cells.boundary_edges[:, 3].tolist())) == [0, 1, 2, 3]
    bottom = cells.boundary_edges[cells.boundary_edges[:, 3] == 0]
    assert np.all(cells.vertices[bottom[:, 1:3]][..., 1] == 0.0)


def test_the_cells_of_a_packing_are_the_same_again():
    packed = Specimen.rectangle(0.02, 0.04, 0.08)
    again = Specimen.from_polygons(
        [polygon[::-1] for polygon in cell_polygons(packed.tessellation)], 0.08
    )
    assert again.kind == "rectangle"
    pairs = packed.tessellation.shared_edges[:, :2]
    np.testing.assert_array_equal(again.tessellation.shared_edges[:, :2], pairs)
    # the centre nodes and the normals lie elsewhere
    stiff = [flexpm.elastic(one)["youngs_modulus"] for one in (packed, again)]
    assert stiff[1] == pytest.approx(stiff[0], rel=0.02)


def test_corners_are_snapped():
    off = scaled(BRICKS)
    off[0] = off[0] + 3e-10  # of 1.6e-3 m, the mean diameter
    specimen = Specimen.from_polygons(off, 0.01)
    assert len(specimen.tessellation.shared_edges) == 3


def test_a_bent_cell_is_split():
    bent = [(0, 0), (3, 0), (3, 3), (2.8, 3), (2.8, 0.2), (0.2, 0.2), (0.2, 3), (0, 3)]
    fill = [(0.2, 0.2), (2.8, 0.2), (2.8, 3), (0.2, 3)]
    specimen = Specimen.from_polygons(scaled([bent, fill]), 0.01)
    assert specimen.tessellation.cells == 3
    assert math.fsum(specimen.tessellation.cell_areas) == pytest.approx(9e-6, rel=1e-12)
    assert specimen.kind == "rectangle"


def area_of(polygon):
    (x, y), (next_x, next_y) = np.transpose(polygon), np.roll(polygon, -1, axis=0).T
    return 0.5 * abs(float(np.sum(x * next_y - next_x * y)))


def test_pieces_of_a_split_cell_know_their_cell(tmp_path):
    """Areas of the pieces sum up to those of the given cells, from polygons and from Neper."""
    bent = [(0, 0), (3, 0), (3, 3), (2.8, 3), (2.8, 0.2), (0.2, 0.2), (0.2, 3), (0, 3)]
    fill = [(0.2, 0.2), (2.8, 0.2), (2.8, 3), (0.2, 3)]
    given = scaled([bent, fill])
    split = Specimen.from_polygons(given, 0.01)
    assert split.grains.tolist() == [0, 1, 0]
    around = scaled([SQUARE, square_at(4, 5), square_at(6, 5)])
    rings = Specimen.from_polygons(around, 0.01)
    corners = sorted({corner for ring in (bent, fill) for corner in ring})
    text = tess_text(corners, [[corners.index(corner) for corner in ring] for ring in (bent, fill)])
    (tmp_path / "a.tess").write_text(text)
    for specimen, cells in (
        (split, given),
        (rings, around),
        (Specimen.from_tess(tmp_path / "a.tess", 0.01, scale=1e-3), given),
    ):
        areas = np.bincount(specimen.grains, specimen.tessellation.cell_areas)
        expected = [area_of(cell) for cell in cells]
        if cells is around:
            expected[0] -= sum(expected[1:])
        np.testing.assert_allclose(areas, expected, rtol=1e-9)
        specimen.save(tmp_path / "it.json")
        again = Specimen.load(tmp_path / "it.json")
        assert again.spec == specimen.spec
        np.testing.assert_array_equal(again.grains, specimen.grains)
        # a mineral is drawn for each given cell, not for each piece
        drawn = minerals_of(specimen, TWO)
        for grain in range(len(cells)):
            assert len({*drawn[specimen.grains == grain].tolist()}) == 1
    # whole cells are grains each
    assert Specimen.from_polygons(scaled(BRICKS), 0.01).grains is None


def test_pieces_of_a_sawn_grain_know_it(tmp_path):
    """A slot through the first cells of a packing parts some grains in two."""
    slot = [(0.0, 0.0), (0.02, 0.0), (0.02, 0.02), (0.0102, 0.02), (0.0102, 0.004)]
    slot += [(0.0098, 0.004), (0.0098, 0.02), (0.0, 0.02)]
    sawn = Specimen.polygon(slot, 0.01)
    assert sawn.grains is not None
    count = int(sawn.grains.max()) + 1
    assert count < sawn.tessellation.cells
    halves = np.flatnonzero(np.bincount(sawn.grains) == 2)
    assert len(halves) >= 3
    for grain in halves:  # one on each side, at most a grain's diameter apart
        places = sawn.centres[sawn.grains == grain]
        assert np.hypot(*(places[1] - places[0])) < 4e-3
    cut = sawn.with_joints({"a": [(-0.001, 0.0103), (0.021, 0.0121)]})
    np.testing.assert_array_equal(cut.grains[: len(sawn.grains)], sawn.grains)
    assert len(cut.grains) > len(sawn.grains) and {*cut.grains} == {*sawn.grains}
    for specimen in (sawn, cut):
        specimen.save(tmp_path / "it.json")
        again = Specimen.load(tmp_path / "it.json")
        assert again.spec == specimen.spec
        np.testing.assert_array_equal(again.grains, specimen.grains)
    # without a part that is sawn in two there is nothing to tell
    assert Specimen.polygon([(0, 0), (0.02, 0), (0, 0.02)], 0.01).grains is None


SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10)]


def square_at(x, y, half=1.0):
    return [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]


@pytest.mark.parametrize(
    "inside",
    [
        [square_at(5, 5)],
        [square_at(5, 5)[::-1]],
        # two grains side by side, and one within a grain within a grain
        [square_at(4, 5), square_at(6, 5)],
        [square_at(5, 5, 3), square_at(5, 5)],
        [square_at(2, 5), square_at(5, 5), square_at(8, 5)],
        [square_at(x, y, 0.7) for x in (2, 5, 8) for y in (2, 5, 8)],
    ],
)
def test_a_grain_within_a_grain(inside):
    """The grain around goes round in parts; all of its rim and of theirs are contacts."""
    specimen = Specimen.from_polygons(scaled([SQUARE, *inside]), 0.01)
    cells = specimen.tessellation
    assert math.fsum(cells.cell_areas) == pytest.approx(1e-4, rel=1e-12)
    assert specimen.kind == "rectangle"
    assert specimen.holes == ()
    assert len(cells.boundary_edges) == 4
    for number, polygon in enumerate(cell_polygons(cells)[1 : len(inside) + 1], 1):
        # all sides of what has nothing inside are contacts
        own = (cells.shared_edges[:, :2] == number).any(axis=1)
        assert own.sum() >= 4, polygon
    flexpm.elastic(specimen)


def test_what_overlaps_is_no_grain_within_a_grain():
    with pytest.raises(InputError, match=r"polygons: boundary at|polygon 1: corner = "):
        Specimen.from_polygons(scaled([SQUARE, square_at(9.5, 5)]), 0.01)
    with pytest.raises(InputError, match="polygon 0") as refused:
        Specimen.from_polygons(scaled([SQUARE, [(12, 0), (13, 0), (13, 1)]]), 0.01)
    assert "polygon 1 at (0.012, 0) m" in str(refused.value)
    # over two cells that have no boundary there
    with pytest.raises(InputError, match=r"polygon 3: corner = .* must not cross the sides of"):
        Specimen.from_polygons(scaled([*BRICKS, square_at(1.1, 1.5, 0.2)]), 0.01)


def closed(ring):
    return [*ring, ring[0]]


def test_closed_rings_are_open_ones():
    """GeoJSON, shapefiles and shapely give the first corner twice."""
    closed_bricks = [closed(ring) for ring in BRICKS]
    require_same(
        Specimen.from_polygons(scaled(closed_bricks), 0.01),
        Specimen.from_polygons(scaled(BRICKS), 0.01),
    )
    outline = [(0.0, 0.0), (0.02, 0.0), (0.02, 0.03), (0.0, 0.03)]
    hole = [(0.008, 0.01), (0.012, 0.01), (0.012, 0.02), (0.008, 0.02)]
    require_same(
        Specimen.polygon(closed(outline), 0.01, holes=[closed(hole)]),
        Specimen.polygon(outline, 0.01, holes=[hole]),
    )
    packed = Specimen.rectangle(0.02, 0.03, 0.01)
    given = packed.centres, packed.radii
    require_same(
        Specimen.from_discs(*given, closed(outline), 0.01),
        Specimen.from_discs(*given, outline, 0.01),
    )
    assert Specimen.polygon(closed(outline), 0.01).kind == "rectangle"


def test_hidden_discs_are_dropped_or_all_told():
    centres = np.array([(x, y) for x in (1.0, 3.0, 5.0) for y in (1.0, 3.0)]) * 1e-3
    outline = 1e-3 * np.array([(0, 0), (6, 0), (6, 4), (0, 4)])
    hidden = centres[[0, 3]] + 1e-5
    every = np.vstack((centres, hidden)), np.array([1e-3] * 6 + [1e-4] * 2)
    with pytest.raises(InputError, match=r"hidden discs = 2 \(6, 7\), must have a cell"):
        Specimen.from_discs(*every, outline, 0.01)
    kept = Specimen.from_discs(*every, outline, 0.01, drop_hidden=True)
    assert kept.removed_discs == 2
    require_same(kept, Specimen.from_discs(centres, every[1][:6], outline, 0.01))


def two_contacts_of_a_pair():
    """A cell around a corner of another: they share two edges."""
    corner = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    return Specimen.from_polygons(scaled([corner, [(1, 1), (2, 1), (2, 2), (1, 2)]]), 0.01)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_pair_may_share_two_edges(model):
    specimen = two_contacts_of_a_pair()
    assert specimen.tessellation.shared_edges[:, :2].tolist() == [[0, 1], [0, 1]]
    built = flexpm.build(specimen, model=model)
    assert built.counts()["contacts"] == 2
    built.run(250)
    assert built.counts()["contacts"] == 2
    assert built.snapshot().contact_grains.tolist() == [[0, 1], [0, 1]]


def test_erasing_a_pair_erases_all_of_its_contacts():
    import yade

    built = flexpm.build(two_contacts_of_a_pair())
    yade.O.interactions.erase(0, 1)
    built.run(1)
    assert built.counts()["contacts"] == 0


def test_a_hole_is_meant_or_refused():
    frame = [
        [(0, 0), (3, 0), (2, 1), (1, 1)],
        [(3, 0), (3, 3), (2, 2), (2, 1)],
        [(3, 3), (0, 3), (1, 2), (2, 2)],
        [(0, 3), (0, 0), (1, 1), (1, 2)],
    ]
    specimen = Specimen.from_polygons(scaled(frame), 0.01, holes=True)
    assert len(specimen.holes) == 1
    with pytest.raises(InputError, match=r"gap at \(0.001, 0.001\) m, area = 1e-06 m\^2"):
        Specimen.from_polygons(scaled(frame), 0.01)


@pytest.mark.parametrize(
    ("polygons", "message"),
    [
        ([], "polygons = 0, must be >= 1"),
        ([BRICKS[0], [(0, 0.9), (2, 0.9), (2, 2), (0, 2)]], "overlap"),
        (
            [*BRICKS, [(0.2, 0.2), (0.5, 0.2), (0.5, 1.5)]],
            r"polygon 0 at .*|polygons: boundary|polygon 3: corner",
        ),
        (
            [*BRICKS, [(3, 0), (4, 0), (4, 1)]],
            r"= 2, must be 1; polygon 3 at \(0.003, 0\) m does not reach polygon 0 at \(0, 0\) m",
        ),
        ([*BRICKS, BRICKS[1]], "must not overlap polygon 1"),
        ([BRICKS[0], [(0, 1.1), (2, 1.1), (2, 2), (0, 2)]], "connected parts = 2"),
        (
            [BRICKS[0], [(0, 1), (1, 1.1), (2, 1), (2, 2), (0, 2)]],
            "polygons: gap at|must not meet itself",
        ),
        ([[(0, 0), (1, 1), (1, 0), (0, 1)]], "polygon 0: side 2 .* must not cross or touch side 0"),
        ([BRICKS[0][:2]], "polygon 0: corners = 2, must be >= 3"),
        ([[(0, 0), (1, 0), (math.inf, 1)]], "must be finite"),
        ([[(0, 0), (1, 0), (2, 0)]], "must not cross or touch"),
    ],
)
def test_polygons_that_are_no_tiling(polygons, message):
    refusal(message, Specimen.from_polygons, scaled(polygons), 0.01)


def test_spheres_have_no_given_cells():
    specimen = Specimen.from_polygons(scaled(BRICKS), 0.01)
    with pytest.raises(
        InputError,
        match="model = jcfpm, must be flexible or rigid .* given cells",
    ):
        flexpm.build(specimen, model="jcfpm")


def require_same(first, second):
    assert first.spec == second.spec
    for name in ("vertices", "cell_offsets", "cell_vertices", "shared_edges", "boundary_edges"):
        np.testing.assert_array_equal(
            getattr(first.tessellation, name), getattr(second.tessellation, name)
        )
    np.testing.assert_array_equal(first.discs, second.discs)
    if isinstance(first.outline, Circle):
        assert first.outline == second.outline
    else:
        np.testing.assert_array_equal(first.outline, second.outline)
    assert len(first.holes) == len(second.holes)
    if first.minerals is not None:
        np.testing.assert_array_equal(first.minerals, second.minerals)


@pytest.mark.parametrize(
    "made",
    [
        lambda: Specimen.rectangle(0.02, 0.04, 0.08, seed=3),
        lambda: Specimen.disc(0.03, 0.08),
        lambda: Specimen.polygon([(0, 0), (0.03, 0), (0.03, 0.03), (0.01, 0.01)], 0.08),
        lambda: Specimen.from_polygons(scaled(BRICKS), 0.01).with_minerals([0, 1, 0]),
    ],
)
def test_a_specimen_is_loaded_to_the_bit(made, tmp_path):
    specimen = made()
    specimen.save(tmp_path / "specimen.json")
    require_same(specimen, Specimen.load(tmp_path / "specimen.json"))


def test_a_file_is_plain_json(tmp_path):
    specimen = Specimen.from_polygons(scaled(BRICKS), 0.01)
    specimen.save(tmp_path / "specimen.json")
    content = json.loads((tmp_path / "specimen.json").read_text())
    assert content["cells"] == [[0, 1, 2, 3, 4], [4, 3, 5, 6], [3, 2, 7, 5]]
    assert content["vertices"][3] == [1e-3, 1e-3]


def test_a_changed_file_is_refused(tmp_path):
    file = tmp_path / "specimen.json"
    Specimen.from_polygons(scaled(BRICKS), 0.01).save(file)
    file.write_text(file.read_text().replace("0.002", "0.003"))
    refusal("was changed after it was saved", Specimen.load, file)
    file.write_text("{}")
    refusal("is not a specimen file of this version", Specimen.load, file)
    file.write_text("{")
    refusal("is not a JSON table", Specimen.load, file)
    refusal("cannot be read", Specimen.load, tmp_path / "none.json")


def test_the_command_takes_a_specimen(tmp_path, capsys):
    file = tmp_path / "specimen.json"
    specimen = Specimen.polygon([(0, 0), (0.02, 0), (0.02, 0.04), (0, 0.04)], 0.08, seed=5)
    specimen.save(file)
    arguments = ["elastic", "--specimen", str(file), "--out", str(tmp_path / "out"), "--quiet"]
    assert cli.main(arguments) == 0
    found = json.loads((tmp_path / "out" / "result.json").read_text())
    assert found["youngs_modulus"] == flexpm.elastic(specimen)["youngs_modulus"]
    assert found["inputs"]["specimen"]["outline"] == specimen.spec.outline
    assert cli.main([*arguments, "--width", "0.02"]) == 2
    assert "width = 0.02, must not be given with specimen" in capsys.readouterr().err
    refused_command(capsys, "cannot be read", "run", "uniaxial", "--specimen", tmp_path / "none")
