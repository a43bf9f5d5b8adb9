# SPDX-License-Identifier: GPL-3.0-or-later
"""Command lines of any words: the documented exit codes, and one line for each end but 0."""

from __future__ import annotations

import click
import pytest
from fuzz_child import Child, drawing
from hypothesis import given
from hypothesis import strategies as st

NUMBERS = st.sampled_from(
    ["0", "1", "2", "-1", "1e-9", "0.5", "1e9", "1e-400", "nan", "inf", "0x1", "٣", "1,2", "", "a"]
)
WORDS = st.sampled_from(
    """uniaxial tension biaxial triaxial brazilian flexible rigid inner jcfpm static adaptive
    constant waiting box cylinder solid-disc solid-half-disc p s
    axial lateral displacement cmod gif augig-table7 augig-table2-brittle
    nofile.toml material.toml phases.toml network.toml joints.csv a.geojson grains.json solid.json
    discs.csv discs.toml polygons.dat
    grey.png volume.npy uint8 grains phases exact um""".split()
)
TEXTS = st.text(st.characters(blacklist_categories=["Cs"], blacklist_characters="\0"), max_size=6)
KEYS = st.sampled_from(
    """young cohesion friction softening normal_stiffness quartz.x joint.j.friction interface.a.b
    joint.fault.open joint.bed-1.open quartz.cohesion
    residual_friction slip_length joint.j.residual_friction interface.a/b.slip_length
    interface.quartz/biotite.cohesion interface.a/b.factor.friction""".split()
)
VALUED = """--rate --max-strain --stop-ratio --confinement --threads --seed --porosity
    --thickness --depth --origin --diameters --points --gravity --diameter --length --span --notch
    --distance --normal-stress --second-confinement --end-friction --jaw-radius
    --max-displacement --network-seed --seeds --frames --workers --damping
    --interaction-range --pixel --edge --smallest
    --halvings --misorientation --scale --short-edge --confinements
    --voxel --counts --coarsen --least-voxels --crop""".split()
FLAGS = ["--dynamic", "--discard-checkpoint", "--no-report", "--help", "--nothing", "--watershed"]
NAMED = """--model --material --mesh --start --loading --wave --sides --control --film --specimen
    --joints --joint --minerals --name --network --phases --shape
    --models --unindexed --size --rock
    --array --dtype --minerals-array --minerals-dtype --labels --unit --volumes --new""".split()
#: Options that are given below, or that lead to other files, long work or other machines.
NOT_DRAWN = """--width --height --out --quiet --steps --scaling --large --json --scheduler
    --cluster --version""".split()
