# SPDX-License-Identifier: GPL-3.0-or-later
"""A small whole file of each format that other programs or people write, and its reader."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from ebsd_files import ang_text, ctf_text
from neper_files import tesr_bytes, tesr_text, tess_text
from neper_solids import bricks, prism
from neper_solids import tess_text as solid_text
from PIL import Image

from flexpm import materials
from flexpm.joints import dfnworks, geojson, lines, plane_files
from flexpm.joints.disc_network import Box, DiscNetwork
from flexpm.joints.network import Network
from flexpm.joints.window import Window
from flexpm.materials.material import Material
from flexpm.rigs.stages.history import history_of
from flexpm.specimens.labels import ebsd, picture, tesr
from flexpm.specimens.space.cells import sphere_rows
from flexpm.specimens.specimen import Specimen
from flexpm.studies import calibration_problem, study
from flexpm.studies.scorecards import rock

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
JOINTS = (
    "x1,y1,x2,y2,name\n0,0.01,0.01,0.02,fault\n0.01,0.02,0.02,0.02,fault\n0,0,0.004,0.02,bed-1\n"
)
DISCS = "x,y,z,dip,dip_direction,radius,name\n0.004,0.004,0.006,50,30,0.004,bedding\n"
POLYGONS = """nPolygons: 2
4 {-1, -1, 0.001} {1, -1, 0.001} {1, 1, 0.001} {-1, 1, 0.001}
3 {-1, 0, -1} {1, 0, -1} {0, 0, 1e-3}
"""
DISC_NETWORK = """seed = 3

[set.bedding]
kind = "discs"
intensity = 120.0
radius = {law = "exponential", mean = 0.004, smallest = 0.003, largest = 0.009}
orientation = {law = "fisher", dip = 50.0, dip_direction = 30.0, concentration = 20.0}

[set.steep]
kind = "planes"
dip = 80.0
dip_direction = 200.0
spacing = 0.01
origin = [0.0, 0.0, 0.0]
"""
NETWORK = """seed = 3

[set.bedding]
intensity = 120.0
length = { law = "power", exponent = 2.5, smallest = 2e-3, largest = 0.02 }
orientation = { law = "von-mises", angle = 30.0, concentration = 40.0 }

[set.steep]
intensity = 60.0
length = { law = "lognormal", mean = 6e-3, deviation = 2e-3, smallest = 2e-3, largest = 0.02 }
orientation = { law = "fisher", dip = 80, dip_direction = 90, concentration = 20, weight = "sine" }
"""
HISTORY = "time,load\nms,kN\n0,0\n1.5,10\n2.5,-3e-1\n4,0\n"
SPHERES = (
    "# x y z r\n0.002 0.002 0.002 1e-3\n0.006,0.006,0.006,1e-3 # a comment\n2e-3 6e-3 4e-3 1e-3\n"
)
MATERIAL = """tensile_strength = 8e6
cohesion = 30e6
friction = 0.4
tensile_fracture_energy = 20
shear_fracture_energy = 800

[elastic.flexible]
young = 50e9
poisson = 0.2
normal_stiffness = 1e14
shear_ratio = 0.3

[[mineral]]
name = "quartz"
fraction = 0.4
cohesion = 40e6
elastic.flexible.young = 90e9

[[mineral]]
name = "feldspar"
fraction = 0.6

[[interface]]
pair = ["quartz", "feldspar"]
factor.cohesion = 0.5
tensile_strength = 5e6

[joint.fault]
normal_stiffness = 1e13
shear_stiffness = 5e12
friction = 0.6
dilation_angle = 8.0
dilation_slip = 1e-4
residual_friction = 0.5
slip_length = 1e-3

[joint.slot]
open = true
"""
STUDY = """[study]
name = "few"

[common]
test = "bending"
length = 0.03
height = 0.008

[grid]
model = ["flexible", "rigid"]
set.cohesion = [20e6, 30e6]
seed = [1, 2]

[[case]]
span = 0.02

[[case]]
control = "cmod"
notch = 2e-3

[[picture]]
x = "set.cohesion"
y = "peak_stress"
by = ["model"]
"""
CALIBRATION = """[calibration]
name = "mine"
model = "rigid"
evaluations = 4
confinements = [0, 2e6]

[screen]
seeds = [1, 2]
shape = "box"
width = 0.015
depth = 0.015
height = 0.030

[screen.brazilian]
shape = "solid-disc"
diameter = 0.030
depth = 0.015

[target]
youngs_modulus = { value = 25.8e9, tolerance = 0.05 }
compressive_strength = 122.1e6

[free]
normal_stiffness = [5e12, 5e13]
cohesion = [8e6, 90e6]
tensile_strength = [1e6, 3e7]

[[ratio]]
of = "cohesion"
to = "tensile_strength"
bounds = [1.5, 40]
"""
ROCK = """[rock]
name = "granite"
presets = ["mine"]
source = "laboratory"

[compressive_strength]
value = 120e6
spread = 8e6
lower = 110e6
upper = 130e6
unit = "Pa"
decides = true

