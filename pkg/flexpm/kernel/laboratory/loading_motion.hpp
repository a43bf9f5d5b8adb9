// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The motion that a loading gives to a specimen: the elastic solution at the present
/// velocity of its ends and parts, deviation D30, found anew as cracks open and slide, deviation
/// D40. Damping does not act on it.
///
/// steady_motion.hpp says what damping leaves alone besides. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// What holds a specimen, for its elastic solution.
enum class Held {
    /// plates along whole ends, which leave it free to slide: it is kept from that
    by_ends,
    /// supports that hold it by themselves; cracks and joints bear pressure and friction alone
    by_parts,
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

/// Change the velocities that the loading gives to `ratio` times what they are, and all velocities
/// with them, so that a change of the loading's velocity raises no wave. The kinetic energy that
/// this gives is work of the boundary. Call drive_node_sets() afterwards.
void change_loading(Assembly& a, double ratio);

/// Velocities of all nodes in that motion, in the layout of Grains::displacement; held and driven
/// nodes have their own [m/s].
Array<double> loading_field(const Assembly& a);

}  // namespace flexpm
