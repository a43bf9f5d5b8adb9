// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Node sets: which nodes they may hold, how these move, and what that takes. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// Nodes that a set may hold, ascending: all of deformable grains, the centres of rigid ones.
std::vector<int> holdable_nodes(const Assembly& a);

/// Hold nodes at rest in x, y or both; returns the number of the set. Its pivot is the mean of
/// their places.
/// @throws std::invalid_argument  if there are none, if one is none of holdable_nodes(), is held
///         already, or lies on the face of a plate
int add_node_set(Assembly& a, const std::vector<int>& nodes, bool holds_x, bool holds_y);

/// Let a set turn about a point instead.
void set_pivot(Assembly& a, int set, Vector pivot);

/// Let a set move under the forces on it, apart from its rotation.
void let_float(Assembly& a, int set);

/// Velocity of the pivot, which one that floats finds itself [m/s], and spin about z
/// [rad/s]; drive_node_sets() takes them to the nodes.
void set_motion_of(Assembly& a, int set, Vector velocity, double spin);

/// Give the nodes of all sets the velocities that their motion has over the coming step of `dt`;
/// what their forces work in the half step until then goes with these.
void drive_node_sets(Assembly& a, double dt);

/// Forces, works and motion of all sets after a step. Called by step().
void update_node_sets(Assembly& a, double dt, double damping);

/// Kinetic energy of the translation of a set that floats, as if no force acted on it; 0 of others
/// [J].
double kinetic_of_velocity(const Assembly& a, const NodeSet& set);

/// @throws std::invalid_argument  if a node of a set lies on the face of a plate
void require_apart(const Assembly& a, const Plate& plate);

}  // namespace flexpm