[drop_30.general]
lower = 0.1
source = "granites"
"""
#: Labels of eight bricks of 3 x 3 x 3 voxels.
VOLUME = np.arange(8, dtype=np.uint8).reshape(2, 2, 2).repeat(3, 0).repeat(3, 1).repeat(3, 2)
#: Two halves of a box of 9 mm x 9 mm x 12 mm.
GRAINS = """id,x,y,z,volume,phase
1,0.0045,0.0045,0.003,4.86e-7,quartz
2,0.0045,0.0045,0.009,4.86e-7,mica
"""
#: Content of each file, by its name.
TEXTS = {
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
    "a.ctf": ctf_text(PHASE, ANGLES, PHASES),
    "h.ctf": ctf_text(PHASE, ANGLES, PHASES, (1.0, 0.866), hexagonal=True),
    "a.ang": ang_text(PHASE, ANGLES, PHASES),
    "h.ang": ang_text(PHASE, ANGLES, PHASES, (1.0, 0.866), hexagonal=True),
    "a.geojson": json.dumps(
        {"type": "FeatureCollection", "crs": CRS, "features": FEATURES}, indent=1
    ),
    "joints.csv": JOINTS,
    "discs.csv": DISCS,
    "polygons.dat": POLYGONS,
    "discs.toml": DISC_NETWORK,
    "history.csv": HISTORY,
    "spheres.txt": SPHERES,
    "network.toml": NETWORK,
    "material.toml": MATERIAL,
    "study.toml": STUDY,
    "calibration.toml": CALIBRATION,
    "rock.toml": ROCK,
    "phases.toml": '0 = "hole"\n1 = "quartz"\n2 = "mica"\n',
}


def saved(save: Callable[..., Any], *given: Any, **options: Any) -> bytes:
    """What a function writes into a file."""
    file = io.BytesIO()
    save(file, *given, **options)
    return file.getvalue()


_COLOURS = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255]], dtype=np.uint8)[PHASE]
_GREY = Image.fromarray(PHASE.astype(np.uint8))
#: The same of files that are bytes.
BYTES = {
    "b.tesr": tesr_bytes(PHASE, "binary8", "u1"),
    "colours.png": saved(Image.fromarray(_COLOURS).save, format="PNG"),
    "grey.png": saved(_GREY.save, format="PNG"),
    "palette.png": saved(_GREY.convert("P").save, format="PNG"),
    "grey.tif": saved(Image.fromarray(PHASE.astype(np.uint16)).save, format="TIFF"),
    "lzw.tif": saved(_GREY.save, format="TIFF", compression="tiff_lzw"),
    "zip.tif": saved(_GREY.save, format="TIFF", compression="tiff_adobe_deflate"),
    "labels.npy": saved(np.save, PHASE),
    "parts.npy": saved(np.save, PHASE.astype(np.float32)),
}
FILES = {name: text.encode() for name, text in TEXTS.items()} | BYTES
#: Files of commands that are not broken byte by byte here.
OTHERS = {"volume.npy": saved(np.save, VOLUME), "grains.csv": GRAINS.encode()}


def _phases(path: Path) -> Any:
    found = picture.Picture(PHASE)
    return picture.indices(picture.read_phases(path, found))


def _network(path: Path) -> Any:
    network = Network.read(path)
    return network, network.lines(Window((0.0, 0.0), (0.02, 0.03)))


def _material(path: Path) -> Any:
    made = materials.load(path)
    assert isinstance(made, Material)
    return made, made.joint_laws("flexible")


def _tess(path: Path) -> Any:
    return Specimen.from_tess(path, 0.01).tessellation.vertices.tolist()


def _solid_tess(path: Path) -> Any:
    return Specimen.from_tess_solid(path).cells.vertices.tolist()


def _map(path: Path, **options: Any) -> Any:
    found = ebsd.grains(ebsd.read(path), **options)
    return found.labels.tolist(), found.minerals, found.names, found.counts


def _picture(path: Path) -> Any:
    return picture.read(path).labels.tolist()


#: What reads each file; two readings of the same content are equal.
READERS: dict[str, Callable[[Path], Any]] = {
    **dict.fromkeys(("a.tess", "s.tess"), _tess),
    **dict.fromkeys(("b.tess", "c.tess"), _solid_tess),
    **dict.fromkeys(("a.tesr", "b.tesr"), lambda path: tesr.read(path).tolist()),
    **dict.fromkeys(("a.ctf", "h.ctf", "a.ang"), _map),
    "h.ang": lambda path: _map(path, unindexed="hole"),
    "a.geojson": geojson.read,
    "joints.csv": lines.read,
    "discs.csv": plane_files.read,
    "polygons.dat": lambda path: dfnworks.read(path, "bedding", (0.0, 0.0, 0.0)),
    "discs.toml": lambda path: DiscNetwork.read(path).planes(Box((0, 0, 0), (0.01, 0.01, 0.02))),
    "history.csv": lambda path: history_of(path, None, "N"),
    "spheres.txt": lambda path: sphere_rows(path).tolist(),
    "network.toml": _network,
    "material.toml": _material,
    "study.toml": lambda path: [job.key for job in study.read(path).jobs],
    "calibration.toml": lambda path: calibration_problem.read(path).targets,
    "rock.toml": rock.read,
    "phases.toml": _phases,
    **dict.fromkeys(BYTES, _picture),
    "b.tesr": lambda path: tesr.read(path).tolist(),
}
