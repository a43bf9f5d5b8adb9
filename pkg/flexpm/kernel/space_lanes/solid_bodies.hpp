// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion of rigid polyhedral grains, whose turn is a quaternion. Contacts read their motions
/// and add to their wrenches, see update_rigid_blocks(). Their nodes follow the centre and the turn when
/// somebody looks at them, or plates or pressures act on them.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/assembly/step_options.hpp>
#include <flexpm/kernel/core/central_difference.hpp>

namespace flexpm {

/// Move a rigid grain to the end of a step, by its block, and write its motion to the plan.
void move_body(SolidState& s, int block, double dt);

/// Ask for what a step reads of a rigid grain, some time before it does, by its block.
void prefetch_body(const SolidState& s, int block);

/// Write the motions of all rigid grains to the plan.
void read_motions(SolidState& s);

/// Leave no wrench on blocks of rigid grains, no weight on their centres, and no force on nodes on
/// which plates or pressures act.
void clear_wrenches(SolidState& s, int first, int end);

/// Give the centre of a rigid grain, which has its weight, the sum of that, the wrench of its
/// contacts and the forces on its nodes, by its block.
void sum_body_forces(SolidState& s, int block);

/// Sum force and moment on a rigid grain, and integrate its velocity and its angular momentum. The
/// spin half a step later is that whose turn in the middle of the step has the momentum.
void integrate_body(SolidState& s, int block, const StepOptions& o, StepSums& sums);

/// Note that a step has left the nodes of rigid grains behind.
void leave_nodes_behind(SolidState& s);

/// Put the nodes of rigid grains where these are, if a step has left them behind. This writes
/// nothing that a step reads.
void show_places(SolidState& s);

/// Motion of a rigid grain since the reference.
struct BodyMotion {
    Vector way;  ///< of its centre [m]
    Quaternion turn;
};

/// Write a motion as contacts read it: RigidMotionRow.
void write_motion(const BodyMotion& motion, double* to);

/// The motion of a rigid grain before its last move by `dt` with the present velocities.
BodyMotion motion_before(const SolidState& s, int grain, double dt);

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
