#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Detect a change of results: small commands and rigs, numbers compared with committed hashes.

    scripts/checks/reference.py [BUILD]            fails if a column of numbers has changed
    scripts/checks/reference.py [BUILD] --renew    writes the reference, after a wanted change
    scripts/checks/reference.py --installed        the same check of the flexpm that is installed

BUILD is the build folder (default: build). The commands are five 2D tests with flexible and with
rigid grains, compression of inner particles, tension of YADE's two models and a study of two runs;
five 3D tests with flexible and with rigid grains; a 2D specimen with a joint; one custom rig in 2D
and one in 3D, with a seated support, a soft machine and a node set. --quick does nine of the 2D
runs, with the instruction set that flexpm chooses.
Each column of curve.csv and cracks.csv has a hash of its numbers: a file's layout may change, and a
renamed column is renamed in reference.json. Runs that reach all lanes are repeated with each
instruction set of this machine, which must give the same hashes.

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

PACKED = ("--seed", "1")
RECTANGLE = ("--width", "0.012", "--height", "0.024", *PACKED)
DISC = ("--diameter", "0.016", *PACKED)
TESTS = {
    "uniaxial": (*RECTANGLE, "--rate", "4"),
    "tension": (*RECTANGLE, "--rate", "1"),
    "biaxial": (*RECTANGLE, "--rate", "4", "--confinement", "5e6"),
    "brazilian": (*DISC, "--rate", "0.5"),
    "scb": ("--diameter", "0.02", *PACKED, "--rate", "4"),
}
#: Solids, far too fast to be quasi-static: small, and with cracks.
SOLID_PACKED = ("--seed", "1", "--material", "augig3d-calibrated", "--rate", "16")
SOLID_TESTS = {
    "uniaxial": ("--shape", "cylinder", "--diameter", "0.009", "--height", "0.018"),
    "triaxial": (
        *("--shape", "box", "--width", "0.008", "--depth", "0.008", "--height", "0.016"),
        *("--confinement", "1e6,3e6", "--max-strain", "0.008"),
    ),
    "shear": ("--width", "0.016", "--height", "0.008", "--depth", "0.008"),
    "brazilian": ("--diameter", "0.012", "--depth", "0.008", "--jaw-radius", "0.009"),
    "scb": ("--diameter", "0.02", "--depth", "0.008"),
}
MODELS = ("flexible", "rigid")
#: The joint that cuts the rectangle, a table as of --joints, and its law.
JOINT_TABLE = "x1,y1,x2,y2,name\n-0.001,0.004,0.013,0.018,fault\n"
JOINT_LAW = ("friction=0.3", "normal_stiffness=1e13", "shear_stiffness=3e12", "cohesion=1e6")
JOINT = [word for rule in JOINT_LAW for word in ("--set", f"joint.fault.{rule}")]
#: Arguments of `flexpm run`, by the name of the run; {work} is the folder with the files below.
RUNS = {
    **{
        f"{test} {model}": (test, "--model", model, *TESTS[test])
        for model in MODELS
        for test in TESTS
    },
    "uniaxial inner": ("uniaxial", "--model", "inner", *TESTS["uniaxial"]),
    "tension jcfpm": ("tension", "--model", "jcfpm", *TESTS["tension"]),
    "tension cohfrict": ("tension", "--model", "cohfrict", *TESTS["tension"]),
    "uniaxial joint": ("uniaxial", *TESTS["uniaxial"], "--joints", "{work}/joint.csv", *JOINT),
    "tension labels": (
        *("tension", "--specimen", "{work}/labels/grains.json"),
        *("--material", "augig-table7", "--rate", "1"),
    ),
    **{
        f"{test} {model} 3D": (test, "--model", model, *arguments, *SOLID_PACKED)
        for model in MODELS
        for test, arguments in SOLID_TESTS.items()
    },
}
#: Runs of --quick.
QUICK = (
    *(f"{test} flexible" for test in TESTS),
    *("uniaxial rigid", "uniaxial inner", "tension jcfpm", "tension cohfrict"),
)
#: Runs that each instruction set repeats: all lanes, between ends, under jaws and beside a joint.
REPEATED = {
    *(f"{test} {model}" for model in MODELS for test in ("uniaxial", "brazilian")),
    *(f"uniaxial {model} 3D" for model in MODELS),
    *("uniaxial inner", "uniaxial joint"),
}
#: Specimen of an image whose pixels have the number of their grain.
LABELS = """
import numpy as np
import flexpm

draw = np.random.default_rng(1)
rows, columns = np.mgrid[:48, :24]
centres = draw.random((30, 2)) * (48, 24)
distances = (rows[..., None] - centres[:, 0]) ** 2 + (columns[..., None] - centres[:, 1]) ** 2
labels = distances.argmin(axis=2)
flexpm.Specimen.from_labels(labels, pixel=5e-4, thickness=0.08).save("{work}/labels/grains.json")
"""
#: Custom rigs: held nodes, a roller, a seated support and a soft machine.
RIGS = {
    f"rig {model}{name}": f"""
import flexpm

material = flexpm.materials.load("{material}")
built = flexpm.build(flexpm.Specimen.{specimen}, material, model="{model}")
rig = flexpm.{rig}(built, out="{{folder}}")
clamp = rig.hold(box={box})
roller = rig.support({roller})
head = rig.support({head}, seated=True)
rig.drive(head, {direction}, against=[clamp, roller], machine=2e8)
rig.load(flexpm.Loading(kind="waiting", rate=16))
rig.finish()
"""
    for model in MODELS
    for name, material, specimen, rig, box, roller, head, direction in (
        (
            *("", "augig-table7", "rectangle(0.03, 0.01, 0.01, seed=1)", "PartRig"),
            *("((0, 0), (0.006, 0.01))", "(0.014, 0), 0.003", "(0.026, 0.01), 0.004", "(0, -1)"),
        ),
        (
            *(" 3D", "augig3d-calibrated", "box(0.024, 0.008, 0.008, seed=1)", "SolidPartRig"),
            *("((0, 0, 0), (0.005, 0.008, 0.008))", "(0.012, 0.004, 0), (0.004, 0.008, 0.004)"),
            *("(0.021, 0.004, 0.008), (0.004, 0.008, 0.004)", "(0, 0, -1)"),
        ),
    )
}
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
    if not options.quick:
        _write_files(package, work)
    names = QUICK if options.quick else tuple(RUNS)
    jobs = [(name, one) for one in sets for name in names if one == sets[0] or name in REPEATED]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        made = list(pool.map(lambda job: _run(package, work, *job), jobs))
        rigs = [] if options.quick else list(RIGS)
        made_rigs = list(pool.map(lambda name: _rig(package, work, name), rigs))
    found: dict[str, Path] = {}
    failed = 0
    for (name, one), folder in zip(jobs, made, strict=True):
        first = found.setdefault(name, folder)
        if differing := _differing(dict(_hashes(first)), dict(_hashes(folder))):
            failed = _fail(f"{name} = other {differing} with {one} than with {sets[0]}")
    found |= dict(zip(rigs, made_rigs, strict=True))
    if not options.quick:
        found |= _study(package, work)
    numbers = _numbers(package, found)
    hashes = {name: dict(_hashes(folder)) for name, folder in found.items()}
    if failed == 0:
        shutil.rmtree(work)
    print(f"reference: {len(found)} runs, instruction sets {', '.join(sets)}")
    if options.renew:
        return failed or _renew(numbers, hashes)
    return failed or _compare(numbers, hashes, all_runs=not options.quick)


