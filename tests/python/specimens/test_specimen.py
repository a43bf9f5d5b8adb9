# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens: the paper's counts, cells that tile the outline, explicit discs, refused input."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from refusals import refusal

from flexpm.errors import InputError
from flexpm.specimens.spec import SpecimenSpec
from flexpm.specimens.specimen import SHORT_EDGE, Circle, Specimen

SQUARE = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]


def polygons(specimen):
    cells = specimen.tessellation
    offsets = cells.cell_offsets
    return [
        cells.vertices[cells.cell_vertices[offsets[k] : offsets[k + 1]]] for k in range(cells.cells)
    ]


def area(polygon):
    x, y = (polygon - polygon[0]).T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def require_tiling(specimen, total):
    areas = [area(polygon) for polygon in polygons(specimen)]
    assert min(areas) > 0.0
    assert math.fsum(areas) == pytest.approx(total, rel=1e-12)
    np.testing.assert_allclose(specimen.tessellation.cell_areas, areas, rtol=1e-12)


def rim_area(specimen):
    """Area within the boundary edges, which run counter-clockwise."""
    cells = specimen.tessellation
    a, b = cells.vertices[cells.boundary_edges[:, 1]], cells.vertices[cells.boundary_edges[:, 2]]
    return 0.5 * float(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))


def require_mesh_counts(specimen):
    figures = specimen.statistics()
    assert figures["fan_fallbacks"] == 0
    assert figures["refined_nodes"] == 2 * figures["cell_vertices"]
    assert figures["refined_triangles"] == 3 * figures["cell_vertices"] - 2 * figures["grains"]
    assert figures["fan_nodes"] == figures["cell_vertices"] + figures["grains"]
    assert figures["fan_triangles"] == figures["cell_vertices"]


def require_radical_axes(specimen):
    """Ends of contacts that no collapse has touched have equal power to both discs."""
    cells, discs = specimen.tessellation, specimen.discs
    merged = np.zeros(len(cells.vertices), bool)
    merged[cells.merged_vertices] = True
    edges = cells.shared_edges[~merged[cells.shared_edges[:, 2:4]].any(axis=1)]
    a, b = discs[edges[:, 0]], discs[edges[:, 1]]
    apart = np.hypot(*(b - a)[:, :2].T)
    for end in cells.vertices[edges[:, 2]], cells.vertices[edges[:, 3]]:
        power = [np.sum((end - d[:, :2]) ** 2, axis=1) - d[:, 2] ** 2 for d in (a, b)]
        off = np.abs(power[0] - power[1]) / (2.0 * apart)
        assert off.max() < 1e-9 * specimen.mean_diameter


@pytest.fixture(scope="module")
def rectangles():
    return [Specimen.rectangle(0.08, 0.16, 0.08, seed=seed) for seed in range(1, 6)]


@pytest.fixture(scope="module")
def circles():
    return [Specimen.disc(0.08, 0.08, seed=seed) for seed in range(1, 6)]


@pytest.mark.long
def test_the_papers_rectangle(rectangles):
    figures = [specimen.statistics() for specimen in rectangles]
    assert all(f["grains"] == 1630 and f["removed_discs"] == 0 for f in figures)
    assert np.mean([f["contacts"] for f in figures]) == pytest.approx(4627, rel=0.01)
    assert np.mean([f["uncollapsed_contacts"] for f in figures]) == pytest.approx(4727, rel=0.003)
    assert np.mean([f["refined_nodes"] for f in figures]) == pytest.approx(18842, rel=0.01)
    assert np.mean([f["refined_triangles"] for f in figures]) == pytest.approx(25003, rel=0.01)
    for specimen, f in zip(rectangles, figures, strict=True):
        require_tiling(specimen, 0.08 * 0.16)
        require_radical_axes(specimen)
        require_mesh_counts(specimen)
        assert f["edge_length"]["0.00"] > 0.99 * SHORT_EDGE * specimen.mean_diameter
        assert f["flipped_meshes"] < 10
        assert f["moved_centres"] == 0


@pytest.mark.long
def test_the_papers_disc(circles):
    figures = [specimen.statistics() for specimen in circles]
    assert all(f["grains"] == 640 and f["removed_discs"] == 0 for f in figures)
    assert np.mean([f["contacts"] for f in figures]) == pytest.approx(1805, rel=0.01)
    for specimen in circles:
        cells = specimen.tessellation
        rim = np.unique(cells.boundary_edges[:, 1:3])
        assert np.hypot(*cells.vertices[rim].T) == pytest.approx(0.04, rel=1e-12)
        assert len(np.unique(cells.boundary_edges[:, 0])) == len(cells.boundary_edges)
        require_tiling(specimen, rim_area(specimen))
        # 80 chords or so: the polygon lacks 1 - sin(x) / x of the disc, x = 2 pi / 80
        assert 0.997 < rim_area(specimen) / (math.pi * 0.04**2) < 1.0
        require_radical_axes(specimen)
        require_mesh_counts(specimen)


