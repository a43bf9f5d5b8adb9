# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documentation shows runs: its commands, and its listings in Python."""

import json
import re
import shlex
import textwrap
from pathlib import Path

import pytest
import result_schema_file

import flexpm
from flexpm.cli import main as cli
from flexpm.materials import load

ROOT = Path(__file__).resolve().parents[3]
DOC = ROOT / "doc"
PAGES = (ROOT / "README.md", *sorted(DOC.rglob("*.rst")))
#: Commands of hours, and such that need another program: test_docs.py has them parsed.
NOT_RUN = ("calibrate", "scorecard", "study", "bench")


def shown_commands():
    """Commands of flexpm that the pages show and that take less than about a minute."""
    found = {}
    for page in PAGES:
        text = page.read_text().replace("\\\n", " ")
        for line in re.findall(r"^ {4}(?:scripts/)?flexpm (.*)$", text, re.MULTILINE):
            command = line.partition("#")[0].strip()
            known = not re.search(r"\b[A-Z]{3,}\b|\.\.\.", command)
            if known and not command.startswith(NOT_RUN):
                found[command] = command
    return list(found)


def is_quick(command):
    """Whether a command takes seconds: it has a small specimen, or does not run a test."""
    return "--width 0.02" in command or command.split()[0] in ("elastic", "specimen", "doctor")


def printed(page, capsys):
    """Whether the page shows the line that its listing has printed."""
    return f"It prints ``{capsys.readouterr().out.strip()}``" in (ROOT / page).read_text()


