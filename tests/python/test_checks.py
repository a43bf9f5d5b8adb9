# SPDX-License-Identifier: GPL-3.0-or-later
"""The checks of the sources accept this tree and find each kind of violation in a broken one."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CHECKS = ROOT / "scripts" / "checks"


def run(check: str, tree: Path) -> tuple[int, str]:
    command = [sys.executable, str(CHECKS / check), str(tree)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    for folder in ("pkg/flexpm/kernel", "pkg/flexpm/yade", "tests/kernel", "py/flexpm"):
        (tmp_path / folder).mkdir(parents=True)
    return tmp_path


@pytest.mark.parametrize("check", ["layering.py", "adapter_length.py"])
def test_this_tree_passes(check: str) -> None:
    code, text = run(check, ROOT)
    assert code == 0, text


@pytest.mark.parametrize(
    ("name", "text", "complaint"),
    [
        ("pkg/flexpm/kernel/a.hpp", "#include <core/Scene.hpp>\n", "core/Scene.hpp"),
        ("pkg/flexpm/kernel/a.hpp", "#include <boost/python.hpp>\n", "boost/python.hpp"),
        ("pkg/flexpm/kernel/a.hpp", "#include <Eigen/Dense>\n", "elastic_solve"),
        ("pkg/flexpm/kernel/elastic_solve.hpp", "#include <Eigen/Dense>\n", "elastic_solve"),
        ("pkg/flexpm/kernel/a.cpp", "#include <CGAL/Origin.h>\n", "power_diagram"),
        ("pkg/flexpm/kernel/a.cpp", "#include <omp.h>\n", "stepping"),
        ("pkg/flexpm/kernel/a.cpp", "void f()\n{\n#pragma omp parallel\n}\n", "OpenMP"),
        ("pkg/flexpm/kernel/a.cpp", "#include <iostream>\n", "iostream"),
        ("pkg/flexpm/kernel/a.cpp", 'void f() { std::printf("x"); }\n', "prints"),
        ("pkg/flexpm/kernel/a.cpp", 'auto f() { return std::getenv("X"); }\n', "environment"),
        ("pkg/flexpm/kernel/a.hpp", "#include <flexpm/kernel/a.hpp>\n", "ring"),
        ("pkg/flexpm/yade/A.cpp", "#include <core/Scene.hpp>\n", "yade_lite.hpp"),
        ("pkg/flexpm/yade/binding_a.cpp", "#include <flexpm/yade/yade_lite.hpp>\n", "no YADE"),
        ("pkg/flexpm/yade/A.cpp", "yade::NewtonIntegrator* n;\n", "layout differs"),
        ("tests/kernel/test_a.cpp", "#include <core/Scene.hpp>\n", "Catch2"),
        ("py/flexpm/a.py", "import matplotlib.pyplot\n", "plot.py"),
        ("py/flexpm/a.py", "    from yade import *\n", "all names of YADE"),
    ],
)
def test_violation_is_found(tree: Path, name: str, text: str, complaint: str) -> None:
    (tree / name).write_text(text)
    code, output = run("layering.py", tree)
    assert (
        code == 1 and complaint in output and name in output.replace("kernel: headers", f"{name}")
    )


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("pkg/flexpm/kernel/elastic_solve.cpp", "#include <Eigen/Sparse>\n"),
        ("pkg/flexpm/kernel/power_diagram.cpp", "#include <CGAL/Origin.h>\n"),
        ("pkg/flexpm/kernel/stepping.cpp", "#include <omp.h>\n#pragma omp parallel\n"),
        ("pkg/flexpm/kernel/a.hpp", "// std::cout is not used\n#include <cmath>\n"),
        ("pkg/flexpm/yade/A.cpp", "// placed after NewtonIntegrator\n"),
        ("pkg/flexpm/yade/A.hpp", 'auto s = R"""(after :yref:`NewtonIntegrator`)""";\n'),
        ("py/flexpm/plot.py", "import matplotlib\n"),
    ],
)
def test_allowed_use_passes(tree: Path, name: str, text: str) -> None:
    (tree / name).write_text(text)
    assert run("layering.py", tree)[0] == 0


@pytest.mark.parametrize(("lines", "code"), [(25, 0), (26, 1)])
@pytest.mark.parametrize("head", ["void A::action()", "bool L::go(int a,\n\tint b)"])
def test_length_of_adapter_bodies(tree: Path, head: str, lines: int, code: int) -> None:
    body = "\tif (a) { b(); }\n" * lines
    (tree / "pkg/flexpm/yade/A.cpp").write_text(f"{head}\n{{\n{body}}}\n\nvoid other() {{ }}\n")
    assert run("adapter_length.py", tree)[0] == code
