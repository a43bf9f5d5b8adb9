// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Stability of the scaled masses with local damping, paper Sec. 2.4, on specimens that no
/// load breaks.
#include "support/catch.hpp"

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/removal.hpp>

#include "support/driven.hpp"

using namespace driven;

namespace {

/// A free, unbreakable specimen with random node velocities of 1e-12 m a step, masses scaled for
/// `mass_damping`, times `mass_factor`.
Assembly shaken(const specimens::Specimen& s, double mass_damping, double mass_factor = 1.0)
{
    Assembly a = specimens::assemble(s, specimens::options(specimens::strong_contact()));
    flexpm::scale_masses(a, mass_damping);
    for (double& m : a.grains.inverse_mass)
        m /= mass_factor;
    flexpm::Random random(7);
    for (int g = 0; g < a.grains.count; ++g) {
        set_velocity(a, g, [&](Point) {
            const double x = random.next(), y = random.next();
            return Point { 1e-12 * (2.0 * x - 1.0), 1e-12 * (2.0 * y - 1.0) };
        });
    }
    flexpm::reset_energy_balance(a);
    return a;
}

/// 1/2 m v^2 of the velocities, never below zero [J].
double kinetic(const Assembly& a)
{
    double sum = 0.0;
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            const int i = a.grains.node(g, n);
            const double vx = a.grains.velocity[i], vy = a.grains.velocity[component(i, 1)];
            sum += 0.5 * (vx * vx + vy * vy) / a.grains.inverse_mass[flexpm::scalar_index(i)];
        }
    }
    return sum;
}

/// Largest kinetic energy over the initial one, looked at every 10 steps.
double growth(Assembly& a, double damping, int steps)
{
    double most = 0.0;
    for (int i = 0; i < steps && most < 1e6; i += 10) {
        run(a, 10, damping);
        most = std::max(most, kinetic(a) / a.ledger.initial);
    }
    return most;
}

std::vector<specimens::Specimen> small_specimens()
{
    return { specimens::grid(3, 2, 3e-3), specimens::random_grains(9e-3, 9e-3, 3e-3, 3) };
}

}  // namespace

TEST_CASE("With damping, noise dies out: 1e-6 of its energy after 300 steps, 1e-18 after 1000")
{
    for (const auto& s : small_specimens()) {
        for (double damping : { 0.3, 0.7 }) {
            CAPTURE(damping);
            Assembly a = shaken(s, damping);
            CHECK(growth(a, damping, 300) < 1.0);
            CHECK(kinetic(a) < 1e-6 * a.ledger.initial);
            CHECK(growth(a, damping, 700) < 1e-6);
            CHECK(kinetic(a) < 1e-18 * a.ledger.initial);
        }
    }
}

TEST_CASE("Without damping, noise stays bounded over 1e5 steps")
{
    Assembly a = shaken(specimens::random_grains(6e-3, 6e-3, 3e-3, 3), 0.0);
    CHECK(growth(a, 0.0, 100000) < 100.0);
    CHECK(kinetic(a) > 0.01 * a.ledger.initial);
}

TEST_CASE("Masses without the factor 1 + alpha are unstable with damping")
{
    // the printed Eq. 20, here even with the margin s = 1.1
    for (const auto& s : small_specimens()) {
        Assembly a = shaken(s, 0.0);
        CHECK(growth(a, 0.7, 2000) > 1e6);
        Assembly b = shaken(s, 0.7, 1.0 / 1.7);
        CHECK(growth(b, 0.7, 2000) > 1e6);
    }
}

TEST_CASE("Masses of less than 0.7 of the bound are unstable without damping")
{
    for (const auto& s : small_specimens()) {
        Assembly a = shaken(s, 0.0, 0.7);
        CHECK(growth(a, 0.0, 20000) > 1e6);
    }
}

TEST_CASE("Real masses are stable at the time step that goes with them")
{
    for (double damping : { 0.0, 0.7 }) {
        for (double factor : { 1.0, 2.0 }) {
            Assembly a = shaken(small_specimens()[1], damping);
            flexpm::StepOptions o;
            o.damping = damping;
            o.dt = factor * flexpm::set_real_masses(a, damping);
            const double initial = kinetic(a);
            double most = 0.0;
            for (int i = 0; i < 3000 && most < 1e6; ++i) {
                flexpm::step(a, o);
                most = std::max(most, kinetic(a) / initial);
            }
            if (factor == 1.0) CHECK(most < 100.0);
            if (factor == 2.0) CHECK(most > 1e6);
        }
    }
}

TEST_CASE("The elements' part of the stiffness bound is kept, and found anew once a grain is gone")
{
    Assembly a =
        specimens::assemble(specimens::random_grains(12e-3, 15e-3, 3e-3, 9), specimens::options());
    const int node = flexpm::scalar_index(a.grains.centre(2));
    REQUIRE_FALSE(a.plan.element_bound.empty());
    CHECK(a.plan.element_bound == flexpm::element_bound(a.grains));
    CHECK(a.plan.element_bound[node] > 0.0);
    const auto before = flexpm::stiffness_bound(a).node;
    flexpm::remove_grain(a, 2);
    const auto after = flexpm::stiffness_bound(a).node;
    CHECK(after[node] == 0.0);
    CHECK(after[flexpm::scalar_index(a.grains.centre(3))]
        == before[flexpm::scalar_index(a.grains.centre(3))]);
    flexpm::prepare_step(a);
    CHECK(flexpm::stiffness_bound(a).node == after);
}

TEST_CASE("Options of a step that make no sense are refused")
{
    Assembly a = specimens::assemble(specimens::grid(2, 2, 2e-3), specimens::options());
    const auto refused = [&](double dt, double damping, int threads) {
        flexpm::StepOptions o;
        o.dt = dt;
        o.damping = damping;
        o.threads = threads;
        CHECK_THROWS_AS(step(a, o), std::invalid_argument);
    };
    for (double dt : { 0.0, -1.0, std::nan(""), HUGE_VAL })
        refused(dt, 0.7, 1);
    for (double damping : { -0.1, 1.0, std::nan("") })
        refused(1.0, damping, 1);
    for (int threads : { 0, -1 })
        refused(1.0, 0.7, threads);
    CHECK(a.step == 0);
}
