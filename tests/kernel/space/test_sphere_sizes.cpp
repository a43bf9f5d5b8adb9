// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Number of spheres against their mean volume.
#include <flexpm/kernel/space/sphere_sizes.hpp>

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace flexpm;

TEST_CASE("spheres fill what the porosity leaves", "[space]")
{
    Random random(1);
    double volume = 0.0;
    constexpr int draws = 200000;
    for (int k = 0; k < draws; ++k) {
        const double d = 2e-3 + 2e-3 * random.next();
        volume += pi / 6.0 * d * d * d / draws;
    }
    const int count = sphere_count(0.025 * 0.025 * 0.05, 2e-3, 4e-3, 0.10);
    CHECK(count * volume == Approx(0.9 * 0.025 * 0.025 * 0.05).epsilon(0.005));
    CHECK(sphere_count(pi / 6.0 * 1e-6, 1e-2, 1e-2, 0.0) == 1);
    CHECK(sphere_count(pi / 6.0 * 1e-6, 1e-3, 1e-3, 0.5) == 500);
}

TEST_CASE("wrong sizes of spheres are refused", "[space]")
{
    CHECK_THROWS_WITH(sphere_count(1.0, 2e-3, 1e-3, 0.1), Catch::Contains("swap or correct them"));
    CHECK_THROWS_WITH(
        sphere_count(1.0, 0.0, 1e-3, 0.1), Catch::Contains("smallest diameter = 0 m"));
    CHECK_THROWS_WITH(sphere_count(1.0, 1e-3, 1e-3, 1.0), Catch::Contains("porosity = 1"));
    CHECK_THROWS_WITH(sphere_count(std::nan(""), 1e-3, 1e-3, 0.0), Catch::Contains("volume = nan"));
    CHECK_THROWS_WITH(sphere_count(1e-12, 1e-3, 1e-3, 0.0), Catch::Contains("spheres = 0"));
    CHECK_THROWS_WITH(
        sphere_count(1.0, 1e-5, 1e-5, 0.0), Catch::Contains("must be >= 1 and < 1e8"));
}
