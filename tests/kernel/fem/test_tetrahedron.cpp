// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Constant-strain tetrahedron against closed forms of elasticity. SI units.
#include <flexpm/kernel/fem/tetrahedron.hpp>
#include <flexpm/kernel/space/fan_meshes.hpp>

#include "support/specimens.hpp"
#include "support/sphere_samples.hpp"

using namespace flexpm_test;

namespace {

constexpr double size = 1e-3;  // about the size of the tetrahedra [m]

using Corners = std::array<Vector, 4>;

Vector random_vector(Random& random)
{
    const double x = random.next() - 0.5, y = random.next() - 0.5, z = random.next() - 0.5;
    return { x, y, z };
}

Corners random_corners(Random& random)
{
    for (;;) {
        Corners p;
        for (Vector& q : p)
            q = 2.0 * size * random_vector(random);
        if (triple(p[1] - p[0], p[2] - p[0], p[3] - p[0]) > 0.5 * size * size * size) return p;
    }
}

Corners random_displacements(Random& random, double amplitude)
{
    Corners u;
    for (Vector& v : u)
        v = amplitude * random_vector(random);
    return u;
}

TetrahedronShape shape_of(const Corners& p) { return tetrahedron_shape(p[0], p[1], p[2], p[3]); }

PlaneStiffness stiffness() { return solid_stiffness(specimens::granite()); }

/// Displacements that bring the corners, already displaced by `u`, to where a rotation has them.
Corners spun(const Corners& p, const Corners& u, const Rotation& r)
{
    Corners v;
    for (int i = 0; i < 4; ++i)
        v[i] = turned(r, p[i] + u[i]) - p[i];
    return v;
}

Corners forces(const TetrahedronShape& s, const Corners& u)
{
    const TetrahedronForces f = tetrahedron_forces(s, stiffness(), u[0], u[1], u[2], u[3]);
    return { -(f.f1 + f.f2 + f.f3), f.f1, f.f2, f.f3 };
}

double energy(const TetrahedronShape& s, const Corners& u)
{
    return tetrahedron_energy(s, stiffness(), u[0], u[1], u[2], u[3]);
}

double& component(Vector& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

TEST_CASE("uniaxial stress gives Hooke's strains in space", "[tetrahedron]")
{
    const double young = 25.8e9, nu = 0.23;
    const SpaceTensor s =
        stress(stiffness(), SpaceTensor { -nu * 1e-3, -nu * 1e-3, 1e-3, 2e-4, -3e-4, 4e-4 });
    CHECK(s.zz == Approx(young * 1e-3).epsilon(1e-13));
    CHECK(std::abs(s.xx) + std::abs(s.yy) < 1e-9 * young * 1e-3);
    CHECK(s.yz == Approx(young / (1.0 + nu) * 2e-4).epsilon(1e-14));
    CHECK(s.xz == Approx(-young / (1.0 + nu) * 3e-4).epsilon(1e-14));
    CHECK(s.xy == Approx(young / (1.0 + nu) * 4e-4).epsilon(1e-14));
}

TEST_CASE("a linear displacement field has its gradient in every tetrahedron", "[tetrahedron]")
{
    Random random(1);
    const SpaceGradient h { { 1e-3, -4e-4, 2e-4 }, { 7e-4, -2e-3, 5e-4 }, { -3e-4, 6e-4, 8e-4 } };
    for (int i = 0; i < 100; ++i) {
        const Corners p = random_corners(random);
        Corners u;
        for (int k = 0; k < 4; ++k)
            u[k] = { dot(h.x, p[k]), dot(h.y, p[k]), dot(h.z, p[k]) };
        const SpaceGradient g = displacement_gradient(shape_of(p), u[0], u[1], u[2], u[3]);
        CHECK(norm(g.x - h.x) + norm(g.y - h.y) + norm(g.z - h.z) < 1e-15);
    }
}

TEST_CASE("a spun tetrahedron carries no force, by any rotation", "[tetrahedron]")
{
    Random random(2);
    const double scale = stiffness().normal * size * size;
    for (int i = 0; i < 1000; ++i) {
        const Corners p = random_corners(random);
        for (const Vector& f : forces(shape_of(p), spun(p, {}, random_rotation(random))))
            CHECK(norm(f) < 2e-14 * scale);
    }
}

TEST_CASE("forces and stress of a strained tetrahedron turn with it", "[tetrahedron]")
{
    Random random(3);
    const double scale = stiffness().normal * size * size;
    for (int i = 0; i < 300; ++i) {
        const Corners p = random_corners(random), u = random_displacements(random, 0.1 * size);
        const Rotation r = random_rotation(random);
        const TetrahedronShape s = shape_of(p);
        const Corners v = spun(p, u, r), before = forces(s, u), after = forces(s, v);
        for (int k = 0; k < 4; ++k)
            CHECK(norm(after[k] - turned(r, before[k])) < 2e-13 * scale);
        const SpaceTensor a = cauchy_stress(s, stiffness(), u[0], u[1], u[2], u[3]);
        const SpaceTensor b = cauchy_stress(s, stiffness(), v[0], v[1], v[2], v[3]);
        const Vector direction = random_vector(random), there = turned(r, direction);
        CHECK(norm(b * there - turned(r, a * direction)) < 1e-12 * stiffness().normal);
        // balance of moments: the true stress is symmetric
        Vector moment;
        for (int k = 0; k < 4; ++k)
            moment = moment + cross(p[k] + u[k], before[k]);
        CHECK(norm(moment) < 1e-13 * scale * size);
    }
}

TEST_CASE("forces of a tetrahedron are minus the derivatives of its energy", "[tetrahedron]")
{
    Random random(4);
    const double step = 1e-5 * size, scale = stiffness().normal * size * size;
    for (int i = 0; i < 100; ++i) {
        const Corners p = random_corners(random), u = random_displacements(random, 0.2 * size);
        const TetrahedronShape s = shape_of(p);
        Corners f = forces(s, u);
        for (int k = 0; k < 4; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                Corners ahead = u, behind = u;
                component(ahead[k], axis) += step;
                component(behind[k], axis) -= step;
                const double slope = (energy(s, behind) - energy(s, ahead)) / (2.0 * step);
                // truncation: the square of the relative step
                CHECK(component(f[k], axis) == Approx(slope).margin(2e-9 * scale));
            }
    }
}

TEST_CASE("stiffness blocks of a tetrahedron are the derivatives of its forces", "[tetrahedron]")
{
    Random random(5);
    const double step = 1e-6 * size, scale = stiffness().normal * size;
    const Corners p = random_corners(random);
    const TetrahedronShape s = shape_of(p);
    for (int b = 0; b < 4; ++b)
        for (int axis = 0; axis < 3; ++axis) {
            Corners plus {}, minus {};
            component(plus[b], axis) = step;
            component(minus[b], axis) = -step;
            const Corners f = forces(s, plus), g = forces(s, minus);
            for (int a = 0; a < 4; ++a) {
                SpaceGradient k = stiffness_block(s, stiffness(), a, b);
                const Vector slope = (0.5 / step) * (g[a] - f[a]);
                const Vector column { component(k.x, axis), component(k.y, axis),
                    component(k.z, axis) };
                CHECK(norm(slope - column) < 1e-10 * scale);
            }
        }
}

TEST_CASE("uniform strain leaves no force on the inner node of a grain", "[tetrahedron]")
{
    const Solid solid = Solid::box(0.0175, 0.0175, 0.0175);
    const Polyhedra cells = polyhedra(packed_spheres(solid, 200, 1), solid, { 3e-4, false });
    const FanMeshes meshes = fan_meshes(cells);
    const SpaceGradient h { { 1e-3, -4e-4, 2e-4 }, { 7e-4, -2e-3, 5e-4 }, { -3e-4, 6e-4, 8e-4 } };
    double largest = 0.0;
    for (int c = 0; c < cells.cells(); ++c) {
        const auto place = [&](int node) {
            const int vertex = meshes.node_vertices[meshes.node_offsets[c] + node];
            return vertex < 0 ? cells.centres[c] : cells.vertices[vertex];
        };
        Vector at_centre;
        for (auto e = meshes.element_offsets[c]; e < meshes.element_offsets[c + 1]; ++e) {
            Corners p, u;
            for (int k = 0; k < 4; ++k) {
                p[k] = place(meshes.elements[e][k]);
                const Vector from = p[k] - cells.centres[c];
                u[k] = { dot(h.x, from), dot(h.y, from), dot(h.z, from) };
            }
            REQUIRE(
                meshes.elements[e][0] == meshes.node_offsets[c + 1] - meshes.node_offsets[c] - 1);
            at_centre = at_centre + forces(shape_of(p), u)[0];
        }
        largest = std::max(largest, norm(at_centre));
    }
    // beside forces of 1e-3 E d^2
    CHECK(largest < 1e-10 * 1e-3 * 25.8e9 * 9e-6);
}

TEST_CASE("second moments of tetrahedra are those of the body that they fill", "[tetrahedron]")
{
    const double a = 2.0, b = 3.0, c = 5.0, six = a * b * c;
    const SpaceTensor corner = second_moments({}, { a, 0, 0 }, { 0, b, 0 }, { 0, 0, c });
    CHECK(corner.xx == Approx(six * a * a / 60.0));
    CHECK(corner.yz == Approx(six * b * c / 120.0));
    CHECK(corner.xz == Approx(six * a * c / 120.0));

    const double w = 0.015, d = 0.0175, h = 0.02, volume = w * d * h;
    const Solid solid = Solid::box(w, d, h);
    const Polyhedra cells = polyhedra(packed_spheres(solid, 200, 1), solid, { 3e-4, false });
    const FanMeshes meshes = fan_meshes(cells);
    SpaceTensor sum {};
    for (int g = 0; g < cells.cells(); ++g) {
        const auto place = [&](int node) {
            const int vertex = meshes.node_vertices[meshes.node_offsets[g] + node];
            return vertex < 0 ? cells.centres[g] : cells.vertices[vertex];
        };
        for (auto e = meshes.element_offsets[g]; e < meshes.element_offsets[g + 1]; ++e) {
            const auto& n = meshes.elements[e];
            const SpaceTensor m =
                second_moments(place(n[0]), place(n[1]), place(n[2]), place(n[3]));
            sum = { sum.xx + m.xx, sum.yy + m.yy, sum.zz + m.zz, sum.yz + m.yz, sum.xz + m.xz,
                sum.xy + m.xy };
        }
    }
    CHECK(sum.xx == Approx(volume * w * w / 3.0).epsilon(1e-12));
    CHECK(sum.yz == Approx(volume * d * h / 4.0).epsilon(1e-12));
    const SpaceTensor i = inertia_of(sum);
    CHECK(i.zz == Approx(volume * (w * w + d * d) / 3.0).epsilon(1e-12));
    CHECK(i.xy == Approx(-volume * w * d / 4.0).epsilon(1e-12));
}

TEST_CASE("a turned tetrahedron is refused", "[tetrahedron]")
{
    CHECK_THROWS_WITH(tetrahedron_shape({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }),
        Catch::Contains("tetrahedron volume = -0.166666666667 m^3")
            && Catch::Contains("right-handed"));
}
