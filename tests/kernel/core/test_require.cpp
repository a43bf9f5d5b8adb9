// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Errors: one line with quantity, value and unit, rule.
#include <flexpm/kernel/core/require.hpp>

#include "support/catch.hpp"

using namespace flexpm;

TEST_CASE("an error is one line of quantity, value, unit and rule", "[require]")
{
    CHECK_THROWS_AS(refuse("width", 0.5, "m", "must be above 1"), std::invalid_argument);
    CHECK_THROWS_WITH(
        refuse("width", 0.5, "m", "must be above 1"), "width = 0.5 m, must be above 1");
    CHECK_THROWS_WITH(refuse("count", 3, "", "must be 4"), "count = 3, must be 4");
    CHECK_THROWS_WITH(refuse("centre", place(Point { 1.0, -2.5 }), "must be inside"),
        "centre = (1, -2.5) m, must be inside");
    CHECK_THROWS_AS(fail("pivot", "0", "must be above 1"), std::runtime_error);
}

TEST_CASE("numbers in errors have the digits that a user gave", "[require]")
{
    CHECK(number(0.004) == "0.004");
    CHECK(number(1.8e14) == "1.8e+14");
    CHECK(number(20.0000001) == "20.0000001");
    CHECK(number(0.1 + 0.2) == "0.3");
}

TEST_CASE("checks refuse what is out of range and what is no number", "[require]")
{
    const double nan = std::nan(""), infinity = 1.0 / 0.0;
    CHECK_NOTHROW(check_finite("x", -1.0, ""));
    CHECK_THROWS_AS(check_finite("x", nan, ""), std::invalid_argument);
    CHECK_NOTHROW(check_not_negative("x", 0.0, ""));
    CHECK_THROWS_AS(check_not_negative("x", -1e-300, ""), std::invalid_argument);
    CHECK_THROWS_AS(check_not_negative("x", nan, ""), std::invalid_argument);
    CHECK_NOTHROW(check_positive("x", 1e-300, ""));
    CHECK_THROWS_AS(check_positive("x", 0.0, ""), std::invalid_argument);
    CHECK_THROWS_AS(check_positive("x", infinity, ""), std::invalid_argument);
}
