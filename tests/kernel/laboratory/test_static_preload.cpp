// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Start of a test from its elastic solution: equilibrium, the first point's utilisation, and the
/// energy balance. SI units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/static_preload.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/balance.hpp"
#include "support/specimens.hpp"

#include <cmath>

using namespace flexpm;

namespace {

constexpr double share = 0.9;
constexpr int steps = 10;

/// Random grains, gripped and driven at `velocity`, the energies counted.
Assembly driven_grains(double velocity)
{
    Assembly a =
        specimens::assemble(specimens::random_grains(0.02, 0.04, 2.8e-3, 3), specimens::options());
    scale_masses(a, 0.7);
    grip_bottom(a);
    move_top(a, velocity);
    reset_energy_balance(a);
    return a;
}

StepOptions measured()
{
    StepOptions o;
    o.measure = true;
    return o;
}

void run(Assembly& a, int count)
{
    for (int i = 0; i < count; ++i)
        step(a, measured());
}

/// Largest share of its strength that a point carries, tension or Mohr-Coulomb.
double utilisation(const Assembly& a)
{
    double largest = 0.0;
    for (int c = 0; c < a.contacts.count; ++c) {
        const LawParameters& law = a.contacts.law_of(c);
        for (int p = 0; p < a.contacts.points; ++p) {
            const PointState s = a.contacts.point_state(c, p);
            const double normal = law.normal_stiffness * s.opening;
            largest = std::max(largest, normal / law.tensile_strength);
            // proportional loading: c / (|shear| + mu normal) is what is left to grow
            largest = std::max(
                largest, (std::fabs(s.shear_traction) + law.friction * normal) / law.cohesion);
        }
    }
    return largest;
}

}  // namespace

TEST_CASE(
    "A specimen preloaded along its elastic solution is in equilibrium at the share asked for")
{
    const double velocity = GENERATE(-1e-9, 1e-9);
    Assembly a = driven_grains(velocity);
    const ElasticConstants solved = elastic_constants(a);
    preload(a, share, steps, 1.0);
    run(a, steps);
    const Sense sense = velocity < 0.0 ? Sense::compression : Sense::tension;
    const AxialObservation o = observe(a, rectangle_of(a, sense));
    // the solution is linear: strains of a few 1e-4 turn and stretch by as much of each term
    CHECK(utilisation(a) == Approx(share).epsilon(2e-3));
    CHECK(o.axial_stress / o.axial_strain == Approx(solved.youngs_modulus).epsilon(2e-3));
    CHECK(o.lateral_strain / o.axial_strain == Approx(solved.poissons_ratio).epsilon(2e-3));
    const Energies e = energies(a);
    CHECK(e.damage == 0.0);
    CHECK(std::fabs(balance::miss(e)) < 1e-5 * e.elastic);
}

TEST_CASE("After the elastic solution the test goes on without a jolt")
{
    const double velocity = GENERATE(-1e-9, 1e-9);
    Assembly a = driven_grains(velocity);
    preload(a, share, steps, 1.0);
    run(a, steps);
    const Sense sense = velocity < 0.0 ? Sense::compression : Sense::tension;
    const AxialGeometry g = rectangle_of(a, sense);
    const AxialObservation before = observe(a, g);
    release_preload(a, velocity, 1.0, false);
    CHECK(unbalanced_ratio(a) == 0.0);  // nothing was free
    double largest = 0.0;
    for (int i = 0; i < 300; ++i) {
        step(a, measured());
        largest = std::max(largest, unbalanced_ratio(a));
    }
    CHECK(largest < 5e-3);
    const AxialObservation after = observe(a, g);
    const double strain = after.axial_strain - before.axial_strain;
    CHECK(strain == Approx(300.0 * std::fabs(velocity) / g.height).epsilon(1e-6));
    CHECK(after.axial_stress - before.axial_stress
        == Approx(strain * before.axial_stress / before.axial_strain).epsilon(0.02));
    const Energies e = energies(a);
    CHECK(std::fabs(balance::miss(e)) < 1e-5 * e.elastic);
}

