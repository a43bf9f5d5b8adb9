// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean of numbers, exact for equal ones.
#pragma once

namespace flexpm {

/// Mean of value(i) over 0 <= i < count, for a count above 0. Equal values give exactly that value.
template <class Value> double mean_of(int count, Value value)
{
    const double first = value(0);
    double excess = 0.0;
    for (int i = 1; i < count; ++i)
        excess += value(i) - first;
    return first + excess / count;
}

}  // namespace flexpm
