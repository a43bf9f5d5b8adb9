// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion that the loading gives: start from the elastic solution, change of its velocity,
/// cracks that change it. SI units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>

#include "laboratory/gripped.hpp"
#include "support/balance.hpp"

#include <cmath>

using namespace flexpm;

TEST_CASE("A start from rest without damping of the loading keeps to the elastic solution")
{
    const double velocity = GENERATE(-1e-9, 1e-9);
    Assembly a = gripped::grains(velocity);
    const ElasticConstants solved = elastic_constants(a);
    start_elastically(a, true);
    reset_energy_balance(a);
    gripped::run(a, 400);
    const Sense sense = velocity < 0.0 ? Sense::compression : Sense::tension;
    const AxialObservation o = observe(a, rectangle_frame(a, sense));
    CHECK(o.axial_stress / o.axial_strain == Approx(solved.youngs_modulus).epsilon(1e-3));
    CHECK(o.lateral_strain / o.axial_strain == Approx(solved.poissons_ratio).epsilon(1e-3));
    CHECK(unbalanced_ratio(a) < 1e-3);
}

TEST_CASE("Ends that move apart take the halves of a cracked specimen with them")
{
    constexpr double velocity = 1e-9;
    Assembly a = gripped::grains(velocity);
    start_elastically(a, true);
    const auto is_upper = [&](int g) {
        return a.grains.reference[component(a.grains.centre(g), 1)] > 0.02;
    };
    for (int c = 0; c < a.contacts.count; ++c) {
        const auto [g, h] = a.contacts.pairs[c];
        if (is_upper(g) == is_upper(h)) continue;
        for (int p = 0; p < a.contacts.points_of(c); ++p) {
            a.contacts.state(c, p, &PointState::shear_damage) = 1.0;
            a.contacts.state(c, p, &PointState::opening) = 1e-6;
        }
    }
    REQUIRE(renew_loading(a));
    for (int g = 0; g < a.grains.count; ++g) {
        const double along = a.loading.grains.velocity[component(a.grains.centre(g), 1)];
        CHECK(along == Approx(is_upper(g) ? velocity : 0.0).margin(1e-3 * velocity));
    }
}

TEST_CASE("A change of the loading's velocity raises no wave")
{
    const double ratio = GENERATE(0.1, -1.0, 3.0);
    Assembly a = gripped::grains(-1e-9);
    start_elastically(a, true);
    reset_energy_balance(a);
    gripped::run(a, 200);
    const TestFrame g = rectangle_frame(a, Sense::compression);
    const AxialObservation before = observe(a, g);
    move_top(a, -1e-9 * ratio);
    update_prescribed_work(a, 1.0);
    change_loading(a, ratio);
    gripped::run(a, 100);
    const AxialObservation after = observe(a, g);
    const double strain = after.axial_strain - before.axial_strain;
    CHECK(strain == Approx(100.0 * 1e-9 * ratio / g.height).epsilon(1e-6));
    CHECK(after.axial_stress - before.axial_stress
        == Approx(strain * before.axial_stress / before.axial_strain).epsilon(1e-3));
    CHECK(unbalanced_ratio(a) < 1e-3);
    const Energies e = energies(a);
    CHECK(std::fabs(balance::miss(e)) < 1e-5 * e.elastic);
    CHECK_THROWS_AS(change_loading(a, std::nan("")), std::invalid_argument);
}

TEST_CASE("A node that is held later keeps its velocity when that of the loading changes")
{
    Assembly a = gripped::grains(-1e-9);
    start_elastically(a, true);
    const int node = a.grains.centre(0);
    prescribe(a, { node }, 1, 0.0);
    const double free = a.grains.velocity[component(a.grains.centre(1), 1)];
    change_loading(a, 3.0);
    CHECK(a.grains.velocity[component(node, 1)] == 0.0);
    CHECK(a.grains.velocity[component(a.grains.centre(1), 1)] == Approx(3.0 * free));
}

TEST_CASE("A motion of the loading that does not fit its specimen is refused")
{
    Assembly a = gripped::grains(-1e-9);
    start_elastically(a, true);
    check_state(a);
    const auto refused = [&](auto change, const char* part) {
        Assembly bad = a;
        change(bad.loading);
        CHECK_THROWS_WITH(check_state(bad), Catch::Contains(part));
    };
    refused([](LoadingMotion& l) { l.grains.velocity.pop_back(); }, "velocities of the loading");
    refused([](LoadingMotion& l) { l.grains.spin.push_back(0.0); }, "spins of the loading");
    refused([](LoadingMotion& l) { l.plates.resize(1); }, "plates of the loading");
    refused([](LoadingMotion& l) { l.sets.resize(1); }, "node sets of the loading");
}

TEST_CASE("Parts that came after the loading had begun have no motion of it")
{
    Assembly a = gripped::grains(-1e-9);
    start_elastically(a, true);
    CHECK(norm(a.loading.of_plate(0).velocity) == 0.0);
    CHECK(a.loading.of_set(3).moment.z == 0.0);
}
