# SPDX-License-Identifier: GPL-3.0-or-later
"""The documentation names what exists: functions, tests, files' columns and arrays, deviations."""

import functools
import html
import inspect
import json
import re
import shlex
import shutil
import sys
import textwrap
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sample_snapshot import wall

import flexpm
import flexpm._api
from flexpm import __version__, _flexpm
from flexpm._plugin import load
from flexpm.cli import main
from flexpm.kinds.registry import KINDS
from flexpm.materials.material import preset_names
from flexpm.results.cracks import Crack
from flexpm.results.record import COLUMNS
from flexpm.results.result import Result
from flexpm.results.vtu import cell_arrays, point_arrays

ROOT = Path(__file__).resolve().parents[3]
DOC = ROOT / "doc"


@functools.cache
def text_of(*folders, suffixes):
    files = (file for folder in folders for file in (ROOT / folder).rglob("*"))
    return "\n".join(file.read_text() for file in files if file.suffix in suffixes)


def literals(text):
    return set(re.findall(r"``([^`]+)``", text))


def theory_table():
    """Functions and tests named in the table that leads from equation to test."""
    table = (DOC / "theory.rst").read_text().split("   Paper | ")[1].split("Grains\n---")[0]
    names = literals(table)
    tests = {name for name in names if name.startswith("test_")}
    return names - tests, tests


def test_functions_and_tests_of_the_theory_exist():
    functions, tests = theory_table()
    assert len(functions) > 10
    assert len(tests) > 5
    code = text_of("pkg", "py", suffixes=(".cpp", ".hpp", ".py"))
    assert {name for name in functions if not re.search(rf"\b{name}\(", code)} == set()
    found = {file.name for file in (ROOT / "tests").rglob("test_*")}
    assert tests - found == set()


@pytest.mark.parametrize("page", ["architecture", "contributing", "layout"])
def test_what_pages_on_the_sources_name_exists(page):
    """Names of functions, types, members and files, the placeholder ``NAME`` apart."""
    code = text_of("pkg", "py", "tests/kernel", suffixes=(".cpp", ".hpp", ".py"))
    files = {
        str(file)
        for top in ("pkg", "py", "tests", "scripts", "doc")
        for file in (ROOT / top).rglob("*")
    }
    named = literals((DOC / f"{page}.rst").read_text())
    assert len(named) > 20
    words = {name.removesuffix("()") for name in named}
    words = {re.split(r"\.|::", name)[-1] for name in words if re.fullmatch(r"[\w.:]+", name)}
    paths = {name for name in named if re.fullmatch(r"[\w./]+\.(hpp|cpp|py|toml|txt)", name)}
    absent = {name for name in paths if not any(one.endswith(f"/{name}") for one in files)}
    assert absent - {"py/flexpm/kinds/tests/NAME.py"} == set()
    words -= {name.rpartition(".")[2] for name in paths} | {"cff"}
    assert {name for name in words if not re.search(rf"\b{name}\b", code)} == set()


#: Folders of the tree, of which a page names a file by its path.
TOPS = ("pkg/", "py/", "tests/", "scripts/", "doc/", "cmake/", ".ci/")


def absent(text):
    """Paths of files and folders that a page names and the tree does not have."""
    named = {name.split()[0] for name in literals(text) if name.startswith(TOPS)}
    return {name for name in named if "NAME" not in name and not any(ROOT.glob(name))}


@pytest.mark.parametrize(
    "page", [str(page.relative_to(DOC)) for page in sorted(DOC.rglob("*.rst"))]
)
def test_files_that_pages_name_exist(page):
    assert absent((DOC / page).read_text()) == set()


def test_each_test_has_its_page():
    pages = {page.stem for page in (DOC / "tests").glob("*.rst")}
    assert pages == {*KINDS}
    index = (DOC / "tests.rst").read_text()
    assert {name for name in KINDS if f":doc:`tests/{name}`" not in index} == set()


def test_a_file_that_is_gone_is_found():
    text = "``scripts/checks/gone.py --now``, ``scripts/setup``, ``tests/NAME.py``, ``gone.py``"
    assert absent(text) == {"scripts/checks/gone.py"}


def test_every_deviation_in_the_code_is_in_the_document():
    code = text_of("pkg", "py", suffixes=(".cpp", ".hpp", ".py"))
    cited = set(re.findall(r"Deviations? (D\d+)", code))
    numbered = re.findall(r"^(D\d+), ", (DOC / "deviations.rst").read_text(), re.MULTILINE)
    assert numbered == sorted(set(numbered), key=lambda name: int(name[1:]))
    assert cited
    assert cited - set(numbered) == set()


def test_arrays_and_columns_of_the_files_are_documented():
    pages = ("result_json", "csv_tables", "vtu_files")
    documented = literals("".join((DOC / f"{page}.rst").read_text() for page in pages))
    arrays = {**point_arrays(wall()), **cell_arrays(jointed_wall())}
    assert set(arrays) - documented == set()
    assert set(COLUMNS) - documented == set()
    assert set(Crack._fields) - documented == set()
    result = Result("", "", "", "", {}, 1, 1, 1, 1, 1)
    assert set(result.as_dict()) - documented == set()