TEST_CASE("A start from rest without damping of the loading keeps to the elastic solution")
{
    const double velocity = GENERATE(-1e-9, 1e-9);
    Assembly a = driven_grains(velocity);
    const ElasticConstants solved = elastic_constants(a);
    start_elastically(a, true);
    reset_energy_balance(a);
    run(a, 400);
    const Sense sense = velocity < 0.0 ? Sense::compression : Sense::tension;
    const AxialObservation o = observe(a, rectangle_of(a, sense));
    CHECK(o.axial_stress / o.axial_strain == Approx(solved.youngs_modulus).epsilon(1e-3));
    CHECK(o.lateral_strain / o.axial_strain == Approx(solved.poissons_ratio).epsilon(1e-3));
    CHECK(unbalanced_ratio(a) < 1e-3);
}

TEST_CASE("Ends that move apart take the halves of a cracked specimen with them")
{
    constexpr double velocity = 1e-9;
    Assembly a = driven_grains(velocity);
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
        const double along = a.grains.loading_velocity[component(a.grains.centre(g), 1)];
        CHECK(along == Approx(is_upper(g) ? velocity : 0.0).margin(1e-3 * velocity));
    }
}

TEST_CASE("A change of the loading's velocity raises no wave")
{
    const double ratio = GENERATE(0.1, -1.0, 3.0);
    Assembly a = driven_grains(-1e-9);
    start_elastically(a, true);
    reset_energy_balance(a);
    run(a, 200);
    const AxialGeometry g = rectangle_of(a, Sense::compression);
    const AxialObservation before = observe(a, g);
    move_top(a, -1e-9 * ratio);
    update_prescribed_work(a, 1.0);
    change_loading(a, ratio);
    run(a, 100);
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
    Assembly a = driven_grains(-1e-9);
    start_elastically(a, true);
    const int node = a.grains.centre(0);
    prescribe(a, { node }, 1, 0.0);
    const double free = a.grains.velocity[component(a.grains.centre(1), 1)];
    change_loading(a, 3.0);
    CHECK(a.grains.velocity[component(node, 1)] == 0.0);
    CHECK(a.grains.velocity[component(a.grains.centre(1), 1)] == Approx(3.0 * free));
}

TEST_CASE("The elastic limit follows from the strengths of the point that reaches one first")
{
    // one bond in pure tension: the top moves until K_n u = sigma_t
    Assembly a = specimens::assemble(specimens::grid(1, 2, 3e-3), specimens::options());
    grip_bottom(a);
    move_top(a, 1e-9);
    Array<double> v(a.grains.velocity.size(), 0.0);
    for (int n = 0; n < a.grains.nodes_of(1); ++n)
        v[component(a.grains.node(1, n), 1)] = 1e-9;  // the upper grain as a whole
    const LawParameters& law = a.contacts.laws[0];
    CHECK(elastic_time(a, v) == Approx(law.elastic_opening / 1e-9));
    for (double& value : v)
        value = -value;
    CHECK(std::isinf(elastic_time(a, v)));
}

TEST_CASE("A start from the elastic solution refuses shares and steps that make no sense")
{
    Assembly a = driven_grains(-1e-9);
    CHECK_THROWS_AS(preload(a, 1.0, steps, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(preload(a, 0.0, steps, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(preload(a, share, 0, 1.0), std::invalid_argument);
}

TEST_CASE("A release without a preload is refused")
{
    Assembly a = driven_grains(0.0);
    CHECK_THROWS_WITH(
        release_preload(a, -1e-9, 1.0, false), Catch::Contains("velocity of the preload = 0 m/s"));
    CHECK_THROWS_AS(release_preload(a, std::nan(""), 1.0, false), std::invalid_argument);
}
