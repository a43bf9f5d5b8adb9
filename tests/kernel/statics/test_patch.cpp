// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Patch tests: grains and grids of grains under uniform stress, solved and stepped; a
/// Voronoi assembly approaches uniform stress as its contacts stiffen. SI units, tension positive.
#include "support/specimens.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

using namespace flexpm;

namespace {

AssemblyOptions with(MeshKind mesh, Plane plane = Plane::stress, int points = 3)
{
    AssemblyOptions o = specimens::options(specimens::strong_contact(), specimens::granite(plane));
    o.mesh = mesh;
    o.points = points;
    return o;
}

/// Calls visit(gradient, shape, stiffness) for every triangle.
template <class Visit>
void for_each_triangle(const Assembly& a, const Array<double>& u, Visit visit)
{
    const auto at = [&](int node) { return vector_at(u, node); };
    for (int g = 0; g < a.grains.count; ++g) {
        for (int t = 0; t < triangles_of(a.grains, g); ++t) {
            const auto n = triangle_nodes(a.grains, g, t);
            const TriangleShape s = shape_of(a.grains, g, t);
            visit(displacement_gradient(s, at(a.grains.node(g, n[0])), at(a.grains.node(g, n[1])),
                      at(a.grains.node(g, n[2]))),
                s, stiffness_of(a.grains, g));
        }
    }
}

/// Largest difference between a triangle's linear stress and `expected` [Pa].
double stress_error(const Assembly& a, const Array<double>& u, const Tensor& expected)
{
    double error = 0.0;
    for_each_triangle(a, u, [&](const Gradient& h, const TriangleShape&, const PlaneStiffness& c) {
        const Tensor s = stress(c, { h.xx, h.yy, 0.5 * (h.xy + h.yx) });
        error = std::max({ error, std::fabs(s.xx - expected.xx), std::fabs(s.yy - expected.yy),
            std::fabs(s.xy - expected.xy) });
    });
    return error;
}

double largest(const Tensor& s)
{
    return std::max({ std::fabs(s.xx), std::fabs(s.yy), std::fabs(s.xy) });
}

/// Forces of the uniform stress on the boundary edges, half to each end.
Array<double> edge_loads(const Assembly& a, const Tensor& s)
{
    Array<double> f(a.grains.displacement.size(), 0.0);
    for (int e = 0; e < a.facets.count; ++e) {
        const auto n = a.facets.nodes(e);
        const double half = 0.5 * a.thickness;
        const double nx = half
            * (a.grains.reference[component(n[1], 1)] - a.grains.reference[component(n[0], 1)]);
        const double ny = -half * (a.grains.reference[n[1]] - a.grains.reference[n[0]]);
        for (int i : n) {
            f[i] += s.xx * nx + s.xy * ny;
            f[component(i, 1)] += s.xy * nx + s.yy * ny;
        }
    }
    return f;
}

/// Just what keeps an assembly from moving as a whole: one node of the first grain, and one
/// component of another that lies apart from it.
std::vector<Prescribed> no_rigid_motion(const Assembly& a)
{
    const int n0 = a.grains.node(0, 0), n1 = a.grains.node(0, 1);
    const bool apart_along_x = std::fabs(a.grains.reference[n1] - a.grains.reference[n0])
        > std::fabs(a.grains.reference[component(n1, 1)] - a.grains.reference[component(n0, 1)]);
    return { { n0, 0.0 }, { component(n0, 1), 0.0 },
        { apart_along_x ? component(n1, 1) : n1, 0.0 } };
}

/// Largest difference between a triangle's Cauchy stress and `expected` [Pa].
double cauchy_error(const Assembly& a, const Tensor& expected)
{
    double error = 0.0;
    for (int g = 0; g < a.grains.count; ++g) {
        for (int t = 0; t < triangles_of(a.grains, g); ++t) {
            const auto n = triangle_nodes(a.grains, g, t);
            const Tensor s = cauchy_stress(shape_of(a.grains, g, t), stiffness_of(a.grains, g),
                vector_at(a.grains.displacement, a.grains.node(g, n[0])),
                vector_at(a.grains.displacement, a.grains.node(g, n[1])),
                vector_at(a.grains.displacement, a.grains.node(g, n[2])));
            error = std::max({ error, std::fabs(s.xx - expected.xx), std::fabs(s.yy - expected.yy),
                std::fabs(s.xy - expected.xy) });
        }
    }
    return error;
}

/// Damped steps with scaled masses until the assembly rests.
void settle(Assembly& a, int steps)
{
    scale_masses(a, 0.7);
    for (int n = 0; n < steps; ++n)
        step(a, StepOptions());
}

const Tensor stresses[] = { { 1e6, 0, 0 }, { 0, -2e6, 0 }, { 0, 0, 1e6 }, { 1e6, -3e6, 0.7e6 } };

}  // namespace

