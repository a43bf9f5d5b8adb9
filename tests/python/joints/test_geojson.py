# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints from maps: GeoJSON, its names, origin and system of coordinates; what is refused."""

from __future__ import annotations

import itertools
import json

import numpy as np
import pytest
from refusals import refusal

from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.joints import geojson
from flexpm.joints.lines import read as read_csv
from flexpm.specimens.specimen import Specimen
from flexpm.studies import jobs

EAST, NORTH = 691_000.0, 5_334_000.0
METRES = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
WIDTH, HEIGHT = 0.02, 0.03


def feature(kind, coordinates, **properties):
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def moved(points):
    return [[EAST + x, NORTH + y, 500.0] for x, y in points]


A = [(0.0, 0.005), (0.01, 0.012), (0.02, 0.013)]
B = [[(0.0, 0.02), (0.02, 0.025)], [(0.004, 0.0), (0.004, 0.03)]]
MAP = {
    "type": "FeatureCollection",
    "crs": METRES,
    "features": [
        feature("LineString", moved(A), set="bedding", name="set 1", no=7),
        feature("MultiLineString", [moved(one) for one in B], set="joints", name="set 2", no=8),
        feature("Point", [0.0, 0.0], set="well"),
        feature("Polygon", [moved(A)]),
        {"type": "Feature", "properties": None, "geometry": None},
    ],
}


@pytest.fixture
def file(tmp_path):
    (tmp_path / "map.geojson").write_text(json.dumps(MAP))
    return tmp_path / "map.geojson"


def same(found, expected):
    assert list(found) == list(expected)
    for name, lines in expected.items():
        for one, other in zip(found[name], lines, strict=True):
            assert np.asarray(one) == pytest.approx(np.asarray(other), abs=1e-9)


def test_lines_are_named_by_a_property_and_begin_at_the_lower_left_corner(file):
    found = geojson.read(file, "set")
    same(found.lines, {"bedding": [A], "joints": B})
    assert found.origin == (EAST, NORTH)
    assert found.notes[0] == "joints: 1 Point, 1 Polygon left out, which are no lines"
    assert found.notes[1].startswith("joints: origin = 691000,5334000 m of the map (lower left")
    assert len(found.notes) == 2
    same(geojson.read(file, "no").lines, {"7": [A], "8": B})
    same(geojson.read(file).lines, {"set-1": [A], "set-2": B})
    shifted = geojson.read(file, "set", (EAST - 1.0, NORTH + 2.0)).lines["bedding"][0]
    assert shifted[0] == pytest.approx((1.0, -1.995))


def test_a_map_without_names_is_one_joint_and_without_a_system_is_metres(tmp_path):
    lines = {"type": "GeometryCollection", "geometries": [feature("LineString", A)["geometry"]]}
    (tmp_path / "a.json").write_text(json.dumps(lines))
    found = geojson.read(tmp_path / "a.json", origin=(0.0, 0.0))
    same(found.lines, {"joint": [A]})
    assert found.notes[0] == "joints: crs is missing in the map, its numbers are taken as metres"


def test_a_map_cuts_as_the_same_lines_from_a_table(file, tmp_path):
    rows = ["x1,y1,x2,y2,name"]
    for name, lines in {"bedding": [A], "joints": B}.items():
        for line in lines:
            for (a, b), (c, d) in itertools.pairwise(line):
                rows.append(f"{a!r},{b!r},{c!r},{d!r},{name}")
    (tmp_path / "a.csv").write_text("\n".join(rows))
    specimen = Specimen.rectangle(WIDTH, HEIGHT, 0.01)
    cut = specimen.joints_from_geojson(file, name="set")
    other = specimen.with_joints(read_csv(tmp_path / "a.csv"))
    assert cut.tessellation.cells == other.tessellation.cells
    assert cut.spec.joint_origin == (EAST, NORTH)
    cut.save(tmp_path / "a.json")
    again = Specimen.load(tmp_path / "a.json")
    assert again.spec == cut.spec and again.joints == cut.joints


