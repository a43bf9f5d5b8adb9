// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts between polyhedral grains by their nodes, `lanes` at a time: deviations D66 and D67.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Update points and forces of blocks of contacts at the present places, and record what cracks.
///
/// @param dt  of the move that has led there with the present velocities; 0: none has
/// @return    number of contacts whose middle face has no area
int update_face_blocks(SolidState& s, int first, int end, double dt);

/// Add the forces of all contacts at the present places to those on the nodes of their corners. No
/// state changes.
///
/// @param force  of nodes, as Grains::force
void add_node_forces(const SolidState& s, double* force);

}  // namespace flexpm
