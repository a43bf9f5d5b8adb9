// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Static solutions of several cases at once, and of a specimen between plates. SI units.
#include "support/same_bits.hpp"
#include "support/specimens.hpp"
#include "support/statics.hpp"

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/statics/elastic_state.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

using namespace flexpm;
using namespace statics;

TEST_CASE("Several cases of one factorisation are those of each alone", "[elastic]")
{
    const Assembly a = random_assembly();
    const auto found = solve_static_cases(
        a, { { hold_sides(a, 1e-6), {}, {} }, { hold_sides(a, -3e-6), {}, {} } }, {});
    CHECK(found[0].displacement == solve_static(a, hold_sides(a, 1e-6)).displacement);
    CHECK(found[1].displacement == solve_static(a, hold_sides(a, -3e-6)).displacement);
    auto fewer = hold_sides(a, 1e-6);
    fewer.pop_back();
    CHECK_THROWS_WITH(
        solve_static_cases(a, { { hold_sides(a, 1e-6), {}, {} }, { fewer, {}, {} } }, {}),
        Catch::Contains("must be the same in all cases"));
    CHECK_THROWS_WITH(solve_static_cases(a, { { hold_sides(a, 1e-6), { {} }, {} } }, {}),
        Catch::Contains("plates = 1 values, must be 0"));
    CHECK_THROWS_WITH(
        solve_static_cases(a, { { hold_sides(a, 1e-6), {}, {} } }, { PointSprings(3), {} }),
        Catch::Contains("springs = 3 values"));
}

TEST_CASE("Springs of the law's stiffness are its own, and half of them bear half", "[elastic]")
{
    const Assembly a = random_assembly();
    PointSprings springs;
    for (int c = 0; c < a.contacts.count; ++c) {
        const LawParameters& law = a.contacts.law_of(c);
        springs.resize(springs.size() + a.contacts.points_of(c),
            { law.normal_stiffness, law.shear_stiffness });
    }
    const auto rows = [&](const std::vector<StiffnessEntry>& entries) {
        Array<double> sums(a.grains.displacement.size(), 0.0);
        for (const auto& e : entries)
            sums[e.row] += e.value * (e.column % 7);
        return sums;
    };
    double largest = 0.0;
    for (const auto& e : stiffness_entries(a))
        largest = std::max(largest, std::fabs(e.value));
    const Array<double> whole = rows(stiffness_entries(a)),
                        given = rows(stiffness_entries(a, { springs, {} }));
    for (PointSpring& k : springs)
        k = { 0.5 * k.normal, 0.5 * k.shear };
    const Array<double> half = rows(stiffness_entries(a, { springs, {} }));
    springs.assign(springs.size(), {});
    const Array<double> none = rows(stiffness_entries(a, { springs, {} }));
    double borne = 0.0;  // by contacts
    for (std::size_t i = 0; i < whole.size(); ++i) {
        CHECK(std::fabs(whole[i] - given[i]) < 1e-9 * largest);
        CHECK(std::fabs((whole[i] - half[i]) - (half[i] - none[i])) < 1e-9 * largest);
        borne = std::max(borne, std::fabs(whole[i] - none[i]));
    }
    CHECK(borne > 0.1 * largest);
}

TEST_CASE("A rectangle between plates is as stiff as its modulus and its plates", "[elastic]")
{
    Assembly a = random_assembly();
    add_side_plates(a, 0, 1, { 0, 0.0, true });
    const int top = add_side_plates(a, 2, 1, { 0, 0.0, true }).front();
    add_side_plates(a, 3, 1, { 0, 0.0, true });
    scale_masses(a, 0.7);
    prepare_step(a);
    const Assembly before = a;
    ElasticLoading loading;
    loading.pressures = { { top, 3e6 } };
    const ElasticState found = find_elastic_state(a, loading);
    CHECK(same_bits::difference(a, before).empty());
    CHECK(found.solutions == 2);
    const double force = 3e6 * a.area_of(a.plates[top].width);
    CHECK(found.state.plates[top].force.y == Approx(-force).epsilon(1e-9));
    CHECK(found.state.plates[0].force.y == Approx(force).epsilon(1e-9));
    // two plates of stiffness K_n in series with the specimen
    const double strain = -found.state.plates[top].displacement.y / 0.04;
    const double series =
        1.0 / (1.0 / elastic_constants(a).youngs_modulus + 2.0 / (a.plates[top].stiffness * 0.04));
    CHECK(3e6 / strain == Approx(series).epsilon(0.02));
}
