# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading rates of grains of several minerals follow the weakest contacts. SI units.

Grains are pieces of larger ones: pieces of one parent have one mineral, a colour, and no two
neighbouring parents have the same, so that contacts within parents are those of a colour with
itself.
"""

from __future__ import annotations

import numpy as np
import pytest

import flexpm
from flexpm.materials.material import Material

PARENTS = 12
KEYS = ("tensile_strength", "cohesion", "friction", "density")
ENERGIES = ("tensile_fracture_energy", "shear_fracture_energy")


def pieces():
    """A specimen of pieces of parents, and the number of colours."""
    specimen = flexpm.Specimen.rectangle(0.008, 0.016, 0.01, diameters=(0.8e-3, 1.2e-3), seed=21)
    centres = np.asarray(specimen.centres)[:, :2]
    draw = np.random.default_rng(21)
    seeds = centres[draw.choice(len(centres), PARENTS, replace=False)]
    for _ in range(20):  # parents of about the same size
        parent = np.argmin(((centres[:, None] - seeds[None]) ** 2).sum(-1), axis=1)
        seeds = np.array([centres[parent == one].mean(axis=0) for one in range(PARENTS)])
    pairs = np.array(specimen.tessellation.shared_edges, dtype=int).reshape(-1, 4)[:, :2]
    near = {tuple(sorted(pair)) for pair in parent[pairs].tolist() if pair[0] != pair[1]}
    colours: dict[int, int] = {}
    for one in range(PARENTS):
        used = {
            colours[b if a == one else a] for a, b in near if one in (a, b) and {a, b} & {*colours}
        }
        colours[one] = next(colour for colour in range(PARENTS) if colour not in used)
    return specimen.with_minerals([colours[one] for one in parent]), max(colours.values()) + 1


def rock(colours, factor, model):
    """Contacts within parents have a factor of the strengths of those between them."""
    base = flexpm.materials.load("augig-calibrated-rigid" if model == "rigid" else None)
    law = {**base.law(model)}
    names = [f"c{number}" for number in range(colours)]
    factors = {"tensile_strength": factor, "cohesion": factor}
    elastic = ("young", "poisson", "normal_stiffness", "shear_ratio")
    return Material.from_dict(
        {
            **{key: law[key] for key in (*KEYS, *ENERGIES)},
            "elastic": {model: {key: law[key] for key in elastic if law[key] is not None}},
            "mineral": [{"name": name, "fraction": 1.0 / colours} for name in names],
            "interface": [{"pair": [name, name], "factor": factors} for name in names],
        }
    )


def loaded(factor, model="rigid", **options):
    specimen, colours = pieces()
    return flexpm.run("tension", specimen, rock(colours, factor, model), model, **options)


def test_strong_contacts_on_most_of_the_length_do_not_make_a_test_faster():
    """The rate followed the mean of all strengths: 3 steps, no peak and no warning."""
    usual, strong = (loaded(factor) for factor in (1.0, 1000.0))
    assert usual.status == strong.status == "ok"
    assert strong.steps == pytest.approx(usual.steps, rel=0.2)
    assert not {"c0/c0", "c1/c1"} & {*strong.cracks_by_pair}


def test_weak_contacts_on_most_of_the_length_make_a_test_slow():
    """The specimen tears along them, at a thousandth of the stress and with as many steps."""
    result = loaded(0.001)
    assert result.steps >= 1000
    assert result.status == "ok"


def test_a_test_that_ends_before_its_rate_can_be_judged_says_so():
    result = loaded(1.0, max_strain=1e-7, rate=8.0)
    assert result.status == "no_peak"
    (line,) = [one for one in result.warnings if "to judge the loading rate" in one]
    assert line.startswith("rows while loaded = ")


def test_contacts_that_nothing_breaks_end_by_default():
    """A skeleton of strong pairs: no fall counted before a fifth of its nominal strength, and a
    specimen that had torn was stretched on without an end.
    """
    base = flexpm.materials.load("augig-calibrated-rigid").law("rigid")
    elastic = ("normal_stiffness", "shear_ratio")
    strong = {"pair": ["a", "b"], "factor": {"tensile_strength": 1e3, "cohesion": 1e3}}
    material = Material.from_dict(
        {
            **{key: base[key] for key in (*KEYS, *ENERGIES)},
            "elastic": {"rigid": {key: base[key] for key in elastic}},
            "mineral": [{"name": name, "fraction": 0.5} for name in "ab"],
            "interface": [strong],
        }
    )
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=3)
    result = flexpm.run("tension", specimen, material, "rigid")
    assert result.ended_by in ("drop", "largest_strain")
    assert result.curve["axial_strain"][-1] < 0.2
