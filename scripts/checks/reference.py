#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Detect a change of results: fourteen small commands, numbers compared with committed hashes.

    scripts/checks/reference.py [BUILD]            fails if a column of numbers has changed
    scripts/checks/reference.py [BUILD] --renew    writes the reference, after a wanted change
    scripts/checks/reference.py --installed        the same check of the flexpm that is installed

BUILD is the build folder (default: build). The commands are five tests with flexible and with
rigid grains, compression of inner particles, tension of YADE's two models and a study of two runs;
--quick does nine of the single runs, with the instruction set that flexpm chooses.
Each column of curve.csv and cracks.csv has a hash of its numbers: a file's layout may change, and a
renamed column is renamed in reference.json. The single runs are repeated with each instruction set
of this machine, which must give the same hashes.

The check only detects change; that results are right is shown by the other tests. A wanted change
raises the results number of its test and model, by which finished runs are told from outdated ones
(flexpm.runs.run_spec): --renew refuses other hashes under the same number, and takes new
columns.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = Path(__file__).with_name("reference.json")
PYTHON = "/usr/bin/python3"

RECTANGLE = ("--width", "0.012", "--height", "0.024", "--seed", "1")
DISC = ("--diameter", "0.016", "--seed", "1")
TESTS = {
    "uniaxial": (*RECTANGLE, "--rate", "4"),
    "tension": (*RECTANGLE, "--rate", "1"),
    "biaxial": (*RECTANGLE, "--rate", "4", "--confinement", "5e6"),
    "brazilian": (*DISC, "--rate", "0.5"),
    "scb": ("--diameter", "0.02", "--seed", "1", "--rate", "4"),
}
RUNS = (
    *((test, model) for model in ("flexible", "rigid") for test in TESTS),
    ("uniaxial", "inner"),
    ("tension", "jcfpm"),
    ("tension", "cohfrict"),
)
#: Those of --quick.
QUICK = (*((test, "flexible") for test in TESTS), ("uniaxial", "rigid"), *RUNS[-3:])
STUDY = """[common]
test = "tension"
width = 0.012
height = 0.024
seed = 1
[grid]
"set.cohesion" = [2e7, 3e7]
"""
#: The command with the instruction set that its first argument names.
LAUNCH = """
import sys
import flexpm
from flexpm.cli.main import main
flexpm._flexpm.use_instruction_set(sys.argv[1])
sys.exit(main(sys.argv[2:]))
"""
#: Test and model of the study's runs.
STUDY_KIND = ("tension", "flexible")


