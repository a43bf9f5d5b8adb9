# SPDX-License-Identifier: GPL-3.0-or-later
"""Excavations: lines that are sawn into the cells, and what is taken away in a test."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
import yade
from refusals import refusal, refused_command
from scenes import fresh

import flexpm
from flexpm.errors import InputError

SIDE, THICKNESS = 0.012, 0.01
CIRCLE = ((0.006, 0.006), 0.002)
STRONG = ["tensile_strength=1e10", "cohesion=1e10", "softening=brittle"]


@pytest.fixture(scope="module")
def whole() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(SIDE, SIDE, THICKNESS, diameters=(0.8e-3, 1.2e-3), seed=1)


@pytest.fixture(scope="module")
def sawn(whole) -> flexpm.Specimen:
    return whole.with_excavations({"tunnel": CIRCLE})


def made(specimen: flexpm.Specimen, model: str = "flexible", **leaves: object):
    name = "augig-table7" if model == "flexible" else "augig-table2-bilinear"
    material = flexpm.materials.load(name).with_set(STRONG)
    rig = flexpm.PartRig(fresh(specimen, material, model), **leaves)
    return rig, [rig.platen(side) for side in range(4)]


@pytest.mark.parametrize("name", ["excavation:tunnel", "excavation:"])
def test_names_of_excavations_are_of_no_joint(whole, name, tmp_path, capsys):
    """Else the joint would be rock without a word: its law is not asked for."""
    line = [(-0.001, 0.003), (0.013, 0.009)]
    tables = {
        "length": {"law": "constant", "value": 0.004},
        "orientation": {"law": "constant", "angle": 30.0},
    }
    network = {"set": {name: {"intensity": 100.0, **tables}}}
    (tmp_path / "a.csv").write_text(f"x1,y1,x2,y2,name\n-0.001,0.003,0.013,0.009,{name}\n")
    feature = {"type": "LineString", "coordinates": line}
    feature = {"type": "Feature", "properties": {"name": name}, "geometry": feature}
    (tmp_path / "a.geojson").write_text(json.dumps(feature))
    for cut in (
        lambda: whole.with_joints({name: line}),
        lambda: whole.with_network(network),
        lambda: whole.joints_from_csv(tmp_path / "a.csv"),
        lambda: whole.joints_from_geojson(tmp_path / "a.geojson"),
        lambda: whole.with_excavations({name: CIRCLE}),
    ):
        refusal("must not begin with excavation:|must be a name", cut)
    sizes = ["--width", "0.012", "--height", "0.024", "--thickness", "0.01"]
    asked = [*sizes, "--joints", str(tmp_path / "a.csv"), "--out", str(tmp_path / "out")]
    for command in (["run", "uniaxial"], ["specimen", "rectangle"]):
        refused_command(capsys, "must not begin with excavation:", *command, *asked)


def test_a_line_is_sawn_into_the_cells_and_is_rock_until_then(whole, sawn, tmp_path):
    found = sawn.excavation("tunnel")
    assert len(found.cells) > 10
    assert found.asked_area == pytest.approx(np.pi * 0.002**2, rel=0.02)
    # chords of cells, but where a grain is left whole
    assert found.area == pytest.approx(found.asked_area, rel=0.05)
    assert 0.0 < found.raggedness < 0.5 * sawn.mean_diameter
    inside = np.isin(sawn.tessellation.shared_edges[:, :2], found.cells)
    wall = inside.any(axis=1) & ~inside.all(axis=1)
    # some run along edges on the way to where the line was cut
    assert np.count_nonzero(wall != (sawn.edge_joints >= 0)) <= 0.2 * np.count_nonzero(wall)
    for model in ("rigid", "flexible"):  # no joint asks for a law
        rock = flexpm.elastic(replace(sawn, edge_joints=None), model=model)
        assert flexpm.elastic(sawn, model=model) == rock
    vein = whole.with_joints({"vein": sawn.joints["excavation:tunnel"][0]})
    refusal("joint = 'vein', has no law", flexpm.elastic, vein)
    sawn.save(tmp_path / "sawn.json")
    again = flexpm.Specimen.load(tmp_path / "sawn.json").excavation("tunnel")
    np.testing.assert_array_equal(again.cells, found.cells)
    assert (again.area, again.raggedness) == (found.area, found.raggedness)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_an_excavated_hole_has_the_stress_of_one_made_before(sawn, model):
    asked = (4e6, 2e6)
    stresses = []
    for before in (False, True):
        rig, (_, right, top, _) = made(sawn, model)
        if before:
            rig.excavate("tunnel")
        rig.press({top: asked[0], right: asked[1]})
        if not before:
            solver = rig.built.solver
            stored = solver.energies()["elastic_energy"]
            solver.resetEnergyBalance()
            rig.excavate("tunnel")
            energies = solver.energies()
            given = energies.pop("boundary_work") + energies.pop("initial_energy")
            assert abs(given - sum(energies.values())) < 1e-6 * stored
            assert energies["erased_energy"] > 1e-2 * stored
        state = rig.built.snapshot()
        stresses.append(state.grain_stress)
        static = rig.elastic()
        moved = state.positions - state.reference
        np.testing.assert_allclose(static.displacements, moved, atol=2e-3 * np.abs(moved).max())
    largest = np.nanmax(np.abs(stresses[1]))
    np.testing.assert_allclose(*stresses, atol=0.01 * largest)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_forces_on_the_wall_are_released_in_parts_each_to_balance(sawn, model):
    rig, (floor, right, top, _) = made(sawn, model)
    rig.press({top: 4e6, right: 2e6})
    once = rig.elastic()
    solver = rig.built.solver
    stored = solver.energies()["elastic_energy"]
    solver.resetEnergyBalance()
    balances, roofs = [], []
    found = rig.built.specimen.excavation("tunnel")

    def look(one: flexpm.PartRig) -> None:
        wall = one.built.required(yade.wrapper.ReleaseController)
        if yade.O.iter == one._runner.position.stage_start + 1:
            balances.append((wall.startPart, one._balance_of_all().largest))
            roofs.append(one.built.snapshot().grain_stress[:, 0].copy())

    rig.watch = look
    rig.excavate("tunnel", parts=4)
    # what a part begins with is what the one before has come to
    assert [part for part, _ in balances] == [1.0, 0.75, 0.5, 0.25]
    assert max(missing for _, missing in balances) < 1e-3
    wall = rig.built.required(yade.wrapper.ReleaseController)
    assert (wall.part, wall.acting) == (0.0, 0.0)
    energies = solver.energies()
    given = energies.pop("boundary_work") + energies.pop("initial_energy")
    assert abs(given - sum(energies.values())) < 1e-6 * stored
    assert energies["erased_energy"] > 1e-2 * stored
    # with the forces on it the wall stays where it was; without them it is that of a free hole
    others = np.setdiff1d(np.arange(len(roofs[0])), found.cells)
    largest = np.abs(once.grain_stress).max()
    if model == "flexible":  # rigid ones have the forces on them among their means
        np.testing.assert_allclose(
            roofs[0][others], once.grain_stress[others, 0], atol=2e-3 * largest
        )
    free = rig.elastic()
    state = rig.built.snapshot()
    moved = state.positions - state.reference
    np.testing.assert_allclose(free.displacements, moved, atol=2e-3 * np.abs(moved).max())
    [stage] = [one for one in rig.stages if one["stage"] == "excavate"]
    assert stage["parts"] == 4
    # a gradual release stirs less than one at once: next to all of the work is the wall's
    assert energies["damping_energy"] < 0.5 * abs(given)
    rig.watch = None
    rig.drive(top, (0.0, -1.0), against=floor, area=SIDE * THICKNESS)
    rig.stress_to(4.2e6)
    assert rig.warnings == []


def test_a_polygon_is_excavated_after_loading_and_the_record_stays_in_balance(whole):
    room = [(0.004, 0.004), (0.008, 0.004), (0.008, 0.007), (0.004, 0.007)]
    rig, (floor, right, top, _) = made(whole.with_excavations({"room": room, "shaft": CIRCLE}))
    rig.press({top: 4e6, right: 2e6})
    rig.drive(top, (0.0, -1.0), against=floor, area=SIDE * THICKNESS, length=SIDE)
    rig.stress_to(8e6)
    rig.relax()
    grains = rig.built.counts()["grains"]
    rig.excavate("room")
    assert rig.built.counts()["grains"] < grains
    rig.excavate("shaft")  # what is left of it
    refusal("excavate: name = shaft, is already excavated", rig.excavate, "shaft")
    rig.stress_to(9e6)
    assert rig.warnings == []
    assert [stage["stage"] for stage in rig.stages][3:6] == ["excavate", "excavate", "stress_to"]


@pytest.mark.long
def test_a_script_that_is_started_again_finds_what_was_excavated(sawn, tmp_path):
    records, leaves = [], {"out": tmp_path / "out", "report": False}
    for _ in range(2):
        rig, (floor, right, top, _) = made(sawn, "rigid", **leaves)
        rig.press({top: 4e6, right: 2e6})
        rig.drive(top, (0.0, -1.0), against=floor)
        rig.stress_to(100.0)
        rig.excavate("tunnel", parts=2)
        rig.finish()
        records.append((rig.record.array.copy(), rig.built.counts(), rig.stages))
    np.testing.assert_array_equal(records[0][0], records[1][0])
    assert records[0][1:] == records[1][1:]


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"a": [(2e-3, 2e-3), (8e-3, 8e-3), (8e-3, 2e-3), (2e-3, 8e-3)]}, "must not cross"),
        ({"a": ((0.0, 6e-3), 2e-3)}, "length outside of the specimen = 0.00[0-9]* m, must be 0"),
        ({"a": ((6e-3, 6e-3), 1e-6)}, "edges of cells that its line meets = 0"),
        ({"a": ((6e-3, 6e-3), -1.0)}, r"excavation a: radius = -1.0 m"),
        ({"a": ((6e-3,), 1e-3)}, "excavation a: centre = "),
        ({"a": [(2e-3, 2e-3), (8e-3, 8e-3)]}, "corners = 2, must be at least 3"),
        ({"a": [(2e-3, 2e-3), (8e-3, 8e-3, 1.0)]}, "must be a polygon"),
        ({"a b": CIRCLE}, "a b"),
        ({3: [(2e-3, 2e-3), (8e-3, 8e-3), (8e-3, 2e-3)]}, "name = 3, must be a text"),
        ({"a": 3.0}, "must be a polygon, rows x, y, or a circle"),
        ({}, "must be polygons or circles by their name"),
        ({"tunnel": CIRCLE}, "name = tunnel, exists"),
    ],
)
def test_lines_that_cannot_be_excavated_are_refused_in_one_line(sawn, given, told):
    refusal(told, sawn.with_excavations, given)


def test_what_would_hang_on_nothing_is_refused_and_nothing_is_taken(whole):
    rings = {"outer": ((0.006, 0.006), 0.0045), "inner": ((0.006, 0.006), 0.0015)}
    rig, _ = made(whole.with_excavations(rings))
    held = rig.hold(disc=((0.006, 0.006), 2e-4))
    grains = rig.built.counts()["grains"]
    with pytest.raises(
        InputError, match="contains held nodes at .*; pass other nodes to hold"
    ) as refused:
        rig.excavate("outer")
    assert "\n" not in str(refused.value) and held.nodes
    refusal("unknown .did you mean inner", rig.excavate, "iner")
    for parts in (0, -1, 1.5, "all", 10**9):
        refusal("excavate: parts = .*, must be", rig.excavate, "inner", parts=parts)
    assert rig.built.counts()["grains"] == grains
    assert rig.stages == []
    plain, _ = made(whole)
    refusal(
        "does not exist in the specimen; add it with with_excavations", plain.excavate, "tunnel"
    )


def test_an_island_is_refused(whole):
    slots = {"c": _ring_with_a_gap(0.003, 0.0045), "plug": ((0.006, 0.00225), 0.0012)}
    rig, _ = made(whole.with_excavations(slots))
    rig.excavate("c")
    refusal(r"leaves \d+ grains at .* without a connection to a part", rig.excavate, "plug")


def _ring_with_a_gap(inner: float, outer: float) -> np.ndarray:
    """A ring but for its lowest part."""
    angles = np.radians(np.linspace(-75.0, 255.0, 45))
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    return 0.006 + np.vstack([outer * ways, inner * ways[::-1]])
