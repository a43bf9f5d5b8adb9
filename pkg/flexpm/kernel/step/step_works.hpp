// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a step of a block of grains leaves in the ledger.
#pragma once

#include <flexpm/kernel/assembly/energy_ledger.hpp>
#include <flexpm/kernel/core/central_difference.hpp>

#include <algorithm>

namespace flexpm {

/// Sum over the lanes.
inline double sum_of_lanes(const double* values)
{
    double total = 0.0;
    for (int l = 0; l < lanes; ++l)
        total += values[l];
    return total;
}

/// Take the works of a block's last step into the ledger, and what was measured in it.
inline void add_works(EnergyLedger& ledger, int block, const StepSums& sums, bool measured)
{
    double* damped = ledger.damping_work.data() + 2 * block;
    double* dragged = ledger.drag_work.data() + 2 * block;
    double* prescribed = ledger.prescribed_work.data() + 2 * block;
    damped[0] += damped[1] + sum_of_lanes(sums.damped);
    damped[1] = sum_of_lanes(sums.damped_next);
    const double half_drag = sum_of_lanes(sums.dragged);
    dragged[0] += dragged[1] + half_drag;
    dragged[1] = half_drag;
    prescribed[0] += prescribed[1] + sum_of_lanes(sums.prescribed);
    prescribed[1] = sum_of_lanes(sums.prescribed_next);
    if (!measured) return;
    ledger.kinetic[block] = sum_of_lanes(sums.kinetic);
    ledger.largest_force[block] = *std::max_element(sums.largest, sums.largest + lanes);
}

}  // namespace flexpm