def main(arguments: list[str]) -> int:
    """Run the commands, then compare or renew."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", nargs="?", type=Path, default=ROOT / "build")
    parser.add_argument("--installed", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--renew", action="store_true")
    options = parser.parse_args(arguments)
    if options.renew and (options.quick or options.installed):
        parser.error("--renew writes all hashes, of a build; leave out --quick and --installed")
    # None: where Python looks by itself
    package = None if options.installed else options.build.resolve() / "python"
    if package and not (package / "flexpm").is_dir():
        return _fail(f"{package}/flexpm = missing; build first (scripts/setup)")
    sets = _ask(package, "print(*flexpm._flexpm.instruction_sets())").split()
    if options.quick:
        sets = [_ask(package, "print(flexpm._flexpm.instruction_set())").strip()]
    work = Path(tempfile.mkdtemp(prefix="flexpm-reference-"))
    runs = QUICK if options.quick else RUNS
    jobs = [(test, model, name) for name in sets for test, model in runs]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        made = list(pool.map(lambda job: _run(package, work, *job), jobs))
    found: dict[str, dict[str, str]] = {}
    failed = 0
    for (test, model, name), hashes in zip(jobs, made, strict=True):
        first = found.setdefault(f"{test} {model}", hashes)
        if differing := _differing(first, hashes):
            failed = _fail(f"{test} {model} = other {differing} with {name} than with {sets[0]}")
    if not options.quick:
        found |= _study(package, work)
    numbers = _numbers(package, list(found))
    if failed == 0:
        shutil.rmtree(work)
    print(f"reference: {len(found)} runs, instruction sets {', '.join(sets)}")
    if options.renew:
        return failed or _renew(numbers, found)
    return failed or _compare(numbers, found, all_runs=not options.quick)


def _run(
    package: Path | None, work: Path, test: str, model: str, instruction_set: str
) -> dict[str, str]:
    """Hashes of the columns of one run."""
    folder = work / instruction_set / f"{test}-{model}"
    command = [PYTHON, "-P", "-c", LAUNCH, instruction_set, "run", test, "--model", model]
    command += [*TESTS[test], "--quiet", "--out", str(folder)]
    done = _child(package, command)
    if done.returncode not in (0, 3):
        sys.exit(_fail(f"{' '.join(command[4:])} = exit code {done.returncode}: {done.stderr}"))
    return dict(_hashes(folder))


def _study(package: Path | None, work: Path) -> dict[str, dict[str, str]]:
    """Hashes of the columns of each run of a study, in the order of its table."""
    plan, folder = work / "study.toml", work / "study"
    plan.write_text(STUDY, encoding="utf-8")
    command = [PYTHON, "-P", "-m", "flexpm", "study", str(plan), "--out", str(folder), "--quiet"]
    done = _child(package, command)
    if done.returncode != 0:
        sys.exit(_fail(f"study = exit code {done.returncode}: {done.stderr}"))
    with (folder / "table.csv").open(encoding="utf-8", newline="") as file:
        runs = [next(iter(row.values())) for row in csv.DictReader(file)]
    return {f"study {i + 1}": dict(_hashes(folder / "runs" / run)) for i, run in enumerate(runs)}


def _hashes(folder: Path) -> Iterator[tuple[str, str]]:
    """Name and hash of each column; numbers count by their value, texts by their letters."""
    for name in ("curve.csv", "cracks.csv"):
        with (folder / name).open(encoding="utf-8", newline="") as file:
            header, *rows = csv.reader(file)
        for column, heading in enumerate(header):
            text = " ".join(_canonical(row[column]) for row in rows)
            yield f"{name} {heading}", hashlib.sha256(text.encode()).hexdigest()[:16]


def _canonical(cell: str) -> str:
    try:
        return float(cell).hex()
    except ValueError:
        return cell


def _numbers(package: Path | None, names: list[str]) -> dict[str, int]:
    """Results number of each run."""
    kinds = [STUDY_KIND if name.startswith("study") else tuple(name.split()) for name in names]
    script = "from flexpm.materials import load; from flexpm.runs.run_spec import RunSpec\n"
    script += "runs = ((t, {'model': m}, load(None, m)) for t, m in " + f"{kinds})\n"
    script += "print(*(RunSpec.from_options(*run).results for run in runs))"
    return dict(zip(names, map(int, _ask(package, script).split()), strict=True))


def _compare(numbers: dict[str, int], found: dict[str, dict[str, str]], all_runs: bool) -> int:
    reference = json.loads(REFERENCE.read_text(encoding="utf-8"))
    failed = 0
    for run in {**(reference if all_runs else {}), **found}:
        before = reference.get(run, {"results": None, "hashes": {}})
        if numbers.get(run) != before["results"]:
            failed = _fail(
                f"{run} has results number {numbers.get(run)}, must be {before['results']} of the "
                "reference; renew it (--renew) in the commit that changes the number"
            )
        differing = _differing(before["hashes"], found.get(run, {}))
        if differing:
            failed = _fail(
                f"{run} = other {differing}; find out why, or, if it is wanted, raise the results "
                "number of its test and model and renew the reference (--renew)"
            )
    if not failed:
        print("reference: no change")
    return failed


def _renew(numbers: dict[str, int], found: dict[str, dict[str, str]]) -> int:
    reference = json.loads(REFERENCE.read_text(encoding="utf-8")) if REFERENCE.exists() else {}
    for run, before in reference.items():
        # a column that is new changes no result
        known = {name: found.get(run, {}).get(name) for name in before["hashes"]}
        if before["hashes"] != known and numbers[run] <= before["results"]:
            return _fail(
                f"{run} has results number {numbers[run]}, must be above {before['results']}, "
                "since its hashes changed; raise it in flexpm.runs.run_spec"
            )
    content = {run: {"results": numbers[run], "hashes": found[run]} for run in found}
    REFERENCE.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    print(f"reference: wrote {REFERENCE}")
    return 0


def _differing(one: dict[str, str], other: dict[str, str]) -> str:
    """Columns of which the hashes differ, or which only one has."""
    return ", ".join(name for name in {**one, **other} if one.get(name) != other.get(name))


def _ask(package: Path | None, question: str) -> str:
    done = _child(package, [PYTHON, "-P", "-c", f"import flexpm\n{question}"])
    if done.returncode != 0:
        sys.exit(_fail(f"{question} = exit code {done.returncode}: {done.stderr}"))
    return done.stdout


def _child(package: Path | None, command: list[str]) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(package or ""), "OMP_NUM_THREADS": "1"}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


def _fail(text: str) -> int:
    print(f"reference: {text}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
