// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces of contacts and facets on the nodes of the grains, paper Eqs. 18-19,
/// summed in a fixed order, so that results do not depend on the number of threads.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Find which forces act on which nodes of each block of grains.
ForceSources find_sources(const Grains& grains, const Contacts& contacts, const Facets& facets);

/// Sum the forces on the nodes of a block into Grains::force, which is overwritten.
void sum_forces(Assembly& a, int block);

}  // namespace flexpm
