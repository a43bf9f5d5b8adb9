# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens cut by fracture networks: what is cut, files, the command, repeats and studies."""

import json
import math

import pytest
from cut_specimens import HEIGHT, LAW, WIDTH, require_lengths, require_pieces
from refusals import refusal, refused_command

from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.renamed import current
from flexpm.specimens.files.source import SpecimenSource
from flexpm.specimens.spec import SpecimenSpec
from flexpm.specimens.specimen import Specimen
from flexpm.studies import jobs

TOML = """
seed = 3

[set.weak]
intensity = 120.0
length = { law = "power", exponent = 2.5, smallest = 0.005, largest = 0.02 }
orientation = { law = "von-mises", angle = 50.0, concentration = 20.0 }
"""
#: Shapes and their sizes, by which they are packed.
SHAPES = {
    "rectangle": {"width": WIDTH, "height": HEIGHT},
    "disc": {"diameter": 0.03},
    "half-disc": {"diameter": 0.04},
}
SIZES = ["--width", str(WIDTH), "--height", str(HEIGHT), "--quiet"]
SHORT = ["--max-strain", "1e-5", "--rate", "16"]


@pytest.fixture(scope="module")
def rectangle():
    return Specimen.rectangle(WIDTH, HEIGHT, 0.08)


@pytest.fixture
def file(tmp_path):
    found = tmp_path / "network.toml"
    found.write_text(TOML)
    return found


@pytest.mark.parametrize("kind", SHAPES)
def test_what_is_cut(kind, file, tmp_path):
    """Inputs are known before anything is packed; files read back, and all that is drawn adds up.

    Cuts of a disc lie on the chords of its cells, not on its circle.
    """
    spec = SpecimenSpec(kind, thickness=0.08, **SHAPES[kind])
    whole = Specimen.pack(spec)
    for seed in range(1, 11):
        cut = whole.with_network(file, seed)
        assert SpecimenSource.read(spec, network=file, network_seed=seed).spec == cut.spec
        if kind == "rectangle":
            require_pieces(cut, whole)
        require_lengths(cut)
        found = cut.network_intensities()["weak"]
        area = cut.tessellation.cell_areas.sum()
        ends, lines = cut.joint_lines()[0], cut.joint_cuts["weak"]
        assert found["target"] == 120.0
        assert found["generated"] == pytest.approx((lines.length - lines.outside) / area)
        made = math.fsum(math.dist(*one) for one in ends.tolist())
        assert found["cut"] == pytest.approx(made / area)
        # contacts bend to the grains, and go on to the edge of the one in which a trace ends
        more = (lines.lines - lines.idle) * whole.mean_diameter
        assert lines.cut < made < lines.cut + more
        cut.save(tmp_path / "cut.json")
        again = Specimen.load(tmp_path / "cut.json")
        assert again.spec == cut.spec
        assert again.network_intensities() == cut.network_intensities()


def test_a_network_joins_other_joints(rectangle, file, tmp_path):
    table = tmp_path / "joints.csv"
    table.write_text("x1,y1,x2,y2,name\n0,0.01,0.02,0.03,fault\n")
    fault = rectangle.joints_from_csv(table)
    assert fault.spec == rectangle.with_joints({"fault": [(0, 0.01), (0.02, 0.03)]}).spec
    both = fault.with_network(file)
    assert both.spec.joint_names == ("fault", "weak")
    assert both.spec == SpecimenSource.read(rectangle.spec, None, table, file).spec
    fault.save(tmp_path / "fault.json")
    assert both.spec == SpecimenSource.read(None, tmp_path / "fault.json", network=file).spec
    refusal(
        "set weak: name = weak, is the name of a joint of the specimen", both.with_network, file
    )
    with pytest.raises(InputError, match="is the name of a set of the network"):
        both.with_joints({"weak": [(0.0, 0.01), (0.01, 0.02)]})
    assert [*both.network_intensities()] == ["weak"]


def test_the_command_draws_a_network(file, tmp_path, capsys):
    out = tmp_path / "out"
    assert cli.main(["specimen", "disc", "--quiet", "--network", str(file), "--out", str(out)]) == 0
    assert "joint weak: P21 target, generated, cut" in capsys.readouterr().out
    found = json.loads((out / "specimen.json").read_text())["networks"]["weak"]
    assert found["target"] == 120.0
    assert found["cut"] == pytest.approx(found["generated"], rel=0.25)
    assert (out / "network.png").stat().st_size > 10000


