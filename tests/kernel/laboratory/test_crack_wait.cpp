// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Loading that waits for cracks: how its velocity follows from what a test dissipates. SI
/// units.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/crack_wait.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace flexpm;

namespace {

constexpr CrackWaitRule rule = { 16.0, 0.01, 0.002, 0.01, 400.0 };

/// What is seen in 100 steps whose fastest work is 1 J, at a part of the peak.
CrackWatch watch(double dissipated, double part_of_peak = 1.0, double fastest_work = 1.0)
{
    return { dissipated, fastest_work, 1e8 * part_of_peak, 1e8, 100.0 };
}

/// Velocity factor once it has settled.
double settled(double factor, const CrackWatch& seen)
{
    for (int look = 0; look < 100; ++look)
        factor = factor_for_cracks(factor, seen, rule);
    return factor;
}

}  // namespace

TEST_CASE("A loading is fast until cracks run, then slower by the fourth power of what they take")
{
    const double start = GENERATE(0.16, 1.0, 16.0);
    CHECK(settled(start, watch(0.0)) == Approx(16.0));
    CHECK(settled(start, watch(0.002)) == Approx(16.0));
    CHECK(settled(start, watch(0.004)) == Approx(1.0));
    CHECK(settled(start, watch(0.003)) == Approx(16.0 * std::pow(2.0 / 3.0, 4)));
}

TEST_CASE("A loading that waits goes on at a hundredth of its fastest velocity")
{
    CHECK(settled(16.0, watch(0.5)) == Approx(0.16));
    CHECK(settled(0.16, watch(1e9)) == Approx(0.16));
    // cracks without a load that feeds them
    CHECK(settled(16.0, watch(1e-9, 1.0, 0.0)) == Approx(0.16));
    CHECK(settled(16.0, watch(1e-9, 1.0, -1.0)) == Approx(0.16));
}

TEST_CASE("A run that has diverged leaves the velocity a number")
{
    const double none = std::nan("");
    for (const CrackWatch& seen : { watch(none), watch(0.1, 1.0, none), watch(0.1, none) }) {
        const double factor = factor_for_cracks(1.0, seen, rule);
        CHECK(std::isfinite(factor));
        CHECK(factor > 0.0);
    }
}

TEST_CASE("Once the stress has fallen from its peak more counts as at rest")
{
    CHECK(settled(1.0, watch(0.01, 0.91)) == Approx(0.16));
    CHECK(settled(1.0, watch(0.01, 0.89)) == Approx(16.0));
    CHECK(settled(1.0, watch(0.02, 0.5)) == Approx(1.0));
}

TEST_CASE("A waiting loading doubles its velocity in a crossing and halves it in a quarter of one")
{
    double factor = 1.0;
    for (int look = 0; look < 4; ++look)
        factor = factor_for_cracks(factor, watch(0.0), rule);
    CHECK(factor == Approx(2.0));
    CHECK(factor_for_cracks(8.0, watch(1.0), rule) == Approx(4.0));
}

TEST_CASE("Ahead of points that will soften a loading falls at once to what they ask for")
{
    const double infinite = std::numeric_limits<double>::infinity();
    CHECK(factor_ahead(16.0, infinite, rule) == 16.0);
    CHECK(factor_ahead(0.16, 2.0, rule) == 0.16);
    CHECK(factor_ahead(16.0, 0.01, rule) == 0.01);
    CHECK(factor_ahead(16.0, 0.0, rule) == Approx(16e-4));
    CHECK(factor_ahead(16.0, -1.0, rule) == Approx(16e-4));
    CHECK(factor_ahead(2.0, std::nan(""), rule) == 2.0);
}

TEST_CASE("A rule of a waiting loading without sense is refused")
{
    const double none = std::nan("");
    for (const CrackWaitRule& bad : { CrackWaitRule { 0.0, 0.01, 0.002, 0.01, 400.0 },
             CrackWaitRule { none, 0.01, 0.002, 0.01, 400.0 },
             CrackWaitRule { 16.0, 0.01, 0.0, 0.01, 400.0 },
             CrackWaitRule { 16.0, 0.01, 0.002, -1.0, 400.0 },
             CrackWaitRule { 16.0, 0.01, 0.002, 0.01, 0.0 },
             CrackWaitRule { 16.0, 0.0, 0.002, 0.01, 400.0 } })
        CHECK_THROWS_AS(factor_for_cracks(1.0, watch(0.0), bad), std::invalid_argument);
    for (double factor : { 0.0, -1.0, none })
        CHECK_THROWS_AS(factor_for_cracks(factor, watch(0.0), rule), std::invalid_argument);
}
