// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rigid grains: exact rotation, contacts as those of deformable grains, masses, energy, and
/// the elastic solve. SI units, tension positive, rotations counter-clockwise.
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/removal.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/driven.hpp"

using flexpm::Assembly;
using flexpm::component;
using flexpm::lanes;
using flexpm::Point;

namespace {

flexpm::AssemblyOptions rigid_options(const flexpm::ContactMaterial& contact)
{
    flexpm::AssemblyOptions o = specimens::options(contact);
    o.rigid = true;
    o.elastic[0].young = o.elastic[0].poisson = 0.0;  // must not matter
    return o;
}

Assembly rigid(const specimens::Specimen& s, const flexpm::ContactMaterial& contact)
{
    return specimens::assemble(s, rigid_options(contact));
}

/// Random velocities and spins that move points by about `speed`.
void shake(Assembly& a, double speed)
{
    flexpm::Random random(7);
    for (int g = 0; g < a.grains.count; ++g) {
        const double x = random.next() - 0.5, y = random.next() - 0.5, s = random.next() - 0.5;
        flexpm::set_motion(
            a.grains, g, { speed * x, speed * y }, speed * s / a.grains.radius[g], 1.0);
    }
}

}  // namespace

TEST_CASE("a rigid grain keeps its shape to round-off when it turns", "[rigid]")
{
    Assembly a = rigid(specimens::hexagon(), specimens::granite_contact());
    flexpm::scale_masses(a, 0.7);
    const double turn = 2.5 * 3.14159265358979323846;
    const int steps = GENERATE(40, 1000);
    flexpm::set_motion(a.grains, 0, { 1e-4 / steps, 0.0 }, turn / steps, 1.0);
    driven::run_measured(a, steps, 0.7);

    CHECK(flexpm::rotation_of(a.grains, 0) == Approx(turn).epsilon(1e-13));
    const int c = a.grains.centre(0);
    CHECK(a.grains.displacement[c] == Approx(1e-4).epsilon(1e-12));
    for (int n = 0; n + 1 < a.grains.nodes_of(0); ++n) {
        const int i = a.grains.node(0, n);
        const double rx = a.grains.reference[i] - a.grains.reference[c];
        const double ry = a.grains.reference[component(i, 1)] - a.grains.reference[component(c, 1)];
        const Point p = a.grains.point_at(i), q = a.grains.point_at(c);
        // a right angle and two half turns: (x, y) becomes (-y, x)
        CHECK(p.x - q.x == Approx(-ry).margin(1e-15));
        CHECK(p.y - q.y == Approx(rx).margin(1e-15));
    }
}

TEST_CASE("half the turn of a rigid grain is a unit quaternion", "[rigid]")
{
    Assembly a = rigid(specimens::hexagon(), specimens::granite_contact());
    flexpm::scale_masses(a, 0.7);
    const double turn = GENERATE(1e-9, 0.4, -2.0, 3.1415926, 3.2, -4.0);
    flexpm::set_motion(a.grains, 0, { 0.0, 0.0 }, turn / 20, 1.0);
    driven::run_measured(a, 20, 0.0);
    const auto half = flexpm::half_turn(a.grains, 0);
    CHECK(std::hypot(half.cosine, half.sine) == Approx(1.0).epsilon(1e-12));
    // a quaternion and its negative are the same turn
    const double sign = half.cosine * std::cos(turn / 2) + half.sine * std::sin(turn / 2);
    CHECK(std::fabs(sign) == Approx(1.0).epsilon(1e-12));
    CHECK(half.cosine * std::sin(turn / 2) == Approx(half.sine * std::cos(turn / 2)).margin(1e-12));
}

TEST_CASE("a rigid grain that nothing holds has finite masses and keeps its motion", "[rigid]")
{
    Assembly a = rigid(specimens::hexagon(), specimens::granite_contact());
    flexpm::scale_masses(a, 0.7);
    CHECK(a.grains.inverse_mass[flexpm::scalar_index(a.grains.centre(0))] > 0.0);
    CHECK(a.grains.inverse_inertia[a.grains.slot[0]] > 0.0);
    flexpm::set_motion(a.grains, 0, { 1e-6, 0.0 }, 1e-4, 1.0);
    driven::run_measured(a, 10, 0.7);
    CHECK(a.grains.displacement[a.grains.centre(0)] == Approx(1e-5).epsilon(1e-12));
    CHECK(flexpm::energies(a).kinetic > 0.0);
}

