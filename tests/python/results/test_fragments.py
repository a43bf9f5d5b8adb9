# SPDX-License-Identifier: GPL-3.0-or-later
"""Fragments of graphs whose parts are known."""

import dataclasses

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from sample_snapshot import wall

from flexpm.results import fragments


@given(
    sizes=st.lists(st.integers(1, 12), min_size=1, max_size=8),
    seed=st.integers(0, 2**31),
)
def test_parts_that_were_put_together_are_found_again(sizes, seed):
    """Chains of known sizes under random numbers; broken contacts between them do not count."""
    random = np.random.default_rng(seed)
    part = np.repeat(np.arange(len(sizes)), sizes)
    number = random.permutation(len(part))  # grain of each place in the chains
    places = np.arange(len(part) - 1)
    chains = np.stack([number[places], number[places + 1]], axis=1)
    held = part[places] == part[places + 1]
    areas = random.uniform(1.0, 2.0, len(part))
    found = fragments.connected(chains, held, areas)
    assert len(found) == len(sizes)
    assert sorted(found.grains) == sorted(sizes)
    of_place = found.labels[number]
    assert len(set(zip(part, of_place, strict=True))) == len(sizes)
    for label in range(len(found)):
        assert np.isclose(found.areas[label], areas[found.labels == label].sum())
    assert np.all(np.diff(found.areas) <= 0.0)
    assert found.areas[found.labels[0]] <= found.areas[0]


def test_without_contacts_every_grain_is_a_fragment():
    found = fragments.connected(np.empty((0, 2), dtype=int), np.empty(0, dtype=bool), np.ones(4))
    assert found.labels.tolist() == [0, 1, 2, 3]  # ties in the order of the grains


def test_one_point_that_is_not_fully_damaged_holds():
    damage = np.array([1.0, 0.999, 1.0, 1.0, 1.0, 1.0])
    triangle = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    snapshot = dataclasses.replace(
        wall(),
        reference=np.tile(triangle, (3, 1)),
        triangles=np.arange(9).reshape(3, 3),
        triangle_grain=np.arange(3),
        contact=np.array([0, 1]),
        contact_grains=np.array([[0, 1], [1, 2]]),
        point_contact=np.repeat([0, 1], 3),
        point_damage=damage,
    )
    found = snapshot.fragments
    assert found.labels.tolist() == [0, 0, 1]
    assert found.areas.tolist() == [2.0, 1.0]


def test_grains_that_are_gone_are_in_no_fragment():
    pairs, held = np.array([[0, 2], [2, 4]]), np.array([True, False])
    found = fragments.connected(pairs, held, np.array([1.0, 0.0, 1.0, 0.0, 3.0]))
    assert found.labels.tolist() == [1, -1, 1, -1, 0]
    assert found.grains.tolist() == [1, 2]
    assert found.areas.tolist() == [3.0, 2.0]
    assert len(fragments.connected(pairs[:0], held[:0], np.zeros(2))) == 0