def code_after(page, words):
    """The listing below the words of a page."""
    text = (ROOT / page).read_text()
    below = text[text.index(words) + len(words) :]
    lines = below.split("\n")[1:]
    end = next(n for n, line in enumerate(lines) if line.strip() and not line.startswith("    "))
    return textwrap.dedent("\n".join(lines[:end]))


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(one, marks=pytest.mark.long if is_quick(one) else pytest.mark.slow)
        for one in shown_commands()
    ],
)
def test_commands_of_the_pages_run(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name, *arguments = shlex.split(command)
    if name == "rerun":  # of the run that the page has before it
        size = ["--width", "0.02", "--height", "0.04", "--quiet"]
        assert cli.main(["run", "uniaxial", *size, "--out", "granite"]) == 0
    if "my-rock-start.toml" in arguments:  # of the command that the page has before it
        rock = str(ROOT / "scripts/tutorials/sandstone.toml")
        assert cli.main(["calibrate", "--new", rock, "--out", "my-rock.toml"]) == 0
    quiet = ["--quiet"] if name in ("run", "rerun", "compare", "elastic") else []
    assert cli.main([name, *arguments, *quiet]) == 0
    if "--out" in arguments:
        assert any(Path(arguments[arguments.index("--out") + 1]).iterdir())


@pytest.mark.long
def test_the_listing_of_the_first_tutorial(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    scope = {}
    exec(code_after("doc/tutorials/first_test.rst", "is a quarter of the paper's::"), scope)
    said = capsys.readouterr().out
    page = (DOC / "tutorials/first_test.rst").read_text()
    assert textwrap.indent(said, "    ") in page
    solved, tested = map(float, re.findall(r"E = ([\d.]+) GPa", said))
    assert tested == pytest.approx(solved, rel=0.02)
    assert "status ok" in said
    assert len(scope["strain"]) == len(scope["stress"]) > 100
    assert (tmp_path / "granite-quarter" / "report.html").is_file()


def test_the_listings_of_the_page_on_specimens():
    scope = {}
    exec(code_after("doc/specimens.rst", "makes a notched beam::"), scope)
    assert len(scope["beam"].discs) > 20
    exec(code_after("doc/specimens.rst", "makes a wall of three bricks::"), scope)
    assert len(scope["wall"].discs) == 3
    scope["specimen"] = flexpm.Specimen.rectangle(0.02, 0.04, 0.01)
    exec(code_after("doc/joints.rst", ':doc:`materials`, "Joints"). In Python::'), scope)
    assert len(scope["cut"].discs) > len(scope["specimen"].discs)
    assert {0, 1} <= set(scope["cut"].edge_joints)


@pytest.mark.parametrize(
    ("page", "words"),
    [
        ("doc/csv_tables.rst", "counts the cracks up to the peak::"),
        ("doc/result_json.rst", "the test does not define::"),
    ],
)
@pytest.mark.long
def test_the_listings_that_read_a_run(page, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    command = re.search(r"After ``flexpm (run [^`]+)``", (ROOT / page).read_text())[1]
    assert cli.main([*command.split(), "--quiet"]) == 0
    capsys.readouterr()
    exec(code_after(page, words), {})
    assert printed(page, capsys)


@pytest.mark.parametrize(
    ("page", "words"),
    [
        ("doc/specimen_files.rst", "reads the same grains from it::"),
        ("doc/polyhedra.rst", "a small box and counts them::"),
        ("doc/theory.rst", 'work of the boundary ("Energy")::'),
        ("doc/control.rst", "which must be below 0.001::"),
        ("doc/deviations.rst", "determine its grains and contacts::"),
    ],
)
def test_the_listings_that_make_a_specimen(page, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    exec(code_after(page, words), {})
    assert printed(page, capsys)


def shown_output(page):
    """The first command of a page of which the output is shown, and this output as a pattern."""
    text = (ROOT / page).read_text()
    command, below = re.search(
        r"^    flexpm (.*)\n\nThe command prints((?:.*\n)+)", text, re.M
    ).groups()
    block = re.search(r"::(?: none)?\n\n((?:    .*\n)+)", below)[1]
    lines = [line for line in textwrap.dedent(block).splitlines() if not line.startswith("about ")]
    pattern = re.escape("\n".join(lines)).replace(r"\.\.\.", r"[\s\S]*").replace(r"\*", ".*")
    return shlex.split(command), pattern


@pytest.mark.parametrize("page", ["doc/choosing.rst", "doc/loading.rst", "doc/yade_models.rst"])
@pytest.mark.long
def test_commands_print_what_the_pages_show(page, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    command, pattern = shown_output(page)
    assert cli.main([*command, "--quiet"]) == 0
    said = "\n".join(line.rstrip() for line in capsys.readouterr().out.splitlines())
    assert re.fullmatch(pattern, said), said


def test_the_listing_of_solids_in_the_scene(capsys):
    from yade import O  # after flexpm, which finds it

    O.reset()
    words = "rejects such a scene::"
    exec(code_after("doc/yade_interoperability.rst", words), {"flexpm": flexpm, "O": O})
    assert capsys.readouterr().out.startswith("Vector3(")


def test_the_listing_of_held_nodes():
    scope = {"flexpm": flexpm}
    exec(code_after("doc/rig_parts.rst", "rotated until it breaks::"), scope)
    load = scope["rig"].record["load"]
    assert load[-1] <= 0.5 * load.max()


@pytest.mark.long
def test_the_listing_of_the_page_on_comparisons(monkeypatch):
    scope = {"flexpm": flexpm, "specimen": flexpm.Specimen.rectangle(0.012, 0.024, 0.01)}
    compare = flexpm.compare
    monkeypatch.setattr(flexpm, "compare", lambda *given, **more: compare(*given, rate=6.0, **more))
    exec(code_after("doc/compare.rst", "In Python::"), scope)
    assert len(scope["found"].cases) == 6
    assert scope["found"].envelopes[0].mohr_coulomb.friction_angle > 0.0


@pytest.mark.long
def test_the_listing_of_the_page_on_the_schema(tmp_path, monkeypatch):
    pytest.importorskip("jsonschema", reason="needs python3-jsonschema")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "result.schema.json").write_text(json.dumps(result_schema_file.schema()))
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    flexpm.run("tension", specimen, out="granite", max_strain=2e-5)
    text = (DOC / "schema.rst").read_text()
    exec(textwrap.dedent(re.search(r"::\n\n((?:    .*\n|\n)+)", text)[1]), {})


def test_the_joints_of_the_page_on_materials_are_laws(tmp_path):
    tables = code_after("doc/materials.rst", "[joint.NAME]``:\n\n.. code-block:: toml\n")
    preset = (ROOT / "py/flexpm/materials/presets/augig-table7.toml").read_text()
    (tmp_path / "rock.toml").write_text(preset + tables)
    assert [one.name for one in load(str(tmp_path / "rock.toml"), "flexible").joints] == [
        "bedding",
        "notch",
    ]
