# SPDX-License-Identifier: GPL-3.0-or-later
"""Label volumes as specimens: agreement, volumes, pores, phases, elastic constants, refusals."""

from __future__ import annotations

import functools
import json
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from drawn_volumes import bent_with_fragments, power_volume, unions
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refusal
from volume_files import FORMATS, write
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import flexpm
from flexpm import Specimen
from flexpm._flexpm import Solid, weighted_cells
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.materials.material import Material
from flexpm.specimens.label_volumes.label_volume import LabelVolume
from flexpm.specimens.space.own_cells import OwnCells
from flexpm.specimens.space.specimen import SolidSpecimen
from flexpm.specimens.volumes.regions import Kinds, find
from flexpm.specimens.volumes.volume_minerals import kinds_of_file

SIDE = 1e-3
COMMAND = ["specimen", "volume", "--quiet"]


@functools.cache
def own_cells():
    """160 power cells on 40 x 40 x 80 voxels."""
    return power_volume(160, (40, 40, 80), seed=1)


@functools.cache
def few_cells():
    return power_volume(40, (20, 16, 24), seed=2)


def made(labels, **options):
    return Specimen.from_label_volume(labels, voxel=SIDE, **options)


def checked(specimen, sizes):
    """A specimen whose cells fill the box but for its pores."""
    assert list(specimen.extent.values()) == pytest.approx(sizes, rel=1e-12)
    volumes, _ = specimen.given.measured()
    assert volumes.sum() == pytest.approx(np.prod(sizes), rel=1e-9)
    return specimen


def test_cells_that_made_the_labels_are_found():
    volume = own_cells()
    solid = checked(made(volume.labels), (0.04, 0.04, 0.08))
    totals = solid.fit.totals
    assert totals["agreement"] >= 0.995 > totals["start_agreement"]
    assert totals["grains"] == len(solid.spheres) == 160
    columns = {name: np.array(values) for name, values in solid.fit.columns.items()}
    errors = columns["volume"] / volume.cells.volumes - 1.0
    assert np.sqrt(np.mean(errors**2)) <= 0.01
    # voxels times the volume of one are the volume of the box, to round-off
    assert columns["voxels"].sum() * SIDE**3 == pytest.approx(0.04 * 0.04 * 0.08, rel=1e-12)
    pairs = np.sort(
        Specimen.from_label_volume(volume.labels, voxel=SIDE, short_edge=0.0).cells.faces[:, :2]
    )
    found = {tuple(pair) for pair in pairs.tolist() if pair[0] >= 0}
    true = {tuple(pair) for pair in volume.neighbours.tolist()}
    assert 2 * len(found & true) / (len(found) + len(true)) >= 0.99
    assert columns["centroid_shift"].max() < 0.2 * SIDE


@pytest.mark.parametrize(("largest", "least"), [(True, 0.75), (False, 0.65)])
def test_grains_that_are_not_convex_get_the_best_cells(largest, least):
    fit = made(unions(own_cells(), 1, largest)).fit
    totals = fit.totals
    assert totals["agreement"] >= least
    assert totals["agreement"] > totals["start_agreement"]
    agreement, labels = (np.array(fit.columns[name]) for name in ("agreement", "label"))
    assert fit.poor_grains == totals["poor_grains"]
    assert len(fit.poor_grains) == np.count_nonzero(agreement < 0.8)
    assert fit.poor_grains[0] == np.argmin(agreement)
    # no grain pays for the gain of the others
    assert totals["grains_below_start"] == 0 and len(labels) == totals["grains"]
    assert (agreement >= np.array(fit.columns["start_agreement"])).all()


def test_small_grains_at_boundaries_of_large_ones_keep_their_cells():
    """As in recrystallised metals: the boundaries of large grains pay better than small grains."""
    labels = bent_with_fragments(power_volume(20, (32, 32, 32), seed=2), 60, seed=1)
    fit = made(labels).fit
    assert fit.totals["grains_below_start"] == 0
    assert fit.totals["agreement"] > fit.totals["start_agreement"] + 0.02
    assert not fit.totals["lost_grains"]


def test_a_grain_within_another_is_named():
    """Both have one centroid, and a shell is far from convex: one of them has no cell."""
    labels = np.ones((9, 9, 9), int)
    labels[2:7, 2:7, 2:7] = 2
    refusal("grains with a cell in the box = 1 of 2", made, labels)
    labels[:, :, :2] = 3
    fit = made(labels).fit
    (lost,) = fit.totals["lost_grains"]
    assert fit.columns["label"][lost] in (1, 2) and lost in fit.poor_grains
    assert fit.columns["volume"][lost] == 0.0
    assert fit.columns["centroid_shift"][lost] is None and fit.columns["grain"][lost] is None


