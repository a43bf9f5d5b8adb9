#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Guard against a slower step: count its instructions under valgrind and compare with a reference.

    scripts/checks/instructions.py BUILD            fails if a count is 5 % above its reference
    scripts/checks/instructions.py BUILD --renew    writes the reference, after a costly change

BUILD is a build folder configured with -DFLEXPM_BENCHMARKS=ON. Counts repeat to the instruction on
any load of the machine; they depend on the compiler and on the instruction set (valgrind knows
AVX2, not AVX-512), which the reference names. A count 5 % below asks for a new reference.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

REFERENCE = Path(__file__).parents[2] / "tests" / "kernel" / "bench" / "instructions.json"
#: Cubes of polyhedral grains: elastic, torn so that their points open and slide, and parted so that
#: grains press on others than their neighbours.
_SOLID_STATES = ("", "-torn", "-parted")
SOLID_CASES = tuple(f"solid{kind}{state}" for kind in ("", "-rigid") for state in _SOLID_STATES)
CASES = ("refined", "fan", "rigid", "softening", "joints", *SOLID_CASES)
TOLERANCE = 0.05
#: The function whose instructions count, by the class of the state.
_STEP = "flexpm::step(flexpm::{}&, flexpm::StepOptions const&)"


def main(arguments: list[str]) -> int:
    """Count, then compare or renew."""
    if not arguments or set(arguments[1:]) - {"--renew"}:
        print(__doc__, file=sys.stderr)
        return 2
    driver = Path(arguments[0]) / "tests" / "kernel" / "bench" / "step_count"
    if not driver.is_file():
        return _fail(f"{driver} = missing; configure with -DFLEXPM_BENCHMARKS=ON and build")
    if "avx2" not in Path("/proc/cpuinfo").read_text(encoding="utf-8").split():
        print("instructions: not counted, this machine has no AVX2, which the reference is for")
        return 0
    found = {"compiler": _compiler(Path(arguments[0])), "instruction_set": "avx2"}
    found["instructions"] = {case: _count(driver, case) for case in CASES}
    if "--renew" in arguments:
        REFERENCE.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
        print(f"instructions: wrote {REFERENCE}")
        return 0
    return _compare(found, json.loads(REFERENCE.read_text(encoding="utf-8")))


def _compare(found: dict, reference: dict) -> int:
    if found["compiler"] != reference["compiler"]:
        return _fail(
            f"compiler = {found['compiler']}, must be {reference['compiler']} of the reference; "
            "use it, or renew the reference (--renew) from the last good commit"
        )
    failed = 0
    for case, count in found["instructions"].items():
        before = reference["instructions"][case]
        change = count / before - 1.0
        print(f"instructions: {case:16} {count:12d}  reference {before:12d}  {change:+.2%}")
        if change > TOLERANCE:
            failed = _fail(
                f"{case} = {count} instructions, must not exceed {before} by {TOLERANCE:.0%}; "
                "find what made the step slower, or renew the reference (--renew) and say why"
            )
        elif change < -TOLERANCE:
            print("instructions: the step became faster; renew the reference (--renew)")
    return failed


def _count(driver: Path, case: str) -> int:
    """Instructions of all steps of a case."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    step = _STEP.format("SolidState" if case in SOLID_CASES else "Assembly")
    command += [f"--toggle-collect={step}", str(driver), case]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or collected is None or int(collected[1]) == 0:
        sys.exit(_fail(f"{' '.join(command)} = no count; run it and read its errors"))
    return int(collected[1])


def _compiler(build: Path) -> str:
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    path = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.+)$", cache, re.MULTILINE)
    if path is None:
        sys.exit(_fail(f"{build}/CMakeCache.txt = names no compiler; configure again"))
    version = subprocess.run([path[1], "--version"], capture_output=True, text=True, check=True)
    return version.stdout.splitlines()[0].split(" ", 1)[1]


def _fail(text: str) -> int:
    print(f"instructions: {text}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
