# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 9: calibration of your rock, then a test with the calibrated material.

calibration.toml has the properties of the rock and the keys that may change. The command carries
out all runs. If it is started again, it resumes and does not repeat finished runs.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/calibration.py [FOLDER]
"""

import subprocess
import sys
from pathlib import Path

import flexpm

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "my-rock")
rock = Path(__file__).with_name("calibration.toml")

# 1. This is the command: flexpm calibrate calibration.toml --out my-rock
command = [sys.executable, "-P", "-m", "flexpm", "calibrate", str(rock), "--out", str(folder)]
subprocess.run([*command, "--quiet"], check=True)

# 2. The result is a file of a material. A packing that was not used in the calibration tests it.
material = flexpm.materials.load(folder / "my-rock.toml")
specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=3)
result = flexpm.run("uniaxial", specimen, material, "rigid", stop_ratio=0.9)
print(f"E = {result.youngs_modulus / 1e9:.1f} GPa, strength {result.peak_stress / 1e6:.0f} MPa")
