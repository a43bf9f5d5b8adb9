# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints of 3D specimens: areas, volumes, files, networks and their statistics. SI units."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from good_files import POLYGONS
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refusal

import flexpm
from flexpm.cli import main as cli
from flexpm.joints.disc_network import Box, DiscNetwork
from flexpm.joints.disc_radii import RADII
from flexpm.joints.planes import JointPlane, disc, normal_of
from flexpm.joints.poles import Fisher, statistics
from flexpm.report.stereonet import great_circle, projected
from flexpm.results import doubts
from flexpm.specimens.files.source import SpecimenSource
from flexpm.specimens.space import cuts, file
from flexpm.specimens.space.spec import SolidSpec
from flexpm.specimens.spec import SpecimenSpec

SIDES = (0.012, 0.012, 0.016)
PLANE = {"point": (0.006, 0.006, 0.008), "dip": 50.0, "dip_direction": 30.0}


@pytest.fixture(scope="module")
def box():
    return flexpm.Specimen.box(*SIDES)


@pytest.fixture(scope="module")
def cylinder():
    return flexpm.Specimen.cylinder(0.012, 0.016)


def discs(**changes):
    """A network of one set of discs."""
    one = {
        "kind": "discs",
        "intensity": 300.0,
        "radius": {"law": "constant", "value": 0.004},
        "orientation": {"law": "fisher", "dip": 40, "dip_direction": 100, "concentration": 20},
    }
    return {"seed": 3, "set": {"a": {**one, **changes}}}


def volume_error(specimen):
    """Volume of all cells over that of the specimen, less 1."""
    return math.fsum(specimen.cells.volumes) / specimen.outline().volume - 1.0


@pytest.mark.parametrize("shape", ["box", "cylinder"])
@pytest.mark.parametrize("dip", [0.0, 50.0, 90.0])
def test_a_plane_cuts_its_section(shape, dip, request):
    """Corners of grains that stay whole are moved into the plane."""
    specimen = request.getfixturevalue(shape)
    middle = (0.006, 0.006, 0.008) if shape == "box" else (0.0, 0.0, 0.008)
    given = {"point": middle, "dip": dip, "dip_direction": 90.0}
    cut = specimen.with_joints({"f": given})
    told = cut.told_cuts["f"]
    plane = (shape, dip) != ("cylinder", 90.0)  # there a corner stays off the plane
    assert told.cut == pytest.approx(told.within, rel=1e-9 if plane else 0.01)
    assert told.taken == told.bridged == told.beyond == 0.0
    sections = {"box": {0.0: 0.012**2, 90.0: 0.012 * 0.016, 50.0: None}}
    expected = sections.get(shape, {}).get(dip)
    if expected is not None:
        assert told.within == pytest.approx(expected, rel=1e-12)
    areas = cuts.areas(cut.cells, cut.planes)
    assert areas.sum() == pytest.approx(told.cut, rel=1e-12)
    assert abs(volume_error(cut)) < 1e-12
    assert len(cut.spheres) > len(specimen.spheres)
    assert told.deviation == cut.joint_deviations()["f"]
    assert told.deviation < (1e-9 if plane else 0.2) * cut.mean_diameter
    assert (told.detour == 0.0) == plane
    assert cut.mean_diameter == specimen.mean_diameter
    assert np.bincount(cut.grains).max() == 2
    cut.meshes()


def test_a_jointed_solid_is_saved_and_loaded_with_the_same_bits(box, tmp_path):
    minerals = np.arange(len(box.spheres)) % 2
    cut = box.with_minerals(minerals).with_joints({"f": PLANE})
    cut = cut.with_joints({"g": {**PLANE, "dip": 20.0}, "f": {**PLANE, "dip": 80.0}})
    assert (cut.minerals == minerals[cut.grains]).all()
    assert cut.spec.joint_names == ("f", "g")
    assert [one.name for one in cut.planes] == ["f", "g", "f"]
    cut.save(tmp_path / "solid.json")
    found = flexpm.Specimen.load_solid(tmp_path / "solid.json")
    assert found.spec == cut.spec
    assert found.planes == cut.planes
    for name in ("spheres", "minerals", "grains", "edge_joints"):
        assert np.array_equal(getattr(found, name), getattr(cut, name))
    for name in ("vertices", "volumes", "faces", "joints"):
        assert np.array_equal(getattr(found.cells, name), getattr(cut.cells, name))
    again = found.with_joints({"h": {**PLANE, "dip": 10.0}})
    same = cut.with_joints({"h": {**PLANE, "dip": 10.0}})
    assert np.array_equal(again.cells.vertices, same.cells.vertices)