def test_a_run_tells_its_network_and_repeats(file, rectangle, tmp_path, capsys):
    law = [word for one in LAW.split() for word in ("--set", one)]
    out = tmp_path / "out"
    call = ["run", "uniaxial", "--model", "rigid", *SIZES, *SHORT, *law, "--network", str(file)]
    assert cli.main([*call, "--network-seed", "8", "--out", str(out)]) == 3  # no peak
    found = json.loads((out / "result.json").read_text())
    cut = rectangle.with_network(file, 8)
    assert current(found)["networks"] == cut.network_intensities()
    inputs = found["inputs"]["specimen"]
    assert inputs["joints"] == cut.spec.joints
    assert inputs["networks"] == [*cut.spec.networks]
    assert inputs["networks"][0]["seed"] == 8
    assert (out / "network.png").stat().st_size > 10000
    page = (out / "report.html").read_text()
    assert "Fracture network, P21" in page
    assert "power, exponent 2.5, smallest 0.005, largest 0.02" in page
    capsys.readouterr()
    assert cli.main(["rerun", str(out), "--quiet", "--out", str(tmp_path / "again")]) == 3
    assert "the same as in" in capsys.readouterr().out


@pytest.mark.long
def test_packings_of_several_seeds_have_one_network(file, tmp_path):
    law = [word for one in LAW.split() for word in ("--set", one)]
    call = ["run", "uniaxial", "--model", "rigid", *SIZES, *SHORT, *law, "--network", str(file)]
    assert cli.main([*call, "--seeds", "1-2", "--no-report", "--out", str(tmp_path / "two")]) == 3
    for seed in (1, 2):
        result = json.loads((tmp_path / "two" / f"seed-{seed}" / "result.json").read_text())
        assert result["inputs"]["specimen"]["networks"][0]["seed"] == 3


def test_studies_have_networks_with_seeds_of_their_own(file, tmp_path):
    law = {f"set.{key}": float(value) for key, value in (one.split("=") for one in LAW.split())}
    given = {"test": "elastic", "width": WIDTH, "height": HEIGHT, **law, "network": file.name}
    first, second = (jobs.make({**given, "network-seed": n}, tmp_path) for n in (1, 2))
    assert first.key != second.key
    assert first.spec.specimen.networks[0]["seed"] == 1
    words = list(first.arguments)
    assert words[words.index("--network") + 1] == str(file)
    assert words[words.index("--network-seed") + 1] == "1"
    assert jobs.make(given, tmp_path).spec.specimen.networks[0]["seed"] == 3
    with pytest.raises(InputError, match="network_seed = 1, needs a network; give its file"):
        jobs.make({"test": "elastic", "network_seed": 1}, tmp_path)
    with pytest.raises(InputError, match="study network = 3, must be a text"):
        jobs.make({"test": "elastic", "network": 3}, tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("120.0", "1e7", "traces expected = .*, must be <= 20000"),
        ("120.0", "inf", "intensity = inf 1/m, must be finite"),
        ("0.005", "0.05", "smallest = 0.05 m, must be < largest = 0.02 m"),
        ("2.5", "1.5", "exponent = 1.5, must be > 2"),
        ("120.0", "1e-6", "traces in the specimen = 0"),
        ("[set.weak]", "[set.'a b']", "must be a name without spaces"),
        ("seed = 3", "seed = -3", "network seed = -3, must be >= 0"),
        ("seed = 3", "seed =", "is not a valid TOML file"),
    ],
)
def test_the_command_refuses_in_one_line(file, tmp_path, capsys, old, new, message):
    file.write_text(TOML.replace(old, new))
    out = tmp_path / "out"
    call = ["specimen", "rectangle", *SIZES, "--network", str(file), "--out", str(out)]
    refused_command(capsys, message, *call)


def test_a_seed_without_a_network_is_refused(tmp_path, capsys):
    call = ["specimen", "disc", "--network-seed", "2", "--out", str(tmp_path / "out")]
    refused_command(capsys, "network_seed = 2, needs a network; give its file", *call)


def test_a_set_that_cuts_nothing_reads_back(rectangle, tmp_path):
    """A trace within a grain is kept, and a set without a trace has no joint."""
    lines = {"short": [(0.0101, 0.02), (0.0103, 0.02)], "weak": [(0.0, 0.01), (0.02, 0.03)]}
    cut = rectangle.with_joints(lines)
    assert cut.joint_cuts["short"].cut == 0.0
    cut.save(tmp_path / "cut.json")
    assert Specimen.load(tmp_path / "cut.json").joint_cuts == cut.joint_cuts
    one = {
        "intensity": 120.0,
        "length": {"law": "constant", "value": 0.01},
        "orientation": {"law": "constant", "angle": 45.0},
    }
    cut = rectangle.with_network({"set": {"weak": one, "rare": {**one, "intensity": 1e-6}}})
    assert cut.network_intensities()["rare"] == {"target": 1e-6, "generated": 0.0, "cut": 0.0}
    cut.save(tmp_path / "cut.json")
    assert Specimen.load(tmp_path / "cut.json").spec == cut.spec
