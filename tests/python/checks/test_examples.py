# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of docstrings run, with one small 2D and one small 3D specimen for all of them."""

import ast
import doctest
from pathlib import Path

import pytest

import flexpm

PACKAGE = Path(__file__).resolve().parents[3] / "py" / "flexpm"
#: Names that the examples use: the package, and a specimen of each dimension.
NAMES = {
    "flexpm": flexpm,
    "specimen": flexpm.Specimen.rectangle(0.012, 0.024, 0.01),
    "solid": flexpm.Specimen.box(0.008, 0.008, 0.012),
}


def examples():
    """Docstrings with examples, by file and name; read as text, so that nothing is imported."""
    parser = doctest.DocTestParser()
    found = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)):
                name = f"{file.relative_to(PACKAGE)}:{getattr(node, 'name', '')}"
                test = parser.get_doctest(ast.get_docstring(node) or "", {}, name, str(file), 0)
                if test.examples:
                    found[name] = test
    return found


FOUND = examples()


def run(test):
    """Run the examples of a docstring in an empty scene; return its failures as text."""
    from yade import O  # after flexpm, which finds it

    O.reset()
    test.globs = dict(NAMES)
    said = []
    doctest.DocTestRunner(verbose=False).run(test, out=said.append)
    return "".join(said)


@pytest.mark.parametrize("name", FOUND)
def test_examples_of_docstrings_run(name):
    assert run(FOUND[name]) == ""


def test_the_main_entry_points_have_examples():
    names = {name.rpartition(":")[2] for name in FOUND}
    assert {"run", "build", "elastic", "compare", "load", "Result", "PartRig", "rig"} <= names
    assert {"rectangle", "box", "cylinder", "Material", "InputError", "Loading"} <= names


def test_a_wrong_example_is_found():
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, 0)
    assert "Expected" in run(wrong)