def test_parts_of_two_minerals_are_cut_no_more(box):
    cut = box.with_joints({"f": PLANE})
    minerals = np.zeros(len(cut.spheres), dtype=int)
    again = cut.with_minerals(minerals).with_joints({"g": {**PLANE, "dip": 20.0}})
    assert (again.minerals == 0).all()
    minerals[-1] = 1  # a second part
    refusal(
        f"minerals: parts of grain {cut.grains[-1]} have two, must be one before more joints",
        cut.with_minerals(minerals).with_joints,
        {"g": {**PLANE, "dip": 20.0}},
    )


def test_minerals_of_parts_are_saved_and_loaded(box, tmp_path):
    cut = box.with_joints({"f": PLANE})
    minerals = np.arange(len(cut.spheres)) % 2
    cut.with_minerals(minerals).save(tmp_path / "solid.json")
    found = flexpm.Specimen.load_solid(tmp_path / "solid.json")
    assert np.array_equal(found.minerals, minerals)


def test_other_minerals_than_those_of_the_inputs_are_refused(box, tmp_path):
    minerals = np.arange(len(box.spheres)) % 2
    cut = box.with_minerals(minerals).with_joints({"f": PLANE})
    dataclasses.replace(cut, minerals=1 - cut.minerals).save(tmp_path / "solid.json")
    refusal("other minerals than it names", flexpm.Specimen.load_solid, tmp_path / "solid.json")


@pytest.mark.parametrize("network", [1, {"seed": 1}, {"seed": -1, "set": discs()["set"]}])
def test_a_file_with_no_network_is_refused(box, tmp_path, network):
    cut = box.with_network(discs())
    content = {
        "spec": {**dataclasses.asdict(cut.spec), "networks": [network]},
        "removed_spheres": 0,
        "planes": [one.to_json() for one in cut.planes],
        "spheres": cut.whole_spheres.tolist(),
    }
    file.write(tmp_path / "solid.json", content)
    refusal("network", flexpm.Specimen.load_solid, tmp_path / "solid.json")


def test_planes_that_are_small_or_close_for_the_grains_are_warned_of(box):
    """P32 of level planes at a distance h is about 1 / h; of a disc it is its area over V."""
    grain, volume = box.mean_diameter, math.prod(SIDES)
    middle = {"centre": (0.006, 0.006, 0.008), "dip": 0.0, "dip_direction": 0.0}
    radii = [0.7 * grain, 1.2 * grain]
    far = {**middle, "centre": (1.0, 1.0, 1.0), "radius": 0.6 * grain}
    cut = box.with_joints({"f": [{**middle, "radius": radius} for radius in radii] + [far]})
    told = cut.told_cuts["f"]
    assert told.smallest_disc == pytest.approx(1.4, rel=1e-12)
    area = math.pi * sum(radius**2 for radius in radii)
    assert told.crowding == pytest.approx(area / volume * grain, rel=1e-9)
    found = doubts.of_cuts({"f": told.to_json()})
    assert "joint f: smallest disc = 1.4 mean diameters, should be at least 1.5" in found[-1]

    def warned(number):
        places = np.linspace(0.0, SIDES[2], number + 2)[1:-1]
        planes = [{"point": (0.0, 0.0, z), "dip": 0.0, "dip_direction": 0.0} for z in places]
        told = box.with_joints({"f": planes}).told_cuts["f"]
        assert told.smallest_disc is None
        assert told.crowding == pytest.approx(number * grain / SIDES[2], rel=1e-9)
        return [one for one in doubts.of_cuts({"f": told.to_json()}) if "P32 times" in one]

    most = int(0.5 * SIDES[2] / grain)
    assert warned(most) == []
    assert "should be at most 0.5; use smaller grains" in warned(most + 1)[0]


def test_a_joint_off_its_plane_is_named_so(box):
    cuts_of = {"f": box.with_joints({"f": PLANE}).told_cuts["f"].to_json()}
    assert "deviates from its plane" in doubts.of_bend(1e-3, cuts_of)
    assert "deviates from its line" in doubts.of_bend(1e-3, {})


