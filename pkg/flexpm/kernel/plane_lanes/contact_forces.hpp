// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Blocks of contacts: relative motion, bilinear law, nodal forces, paper Eqs. 5-19.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Update the contact blocks from `first` to before `end` over a step `dt`, at the positions
/// reached at its end.
void update_contact_blocks(Assembly& a, int first, int end, double dt);

}  // namespace flexpm
