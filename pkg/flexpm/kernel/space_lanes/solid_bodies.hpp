// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion of rigid polyhedral grains, whose turn is a quaternion. Their nodes follow the
/// centre and the turn; nodes and contacts are those of deformable grains.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/assembly/step_options.hpp>
#include <flexpm/kernel/core/central_difference.hpp>

namespace flexpm {

/// Move a rigid grain to the end of a step, by its block.
void move_body(SolidState& s, int block, double dt);

/// Give the centre of a rigid grain, which has its weight, the sum of that and the forces on all
/// other nodes, by its block.
void sum_body_forces(SolidState& s, int block);

/// Sum force and moment on a rigid grain from those on its nodes, and integrate its velocity and
/// its angular momentum. The spin half a step later is that whose turn in the middle of the step
/// has the momentum.
void integrate_body(SolidState& s, int block, const StepOptions& o, StepSums& sums);

/// Put a rigid grain where centre and turn are, by its number.
/// @param way  of its centre since the reference [m]
void place_body(SolidState& s, int grain, Vector way);

/// Displacement of a node, of rigid grains and of others, before their last move by `dt` with the
/// present velocities [m].
Vector displacement_before(const SolidState& s, int grain, int node, double dt);

/// Give a rigid grain a spin from now on [rad/s].
/// @param held  it stays; else it is integrated
void set_spin(SolidState& s, int grain, Vector spin, bool held);

/// Velocity of the centre [m/s] and spin [rad/s] of a rigid grain, from now on.
/// @throws std::invalid_argument  unless the grain is rigid and all are finite
void set_motion(SolidState& s, int grain, Vector velocity, Vector spin);

/// Stop the faces that are held along an axis: each gets the push in its middle that takes its
/// velocity along the axis away, which changes the grain's motion and does no work on what it
/// holds. Comes after the velocities of a step.
void hold_faces(SolidState& s);

/// A lower bound of the smallest principal moment of an inertia.
double least_moment(const SpaceTensor& inertia);

}  // namespace flexpm