def test_cells_of_labels_are_cut_too():
    labels = np.arange(1, 28).reshape(3, 3, 3).repeat(4, 0).repeat(4, 1).repeat(4, 2)
    solid = flexpm.Specimen.from_label_volume(labels, voxel=1e-3, minerals={27: None})
    cut = solid.with_joints({"f": {"point": (0.006,) * 3, "dip": 0.0, "dip_direction": 0.0}})
    assert len(cut.spheres) == 26 + 9
    assert cut.told_cuts["f"].cut == pytest.approx(0.012**2, rel=1e-9)


@pytest.mark.parametrize(
    ("joints", "words"),
    [
        ({}, "must be planes, discs or polygons"),
        ({"a b": PLANE}, "must be a name without spaces"),
        ({"a": [(0, 0, 0), (1, 0, 0)]}, "corners = 2, must be three or more"),
        ({"a": [(0, 0, 0), (1, 0, 0), (2, 0, 0)]}, "area = 0 m2, must be above 0"),
        ({"a": [(0, 0, 0), (1, 0, 0), (1, 1, 0.1), (0, 1, 0)]}, "from the plane of the others"),
        ({"a": [(0, 0, 0), (2, 0, 0), (2, 2, 0), (1.5, 0.2, 0)]}, "one of a convex polygon"),
        ({"a": [(0, 0, math.inf), (1, 0, 0), (1, 1, 0)]}, "must be a plane, a disc or a polygon"),
        ({"a": {"point": (0, 0, 0), "dip": 5}}, "dip_direction is missing"),
        ({"a": {**PLANE, "dip": 91}}, "dip = 91 degree, must be <= 90"),
        ({"a": {**PLANE, "size": 1}}, "key = 'size'"),
        ({"a": {**PLANE, "point": (0, 0)}}, "must be three numbers"),
        ({"a": {**PLANE, "point": (9, 9, 9)}}, "planes that cut a grain = 0 of 1"),
        (
            {"a": {"centre": (0, 0, 0), "dip": 0, "dip_direction": 0, "radius": 1e-4}},
            "radius of disc 0 = 0.0001 m, must be >=",
        ),
    ],
)
def test_what_is_no_joint_is_refused(box, joints, words):
    refusal(words, box.with_joints, joints)


def test_polygons_discs_and_planes_are_read_from_files(box, tmp_path):
    corners = [(-1.0, -1.0, 0.008), (1.0, -1.0, 0.008), (0.0, 2.0, 0.008)]
    numbers = ",".join(str(x) for corner in corners for x in corner)
    head = "name," + ",".join(f"{axis}{k}" for k in range(4) for axis in "xyz")
    files = {
        "polygons.csv": f"{head}\nf,{numbers},,,\n",
        "discs.csv": "x,y,z,dip,dip_direction,radius,name\n0.006,0.006,0.008,0,0,0.5,f\n",
        "planes.csv": "name,x,y,z,dip,dip_direction\nf,0.006,0.006,0.008,0,0\n",
    }
    made = []
    for name, text in files.items():
        (tmp_path / name).write_text(text)
        made.append(box.joints_from_csv(tmp_path / name))
    assert [one.planes[0].kind for one in made] == ["polygon", "disc", "plane"]
    for one in made:
        assert np.array_equal(one.cells.vertices, made[0].cells.vertices)


def test_polygons_of_dfnworks_are_read_about_the_middle(box, tmp_path):
    polygons, out = tmp_path / "polygons.dat", tmp_path / "out"
    polygons.write_text(POLYGONS)
    cut = box.joints_from_dfnworks(polygons, "f")
    assert [one.name for one in cut.planes] == ["f", "f"]
    assert cut.planes[0].offset == pytest.approx(0.5 * SIDES[2] + 0.001)
    assert cut.planes[1].corners[2] == pytest.approx((0.006, 0.006, 0.009))
    call = ["specimen", "box", "--width", "0.012", "--depth", "0.012", "--height", "0.016"]
    call += ["--quiet", "--joints", str(polygons), "--joint", "f", "--out", str(out)]
    assert cli.main(call) == 0
    found = flexpm.Specimen.load_solid(out / "solid.json")
    assert found.planes == cut.planes
    assert np.array_equal(found.cells.vertices, cut.cells.vertices)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "first line = '', must be 'nPolygons: N' before N polygons"),
        (POLYGONS.replace("2", "3", 1), "must be 'nPolygons: N' before N polygons, of which the"),
        (POLYGONS.replace("4 {", "5 {"), "number of corners = '5', must be 4"),
        (POLYGONS.replace("1e-3", "nan"), "line 3: corner = '0, 0, nan', must be three numbers"),
        (POLYGONS.replace("1e-3", "1, 2"), "corner = '0, 0, 1, 2', must be three numbers"),
        (POLYGONS.replace("1e-3", "-1"), "area = 0 m2, must be above 0"),
    ],
)
def test_files_of_no_polygons_are_refused(box, tmp_path, text, words):
    (tmp_path / "a.dat").write_text(text)
    refusal(words, box.joints_from_dfnworks, tmp_path / "a.dat", "f")