def test_contacts_come_in_the_order_of_their_grains():
    specimen = Specimen.rectangle(0.02, 0.03, 0.08, seed=3)
    pairs = specimen.tessellation.shared_edges[:, :2].tolist()
    assert pairs == sorted(pairs)
    assert all(a < b for a, b in pairs)
    assert len({tuple(pair) for pair in pairs}) == len(pairs)


def test_a_seed_gives_the_same_specimen():
    first = Specimen.rectangle(0.015, 0.02, 0.08, seed=4)
    again = Specimen.rectangle(0.015, 0.02, 0.08, seed=np.int64(4))
    assert np.array_equal(first.discs, again.discs)
    assert np.array_equal(first.tessellation.vertices, again.tessellation.vertices)
    assert np.array_equal(first.tessellation.shared_edges, again.tessellation.shared_edges)


def test_fields_of_a_specimen():
    specimen = Specimen.rectangle(width=0.012, height=0.02, thickness=0.05, seed=9)
    assert specimen.kind == "rectangle"
    assert specimen.dimensions == {"width": 0.012, "height": 0.02}
    assert (specimen.thickness, specimen.seed) == (0.05, 9)
    assert specimen.mean_diameter == 2.0 * specimen.radii.mean()
    assert specimen.tessellation.disc_of_cell.tolist() == list(range(len(specimen.discs)))
    disc = Specimen.disc(diameter=0.02, thickness=0.05, seed=9)
    assert (disc.kind, disc.dimensions) == ("disc", {"diameter": 0.02})


def test_a_board_of_squares():
    size, columns, rows = 3e-3, 6, 4
    centres = [((i + 0.5) * size, (j + 0.5) * size) for j in range(rows) for i in range(columns)]
    corners = np.array([[0, 0], [columns, 0], [columns, rows], [0, rows]]) * size
    specimen = Specimen.from_discs(centres, [size / 2] * len(centres), corners, 0.08)
    figures = specimen.statistics()
    assert specimen.kind == "rectangle"
    assert figures["contacts"] == figures["uncollapsed_contacts"] == 5 * 4 + 6 * 3
    assert figures["cell_vertices"] == 4 * 24
    np.testing.assert_allclose(specimen.tessellation.cell_areas, size**2, rtol=1e-12)
    np.testing.assert_allclose(list(figures["edge_length"].values()), size, rtol=1e-12)
    require_tiling(specimen, 24 * size**2)
    require_mesh_counts(specimen)


def test_one_and_two_discs():
    one = Specimen.from_discs([(0.4, 0.5)], [0.3], SQUARE, 1.0)
    assert area(polygons(one)[0]) == 1.0
    assert one.statistics()["contacts"] == 0
    two = Specimen.from_discs([(0.25, 0.5), (0.75, 0.5)], [0.25, 0.25], SQUARE, 1.0)
    np.testing.assert_allclose(two.tessellation.cell_areas, 0.5, rtol=1e-14)
    assert two.tessellation.shared_edges[0, :2].tolist() == [0, 1]


coordinates = st.floats(0.02, 0.98)
some_discs = st.lists(
    st.tuples(coordinates, coordinates), min_size=3, max_size=30, unique=True
).flatmap(
    lambda points: st.tuples(
        st.just(points),
        st.lists(st.floats(0.05, 0.06), min_size=len(points), max_size=len(points)),
        st.sampled_from([0.0, 0.1, 0.3]),
    )
)


@settings(max_examples=150, deadline=None)
@given(some_discs)
@example(
    ([(0.020000000000000004, 0.98), (0.02, 0.98), (0.02, 0.9799999999999999)], 3 * [0.0546875], 0.0)
)
def test_any_discs_tile_the_square_or_name_the_hidden_one(case):
    points, radii, short_edge = case
    try:
        specimen = Specimen.from_discs(points, radii, SQUARE, 1.0, short_edge=short_edge)
    except InputError as error:
        assert "hidden" in str(error)
        return
    require_tiling(specimen, 1.0)
    cells = specimen.tessellation
    assert len(cells.vertices) + cells.cells + 1 == (
        len(cells.shared_edges) + len(cells.boundary_edges) + 2
    )
    meshes = specimen.meshes()
    offsets, starts = meshes.node_offsets, meshes.triangle_offsets
    total = 0.0
    for k in range(cells.cells):
        nodes = meshes.nodes[offsets[k] : offsets[k + 1]]
        a, b, c = nodes[meshes.triangles[starts[k] : starts[k + 1]].T]
        twice = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        assert twice.min() > 0.0
        total += 0.5 * twice.sum()
    assert total == pytest.approx(1.0, rel=1e-11)


