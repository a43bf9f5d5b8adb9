// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Friction of a cracked point that falls to a residual value: its parameters and their ranges.
#include "support/catch.hpp"

#include "support/law_path.hpp"

#include <limits>
#include <stdexcept>

using namespace law_path;

namespace {

/// mu = 0.6, mu_r = 0.35 after 50 micrometres.
ContactMaterial weakening()
{
    ContactMaterial m = specimens::granite_contact();
    m.friction = 0.6;
    m.residual_friction = 0.35;
    m.slip_length = 5e-5;
    return m;
}

}  // namespace

TEST_CASE("Friction falls linearly with the slip since the crack to its residual value")
{
    const LawParameters p = flexpm::make_law(weakening());
    CHECK(flexpm::law::weakens(p));
    CHECK(flexpm::law::friction_after(p, 0.0) == 0.6);
    CHECK(flexpm::law::friction_after(p, 2e-5) == Approx(0.5).epsilon(1e-14));
    CHECK(flexpm::law::friction_after(p, 5e-5) == Approx(0.35).epsilon(1e-14));
    for (double far : { 6e-5, 1.0, 1e300 })
        CHECK(flexpm::law::friction_after(p, far) == 0.35);
    CHECK(flexpm::law::slip_to_residual(p) == Approx(5e-5).epsilon(1e-14));
}

TEST_CASE("Without a slip length, or with equal frictions, friction stays to the bit")
{
    ContactMaterial none = weakening(), equal = weakening();
    none.slip_length = 0.0;
    equal.residual_friction = equal.friction;
    for (const ContactMaterial& m : { none, equal }) {
        const LawParameters p = flexpm::make_law(m);
        CHECK_FALSE(flexpm::law::weakens(p));
        CHECK(p.residual_friction == m.friction);
        CHECK(flexpm::law::slip_to_residual(p) == 0.0);
        for (double slip : { 0.0, 1e-6, 1.0 })
            CHECK(flexpm::law::friction_after(p, slip) == m.friction);
    }
}

TEST_CASE("The shortest slip length is one step of slip")
{
    ContactMaterial m = weakening();
    m.slip_length = std::numeric_limits<double>::denorm_min();
    const LawParameters p = flexpm::make_law(m);
    CHECK(flexpm::law::friction_after(p, 0.0) == m.friction);
    CHECK(flexpm::law::friction_after(p, 1e-12) == m.residual_friction);
}

TEST_CASE("A residual friction above the friction, below zero or below the dilation is refused")
{
    ContactMaterial m = weakening();
    m.residual_friction = 0.7;
    CHECK_THROWS_WITH(flexpm::make_law(m),
        "residual_friction = 0.7, must be <= the friction 0.6; give a smaller one");
    m.residual_friction = -0.1;
    CHECK_THROWS_AS(flexpm::make_law(m), std::invalid_argument);
    m = weakening();
    m.slip_length = -1e-5;
    CHECK_THROWS_AS(flexpm::make_law(m), std::invalid_argument);
    m = weakening();
    m.dilation = 0.4;
    m.dilation_slip = 1e-5;
    CHECK_THROWS_WITH(flexpm::make_law(m),
        "residual_friction = 0.35, must be >= the dilation 0.4; give a larger one");
    m.residual_friction = m.dilation;
    CHECK_NOTHROW(flexpm::make_law(m));
}