def test_polygons_of_dfnworks_need_a_name_and_a_3d_specimen(tmp_path):
    polygons = tmp_path / "a.dat"
    polygons.write_text(POLYGONS)
    solid, plane = SolidSpec("box"), SpecimenSpec("rectangle")
    read = SpecimenSource.read
    refusal("joint = None, must be the name of the joint", read, solid, joints=polygons)
    refusal("joint = f, needs polygons of dfnWorks", read, solid, joint="f")
    refusal("polygons of dfnWorks are available in 3D only", read, plane, joint="f")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "must have rows and the columns"),
        ("x1,y1,x2,y2,name\n0,0,1,1,a\n", "must have rows and the columns"),
        ("name,x0,y0,z0,x1,y1,z1\na,0,0,0,1,1,1\n", "must have rows and the columns"),
        ("name,x,y,z,dip,dip_direction\na,0,0,0,1\n", "cells = 5, must be 6"),
        ("name,x,y,z,dip,dip_direction\na,0,b,0,1,0\n", "line 2, joint 'a': y = 'b'"),
        ("name,x,y,z,dip,dip_direction\n,0,0,0,1,0\n", "must be a name without"),
        ("name,x,y,z,dip,dip_direction\na,0,0,0,-1,0\n", "dip = -1.0 degree, must be >= 0"),
        ("name,x,y,z,dip,dip_direction\na,0,0,0,1,361\n", "dip_direction = 361.0 degree, must"),
        ("name,x0,y0,z0,x1,y1,z1,x2,y2,z2\na,0,0,0,1,1\n", "numbers = 5, must be three"),
    ],
)
def test_files_of_no_joints_are_refused(box, tmp_path, text, words):
    (tmp_path / "a.csv").write_text(text)
    refusal(words, box.joints_from_csv, tmp_path / "a.csv")


def test_a_network_has_its_intensity_in_the_mean():
    """P32 of the generated discs in a box, over seeds, within three standard errors."""
    low, high = np.zeros(3), np.array([0.02, 0.02, 0.03])
    box, found = Box(tuple(low), tuple(high)), []
    for seed in range(20):
        network = DiscNetwork.of(
            discs(radius={"law": "uniform", "smallest": 3e-3, "largest": 6e-3})
        )
        made = DiscNetwork.of(network, seed).planes(box)
        found.append(sum(area_in(one, low, high) for one in made) / np.prod(high - low))
    error = np.std(found) / math.sqrt(len(found))
    assert np.mean(found) == pytest.approx(300.0, abs=3.0 * error)
    assert error < 15.0


def area_in(plane: JointPlane, low, high):
    """Area of a polygon in a box."""
    corners = np.array(plane.corners)
    for axis in range(3):
        for bound, sense in ((low[axis], 1.0), (high[axis], -1.0)):
            kept = []
            for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
                off, then = sense * (a[axis] - bound), sense * (b[axis] - bound)
                if off >= 0.0:
                    kept.append(a)
                if (off >= 0.0) != (then >= 0.0):
                    kept.append(a + off / (off - then) * (b - a))
            if not kept:
                return 0.0
            corners = np.array(kept)
    arms = corners - corners[0]
    return 0.5 * float(np.linalg.norm(np.cross(arms[1:-1], arms[2:]).sum(axis=0)))


@pytest.mark.parametrize(
    ("dip", "direction", "normal"),
    [
        (30.0, 90.0, (0.5, 0.0, math.sqrt(0.75))),
        (30.0, 0.0, (0.0, 0.5, math.sqrt(0.75))),
        (90.0, 180.0, (0.0, -1.0, 0.0)),
        (0.0, 77.0, (0.0, 0.0, 1.0)),
    ],
)
def test_dips_are_clockwise_from_y(dip, direction, normal):
    """Towards x the direction is 90 degrees; the upper normal leans to where the plane dips."""
    assert normal_of(dip, direction) == pytest.approx(normal, abs=1e-15)