def test_stretched_voxels_fit_as_well():
    volume = few_cells()
    whole = made(volume.labels).fit.totals["agreement"]
    for factor in (2.0, 8.0):
        voxel = np.array([SIDE, SIDE, factor * SIDE])
        stretched = Specimen.from_label_volume(volume.labels, voxel=voxel)
        assert stretched.extent["height"] == pytest.approx(factor * 0.024, rel=1e-12)
        assert stretched.fit.totals["agreement"] == pytest.approx(whole, abs=0.01)


def test_exact_volumes_are_those_of_the_voxels():
    solid = made(unions(few_cells(), 1, True), volumes="exact", short_edge=0.0)
    voxels = np.array(solid.fit.columns["voxels"])
    assert solid.cells.volumes == pytest.approx(voxels * SIDE**3, rel=1e-6)


def test_labels_that_differ_by_their_order_only_give_the_same_grains():
    """The fit is flat near its best cells, so that round-off moves them a little."""
    labels = few_cells().labels
    order = np.random.default_rng(3).permutation(40)
    one, other = made(labels), made(order[labels] * 1000 - 7)
    assert np.argsort(order).tolist() == [
        int(np.argmin(np.linalg.norm(one.centres - centre, axis=1))) for centre in other.centres
    ]
    assert other.cells.volumes == pytest.approx(one.cells.volumes[np.argsort(order)], rel=0.01)


@functools.cache
def with_pore():
    """A ball without rock, of 0.9 grain's volumes and more, in the middle."""
    labels = few_cells().labels + 1
    z, y, x = np.indices(labels.shape)
    return np.where((x - 9.5) ** 2 + (y - 7.5) ** 2 + (z - 11.5) ** 2 < 25.0, 0, labels)


def test_pores_are_fitted_and_removed(tmp_path):
    labels = with_pore()
    solid = checked(made(labels, minerals={0: None}), (0.02, 0.016, 0.024))
    totals = solid.fit.totals
    share = np.count_nonzero(labels == 0) / labels.size
    assert totals["source_pore_fraction"] == pytest.approx(share, rel=1e-12)
    outline = solid.outline().volume
    assert totals["pore_fraction"] == pytest.approx(1 - solid.cells.volumes.sum() / outline)
    assert totals["pore_fraction"] == pytest.approx(share, abs=0.005)
    assert totals["pore_pieces"] > 1 and solid.minerals is None
    # the walls of the pore are free faces; convex cells in a ball have a larger surface than it
    walls = len(solid.outline().walls)
    free = np.flatnonzero(solid.cells.faces[:, 2] == walls)
    assert set(solid.cells.faces[free, 1]) == {-1}
    polygons = solid.outer_polygons()
    area = 0.0
    for face in free - solid.cells.contacts:
        ring = solid.cells.vertices[polygons[face]]
        twice = np.cross(ring[1:-1] - ring[0], ring[2:] - ring[0]).sum(axis=0)
        area += 0.5 * np.linalg.norm(twice)
    assert area == pytest.approx(4.0 * np.pi * (5.0 * SIDE) ** 2, rel=0.25)
    solid.save(tmp_path / "solid.json")
    again = Specimen.load_solid(tmp_path / "solid.json")
    assert np.array_equal(again.cells.vertices, solid.cells.vertices)
    assert np.array_equal(again.cells.faces, solid.cells.faces) and again.spec == solid.spec


def test_a_pore_softens_the_rock_within_bounds():
    """A small ball takes 3 (1 - nu)(9 + 5 nu)/(2 (7 - 5 nu)) = 2.0 times its share (Mackenzie)."""
    labels = with_pore()
    rock = flexpm.elastic(made(labels))["youngs_modulus"]
    found = flexpm.elastic(made(labels, minerals={0: None}))["youngs_modulus"]
    share = made(labels, minerals={0: None}).fit.totals["pore_fraction"]
    assert 1.0 - 3.5 * share < found / rock < 1.0 - 1.5 * share


