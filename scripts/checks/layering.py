#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check which file may include or import what: one table of rooms for kernel, adapters and Python.

Usage: scripts/checks/layering.py [ROOT]. Prints one line per violation; exit code 1 if any.
A folder with many modules is a warning only: a topic, not a number, says where a folder is split.
The table is scripts/checks/layers.toml below ROOT.
"""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from fnmatch import fnmatch
from pathlib import Path

TABLE = "scripts/checks/layers.toml"
TREES = {"kernel": "pkg/flexpm/kernel", "yade": "pkg/flexpm/yade", "python": "py/flexpm"}
MOST_MODULES = 14
# Folders of the kernel's tests that mirror no room of the kernel.
TEST_FOLDERS = {"bench", "bits", "fuzz", "reference", "support"}
# What the kernel must not use of the standard library: it does not print, read files or clocks.
FORBIDDEN_STANDARD = {"chrono", "ctime", "filesystem", "fstream", "iomanip", "iostream", "ostream"}
FORBIDDEN_WORDS = {
    r"std::c(out|err|log)\b": "prints; callers do that",
    r"(?<!n)\bprintf\s*\(|\bputs\s*\(": "prints; callers do that",
    r"\bgetenv\s*\(": "reads the environment; callers do that",
    r"\bs?rand\s*\(|\brandom_device\b": "draws random numbers without a seed; use random.hpp",
}
# Files that import all that lies in a folder of their room: tests are registered so.
IMPORT_A_FOLDER = {"py/flexpm/kinds/registry.py"}
# What opens a file by itself; elsewhere a file is written whole and read up to a largest size, by
# FILES, which knows devices, links and disks that are full.
FILES = "py/flexpm/files.py"
OPENS = {"open", "read_text", "read_bytes", "write_text", "write_bytes"}
MAY_OPEN = {
    FILES: "the home of reading and writing",
    "py/flexpm/cli/terminal.py": "streams of the process",
    "py/flexpm/bench/memory.py": "/proc",
    "py/flexpm/bench/report.py": "/proc",
    "py/flexpm/report/notebook.py": "a picture that it has drawn",
    "py/flexpm/report/pages/page.py": "the package's templates, pictures of the run",
    "py/flexpm/results/arrays/vtu_arrays.py": "a temporary file of FILES",
    "py/flexpm/runs/checkpoint.py": "a checksum, read in parts",
    "py/flexpm/runs/loading_start.py": "a checksum, read in parts",
    "py/flexpm/specimens/labels/image_files.py": "an image, whose size is known from its head",
    "py/flexpm/specimens/space/file.py": "the first letters of a file",
    "py/flexpm/studies/scripts.py": "a checksum of modules that Python has read",
}
# The one home of the kernel's errors.
ERRORS = "require.hpp"
OPENMP = r"#\s*pragma\s+omp\s+(?!simd|declare)"
# Classes whose layout in Debian's YADE differs from its headers.
FORBIDDEN_YADE = ("NewtonIntegrator", "Clump")


@dataclass(frozen=True)
class Room:
    """A folder of sources, or one file at the top of its tree."""

    uses: frozenset[str]
    libraries: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Use:
    """A line of a file that includes or imports another file of the project."""

    path: Path
    line: int
    target: Path


class Rooms:
    """The table of rooms and where each file stands in it. Rooms are named "tree.room"."""

    def __init__(self, root: Path) -> None:
        table = root / TABLE
        self.root = root
        self.trees = tomllib.loads(table.read_text(encoding="utf-8")) if table.exists() else {}
        self.rooms = {
            f"{tree}.{name}": Room(
                frozenset(self._full(tree, room["uses"])), room.get("libraries", {})
            )
            for tree, rooms in self.trees.items()
            for name, room in rooms.items()
        }

    def _full(self, tree: str, names: Iterable[str]) -> Iterator[str]:
        for name in names:
            if name in TREES:
                yield from (f"{name}.{room}" for room in self.trees.get(name, {}))
            else:
                yield name if "." in name else f"{tree}.{name}"

    def name(self, path: Path) -> str:
        """Return the name of the room that a file stands in, listed or not."""
        for tree, folder in TREES.items():
            top = self.root / folder
            if path.is_relative_to(top):
                first = path.relative_to(top).parts[0]
                return f"{tree}.{first if (top / first).is_dir() else Path(first).stem}"
        return ""

    def listed(self, tree: str) -> bool:
        """Tell whether the rooms of a tree are in the table."""
        return tree in self.trees


def ring(below: dict[str, set[str]]) -> list[str]:
    """Return the nodes of a graph that stand on circles or between two, sorted."""
    left = dict(below)
    while True:
        used = set().union(*left.values())
        ends = [name for name, children in left.items() if not children & left.keys()]
        ends += [name for name in left if name not in used]
        if not ends:
            return sorted(left)
        for name in ends:
            left.pop(name, None)


def without_comments(text: str) -> str:
    """Return C++ text without comments and string contents, line numbers kept."""
    pattern = re.compile(r'R"""\((.*?)\)"""|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)

    def blank(match: re.Match[str]) -> str:
        return "\n" * match.group(0).count("\n")

    return pattern.sub(blank, text)


def includes(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line number and name of each include of a C++ file."""
    for number, line in enumerate(path.read_text().splitlines(), start=1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if match:
            yield number, match.group(1)


def sources(folder: Path) -> list[Path]:
    """Return the C++ files below a folder."""
    return sorted([*folder.rglob("*.hpp"), *folder.rglob("*.cpp")])


def cpp_uses(path: Path, root: Path) -> Iterator[Use]:
    """Yield the includes of a C++ file that name a file of the project."""
    for number, name in includes(path):
        if name.startswith("flexpm/"):
            yield Use(path, number, root / "pkg" / name)


def python_file(base: Path, parts: Iterable[str]) -> Path | None:
    """Return the file of a module of the package in `base`, None if there is none."""
    path = base.joinpath(*parts)
    module = path.with_name(path.name + ".py") if path != base else base / "__init__.py"
    package = path / "__init__.py"
    return module if module.exists() else package if package.exists() else None


def imported(node: ast.AST, path: Path, base: Path) -> Iterator[Path]:
    """Yield the files of the package in `base` that an import statement of `path` names."""
    if isinstance(node, ast.Import):
        for alias in node.names:
            first, *parts = alias.name.split(".")
            target = python_file(base, parts) if first == base.name else None
            if target:
                yield target
    elif isinstance(node, ast.ImportFrom):
        parts = node.module.split(".") if node.module else []
        if node.level:
            here = path.parent.relative_to(base).parts
            parts = [*here[: len(here) - node.level + 1], *parts]
        elif parts and parts[0] == base.name:
            parts = parts[1:]
        else:
            return
        for alias in node.names:
            target = python_file(base, [*parts, alias.name]) or python_file(base, parts)
            if target:
                yield target


def python_uses(path: Path, base: Path) -> Iterator[Use]:
    """Yield the imports of a Python file that name a file of the package."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        for target in imported(node, path, base):
            if target != path:
                yield Use(path, node.lineno, target)


def check_table(rooms: Rooms) -> Iterator[str]:
    """Yield names in the table that are no rooms, and rooms that use each other in a circle."""
    for name, room in rooms.rooms.items():
        for other in sorted(room.uses - rooms.rooms.keys()):
            yield f"{TABLE}: {name} uses {other}, which is no room"
    circle = ring({name: set(room.uses) for name, room in rooms.rooms.items()})
    if circle:
        yield f"{TABLE}: {', '.join(circle)} use each other in a circle"


def check_rooms(rooms: Rooms, paths: list[Path], uses: list[Use]) -> Iterator[str]:
    """Yield files outside all rooms and uses that the table does not allow."""
    for path in paths:
        if rooms.name(path) not in rooms.rooms:
            yield f"{path}:1: stands in no room of {TABLE}; move it or list its folder"
    for use in uses:
        here, there = rooms.name(use.path), rooms.name(use.target)
        room = rooms.rooms.get(here)
        if room and there != here and there not in room.uses:
            yield f"{use.path}:{use.line}: uses {there}; {here} may not, see {TABLE}"


def check_size(paths: list[Path]) -> Iterator[str]:
    """Yield folders with many modules; header and source of one name are one module."""
    for folder in sorted({path.parent for path in paths}):
        count = len({path.stem for path in paths if path.parent == folder} - {"__init__"})
        if count > MOST_MODULES:
            yield f"{folder}: {count} modules, more than {MOST_MODULES}; does it hold two topics?"


def check_ring(paths: list[Path], uses: list[Use]) -> Iterator[str]:
    """Yield files that use each other in a circle, which #pragma once or a late import hides."""
    below: dict[str, set[str]] = {str(path): set() for path in paths}
    for use in uses:
        if str(use.path) in below:
            below[str(use.path)].add(str(use.target))
    circle = ring(below)
    if circle:
        yield f"{circle[0]}: {', '.join(circle)} use each other in a ring"


def check_tree(rooms: Rooms, tree: str, paths: list[Path], uses: list[Use]) -> Iterator[str]:
    """Yield what breaks the rules that all trees share."""
    if rooms.listed(tree):
        yield from check_rooms(rooms, paths, uses)
        yield from check_ring([path for path in paths if path.suffix != ".cpp"], uses)


def kernel_include(room: Room, path: Path, name: str) -> str | None:
    """Return why a kernel file may not include `name`, or None if it may."""
    if name.startswith("flexpm/kernel/"):
        return None
    for library, home in room.libraries.items():
        if name.startswith(library):
            return None if fnmatch(path.name, home) else f"only {home} may use it"
    if name == "immintrin.h" and path.suffix == ".cpp":
        return None
    if "/" in name or "." in name:
        return "the kernel knows the standard library, its own headers and the room's libraries"
    return "the kernel does not print, read files or clocks" if name in FORBIDDEN_STANDARD else None


def check_kernel(rooms: Rooms) -> Iterator[str]:
    """Yield violations of the kernel's sources."""
    folder = rooms.root / TREES["kernel"]
    paths = sources(folder)
    for path in paths:
        room = rooms.rooms.get(rooms.name(path), Room(frozenset()))
        found = list(includes(path))
        for number, name in found:
            reason = kernel_include(room, path, name)
            if reason:
                yield f"{path}:{number}: includes {name}; {reason}"
        header = path.with_suffix(".hpp")
        own = str(header.relative_to(rooms.root / "pkg"))
        if path.suffix == ".cpp" and not header.exists():
            yield f"{path}:1: has no header {own}; what it defines is declared in its own room"
        elif path.suffix == ".cpp" and (not found or found[0][1] != own):
            line, first = found[0] if found else (1, "nothing")
            yield f"{path}:{line}: includes {first} first; its own header comes first"
        text = without_comments(path.read_text())
        words = dict(FORBIDDEN_WORDS)
        if path.name != ERRORS:
            words[r"\bthrow\b"] = f"makes an error of its own form; use {ERRORS}"
        if "omp.h" not in room.libraries:
            words[OPENMP] = "uses OpenMP outside the rooms that have it"
        for pattern, what in words.items():
            for match in re.finditer(pattern, text):
                number = text.count("\n", 0, match.start()) + 1
                yield f"{path}:{number}: {what} ({match.group(0).strip()})"
    uses = [use for path in paths for use in cpp_uses(path, rooms.root)]
    yield from check_tree(rooms, "kernel", paths, uses)


def check_adapters(rooms: Rooms) -> Iterator[str]:
    """Yield violations of the YADE side."""
    paths = sources(rooms.root / TREES["yade"])
    for path in paths:
        plain = re.match(r"(binding|elf)_", path.name)
        for number, name in includes(path):
            yades = re.match(r"(core|lib|pkg|gui|py)/", name)
            if yades and path.name != "yade_lite.hpp":
                yield f"{path}:{number}: includes {name}; YADE's headers come through yade_lite.hpp"
            if name.endswith("yade_lite.hpp") and plain:
                yield f"{path}:{number}: includes {name}; {plain.group(1)}_* files know no YADE"
            if name.startswith(("CGAL/", "Eigen/")):
                yield f"{path}:{number}: includes {name}; the kernel alone may use it"
        text = without_comments(path.read_text())
        for name in FORBIDDEN_YADE:
            for match in re.finditer(rf"\b{name}\b", text):
                number = text.count("\n", 0, match.start()) + 1
                yield f"{path}:{number}: names {name}, whose layout differs; use Python for it"
    uses = [use for path in paths for use in cpp_uses(path, rooms.root)]
    yield from check_tree(rooms, "yade", paths, uses)


def check_tests(rooms: Rooms) -> Iterator[str]:
    """Yield violations of the kernel's tests, whose folders are those of the kernel."""
    folder = rooms.root / "tests/kernel"
    paths = sources(folder)
    for path in paths:
        first = path.relative_to(folder).parts[0]
        if first not in TEST_FOLDERS and f"kernel.{first}" not in rooms.rooms:
            yield f"{path}:1: stands in {first}; the folders are the kernel's and {TEST_FOLDERS}"
        for number, name in includes(path):
            # independent references: Eigen for eigenvalues and linear systems, voro++ for cells
            known = name.startswith(
                ("flexpm/kernel/", "catch2/", "Eigen/", "voro++/", "benchmark/")
            )
            local = (folder / name).exists() or (path.parent / name).exists()
            if not (known or local or "/" not in name):
                yield f"{path}:{number}: includes {name}; kernel, Catch2, Eigen, voro++ are allowed"


def hidden_imports(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield line and name of imports of own modules through a string, which no tool sees."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else None
        name = node.func.id if isinstance(node.func, ast.Name) else name
        if name not in {"import_module", "__import__"}:
            continue
        first = node.args[0] if node.args else None
        text = first.value if isinstance(first, ast.Constant) else None
        if not isinstance(text, str) or re.match(r"\.|flexpm\b", text):
            yield node.lineno, name


def opened(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield line and name of calls that open a file themselves."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            name = node.func
            if isinstance(name, ast.Attribute) and name.attr in OPENS:
                yield node.lineno, name.attr
            elif isinstance(name, ast.Name) and name.id == "open":
                yield node.lineno, name.id


def check_files(rooms: Rooms) -> Iterator[str]:
    """Yield files of the package that read or write by themselves, and exceptions that are none."""
    met = set()
    for path in sorted((rooms.root / TREES["python"]).rglob("*.py")):
        name = str(path.relative_to(rooms.root))
        for number, call in opened(ast.parse(path.read_text(encoding="utf-8"))):
            met.add(name)
            if name not in MAY_OPEN:
                yield f"{path}:{number}: {call} opens a file; {FILES} reads and writes files"
    for name in MAY_OPEN:
        if (rooms.root / name).exists() and name not in met:
            yield f"{name}:1: opens no file any more; take it off the exceptions of layering.py"


def check_python(rooms: Rooms) -> Iterator[str]:
    """Yield violations of the package."""
    folder = rooms.root / TREES["python"]
    paths = sorted(folder.rglob("*.py"))
    homes = {
        library: f"{files} of {name}"
        for name, room in rooms.rooms.items()
        if name.startswith("python.")
        for library, files in room.libraries.items()
    }
    for path in paths:
        own = rooms.rooms.get(rooms.name(path), Room(frozenset())).libraries
        for number, line in enumerate(path.read_text().splitlines(), start=1):
            match = re.match(r"\s*(?:from|import)\s+(\w+)", line)
            library = match.group(1) if match else ""
            if library in homes and not fnmatch(path.name, own.get(library, "")):
                yield f"{path}:{number}: imports {library}; only {homes[library]} may, see {TABLE}"
            if re.match(r"\s*from\s+yade(\.\w+)?\s+import\s+\*", line):
                yield f"{path}:{number}: imports all names of YADE; import the names that are used"
        if rooms.listed("python"):
            folders = str(path.relative_to(rooms.root)) in IMPORT_A_FOLDER
            for number, name in hidden_imports(ast.parse(path.read_text(encoding="utf-8"))):
                if folders:
                    continue
                yield f"{path}:{number}: hides an import in a string ({name}); write it out"
    uses = [use for path in paths for use in python_uses(path, folder)]
    yield from check_tree(rooms, "python", paths, uses)


def violations(root: Path) -> Iterator[str]:
    """Yield all violations of the tree at `root`, one line each."""
    rooms = Rooms(root)
    yield from check_table(rooms)
    yield from check_kernel(rooms)
    yield from check_adapters(rooms)
    yield from check_tests(rooms)
    yield from check_python(rooms)
    yield from check_files(rooms)


def warnings(rooms: Rooms) -> Iterator[str]:
    """Yield warnings of the listed trees and of the kernel's tests, one line each."""
    for tree, folder in TREES.items():
        if rooms.listed(tree):
            top = rooms.root / folder
            yield from check_size([*sources(top), *top.rglob("*.py")])
    yield from check_size(sources(rooms.root / "tests/kernel"))


def main() -> int:
    """Print warnings and violations of the tree given as argument, or of this one."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    for line in warnings(Rooms(root)):
        print(f"layering: warning: {line}")
    found = list(violations(root))
    for line in found:
        print(f"layering: {line}")
    print(f"layering: {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
