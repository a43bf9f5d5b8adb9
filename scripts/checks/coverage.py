#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check how much of the sources their tests reach.

    scripts/checks/coverage.py kernel [BUILD]               default: build-coverage
    scripts/checks/coverage.py python [PYTEST ARGUMENT...]  default: all tests that are not slow

kernel   builds with GCC's counters and runs the kernel's tests. All of it: lines. The law of a
         point, the forces and the changes of contacts: each line, and each condition both ways.
python   runs the tests by the plugin in build, child processes included: lines of the package.

Below its gate exit code 1, and what is missing; there are no exceptions. Needs the package
python3-pytest-cov.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
KERNEL = ROOT / "pkg/flexpm/kernel"
#: Files of the kernel of which each line and each condition, both ways, must be reached.
WHOLE = (
    "law/*",
    "forces/contact_forces.*",
    "forces/contact_kinematics.hpp",
    "forces/crack_record.*",
    "topology/contact_search.*",
    "topology/contact_update.*",
    "topology/erasure.*",
    "topology/joint_faces.*",
    "topology/removal.*",
    "topology/touch_point.*",
)
#: Least share of lines [%].
KERNEL_LINES = 95
PYTHON_LINES = 90


class Reached(NamedTuple):
    """How often a line ran, and each way of its conditions."""

    file: str  #: within the kernel
    line: int
    count: int
    ways: list[int]


def run(*command: str | Path, **environment: str) -> None:
    """Run a command at the top of the checkout; its failure ends this one."""
    done = subprocess.run(command, cwd=ROOT, env=os.environ | environment)
    if done.returncode != 0:
        sys.exit(done.returncode)


def measure_kernel(build: Path) -> None:
    """Run the kernel's tests in a build that counts."""
    run(
        *("cmake", "-S", ".", "-B", build, "-G", "Ninja", "--log-level=ERROR", "-Wno-dev"),
        *("-DFLEXPM_KERNEL_ONLY=ON", "-DFLEXPM_COVERAGE=ON", "-DCMAKE_CXX_COMPILER=g++"),
        *("-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG="),
        *("-DFLEXPM_UNITY=OFF", "-DCGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=TRUE"),
    )
    run("ninja", "-C", build, "-j2", "--quiet", "kernel_tests")
    for old in build.rglob("*.gcda"):
        old.unlink()
    # on one core: threads would lose counts of each other
    # long loops over the same lines are cut short
    tests = build / "tests/kernel/kernel_tests"
    run("taskset", "-c", "0", tests, "~[eigenvalues]", FLEXPM_ASSEMBLIES="30")


def reached(build: Path) -> Iterator[Reached]:
    """Lines of the kernel in order, the copies of a template or an inline function as one.

    GCC's own output is read: the gcovr of Debian 12 takes ways into an exception for conditions
    where a copy of a function never ran.
    """
    counts: dict[tuple[str, int], int] = defaultdict(int)
    ways: dict[tuple[str, int], dict[int, list[int]]] = defaultdict(dict)
    data = [str(file.relative_to(build)) for file in build.rglob("*.gcda")]
    command = ["gcov", "--json-format", "--stdout", "--branch-probabilities", *data]
    found = subprocess.run(command, cwd=build, check=True, capture_output=True, text=True).stdout
    for unit in found.splitlines():
        for file in json.loads(unit)["files"]:
            path = (build / file["file"]).resolve()
            if not path.is_relative_to(KERNEL):
                continue
            source = path.read_text().splitlines()
            for line in file["lines"]:
                if source[line["line_number"] - 1].strip() == "}":
                    continue  # what is cleaned up after an exception
                place = str(path.relative_to(KERNEL)), line["line_number"]
                counts[place] += line["count"]
                own = [way["count"] for way in line["branches"] if not way["throw"]]
                # copies for other template arguments may have fewer conditions
                sums = ways[place].setdefault(len(own), [0] * len(own))
                sums[:] = map(sum, zip(sums, own, strict=False))
    for place in sorted(counts):
        yield Reached(*place, counts[place], [way for sums in ways[place].values() for way in sums])


def check_kernel(build: Path) -> int:
    """Print what is below the gates; return the exit code."""
    measure_kernel(build)
    lines = list(reached(build))
    share = 100.0 * sum(line.count > 0 for line in lines) / len(lines)
    whole = [line for line in lines if any(fnmatch(line.file, name) for name in WHOLE)]
    missing = [line for line in whole if line.count == 0 or not all(line.ways)]
    for file, number, count, _ in missing:
        text = (KERNEL / file).read_text().splitlines()[number - 1].strip()
        what = "condition one way only" if count > 0 else "line not reached"
        print(f"{(KERNEL / file).relative_to(ROOT)}:{number}: {what}: {text}")
    ways = [way for line in whole for way in line.ways]
    print(
        f"coverage: kernel: {share:.2f} % of {len(lines)} lines, must be {KERNEL_LINES} %; law,"
        f" forces and changes of contacts: {len(whole) - len(missing)} of {len(whole)} lines,"
        f" {sum(way > 0 for way in ways)} of {len(ways)} ways of conditions, must be all"
    )
    return int(bool(missing) or share < KERNEL_LINES)


def check_python(arguments: list[str]) -> int:
    """Run pytest, which lists the files that are not reached whole; return the exit code."""
    run(
        *(sys.executable, "-m", "pytest", "-q", f"--cov={ROOT / 'py/flexpm'}"),
        *("--cov-report=term:skip-covered", f"--cov-fail-under={PYTHON_LINES}"),
        *(arguments or ["-m", "not slow"]),
        OMP_NUM_THREADS="1",
        HYPOTHESIS_PROFILE="",  # by night, too, the examples of the day
        PYTHONPATH=str(ROOT / "build/python"),
        COVERAGE_FILE=str(ROOT / "build/coverage.data"),
    )
    return 0


def main(arguments: list[str]) -> int:
    """Check one part."""
    if arguments[:1] == ["kernel"]:
        return check_kernel(ROOT / (arguments[1] if arguments[1:] else "build-coverage"))
    if arguments[:1] == ["python"]:
        return check_python(arguments[1:])
    print(__doc__)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