@pytest.mark.parametrize("seed", [36, 88, 121])
def test_bent_walls_of_pores_keep_the_triangles_of_the_collapse(seed):
    """A polygon that two corners cut equally well has other triangles if its corners turn around.

    In these cells one of the two cuts turns a tetrahedron over.
    """
    draw = np.random.default_rng(seed)
    points, weights = 0.01 * draw.random((60, 3)), (0.0025 * draw.uniform(0.0, 0.5, 60)) ** 2
    cube = Solid.box(0.01, 0.01, 0.01)
    cells = weighted_cells(points, weights, cube)
    while not (there := cells.volumes > 1e-4 * cells.volumes.mean()).all():
        points, weights = points[there], weights[there]
        cells = weighted_cells(points, weights, cube)
    own = OwnCells.of_weighted(cells).with_pores(len(points) * 3 // 5)
    sizes = {"width": 0.01, "depth": 0.01, "height": 0.01}
    solid = SolidSpecimen.of_cells(own, "box", sizes, short_edge=0.45)
    assert np.asarray(solid.meshes().volumes).min() > 0.0


def test_a_channel_along_the_side_leaves_poissons_ratio():
    """Between smooth platens a prism of any section has the stress, and the widening, of a box."""
    z, y, x = np.indices((24, 24, 24)) // 4
    labels = (z * 6 + y) * 6 + x + 1
    channel = (x < 2) & (y >= 2) & (y < 4)
    whole = made(labels)
    cut = made(np.where(channel, 0, labels), minerals={0: None})
    share = cut.fit.totals["pore_fraction"]
    assert share == pytest.approx(1.0 / 9.0, abs=0.002)
    elastic = {"young": 20e9, "poisson": 0.2, "normal_stiffness": 2e15, "shear_ratio": 1.0}
    rock = Material.from_dict({**ROCK, "elastic": {"flexible": elastic}}, "one")
    one, other = flexpm.elastic(whole, rock), flexpm.elastic(cut, rock)
    assert other["poissons_ratio"] == pytest.approx(one["poissons_ratio"], rel=0.01)
    stiffness = (1.0 - share) * one["youngs_modulus"]
    assert other["youngs_modulus"] == pytest.approx(stiffness, rel=2e-3)


def test_islands_and_small_grains_join_a_neighbour():
    labels = np.ones((8, 8, 8), int)
    labels[4:] = 2
    labels[1, 1, 1] = 7  # one voxel
    labels[6, 6, 6] = 1  # an island of a label that goes on elsewhere
    labels[2:4, 5:7, 5:7] = 9  # eight voxels are a grain
    found = find(LabelVolume.of(labels, (SIDE,) * 3), Kinds(), 8)
    assert found.ids.tolist() == [1, 2, 9] and found.grains == 3
    assert found.counts["regions"] == 5 and found.counts["small_regions"] == 2
    assert found.regions[1, 1, 1] == 0 and found.regions[6, 6, 6] == 1


def test_parts_of_a_label_are_grains_of_their_own():
    labels = np.ones((6, 6, 9), int)
    labels[:, :, 3:6] = 2
    found = find(LabelVolume.of(labels, (SIDE,) * 3), Kinds(), 8)
    assert found.ids.tolist() == [1, 1, 2]


def test_rock_that_nothing_holds_is_removed():
    labels = np.zeros((9, 9, 9), int)
    labels[:3], labels[3:5] = 1, 2
    labels[7:, 2:5, 2:5] = 3
    found = find(LabelVolume.of(labels, (SIDE,) * 3), Kinds(pores=frozenset({0})), 8)
    assert found.ids[: found.grains].tolist() == [1, 2]
    assert found.counts["loose_grains"] == 1
    assert found.counts["pore_voxels"] == 9**3 - 5 * 81
    assert (found.regions[7:, 2:5, 2:5] >= 2).all()


def test_rock_that_a_cut_separates_is_removed():
    """Two halves that hang together outside of the cylinder alone."""
    labels = np.zeros((6, 12, 24), int)
    labels[:, :, :11], labels[:, :, 13:] = 1, 2
    labels[:, 10:, 11:13] = 3
    labels[:3] += 10 * (labels[:3] > 0)
    labels[:, :6] += 20 * (labels[:, :6] > 0)
    pores = {0: None}
    assert made(labels, minerals=pores).fit.totals["loose_grains"] == 0
    solid = made(labels, minerals=pores, shape="cylinder", diameter=0.009)
    assert solid.fit.totals["loose_grains"] > 0
    found = flexpm.elastic(solid)["youngs_modulus"]
    assert 0.0 < found < 26e9
    pairs = solid.cells.faces[: solid.cells.contacts, :2]
    part = np.arange(len(solid.spheres))
    for _ in range(len(part)):
        low = np.minimum(part[pairs[:, 0]], part[pairs[:, 1]])
        np.minimum.at(part, pairs[:, 0], low)
        np.minimum.at(part, pairs[:, 1], low)
    assert (part == 0).all()


def test_watershed_divides_a_phase_where_it_is_narrow():
    z, y, x = np.indices((16, 16, 30))
    balls = [(7.5, 7.5, 8.0, 7.0), (7.5, 7.5, 20.0, 7.5)]
    inside = [(z - a) ** 2 + (y - b) ** 2 + (x - c) ** 2 < r * r for a, b, c, r in balls]
    volume = LabelVolume.of(np.where(inside[0] | inside[1], 2, 1), (SIDE,) * 3)
    whole = find(volume, Kinds({1: 0, 2: 1}), 8)
    assert whole.ids.tolist() == [1, 2]
    found = find(volume, Kinds({1: 0, 2: 1}), 30, watershed=True)
    assert np.count_nonzero(found.ids == 2) == 2
    for own, (a, b, c, r) in zip(inside, balls, strict=True):
        region = found.regions[int(a), int(b), int(c)]
        core = (z - a) ** 2 + (y - b) ** 2 + (x - c) ** 2 < (0.7 * r) ** 2
        assert (found.regions[core] == region).all() and own[core].all()
    assert found.minerals.tolist() == [0] * (len(found.ids) - 2) + [1, 1]


@pytest.mark.parametrize(("common", "told"), [(4, True), (2, False)])
def test_boundaries_by_which_a_watershed_divides_a_phase_are_told(
    tmp_path, capsys, monkeypatch, common, told
):
    """Two cubes of 8 voxels in a box that they fill but for pores, with a strip in common."""
    monkeypatch.chdir(tmp_path)
    off = 8 - common
    labels = np.zeros((8, 8 + off, 16), np.uint8)
    labels[:, :8, :8] = labels[:, off:, 8:] = 1
    np.save("scan.npy", labels)
    (tmp_path / "phases.toml").write_text('0 = "hole"\n')
    arguments = ["--voxel", "1e-3", "--labels", "phases", "--watershed", "--phases", "phases.toml"]
    assert cli.main([*COMMAND, "scan.npy", *arguments, "--out", "made"]) == 0
    made_of = json.loads((tmp_path / "made" / "specimen.json").read_text())["volume"]
    walls = 2 * 8 * (8 + off)
    assert made_of["divided_share"] == pytest.approx(8 * common / (8 * common + walls), rel=1e-12)
    assert ("divides regions of one label" in capsys.readouterr().out) == told


def voxels_inside(section, diameter):
    """Voxels of `with_pore` in the middle of the box."""
    z, y, x = np.indices(with_pore().shape) + 0.5
    off = {"x": x - 10.0, "y": y - 8.0, "z": z - 12.0}
    return sum((SIDE * off[axis]) ** 2 for axis in section) < (0.5 * diameter) ** 2


@pytest.mark.parametrize(("shape", "section"), [("cylinder", "xy"), ("disc", "xz")])
def test_round_specimens_are_cut_from_the_middle(tmp_path, shape, section):
    labels = with_pore()
    minerals = {label: (None if label == 0 else label % 2) for label in range(41)}
    solid = made(labels, minerals=minerals, shape=shape, diameter=0.016)
    assert solid.kind == {"cylinder": "cylinder", "disc": "solid-disc"}[shape]
    assert solid.extent["diameter"] == 0.016
    volume = np.pi / 4.0 * 0.016**2 * {"xy": 0.024, "xz": 0.016}[section]
    assert solid.outline().volume == pytest.approx(volume, rel=1e-9)
    # grains that are in the middle of the box are there, with their minerals
    box = made(labels, minerals=minerals)
    same = 0
    corner = np.array({"xy": (-0.01, -0.008, 0.0), "xz": (-0.01, 0.0, -0.012)}[section])
    for centre, mineral in zip(solid.centres, solid.minerals, strict=True):
        nearest = int(np.argmin(np.linalg.norm(box.centres + corner - centre, axis=1)))
        if np.linalg.norm(box.centres[nearest] + corner - centre) < 0.1 * SIDE:
            assert box.minerals[nearest] == mineral
            same += 1
    assert same >= 5
    rows = {grain: row for row, grain in enumerate(solid.fit.columns["grain"]) if grain is not None}
    assert sorted(rows) == list(range(len(solid.spheres)))
    labels_of = [solid.fit.columns["label"][rows[grain]] for grain in range(len(solid.spheres))]
    assert solid.minerals.tolist() == [label % 2 for label in labels_of]
    # figures are those of the part that is cut
    inside = voxels_inside(section, 0.016)
    share = np.count_nonzero(labels[inside] == 0) / np.count_nonzero(inside)
    assert solid.fit.totals["source_pore_fraction"] == pytest.approx(share, rel=1e-9)
    assert solid.fit.totals["pore_fraction"] == pytest.approx(share, abs=0.01)
    odd = np.count_nonzero(labels[inside] % 2) / np.count_nonzero(labels[inside])
    assert solid.fit.totals["source_mineral_fractions"][1] == pytest.approx(odd, rel=1e-9)
    assert solid.fit.totals["mineral_fractions"][1] == pytest.approx(odd, abs=0.02)
    solid.save(tmp_path / "solid.json")
    again = Specimen.load_solid(tmp_path / "solid.json")
    assert np.array_equal(again.cells.vertices, solid.cells.vertices)
    assert again.outline().volume == solid.outline().volume


ROCK = {
    "tensile_strength": 1e6,
    "cohesion": 4e6,
    "friction": 0.5,
    "tensile_fracture_energy": 1e6,
    "shear_fracture_energy": 1e6,
}


def two_minerals(young, poisson, stiffness):
    """Two minerals behind contacts that hardly give."""
    elastic = {"young": young[0], "poisson": poisson[0]}
    other = {"elastic": {"flexible": {"young": young[1], "poisson": poisson[1]}}}
    kinds = [{"name": "a", "fraction": 0.5}, {"name": "b", "fraction": 0.5, **other}]
    law = {"normal_stiffness": stiffness, "shear_ratio": 1.0}
    return Material.from_dict(
        {**ROCK, "elastic": {"flexible": {**elastic, **law}}, "mineral": kinds}, "two"
    )


def layers(axis):
    """216 bricks in layers of two minerals, across z or x."""
    z, y, x = np.indices((24, 24, 24)) // 4
    labels = (z * 6 + y) * 6 + x + 1
    phase = {"z": z, "x": x}[axis] % 2
    first = np.unique(labels, return_index=True)[1]
    minerals = {label: int(phase.ravel()[at]) for label, at in enumerate(first.tolist(), 1)}
    return made(labels, minerals=minerals)


def test_layers_along_the_load_have_the_mean_modulus():
    young = (20e9, 60e9)
    found = flexpm.elastic(layers("x"), two_minerals(young, (0.2, 0.2), 2e17))
    assert found["youngs_modulus"] == pytest.approx(40e9, rel=1e-3)
    assert found["poissons_ratio"] == pytest.approx(0.2, rel=1e-3)


def test_layers_across_the_load_have_the_mean_compliance_where_they_widen_alike():
    """With Poisson's ratios like the moduli, all layers widen by the same under one stress."""
    found = flexpm.elastic(layers("z"), two_minerals((20e9, 60e9), (0.1, 0.3), 2e17))
    assert found["youngs_modulus"] == pytest.approx(30e9, rel=1e-3)


def test_layers_across_the_load_of_equal_poissons_ratios_are_a_laminate():
    """Layers of one lateral strain: 1/E = <1/E_i> - 2 nu^2 / (1 - nu) (<1/E_i> - 1 / <E_i>).

    The mean lateral stress is 0, that of a layer is not. At the free sides it vanishes, which makes
    the specimen 0.25 % softer for layers of a sixth of the width, and 0.09 % for half of this.
    """
    poisson, mean, compliance = 0.2, 40e9, 0.5 * (1 / 20e9 + 1 / 60e9)
    laminate = compliance - 2 * poisson**2 / (1 - poisson) * (compliance - 1 / mean)
    found = flexpm.elastic(layers("z"), two_minerals((20e9, 60e9), (poisson,) * 2, 2e17))
    assert found["youngs_modulus"] == pytest.approx(1.0 / laminate, rel=5e-3)
    assert found["poissons_ratio"] == pytest.approx(poisson / mean / laminate, rel=0.04)


def test_a_mixture_is_within_the_bounds_of_hashin_and_shtrikman():
    """Phases have several grains: single grains of unlike moduli are 2 to 4 % too stiff."""
    draw = np.random.default_rng(0)
    coarse, fine = 60, 480
    volume = power_volume(fine, (26, 26, 26), seed=4, side=SIDE, relaxations=4)
    places = volume.cells.centroids
    centres = draw.random((coarse, 3)) * 0.026
    owner = np.linalg.norm(places[:, None] - centres, axis=2).argmin(axis=1)
    sizes = np.bincount(owner, volume.cells.volumes, coarse)
    stiff = np.zeros(coarse, int)
    for one in draw.permutation(coarse):
        if sizes[stiff > 0].sum() + sizes[one] <= 0.5 * sizes.sum():
            stiff[one] = 1
    minerals = dict(enumerate(stiff[owner].tolist()))
    solid = made(volume.labels, minerals=minerals)
    found = flexpm.elastic(solid, two_minerals((20e9, 60e9), (0.2, 0.2), 2e17))
    share = solid.cells.volumes[solid.minerals == 1].sum() / solid.cells.volumes.sum()
    low, high = hashin_shtrikman(20e9, 60e9, 0.2, share)
    assert 0.985 * low < found["youngs_modulus"] < 1.015 * high


def hashin_shtrikman(soft, stiff, poisson, share):
    """Bounds of Young's modulus, of the bounds of bulk and shear modulus."""

    def moduli(young):
        return young / (3.0 * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))

    def bound(matrix, other, part):
        (bulk, shear), (of_bulk, of_shear) = matrix, other
        k = bulk + part / (1 / (of_bulk - bulk) + 3 * (1 - part) / (3 * bulk + 4 * shear))
        stiffness = 6 * (1 - part) * (bulk + 2 * shear) / (5 * shear * (3 * bulk + 4 * shear))
        g = shear + part / (1 / (of_shear - shear) + stiffness)
        return 9 * k * g / (3 * k + g)

    return bound(moduli(soft), moduli(stiff), share), bound(moduli(stiff), moduli(soft), 1 - share)


