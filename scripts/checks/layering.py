#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check which file may include or import what: kernel without frameworks, one home per library.

Usage: scripts/checks/layering.py [ROOT]. Prints one line per violation; exit code 1 if any.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

# What the kernel must not use of the standard library: it does not print, read files or clocks.
FORBIDDEN_STANDARD = {"chrono", "ctime", "filesystem", "fstream", "iomanip", "iostream", "ostream"}
# Libraries that one kind of kernel source may use.
KERNEL_LIBRARIES = {
    "CGAL/": r"power_diagram\.cpp",
    "Eigen/": r"elastic_solve\.cpp",
    "omp.h": r"stepping[a-z_0-9]*\.cpp",
}
FORBIDDEN_WORDS = {
    r"std::c(out|err|log)\b": "prints",
    r"(?<!n)\bprintf\s*\(|\bputs\s*\(": "prints",
    r"\bgetenv\s*\(": "reads the environment",
    r"\bs?rand\s*\(|\brandom_device\b": "draws random numbers without a seed",
}
# Classes whose layout in Debian's YADE differs from its headers.
FORBIDDEN_YADE = ("NewtonIntegrator", "Clump")
PYTHON_LIBRARIES = {
    "matplotlib": {"plot.py", "plot_compare.py", "plot_maps.py"},
    "vtk": {"export.py"},
    "vtkmodules": {"export.py"},
}


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


def kernel_include(path: Path, name: str) -> str | None:
    """Return why a kernel file may not include `name`, or None if it may."""
    if name.startswith("flexpm/kernel/"):
        return None
    for library, home in KERNEL_LIBRARIES.items():
        if name.startswith(library):
            return None if re.fullmatch(home, path.name) else f"only {home} may use it"
    if name == "immintrin.h" and path.suffix == ".cpp":
        return None
    if "/" in name or "." in name:
        return "the kernel knows the standard library and its own headers only"
    return "the kernel does not print, read files or clocks" if name in FORBIDDEN_STANDARD else None


def check_kernel(folder: Path) -> Iterator[str]:
    """Yield violations of the kernel's sources, `folder` being pkg/flexpm/kernel."""
    for path in sorted([*folder.glob("*.hpp"), *folder.glob("*.cpp")]):
        found = list(includes(path))
        for number, name in found:
            reason = kernel_include(path, name)
            if reason:
                yield f"{path}:{number}: includes {name}; {reason}"
        own = f"flexpm/kernel/{path.stem}.hpp"
        if path.suffix == ".cpp" and (folder / f"{path.stem}.hpp").exists() and found[0][1] != own:
            yield f"{path}:{found[0][0]}: includes {found[0][1]} first; its own header comes first"
        text = without_comments(path.read_text())
        words = dict(FORBIDDEN_WORDS)
        if not re.fullmatch(KERNEL_LIBRARIES["omp.h"], path.name):
            words[r"#\s*pragma\s+omp\s+(?!simd|declare)"] = (
                "uses OpenMP outside the stepping sources"
            )
        for pattern, what in words.items():
            for match in re.finditer(pattern, text):
                number = text.count("\n", 0, match.start()) + 1
                yield f"{path}:{number}: {what} ({match.group(0).strip()}); callers do that"
    yield from check_cycles(folder)


def check_cycles(folder: Path) -> Iterator[str]:
    """Yield kernel headers that include each other in a ring, which #pragma once would hide."""
    below = {
        path.name: {name.split("/")[-1] for _, name in includes(path) if "flexpm/kernel/" in name}
        for path in folder.glob("*.hpp")
    }
    while True:
        leaves = [name for name, children in below.items() if not children & below.keys()]
        if not leaves:
            break
        for name in leaves:
            del below[name]
    if below:
        yield f"{folder}: headers {', '.join(sorted(below))} include each other in a ring"


def check_adapters(folder: Path) -> Iterator[str]:
    """Yield violations of the YADE side, `folder` being pkg/flexpm/yade."""
    for path in sorted([*folder.glob("*.hpp"), *folder.glob("*.cpp")]):
        plain = re.match(r"(binding|elf)_", path.name)
        for number, name in includes(path):
            yades = re.match(r"(core|lib|pkg|gui|py)/", name)
            if yades and path.name != "yade_lite.hpp":
                yield f"{path}:{number}: includes {name}; YADE's headers come through yade_lite.hpp"
            if name.endswith("yade_lite.hpp") and plain:
                yield f"{path}:{number}: includes {name}; {plain.group(1)}_* files know no YADE"
            if name.startswith("CGAL/"):
                yield f"{path}:{number}: includes {name}; only power_diagram.cpp may use it"
        text = without_comments(path.read_text())
        for name in FORBIDDEN_YADE:
            for match in re.finditer(rf"\b{name}\b", text):
                number = text.count("\n", 0, match.start()) + 1
                yield f"{path}:{number}: names {name}, whose layout differs; use Python for it"


def check_tests(folder: Path) -> Iterator[str]:
    """Yield violations of the kernel's tests, `folder` being tests/kernel."""
    for path in sorted([*folder.glob("*.hpp"), *folder.glob("*.cpp")]):
        for number, name in includes(path):
            # Eigen: an independent reference for eigenvalues and linear systems
            known = name.startswith(("flexpm/kernel/", "catch2/", "Eigen/"))
            local = (folder / name).exists()
            if not (known or local or "/" not in name):
                yield f"{path}:{number}: includes {name}; kernel, Catch2 and Eigen are allowed"


def check_python(folder: Path) -> Iterator[str]:
    """Yield violations of the package, `folder` being py/flexpm."""
    for path in sorted(folder.rglob("*.py")):
        for number, line in enumerate(path.read_text().splitlines(), start=1):
            match = re.match(r"\s*(?:from|import)\s+(\w+)", line)
            homes = PYTHON_LIBRARIES.get(match.group(1)) if match else None
            if homes is not None and path.name not in homes:
                yield f"{path}:{number}: imports {match.group(1)}; only {', '.join(homes)} may"
            if re.match(r"\s*from\s+yade(\.\w+)?\s+import\s+\*", line):
                yield f"{path}:{number}: imports all names of YADE; import the names that are used"


def violations(root: Path) -> Iterator[str]:
    """Yield all violations of the tree at `root`, one line each."""
    yield from check_kernel(root / "pkg/flexpm/kernel")
    yield from check_adapters(root / "pkg/flexpm/yade")
    yield from check_tests(root / "tests/kernel")
    yield from check_python(root / "py/flexpm")


def main() -> int:
    """Print the violations of the tree given as argument, or of this one."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    found = list(violations(root))
    for line in found:
        print(f"layering: {line}")
    print(f"layering: {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
