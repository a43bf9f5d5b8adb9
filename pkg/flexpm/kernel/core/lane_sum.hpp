// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A sum with a part in each lane, so that its order is the same on all machines.
#pragma once

#include <flexpm/kernel/core/array.hpp>

namespace flexpm {

/// One sum a lane.
struct LaneSum {
    alignas(64) double lane[lanes] = {};

    double total() const
    {
        double sum = 0.0;
        for (double part : lane)
            sum += part;
        return sum;
    }
};

}  // namespace flexpm