def test_phases_of_a_file_become_minerals(tmp_path):
    labels = few_cells().labels + 1
    volume = LabelVolume.of(labels, (SIDE,) * 3)
    phases = np.where(volume.ids % 3 == 0, 5, 2)
    solid = Specimen.from_label_volume(replace(volume, phases=phases, phase_names={5: "quartz"}))
    assert solid.mineral_names == ("phase 2", "quartz")
    assert solid.minerals.tolist() == (volume.ids % 3 == 0).astype(int).tolist()
    solid.save(tmp_path / "solid.json")
    assert Specimen.load_solid(tmp_path / "solid.json").mineral_names == solid.mineral_names


def test_rock_of_one_phase_has_this_mineral():
    """Not those that a material of two minerals would give to any grains."""
    volume = LabelVolume.of(few_cells().labels + 1, (SIDE,) * 3)
    phases = np.full(len(volume.ids), 4)
    given_phases = replace(volume, phases=phases, phase_names={4: "b"})
    solid = Specimen.from_label_volume(given_phases)
    assert solid.mineral_names == ("b",) and not solid.minerals.any()
    rock = two_minerals((20e9, 60e9), (0.2, 0.2), 2e17)
    with pytest.raises(InputError, match="specimen mineral 1 = b, is mineral 2 of two"):
        flexpm.elastic(solid, rock)
    named = replace(solid, mineral_names=("a",))
    assert flexpm.elastic(named, rock)["youngs_modulus"] == pytest.approx(20e9, rel=1e-3)
    flexpm.elastic(solid)  # a material without minerals is this mineral


