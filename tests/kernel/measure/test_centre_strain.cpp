// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Strains from the centres of grains against the field that moves them. SI units, extension
/// positive.
#include "support/catch.hpp"

#include <flexpm/kernel/measure/centre_strain.hpp>

#include <array>
#include <stdexcept>
#include <vector>

using namespace flexpm;

namespace {

constexpr double size = 1e-3;

/// Centres of squares, `columns` x `rows`, from y = 5 on.
std::vector<std::array<double, 2>> centres(int columns, int rows)
{
    std::vector<std::array<double, 2>> all;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i)
            all.push_back({ (i + 0.5) * size, 5.0 + (j + 0.5) * size });
    }
    return all;
}

StrainGauge gauge(int columns, int rows)
{
    StrainGauge g { 5.0, rows * size, size, {}, {}, {} };
    for (int j = 0; j < rows; ++j) {
        g.left.push_back({ j * columns, size });
        g.right.push_back({ j * columns + columns - 1, size });
    }
    return g;
}

}  // namespace

TEST_CASE("An even field gives its own strains, whatever else moves or turns the specimen")
{
    const auto all = centres(4, 12);
    const double axial = -2e-4, lateral = 5e-5, turn = 3e-4;
    const auto place = [&](int g, int c) { return all[g][c]; };
    const auto moved = [&](int g, int c) {
        const double x = all[g][0], y = all[g][1];
        return c == 0 ? lateral * x - turn * y + 0.1 : axial * y + turn * x - 0.2;
    };
    const SpecimenStrain strain = centre_strain(gauge(4, 12), 48, place, moved);
    CHECK(strain.axial == Approx(axial).epsilon(1e-9));
    CHECK(strain.lateral == Approx(lateral).epsilon(1e-9));
}

TEST_CASE("What happens at the ends, beyond the bands, does not count as axial strain")
{
    const auto all = centres(4, 12);
    const auto place = [&](int g, int c) { return all[g][c]; };
    const auto ends = [&](int g, int c) { return c == 1 && (g < 4 || g >= 44) ? 1e-5 : 0.0; };
    CHECK(centre_strain(gauge(4, 12), 48, place, ends).axial == 0.0);
}

TEST_CASE("A band without a grain is refused")
{
    const auto all = centres(4, 12);
    const auto far = [&](int g, int c) { return all[g][c] - (c == 1 ? 1.0 : 0.0); };
    const auto still = [](int, int) { return 0.0; };
    CHECK_THROWS_AS(centre_strain(gauge(4, 12), 48, far, still), std::invalid_argument);
}
