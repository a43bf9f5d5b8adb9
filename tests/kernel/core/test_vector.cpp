// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Vectors of the plane: products that a turn keeps, and lengths beyond the range of
/// squares.
#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include "support/catch.hpp"

using namespace flexpm;

namespace {

Point turned(Point a, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return { c * a.x - s * a.y, s * a.x + c * a.y };
}

}  // namespace

TEST_CASE("products of unit vectors", "[vector]")
{
    const Point x { 1.0, 0.0 }, y { 0.0, 1.0 };
    CHECK(dot(x, y) == 0.0);
    CHECK(cross(x, y) == 1.0);
    CHECK(cross(y, x) == -1.0);
    const Point sum = 2.0 * x + 3.0 * y - x;
    CHECK(sum.x == 1.0);
    CHECK(sum.y == 3.0);
}

TEST_CASE("a turn keeps length, dot and cross product", "[vector]")
{
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const Point a { random.next() - 0.5, random.next() - 0.5 };
        const Point b { random.next() - 0.5, random.next() - 0.5 };
        const double angle = 2.0 * pi * random.next();
        const Point p = turned(a, angle), q = turned(b, angle);
        // round-off of products of numbers below 1
        CHECK(norm(p) == Approx(norm(a)).margin(1e-15));
        CHECK(dot(p, q) == Approx(dot(a, b)).margin(1e-15));
        CHECK(cross(p, q) == Approx(cross(a, b)).margin(1e-15));
        // Lagrange's identity
        const double squares = dot(a, b) * dot(a, b) + cross(a, b) * cross(a, b);
        CHECK(squares == Approx(dot(a, a) * dot(b, b)).epsilon(1e-14));
    }
}

TEST_CASE("lengths have no squares that could overflow or vanish", "[vector]")
{
    CHECK(norm(Point { 3e200, -4e200 }) == Approx(5e200).epsilon(1e-15));
    CHECK(norm(Point { 3e-200, 4e-200 }) == Approx(5e-200).epsilon(1e-15));
}

TEST_CASE("a point is finite if both components are", "[vector]")
{
    const double nan = std::nan("");
    CHECK(is_finite(Point { 1.0, 2.0 }));
    CHECK_FALSE(is_finite(Point { nan, 0.0 }));
    CHECK_FALSE(is_finite(Point { 0.0, -1.0 / 0.0 }));
}

TEST_CASE("a vector of the plane among those of space keeps its bits", "[vector]")
{
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const Point a { random.next() - 0.5, random.next() - 0.5 };
        const Point b { random.next() - 0.5, random.next() - 0.5 };
        const Vector v = a, sum = v + b, twice = 2.0 * v - b;
        CHECK((sum.x == (a + b).x && sum.y == (a + b).y && sum.z == 0.0));
        CHECK((twice.x == (2.0 * a - b).x && twice.y == (2.0 * a - b).y && twice.z == 0.0));
        CHECK(dot(v, b) == dot(a, b));
        CHECK((cross(v, Vector(b)).z == cross(a, b) && cross(v, Vector(b)).x == 0.0));
        CHECK((in_plane(v).x == a.x && in_plane(v).y == a.y));
    }
    // the third component goes in last
    CHECK(dot(Vector { 1e16, -1e16, 1.0 }, Vector { 1.0, 1.0, 1.0 }) == 1.0);
}