@pytest.mark.parametrize("labels", ["grains", "phases"])
def test_files_of_holes_leave_the_other_phases_as_they_are(tmp_path, labels):
    (tmp_path / "holes.toml").write_text('7 = "hole"\n')
    volume = LabelVolume.of(np.repeat([[[3, 7], [5, 5]]], 2, axis=0), (SIDE,) * 3)
    if labels == "grains":
        volume = replace(volume, phases=np.array([3, 5, 7]))
    found = kinds_of_file(tmp_path / "holes.toml", volume, labels)
    assert found == Kinds({3: 0, 5: 1}, frozenset({7}), ("phase 3", "phase 5"))


def test_minerals_come_from_a_second_volume_of_any_format(tmp_path):
    labels = few_cells().labels.astype(np.uint8) + 1
    labels.tofile(tmp_path / "grains.raw")
    np.save(tmp_path / "phases.npy", labels % 2)
    solid = Specimen.from_label_volume(
        tmp_path / "grains.raw",
        voxel=SIDE,
        minerals=tmp_path / "phases.npy",
        counts=(20, 16, 24),
        dtype="uint8",
    )
    ids = np.unique(labels)
    assert solid.minerals.tolist() == (ids % 2).tolist()
    assert solid.mineral_names == ("phase 0", "phase 1")


