// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains of a solid that have come loose: loose_grains.hpp for those of the plane.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Find the grains that no chain of contacts, bonded or pressed together, joins to what is held:
/// nodes whose velocity is given, and grains that touch a plate which moves at a given velocity.
/// Where nothing is held, to the largest group of grains. Without any pressure none is loose.
/// Deviation D57.
void find_loose(SolidState& s);

}  // namespace flexpm
