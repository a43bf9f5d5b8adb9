# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial: a bar that snaps back, in tension under control of the opening of its weak line.

A bar of 72 mm has a weak line across its middle; the rest is unbreakable. The bar is 1.5 times as
long as 2 E G / sigma_t^2. Above this length the ends must move back while the line opens. Rollers
keep the bar straight.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/snap_back.py [FOLDER]
"""

import sys

import flexpm  # isort: skip  (first: it makes YADE importable)
import matplotlib.pyplot as plt
import numpy as np

length, height, thickness, strength = 0.072, 0.012, 0.01, 10e6
model = sys.argv[2] if len(sys.argv) > 2 else "rigid"
rock = flexpm.materials.load(None, model).with_set(
    {"tensile_strength": 1e9, "cohesion": 1e9},
    tensile_fracture_energy=1e6,
    shear_fracture_energy=1e6,
)
strip = flexpm.Specimen.rectangle(height, 2 * height, thickness, seed=1)
young = flexpm.elastic(strip, rock, model=model)["youngs_modulus"]
energy = length * strength**2 / (2 * young) / 1.5
stiffness = rock.law(model)["normal_stiffness"]
line = {
    **{"normal_stiffness": stiffness, "shear_stiffness": stiffness},
    **{"tensile_strength": strength, "cohesion": 1e9},
    **{"tensile_fracture_energy": energy, "shear_fracture_energy": 1e6, "friction": 0.5},
}
rock = rock.with_set({f"joint.weak.{key}": value for key, value in line.items()}, model)
bar = flexpm.Specimen.rectangle(length, height, thickness, seed=1)
bar = bar.with_joints({"weak": [(length / 2, 0.0), (length / 2, height)]})
rig = flexpm.PartRig(flexpm.build(bar, rock, model=model))

# Bonded ends, rollers along the bar, and a gauge across the line with a length of two grains.
left, right = (rig.platen(side, bonded=True, friction=1e6) for side in (3, 1))
for side in (0, 2):
    rig.platen(side, bonded=True)
apart = bar.mean_diameter
rig.gauge("opening", (length / 2 - apart, height / 2), (length / 2 + apart, height / 2))
rig.drive(
    [right], (1, 0), against=[left], area=height * thickness, length=length, strength=strength
)
rig.load(flexpm.Loading(kind="waiting", control="opening", stop_ratio=0.05))

# The opening of the line is the displacement of the ends minus the elastic extension of the bar.
record = rig.record
stress, way = record["axial_stress"], record["displacement"]
peak = stress.argmax()
elastic = (
    (stress > 0.2 * stress[peak]) & (stress < 0.7 * stress[peak]) & (np.arange(len(way)) < peak)
)
compliance = np.polyfit(stress[elastic], way[elastic], 1)[0] - 1 / stiffness
opened = way - compliance * stress
first, last = strength / stiffness, 2 * energy / strength
law = strength * np.clip(opened / first, 0, np.clip((last - opened) / (last - first), 0, 1))
after = opened > 0.1 * last
deviation = np.max(np.abs(stress - law)[after]) / strength
print(f"the ends moved back from {way[peak] * 1e6:.1f} to {way[-1] * 1e6:.1f} um")
print(f"largest deviation from the law {100 * deviation:.2f} % of the strength")
followed = np.abs(record["opening"] / record["set_point"] - 1)[1:] < 0.02
print(f"within 2 % of the set point: {100 * followed.mean():.1f} % of the rows", *rig.warnings)

_, (ends, opening) = plt.subplots(1, 2, figsize=(8, 3.4), sharey=True, layout="constrained")
ends.plot(1e6 * way, stress / 1e6)
ends.set(xlabel="displacement of the ends [µm]", ylabel="stress [MPa]")
opening.plot(1e6 * opened, stress / 1e6, label="bar")
opening.plot(1e6 * opened, law / 1e6, "--", label="law of the line")
opening.set(xlabel="opening of the line [µm]")
opening.legend()
plt.savefig(f"{sys.argv[1] if len(sys.argv) > 1 else '.'}/snap_back.png")
