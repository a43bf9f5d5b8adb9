#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let calls to the file system fail, one in each run, and see that nothing finished is lost.

    scripts/checks/faults.py [run] [core] [confined] [solid-disc] [study] [calibration]
                             [--draw N] [--seed S] [--part K/N] [--build DIR]

A small command, of the plane or of a solid, is traced (strace): each write, rename, unlink and
fsync below its folder is a place by call and file name. At the first and the last call of each
place the process is killed, or the call gives EIO or ENOSPC. After the fault every file under its
final name is whole; a process that was not killed has ended with a documented exit code and one
line. The same command again, without a fault, ends with the bits of an undisturbed one and leaves
nothing behind. --draw takes N of the faults by chance, of a seed that is printed; --part 2/3 takes
every third from the second, for several processes side by side.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
CALLS = ("write", "writev", "rename", "unlink", "fsync")
FAULTS = ("signal=KILL", "error=EIO", "error=ENOSPC")
#: Exit codes of a process that met an error, or of one whose child was killed.
CODES = (0, 1, 2, 3)
#: Runs of a second or so: one of the plane, then those of solids.
CORE = ("--diameter", "0.009", "--height", "0.012", "--rate", "8")
RUNS = {
    "run": ("tension", "--width", "0.012", "--height", "0.024", "--rate", "4"),
    "core": ("uniaxial", "--shape", "cylinder", *CORE),
    "confined": ("triaxial", *CORE, "--confinement", "5e6", "--max-strain", "2e-3"),
    "solid-disc": ("brazilian", "--diameter", "0.012", "--depth", "0.008", "--rate", "2"),
}
STUDY = """[common]
test = "tension"
width = 0.012
height = 0.024
rate = 8.0
[grid]
seed = [1, 2]
[[picture]]
x = "seed"
y = "peak_stress"
file = "peaks.png"
"""
CALIBRATION = """[calibration]
name = "found"
evaluations = 3
rounds = 1
candidates = 1
[common]
width = 0.012
height = 0.024
rate = 8.0
[screen]
seeds = [1]
[verify]
seeds = [2]
[target]
direct_tensile_strength = { value = 8e6, tolerance = 0.5 }
[free]
tensile_strength = [2e6, 30e6]
"""
#: Names of all campaigns.
CAMPAIGNS = (*RUNS, "study", "calibration")
#: A traced call: process, name, arguments.
_TRACED = re.compile(r"^(\d+) +(\w+)\((.*)$")
#: Parts of a name that differ from run to run.
_CHANGING = ((r"-[0-9a-f]{8,}\.", "-*."), (r"checkpoint-\d+(\.1)?", "checkpoint-N"))
#: Wall time between two checkpoints of a run, in its module.
_INTERVAL = re.compile(r"^INTERVAL = [\d.]+$", re.MULTILINE)
#: A run's measures that are no results.
_TIMES = ("step_time",)
#: The same in a page.
_STEP_TIME = re.compile(rb"(?<=\d) of [\d.e-]+ ms(?=</td>)")


class Place(NamedTuple):
    """A call on a file, both as they are named in all runs."""

    call: str
    file: str


class Fault(NamedTuple):
    """What shall happen at which call of a process, counted from 1."""

    place: Place
    number: int
    kind: str