TEST_CASE("patch: one grain whose boundary follows a linear field", "[patch]")
{
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    const auto plane = GENERATE(Plane::stress, Plane::strain);
    const Assembly a = specimens::assemble(specimens::hexagon(), with(mesh, plane));
    const Gradient h { 1e-4, 3e-5, -2e-5, -4e-4 };
    std::vector<Prescribed> boundary;
    for (int k = 0; k < a.grains.group(0).vertices; ++k) {
        const int n = a.grains.node(0, k);
        const Point p = a.grains.point_at(n);
        boundary.push_back({ n, h.xx * p.x + h.xy * p.y });
        boundary.push_back({ component(n, 1), h.yx * p.x + h.yy * p.y });
    }
    // Hooke's law written out anew
    const double young = 25.8e9, nu = 0.23, g = 0.5 * young / (1.0 + nu);
    const double lambda =
        plane == Plane::strain ? 2.0 * g * nu / (1.0 - 2.0 * nu) : 2.0 * g * nu / (1.0 - nu);
    const double trace = h.xx + h.yy;
    const Tensor expected = { lambda * trace + 2.0 * g * h.xx, lambda * trace + 2.0 * g * h.yy,
        g * (h.xy + h.yx) };
    const StaticSolution s = solve_static(a, boundary);
    CHECK(stress_error(a, s.displacement, expected) < 1e-10 * largest(expected));
}

TEST_CASE("patch: one grain under uniform traction", "[patch]")
{
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    const auto plane = GENERATE(Plane::stress, Plane::strain);
    for (const auto& shape : { specimens::hexagon(), specimens::grid(1, 1, 2e-3) }) {
        const Assembly a = specimens::assemble(shape, with(mesh, plane));
        for (const Tensor& expected : stresses) {
            const Array<double> loads = edge_loads(a, expected);
            const StaticSolution s = solve_static(a, no_rigid_motion(a), &loads);
            CHECK(stress_error(a, s.displacement, expected) < 1e-10 * largest(expected));
        }
    }
}

TEST_CASE("patch: a grid of bonded grains under uniform traction", "[patch]")
{
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    const int points = GENERATE(2, 3);
    const double size = 2e-3;
    const Assembly a =
        specimens::assemble(specimens::grid(4, 3, size), with(mesh, Plane::stress, points));
    for (const Tensor& expected : stresses) {
        const Array<double> loads = edge_loads(a, expected);
        const StaticSolution s = solve_static(a, no_rigid_motion(a), &loads);
        CHECK(stress_error(a, s.displacement, expected) < 1e-10 * largest(expected));
        // between two grains of a row: opening sigma / K_n and slip tau / (eta K_n)
        const int left = a.contacts.node(0, 0, 0);
        const int right = a.contacts.node(0, 1, 0);
        REQUIRE(a.contacts.pairs[0][1] == 1);
        const double unit = largest(expected) / 1.80e14;
        CHECK(s.displacement[right] - s.displacement[left]
            == Approx(expected.xx / 1.80e14).margin(1e-9 * unit));
        CHECK(s.displacement[component(right, 1)] - s.displacement[component(left, 1)]
            == Approx(expected.xy / (0.28 * 1.80e14)).margin(1e-9 * unit));
    }
}

TEST_CASE("patch: stepping reaches the uniform stress of one grain at large strain", "[patch]")
{
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    const auto plane = GENERATE(Plane::stress, Plane::strain);
    Assembly a = specimens::assemble(specimens::hexagon(), with(mesh, plane));
    const double pressure = 2e9;  // strains of several percent
    for (int side = 0; side < 6; ++side)
        set_pressure(a, side, pressure);
    settle(a, 4000);
    // the pressure acts on the deformed edges: this is the exact Cauchy stress
    CHECK(cauchy_error(a, { -pressure, -pressure, 0.0 }) < 1e-10 * pressure);
}

TEST_CASE("patch: stepping reaches the uniform stress of bonded grains", "[patch]")
{
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    const double axial = 100.0, lateral = GENERATE(0.0, 40.0);
    Assembly a = specimens::assemble(specimens::grid(2, 2, 2e-3), with(mesh));
    for (int side : { 0, 2 })
        set_pressure(a, side, axial);
    for (int side : { 1, 3 })
        set_pressure(a, side, lateral);
    settle(a, 4000);
    // bonds that turn while they open, on the way to rest, keep an error of second order in the
    // load: hence the small pressure
    CHECK(cauchy_error(a, { -lateral, -axial, 0.0 }) < 1e-10 * axial);
}

TEST_CASE("the stress scatter of a Voronoi assembly falls as 1 / K_n", "[patch]")
{
    const auto specimen = specimens::random_grains(0.02, 0.04, 3e-3, 7);
    std::vector<double> scatter;
    for (const double stiffness : { 1.80e15, 1.80e16, 1.80e17 }) {
        const Assembly a =
            specimens::assemble(specimen, specimens::options(specimens::strong_contact(stiffness)));
        const Tensor applied { 0.0, -1e6, 0.0 };
        const Array<double> loads = edge_loads(a, applied);
        const StaticSolution s = solve_static(a, no_rigid_motion(a), &loads);
        double sum = 0.0, volume = 0.0;
        for_each_triangle(a, s.displacement,
            [&](const Gradient& h, const TriangleShape& t, const PlaneStiffness& c) {
                const double yy = stress(c, { h.xx, h.yy, 0.5 * (h.xy + h.yx) }).yy;
                sum += t.volume * (yy - applied.yy) * (yy - applied.yy);
                volume += t.volume;
            });
        scatter.push_back(std::sqrt(sum / volume) / 1e6);
    }
    INFO("scatter " << scatter[0] << ", " << scatter[1] << ", " << scatter[2]);
    CHECK(scatter[0] > 1e-3);
    CHECK(scatter[0] / scatter[1] == Approx(10.0).epsilon(0.15));
    CHECK(scatter[1] / scatter[2] == Approx(10.0).epsilon(0.02));
}
