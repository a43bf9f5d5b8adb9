# SPDX-License-Identifier: GPL-3.0-or-later
"""Check of flexpm in the form of YADE's own checks, which ``yade --check`` runs from its folder.

A small specimen of bonded grains is pulled until it breaks: its stiffness must be that of one
direct solve, the energies must balance, and points must crack in tension, near the bonds' strength.
"""

import flexpm

specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
stiffness = flexpm.elastic(specimen)["youngs_modulus"]
result = flexpm.run("tension", specimen)

if result.status != "ok":
    raise YadeCheckError(f"flexpm: status of the test = {result.status}, must be ok")
if not abs(result.youngs_modulus / stiffness - 1.0) < 1e-3:
    raise YadeCheckError(
        f"flexpm: Young's modulus = {result.youngs_modulus:.4g} Pa, must be {stiffness:.4g} Pa"
    )
if not abs(result.energy_error) < 1e-3:
    raise YadeCheckError(f"flexpm: energy error = {result.energy_error:.2g}, must be below 0.001")
if not (result.tensile_cracks > 0 and result.shear_cracks == 0):
    raise YadeCheckError(
        f"flexpm: cracked points = {result.tensile_cracks} tensile and {result.shear_cracks} shear,"
        " must be tensile alone"
    )
ratio = result.peak_stress / result.material["tensile_strength"]
if not 0.5 < ratio < 1.5:
    raise YadeCheckError(f"flexpm: peak stress = {ratio:.3g} bond strengths, must be 0.5 to 1.5")
