// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Number and radii of discs: the paper's counts, bounds, moments, the generator's standard
/// value.
#include "support/disc_samples.hpp"

#include <flexpm/kernel/geometry/disc_sizes.hpp>
#include <flexpm/kernel/geometry/insertion.hpp>

using namespace flexpm_test;

TEST_CASE("the paper's specimens have 1630 and 640 discs", "[radii]")
{
    REQUIRE(disc_count(0.08 * 0.16, 2e-3, 4e-3, 0.10) == 1630);
    REQUIRE(disc_count(pi * 0.04 * 0.04, 2e-3, 4e-3, 0.10) == 640);
}

TEST_CASE("the generator gives the values that the C++ standard prescribes", "[radii]")
{
    // [rand.predef]: the 10000th output of a default-constructed mt19937_64
    Random random(5489);
    for (int k = 0; k < 9999; ++k)
        random.next();
    REQUIRE(random.next() == static_cast<double>(9981545732273789042ull >> 11) * 0x1p-53);
}

TEST_CASE("diameters are uniform in their interval", "[radii]")
{
    const int n = 100000;
    const auto radii = disc_radii(n, 2.0, 4.0, 7);
    double sum = 0.0, squares = 0.0;
    for (double r : radii) {
        REQUIRE(r >= 1.0);
        REQUIRE(r < 2.0);
        sum += r;
        squares += r * r;
    }
    const double mean = sum / n, variance = squares / n - mean * mean;
    REQUIRE(mean == Approx(1.5).margin(5.0 / std::sqrt(12.0 * n)));
    REQUIRE(variance == Approx(1.0 / 12.0).epsilon(0.02));
    REQUIRE(disc_radii(n, 2.0, 4.0, 7) == radii);
    REQUIRE(disc_radii(n, 2.0, 4.0, 8) != radii);
}

TEST_CASE("inserted discs overlap neither each other nor the outline", "[radii]")
{
    const auto radii = disc_radii(300, 0.5, 1.5, 3);
    const Outline outline = GENERATE(rectangle(15.0, 20.0), Outline::circle({ 3.0, -2.0 }, 9.5));
    const auto centres = insert_discs(radii, outline, 0.5, 11);
    for (std::size_t i = 0; i < radii.size(); ++i) {
        REQUIRE(distance_inside(outline, centres[i]) >= 0.5 * radii[i]);
        for (std::size_t j = 0; j < i; ++j)
            REQUIRE(std::hypot(centres[i].x - centres[j].x, centres[i].y - centres[j].y)
                >= 0.5 * (radii[i] + radii[j]));
    }
    REQUIRE_THROWS_AS(insert_discs({ 40.0 }, outline, 0.5, 1), std::invalid_argument);
}

TEST_CASE("wrong values are refused", "[radii]")
{
    REQUIRE_THROWS_AS(disc_count(1.0, 0.0, 1.0, 0.1), std::invalid_argument);
    REQUIRE_THROWS_AS(disc_count(1.0, 0.2, 0.1, 0.1), std::invalid_argument);
    REQUIRE_THROWS_AS(disc_count(1.0, 0.1, 0.2, 1.0), std::invalid_argument);
    REQUIRE_THROWS_AS(disc_count(1.0, 0.1, 0.2, NAN), std::invalid_argument);
    REQUIRE_THROWS_AS(disc_count(-1.0, 0.1, 0.2, 0.1), std::invalid_argument);
    REQUIRE_THROWS_AS(disc_count(1.0, 10.0, 20.0, 0.1), std::invalid_argument);
    REQUIRE_THROWS_AS(disc_radii(0, 0.1, 0.2, 1), std::invalid_argument);
}
