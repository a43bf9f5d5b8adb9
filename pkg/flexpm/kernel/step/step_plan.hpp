// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a step needs and a saved state does not hold.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Derive from the contacts, the edges and the grains: the gather list and the same sorted by nodes, the
/// order of a step, what to ask for ahead, blocks between shared edges, and, unless it is known, the
/// elements' part of the stiffness bound. Needed once contacts or edges have changed; a step does it
/// after a state has been loaded.
void prepare_step(Assembly& a);

}  // namespace flexpm
