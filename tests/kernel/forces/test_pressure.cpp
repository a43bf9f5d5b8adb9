// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pressure on boundary edges: resultant, direction, work, paper Sec. 4.2. Compressive
/// pressure is positive.
#include "support/catch.hpp"

#include <flexpm/kernel/forces/sides.hpp>

#include "support/driven.hpp"

using namespace driven;

namespace {

constexpr double pressure = 4e6;  // [Pa]

/// A held specimen with the same pressure on all sides.
Assembly pressed(const specimens::Specimen& s, int sides)
{
    Assembly a = specimens::assemble(s, specimens::options(specimens::strong_contact()));
    hold_all(a);
    for (int side = 0; side < sides; ++side)
        flexpm::set_pressure(a, side, pressure);
    return a;
}

Point edge_force(const Assembly& a, int edge, int end)
{
    const int first = flexpm::Facets::force_index(edge, flexpm::FacetRow::of_pressure);
    return vector_at(a.facets.forces, first + end * flexpm::node_stride);
}

struct Resultant {
    double x = 0.0, y = 0.0, moment = 0.0, size = 0.0;
};

Resultant resultant_of_edges(const Assembly& a)
{
    Resultant r;
    for (int e = 0; e < a.facets.count; ++e) {
        for (int end : { 0, 1 }) {
            const Point f = edge_force(a, e, end), p = a.grains.point_at(a.facets.nodes(e)[end]);
            r.x += f.x;
            r.y += f.y;
            r.moment += p.x * f.y - p.y * f.x;
            r.size += std::hypot(f.x, f.y);
        }
    }
    return r;
}

double area(const Assembly& a)
{
    double twice = 0.0;
    for (int e = 0; e < a.facets.count; ++e) {
        const auto n = a.facets.nodes(e);
        const Point p = a.grains.point_at(n[0]), q = a.grains.point_at(n[1]);
        twice += p.x * q.y - p.y * q.x;
    }
    return 0.5 * twice;
}

/// A large affine motion: turned, stretched and sheared, a step at a time.
Point moved(Point p, double share)
{
    const double angle = 0.9 * share, c = std::cos(angle), s = std::sin(angle);
    const double x = (1.0 + 0.3 * share) * p.x + 0.2 * share * p.y, y = (1.0 - 0.1 * share) * p.y;
    return { c * x - s * y + 1e-3 * share, s * x + c * y };
}

void move_to(Assembly& a, double share)
{
    aim(a, 1.0, [&](int i) { return moved(vector_at(a.grains.reference, i), share); });
    run(a, 1);
}

}  // namespace

TEST_CASE("Uniform pressure on a closed outline has no resultant, however deformed")
{
    for (const auto& s :
        { specimens::grid(3, 2, 3e-3), specimens::random_grains(9e-3, 6e-3, 3e-3, 4) }) {
        Assembly a = pressed(s, 4);
        for (int k = 0; k <= 4; ++k) {
            move_to(a, k / 4.0);
            const Resultant r = resultant_of_edges(a);
            CHECK(std::hypot(r.x, r.y) < 1e-13 * r.size);
            CHECK(std::fabs(r.moment) < 1e-13 * r.size * 10e-3);
        }
    }
}

TEST_CASE("Pressure follows the deformed edge: pressure times its present length, inwards")
{
    Assembly a = pressed(specimens::hexagon(), 6);
    move_to(a, 1.0);
    for (int e = 0; e < a.facets.count; ++e) {
        const auto n = a.facets.nodes(e);
        const Point p =
            moved({ a.grains.reference[n[0]], a.grains.reference[component(n[0], 1)] }, 1.0);
        const Point q =
            moved({ a.grains.reference[n[1]], a.grains.reference[component(n[1], 1)] }, 1.0);
        const double half = 0.5 * pressure * specimens::thickness;
        for (int end : { 0, 1 }) {
            const Point f = edge_force(a, e, end);
            // corners run counter-clockwise: inside is to the left
            CHECK(f.x == Approx(-half * (q.y - p.y)).epsilon(1e-10).margin(1e-9));
            CHECK(f.y == Approx(half * (q.x - p.x)).epsilon(1e-10).margin(1e-9));
        }
    }
}

TEST_CASE("The work of pressure is pressure times the volume given up")
{
    Assembly a = pressed(specimens::hexagon(), 6);
    run(a, 1);  // the pressure is on before anything moves
    const double before = area(a);
    for (int k = 1; k <= 20; ++k)
        move_to(a, k / 20.0);
    const double given_up = (before - area(a)) * specimens::thickness;
    CHECK(std::fabs(given_up) > 0.1 * before * specimens::thickness);
    CHECK(a.ledger.pressure_work == Approx(pressure * given_up).epsilon(1e-10));
}

TEST_CASE("A side that the outline has not is refused")
{
    Assembly a = pressed(specimens::grid(2, 2, 2e-3), 4);
    for (int side : { -1, 4, 99 }) {
        CHECK_THROWS_WITH(flexpm::set_pressure(a, side, pressure),
            Catch::Contains("side = " + std::to_string(side)));
        CHECK_THROWS_AS(flexpm::side_nodes(a, side), std::invalid_argument);
    }
}