TEST_CASE("nodes move in a step as far as their velocities say", "[rigid]")
{
    Assembly a = rigid(specimens::hexagon(), specimens::granite_contact());
    flexpm::scale_masses(a, 0.7, 0.5);
    flexpm::set_motion(a.grains, 0, { 1e-4, -2e-4 }, 0.3, 0.5);
    driven::run_measured(a, 1, 0.7, 0.5);
    const auto velocity = a.grains.velocity;
    const auto before = a.grains.displacement;
    driven::run_measured(a, 1, 0.7, 0.5);
    for (int n = 0; n < a.grains.nodes_of(0); ++n) {
        for (int i : { a.grains.node(0, n), component(a.grains.node(0, n), 1) }) {
            CHECK(a.grains.displacement[i] - before[i] == Approx(0.5 * velocity[i]).margin(1e-17));
        }
    }
}

TEST_CASE("a grid of rigid squares has E = K_n a and no Poisson's ratio", "[rigid][elastic]")
{
    const double size = 3e-3, stiffness = 1.08e13;
    const int points = GENERATE(2, 3);  // with one, squares turn freely like gears
    auto o = rigid_options(specimens::strong_contact(stiffness));
    o.points = points;
    const Assembly a = specimens::assemble(specimens::grid(4, 8, size), o);
    const auto e = flexpm::elastic_constants(a);
    CHECK(e.youngs_modulus == Approx(stiffness * size).epsilon(1e-9));
    CHECK(std::fabs(e.poissons_ratio) < 1e-9);
}

TEST_CASE("the elastic solve of rigid grains holds the forces in balance", "[rigid][elastic]")
{
    const Assembly a =
        rigid(specimens::random_grains(12e-3, 18e-3, 3e-3, 5), specimens::strong_contact(1.08e13));
    std::vector<flexpm::Prescribed> held;
    const int first = a.grains.centre(0), other = a.grains.centre(a.grains.count - 1);
    held.push_back({ first, 0.0 });
    held.push_back({ component(first, 1), 0.0 });
    held.push_back({ other, 1e-6 });
    held.push_back({ component(other, 1), 0.0 });
    Assembly solved = a;
    const auto s = flexpm::solve_static(a, held);
    solved.grains.force = s.force;
    double largest = 0.0;
    for (double f : s.force)
        largest = std::max(largest, std::fabs(f));
    REQUIRE(largest > 1.0);
    for (int g = 1; g + 1 < a.grains.count; ++g) {
        const auto sum = flexpm::resultant_on(solved.grains, g);
        CHECK(std::hypot(sum.force.x, sum.force.y) < 1e-8 * largest);
        CHECK(std::fabs(sum.moment.z) < 1e-8 * largest * a.grains.radius[g]);
    }
    CHECK_THROWS_WITH(
        flexpm::solve_static(a, { { a.grains.node(0, 0), 0.0 } }), Catch::Contains("rigid grain"));
}

TEST_CASE("stepping rigid grains arrives at the elastic solve", "[rigid][elastic]")
{
    Assembly a =
        rigid(specimens::random_grains(9e-3, 12e-3, 3e-3, 5), specimens::strong_contact(1.08e13));
    const std::vector<int> ends = { a.grains.centre(0), a.grains.centre(a.grains.count - 1) };
    const auto s = flexpm::solve_static(a,
        { { ends[0], 0.0 }, { component(ends[0], 1), 0.0 }, { ends[1], 1e-7 },
            { component(ends[1], 1), 0.0 } });
    flexpm::scale_masses(a, 0.7);
    for (int i : ends)
        a.grains.prescribed[i] = a.grains.prescribed[component(i, 1)] = 1;
    flexpm::set_motion(a.grains, a.grains.count - 1, { 1e-10, 0.0 }, 0.0, 1.0);
    driven::run_measured(a, 1000, 0.7);
    flexpm::set_motion(a.grains, a.grains.count - 1, { 0.0, 0.0 },
        a.grains.spin[a.grains.slot[a.grains.count - 1]], 1.0);
    driven::run_measured(a, 4000, 0.7);
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            for (int i : { a.grains.node(g, n), component(a.grains.node(g, n), 1) }) {
                CHECK(a.grains.displacement[i] == Approx(s.displacement[i]).margin(2e-11));
            }
        }
    }
}

