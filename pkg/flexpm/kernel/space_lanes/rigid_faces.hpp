// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts between rigid polyhedral grains, `lanes` at a time: deviations D66 and D67, as for
/// deformable grains. Both sides of a face have one reference place and move as bodies, so what is
/// between them is linear in that place, and forces come to a wrench on each side.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Update points of blocks of contacts by the motions of rigid grains in the plan, add to their
/// wrenches, and record what cracks.
///
/// @param dt  of the move that has led there with the present velocities; 0: none has
/// @return    number of contacts whose middle face has no area
int update_rigid_blocks(SolidState& s, int first, int end, double dt);

}  // namespace flexpm