@pytest.mark.parametrize("kappa", [5.0, 50.0, 500.0])
def test_poles_follow_fisher(kappa):
    count = 10_000
    law = Fisher(30.0, 250.0, kappa)
    poles = law.draw(np.random.default_rng(1), count)
    found = statistics(poles)
    assert found.concentration == pytest.approx(kappa, rel=0.05)
    # standard error of each component of the mean pole: that of a Fisher law
    mean = 1.0 / math.tanh(kappa) - 1.0 / kappa
    error = 1.0 / math.sqrt(count * kappa * mean)
    off = math.acos(min(1.0, float(np.dot(law.mean, normal_of(found.dip, found.dip_direction)))))
    assert off < 3.0 * math.sqrt(2.0) * error


def test_lines_meet_planes_as_often_as_their_intensity_says():
    """P10 = P32 <|cos|>: counted along 400 lines against the areas of the discs."""
    box = flexpm.Specimen.box(0.02, 0.02, 0.02, diameters=(0.003, 0.005))
    cut = box.with_network(discs(intensity=400.0))
    found = cut.network_intensities()["a"]
    generator = np.random.default_rng(2)
    places = generator.uniform(0.0, 0.02, (4000, 2))
    hits = sum(meets(one, places).sum() for one in cut.planes)
    counted = hits / (len(places) * 0.02)
    assert found["p10_z"] == pytest.approx(counted, rel=0.02)
    normals = np.abs([one.normal for one in cut.planes])
    inside = cut.cells.joint_cuts[:, 0]
    mean = float((normals[:, 2] * inside).sum() / inside.sum())
    assert found["p10_z"] == pytest.approx(found["generated"] * mean, rel=1e-12)
    assert found["cut"] == pytest.approx(found["generated"], rel=0.2)


def meets(one: JointPlane, places):
    """Which upright lines at places x, y in a box of 2 cm meet a disc there."""
    x, y, z = one.normal
    height = (one.offset - places @ [x, y]) / z
    corners = np.array(one.corners)[:, :2]
    inside = np.ones(len(places), dtype=bool)
    turned = np.roll(corners, -1, axis=0) - corners
    for corner, (along, across) in zip(corners, turned, strict=True):
        inside &= (places - corner) @ [-across, along] * np.sign(z) > 0.0
    return inside & (height > 0.0) & (height < 0.02)