TEST_CASE("contacts of rigid grains follow those of deformable grains led along the same way",
    "[rigid][contact]")
{
    // two squares, the second turned and moved: the moment and the forces of each point agree
    const auto contact = specimens::granite_contact();
    const auto squares = specimens::grid(2, 1, 3e-3);
    Assembly stiff = rigid(squares, contact);
    Assembly soft = specimens::assemble(squares, specimens::options(contact));
    driven::hold_all(soft);
    const double spin = GENERATE(6e-5, -6e-5), speed = GENERATE(0.0, 1e-9);
    const int steps = 60;  // opens the far point beyond its strength
    flexpm::scale_masses(stiff, 0.7);
    for (int g : { 0, 1 }) {
        stiff.grains.prescribed[stiff.grains.centre(g)] =
            stiff.grains.prescribed[component(stiff.grains.centre(g), 1)] = 1;
        driven::prescribe_spin(stiff.grains, g, 0.0);
    }
    flexpm::set_motion(stiff.grains, 1, { speed, 0.5 * speed }, spin, 1.0);
    const int c = soft.grains.centre(1);
    for (int i = 1; i <= steps; ++i) {
        driven::run_measured(stiff, 1, 0.7);
        driven::aim(soft, 1.0, [&](int node) {
            const Point reference = vector_at(soft.grains.reference, node);
            if (node % lanes == c % lanes && node >= soft.grains.node(1, 0)
                && node <= soft.grains.node(1, soft.grains.nodes_of(1) - 1)) {
                const double angle = i * spin;
                const double rx = reference.x - soft.grains.reference[c];
                const double ry = reference.y - soft.grains.reference[component(c, 1)];
                return Point { soft.grains.reference[c] + i * speed + std::cos(angle) * rx
                        - std::sin(angle) * ry,
                    soft.grains.reference[component(c, 1)] + 0.5 * i * speed + std::sin(angle) * rx
                        + std::cos(angle) * ry };
            }
            return reference;
        });
        driven::run(soft, 1);
    }
    REQUIRE(flexpm::count_cracks(soft).tensile + flexpm::count_cracks(soft).shear > 0);
    for (int end : { 0, 1 }) {
        const Point f = driven::contact_force(stiff, 0, 1, end);
        const Point g = driven::contact_force(soft, 0, 1, end);
        CHECK(f.x == Approx(g.x).epsilon(1e-6).margin(1e-3));
        CHECK(f.y == Approx(g.y).epsilon(1e-6).margin(1e-3));
    }
    CHECK(flexpm::count_cracks(stiff).tensile == flexpm::count_cracks(soft).tensile);
    CHECK(flexpm::energies(stiff).damage == Approx(flexpm::energies(soft).damage).epsilon(1e-6));
}

TEST_CASE("an elastic rigid contact resists rotation with K_n t h^3 / 12", "[rigid][contact]")
{
    // Lobatto points integrate the moment of a linear traction exactly
    const double size = 3e-3, stiffness = 1.08e13, angle = 1e-9;
    Assembly a = rigid(specimens::grid(2, 1, size), specimens::strong_contact(stiffness, 0.28));
    flexpm::scale_masses(a, 0.7);
    for (int g : { 0, 1 }) {
        a.grains.prescribed[a.grains.centre(g)] =
            a.grains.prescribed[component(a.grains.centre(g), 1)] = 1;
        driven::prescribe_spin(a.grains, g, 0.0);
    }
    driven::prescribe_spin(a.grains, 1, angle);
    driven::run_measured(a, 1, 0.0);
    const double h = size, t = specimens::thickness;
    // the edge is half a size from the centre: shear adds its force at that arm
    const double shear = 0.28 * stiffness * h * t * 0.25 * size * size;
    CHECK(-flexpm::resultant_on(a.grains, 1).moment.z
        == Approx((stiffness * t * h * h * h / 12.0 + shear) * angle).epsilon(1e-6));
}