def _write_files(package: Path | None, work: Path) -> None:
    """Write the files that the commands read."""
    (work / "joint.csv").write_text(JOINT_TABLE, encoding="utf-8")
    (work / "labels").mkdir()
    _call(package, LABELS.format(work=work))


def _run(package: Path | None, work: Path, name: str, instruction_set: str) -> Path:
    """Do a run and return its folder."""
    folder = work / instruction_set / name.replace(" ", "-")
    arguments = [word.format(work=work) for word in RUNS[name]]
    _call(package, LAUNCH, instruction_set, "run", *arguments, "--quiet", "--out", str(folder))
    return folder


def _rig(package: Path | None, work: Path, name: str) -> Path:
    """Run the script of a rig and return its folder."""
    folder = work / name.replace(" ", "-")
    _call(package, RIGS[name].format(folder=folder))
    return folder


def _study(package: Path | None, work: Path) -> dict[str, Path]:
    """Do the study and return the folder of each run, in the order of its table."""
    plan, folder = work / "study.toml", work / "study"
    plan.write_text(STUDY, encoding="utf-8")
    command = ["study", str(plan), "--out", str(folder), "--quiet"]
    _call(
        package,
        "import sys; from flexpm.cli.main import main; sys.exit(main(sys.argv[1:]))",
        *command,
    )
    with (folder / "table.csv").open(encoding="utf-8", newline="") as file:
        runs = [next(iter(row.values())) for row in csv.DictReader(file)]
    return {f"study {i + 1}": folder / "runs" / run for i, run in enumerate(runs)}


def _call(package: Path | None, script: str, *arguments: str) -> None:
    """Run a script of Python; a status other than ``ok`` (exit code 3) is a result, too."""
    done = _child(package, [PYTHON, "-P", "-c", script, *arguments])
    if done.returncode not in (0, 3):
        sys.exit(_fail(f"{arguments or script} = exit code {done.returncode}: {done.stderr}"))


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


def _numbers(package: Path | None, found: dict[str, Path]) -> dict[str, int]:
    """Results number of each run."""
    files = [str(folder / "result.json") for folder in found.values()]
    script = f"""
from pathlib import Path
from flexpm.runs.asked import read_inputs, read_own
from flexpm.runs.run_spec import results_of
for file in map(Path, {files}):
    own = read_own(file)
    print(results_of((own or read_inputs(file))[0]))
"""
    return dict(zip(found, map(int, _ask(package, script).split()), strict=True))


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