def test_arrays_outlive_the_specimen_and_are_read_only():
    vertices = Specimen.from_discs([(0.4, 0.5)], [0.3], SQUARE, 1.0).tessellation.vertices
    assert vertices.tolist() == SQUARE
    with pytest.raises(ValueError, match="read-only"):
        vertices[0, 0] = 1.0


GOOD = {"width": 0.02, "height": 0.03, "thickness": 0.08}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"width": -0.02}, "width"),
        ({"height": math.nan}, "height"),
        ({"height": "tall"}, "height"),
        ({"thickness": 0.0}, "thickness"),
        ({"thickness": math.inf}, "thickness"),
        ({"diameters": (4e-3, 2e-3)}, "diameters"),
        ({"diameters": (0.0, 2e-3)}, "smallest diameter"),
        ({"diameters": (2e-3, math.nan)}, "largest diameter"),
        ({"diameters": 3e-3}, "two numbers"),
        ({"diameters": (2e-3, 0.015)}, "largest diameter"),
        ({"diameters": (9.9e-3, 10e-3)}, "discs = "),
        ({"width": 20, "height": 40}, "choose larger diameters or a smaller specimen, in m"),
        ({"porosity": 1.0}, "porosity"),
        ({"porosity": -0.1}, "porosity"),
        ({"porosity": math.nan}, "porosity"),
        ({"porosity": "some"}, "porosity"),
        ({"seed": -1}, "seed"),
        ({"seed": 1.5}, "seed"),
        ({"short_edge": -0.1}, "short_edge"),
        ({"short_edge": 0.9}, "short_edge"),
    ],
)
def test_wrong_values_are_refused_in_one_line(change, words):
    assert " must " in refusal(words, Specimen.rectangle, **{**GOOD, **change})


@pytest.mark.parametrize(
    ("centres", "radii", "outline", "words"),
    [
        ([(0.5, 0.5)], [-0.1], SQUARE, "radius"),
        ([(0.5, 0.5)], [0.1, 0.2], SQUARE, "one per centre"),
        ([(0.5, 0.5), (1.5, 0.5)], [0.1, 0.1], SQUARE, "disc 1"),
        ([(0.5, 0.5), (0.5, 0.5)], [0.1, 0.1], SQUARE, "disc 1"),
        ([(0.5, math.nan)], [0.1], SQUARE, "finite"),
        ([0.5, 0.5], [0.1], SQUARE, "rows"),
        ([(0.5, "y")], [0.1], SQUARE, "not numbers"),
        ([(0.5, 0.5)], [0.1], SQUARE[::-1], "counter-clockwise"),
        ([(0.5, 0.5)], [0.1], SQUARE[:2], "corners"),
        ([(0.5, 0.5)], [0.1], Circle(0.5, 0.5, 0.0), "radius"),
        ([(0.5, 0.5)], [0.1], Circle(0.5, 0.5, 0.5), "enough"),
        (np.empty((0, 2)), [], SQUARE, "at least one disc"),
    ],
)
def test_wrong_discs_are_refused_in_one_line(centres, radii, outline, words):
    refusal(words, Specimen.from_discs, centres, radii, outline, 1.0)


def test_an_unknown_mesh_is_refused():
    specimen = Specimen.from_discs([(0.4, 0.5)], [0.3], SQUARE, 1.0)
    refusal("mesh = coarse", specimen.meshes, "coarse")


def test_a_specimen_is_made_again_from_its_description():
    packed = Specimen.disc(0.02, 0.01, (1e-3, 2e-3), seed=np.int64(7))
    again = Specimen.pack(packed.spec)
    assert np.array_equal(again.discs, packed.discs)
    assert packed.spec == SpecimenSpec(
        "disc", diameter=0.02, thickness=0.01, diameters=(1e-3, 2e-3), seed=7
    )
    refusal("largest diameter", SpecimenSpec, width=0.004)
    refusal("porosity = 1.0, must be < 1", SpecimenSpec, porosity=1.0)


def test_given_discs_and_minerals_are_described_by_checksums():
    def given(shift):
        centres = [[0.25 + shift, 0.5], [0.75, 0.5]]
        return Specimen.from_discs(centres, [0.2, 0.2], SQUARE, 0.1)

    first, same, other = given(0.0).spec, given(0.0).spec, given(1e-9).spec
    assert first == same
    assert (first.outline, first.seed, first.width) == (other.outline, None, 1.0)
    assert first.discs != other.discs
    refusal("cannot be packed again; load", Specimen.pack, first)
    mixed = given(0.0).with_minerals([0, 1]).spec
    assert mixed.minerals != given(0.0).with_minerals([1, 0]).spec.minerals
    assert dataclasses.replace(mixed, minerals=None) == first
