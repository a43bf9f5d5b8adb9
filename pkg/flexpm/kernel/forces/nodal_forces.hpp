// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces of contacts and boundary edges on the nodes of the grains, paper Eqs. 18-19, summed in
/// a fixed order, so that results do not depend on the number of threads.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Make the gather list: per block of grains, in the order of contacts and then of edges, which forces
/// act on which nodes.
void list_forces(Assembly& a);

/// Sort the gather list by nodes, for gather_forces().
void sort_sources(Assembly& a);

/// Sum the listed forces on the nodes of a block into `Assembly::force`, which is overwritten.
void gather_forces(Assembly& a, int block);

}  // namespace flexpm
