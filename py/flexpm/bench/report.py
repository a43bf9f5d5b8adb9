# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of steps as a table and as plain data. Times in seconds.

A ratio of two models is the median, over the rounds, of the ratio within a round.
"""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median, quantiles

import yade

from .._version import __version__
from ..files import Table
from ..report.style import drawing
from ..report.tables import scaled

#: Model to which the others are compared.
REFERENCE = "jcfpm"
#: Load of a machine on which a second core is free.
_FREE = 0.5
#: Ratios of the paper, Sec. 4: (model, to model, uniaxial, Brazilian).
PAPER_RATIOS = (("refined", "rigid", 8.15, 4.79), ("inner", "refined", 3.03, 1.21))


@dataclass
class Case:
    """A model in its scene, with its times."""

    name: str
    label: str
    scene: int
    counts: Mapping[str, int]
    times: list[float] = field(default_factory=list)  #: wall time of a step, turn by turn [s]
    cpu_times: list[float] = field(default_factory=list)  #: of the calling thread alone [s]

    @property
    def step_time(self) -> float:
        """Median wall time of a step [s]."""
        return median(self.times)


@dataclass
class Timing:
    """Result of a comparison."""

    machine: dict[str, str | int]
    specimen: dict[str, float | int | None]
    threads: int
    steps: int  #: of each model
    cases: list[Case]

    def ratio(self, name: str, reference: str = REFERENCE) -> float:
        """Return the median of the round-wise ratios of a model's time to `reference` [-]."""
        times = {case.name: case.times for case in self.cases}
        return median(a / b for a, b in zip(times[name], times[reference], strict=True))

    def _to_reference(self, name: str) -> dict[str, float]:
        known = any(case.name == REFERENCE for case in self.cases)
        return {f"ratio_to_{REFERENCE}": self.ratio(name)} if known else {}

    def as_dict(self) -> Table:
        """Return the result as plain data, with ratios and spreads."""
        cases = {}
        for case in self.cases:
            low, _, high = quantiles(case.times, n=4) if len(case.times) > 1 else case.times * 3
            cases[case.name] = {
                "label": case.label,
                "step_time": case.step_time,
                "quartiles": [low, high],
                "cpu_time": median(case.cpu_times) if self.threads == 1 else None,
                **self._to_reference(case.name),
                **case.counts,
            }
        return {
            "machine": self.machine,
            "specimen": self.specimen,
            "threads": self.threads,
            "steps": self.steps,
            "turns": len(self.cases[0].times),
            "models": cases,
        }


def machine() -> dict[str, str | int]:
    """Return the machine and the versions of a measurement."""
    names = [
        line.partition(":")[2].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if line.startswith("model name")
    ]
    return {
        "processor": names[0] if names else platform.machine(),
        "cores": max(len(names), 1),
        "system": platform.platform(),
        "flexpm": __version__,
        "yade": yade.config.version,
        "python": platform.python_version(),
    }


def host_rows(timing: Timing) -> list[tuple[str, str]]:
    """Describe machine and specimen of a comparison as rows (name, value)."""
    host, counts = timing.machine, timing.cases[0].counts
    rows = [
        ("processor", f"{host['processor']}, {host['cores']} cores, {timing.threads} used"),
        ("versions", _versions(host)),
        ("grains, contacts", f"{counts['grains']}, {counts['contacts']}"),
        ("steps of each model", f"{timing.steps} in {len(timing.cases[0].times)} repetitions"),
    ]
    if timing.threads == 1:
        share = median(
            own / wall
            for case in timing.cases
            for own, wall in zip(case.cpu_times, case.times, strict=True)
        )
        rows.append(("share of a core", f"{100.0 * share:.0f} %"))
    return rows


def table_rows(timing: Timing) -> list[tuple[str, str]]:
    """Describe a comparison as rows (name, value)."""
    counts = timing.cases[0].counts
    rows = host_rows(timing)
    rows.insert(3, ("nodes, triangles", f"{counts['nodes']}, {counts['triangles']}"))
    for case in timing.cases:
        ratio = f"{timing.ratio(case.name):.3f} of JCFpm's" if case.name != REFERENCE else "1"
        rows.append((case.label, f"{scaled(case.step_time, 1e6, 'us')}, {ratio}"))
    return rows + _paper_rows(timing, "uniaxial")


def _versions(host: dict[str, str | int]) -> str:
    return f"flexpm {host['flexpm']}, YADE {host['yade']}, Python {host['python']}"


def disc_rows(timing: Timing) -> list[tuple[str, str]]:
    """Describe the models of a Brazilian test as rows (name, value)."""
    return _paper_rows(timing, "brazilian")


def _paper_rows(timing: Timing, test: str) -> list[tuple[str, str]]:
    known = {case.name for case in timing.cases}
    return [
        (
            f"{name} / {other}, {test}",
            f"{timing.ratio(name, other):.2f}, paper {uniaxial if test == 'uniaxial' else disc}",
        )
        for name, other, uniaxial, disc in PAPER_RATIOS
        if {name, other} <= known
    ]


def threads_rows(found: dict[str, float | int]) -> list[tuple[str, str]]:
    """Describe the comparison of two threads with a single thread as rows (name, value)."""
    word = "" if found["load"] < _FREE else f"; the cores were not free (load {found['load']:.1f})"
    return [("two threads", f"{found['gain']:.2f} times as fast as one{word}")]


def size_rows(found: dict[str, float | int]) -> list[tuple[str, str]]:
    """Describe set-up, memory and files as rows (name, value)."""
    return [
        (
            "set-up",
            f"specimen {found['specimen_time']:.1f} s, model {found['model_time']:.2f} s, "
            f"first step {found['first_step_time']:.2f} s",
        ),
        ("memory", f"{found['memory_per_grain'] / 1024:.1f} KiB a grain"),
        ("one .vtu", f"{found['vtu_time']:.2f} s"),
    ]


def scaling_rows(found: list[dict[str, float | int]]) -> list[tuple[str, str]]:
    """Describe the times for growing specimens as rows (name, value)."""
    base = found[0]["time_per_grain"]
    rows = []
    for row in found:
        name = f"{row['grains']} grains"
        share = row["bandwidth"] / row["triad"]
        rows.append(
            (
                name,
                f"{scaled(row['step_time'], 1e6, 'us')}, "
                f"{scaled(row['time_per_grain'], 1e9, 'ns', 3)} a grain "
                f"({row['time_per_grain'] / base:.2f} of the first), "
                f"{row['bandwidth'] * 1e-9:.1f} GB/s, {share:.0%} of the triad's",
            )
        )
        rows += [(f"{name}: {label}", text) for label, text in size_rows(row)]
    return rows


def scaling_picture(path: Path, found: list[dict[str, float | int]]) -> None:
    """Plot the time per grain and step over the number of grains."""
    with drawing(path) as axes:
        times = [1e9 * row["time_per_grain"] for row in found]
        axes.plot([row["grains"] for row in found], times, "o-", color="black")
        axes.set_xscale("log")
        axes.set_xlabel("grains")
        axes.set_ylabel("time per grain and step [ns]")
        axes.set_ylim(0.0, 1.1 * max(times))  # room for the highest mark
