// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  End of a test: stresses are those above the confinement. SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/end_rule.hpp>

#include <cmath>
#include <stdexcept>

using namespace flexpm;

namespace {

const TestEnd rule = { 0.5, 20e6, -1e-3, 4e-3 };

}  // namespace

TEST_CASE("A test is over once the stress has fallen below its part of the peak")
{
    CHECK(test_state(76e6, 150e6, 1e-3, rule) == TestState::running);
    CHECK(test_state(74e6, 150e6, 1e-3, rule) == TestState::past_peak);
    CHECK(test_state(-3e6, 150e6, 1e-3, rule) == TestState::past_peak);
}

TEST_CASE("A fall from less than the least peak does not count")
{
    CHECK(test_state(1e6, 19e6, 1e-3, rule) == TestState::running);
    CHECK(test_state(1e6, 20e6, 1e-3, rule) == TestState::past_peak);
}

TEST_CASE("A test that unloads is over at its least strain")
{
    CHECK(test_state(1e6, 10e6, -0.9e-3, rule) == TestState::running);
    CHECK(test_state(1e6, 10e6, -1e-3, rule) == TestState::least_strain_reached);
}

TEST_CASE("A test is over at its largest strain in any case")
{
    CHECK(test_state(150e6, 150e6, 4e-3, rule) == TestState::largest_strain_reached);
    CHECK(test_state(1e6, 19e6, 4e-3, rule) == TestState::largest_strain_reached);
    CHECK(test_state(1e6, 150e6, 4e-3, rule) == TestState::past_peak);
}

TEST_CASE("An end that could never come is refused")
{
    const double none = std::nan("");
    for (double ratio : { none, -0.1, 1.1 })
        CHECK_THROWS_AS(
            test_state(0.0, 0.0, 0.0, { ratio, 0.0, -1.0, 1.0 }), std::invalid_argument);
    CHECK_THROWS_AS(test_state(0.0, 0.0, 0.0, { 0.5, none, -1.0, 1.0 }), std::invalid_argument);
    CHECK_THROWS_AS(test_state(0.0, 0.0, 0.0, { 0.5, 0.0, none, 1.0 }), std::invalid_argument);
    CHECK_THROWS_AS(test_state(0.0, 0.0, 0.0, { 0.5, 0.0, -1.0, none }), std::invalid_argument);
    CHECK(test_state(0.0, 0.0, 0.0, {}) == TestState::running);
}
