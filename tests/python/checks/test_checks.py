# SPDX-License-Identifier: GPL-3.0-or-later
"""The checks of the sources accept this tree and find each kind of violation in a broken one."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from processes import captured

ROOT = Path(__file__).resolve().parents[3]
CHECKS = ROOT / "scripts" / "checks"


def run(check: str, tree: Path) -> tuple[int, str]:
    command = [sys.executable, str(CHECKS / check), str(tree)]
    done = captured(command, timeout=600)
    return done.returncode, done.stdout


def write(path: Path, text: str) -> None:
    path.parent.mkdir(exist_ok=True)
    if path.suffix == ".cpp" and "kernel" in path.parts and "tests" not in path.parts:
        header = path.with_suffix(".hpp")
        header.touch()
        text = f"#include <{Path(*header.parts[header.parts.index('flexpm') :])}>\n{text}"
    path.write_text(text)


TABLE = """
[kernel.low]
uses = []
libraries = { "CGAL/" = "power_diagram.cpp", "Eigen/" = "*.cpp" }
[kernel.high]
uses = ["low"]
libraries = { "omp.h" = "*.cpp" }
[yade.abi]
uses = []
[yade.bindings]
uses = ["kernel"]
[yade.plugin]
uses = ["kernel.high", "abi", "bindings"]
[python.errors]
uses = []
[python.low]
uses = ["errors"]
[python.plot]
uses = ["low"]
libraries = { matplotlib = "*.py" }
[python.__init__]
uses = ["low", "plot"]
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    folders = ["kernel/low", "kernel/high", "yade/abi", "yade/bindings"]
    folders = [f"pkg/flexpm/{folder}" for folder in folders]
    folders += ["tests/kernel/low", "tests/kernel/support", "py/flexpm/low", "scripts/checks"]
    for folder in folders:
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "scripts/checks/layers.toml").write_text(TABLE)
    for file in ("__init__.py", "errors.py", "plot.py", "low/__init__.py", "low/a.py"):
        (tmp_path / "py/flexpm" / file).touch()
    return tmp_path


@pytest.mark.parametrize("check", ["layering.py", "kinds.py"])
def test_this_tree_passes(check: str) -> None:
    code, text = run(check, ROOT)
    assert code == 0, text