def jointed_wall():
    """A state with all arrays that a file may have."""
    state = wall()
    return replace(state, contact_joint=np.full(len(state.contact), -1), joint_names=("a",))


def test_documented_arrays_exist():
    tables = (DOC / "vtu_files.rst").read_text().split("Arrays over points")[1]
    tables = tables.split("\nArrays in 3D\n")[0]
    named = set(re.findall(r"^   (``.*``) \|", tables, re.MULTILINE))
    documented = literals("\n".join(named))
    arrays = {**point_arrays(wall()), **cell_arrays(jointed_wall())}
    assert documented == set(arrays)


@pytest.mark.long
def test_the_documentation_builds_without_warnings(tmp_path):
    build = pytest.importorskip("sphinx.cmd.build", reason="needs python3-sphinx")
    if shutil.which("dot") is None:
        pytest.skip("needs graphviz")
    path = list(sys.path)
    try:
        assert build.main(["-W", "-q", "-b", "html", str(DOC), str(tmp_path)]) == 0
    finally:
        sys.path[:] = path
    assert (tmp_path / "theory.html").stat().st_size > 5000
    presets = (tmp_path / "materials.html").read_text()
    assert presets.count("normal_stiffness") >= len(preset_names())
    words = json.loads((tmp_path / "searchindex.js").read_text()[len("Search.setIndex(") : -1])
    found = {words["docnames"][number] for number in words["titleterms"]["3d"]}
    assert {"solids", "availability"} <= found
    gallery = (tmp_path / "gallery.html").read_text()
    linked = set(re.findall(r'href="_downloads/\w+/(\w+)\.py"', gallery))
    assert {"first_test", "first_core", "window", "solid_gallery"} <= linked
    reference = html.unescape((tmp_path / "reference" / "yade.html").read_text())
    described = re.findall(r"<dt class=.*?</dt>\s*<dd>(.*?)</dd>", reference, re.DOTALL)
    texts = [re.sub(r"<[^>]+>", "", text).strip() for text in described]
    assert len(texts) > 100
    assert all(texts)
    assert [
        text for text in texts if text.startswith((")", "Common", "Default", "Read only"))
    ] == []
    assert "Values of both ends of the scale [Pa]" in reference


def test_the_version_is_the_same_everywhere():
    assert f"\nversion: {__version__}\n" in (ROOT / "CITATION.cff").read_text()
    assert _flexpm.build_info["version"] == __version__
    cut = re.findall(r"^## \[?(\d[\d.]*)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert cut[:1] == [__version__.removesuffix(".dev")]


def test_each_class_of_the_plugin_has_its_place_in_the_reference():
    named = re.findall(r"yade-class:: (\w+)", (DOC / "reference" / "yade.rst").read_text())
    assert sorted(named) == sorted(load())


def shown_commands():
    """Commands of flexpm that the pages show, without those that have placeholders."""
    found = {}
    for page in (ROOT / "README.md", *sorted(DOC.rglob("*.rst"))):
        text = page.read_text().replace("\\\n", " ")
        for line in re.findall(r"^ {4}(?:scripts/)?flexpm (.*)$", text, re.MULTILINE):
            command = line.partition("#")[0].strip()
            if not re.search(r"\b[A-Z]{3,}\b|\.\.\.", command):
                found[command] = page.name
    return found


@pytest.mark.parametrize("command", shown_commands())
def test_commands_of_the_pages_are_understood(command):
    name, *arguments = shlex.split(command)
    known = main.command.commands[name]
    if name == "specimen":
        name, *arguments = arguments
        known = known.commands[name]
    with known.make_context(name, arguments) as context:
        assert context.args == []


def test_the_first_page_shows_what_runs():
    """Its example in Python prints a stress below that of the strain before the unloading."""
    text = (DOC / "index.rst").read_text()
    example = text.partition("keeps the record::\n")[2].partition("\nContinue")[0]
    scope = {}
    exec(textwrap.dedent(example), scope)
    assert 0.0 < scope["rig"].stress < 3e7
    assert scope["rig"].record["axial_stress"].max() > 1.5 * scope["rig"].stress


def public_names():
    """Public names of the package, of its modules and of their classes, each with what it is."""
    for name in sorted({*flexpm._api.__all__}):
        one = getattr(flexpm, name)
        yield name, one
        own = inspect.ismodule(one) or inspect.isclass(one)
        for part, value in vars(one).items() if own else ():
            home = getattr(value, "__module__", getattr(one, "__name__", ""))
            called = callable(value) or isinstance(value, (property, classmethod, staticmethod))
            elsewhere = inspect.ismodule(one) and home != one.__name__
            if called and not part.startswith("_") and not elsewhere:
                yield f"{name}.{part}", value


def test_every_public_name_has_its_docstring_and_its_place_in_the_reference():
    names = dict(public_names())
    assert len(names) > 50
    assert [name for name, one in names.items() if not inspect.getdoc(one)] == []
    reference = (DOC / "reference" / "python.rst").read_text()
    missing = [name for name in names if "." not in name and name not in reference]
    assert missing == []