class Campaign:
    """One command and its faults."""

    def __init__(self, name: str, work: Path, build: Path) -> None:
        self.name, self.work, self.out = name, work, work / "out"
        build = _saving_at_ends(build.resolve(), work / "build")
        self.environment = {**os.environ, "FLEXPM_BUILD_DIR": str(build), "OMP_NUM_THREADS": "1"}
        self.environment["TMPDIR"] = str(work)
        flexpm = str(ROOT / "scripts" / "flexpm")
        for kind, text in (("study", STUDY), ("calibration", CALIBRATION)):
            (work / f"{kind}.toml").write_text(text)
        self.command = {
            **{kind: [flexpm, "run", *words, "--quiet"] for kind, words in RUNS.items()},
            "study": [flexpm, "study", str(work / "study.toml"), "--quiet", "--workers", "1"],
            "calibration": [
                *(flexpm, "calibrate", str(work / "calibration.toml")),
                *("--quiet", "--workers", "1"),
            ],
        }[name]
        self.command += ["--out", str(self.out)]

    def run(self, *before: str) -> subprocess.CompletedProcess[str]:
        """Do the command."""
        return subprocess.run(
            [*before, *self.command],
            cwd=self.work,
            env=self.environment,
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
            timeout=900,
        )

    def strace(self, *options: str) -> list[str]:
        """Command that traces the calls of all processes into a file."""
        calls = f"trace={','.join(CALLS)}"
        log = str(self.work / "trace")
        return ["strace", "-f", "--seccomp-bpf", "-y", "-qq", "-o", log, "-e", calls, *options]

    def calls(self) -> Iterator[tuple[str, Place, int, str]]:
        """Process, place, number of the call in its process, and the line of each traced call."""
        counts: dict[tuple[str, str], int] = {}
        for line in (self.work / "trace").read_text(errors="replace").splitlines():
            if found := _TRACED.match(line):
                process, call, rest = found.groups()
                counts[process, call] = counts.get((process, call), 0) + 1
                if file := self._file(call, rest):
                    yield process, Place(call, file), counts[process, call], line

    def _file(self, call: str, rest: str) -> str:
        """Name below the folder of the file that a call is on, empty if it is elsewhere."""
        names = re.findall(r'"([^"]*)"', rest) if call in ("rename", "unlink") else []
        if call not in ("rename", "unlink") and (opened := re.match(r"\d+<([^>]*)>", rest)):
            names = [opened.group(1)]
        if not names or not names[-1].startswith(f"{self.out}/"):
            return ""
        name = names[-1].removeprefix(f"{self.out}/")
        for pattern, text in _CHANGING:
            name = re.sub(pattern, text, name)
        return re.sub(r"^runs/[0-9a-f]{16}", "runs/K", name)

    def faults(self) -> list[Fault]:
        """Kinds of faults at the first and the last call of each place."""
        seen: dict[Place, list[int]] = {}
        for _, place, number, _ in self.calls():
            seen.setdefault(place, []).append(number)
        return [
            Fault(place, number, kind)
            for place, numbers in sorted(seen.items())
            for number in sorted({numbers[0], numbers[-1]})
            for kind in FAULTS
        ]

    def bits(self) -> dict[str, str]:
        """Hash of each file that a whole run leaves; times left out."""
        found = {}
        for file in sorted(path for path in self.out.rglob("*") if path.is_file()):
            name = str(file.relative_to(self.out))
            content = file.read_bytes()
            if file.suffix == ".json":
                content = json.dumps(_without_times(json.loads(content))).encode()
            if file.suffix == ".html":
                content = _STEP_TIME.sub(b"", content)
            # a scene holds its time of day, and its checksum does
            if not file.name.startswith("checkpoint"):
                found[name] = hashlib.sha256(content).hexdigest()[:16]
        return found

    def try_fault(self, fault: Fault, whole: dict[str, str]) -> tuple[str, Place | None]:
        """What went wrong, empty if nothing did, and where the fault came."""
        shutil.rmtree(self.out, ignore_errors=True)
        inject = f"inject={fault.place.call}:{fault.kind}:when={fault.number}"
        done = self.run(*self.strace("-e", inject))
        hit = [place for _, place, _, line in self.calls() if "(INJECTED)" in line]
        # the call of that number fails in each process, be it on its messages
        elsewhere = sum("(INJECTED)" in line for line in self._lines()) > len(hit)
        if fault.kind.startswith("signal"):
            ends = {line.split()[0] for line in self._lines() if "+++ killed" in line}
            last = {process: place for process, place, _, _ in self.calls() if process in ends}
            hit = list(last.values())
        killed = done.returncode in (-9, 137)
        if not killed and done.returncode not in CODES:
            return f"exit code {done.returncode}: {done.stderr[-300:]}", None
        if not (killed or elsewhere) and done.returncode and done.stderr.count("\n") != 1:
            return f"{done.stderr.count(chr(10))} lines on stderr: {done.stderr[-600:]}", None
        if half := self._half_files(whole):
            return f"half a file: {half}", None
        again = self.run()
        if again.returncode != self.code:
            return f"restart: exit code {again.returncode}: {again.stderr[-300:]}", None
        found = self._asked_for(whole)
        if fault.place.call == "unlink":  # a lock that the disk keeps holds nobody up
            found = {name: found[name] for name in found if not name.endswith(".flexpm.lock")}
        if differing := _differing(whole, found):
            return f"restart: other {differing}", None
        return "", (hit or [None])[0]

    def _asked_for(self, whole: dict[str, str]) -> dict[str, str]:
        """Bits without runs that only the disturbed command did: a failed one turns a search."""
        runs = {Path(name).parent for name in whole}
        found = self.bits()
        if self.name != "calibration":
            return found
        return {name: found[name] for name in found if Path(name).parent in runs}

    def _lines(self) -> list[str]:
        return (self.work / "trace").read_text(errors="replace").splitlines()

    def _half_files(self, whole: dict[str, str]) -> str:
        """Files under their final names that are not those of an undisturbed run."""
        found = self.bits()
        return ", ".join(
            name
            for name, bits in found.items()
            if name in whole and not self._may_differ(name) and bits != whole[name]
        )

    def _may_differ(self, name: str) -> bool:
        """A study tells in some files how its runs ended, which the fault may have changed."""
        return (self.name not in RUNS and not name.startswith("runs/")) or "outcome.json" in name

    def reference(self) -> dict[str, str]:
        """Bits of an undisturbed run, whose trace is kept."""
        shutil.rmtree(self.out, ignore_errors=True)
        done = self.run(*self.strace())
        if done.returncode not in (0, 3):
            sys.exit(f"faults: {self.name} = exit code {done.returncode}: {done.stderr}")
        self.code = done.returncode
        return self.bits()