def test_a_second_raw_volume_has_the_shape_of_the_file_of_the_grains(tmp_path):
    labels = few_cells().labels.astype(np.uint16) + 1
    np.save(tmp_path / "grains.npy", labels)
    (labels % 2).astype(np.uint8).tofile(tmp_path / "phases.raw")
    labels.tofile(tmp_path / "grains.raw")
    window = ((0, 20), (0, 16), (6, 24))
    ids = np.unique(labels[6:])
    raw = {"counts": (20, 16, 24), "dtype": "uint16"}
    for name, options in (("grains.npy", {}), ("grains.raw", raw)):
        solid = Specimen.from_label_volume(
            tmp_path / name,
            voxel=SIDE,
            crop=window,
            minerals=tmp_path / "phases.raw",
            minerals_dtype="uint8",
            **options,
        )
        of_rows = np.array(solid.fit.columns["label"])[
            [row for row, grain in enumerate(solid.fit.columns["grain"]) if grain is not None]
        ]
        assert solid.minerals.tolist() == (of_rows % 2).tolist() and set(of_rows) <= set(ids)
    given_raw = {"voxel": SIDE, "minerals": tmp_path / "phases.raw"}
    make = Specimen.from_label_volume
    refusal("is a .raw file without minerals_dtype", make, tmp_path / "grains.npy", **given_raw)
    refusal("size = 7680 bytes, must be 15360", make, tmp_path / "grains.raw", **given_raw, **raw)


