#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Warn of large functions and files: parameters, lines of Python files, bodies of the adapters.

Usage: scripts/checks/functions.py [ROOT]. Prints one line per warning; the exit code is always 0.

A function of C++ with more than seven parameters, or one of the package with more than nine, may
need a struct or dataclass. A file of the package with more than 400 lines, or of its tests with
more than 500, may hold two topics. An adapter's go() or action() unpacks, calls the kernel and
packs; more than 25 lines may do more than that. Split by topic, never by a number.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from layering import without_comments

MOST_PARAMETERS = 7
#: Keywords make a longer list readable.
MOST_PARAMETERS_PYTHON = 9
MOST_LINES = 25
#: What users call with keywords: each of these names one quantity.
MANY_KEYWORDS = {
    "flexpm/laboratory/protocols.py": {"run"},
}
#: Lines of a Python file, by the folder.
MOST_FILE_LINES = {"py/flexpm": 400, "tests": 500}
_BODY = re.compile(r"\b(?:go|action)\s*\([^;{}]*\)\s*(?:const\s*)?(?:override\s*)?\{")
# A name, parameters without a call in them, what may follow them, and the body or the end.
_FUNCTION = re.compile(
    r"\b(~?\w+)\s*\(((?:[^(){};]|\([^(){};]*\))*)\)\s*(?:const\s*)?(?:noexcept\s*)?"
    r"(?:override\s*)?(?:->\s*[\w:<>, ]+)?(?::\s*\w+\s*[({][^;]*)?[{;]"
)
_NO_FUNCTION = {"if", "for", "while", "switch", "return", "catch", "sizeof", "decltype", "throw"}
# Each parameter begins with a type that is followed by a name, unlike the arguments of a call.
_PARAMETER = re.compile(r"\s*(?:const\s+|unsigned\s+|struct\s+)*[\w:]+(?:<.*>)?[\s*&]+[\w]", re.S)


def parameters(text: str) -> list[str]:
    """Parameters between the commas that stand outside of brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += {"<": 1, "(": 1, "[": 1, ">": -1, ")": -1, "]": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part for part in parts if part.strip()]


def long_lists_cpp(path: Path) -> Iterator[str]:
    """Functions of a C++ file with too many parameters."""
    text = without_comments(path.read_text(encoding="utf-8"))
    for match in _FUNCTION.finditer(text):
        name, found = match.group(1), parameters(match.group(2))
        if name in _NO_FUNCTION or not all(_PARAMETER.match(part) for part in found):
            continue
        if len(found) > MOST_PARAMETERS:
            line = text.count("\n", 0, match.start()) + 1
            yield _too_many(path, line, name, len(found))


def long_lists_python(path: Path) -> Iterator[str]:
    """Functions of a Python file with too many parameters; ``self`` does not count."""
    allowed: set[str] = set()
    for name, functions in MANY_KEYWORDS.items():
        if path.as_posix().endswith(name):
            allowed = functions
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) or node.name in allowed:
            continue
        arguments = node.args
        names = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
        count = len([name for name in names if name.arg not in ("self", "cls")])
        if count > MOST_PARAMETERS_PYTHON:
            yield _too_many(path, node.lineno, node.name, count, MOST_PARAMETERS_PYTHON)


def long_bodies(path: Path) -> Iterator[str]:
    """Bodies of go() and action() of an adapter with too many lines."""
    text = path.read_text(encoding="utf-8")
    for match in _BODY.finditer(text):
        depth, end = 1, match.end()
        while depth and end < len(text):
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        inside = text[match.end() : end - 1].strip("\n")
        length = len(inside.splitlines()) if inside.strip() else 0
        if length > MOST_LINES:
            line = text.count("\n", 0, match.start()) + 1
            yield f"{path}:{line}: {length} lines, more than {MOST_LINES}; does it do more?"


def long_files(root: Path) -> Iterator[str]:
    """Python files with many lines."""
    for folder, most in MOST_FILE_LINES.items():
        for path in sorted((root / folder).rglob("*.py")):
            count = len(path.read_text(encoding="utf-8").splitlines())
            if count > most:
                yield f"{path}: {count} lines, more than {most}; does it hold two topics?"


def _too_many(path: Path, line: int, name: str, count: int, most: int = MOST_PARAMETERS) -> str:
    return f"{path}:{line}: {name} takes {count} parameters, more than {most}; is it a struct?"


def warnings(root: Path) -> Iterator[str]:
    """All warnings of the tree at `root`, one line each."""
    yield from long_files(root)
    for path in sorted((root / "pkg").rglob("*.[ch]pp")):
        yield from long_lists_cpp(path)
    for path in sorted((root / "py").rglob("*.py")):
        yield from long_lists_python(path)
    for path in sorted((root / "pkg/flexpm/yade").rglob("*.[ch]pp")):
        yield from long_bodies(path)


def main() -> None:
    """Print the warnings of the tree given as argument, or of this one."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    found = list(warnings(root))
    for line in found:
        print(f"functions: warning: {line}")
    print(f"functions: {len(found)} warnings")


if __name__ == "__main__":
    main()
