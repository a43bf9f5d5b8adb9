// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Constant-strain triangle against closed forms of plane elasticity. SI units.
#include "support/specimens.hpp"

#include <flexpm/kernel/fem/triangle.hpp>

#include "support/catch.hpp"

#include <array>
#include <cmath>

using namespace flexpm;

namespace {

constexpr double size = 1e-3;  // about the size of the triangles [m]

using Corners = std::array<Point, 3>;

Corners random_corners(Random& random)
{
    for (;;) {
        Corners p;
        for (Point& q : p)
            q = { 2.0 * size * random.next(), 2.0 * size * random.next() };
        const double twice_area =
            (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        if (twice_area > 0.5 * size * size) return p;
    }
}

Corners random_displacements(Random& random, double amplitude)
{
    Corners u;
    for (Point& v : u)
        v = { amplitude * (random.next() - 0.5), amplitude * (random.next() - 0.5) };
    return u;
}

Point rotate(Point p, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return { c * p.x - s * p.y, s * p.x + c * p.y };
}

/// Displacements that bring the corners, already displaced by `u`, to where a rotation has them.
Corners spun(const Corners& p, const Corners& u, double angle)
{
    Corners v;
    for (int i = 0; i < 3; ++i) {
        const Point r = rotate({ p[i].x + u[i].x, p[i].y + u[i].y }, angle);
        v[i] = { r.x - p[i].x, r.y - p[i].y };
    }
    return v;
}

std::array<Point, 3> forces(const TriangleShape& s, const PlaneStiffness& c, const Corners& u)
{
    const TriangleForces f = triangle_forces(s, c, u[0], u[1], u[2]);
    return { { { -f.f1x - f.f2x, -f.f1y - f.f2y }, { f.f1x, f.f1y }, { f.f2x, f.f2y } } };
}

double energy(const TriangleShape& s, const PlaneStiffness& c, const Corners& u)
{
    return triangle_energy(s, c, u[0], u[1], u[2]);
}

}  // namespace

TEST_CASE("uniaxial stress gives Hooke's strains in plane stress and plane strain", "[triangle]")
{
    const double young = 25.8e9, nu = 0.23;
    for (const Plane plane : { Plane::stress, Plane::strain }) {
        const PlaneStiffness c = plane_stiffness(specimens::granite(plane));
        const bool thin = plane == Plane::stress;
        const double modulus = thin ? young : young / (1.0 - nu * nu);
        const double ratio = thin ? nu : nu / (1.0 - nu);
        const Tensor s = stress(c, { 1e-3, -ratio * 1e-3, 2e-4 });
        CHECK(s.xx == Approx(modulus * 1e-3).epsilon(1e-14));
        CHECK(s.yy == Approx(0.0).margin(1e-14 * modulus * 1e-3));
        CHECK(s.xy == Approx(young / (1.0 + nu) * 2e-4).epsilon(1e-14));
    }
}

TEST_CASE("a linear displacement field has its gradient in every triangle", "[triangle]")
{
    Random random(1);
    const Gradient h { 1e-3, -4e-4, 7e-4, -2e-3 };
    for (int i = 0; i < 100; ++i) {
        const Corners p = random_corners(random);
        const TriangleShape s = triangle_shape(p[0], p[1], p[2], specimens::thickness);
        Corners u;
        for (int k = 0; k < 3; ++k) {
            u[k] = { 0.1 + h.xx * p[k].x + h.xy * p[k].y, h.yx * p[k].x + h.yy * p[k].y };
        }
        const Gradient g = displacement_gradient(s, u[0], u[1], u[2]);
        // the large common displacement costs digits: 0.1 m against 1e-6 m
        CHECK(g.xx == Approx(h.xx).epsilon(1e-9));
        CHECK(g.xy == Approx(h.xy).epsilon(1e-9));
        CHECK(g.yx == Approx(h.yx).epsilon(1e-11));
        CHECK(g.yy == Approx(h.yy).epsilon(1e-11));
    }
}

TEST_CASE("a spun triangle carries no force, at any angle", "[triangle]")
{
    Random random(2);
    const PlaneStiffness c = plane_stiffness(specimens::granite());
    const double scale = c.normal * specimens::thickness * size;
    for (int i = 0; i < 1000; ++i) {
        const Corners p = random_corners(random);
        const double angle = i == 0 ? 0.5 * pi : 2.0 * pi * random.next();
        const TriangleShape s = triangle_shape(p[0], p[1], p[2], specimens::thickness);
        for (const Point& f : forces(s, c, spun(p, {}, angle))) {
            CHECK(std::hypot(f.x, f.y) < 1e-14 * scale);
        }
    }
}

TEST_CASE("forces and stress of a strained triangle turn with it", "[triangle]")
{
    Random random(3);
    const PlaneStiffness c = plane_stiffness(specimens::granite(Plane::strain));
    const double scale = c.normal * specimens::thickness * size;
    for (int i = 0; i < 300; ++i) {
        const Corners p = random_corners(random), u = random_displacements(random, 0.1 * size);
        const double angle = 2.0 * pi * random.next();
        const TriangleShape s = triangle_shape(p[0], p[1], p[2], specimens::thickness);
        const Corners v = spun(p, u, angle);
        const auto before = forces(s, c, u), after = forces(s, c, v);
        for (int k = 0; k < 3; ++k) {
            const Point turned = rotate(before[k], angle);
            CHECK(std::hypot(after[k].x - turned.x, after[k].y - turned.y) < 1e-13 * scale);
        }
        const Tensor a = cauchy_stress(s, c, u[0], u[1], u[2]);
        const Tensor b = cauchy_stress(s, c, v[0], v[1], v[2]);
        const double cs = std::cos(angle), sn = std::sin(angle);
        CHECK(b.xx
            == Approx(a.xx * cs * cs - 2.0 * a.xy * cs * sn + a.yy * sn * sn)
                   .margin(1e-13 * c.normal));
        CHECK(b.xy
            == Approx((a.xx - a.yy) * cs * sn + a.xy * (cs * cs - sn * sn))
                   .margin(1e-13 * c.normal));
    }
}

TEST_CASE("forces are minus the derivatives of the energy", "[triangle]")
{
    Random random(4);
    const PlaneStiffness c = plane_stiffness(specimens::granite());
    const double step = 1e-5 * size;
    for (int i = 0; i < 100; ++i) {
        const Corners p = random_corners(random), u = random_displacements(random, 0.2 * size);
        const TriangleShape s = triangle_shape(p[0], p[1], p[2], specimens::thickness);
        const auto f = forces(s, c, u);
        const double scale = c.normal * specimens::thickness * size;
        for (int k = 0; k < 3; ++k) {
            Corners ahead = u, behind = u;
            ahead[k].x += step;
            behind[k].x -= step;
            const double dx = (energy(s, c, behind) - energy(s, c, ahead)) / (2.0 * step);
            ahead = behind = u;
            ahead[k].y += step;
            behind[k].y -= step;
            const double dy = (energy(s, c, behind) - energy(s, c, ahead)) / (2.0 * step);
            // truncation: the square of the relative step
            CHECK(f[k].x == Approx(dx).margin(1e-9 * scale));
            CHECK(f[k].y == Approx(dy).margin(1e-9 * scale));
        }
    }
}

TEST_CASE("stiffness blocks are the derivatives of the forces at rest", "[triangle]")
{
    Random random(5);
    const double step = 1e-6 * size;
    for (const Plane plane : { Plane::stress, Plane::strain }) {
        const PlaneStiffness c = plane_stiffness(specimens::granite(plane));
        const double scale = c.normal * specimens::thickness;
        const Corners p = random_corners(random);
        const TriangleShape s = triangle_shape(p[0], p[1], p[2], specimens::thickness);
        for (int b = 0; b < 3; ++b) {
            Corners x {}, y {}, minus_x {}, minus_y {};
            x[b].x = y[b].y = step;
            minus_x[b].x = minus_y[b].y = -step;
            const auto fx = forces(s, c, x), gx = forces(s, c, minus_x);
            const auto fy = forces(s, c, y), gy = forces(s, c, minus_y);
            for (int a = 0; a < 3; ++a) {
                const StiffnessBlock k = stiffness_block(s, c, a, b);
                CHECK(k.xx == Approx((gx[a].x - fx[a].x) / (2.0 * step)).margin(1e-10 * scale));
                CHECK(k.yx == Approx((gx[a].y - fx[a].y) / (2.0 * step)).margin(1e-10 * scale));
                CHECK(k.xy == Approx((gy[a].x - fy[a].x) / (2.0 * step)).margin(1e-10 * scale));
                CHECK(k.yy == Approx((gy[a].y - fy[a].y) / (2.0 * step)).margin(1e-10 * scale));
            }
        }
    }
}

TEST_CASE("wrong elastic properties and shapes are refused", "[triangle]")
{
    const ElasticMaterial good = specimens::granite();
    for (const double bad : { 0.0, -1.0, std::nan(""), HUGE_VAL }) {
        ElasticMaterial m = good;
        m.young = bad;
        CHECK_THROWS_AS(plane_stiffness(m), std::invalid_argument);
        m = good;
        m.density = bad;
        CHECK_THROWS_AS(plane_stiffness(m), std::invalid_argument);
    }
    for (const double bad : { 0.0, 0.5, -0.1, 1.0, std::nan("") }) {
        ElasticMaterial m = good;
        m.poisson = bad;
        CHECK_THROWS_AS(plane_stiffness(m), std::invalid_argument);
    }
    CHECK_THROWS_WITH(triangle_shape({ 0, 0 }, { 0, 1 }, { 1, 0 }, 1.0),
        Catch::Contains("triangle area = -0.5 m^2") && Catch::Contains("counter-clockwise"));
}
