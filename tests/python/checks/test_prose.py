# SPDX-License-Identifier: GPL-3.0-or-later
"""The checks of comments and of the manual accept this tree and find what breaks their rules."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
OF = "Of"  #: in a name of its own, as this file is looked at, too
LONG = " ".join(["word"] * 30)


def run(check: str, *arguments: str | Path) -> tuple[int, str]:
    command = [sys.executable, str(ROOT / "scripts" / "checks" / check), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout


@pytest.mark.parametrize("check", ["comments.py", "manual.py"])
def test_this_tree_passes(check: str) -> None:
    code, said = run(check)
    assert code == 0, said


@pytest.mark.parametrize(
    ("name", "text", "code"),
    [
        ("py/a.py", f'"""{OF} a disc."""\n', 1),
        ("py/a.py", f"def f():\n    # {OF.lower()} a disc\n    pass\n", 1),
        ("py/a.py", f"#: {OF} a disc\nA = 1\n", 1),
        ("py/a.py", f'"""Say it.\n\nArgs:\n    width: {OF} the disc [m].\n"""\n', 1),
        ("pkg/flexpm/kernel/a.hpp", f"/// {OF} a disc.\n", 1),
        ("pkg/flexpm/kernel/a.hpp", "double radius;  ///< of the disc [m]\n", 0),
        ("pkg/flexpm/kernel/a.hpp", "/// The weight and the radius\n/// of a disc.\n", 0),
        ("pkg/flexpm/kernel/a.hpp", f"/// {LONG}\n", 1),
        ("pkg/flexpm/yade/a.hpp", f"/// {LONG}\n", 0),
        ("py/a.py", '"""Radius of a disc. Of two the smaller."""\n', 0),
    ],
)
def test_comments(tmp_path: Path, name: str, text: str, code: int) -> None:
    (tmp_path / name).parent.mkdir(parents=True)
    (tmp_path / name).write_text(text)
    assert run("comments.py", tmp_path)[0] == code


def test_a_wide_comment_is_broken_and_code_is_left(tmp_path: Path) -> None:
    file = tmp_path / "pkg/flexpm/kernel/a.hpp"
    file.parent.mkdir(parents=True)
    file.write_text(
        f"/// {LONG}\n/// and more.\n///\n///     a formula\n/// @param a  {LONG}\nint f(int a);\n"
    )
    assert run("comments.py", "--fix", tmp_path)[0] == 0
    lines = file.read_text().splitlines()
    assert max(map(len, lines)) <= 100
    words = " ".join(line.removeprefix("///").strip() for line in lines).split()
    wanted = f"{LONG} and more. a formula @param a {LONG} int f(int a);"
    assert words == wanted.split()
    assert "///     a formula" in lines
    assert lines[-1] == "int f(int a);"
    assert run("comments.py", tmp_path)[0] == 0


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("line\n" * 10000, 0),
        (f"{LONG}\n", 1),
        (f"   {LONG} | {LONG}\n", 0),
        (f"`page <https://example.org/{'a' * 120}>`_\n", 0),
        ("A page.\n", 0),
    ],
)
def test_the_manual(tmp_path: Path, text: str, code: int) -> None:
    (tmp_path / "doc").mkdir()
    (tmp_path / "doc" / "a.rst").write_text(text)
    assert run("manual.py", tmp_path)[0] == code
