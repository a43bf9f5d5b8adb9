// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/crack_wait.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

void check(const CrackWaitRule& rule)
{
    check_positive("largest velocity factor", rule.fastest, "");
    check_positive("smallest velocity factor over the largest", rule.slowest, "");
    check_positive("dissipated share of running cracks", rule.running_share, "");
    check_positive("dissipated share after the peak", rule.share_after_peak, "");
    check_positive("steps of a crossing", rule.crossing, "");
}

/// Part of the fastest velocity that suits what is dissipated [-]. Without a stress all that is
/// dissipated counts.
double wanted_part(const CrackWatch& seen, const CrackWaitRule& rule)
{
    const double allowed = (seen.has_fallen() ? rule.share_after_peak : rule.running_share)
        * std::max(seen.fastest_work, 0.0);
    // no number: the run has diverged, which is seen elsewhere
    if (!(seen.dissipated > allowed)) return 1.0;
    const double square = allowed / seen.dissipated * (allowed / seen.dissipated);
    return std::max(square * square, rule.slowest);
}

}  // namespace

double factor_for_cracks(double factor, const CrackWatch& seen, const CrackWaitRule& rule)
{
    check(rule);
    check_positive("velocity factor", factor, "");
    const double crossings = seen.steps / rule.crossing;
    const double wanted = rule.fastest * wanted_part(seen, rule);
    return std::clamp(wanted, factor * std::exp2(-4.0 * crossings), factor * std::exp2(crossings));
}

double factor_ahead(double wanted, double most, const CrackWaitRule& rule)
{
    check(rule);
    const double least = slowest_ahead * rule.slowest * rule.fastest;
    // no number: the run has diverged, which is seen elsewhere
    return most < wanted ? std::min(std::max(most, least), wanted) : wanted;
}

}  // namespace flexpm
