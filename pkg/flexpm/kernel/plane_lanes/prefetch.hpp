// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Prefetching: memory is asked for some time before it is read, where a step's arrays
/// exceed the caches. It is asked for bit by bit between computations: a core can wait for few
/// lines at once.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/prefetch_rows.hpp>

namespace flexpm {

/// Rows to ask for before each block of contacts; none if the caches keep until the next step what
/// one reads.
PrefetchLists list_prefetches(const Grains& grains, const Contacts& contacts);

/// Ask for what a block of contacts gathers from the nodes of its grains.
inline void prefetch_nodes(const Assembly& a, int block)
{
    for (int row : a.plan.prefetch.nodes[block])
        prefetch_rows(a.grains.velocity.data() + row * lanes, dimension);
    for (int row : a.plan.prefetch.centres[block])
        prefetch_rows(a.plan.next_centre.data() + row * lanes, 1);
}

}  // namespace flexpm
