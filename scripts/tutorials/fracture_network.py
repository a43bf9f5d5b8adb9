# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 8: fracture networks. Strength against the dip of the joints, mean of five networks.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/fracture_network.py [DIR [SEEDS [DIPS]]]
"""

import sys
import tomllib
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import flexpm

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "fracture-network")
seeds = range(1, 1 + int(sys.argv[2] if len(sys.argv) > 2 else 5))
dips = [int(dip) for dip in (sys.argv[3] if len(sys.argv) > 3 else "0,30,60,90").split(",")]

# 1. Rock and joints, which are weaker. A specimen of this size is only an example.
law = {
    "normal_stiffness": 1.8e13,
    "shear_stiffness": 5e12,
    "cohesion": 8e6,
    "tensile_strength": 3e6,
    "friction": 0.5,
    "tensile_fracture_energy": 20.0,
    "shear_fracture_energy": 1000.0,
}
rock = flexpm.materials.load("augig-table7")
rock = rock.with_set({f"joint.joints.{key}": value for key, value in law.items()})
whole = flexpm.Specimen.rectangle(0.025, 0.05, thickness=0.02, diameters=(2e-3, 3e-3))

# 2. The same network at each dip: a seed generates the same positions and lengths.
network = tomllib.loads(Path(__file__).with_suffix(".toml").read_text())
strengths, slow = np.empty((len(dips), len(seeds))), 0
for row, dip in enumerate(dips):
    network["set"]["joints"]["orientation"]["angle"] = float(dip)
    for column, seed in enumerate(seeds):
        cut = whole.with_network(network, seed)
        out = folder / f"dip-{dip}" / f"network-{seed}"
        result = flexpm.run("uniaxial", cut, rock, "rigid", stop_ratio=0.8, out=out, report=False)
        strengths[row, column] = result.peak_stress
        slow += result.status == "ok"
    p21 = cut.network_intensities()["joints"]
    mean, scatter = strengths[row].mean() / 1e6, strengths[row].std(ddof=1) / 1e6
    told = f"dip {dip:2} degrees: strength {mean:5.1f} +- {scatter:4.1f} MPa"
    print(f"{told}, P21 target {p21['target']:.0f}, last network {p21['generated']:.0f} 1/m")

print(f"status ok: {slow} of {strengths.size} runs")

# 3. Mean and standard deviation of all networks over the dip.
figure = Figure(figsize=(5.0, 3.4), layout="constrained")
axes = figure.add_subplot(xlabel="dip of the joints [degree]", ylabel="strength [MPa]")
axes.errorbar(dips, strengths.mean(axis=1) / 1e6, strengths.std(axis=1, ddof=1) / 1e6, capsize=3)
axes.plot(np.repeat(dips, len(seeds)), strengths.ravel() / 1e6, ".", color="grey")
axes.set_ylim(bottom=0.0)
figure.savefig(folder / "strengths.png", dpi=200)