OPTIONS = st.one_of(
    st.tuples(st.sampled_from(VALUED), NUMBERS | TEXTS),
    st.tuples(st.sampled_from(NAMED), WORDS),
    st.tuples(st.just("--set"), st.builds("{}={}".format, KEYS, NUMBERS | WORDS)),
    st.tuples(st.sampled_from(FLAGS)),
    st.tuples(TEXTS),
)
#: Images and maps that are there.
IMAGES = ("colours.png", "grey.png", "palette.png", "lzw.tif", "labels.npy", "a.tesr", "b.tesr")
SETS_OPEN = ("--set", "joint.bedding.open=true", "--set", "joint.steep.open=true")
#: Files of a run in 3D.
READ_3D = (
    ("--joints", "discs.csv", "--set", "joint.bedding.open=true"),
    ("--network", "discs.toml", *SETS_OPEN),
    ("--joints", "polygons.dat", "--joint", "bedding", "--set", "joint.bedding.open=true"),
)
#: Files of a run in 2D.
READ_2D = (
    ("--specimen", "grains.json"),
    ("--joints", "joints.csv", "--material", "material.toml", "--set", "joint.bed-1.open=true"),
    ("--joints", "a.geojson", "--set", "joint.a.open=true"),
    ("--network", "network.toml", *SETS_OPEN),
)
COMMANDS = st.sampled_from(
    [
        *(("run", test) for test in ("uniaxial", "tension", "biaxial", "brazilian")),
        *(("run", test) for test in ("bending", "scb", "shear", "punch", "sonic")),
        *(
            ("run", test, "--shape", "box")
            for test in ("uniaxial", "tension", "biaxial", "triaxial", "sonic")
        ),
        *(("run", test, "--shape", "cylinder") for test in ("uniaxial", "tension", "sonic")),
        ("run", "triaxial"),
        ("run", "brazilian", "--shape", "solid-disc"),
        ("run", "bending", "--shape", "box"),
        ("run", "scb", "--shape", "solid-half-disc"),
        ("run", "shear", "--shape", "box"),
        ("run", "punch", "--shape", "box"),
        *(("specimen", shape) for shape in ("rectangle", "disc", "box", "cylinder")),
        *(("specimen", shape) for shape in ("solid-disc", "solid-half-disc")),
        *(("specimen", "image", file, "--pixel", "1e-4") for file in ("nofile.toml", "no.npy")),
        *(("specimen", kind, f"no.{end}") for kind, end in (("ebsd", "ctf"), ("tess", "tess"))),
        *(("specimen", "image", f"{name}", "--pixel", "1e-4") for name in IMAGES),
        *(("specimen", "ebsd", name) for name in ("a.ctf", "h.ctf", "a.ang", "h.ang")),
        *(("specimen", "tess", name) for name in ("a.tess", "b.tess", "c.tess", "s.tess")),
        ("specimen", "volume", "volume.npy", "--voxel", "1e-3"),
        ("specimen", "table", "grains.csv"),
        *(("run", test, *file) for test in ("uniaxial", "bending") for file in READ_2D),
        *(("run", "uniaxial", "--shape", "box", *file) for file in READ_3D),
        *(("specimen", "box", *file[: file.index("--set")]) for file in READ_3D),
        *(("run", test, "--specimen", "solid.json") for test in ("uniaxial", "triaxial", "shear")),
        *((name, "nofile.toml") for name in ("study", "calibrate", "scorecard", "rerun", "report")),
        *(("compare", "uniaxial"), ("compare", "bending"), ("elastic",), ("bench",), ("run",), ()),
        ("bench", "--shape", "box"),
        ("elastic", "--shape", "cylinder"),
        ("compare", "brazilian", "--shape", "solid-disc"),
    ]
)
#: A small specimen and few steps, so that what is right soon ends.
RECTANGLE = ["--width", "0.012", "--height", "0.016"]
BOX = ["--width", "0.009", "--depth", "0.009", "--height", "0.012"]
CORE = ["--diameter", "0.009", "--height", "0.012"]
DISC = ["--diameter", "0.012", "--depth", "0.008"]
LONG = ["--height", "0.16", "--diameters", "2.8e-3,3.2e-3", "--model", "rigid"]
BEAM = ["--length", "0.03", "--height", "0.008"]
FEW = ["--max-strain", "1e-5", "--rate", "50"]
NEXT = ["--max-displacement", "1e-8", "--rate", "50"]
SIZES = {
    "run uniaxial --shape box": [*BOX, *FEW],
    "run tension --shape box": [*BOX, *FEW],
    "run biaxial --shape box": [*BOX, *FEW],
    "run triaxial --shape box": [*BOX, *FEW],
    "run sonic --shape box": ["--width", "0.0066", "--depth", "0.0066", *LONG],
    "run uniaxial --shape cylinder": [*CORE, *FEW],
    "run tension --shape cylinder": [*CORE, *FEW],
    "run sonic --shape cylinder": ["--diameter", "0.007", *LONG],
    "run triaxial": [*CORE, *FEW],
    "run brazilian --shape solid-disc": [*DISC, *FEW],
    "specimen cylinder": [*CORE, "--out", "made"],
    "specimen solid-disc": [*DISC, "--out", "made"],
    "specimen solid-half-disc": ["--diameter", "0.024", "--depth", "0.008", "--out", "made"],
    "elastic --shape cylinder": CORE,
    "compare brazilian --shape solid-disc": [*DISC, *FEW],
    "run brazilian": ["--diameter", "0.012", *FEW],
    "run bending": [*BEAM, *FEW],
    "run bending --shape box": [*BEAM, "--depth", "0.008", *FEW],
    "run scb": ["--diameter", "0.024", *FEW],
    "run scb --shape solid-half-disc": ["--diameter", "0.024", "--depth", "0.008", *FEW],
    "run shear": [*RECTANGLE, *NEXT],
    "run shear --shape box": [*BOX, *NEXT],
    "run punch --shape box": ["--width", "0.03", "--height", "0.024", "--depth", "0.008", *NEXT],
    "run punch": ["--width", "0.03", "--height", "0.024", "--max-displacement", "1e-8"],
    "run sonic": RECTANGLE,
    "run": [*RECTANGLE, *FEW],
    "elastic": RECTANGLE,
    "specimen": ["--out", "made"],
    "specimen table grains.csv": [*BOX, "--out", "made"],
    "specimen volume volume.npy --voxel 1e-3": ["--out", "made"],
    "specimen box": [*RECTANGLE, "--depth", "0.012", "--out", "made"],
    "compare bending": [*BEAM, *FEW],
    "compare": [*RECTANGLE, *FEW],
    "bench --shape box": [*BOX, "--steps", "2"],
    "bench": [*RECTANGLE, "--steps", "2"],
}


@pytest.fixture(scope="module")
def child():
    one = Child("command")
    yield one
    one.close()


def options_of(command):
    """Options of a command and of all below it."""
    for below in getattr(command, "commands", {}).values():
        yield from options_of(below)
    for one in command.params:
        if isinstance(one, click.Option):
            yield from (name for name in one.opts if name.startswith("--"))


def test_every_option_is_drawn():
    from flexpm.cli.main import command

    drawn = {*VALUED, *FLAGS, *NAMED, "--set"}
    assert drawn.isdisjoint(NOT_DRAWN)
    assert set(options_of(command)) == {*drawn, *NOT_DRAWN} - {"--help", "--nothing"}


@pytest.mark.long
@given(COMMANDS, st.lists(OPTIONS, max_size=4))
@drawing(100)
def test_any_command_line_ends_as_documented(child, command, options):
    if "--specimen" in command:
        sizes = NEXT if command[1] == "shear" else FEW
    elif command[:2] == ("run", "bending"):
        sizes = SIZES["run bending"]
    else:
        sizes = SIZES.get(" ".join(command)) or SIZES.get(command[0] if command else "", [])
    words = [*command, *sizes]
    code, told, left = child.run([*words, *(word for option in options for word in option)])
    # a slow machine shows its progress
    lines = told.splitlines(keepends=True)
    errors = "".join(line for line in lines if not line.startswith("progress "))
    assert code in (0, 2, 3), errors
    assert errors.count("\n") == (code != 0), errors
    assert not code or errors.startswith("flexpm: ")
    assert "internal error" not in errors
    assert not left or set(left) <= {"flexpm-out", "made"}