TEST_CASE("scaled masses keep rigid grains stable", "[rigid][stability]")
{
    auto o = rigid_options(specimens::strong_contact(1.08e13));
    o.points = GENERATE(1, 2, 3);
    Assembly a = specimens::assemble(specimens::random_grains(15e-3, 24e-3, 3e-3, 3), o);
    SECTION("damped, kinetic energy falls by a million")
    {
        const double damping = GENERATE(0.3, 0.7);
        flexpm::scale_masses(a, damping);
        shake(a, 1e-12);
        driven::run_measured(a, 1, damping);
        const double start = flexpm::energies(a).kinetic;
        driven::run_measured(a, 3000, damping);
        CHECK(flexpm::energies(a).kinetic < 1e-6 * start);
    }
    SECTION("undamped, it stays bounded and the total is kept")
    {
        flexpm::scale_masses(a, 0.0);
        shake(a, 1e-12);
        flexpm::reset_energy_balance(a);
        driven::run_measured(a, 20000, 0.0);
        const auto e = flexpm::energies(a);
        CHECK(e.kinetic < 100.0 * e.initial);
        CHECK(balance::total(e) == Approx(e.initial).epsilon(1e-8));
    }
}

TEST_CASE("real masses and inertia of rigid grains are those of their cells", "[rigid][mass]")
{
    const double size = 3e-3;
    Assembly a = rigid(specimens::grid(3, 2, size), specimens::strong_contact());
    const double dt = flexpm::set_real_masses(a, 0.7);
    const double mass = 2650.0 * size * size * specimens::thickness;
    for (int g = 0; g < a.grains.count; ++g) {
        CHECK(
            1.0 / a.grains.inverse_mass[flexpm::scalar_index(a.grains.centre(g))] == Approx(mass));
        CHECK(1.0 / a.grains.inverse_inertia[a.grains.slot[g]] == Approx(mass * size * size / 6.0));
    }
    // the bound lies above the highest frequency, at most twofold: omega^2 <= row sum of M^-1 K
    CHECK(dt > 0.0);
    shake(a, 1e-9);
    flexpm::reset_energy_balance(a);
    driven::run_measured(a, 20000, 0.0, dt);
    CHECK(flexpm::energies(a).kinetic < 100.0 * flexpm::energies(a).initial);
}

TEST_CASE("energy of breaking rigid grains is accounted for", "[rigid][energy]")
{
    Assembly a =
        rigid(specimens::random_grains(9e-3, 12e-3, 3e-3, 9), specimens::granite_contact());
    flexpm::scale_masses(a, 0.7);
    for (int e = 0; e < a.facets.count; ++e) {
        const int c = a.grains.centre(a.facets.grain[e]);
        if (a.facets.side[e] == 0 || a.facets.side[e] == 2)
            a.grains.prescribed[component(c, 1)] = 1;
        if (a.facets.side[e] == 2)
            flexpm::set_motion(a.grains, a.facets.grain[e], { 0.0, 2e-9 }, 0.0, 1.0);
    }
    flexpm::reset_energy_balance(a);
    double work = 0.0, error = 0.0;
    for (int i = 0; i < 60; ++i) {
        driven::run_measured(a, 100, 0.7);
        const auto e = flexpm::energies(a);
        work = std::max(work, std::fabs(e.boundary_work));
        error = std::max(error, std::fabs(balance::miss(e)));
    }
    REQUIRE(flexpm::count_cracks(a).tensile > 3);
    CHECK(error < 0.01 * work);
}

TEST_CASE("a retired rigid grain stands still", "[rigid]")
{
    Assembly a = rigid(specimens::grid(2, 2, 3e-3), specimens::granite_contact());
    flexpm::scale_masses(a, 0.7);
    shake(a, 1e-9);
    flexpm::remove_grain(a, 0);
    const auto before = a.grains.displacement[a.grains.node(0, 0)];
    driven::run_measured(a, 10, 0.7);
    CHECK(a.grains.displacement[a.grains.node(0, 0)] == before);
    CHECK(flexpm::rotation_of(a.grains, 0) == 0.0);
}

TEST_CASE("spins are refused for deformable grains", "[rigid]")
{
    Assembly a = specimens::assemble(specimens::grid(2, 1, 3e-3), specimens::options());
    CHECK_THROWS_WITH(
        flexpm::set_motion(a.grains, 0, { 0.0, 0.0 }, 1.0, 1.0), Catch::Contains("deformable"));
}
