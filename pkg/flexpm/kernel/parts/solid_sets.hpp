// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Nodes of a specimen in space that a test holds or moves as one: node_sets.hpp of the
/// plane, where no set floats (deviation D101). SI units.
/// Deviation D52: of rigid grains the centres are held, and the grains are free to turn about them.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Nodes that a set may hold, ascending: all of deformable grains, the centres of rigid ones.
std::vector<int> holdable_nodes(const SolidState& s);

/// Hold nodes at rest along axes; returns the number of the set. Its pivot is the mean of their
/// places.
/// @throws std::invalid_argument  if there are none or no axis, if one is none of holdable_nodes(),
///                                is held already, or lies on a plate
int add_node_set(SolidState& s, const std::vector<int>& nodes, std::array<bool, 3> axes);

/// @throws std::invalid_argument  if a node of a set lies on the plate
void require_apart(const SolidState& s, const Plate& plate);

/// Place about which a set turns from now on [m].
/// @throws std::invalid_argument  if there is no such set, or unless the place is finite
void set_pivot(SolidState& s, int set, Vector pivot);

/// Give what is held of a set a velocity, which is that of its pivot [m/s], and a spin about that
/// [rad/s]. A step takes its nodes to where the rotation does.
/// @throws std::invalid_argument  if there is no such set, or for one along an axis that is free
void set_motion_of(SolidState& s, int set, Vector velocity, Vector spin, double dt);

/// What held nodes do in the half step that begins, with the velocities that they have now: by
/// blocks of the ledger, and by sets.
void promise_work(SolidState& s, double dt);

/// Forces, moments, ways and works of all sets after a step, and where it takes those that turn
/// next.
void sum_node_sets(SolidState& s, double dt);

}  // namespace flexpm