SECOND = [
    (["--minerals-dtype", "uint8"], "minerals-dtype = uint8, is for a second volume"),
    (
        ["--minerals", "phases.npy", "--minerals-dtype", "u1"],
        "minerals_dtype = 'u1', is for a .raw",
    ),
    (["--minerals", "table.csv", "--minerals-array", "a"], "minerals_array = 'a', is for a second"),
    (["--minerals", "phases.npy", "--minerals-array", "a"], "array = 'a', is for .dream3d"),
    (
        ["--minerals", "phases.npy", "--labels", "phases"],
        "minerals = 'phases.npy', must be used with labels of grains; leave it out",
    ),
    (["--watershed"], "watershed = True, must be used with labels of phases; give --labels phases"),
]


@pytest.mark.parametrize(("options", "words"), SECOND)
def test_options_of_a_second_volume_are_for_one(tmp_path, capsys, monkeypatch, options, words):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", few_cells().labels.astype(np.uint8))
    np.save("phases.npy", few_cells().labels.astype(np.uint8) % 2)
    (tmp_path / "table.csv").write_text("id,mineral\n")
    assert cli.main([*COMMAND, "scan.npy", "--voxel", "1e-3", *options]) == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize("name", FORMATS)
def test_all_formats_make_the_same_specimen(tmp_path, name):
    if name.endswith(".dream3d"):
        pytest.importorskip("h5py")
    labels = few_cells().labels[:9, :9, :9].astype(np.uint8) + 1
    path, options = write(tmp_path, name, labels)
    expected = Specimen.from_label_volume(labels, voxel=SIDE)
    expected.save(tmp_path / "expected.json")
    Specimen.from_label_volume(path, voxel=SIDE, **options).save(tmp_path / "found.json")
    one, other = (
        json.loads((tmp_path / f"{name}.json").read_text()) for name in ("expected", "found")
    )
    # the file is named
    assert [content["spec"]["source"].pop("file") for content in (one, other)] == [
        "array",
        path.name,
    ]
    assert one.pop("checksum") != other.pop("checksum") and one == other


