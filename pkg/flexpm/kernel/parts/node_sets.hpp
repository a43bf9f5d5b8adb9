// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Node sets: which nodes they may hold, how these move, and what that takes. SI units.
/// Templates are for Assembly and SolidState.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Nodes that a set may hold, ascending: all of deformable grains, the centres of rigid ones.
std::vector<int> holdable_nodes(const BondedState& state);

/// Hold nodes at rest along axes; returns the number of the set. Its pivot is the mean of their
/// places.
/// @throws std::invalid_argument  if there are none or no axis, if one is none of holdable_nodes(),
///         is held already, or lies on the face of a plate
template <class State>
int add_node_set(State& state, const std::vector<int>& nodes, std::array<bool, 3> axes);

/// Let a set turn about a point from now on [m].
/// @throws std::invalid_argument  if there is no such set, or unless the place is finite
void set_pivot(BondedState& state, int set, Vector pivot);

/// Let a set move under the forces on it, apart from its rotation.
void let_float(BondedState& state, int set);

/// Velocity of the pivot, which one that floats finds itself [m/s], and spin about that [rad/s], in
/// 2D about z; drive_node_sets() takes them to the nodes.
/// @throws std::invalid_argument  if there is no such set, or for one along an axis that is free
void set_motion_of(BondedState& state, int set, Vector velocity, Vector spin);

/// Give the nodes of all sets the velocities that their motion has over the coming step of `dt`,
/// which takes them to where the rotation does; what their forces work in the half step until then
/// goes with these.
template <class State> void drive_node_sets(State& state, double dt);

/// What held nodes do in the half step that begins, with the velocities that they have now: by
/// blocks of the ledger, and by sets.
void promise_work(SolidState& s, double dt);

/// Forces, works and motion of all sets after a step, and where it takes their nodes next. A step
/// of no time gives the forces alone.
template <class State> void update_node_sets(State& state, double dt, double damping);

/// Kinetic energy of the translation of a set that floats, as if no force acted on it; 0 of others
/// [J].
double kinetic_of_velocity(const BondedState& state, const NodeSet& set);

/// @throws std::invalid_argument  if a node of a set lies on the face of a plate
template <class State> void require_apart(const State& state, const Plate& plate);

}  // namespace flexpm
