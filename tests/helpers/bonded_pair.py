# SPDX-License-Identifier: GPL-3.0-or-later
"""Two bonded spheres whose motion is prescribed, and the force between them."""

import math

import numpy as np
import yade

from flexpm import materials
from flexpm.models import grains as models
from flexpm.specimens.specimen import Specimen

SIDE, THICKNESS = 1e-3, 0.05  # of the two square cells [m]
# so stiff that the pair keeps its geometry up to failure
LAW = {"normal_stiffness": 1e16, "shear_ratio": 0.4}
STRENGTHS = {"tensile_strength": 12e6, "cohesion": 30e6, "friction": 0.6, "softening": "brittle"}


class Pair:
    """Square cells side by side along x, share one edge of length `SIDE`; all motion is given."""

    def __init__(self, model, radius_share=1.0):
        """Discs of half the side times `radius_share`: they overlap above 1, part below."""
        centres = np.array([[0.5, 0.5], [1.5, 0.5]]) * SIDE
        outline = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]) * SIDE
        radii = np.full(2, 0.5 * SIDE * radius_share)
        specimen = Specimen.from_discs(centres, radii, outline, THICKNESS)
        data = {"elastic": {"rigid": LAW}, **STRENGTHS}
        self.built = models.build(specimen, materials.Material.from_dict(data), model)
        self.area = SIDE * THICKNESS
        for body in yade.O.bodies:
            body.state.blockedDOFs = "xyzXYZ"

    def move(self, x=0.0, y=0.0, turn=0.0, steps=1):
        """Move the second sphere by a distance [m] and an angle, evenly over steps.

        Returns:
            Force on the second sphere in each step [N], (steps, 2).
        """
        state = yade.O.bodies[1].state
        state.vel, state.angVel = (x / steps, y / steps, 0.0), (0.0, 0.0, turn / steps)
        forces = []
        for _ in range(steps):
            yade.O.step()
            forces.append(tuple(yade.O.forces.f(1))[:2])
        state.vel, state.angVel = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        yade.O.step()  # forces follow positions by one step
        forces.append(tuple(yade.O.forces.f(1))[:2])
        return np.array(forces[1:])

    @property
    def normal_stiffness(self):
        return LAW["normal_stiffness"] * self.area

    @property
    def shear_stiffness(self):
        return LAW["shear_ratio"] * self.normal_stiffness

    @property
    def tensile_limit(self):
        return STRENGTHS["tensile_strength"] * self.area

    def shear_limit(self, pressure):
        return (STRENGTHS["cohesion"] + STRENGTHS["friction"] * pressure) * self.area


def pull_until_broken(model, radius_share, steps=1000):
    """Largest pull of a pair [N], the promised one [N], and the pull after it has broken [N]."""
    pair = Pair(model, radius_share)
    pulls = -pair.move(x=1.5 * pair.tensile_limit / pair.normal_stiffness, steps=steps)[:, 0]
    return pulls.max(), pair.tensile_limit, pulls[-1]


def shear_until_broken(model, pressure, steps=2000):
    """Largest shear of a pressed pair [N], the promised one, the last one, and its friction."""
    pair = Pair(model)
    normal = pressure * pair.area
    if pressure > 0.0:
        pair.move(x=-normal / pair.normal_stiffness)
    shears = -pair.move(y=1.3 * pair.shear_limit(pressure) / pair.shear_stiffness, steps=steps)[
        :, 1
    ]
    return shears.max(), pair.shear_limit(pressure), shears[-1], STRENGTHS["friction"] * normal


def stiffnesses(model, radius_share):
    """Measured over promised stiffness in tension, compression and shear."""
    found = []
    for sign in (1.0, -1.0):
        pair = Pair(model, radius_share)
        distance = sign * 0.5 * pair.tensile_limit / pair.normal_stiffness
        force = pair.move(x=distance)[-1, 0]
        found.append(-force / distance / pair.normal_stiffness)
        yade.O.reset()
    pair = Pair(model, radius_share)
    distance = 0.3 * pair.shear_limit(0.0) / pair.shear_stiffness
    found.append(-pair.move(y=distance, steps=10)[-1, 1] / distance / pair.shear_stiffness)
    return np.array(found)


def close_again(model, radius_share):
    """Largest force on a torn pair that is pushed back to its start [N], and k_n times the way."""
    pair = Pair(model, radius_share)
    way = 3.0 * pair.tensile_limit / pair.normal_stiffness
    pair.move(x=way, steps=300)
    forces = pair.move(x=-way, steps=300)
    return np.abs(forces).max(), pair.normal_stiffness * way


def bending(radius_share):
    """Moment of a turned pair over k_b times the angle, k_b = K_n A L^2 / 12 (CohFrict)."""
    pair = Pair("cohfrict", radius_share)
    angle = 1e-6
    # turned by the angle about the contact point, so that nothing but bending is left
    lever = yade.O.interactions[0, 1].geom.contactPoint[0] - yade.O.bodies[1].state.pos[0]
    pair.move(y=-angle * lever, turn=angle, steps=10)
    moment = -yade.O.forces.t(1)[2]
    return moment / (pair.normal_stiffness * SIDE**2 / 12.0 * angle)


def balance_before_cracks(record):
    """Stored and damped energy over the work, at the last row without a crack."""
    cracked = (record["tensile_cracks"] + record["shear_cracks"]) > 0
    row = int(np.argmax(cracked)) - 1
    assert row > 10, "the test needs some rows before the first crack"
    names = ("elastic_energy", "kinetic_energy", "damping_energy")
    return math.fsum(record[name][row] for name in names) / record["boundary_work"][row]