@pytest.mark.parametrize(
    ("name", "text", "complaint"),
    [
        ("pkg/flexpm/kernel/low/a.hpp", "#include <core/Scene.hpp>\n", "core/Scene.hpp"),
        ("pkg/flexpm/kernel/low/a.hpp", "#include <boost/python.hpp>\n", "boost/python.hpp"),
        ("pkg/flexpm/kernel/low/a.hpp", "#include <Eigen/Dense>\n", "only *.cpp"),
        ("pkg/flexpm/kernel/high/a.cpp", "#include <Eigen/Dense>\n", "the room's libraries"),
        ("pkg/flexpm/kernel/low/a.cpp", "#include <CGAL/Origin.h>\n", "only power_diagram.cpp"),
        ("pkg/flexpm/kernel/low/a.cpp", "#include <omp.h>\n", "the room's libraries"),
        ("pkg/flexpm/kernel/low/a.cpp", "void f()\n{\n#pragma omp parallel\n}\n", "OpenMP"),
        ("pkg/flexpm/kernel/low/a.cpp", "#include <iostream>\n", "iostream"),
        ("pkg/flexpm/kernel/low/a.cpp", "void f() { throw 1; }\n", "require.hpp"),
        ("pkg/flexpm/kernel/low/a.cpp", 'void f() { std::printf("x"); }\n', "prints"),
        ("pkg/flexpm/kernel/low/a.cpp", 'auto f() { return std::getenv("X"); }\n', "environment"),
        ("pkg/flexpm/kernel/low/a.hpp", "#include <flexpm/kernel/low/a.hpp>\n", "ring"),
        (
            "pkg/flexpm/kernel/low/a.cpp",
            "#include <flexpm/kernel/high/b.hpp>\n",
            "uses kernel.high; kernel.low may not",
        ),
        ("pkg/flexpm/kernel/a.hpp", "", "stands in no room"),
        ("pkg/flexpm/kernel/other/a.hpp", "", "stands in no room"),
        ("pkg/flexpm/yade/abi/A.cpp", "#include <core/Scene.hpp>\n", "yade_lite.hpp"),
        (
            "pkg/flexpm/yade/bindings/binding_a.cpp",
            "#include <flexpm/yade/abi/yade_lite.hpp>\n",
            "no YADE",
        ),
        ("pkg/flexpm/yade/abi/A.cpp", "yade::NewtonIntegrator* n;\n", "layout differs"),
        ("pkg/flexpm/yade/abi/A.cpp", "#include <Eigen/Dense>\n", "the kernel alone"),
        (
            "pkg/flexpm/yade/abi/a.hpp",
            "#include <flexpm/kernel/low/a.hpp>\n",
            "uses kernel.low; yade.abi may not",
        ),
        (
            "pkg/flexpm/yade/plugin.cpp",
            "#include <flexpm/kernel/low/a.hpp>\n",
            "uses kernel.low; yade.plugin may not",
        ),
        ("pkg/flexpm/yade/A.cpp", "", "stands in no room"),
        ("tests/kernel/low/test_a.cpp", "#include <core/Scene.hpp>\n", "Catch2"),
        ("tests/kernel/test_a.cpp", "", "the folders are the kernel's"),
        ("py/flexpm/low/b.py", "import matplotlib.pyplot\n", "only *.py of python.plot"),
        ("py/flexpm/low/b.py", "def f():\n    from yade import *\n", "all names of YADE"),
        ("py/flexpm/low/b.py", "from flexpm import plot\n", "uses python.plot"),
        ("py/flexpm/low/b.py", "def f():\n    import flexpm.plot\n", "uses python.plot"),
        ("py/flexpm/low/b.py", "from .. import plot\n", "uses python.plot"),
        ("py/flexpm/low/b.py", "from ..plot import figure\n", "uses python.plot"),
        ("py/flexpm/low/b.py", "from flexpm import run\n", "uses python.__init__"),
        ("py/flexpm/low/b.py", "x = import_module('flexpm.errors')\n", "hides an import"),
        ("py/flexpm/low/b.py", "x = importlib.import_module(name)\n", "hides an import"),
        ("py/flexpm/low/b.py", "x = __import__('flexpm')\n", "hides an import"),
        ("py/flexpm/other.py", "", "stands in no room"),
    ],
)
def test_violation_is_found(tree: Path, name: str, text: str, complaint: str) -> None:
    write(tree / name, text)
    code, output = run("layering.py", tree)
    assert code == 1 and complaint in output and name in output


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("pkg/flexpm/kernel/low/a.cpp", "#include <Eigen/Sparse>\n"),
        ("pkg/flexpm/kernel/low/power_diagram.cpp", "#include <CGAL/Origin.h>\n"),
        ("pkg/flexpm/kernel/high/a.cpp", "#include <omp.h>\n#pragma omp parallel\n"),
        ("pkg/flexpm/kernel/high/a.cpp", "#include <flexpm/kernel/low/a.hpp>\n"),
        ("pkg/flexpm/kernel/low/a.hpp", "// std::cout is not used\n#include <cmath>\n"),
        ("pkg/flexpm/yade/abi/A.cpp", "// placed after NewtonIntegrator\n"),
        ("pkg/flexpm/yade/abi/A.hpp", 'auto s = R"""(after :yref:`NewtonIntegrator`)""";\n'),
        ("pkg/flexpm/yade/bindings/a.cpp", "#include <flexpm/kernel/low/a.hpp>\n"),
        ("pkg/flexpm/yade/plugin.cpp", "#include <flexpm/kernel/high/a.hpp>\n"),
        ("tests/kernel/support/a.hpp", "#include <flexpm/kernel/high/a.hpp>\n"),
        ("py/flexpm/plot.py", "import matplotlib\nfrom flexpm.low import a\n"),
        ("py/flexpm/low/b.py", "from flexpm import errors\nfrom . import a\n"),
        ("py/flexpm/low/b.py", "x = importlib.import_module('yade')\n"),
    ],
)
def test_allowed_use_passes(tree: Path, name: str, text: str) -> None:
    write(tree / name, text)
    code, output = run("layering.py", tree)
    assert code == 0, output


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("[kernel.low]\nuses = []", '[kernel.low]\nuses = ["high"]', "kernel.high, kernel.low"),
        ('uses = ["low"]', 'uses = ["lower"]', "kernel.lower, which is no room"),
    ],
)
def test_fault_of_the_table_is_found(tree: Path, old: str, new: str, complaint: str) -> None:
    (tree / "scripts/checks/layers.toml").write_text(TABLE.replace(old, new, 1))
    code, output = run("layering.py", tree)
    assert code == 1 and complaint in output and "layers.toml" in output


