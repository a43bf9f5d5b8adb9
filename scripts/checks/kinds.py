#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check that what a test is stands in its own file: no other file of the package names a test.

Usage: scripts/checks/kinds.py [ROOT]. Prints one line per violation; exit code 1 if any.
A test is a file of py/flexpm/kinds/tests. Its name must be no text in any other file of
py/flexpm, nor a word of one unless it is a word of mechanics, too, and none may import a single
test's file: what differs between tests is asked of their kinds.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

PACKAGE, TESTS = "py/flexpm", "py/flexpm/kinds/tests"
#: Files there that are no test of users: a script's own test has no name to them.
NO_NAMES = {"__init__", "own"}
#: Names that are words of mechanics: a text may have them as words.
WORDS = {"elastic", "shear", "tension", "bending"}
#: Texts that are names of tests and mean something else, or that may name one: file, names, reason.
EXCEPTIONS = {
    "materials/mixing.py": ({"elastic"}, "a table of materials"),
    "materials/mineral.py": ({"elastic"}, "a table of materials"),
    "materials/material.py": ({"elastic"}, "a table of materials"),
    "studies/calibration_report.py": ({"elastic"}, "a table of materials"),
    "studies/calibration_search.py": ({"elastic"}, "the part of a search that a solve answers"),
    "_api.py": ({"elastic"}, "the function of the public contract"),
    "__init__.py": ({"elastic"}, "the function of the public contract"),
    "report/pages/page_run.py": ({"elastic"}, "energies"),
    "models/grains.py": ({"elastic"}, "the function of the public contract"),
    "renamed.py": ({"elastic"}, "a method of rigs"),
    "report/notebook.py": ({"tension"}, "the mode of a law"),
    "report/tables.py": ({"shear"}, "a wave"),
    "kinds/words.py": ({"shear"}, "the mode of cracks"),
    "bench/report.py": ({"uniaxial", "brazilian"}, "cases of the measurement"),
    "bench/timing.py": ({"brazilian"}, "a case of the measurement"),
}


def texts(tree: ast.Module) -> Iterator[ast.Constant]:
    """Yield the texts of a file that are no documentation."""
    plain = {
        id(node.value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in plain:
            yield node


def imported(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield line and name of what a file imports, the last part of each."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and "kinds.tests" in f"{'.' * node.level}{node.module}":
            yield from ((node.lineno, alias.name) for alias in node.names)


def named(text: str, names: set[str]) -> set[str]:
    """Tests that a text names: as a whole, or by a word of its own."""
    if text in names:
        return {text}
    return {word for word in re.split(r"[^a-z]+", text) if word in names - WORDS}


def violations(root: Path) -> Iterator[str]:
    """Yield what names a test outside of its file, and exceptions that are none any more."""
    package, folder = root / PACKAGE, root / TESTS
    names = {path.stem for path in folder.glob("*.py")} - NO_NAMES
    met: dict[str, set[str]] = {}
    for path in sorted(package.rglob("*.py")):
        if path.parent == folder:
            continue
        here = str(path.relative_to(package))
        allowed = EXCEPTIONS.get(here, (set(), ""))[0]
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in texts(tree):
            for name in sorted(named(node.value, names)):
                met.setdefault(here, set()).add(name)
                if name not in allowed:
                    yield f"{path}:{node.lineno}: names the test {name}; ask its kind"
        for line, name in imported(tree):
            yield f"{path}:{line}: imports a test's file ({name}); ask the registry of kinds"
    for here, (allowed, _) in EXCEPTIONS.items():
        for name in sorted(allowed - met.get(here, set())):
            yield f"{package / here}:1: does not name {name} any more; take it off the exceptions"


def main() -> int:
    """Print the violations and say how many there are."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    found = list(violations(root.resolve()))
    for line in found:
        print(f"kinds: {line}")
    print(f"kinds: {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
