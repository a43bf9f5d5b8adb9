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

namespace {

/// Record with a rise of 1 % strain to a stress of 100 MPa, then a strain that a wave of a relative
/// amplitude follows.
StrainStress after_rise(std::size_t i, double amplitude)
{
    const double strain = 1e-5 * static_cast<double>(i);
    if (strain <= 0.01) return { strain, 100e6 * strain / 0.01 };
    return { strain, 100e6 * (1.0 - amplitude * (i % 2 == 0)) };
}

/// Index behind the first rows that are a plateau, 0: none of 4000 are.
std::size_t first_plateau(double amplitude, std::size_t first, double length)
{
    TestEnd end;
    end.plateau_strain = length;
    const auto row = [&](std::size_t i) { return after_rise(i, amplitude); };
    for (std::size_t rows = 1; rows <= 4000; ++rows)
        if (is_plateau(row, first, rows, end)) return rows;
    return 0;
}

}  // namespace

TEST_CASE("A stress that is constant within two per cent over the strain is a plateau")
{
    // the rise reaches 98 % of the plateau at a strain of 0.98 %: the window begins there
    CHECK(first_plateau(0.0, 0, 0.005) == Approx(1481).margin(1));
    CHECK(first_plateau(0.019, 0, 0.005) == Approx(1481).margin(6));
    CHECK(first_plateau(0.021, 0, 0.005) == 0);
    CHECK(first_plateau(0.0, 0, 0.0) == 0);  // the rule is off
}

TEST_CASE("Rows before the loading belong to no plateau")
{
    CHECK(first_plateau(0.0, 2000, 0.005) == Approx(2501).margin(1));
}

TEST_CASE("A test is over on a plateau that has reached the least peak, a fall comes first")
{
    CHECK(test_state(150e6, 150e6, 1e-3, rule, true) == TestState::plateau_reached);
    CHECK(test_state(19e6, 19e6, 1e-3, rule, true) == TestState::running);
    CHECK(test_state(74e6, 150e6, 1e-3, rule, true) == TestState::past_peak);
    CHECK(test_state(150e6, 150e6, 4e-3, rule, true) == TestState::plateau_reached);
}

TEST_CASE("A stress of zero is no plateau before the least peak")
{
    TestEnd end = rule;
    end.plateau_strain = 1e-3;
    const auto row = [](std::size_t i) {
        return StrainStress { 1e-5 * static_cast<double>(i), 0.0 };
    };
    CHECK(test_state(0.0, 0.0, 1e-3, end, is_plateau(row, 0, 200, end)) == TestState::running);
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
    CHECK_THROWS_AS(
        test_state(0.0, 0.0, 0.0, { 0.5, 0.0, -1.0, 1.0, -1e-3 }), std::invalid_argument);
    CHECK(test_state(0.0, 0.0, 0.0, {}) == TestState::running);
}
