// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Colours of known values.
#include <flexpm/kernel/view/colours.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <limits>

using flexpm::Colour;

namespace {

bool same(Colour a, Colour b) { return a.red == b.red && a.green == b.green && a.blue == b.blue; }

/// As a black-and-white printer shows it.
double brightness(Colour c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; }

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("A range has the finite values alone", "[view]")
{
    const double inf = std::numeric_limits<double>::infinity();
    const auto found = flexpm::range_of({ not_known, -2.0, 3.0, inf, 1.0, -inf });
    CHECK(found.low == -2.0);
    CHECK(found.high == 3.0);
    CHECK(flexpm::range_of({ not_known }).high == 0.0);
}

TEST_CASE("Colours grow brighter from the low end to the high one, and stay beyond", "[view]")
{
    const flexpm::ValueRange range { -1.0, 3.0 };
    double before = -1.0;
    for (int i = 0; i <= 100; ++i) {
        const double now = brightness(flexpm::colour_of(-1.0 + 0.04 * i, range));
        CHECK(now > before);
        before = now;
    }
    CHECK(same(flexpm::colour_of(-9.0, range), flexpm::colour_of(-1.0, range)));
    CHECK(same(flexpm::colour_of(9.0, range), flexpm::colour_of(3.0, range)));
}

TEST_CASE("Equal values have the colour in the middle, nan is grey", "[view]")
{
    CHECK(same(flexpm::colour_of(5.0, { 5.0, 5.0 }), flexpm::colour_of(0.5, { 0.0, 1.0 })));
    const Colour grey = flexpm::colour_of(not_known, { 0.0, 1.0 });
    CHECK(grey.red == grey.green);
    CHECK(grey.green == grey.blue);
}

TEST_CASE("The first eight kinds differ, then their colours come again", "[view]")
{
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < i; ++j)
            CHECK_FALSE(same(flexpm::colour_of_kind(i), flexpm::colour_of_kind(j)));
    }
    CHECK(same(flexpm::colour_of_kind(8), flexpm::colour_of_kind(1)));
}
