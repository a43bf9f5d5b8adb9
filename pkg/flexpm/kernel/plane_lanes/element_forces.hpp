// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces of the triangles of deformable grains on their nodes, paper Sec. 2.1.
#pragma once

#include <flexpm/kernel/assembly/grains.hpp>

namespace flexpm {

/// Add the forces of a block's elements to Grains::force.
///
/// @param prefetches  ask for what comes after the block, which no cache holds any more
void add_element_forces(Grains& grains, int block, bool prefetches);

}  // namespace flexpm
