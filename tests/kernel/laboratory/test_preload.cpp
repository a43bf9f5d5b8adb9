// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Preload of a test along its elastic solution: equilibrium, the first point's utilisation,
/// and the energy balance. SI units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/preload.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>

#include "laboratory/gripped.hpp"
#include "support/balance.hpp"

#include <algorithm>
#include <cmath>

using namespace flexpm;

namespace {

constexpr double share = 0.9;
constexpr int steps = 10;

/// Largest share of its strength that a point carries, tension or Mohr-Coulomb.
double utilisation(const Assembly& a)
{
    double largest = 0.0;
    for (int c = 0; c < a.contacts.count; ++c) {
        const LawParameters& law = a.contacts.law_of(c);
        for (int p = 0; p < a.contacts.group.points; ++p) {
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
    Assembly a = gripped::grains(velocity);
    const ElasticConstants solved = elastic_constants(a);
    preload(a, share, steps, 1.0);
    gripped::run(a, steps);
    const Sense sense = velocity < 0.0 ? Sense::compression : Sense::tension;
    const AxialObservation o = observe(a, rectangle_frame(a, sense));
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
    Assembly a = gripped::grains(velocity);
    preload(a, share, steps, 1.0);
    gripped::run(a, steps);
    const Sense sense = velocity < 0.0 ? Sense::compression : Sense::tension;
    const TestFrame g = rectangle_frame(a, sense);
    const AxialObservation before = observe(a, g);
    release_preload(a, velocity, 1.0, false);
    CHECK(unbalanced_ratio(a) == 0.0);  // nothing was free
    double largest = 0.0;
    for (int i = 0; i < 300; ++i) {
        step(a, gripped::measured());
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

TEST_CASE("A start from the elastic solution refuses shares and steps that make no sense")
{
    Assembly a = gripped::grains(-1e-9);
    CHECK_THROWS_AS(preload(a, 1.0, steps, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(preload(a, 0.0, steps, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(preload(a, share, 0, 1.0), std::invalid_argument);
}

TEST_CASE("A release without a preload is refused")
{
    Assembly a = gripped::grains(0.0);
    CHECK_THROWS_WITH(
        release_preload(a, -1e-9, 1.0, false), Catch::Contains("velocity of the preload = 0 m/s"));
    CHECK_THROWS_AS(release_preload(a, std::nan(""), 1.0, false), std::invalid_argument);
}
