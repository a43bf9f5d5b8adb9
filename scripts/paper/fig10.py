# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 10 of the paper: crack maps of rigid, flexible and inner-particle grains, half size."""

import subprocess
import sys

from common import options

COMMAND = "--models rigid,flexible,inner --material augig-table2-bilinear --seed 1"
HALF_SIZE = {
    "brazilian": "--diameter 0.04",
    "tension": "--width 0.04 --height 0.08",
    "uniaxial": "--width 0.04 --height 0.08",
}

chosen = options(__doc__)
for test, size in HALF_SIZE.items():
    folder = chosen.out / "fig10" / test
    arguments = ["compare", test, *COMMAND.split(), *size.split(), "--out", str(folder)]
    if not chosen.dry:
        subprocess.run([sys.executable, "-m", "flexpm", *arguments], check=True)
    print(folder / "cracks.png")
