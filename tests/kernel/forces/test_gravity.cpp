// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Gravity on real masses, and walls that grains fall on. SI units; gravity points down.
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/driven.hpp"

using flexpm::Assembly;
using flexpm::component;
using flexpm::lanes;
using flexpm::Point;

namespace {

constexpr double size = 3e-3, g = 9.81;
constexpr double mass = 2650.0 * size * size * specimens::thickness;  // of a square

/// Soft squares, so that few steps fill a long time.
Assembly squares(int nx, int ny, bool rigid)
{
    auto soft = specimens::granite();
    soft.young = 1e8;
    auto o = specimens::options(specimens::strong_contact(1e11), soft);
    o.rigid = rigid;
    return specimens::assemble(specimens::grid(nx, ny, size), o);
}

void run(Assembly& a, int steps, double dt, double damping)
{
    flexpm::StepOptions o;
    o.dt = dt;
    o.damping = damping;
    for (int i = 0; i < steps; ++i) {
        o.measure = i + 1 == steps;
        flexpm::step(a, o);
    }
}

}  // namespace

TEST_CASE("grains fall freely by g (1 - alpha), and their energy is kept", "[gravity]")
{
    const bool rigid = GENERATE(true, false);
    const double damping = GENERATE(0.0, 0.3), dt = 1e-7, down = g * (1.0 - damping);
    Assembly a = squares(2, 2, rigid);
    flexpm::set_real_masses(a, damping);
    flexpm::set_gravity(a, { 0.0, -g });
    flexpm::reset_energy_balance(a);
    // without damping: the sign of a velocity of 0 makes the first step undamped
    const int n = 200;
    run(a, n, dt, damping);
    const double speed = down * (n - 1) * dt + g * dt;
    const double way = down * dt * dt * (n - 1) * (n - 2) / 2.0 + g * dt * dt * (n - 1);
    for (int grain = 0; grain < a.grains.count; ++grain) {
        for (int k = 0; k < a.grains.nodes_of(grain); ++k) {
            const int y = component(a.grains.node(grain, k), 1);
            CHECK(a.grains.velocity[y] == Approx(-speed).epsilon(1e-9));
            CHECK(a.grains.displacement[y] == Approx(-way).epsilon(1e-9));
        }
    }
    const auto e = flexpm::energies(a);
    CHECK(e.potential == Approx(-4.0 * mass * g * way));
    CHECK(e.kinetic > 0.0);
    CHECK(std::fabs(balance::total(e)) < 1e-9 * e.kinetic);
}

TEST_CASE("a column of rigid squares settles by the weights above each contact", "[gravity]")
{
    const int rows = 4;
    Assembly a = squares(1, rows, true);
    const double dt = flexpm::set_real_masses(a, 0.7);
    a.grains.prescribed[component(a.grains.centre(0), 1)] = 1;
    flexpm::set_gravity(a, { 0.0, -g });
    run(a, 4000, dt, 0.7);
    double settled = 0.0;
    for (int above = rows - 1; above > 0; --above)
        settled += above * mass * g / (1e11 * size * specimens::thickness);
    CHECK(a.grains.displacement[component(a.grains.centre(rows - 1), 1)]
        == Approx(-settled).epsilon(1e-6));
}

TEST_CASE("deformable grains hand their weight to what holds them", "[gravity]")
{
    Assembly a = squares(3, 2, false);
    const double dt = flexpm::set_real_masses(a, 0.7);
    const auto bottom = flexpm::side_nodes(a, 0);
    flexpm::prescribe(a, bottom, 1, 0.0);
    flexpm::set_gravity(a, { 0.0, -g });
    flexpm::reset_energy_balance(a);
    run(a, 6000, dt, 0.7);
    CHECK(flexpm::reaction(a, bottom, 1) == Approx(6.0 * mass * g).epsilon(1e-6));
    const auto e = flexpm::energies(a);
    CHECK(e.potential < 0.0);
    CHECK(std::fabs(balance::total(e)) < 1e-9 * std::fabs(e.potential));
}

TEST_CASE("gravity that is set on a moved assembly is booked", "[gravity]")
{
    Assembly a = squares(1, 1, true);
    flexpm::set_real_masses(a, 0.0);
    flexpm::set_motion(a.grains, 0, { 0.0, 1.0 }, 0.0, 1e-6);
    flexpm::reset_energy_balance(a);
    run(a, 100, 1e-6, 0.0);
    flexpm::set_gravity(a, { 0.0, -g });
    run(a, 100, 1e-6, 0.0);
    const auto e = flexpm::energies(a);
    const double height = a.grains.displacement[component(a.grains.centre(0), 1)];
    CHECK(height > 1.9e-4);
    CHECK(e.potential == Approx(mass * g * height));
    // the half of a step in which gravity appears is its work, once
    CHECK(balance::total(e) == Approx(e.initial).margin(mass * g * 1e-6));
    CHECK_THROWS_WITH(flexpm::set_gravity(a, { 0.0, std::nan("") }), Catch::Contains("finite"));
}

TEST_CASE("grains of the inside, too, come to rest on a wall", "[gravity][plate]")
{
    const bool rigid = GENERATE(true, false);
    Assembly a = squares(3, 3, rigid);
    const int wall = flexpm::add_wall(a, { 0.0, -1e-4 }, { 0.0, 1.0 }, { 0.0, 0.3, false });
    CHECK(a.plates[wall].facets.size() == 4 * 9);
    CHECK_THROWS_WITH(flexpm::add_wall(a, { 0.0, 1e-4 }, { 0.0, 1.0 }, {}),
        Catch::Contains("gap between wall and grains"));
    const double damping = 0.2, dt = flexpm::set_real_masses(a, damping);
    flexpm::set_gravity(a, { 0.0, -g });
    flexpm::reset_energy_balance(a);
    double error = 0.0;
    for (int i = 0; i < 200; ++i) {
        run(a, static_cast<int>(2e-4 / dt), dt, damping);
        const auto e = flexpm::energies(a);
        error = std::max(error, std::fabs(balance::miss(e)));
    }
    CHECK(a.plates[wall].force.y == Approx(9.0 * mass * g).epsilon(1e-3));
    CHECK(a.grains.displacement[component(a.grains.centre(4), 1)] == Approx(-1e-4).epsilon(0.02));
    CHECK(flexpm::energies(a).kinetic < 1e-9 * -flexpm::energies(a).potential);
    CHECK(error < 0.01 * -flexpm::energies(a).potential);
}

TEST_CASE("the stable step of real masses falls when a plate is added", "[gravity][mass]")
{
    Assembly a = squares(2, 1, true);
    const double before = flexpm::set_real_masses(a, 0.0);
    CHECK(flexpm::stable_step(a, 0.0) == Approx(before).epsilon(1e-12));
    flexpm::add_wall(a, { 0.0, -1e-4 }, { 0.0, 1.0 }, {});
    CHECK(flexpm::stable_step(a, 0.0) < before);
}