def test_command_writes_grains_report_and_pictures(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", with_pore().astype(np.uint8))
    (tmp_path / "phases.toml").write_text('0 = "hole"\n')
    arguments = ["scan.npy", "--voxel", "1e-3", "--phases", "phases.toml", "--out", "made"]
    assert cli.main([*COMMAND, *arguments]) == 0
    names = {path.name for path in (tmp_path / "made").iterdir()}
    tables = {"specimen.json", "volume.csv", "solid.json"}
    assert names == tables | {"specimen.png", "specimen.vtu", "volume.png"}
    content = json.loads((tmp_path / "made" / "specimen.json").read_text())["volume"]
    assert content["source"] == "scan.npy" and content["voxels"] == [20, 16, 24]
    lines = (tmp_path / "made" / "volume.csv").read_text().splitlines()
    assert len(lines) == content["grains"] + 1 and lines[0].startswith("grain,label,x,y,z,voxels,")
    assert "volume.png" in capsys.readouterr().out


@pytest.mark.parametrize(("phases", "told"), [(None, True), ('0 = "a"\n1 = "b"\n', False)])
def test_label_0_is_told_unless_it_has_a_name(tmp_path, capsys, monkeypatch, phases, told):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", np.repeat([0, 1], 32).reshape(4, 4, 4))
    named = []
    if phases is not None:
        (tmp_path / "phases.toml").write_text(phases)
        named = ["--phases", "phases.toml"]
    arguments = ["scan.npy", "--voxel", "1e-3", "--labels", "phases", *named]
    assert cli.main([*COMMAND, *arguments]) == 0
    assert ("label 0 is rock" in capsys.readouterr().out) == told


def test_the_mesh_for_paraview_has_the_minerals(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", few_cells().labels.astype(np.uint8) + 1)
    rows = [f"{label},{('quartz', 'feldspar', 'mica')[label % 3]}" for label in range(1, 41)]
    (tmp_path / "table.csv").write_text("\n".join(["id,mineral", *rows, ""]))
    assert cli.main([*COMMAND, "scan.npy", "--voxel", "1e-3", "--minerals", "table.csv"]) == 0
    (out,) = tmp_path.glob("*/specimen.vtu")
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(out))
    reader.Update()
    grid = reader.GetOutput()
    kind, grain, mineral = (
        vtk_to_numpy(grid.GetCellData().GetArray(name)) for name in ("kind", "grain", "mineral")
    )
    solid = Specimen.load_solid(out.with_name("solid.json"))
    assert mineral[kind == 0].tolist() == solid.minerals[grain[kind == 0]].tolist()
    assert set(mineral[kind == 1]) == {-1} and set(mineral[kind == 0]) == {0, 1, 2}
    names = grid.GetFieldData().GetAbstractArray("minerals").GetValue(0)
    assert names == ", ".join(solid.mineral_names)


def test_threads_change_no_bit(tmp_path):
    np.save(tmp_path / "scan.npy", with_pore().astype(np.uint8))
    script = (
        "import flexpm, sys; flexpm.Specimen.from_label_volume('scan.npy', voxel=1e-3)"
        ".save('four.json')"
    )
    paths = os.pathsep.join(path for path in sys.path if path)
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")
    settings = {**os.environ, **dict.fromkeys(names, "4"), "PYTHONPATH": paths}
    command = [sys.executable, "-c", script]
    subprocess.run(command, check=True, env=settings, timeout=600, cwd=tmp_path)
    here = Specimen.from_label_volume(tmp_path / "scan.npy", voxel=SIDE)
    here.save(tmp_path / "here.json")
    assert (tmp_path / "here.json").read_bytes() == (tmp_path / "four.json").read_bytes()


PHASES = [
    ('0 = "hole"\n1 = "quartz"\n', "volume phase = 2, is missing in phases.toml; so are 38 others"),
    ("", "phases = 'phases.toml', is empty"),
    ('quartz = "1"\n', "phases key = 'quartz', must be a whole number"),
    ('255 = "hole"\n', "phases 255 = hole, must be a phase or label of the volume"),
    ('0 = "Hole"\n', "phases '0' = 'Hole', must be 'hole' for a pore"),
    ('1 = "a"\n01 = "b"\n', "phases key = '01', is given twice"),
]


@pytest.mark.parametrize(("text", "words"), PHASES)
def test_phases_that_do_not_fit_are_refused(tmp_path, capsys, monkeypatch, text, words):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", with_pore().astype(np.uint8))
    (tmp_path / "phases.toml").write_text(text)
    assert cli.main([*COMMAND, "scan.npy", "--voxel", "1e-3", "--phases", "phases.toml"]) == 2
    assert words in capsys.readouterr().err


REFUSED = [
    ({"voxel": None}, "voxel = None, must be given for an array"),
    ({"least_voxels": 0}, "least_voxels = 0, must be >= 1"),
    ({"least_voxels": 10**6}, "grains = 1, must be 2 to"),
    ({"shape": "cylinder"}, "diameter = None, must be given for a cylinder"),
    ({"diameter": 0.01}, "diameter = 0.01, must be left out for a box"),
    (
        {"shape": "cylinder", "diameter": 0.018},
        "must be <= 0.016 m, the size of",
    ),
    ({"shape": "ball"}, "shape = 'ball', must be one of box"),
    ({"volumes": "all"}, "volumes = 'all', must be one of fitted"),
    ({"minerals": {1: 0, 2: 1}}, "mineral of label 0 and of 37 others is missing"),
    ({"minerals": {99: None}}, "pore = label 99, must be a label of the volume"),
    ({"minerals": [0, 1]}, "minerals = [0, 1], must be an index or None by label"),
    ({"minerals": {1: -1}}, "minerals[1] = -1, must be >= 0"),
    ({"minerals": dict.fromkeys(range(40))}, "all labels are pores"),
    ({"crop": ((0, 4),) * 3}, "crop = ((0, 4), (0, 4), (0, 4)), is for files only"),
]


@pytest.mark.parametrize(("options", "words"), REFUSED)
def test_values_out_of_range_are_refused(options, words):
    given_options = {"voxel": SIDE, **options}
    refusal(words, Specimen.from_label_volume, few_cells().labels, **given_options)


@given(st.data())
@settings(max_examples=40, deadline=None)
def test_any_labels_make_a_specimen_or_are_refused(data):
    """Labels of any shape: not connected, not convex, one voxel thin."""
    counts = data.draw(st.tuples(*[st.integers(2, 7)] * 3), label="counts")
    kinds = data.draw(st.integers(1, 6), label="labels")
    seed = data.draw(st.integers(0, 2**31), label="seed")
    least = data.draw(st.integers(1, 4), label="least_voxels")
    has_pores = data.draw(st.booleans(), label="has_pores")
    labels = np.random.default_rng(seed).integers(0, kinds, counts)
    minerals = {0: None} if has_pores else None
    try:
        solid = made(labels, least_voxels=least, minerals=minerals)
    except InputError as error:
        assert "\n" not in str(error)
        return
    totals = solid.fit.totals
    assert totals["agreement"] >= totals["start_agreement"] and totals["grains_below_start"] == 0
    assert solid.cells.volumes.min() > 0.0
    assert len(solid.spheres) == solid.cells.cells
