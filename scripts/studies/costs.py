# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and memory of whole tests by size, in 2D and 3D, for the page "Costs".

Each run is one `flexpm run` with its defaults, on one thread, in a process of its own. The row has
the processor time of this process, which other programs change little, and its largest memory. Rows
that exist are passed over, so that the script can be stopped and started again; all of them take
about an hour. The second command writes the table that the page shows:

    export PYTHONPATH=build/python
    /usr/bin/python3 scripts/studies/costs.py costs.csv
    /usr/bin/python3 scripts/studies/costs.py costs.csv --table doc/costs.csv
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from growing_table import add_row, rows_of

#: Options of `flexpm run` for each row, the quick ones first.
RUNS = (
    "uniaxial --width 0.02 --height 0.04",
    "uniaxial --width 0.04 --height 0.08",
    "uniaxial --width 0.08 --height 0.16",
    "uniaxial --width 0.08 --height 0.16 --model rigid",
    "tension --width 0.08 --height 0.16",
    "brazilian --diameter 0.08",
    "biaxial --width 0.08 --height 0.16 --confinement 4e6",
    "bending --length 0.18 --height 0.04 --notch 0.01",
    "uniaxial --shape cylinder --diameter 0.015 --height 0.03",
    "uniaxial --shape cylinder --diameter 0.015 --height 0.03 --model rigid",
    "triaxial --shape cylinder --diameter 0.015 --height 0.03 --confinement 2e6",
    "brazilian --diameter 0.03 --depth 0.015",
    "uniaxial --shape box --width 0.025 --depth 0.025 --height 0.05",
    "uniaxial --shape box --width 0.025 --depth 0.025 --height 0.05 --model rigid",
    "uniaxial --width 0.16 --height 0.32",
    "triaxial --shape cylinder --diameter 0.025 --height 0.05 --confinement 2e6",
)


def measured(options: str) -> dict[str, object]:
    """Run a test with these options; return its row."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-P", "-m", "flexpm", "run", *options.split(), "--quiet"]
        process = subprocess.Popen(
            [*command, "--out", folder],
            env={**os.environ, "OMP_NUM_THREADS": "1"},
            stdout=subprocess.DEVNULL,
        )
        _, _, usage = os.wait4(process.pid, 0)
        found = json.loads((Path(folder) / "result.json").read_text())
    return {
        "options": options,
        "dimension": "3D" if "depth" in found["inputs"]["specimen"] else "2D",
        "model": found["model"],
        "grains": found["grains"],
        "steps": found["steps"],
        "seconds": round(usage.ru_utime + usage.ru_stime, 1),
        "peak_mb": round(usage.ru_maxrss / 1024),
        "status": found["status"],
    }


def told(seconds: float) -> str:
    """Time in words of a table."""
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.1f} min"


def write_table(rows: list[dict[str, str]], path: Path) -> None:
    """Write what the page shows, by dimension, test and number of grains."""
    rows = sorted(rows, key=lambda row: (row["dimension"], *_order(row)))
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, delimiter="|", lineterminator="\n")
        table.writerow(("", "Test", "Model", "Grains", "Steps", "Time", "Memory"))
        for row in rows:
            test, *options = [part for part in row["options"].split() if part != "--model"]
            shown = " ".join(part for part in options if part not in ("rigid", "flexible"))
            time = told(float(row["seconds"]))
            counts = (f"{int(row[name]):,}".replace(",", " ") for name in ("grains", "steps"))
            cells = (f"``{test} {shown}``", row["model"], *counts, time)
            table.writerow((row["dimension"], *cells, f"{row['peak_mb']} MB"))


def _order(row: dict[str, str]) -> tuple[bool, str, str, int]:
    test = row["options"].split()[0]
    return test != "uniaxial", test, row["model"], int(row["grains"])


def main() -> None:
    """Measure what is missing, or write the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("file", type=Path, help="CSV file of all rows")
    parser.add_argument("--table", type=Path, help="write the table of the page here")
    asked = parser.parse_args()
    rows = rows_of(asked.file)
    if asked.table:
        write_table(rows, asked.table)
        return
    done = {row["options"] for row in rows}
    for options in RUNS:
        if options not in done:
            row = measured(options)
            add_row(asked.file, row, row.values())
            print(*row.values(), flush=True)


if __name__ == "__main__":
    main()
