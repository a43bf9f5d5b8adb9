// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One block of contacts: relative motion, bilinear law, nodal forces, paper Eqs. 5-19.
#pragma once

#include <flexpm/kernel/assembly.hpp>

namespace flexpm {

/// Fill `next_centre` of a block of grains, which contacts read.
void predict_centres(Assembly& a, int block, double dt);

/// Update the contact blocks from `first` to before `end` over a step `dt`, at the positions reached at
/// its end.
void update_contact_blocks(Assembly& a, int first, int end, double dt);

/// Update the pressure forces on block `block` of boundary edges; returns their work [J].
double update_edge_block(Assembly& a, int block, double dt);

}  // namespace flexpm