def test_source_without_its_header_is_found(tree: Path) -> None:
    write(tree / "pkg/flexpm/kernel/low/a.cpp", "#include <cmath>\n")
    header = tree / "pkg/flexpm/kernel/low/a.hpp"
    assert run("layering.py", tree)[0] == 0
    header.unlink()
    code, output = run("layering.py", tree)
    assert code == 1 and "has no header flexpm/kernel/low/a.hpp" in output


def test_source_that_includes_its_header_late_is_found(tree: Path) -> None:
    source = tree / "pkg/flexpm/kernel/low/a.cpp"
    write(source, "")
    source.write_text("#include <cmath>\n" + source.read_text())
    code, output = run("layering.py", tree)
    assert code == 1 and "its own header comes first" in output


@pytest.mark.parametrize(
    "text",
    [
        "open('a')\n",
        "from pathlib import Path\n\nPath('a').read_text()\n",
        "from pathlib import Path\n\nwith Path('a').open('w') as file:\n    pass\n",
        "from pathlib import Path\n\nPath('a').write_bytes(b'')\n",
    ],
)
def test_a_file_that_is_opened_by_itself_is_found(tree: Path, text: str) -> None:
    write(tree / "py/flexpm/low/it.py", text)
    code, output = run("layering.py", tree)
    assert code == 1
    assert "opens a file; py/flexpm/files.py reads and writes files" in output


def test_ring_of_modules_within_a_room_is_found(tree: Path) -> None:
    write(tree / "py/flexpm/low/b.py", "from . import a\n")
    write(tree / "py/flexpm/low/a.py", "def f():\n    from flexpm.low.b import c\n")
    code, output = run("layering.py", tree)
    assert code == 1 and "low/a.py" in output and "low/b.py" in output and "ring" in output


@pytest.mark.parametrize("folder", ["pkg/flexpm/kernel/low", "py/flexpm/low", "tests/kernel/low"])
@pytest.mark.parametrize("modules", [14, 15])
def test_a_crowded_folder_is_a_warning(tree: Path, folder: str, modules: int) -> None:
    (tree / "py/flexpm/low/a.py").unlink()
    for number in range(modules):
        for ending in ("py",) if folder.startswith("py") else ("hpp", "cpp"):
            write(tree / folder / f"a{number}.{ending}", "")
    found, output = run("layering.py", tree)
    assert found == 0 and ("warning" in output and "15 modules" in output) == (modules == 15)


def test_sizes_are_advice() -> None:
    code, text = run("functions.py", ROOT)
    assert code == 0 and text.endswith(" warnings\n")


