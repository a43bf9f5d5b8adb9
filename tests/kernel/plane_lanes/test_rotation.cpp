// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bonded grains turned as a rigid body, paper Eqs. 5-12. Tension positive.
/// The gap is rebuilt from opening and slip along the normal of the centres, which itself turns by
/// slip / distance while a pair slides: results are exact but for that angle.
#include "support/catch.hpp"

#include "support/driven.hpp"
#include "support/law_path.hpp"

using namespace driven;

namespace {

constexpr double size = 3e-3;  // [m]

Point turned(Point p, double angle)
{
    return { std::cos(angle) * p.x - std::sin(angle) * p.y,
        std::sin(angle) * p.x + std::cos(angle) * p.y };
}

/// A pair of held grains, the second moved by `gap` in 50 steps.
Assembly loaded(Point gap, const flexpm::ContactMaterial& m)
{
    Assembly a = specimens::assemble(specimens::grid(2, 1, size), specimens::options(m));
    hold_all(a);
    set_velocity(a, 1, Point { gap.x / 50.0, gap.y / 50.0 });
    run(a, 50);
    return a;
}

/// Turns all nodes about the origin in equal steps.
void turn(Assembly& a, double angle, int steps)
{
    const Assembly start = a;
    for (int k = 1; k <= steps; ++k) {
        aim(a, 1.0, [&](int i) { return turned(start.grains.point_at(i), angle * k / steps); });
        run(a, 1);
    }
}

}  // namespace

TEST_CASE("An unloaded pair turned by any angle carries no force")
{
    Assembly a = loaded({ 0.0, 0.0 }, specimens::granite_contact());
    for (double angle : { 0.3, 0.5 * M_PI, -2.5 }) {
        turn(a, angle, 50);
        CHECK(std::hypot(resultant(a, 0).x, resultant(a, 0).y)
            < 1e-6 * 8.5e6 * size * specimens::thickness);
        for (int p = 0; p < 3; ++p)
            CHECK(flexpm::damage_of(a.contacts, 0, p) == 0.0);
    }
}

TEST_CASE("A loaded pair turned by 90 degrees keeps opening and slip, and its force turns")
{
    const auto m = specimens::strong_contact();
    for (const Point gap : { Point { 1e-7, 0.0 }, Point { 0.0, 1e-7 }, Point { -2e-7, 3e-7 } }) {
        for (int steps : { 1, 7, 300 }) {  // of any size: gap and normal turn alike
            CAPTURE(gap.x, gap.y, steps);
            Assembly a = loaded(gap, m);
            const Point before = resultant(a, 0);
            const flexpm::PointState old = a.contacts.point_state(0, 1);
            turn(a, 0.5 * M_PI, steps);
            const Point after = resultant(a, 0), expected = turned(before, 0.5 * M_PI);
            const double angle =
                2.0 * std::hypot(gap.x, gap.y) / size;  // the normal is off by half of it
            const double scale = angle * std::hypot(before.x, before.y);
            CHECK(after.x == Approx(expected.x).margin(scale));
            CHECK(after.y == Approx(expected.y).margin(scale));
            const flexpm::PointState now = a.contacts.point_state(0, 1);
            const double size_of_gap = std::hypot(gap.x, gap.y);
            CHECK(now.opening == Approx(old.opening).margin(angle * size_of_gap));
            CHECK(now.slip == Approx(old.slip).margin(angle * size_of_gap));
        }
    }
}

TEST_CASE("A cracked pair that has slid far keeps its pressure when it turns")
{
    const auto m = specimens::granite_contact();
    Assembly a = loaded({ 0.0, 1e-4 }, m);
    for (int p = 0; p < 3; ++p)
        REQUIRE(flexpm::damage_of(a.contacts, 0, p) == 1.0);
    // pressed by 40 MPa along the present normal
    const Point n = a.contacts.normal(0);
    const double push = a.contacts.point_state(0, 1).opening + 40e6 / m.normal_stiffness;
    const double speed = -push / 50.0;
    set_velocity(a, 1, Point { speed * n.x, speed * n.y });
    run(a, 50);
    const Point before = resultant(a, 0);
    CHECK(std::hypot(before.x, before.y) > 0.99 * 40e6 * size * specimens::thickness);
    turn(a, 0.1, 100);
    const Point after = resultant(a, 0);
    CHECK(std::hypot(after.x, after.y) == Approx(std::hypot(before.x, before.y)).epsilon(0.02));
    const double friction_angle = std::atan(m.friction);
    const Point now = a.contacts.normal(0);
    CHECK(-(after.x * now.x + after.y * now.y)
        >= 0.99 * std::cos(friction_angle) * std::hypot(after.x, after.y));
}
