#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure the cases of the verification book and write its table; rows that are there are kept.

Start it from a checkout that scripts/setup has built; the second command only writes the table of
the documentation, ``book.csv``, from ``measured.csv``:

    PYTHONPATH=build/python /usr/bin/python3 tests/helpers/book.py [CASE ...]
    /usr/bin/python3 tests/helpers/book.py --table
"""

from __future__ import annotations

import argparse
import csv
import math
import statistics
import subprocess
import sys
from collections.abc import Iterable
from itertools import product
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parents[1] / "verification"
MEASURED, BOOK = HERE / "measured.csv", HERE / "book.csv"
FIELDS = ("case", "fineness", "number", "grains", "ratio", "commit")
HEADER = ("quantity", "formula", "source", "at", "error [%]", "runs", "order")


class Case(NamedTuple):
    """What the book says of a case beside its numbers."""

    quantity: str
    formula: str
    source: str
    at: str  #: what a fineness is
    finenesses: tuple[float, ...]  #: the last with the error that the book claims
    numbers: tuple[int, ...]  #: seeds of packings, or pressures
    converges: bool = True  #: the error falls with the fineness; else it is that of packings


_ACROSS, _RATE, _SEEDS = "{:g} grains across", "rate {:g}", tuple(range(1, 6))


def _both(name: str, case: Case) -> dict[str, Case]:
    """A case of flexible and of rigid grains."""
    return {
        f"{name} {model}": case._replace(quantity=f"{case.quantity}, {model} grains")
        for model in ("flexible", "rigid")
    }


CASES = {
    **_both(
        "vp",
        Case(
            "v_p",
            "sqrt(E / (rho (1 - nu^2)))",
            "plane wave, plane stress",
            *(_ACROSS, (27, 54), _SEEDS, False),
        ),
    ),
    **_both(
        "vs",
        Case(
            "v_s",
            "sqrt(E / (2 rho (1 + nu)))",
            "plane wave",
            *(_ACROSS, (27, 54), _SEEDS, False),
        ),
    ),
    **_both(
        "onset",
        Case("onset of slip of two blocks", "c + mu sigma_n", "Coulomb", _RATE, (1, 4), (1, 2, 4)),
    ),
    **_both(
        "sliding",
        Case(
            "shear test of a joint, largest stress",
            "mu sigma_n",
            "Coulomb",
            *(_RATE, (0.25, 0.5, 1.0), (1, 2, 3)),
        ),
    ),
    **_both(
        "sliding far",
        Case(
            "shear test of a joint over three mean diameters, mean stress",
            "mu sigma_n",
            "Coulomb",
            *(_RATE, (0.1, 0.2), (1, 2, 3), False),
        ),
    ),
    "K_I beam": Case(
        "K_I of a beam, a / H = 0.2 to 0.6",
        "three-point bending, S = 2.5 H",
        "Guinea, Pastor, Planas, Elices 1998",
        *(_ACROSS, (20, 40, 80), _SEEDS),
    ),
    "K_I half-disc": Case(
        "K_I of half a disc, a / R = 0.4 to 0.6",
        "Y' of the suggested method, S = 1.2 R",
        "Kuruppu et al. 2014 (ISRM)",
        *(_ACROSS, (20, 40, 80), _SEEDS),
    ),
    "closed crack": Case(
        "slip of a closed crack at 45°, mu = 0",
        "4 tau sqrt(a^2 - x^2) / E",
        "Pollard, Segall 1987",
        *("a = {:g} grains", (5, 10, 20), _SEEDS),
    ),
    "rubbing crack": Case(
        "slip of a closed crack at 45°, mu = 0.3",
        "4 (tau - mu sigma_n) sqrt(a^2 - x^2) / E",
        "Pollard, Segall 1987",
        *("a = {:g} grains", (5, 10), _SEEDS, False),
    ),
    "kink": Case(
        "first cracks from a closed crack at 45°, mu = 0",
        "70.5° to the crack",
        "largest hoop stress, Erdogan, Sih 1963",
        *("a = {:g} grains", (5, 10), tuple(range(1, 11)), False),
    ),
    "strip opened": Case(
        "strip opened by end moments",
        "M = sqrt(G_fn t B)",
        "beams, Griffith",
        *("arms of {:g} grains", (4, 8), (1,), False),
    ),
    "strip sheared": Case(
        "strip sheared by end moments",
        "M = sqrt(G_fs t B / 0.75)",
        "beams, Griffith",
        *("arms of {:g} grains", (4, 8), (1,), False),
    ),
}

Row = dict[str, str]


def read() -> list[Row]:
    """Rows that have been measured."""
    if not MEASURED.exists():
        return []
    with MEASURED.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def book(rows: Iterable[Row]) -> list[list[str]]:
    """Rows of the table: one for each case and fineness, with the mean of its runs."""
    found: dict[tuple[str, float], list[float]] = {}
    for row in rows:
        error = 100.0 * (float(row["ratio"]) - 1.0)
        found.setdefault((row["case"], float(row["fineness"])), []).append(error)
    lines: list[list[str]] = []
    for name, case in CASES.items():
        before: tuple[float, float] | None = None
        for fineness in sorted(one for known, one in found if known == name):
            errors = found[name, fineness]
            mean, order = statistics.mean(errors), ""
            if before is not None and case.converges:
                order = f"{math.log(before[1] / mean) / math.log(fineness / before[0]):.1f}"
            place = case.at.format(fineness if case.at != _RATE else 1.0 / fineness)
            shown = f"{mean:+.2f}"
            if len(errors) > 1:
                shown += f" ± {statistics.stdev(errors) / math.sqrt(len(errors)):.2f}"
            about = (case.quantity, case.formula, case.source)
            lines.append([*about, place, shown, str(len(errors)), order])
            before = (fineness, mean)
    return lines


def write_book(rows: Iterable[Row]) -> None:
    """Write the table of the documentation."""
    with BOOK.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *book(rows)])


def measure(names: list[str]) -> None:
    """Measure what is not there yet."""
    import book_cases  # loads YADE

    commit = subprocess.run(
        ["git", "describe", "--always", "--dirty=+"],
        **{"check": True, "capture_output": True, "text": True, "cwd": HERE},
    ).stdout.strip()
    there = {(row["case"], float(row["fineness"]), int(row["number"])) for row in read()}
    new = not MEASURED.exists()
    with MEASURED.open("a", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        if new:
            table.writerow(FIELDS)
        for name in names or CASES:
            for fineness, number in product(CASES[name].finenesses, CASES[name].numbers):
                if (name, fineness, number) in there:
                    continue
                found = book_cases.CASES[name](fineness, number)
                table.writerow([name, fineness, number, found.grains, repr(found.ratio), commit])
                file.flush()
                print(name, fineness, number, found.ratio, flush=True)


def main() -> None:
    """Do what the command line asks for."""
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("case", nargs="*", metavar="CASE", help=", ".join(CASES))
    parser.add_argument("--table", action="store_true", help="write book.csv alone")
    options = parser.parse_args()
    if unknown := set(options.case) - set(CASES):
        parser.error(f"case = {', '.join(sorted(unknown))}, must be one of {', '.join(CASES)}")
    if not options.table:
        measure(options.case)
    write_book(read())


if __name__ == "__main__":
    sys.exit(main())
