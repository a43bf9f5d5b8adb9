// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/loading_rate.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

double dissipated_share(const Dissipation& before, const Dissipation& now)
{
    const double taken = now.damage + now.friction - before.damage - before.friction;
    const double work = now.boundary_work - before.boundary_work;
    if (!(taken > 0.0)) return 0.0;
    return work > 0.0 ? taken / work : std::numeric_limits<double>::infinity();
}

namespace {

void check(const LoadingRateRule& rule)
{
    check_positive("steps of a crossing", rule.crossing, "");
    check_not_negative("dissipated share of the slowest loading", rule.slow_share, "");
    if (!(std::isfinite(rule.fastest) && rule.fastest >= 1.0)) {
        refuse("fastest velocity factor", rule.fastest, "", "must be a finite number, at least 1");
    }
}

}  // namespace

double next_velocity_factor(double factor, double share, double steps, const LoadingRateRule& rule)
{
    check(rule);
    check_positive("velocity factor", factor, "");
    const double crossings = steps / rule.crossing;
    const double wanted =
        share > 0.0 ? std::clamp(rule.slow_share / share, 1.0, rule.fastest) : rule.fastest;
    return std::clamp(wanted, factor * std::exp2(-4.0 * crossings), factor * std::exp2(crossings));
}

}  // namespace flexpm
