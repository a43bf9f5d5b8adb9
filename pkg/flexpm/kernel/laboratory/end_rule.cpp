// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/end_rule.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// A limit may be infinite: it is then never reached.
void check_limit(const char* quantity, double value, const char* unit)
{
    if (std::isnan(value)) refuse(quantity, value, unit, "must be a number; correct it");
}

void check(const TestEnd& end)
{
    if (!(end.stop_ratio >= 0.0 && end.stop_ratio <= 1.0)) {
        refuse("stop ratio", end.stop_ratio, "", "must be 0 to 1; correct it");
    }
    check_limit("least peak", end.least_peak, "Pa");
    check_limit("least strain", end.least_strain, "");
    check_limit("largest strain", end.largest_strain, "");
    check_not_negative("strain of a plateau", end.plateau_strain, "");
}

}  // namespace

bool is_plateau(const std::function<StrainStress(std::size_t)>& row, std::size_t first,
    std::size_t end, const TestEnd& rule)
{
    if (rule.plateau_strain == 0.0 || first >= end) return false;
    const StrainStress last = row(end - 1);
    double least = last.stress, largest = last.stress;
    for (std::size_t i = end - 1; i-- > first;) {
        const StrainStress now = row(i);
        least = std::min(least, now.stress);
        largest = std::max(largest, now.stress);
        if (!(largest - least <= plateau_band * largest)) return false;
        if (last.strain - now.strain >= rule.plateau_strain) return true;
    }
    return false;
}

TestState test_state(double stress, double peak, double strain, const TestEnd& end, bool plateau)
{
    check(end);
    const bool counts = peak >= end.least_peak;
    if (counts && stress < end.stop_ratio * peak) return TestState::past_peak;
    if (counts && plateau) return TestState::plateau_reached;
    if (strain <= end.least_strain) return TestState::least_strain_reached;
    return strain >= end.largest_strain ? TestState::largest_strain_reached : TestState::running;
}

}  // namespace flexpm
