// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/end_rule.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <cmath>

namespace flexpm {

namespace {

/// A limit may be infinite: it is then never reached.
void check_limit(const char* quantity, double value, const char* unit)
{
    if (std::isnan(value)) refuse(quantity, value, unit, "must be a number");
}

void check(const TestEnd& end)
{
    if (!(end.stop_ratio >= 0.0 && end.stop_ratio <= 1.0)) {
        refuse("stop ratio", end.stop_ratio, "", "must be from 0 to 1");
    }
    check_limit("least peak", end.least_peak, "Pa");
    check_limit("least strain", end.least_strain, "");
    check_limit("largest strain", end.largest_strain, "");
}

}  // namespace

TestState test_state(double stress, double peak, double strain, const TestEnd& end)
{
    check(end);
    if (peak >= end.least_peak && stress < end.stop_ratio * peak) return TestState::past_peak;
    if (strain <= end.least_strain) return TestState::least_strain_reached;
    return strain >= end.largest_strain ? TestState::largest_strain_reached : TestState::running;
}

}  // namespace flexpm
