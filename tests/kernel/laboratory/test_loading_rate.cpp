// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Adaptive loading rate: what it follows, how fast it changes, and that a change of the
/// driven velocity keeps the balance of energies. SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/loading_rate.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/balance.hpp"
#include "support/specimens.hpp"

#include <cmath>
#include <limits>

using namespace flexpm;

namespace {

constexpr LoadingRateRule rule = { 8.0, 0.02, 400.0 };
constexpr double damping = 0.7;

/// Velocity factor after `steps` steps of 100 at a constant share.
double factor_after(double factor, double share, int steps)
{
    for (int done = 0; done < steps; done += 100)
        factor = next_velocity_factor(factor, share, 100.0, rule);
    return factor;
}

}  // namespace

TEST_CASE("The dissipated share is what damage and friction take of the work in between")
{
    const Dissipation before = { 1.0, 2.0, 10.0 };
    CHECK(dissipated_share(before, { 1.5, 2.5, 14.0 }) == Approx(0.25));
    CHECK(dissipated_share(before, { 1.0, 2.0, 14.0 }) == 0.0);
    CHECK(dissipated_share(before, before) == 0.0);
    CHECK(std::isinf(dissipated_share(before, { 1.5, 2.0, 9.0 })));
}

TEST_CASE(
    "The velocity factor settles at the share of the rule over the present one, within its limits")
{
    const double start = GENERATE(1.0, 3.0, 8.0);
    CHECK(factor_after(start, 0.01, 4000) == Approx(2.0));
    CHECK(factor_after(start, 0.0, 4000) == Approx(8.0));
    CHECK(factor_after(start, 0.001, 4000) == Approx(8.0));
    CHECK(factor_after(start, 0.02, 4000) == Approx(1.0));
    CHECK(factor_after(start, 0.9, 4000) == Approx(1.0));
    CHECK(factor_after(start, std::numeric_limits<double>::infinity(), 4000) == Approx(1.0));
}

TEST_CASE("The velocity factor doubles in a crossing of the wave and halves in a quarter of it")
{
    CHECK(factor_after(1.0, 0.0, 400) == Approx(2.0));
    CHECK(factor_after(8.0, 1.0, 100) == Approx(4.0));
}

TEST_CASE("Changes of the prescribed velocity keep the balance of energies")
{
    const bool rebooked = GENERATE(true, false);
    Assembly a =
        specimens::assemble(specimens::random_grains(0.02, 0.03, 2.8e-3, 3), specimens::options());
    scale_masses(a, damping);
    grip_bottom(a);
    move_top(a, -1e-9);
    reset_energy_balance(a);
    StepOptions o;
    o.damping = damping;
    for (int i = 0; i < 2000; ++i) {
        o.measure = i == 1999;
        step(a, o);
        if (i % 100 != 99 || i > 1900) continue;
        move_top(a, i % 200 == 99 ? -8e-9 : -1e-9);
        if (rebooked) update_prescribed_work(a, o.dt);
    }
    const Energies e = energies(a);
    CHECK(e.damage == 0.0);
    const double part = std::fabs(balance::miss(e)) / e.boundary_work;
    // a hundredth of the steps have another velocity before than after: the balance sees that
    if (rebooked) {
        CHECK(part < 1e-5);
    } else {
        CHECK(part > 1e-4);
    }
}

TEST_CASE("A test that starts with the elastic velocities deforms as the elastic solve says")
{
    const bool rigid = GENERATE(false, true);
    auto options = specimens::options();
    options.rigid = rigid;
    Assembly a = specimens::assemble(specimens::random_grains(0.02, 0.04, 2.8e-3, 3), options);
    const ElasticConstants solved = elastic_constants(a);
    const double velocity = -1e-10;
    if (rigid) {
        for (int side : { bottom_side, top_side }) {
            const int plate = add_side_plates(a, side, 1, { 0.0, 0.0, true }).front();
            set_velocity(a, plate, { 0.0, side == top_side ? velocity : 0.0 });
        }
        scale_masses(a, damping);
    } else {
        scale_masses(a, damping);
        grip_bottom(a);
        move_top(a, velocity);
    }
    start_elastically(a, false);
    StepOptions o;
    o.damping = damping;
    // far less than a wave needs to cross the specimen
    for (int i = 0; i < 20; ++i) {
        o.measure = i == 19;
        step(a, o);
    }
    const AxialObservation now = observe(a, rectangle_frame(a, Sense::compression));
    CHECK(now.lateral_strain / now.axial_strain == Approx(solved.poissons_ratio).epsilon(1e-3));
    CHECK(now.axial_stress / now.axial_strain == Approx(solved.youngs_modulus).epsilon(1e-2));
}

TEST_CASE("A rule of the loading rate without sense is refused")
{
    const double none = std::nan("");
    for (const LoadingRateRule& rule :
        { LoadingRateRule { 0.5, 0.02, 100.0 }, LoadingRateRule { none, 0.02, 100.0 },
            LoadingRateRule { 8.0, -1.0, 100.0 }, LoadingRateRule { 8.0, 0.02, 0.0 } })
        CHECK_THROWS_AS(next_velocity_factor(1.0, 0.0, 100.0, rule), std::invalid_argument);
    CHECK_THROWS_AS(
        next_velocity_factor(none, 0.0, 100.0, { 8.0, 0.02, 100.0 }), std::invalid_argument);
}
