// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/end_rule.hpp>

namespace flexpm {

TestState test_state(double stress, double peak, double strain, const TestEnd& end)
{
    if (peak >= end.least_peak && stress < end.stop_ratio * peak) return TestState::past_peak;
    if (strain <= end.least_strain) return TestState::least_strain_reached;
    return strain >= end.largest_strain ? TestState::largest_strain_reached : TestState::running;
}

}  // namespace flexpm
