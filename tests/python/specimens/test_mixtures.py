# SPDX-License-Identifier: GPL-3.0-or-later
"""Young's modulus of two minerals: layers drawn as labels, and random mixtures. SI units.

Contacts are a thousand times as stiff as those of the granite, so that the grains alone bear.
"""

from __future__ import annotations

import numpy as np
import pytest

import flexpm
from flexpm.specimens.specimen import Specimen

YOUNG = np.array([26e9, 78e9])
STIFFNESS = 1.8e17
PIXEL = 5e-5


def rock(poisson):
    own = {"poisson": poisson, "normal_stiffness": STIFFNESS, "shear_ratio": 0.28}
    kinds = [
        {"name": name, "fraction": 0.5, "elastic": {"flexible": {"young": young}}}
        for name, young in zip(("soft", "stiff"), YOUNG.tolist(), strict=True)
    ]
    strengths = {"tensile_strength": 8e6, "cohesion": 30e6, "friction": 0.4, "softening": "brittle"}
    return {**strengths, "elastic": {"flexible": {"young": YOUNG[0], **own}}, "mineral": kinds}


def layers(*, along):
    """Six layers of ten and eight pixels; returns the specimen and the areas of the minerals."""
    rows = np.repeat(np.arange(6), [10, 8] * 3)
    labels = rows[:, None] * np.ones(50, dtype=int)
    specimen = Specimen.from_labels(
        labels.T if along else labels, PIXEL, 0.01, minerals={n: n % 2 for n in range(6)}
    )
    areas = np.bincount(specimen.minerals, specimen.tessellation.cell_areas)
    return specimen, areas / areas.sum()


def modulus(specimen, poisson):
    return flexpm.elastic(specimen, rock(poisson))["youngs_modulus"]


@pytest.mark.parametrize("poisson", [1e-9, 0.23])
def test_layers_along_the_load_share_their_strain(poisson):
    specimen, parts = layers(along=True)
    assert parts == pytest.approx([10 / 18, 8 / 18], rel=1e-9)
    assert modulus(specimen, poisson) == pytest.approx(parts @ YOUNG, rel=1e-6)


def test_layers_across_the_load_share_their_stress():
    specimen, parts = layers(along=False)
    found, alone = modulus(specimen, 1e-9), 1.0 / np.sum(parts / YOUNG)
    assert found == pytest.approx(alone, rel=1e-3)
    closed = 5 / (STIFFNESS * specimen.dimensions["height"])  # of five boundaries
    assert found == pytest.approx(1.0 / (1.0 / alone + closed), rel=1e-6)


def test_layers_across_the_load_hold_each_other_sideways():
    specimen, parts = layers(along=False)
    found, free, square = modulus(specimen, 0.23), np.sum(parts / YOUNG), 0.23**2
    held = (1.0 - square) * free + square / (parts @ YOUNG)  # all of one lateral strain
    assert 1.0 / free < found < 1.0 / held


def bounds(parts, poisson):
    """Young's modulus by Hashin and Shtrikman's bounds of the plane, of a plate in plane stress."""
    bulk, shear = YOUNG / (2.0 * (1.0 - poisson)), YOUNG / (2.0 * (1.0 + poisson))
    found = []
    for a, b in ((0, 1), (1, 0)):
        k = bulk[a] + parts[b] / (1.0 / (bulk[b] - bulk[a]) + parts[a] / (bulk[a] + shear[a]))
        room = (bulk[a] + 2.0 * shear[a]) / (2.0 * shear[a] * (bulk[a] + shear[a]))
        g = shear[a] + parts[b] / (1.0 / (shear[b] - shear[a]) + parts[a] * room)
        found.append(4.0 * k * g / (k + g))
    return found


def test_bounds_of_one_mineral_are_its_modulus():
    assert bounds(np.array([1.0, 0.0]), 0.23) == pytest.approx([YOUNG[0]] * 2)
    low, high = bounds(np.array([0.5, 0.5]), 0.23)
    assert 1.0 / np.mean(1.0 / YOUNG) < low < high < YOUNG.mean()


@pytest.mark.long
def test_random_mixtures_lie_within_the_bounds_of_the_plane():
    found, low, high = [], [], []
    for seed in range(1, 11):
        packed = Specimen.rectangle(0.08, 0.0985, 0.01, seed=seed)
        assert len(packed.discs) == pytest.approx(1000, rel=0.05)
        drawn = np.random.default_rng(seed).permutation(len(packed.discs)) % 2
        specimen = packed.with_minerals(drawn)
        areas = np.bincount(drawn, specimen.tessellation.cell_areas)
        least, most = bounds(areas / areas.sum(), 0.23)
        found.append(modulus(specimen, 0.23))
        low.append(least)
        high.append(most)
    assert 0.995 * np.mean(low) < np.mean(found) < 1.005 * np.mean(high)
    assert np.std(found) < 0.05 * np.mean(found)