def _saving_at_ends(build: Path, place: Path) -> Path:
    """A build at `place` whose runs save at their ends alone.

    On a slow machine, runs would also save and write their tables in between, and other calls would
    be hit than those that were traced.
    """
    package, runs = (Path("python", "flexpm", *names) for names in ((), ("runs",)))
    (place / runs).mkdir(parents=True)
    for folder, changed in ((package, runs), (runs, runs / "checkpoint.py")):
        for entry in (build / folder).iterdir():
            if folder / entry.name != changed:
                (place / folder / entry.name).symlink_to(entry)
    text, count = _INTERVAL.subn("INTERVAL = 1e9", (build / runs / "checkpoint.py").read_text())
    if count != 1:
        sys.exit(f"faults: checkpoint.py = {count} intervals, must have one; adapt _INTERVAL here")
    (place / runs / "checkpoint.py").write_text(text)
    return place


def main() -> int:
    """Do the campaigns that are named."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(CAMPAIGNS))
    parser.add_argument("--draw", type=int, metavar="N", help="so many of the faults by chance")
    parser.add_argument("--seed", type=int, default=1, metavar="S")
    parser.add_argument("--part", default="1/1", metavar="K/N", help="every Nth from the Kth")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="build folder")
    options = parser.parse_args()
    if not shutil.which("strace"):
        sys.exit("faults: strace = not found; install the package strace")
    failed = 0
    for name in options.names or ("run", "study"):
        with tempfile.TemporaryDirectory(prefix="flexpm-faults-") as folder:
            failed += _campaign(Campaign(name, Path(folder).resolve(), options.build), options)
    return 1 if failed else 0


def _campaign(campaign: Campaign, options: argparse.Namespace) -> int:
    whole = campaign.reference()
    faults = campaign.faults()
    places = {fault.place for fault in faults}
    chosen = faults
    if options.draw is not None:
        chosen = random.Random(options.seed).sample(faults, min(options.draw, len(faults)))
    first, step = map(int, options.part.split("/"))
    chosen = chosen[first - 1 :: step]
    failed, hit = 0, set()
    for number, fault in enumerate(chosen, 1):
        wrong, place = campaign.try_fault(fault, whole)
        hit |= {place} - {None}
        failed += bool(wrong)
        where = f"{fault.kind} at {fault.place.call} {fault.number} of {fault.place.file}"
        print(
            f"faults: {campaign.name} {number}/{len(chosen)} {where}: {wrong or 'ok'}", flush=True
        )
    print(
        f"faults: {campaign.name}: {len(chosen)} faults (seed {options.seed}) of {len(faults)}, "
        f"{len(hit)} of {len(places)} places hit, {failed} failed"
    )
    return failed


def _without_times(content: object) -> object:
    if isinstance(content, dict):
        return {key: _without_times(value) for key, value in content.items() if key not in _TIMES}
    return content


def _differing(one: dict[str, str], other: dict[str, str]) -> str:
    return ", ".join(name for name in {**one, **other} if one.get(name) != other.get(name))


if __name__ == "__main__":
    sys.exit(main())
