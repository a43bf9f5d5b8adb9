# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 6: a custom test. A specimen is loaded, unloaded and loaded again.

The same script tests deformable grains between driven nodes, rigid grains between plates, and
YADE's bonded spheres. Each call of ``strain_to`` is a stage of the test.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/load_unload_reload.py [FOLDER]
"""

import sys
from pathlib import Path

import flexpm  # isort: skip  (first: it makes YADE importable)
import matplotlib.pyplot as plt
import numpy as np
from yade import O

from flexpm.results.measures import energy_error

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "own-test")
folder.mkdir(exist_ok=True)
specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=3)
for model in ("flexible", "rigid", "jcfpm"):
    O.reset()
    rig = flexpm.rig(flexpm.build(specimen, model=model))
    top = 0.3 * rig.reference_strain  # nearly no contact softens before
    for name, strain in (("load", top), ("unload", 0.3 * top), ("reload", 1.2 * top)):
        first = len(rig.record)
        rig.strain_to(strain)
        axial, stress = (rig.record[column][first:] for column in ("axial_strain", "axial_stress"))
        rows = (axial > 0.4 * top) & (axial < 0.9 * top)  # without the turning points
        modulus = np.polyfit(axial[rows], stress[rows], 1)[0]
        print(f"{model:9} {name:7} E = {modulus / 1e9:6.2f} GPa")
    plt.plot(1e2 * rig.record["axial_strain"], 1e-6 * rig.record["axial_stress"], label=model)
    error = energy_error(rig.record, rig.initial_energy)
    if error is not None:  # YADE's models do not keep all energies
        print(f"{model:9} energy error {error:.1e}")
plt.xlabel("axial strain [%]")
plt.ylabel("axial stress [MPa]")
plt.legend()
plt.savefig(folder / "curves.png")
