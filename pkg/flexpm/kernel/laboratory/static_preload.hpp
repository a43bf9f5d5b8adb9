// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Preload of a test along its elastic solution, paper Sec. 4.1: no crack is possible before
/// the first contact point reaches its strength, so no slow steps are needed up to there.
///
/// All nodes are driven along the elastic solution in a few steps and then released with its
/// velocities. The contacts' history, the works and the energies are those of these steps. SI
/// units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// What holds a specimen, for its elastic solution.
enum class Held {
    by_ends,  ///< plates along whole ends, which leave it free to slide: it is kept from that
    by_parts,  ///< supports that hold it by themselves; cracks and joints bear pressure and friction alone
};

/// Velocities of all nodes at which the bonded assembly deforms in elastic equilibrium with the
/// velocities of its held nodes, of its plates and node sets; plates under a load and sets that
/// float give way [m/s].
///
/// @throws std::runtime_error  as solve_static()
Array<double> elastic_velocities(const Assembly& a, Held held = Held::by_ends);

/// Add these velocities to all nodes that are free, and give them to plates under a load, so that
/// loading starts without a wave. Held nodes and driven plates have theirs already. The kinetic
/// energy that this gives is work of the boundary. Call drive_node_sets() afterwards.
///
/// @param undamped  damping then acts only on what grains and plates move beyond these velocities,
///         deviation D30
/// @throws std::runtime_error  as solve_static()
void start_elastically(Assembly& a, bool undamped, Held held = Held::by_ends);

/// Give the velocities of the loading those of the elastic solution of the specimen as it is now,
/// held by parts or by driven ends: its cracks open and slide freely. A beam that is broken turns
/// as two halves. Where grains have come loose there is no such solution; the velocities then stay
/// as they are. Deviation D40.
///
/// @param sense  -1 if the loading goes back: what opens as it goes on counts as open still
/// @returns  whether there is a solution
bool renew_loading(Assembly& a, double sense = 1.0);

/// Contact points that count as cracks for that solution: those with a damage of a half or more.
int count_softened(const Assembly& a);

/// Contacts of joints that are cracked, pressed, and whose faces slide past each other: a joint
/// without strength slides without a point that softens.
int count_sliding_joints(const Assembly& a);

/// Change the velocities that the loading gives to `ratio` times what they are, and all velocities
/// with them, so that a change of the loading's velocity raises no wave. The kinetic energy that
/// this gives is work of the boundary. Call drive_node_sets() afterwards.
void change_loading(Assembly& a, double ratio);

/// Take hold of all nodes of an unloaded, gripped and driven rectangle, so that `steps` steps take
/// it along its elastic solution to `share` of the strain at which the first point leaves its
/// branch.
///
/// @throws std::invalid_argument  if the share or the number of steps is out of range, or if no
///         load breaks a point
void preload(Assembly& a, double share, int steps, double dt);

/// Release the nodes; the top goes on at `velocity` [m/s], all others as the elastic solution
/// does. The kinetic energy that this gives is work of the boundary.
///
/// @param undamped  as for start_elastically()
void release_preload(Assembly& a, double velocity, double dt, bool undamped);

}  // namespace flexpm