@pytest.mark.long
def test_the_command_tells_and_stores_the_origin(file, tmp_path, capsys):
    size = ["--width", str(WIDTH), "--height", str(HEIGHT), "--thickness", "0.01", "--quiet"]
    joints = ["--joints", str(file), "--name", "set", "--max-strain", "1e-6"]
    laws = [f"joint.{name}.{key}" for name in ("bedding", "joints") for key in LAW]
    law = [word for one in laws for word in ("--set", one)]
    out = ["--out", str(tmp_path / "out"), "--no-report"]
    origin = ["--origin", f"{EAST - 0.001},{NORTH}"]
    assert cli.main(["run", "uniaxial", *size, *joints, *law, *out, *origin]) in (0, 3)
    told = capsys.readouterr().out
    assert "joints: origin = 690999.999,5334000 m of the map\n" in told
    stored = json.loads((tmp_path / "out/result.json").read_text())["inputs"]["specimen"]
    assert stored["joint_origin"] == [EAST - 0.001, NORTH]


LAW = (
    *("normal_stiffness=1e13", "shear_stiffness=3e12", "cohesion=0", "tensile_strength=0"),
    "friction=0.5",
)


def changed(**changes):
    return json.dumps({**MAP, **changes})


def of_line(coordinates, **properties):
    return changed(features=[feature("LineString", coordinates, **properties)])


def system(name):
    return changed(crs={"type": "name", "properties": {"name": name}})


WRONG = [
    ("{", "is not GeoJSON"),
    ("[1]", "is not GeoJSON"),
    (system("urn:ogc:def:crs:OGC:1.3:CRS84"), "is in degrees, must be in metres"),
    (system("EPSG:4326"), "is in degrees"),
    (system("urn:ogc:def:crs:EPSG::7844"), "is in degrees"),
    (changed(crs={"type": "link"}), "must have a name; save it projected"),
    (changed(features=[]), "lines = 0, must be >= 1"),
    (changed(features=3), "features = 3, must be a list"),
    (changed(features=[3]), "feature = 3, must be a GeoJSON feature"),
    (of_line([[0, 0]]), "line = [[0, 0]], must be two points or more"),
    (of_line([[0, 0], [1, "a"]]), "geometry 1: point = [1, 'a'], must be numbers x, y"),
    (of_line([[0, 0], [1, True]]), "must be numbers x, y"),
    (of_line([[0, 0], [1, 1]]).replace("[1, 1]", "[1, NaN]"), "NaN is not a finite number"),
    (of_line([[0, 0], [1, 1]]).replace("[1, 1]", "[1, 1e999]"), "must be numbers x, y"),
    (of_line([[0, 0], [1, 1]], other="a"), "property 'set' = None, must be a text or a number"),
    (of_line([[0, 0], [1, 1]], set="a.b"), "must be a name without spaces, dots"),
    (of_line([[0, 0], [0, 0]], set="a"), "start and end of a line without length"),
]


@pytest.mark.parametrize(("text", "words"), WRONG, ids=range(len(WRONG)))
def test_other_maps_are_refused_in_one_line(tmp_path, text, words):
    (tmp_path / "a.geojson").write_text(text)
    with pytest.raises(InputError) as error:
        geojson.read(tmp_path / "a.geojson", "set")
    assert words in str(error.value) and "\n" not in str(error.value)


def test_names_and_origins_are_of_maps_alone(tmp_path, capsys):
    (tmp_path / "a.csv").write_text("x1,y1,x2,y2,name\n0,0,1,1,a\n")
    for option in (["--name", "set"], ["--origin", "1,2"]):
        given = ["--joints", str(tmp_path / "a.csv"), *option, "--quiet"]
        assert cli.main(["specimen", "rectangle", *given, "--out", str(tmp_path / "o")]) == 2
        assert "needs a map of joints" in capsys.readouterr().err


def test_a_study_reads_a_map_as_the_command_does(file):
    asked = {"test": "uniaxial", "joints": file.name, "width": WIDTH, "height": HEIGHT}
    asked |= {f"set.joint.{name}.open": True for name in ("bedding", "joints")}
    asked |= {"joint-name": "set", "joint_origin": [EAST, NORTH]}
    job = jobs.make(asked, file.parent)
    assert job.spec.specimen.joint_names == ("bedding", "joints")
    assert job.spec.specimen.joint_origin == (EAST, NORTH)
    place = job.arguments.index("--origin")
    assert job.arguments[place + 1] == f"{EAST},{NORTH}"
    assert job.arguments[job.arguments.index("--name") + 1] == "set"
    elsewhere = jobs.make({**asked, "joint_origin": [EAST, NORTH + 1e-3]}, file.parent)
    assert elsewhere.key != job.key
    for key, value in (("joint_name", 3), ("joint_origin", [1.0]), ("joint_origin", ["a", 1.0])):
        refusal(f"study {key} = ", jobs.make, {**asked, key: value}, file.parent)