@given(st.floats(0.0, 90.0), st.floats(0.0, 360.0))
def test_a_stereonet_has_equal_areas_on_the_lower_hemisphere(dip, direction):
    """A pole is opposite to the dip direction, and its cap has the area of its circle."""
    ((x, y),) = projected(np.array([normal_of(dip, direction)]))
    cap = 2.0 * math.pi * (1.0 - math.cos(math.radians(dip)))
    assert math.pi * (x * x + y * y) == pytest.approx(0.5 * cap, abs=1e-12)
    away = math.radians(direction)
    assert x * math.cos(away) - y * math.sin(away) == pytest.approx(0.0, abs=1e-12)
    if dip < 90.0:  # else both ends of the pole are on the rim
        assert x * math.sin(away) + y * math.cos(away) <= 1e-12
    circle = great_circle(dip, direction)
    assert np.hypot(*circle.T).max() <= 1.0 + 1e-12
    assert np.hypot(*circle[[0, -1]].T) == pytest.approx([1.0, 1.0])
    # the lowest point of the plane is below its dip direction
    lowest = circle[len(circle) // 2]
    depth = math.sqrt(2.0) * math.sin(math.radians(45.0 - 0.5 * dip))
    assert lowest == pytest.approx(depth * np.array([math.sin(away), math.cos(away)]), abs=1e-12)


def test_the_commands_draw_a_stereonet(tmp_path):
    network, out = tmp_path / "n.toml", tmp_path / "out"
    network.write_text(
        "seed = 3\n[set.a]\nkind = 'discs'\nintensity = 300.0\n"
        "radius = {law = 'constant', value = 0.004}\n"
        "orientation = {law = 'fisher', dip = 40, dip_direction = 100, concentration = 20}\n"
        "[set.b]\nkind = 'planes'\ndip = 80\ndip_direction = 300\nspacing = 0.008\n"
        "origin = [0.0, 0.0, 0.0]\n"
    )
    sizes = ["--width", "0.012", "--depth", "0.012", "--height", "0.016"]
    given = [*sizes, "--quiet", "--network", str(network), "--out"]
    assert cli.main(["specimen", "box", *given, str(out)]) == 0
    assert (out / "network.png").stat().st_size > 10000
    run, laws = tmp_path / "run", [f"joint.{name}.open=true" for name in "ab"]
    call = ["run", "uniaxial", "--shape", "box", "--model", "rigid", "--max-strain", "1e-5"]
    call += ["--rate", "16", *(word for law in laws for word in ("--set", law))]
    assert cli.main([*call, *given, str(run)]) in (0, 3)
    assert (run / "network.png").stat().st_size > 10000
    assert "Fracture network" in (run / "report.html").read_text()


def test_traces_of_a_plane_go_around_the_surface(box):
    """The rim of a level section: four sides, all in the plane."""
    cut = box.with_joints({"f": {**PLANE, "dip": 0.0}, "g": {**PLANE, "point": (0, 0, 0.004)}})
    ends = cut.cells.vertices[cut.joint_traces()["f"]]
    assert np.all(np.abs(ends[:, :, 2] - 0.008) < 1e-12)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    # an edge belongs to one contact of the joint
    assert math.fsum(lengths) == pytest.approx(4 * 0.012, rel=1e-9)
    assert [*cut.joint_traces()] == ["f", "g"]
    assert box.joint_traces() == {}


@pytest.mark.parametrize("law", [*RADII])
def test_laws_of_radii_have_their_mean_square(law):
    values = {"smallest": 0.5, "largest": 3.0}
    more = {
        "constant": {"value": 2.0},
        "uniform": values,
        "exponential": {**values, "mean": 0.7},
        "lognormal": {**values, "mean": 1.0, "deviation": 0.5},
        "power": {**values, "exponent": 3.0},
    }
    made = RADII[law].of("law", more[law])
    radii = made.draw(np.random.default_rng(1), 100_000)
    assert radii.min() >= made.shortest - 1e-12
    assert radii.max() <= made.longest + 1e-12
    assert made.mean_square == pytest.approx(np.mean(radii**2), rel=0.02)


def test_a_disc_has_its_area():
    one = disc("a", (0.0, 0.0, 0.0), normal_of(40.0, 200.0), 0.5)
    arms = np.array(one.corners) - one.corners[0]
    twice = np.cross(arms[1:-1], arms[2:]).sum(axis=0)
    assert 0.5 * twice == pytest.approx(0.25 * math.pi * np.array(one.normal), rel=1e-12)
    assert (one.dip, one.dip_direction) == pytest.approx((40.0, 200.0))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"kind": "lines"}, "kind = 'lines', must be discs or planes"),
        ({"intensity": -1.0}, "intensity = -1.0 1/m, must be > 0"),
        ({"number": 5}, "must be one of them"),
        ({"size": 5}, "key = 'size'"),
        ({"intensity": 1e8}, "larger discs, a lower upper cut-off or a wider spacing"),
        ({"radius": {"law": "constant", "value": 1e-5}, "intensity": 1.0}, "radius of disc 0 = "),
        ({"radius": {"law": "uniform", "smallest": 2.0, "largest": 1.0}}, "smallest = 2 m, must"),
        ({"radius": 1.0}, "network set a: radius = 1.0, must be a table"),
    ],
)
def test_what_is_no_network_is_refused(box, changes, words):
    refusal(words, box.with_network, discs(**changes))


def test_sets_and_joints_have_names_of_their_own(box):
    cut = box.with_network(discs())
    refusal("is the name of a set of the network", cut.with_joints, {"a": PLANE})
    refusal("is the name of a joint", cut.with_network, discs())


@settings(max_examples=25, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.tuples(*(st.floats(-0.2, 1.2) for _ in range(3))),
            st.sampled_from([0.0, 30.0, 45.0, 90.0]) | st.floats(0.0, 90.0),
            st.sampled_from([0.0, 90.0, 180.0]) | st.floats(0.0, 360.0),
            st.none() | st.floats(0.002, 0.02),
        ),
        min_size=1,
        max_size=12,
    )
)
def test_any_planes_and_discs_leave_sound_cells(box, drawn):
    shapes = []
    for place, dip, direction, radius in drawn:
        at = tuple(share * side for share, side in zip(place, SIDES, strict=True))
        angles = {"dip": dip, "dip_direction": direction}
        shapes.append(
            {"point": at, **angles}
            if radius is None
            else {"centre": at, "radius": radius, **angles}
        )
    try:
        cut = box.with_joints({"f": shapes})
    except flexpm.InputError as error:
        assert "planes that cut a grain = 0" in str(error)
        return
    assert abs(volume_error(cut)) < 1e-12
    assert cut.cells.volumes.min() > 0.0
    assert cut.meshes().volumes.min() > 0.0
