// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts between polyhedral grains, `lanes` at a time: deviations D66 and D67.
#pragma once

#include <flexpm/kernel/solids/solid_state.hpp>

namespace flexpm {

/// Update points and forces of blocks of contacts at the present places, and record what cracks.
/// @return  number of contacts whose middle face has no area
int update_face_blocks(SolidState& s, int first, int end);

}  // namespace flexpm
