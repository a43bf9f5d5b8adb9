# SPDX-License-Identifier: GPL-3.0-or-later
"""A run of cohesion.toml as a job of yade-batch; its parameters are a line of cohesion.table.

PYTHONPATH=../../build/python yade-batch --job-threads=1 cohesion.table cohesion_batch.py

yade-batch ends with exit code 0 also when jobs have failed: look at its summary.
"""

from yade import utils

utils.readParamsFromTable(model="flexible", cohesion=30e6, seed=1, noTableOk=True)
from yade.params.table import cohesion, model, seed  # noqa: E402

import flexpm  # noqa: E402

specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=seed)
material = flexpm.materials.load(None, model).with_set([f"cohesion={cohesion}"], model)
folder = f"batch-{model}-{cohesion:g}-{seed}"
result = flexpm.run("uniaxial", specimen, material=material, model=model, out=folder)
print(f"{folder}: {result.peak_stress * 1e-6:.1f} MPa, {result.status}")