def test_old_words_of_messages_are_listed(tree: Path) -> None:
    write(tree / "py/flexpm/low/d.py", 'def f(a):\n    "It bears."\n    g(f"{a} bears nothing")\n')
    text = '// it bears\nvoid f() { refuse("mantle", "no mantle " "here"); }\n'
    write(tree / "pkg/flexpm/kernel/low/a.cpp", text)
    code, output = run("words.py", tree)
    assert code == 0 and output.endswith("words: 2 old words\n")
    assert "py/flexpm/low/d.py:3: bears: {} bears nothing" in output
    assert "pkg/flexpm/kernel/low/a.cpp:3: mantle: no mantle" in output


@pytest.mark.parametrize("lines", [25, 26])
@pytest.mark.parametrize("head", ["void A::action()", "bool L::go(int a,\n\tint b)"])
def test_a_long_body_of_an_adapter_is_a_warning(tree: Path, head: str, lines: int) -> None:
    body = "\tif (a) { b(); }\n" * lines
    write(tree / "pkg/flexpm/yade/abi/A.cpp", f"{head}\n{{\n{body}}}\n\nvoid other() {{ }}\n")
    found, output = run("functions.py", tree)
    assert found == 0 and ("warning" in output and "26 lines" in output) == (lines == 26)


@pytest.mark.parametrize("count", [7, 8])
def test_many_parameters_in_cpp_are_a_warning(tree: Path, count: int) -> None:
    names = ", ".join(f"const std::map<int, double>& a{i}" for i in range(count))
    call = f"    g({', '.join(f'a{i}' for i in range(9))});\n"
    write(tree / "pkg/flexpm/kernel/low/a.cpp", f"static double f({names})\n{{\n{call}}}\n")
    found, output = run("functions.py", tree)
    assert found == 0 and ("warning" in output and "f takes 8 " in output) == (count == 8)


@pytest.mark.parametrize("count", [9, 10])
def test_many_parameters_in_python_are_a_warning(tree: Path, count: int) -> None:
    names = ", ".join(f"a{i}=1" for i in range(count))
    write(tree / "py/flexpm/low/c.py", f"class C:\n    def f(self, *, {names}):\n        ...\n")
    found, output = run("functions.py", tree)
    assert found == 0 and ("warning" in output and "f takes 10 " in output) == (count == 10)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("def f(test):\n    return test == 'slump'\n", "low/b.py:2: names the test slump"),
        ("RATES = {'slump': 1.0}\n", "names the test slump"),
        ("from ..kinds.tests import slump\n", "imports a test's file (slump)"),
        ("def f():\n    'slump'\n", ""),
        ("X = 'solids are for slump'\n", "names the test slump"),
        ("UNITS = {'slump_height': 'm'}\n", "names the test slump"),
        ("X = 'shear'\n", "names the test shear"),
        ("X = 'shear stiffness', 'shear_slumps'\n", ""),
    ],
)
def test_the_name_of_a_test_outside_of_its_file_is_found(tree, text, complaint):
    kinds = tree / "py/flexpm/kinds/tests"
    kinds.mkdir(parents=True)
    write(kinds / "slump.py", "KIND = 'slump'\n")
    write(kinds / "shear.py", "KIND = 'shear'\n")
    write(tree / "py/flexpm/low/b.py", text)
    _, output = run("kinds.py", tree)
    found = [line for line in output.splitlines() if "low/b.py" in line]
    assert bool(found) == bool(complaint)
    assert all(complaint in line for line in found)


@pytest.mark.parametrize(
    ("file", "most"), [("py/flexpm/low/c.py", 400), ("tests/python/test_c.py", 500)]
)
def test_a_long_python_file_is_a_warning(tree: Path, file: str, most: int) -> None:
    for lines in (most, most + 1):
        write(tree / file, "a = 1\n" * lines)
        found, output = run("functions.py", tree)
        assert found == 0 and (f"warning: {tree / file}: {lines} lines" in output) == (lines > most)
