# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the reading in which tensile damage follows the present opening, for ``readings.py``.

They need another kernel, since the law of flexpm has no such option. From the top of a checkout:

    git apply scripts/paper/present_opening.patch
    scripts/setup
    cd scripts/paper && PYTHONPATH=../../build/python /usr/bin/python3 present_opening.py --keep

A point that closes gains its strength back, up to the moment at which it cracks; damage by shear
stays. Keys are those of the runs of the law in use, so these runs have a table of their own.
"""

import subprocess

from common import HERE, options, results

chosen = options(__doc__)
there = subprocess.run(
    ["git", "apply", "--check", "--reverse", HERE / "present_opening.patch"],
    cwd=HERE.parents[1],
    check=False,
)
if there.returncode != 0 and not chosen.dry:
    raise SystemExit("present_opening.patch is not applied (message above); see this script's text")
rows, _ = results("present_opening", chosen)
print(rows[["test", "confinement", "seed", "peak_stress"]].to_string(index=False))
