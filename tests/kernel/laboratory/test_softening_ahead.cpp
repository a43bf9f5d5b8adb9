// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How slowly a loading must come to points that will soften: distances to strengths in
/// closed form. SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>

#include "support/specimens.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace flexpm;

namespace {

constexpr double edge = 3e-3, speed = 1e-9, dt = 2.0;
constexpr SofteningRule rule = { 0.01, 50.0 };
constexpr double crossing = 100.0;  ///< of the rule [s]

/// Two square grains, one upon the other.
Assembly pair_of(const ContactMaterial& contact = specimens::granite_contact())
{
    return specimens::assemble(specimens::grid(1, 2, edge), specimens::options(contact));
}

/// Velocities at which a grain moves as a whole and all others rest.
Array<double> moving(const Assembly& a, int grain, Point velocity)
{
    Array<double> v(a.grains.velocity.size(), 0.0);
    for (int n = 0; n < a.grains.nodes_of(grain); ++n)
        set_vector(v, a.grains.node(grain, n), velocity);
    return v;
}

void set_states(Assembly& a, const PointState& s)
{
    for (int c = 0; c < a.contacts.count; ++c) {
        for (int p = 0; p < a.contacts.points_of(c); ++p)
            a.contacts.set_point_state(c, p, s);
    }
}

double factor(const Assembly& a, Point velocity)
{
    return factor_before_softening(a, moving(a, 1, velocity), dt, rule);
}

}  // namespace

TEST_CASE(
    "Far from its strength a loading may take a crossing for what is left, near it the growth")
{
    Assembly a = pair_of();
    const LawParameters& law = a.contacts.laws[0];
    const double way = law.elastic_opening;
    const double borne = GENERATE(0.0, 0.5, 0.985, 0.995, 1.0);
    PointState s;
    s.opening = s.max_opening = borne * way;
    set_states(a, s);
    const double missing = std::max(1.0 - borne, rule.growth);
    CHECK(factor(a, { 0.0, speed }) == Approx(missing * way / speed / crossing));
    CHECK(std::isinf(factor(a, { 0.0, -speed })));
    CHECK(std::isinf(factor(a, {})));
}

TEST_CASE("Under pressure the way to the strength is that of Mohr and Coulomb, in both senses")
{
    const double sense = GENERATE(-1.0, 1.0);
    Assembly a = pair_of();
    const LawParameters& law = a.contacts.laws[0];
    const double pressure = 5e6, strength = law.cohesion + law.friction * pressure;
    PointState s;
    s.opening = -pressure / law.normal_stiffness;
    s.shear_traction = 0.0;
    set_states(a, s);
    const double rate = law.shear_stiffness * speed;
    CHECK(factor(a, { sense * speed, 0.0 }) == Approx(strength / rate / crossing));
    // against the sense in which it moves it would have to come back first
    s.shear_traction = 0.9 * strength;
    set_states(a, s);
    const double one = factor(a, { speed, 0.0 }), other = factor(a, { -speed, 0.0 });
    CHECK(std::min(one, other) == Approx(0.1 * strength / rate / crossing));
    CHECK(std::max(one, other) == Approx(1.9 * strength / rate / crossing));
}

TEST_CASE("A crack that sticks comes to its friction, one that slides or is open to nothing")
{
    Assembly a = pair_of();
    const LawParameters& law = a.contacts.laws[0];
    const double pressure = 5e6, strength = law.friction * pressure;
    PointState s;
    s.shear_damage = 1.0;
    s.opening = -pressure / law.normal_stiffness;
    set_states(a, s);
    const double rate = law.shear_stiffness * speed;
    CHECK(factor(a, { speed, 0.0 }) == Approx(strength / rate / crossing));
    s.shear_traction = strength;
    set_states(a, s);
    CHECK(std::isinf(factor(a, { speed, 0.0 })));
    s.opening = 1e-6;
    s.shear_traction = 0.0;
    set_states(a, s);
    CHECK(std::isinf(factor(a, { speed, 0.0 })));
}

TEST_CASE("A joint's point that has begun to soften still counts, one that has lost a tenth or is "
          "of rock does not")
{
    Assembly a = pair_of();
    const bool jointed = GENERATE(true, false);
    for (int& joint : a.contacts.joint)
        joint = jointed ? 0 : -1;
    const LawParameters& law = a.contacts.laws[0];
    const double damage = GENERATE(0.05, 0.2);
    PointState s;
    s.opening = s.max_opening =
        law.elastic_opening + damage * (law.critical_opening - law.elastic_opening);
    set_states(a, s);
    const double slow = rule.growth * (1.0 - damage) * law.elastic_opening / speed / crossing;
    if (damage < 0.1 && jointed)
        CHECK(factor(a, { 0.0, speed }) == Approx(slow));
    else
        CHECK(std::isinf(factor(a, { 0.0, speed })));
}

TEST_CASE("Points that make up a small part of a cut may come faster, brittle ones may not")
{
    const auto brittle = [] {
        ContactMaterial m = specimens::granite_contact();
        m.tensile_fracture_energy = m.shear_fracture_energy = 0.0;
        return joint_law(m);
    }();
    Assembly a = specimens::assemble(specimens::grid(30, 30, edge), specimens::options());
    // a grain of the top row has three edges, one of them to the row below: all are within a tenth
    const int corner = 899;
    const Array<double> v = moving(a, corner, { 0.0, speed });
    const auto of_rock = factor_before_softening(a, v, dt, rule);
    CHECK(std::isfinite(of_rock));
    // points of one edge alone, a thirtieth of the cut, may go
    for (int c = 0; c < a.contacts.count; ++c) {
        const auto [g, h] = a.contacts.pairs[c];
        const bool below = (g == corner || h == corner) && std::abs(g - h) == 30;
        for (int p = 0; p < a.contacts.points_of(c) && !below; ++p)
            a.contacts.state(c, p, &PointState::shear_damage) = 1.0;
    }
    CHECK(std::isinf(factor_before_softening(a, v, dt, rule)));
    a.contacts.laws[0] = brittle;
    CHECK(factor_before_softening(a, v, dt, rule)
        == Approx(brittle.elastic_opening / speed / crossing));
}

TEST_CASE("A rule of what lies ahead without sense is refused")
{
    const Assembly a = pair_of();
    const Array<double> v = moving(a, 1, { 0.0, speed });
    for (const double bad : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() }) {
        CHECK_THROWS_AS(factor_before_softening(a, v, dt, { bad, 50.0 }), std::invalid_argument);
        CHECK_THROWS_AS(factor_before_softening(a, v, dt, { 0.01, bad }), std::invalid_argument);
    }
}

TEST_CASE("The elastic limit follows from the strengths of the point that reaches one first")
{
    // one bond in pure tension: the top moves until K_n u = sigma_t
    Assembly a = specimens::assemble(specimens::grid(1, 2, 3e-3), specimens::options());
    grip_bottom(a);
    move_top(a, 1e-9);
    Array<double> v(a.grains.velocity.size(), 0.0);
    for (int n = 0; n < a.grains.nodes_of(1); ++n)
        v[component(a.grains.node(1, n), 1)] = 1e-9;  // the upper grain as a whole
    const LawParameters& law = a.contacts.laws[0];
    CHECK(elastic_time(a, v) == Approx(law.elastic_opening / 1e-9));
    for (double& value : v)
        value = -value;
    CHECK(std::isinf(elastic_time(a, v)));
}
