// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Near pairs that are kept are those that a new search would find, paper Sec. 2.3.
#include <flexpm/kernel/topology/contact_search.hpp>

#include "support/catch.hpp"

#include "support/specimens.hpp"

#include <algorithm>
#include <cmath>
#include <random>

using flexpm::Assembly;

namespace {

constexpr double diameter = 2.8e-3, margin = 0.2 * diameter;  // [m]

/// Move the centre of every grain by up to `way` in x and in y.
void scatter(Assembly& a, double way, std::mt19937& random)
{
    std::uniform_real_distribution<double> part(-way, way);
    for (int g = 0; g < a.grains.count; ++g) {
        const int centre = a.grains.centre(g);
        a.grains.displacement[centre] += part(random);
        a.grains.displacement[centre + flexpm::lanes] += part(random);
    }
}

}  // namespace

TEST_CASE("Kept near pairs are those of a new search, however grains move")
{
    const double way = GENERATE(0.001, 0.05, 0.15, 0.5) * margin;
    Assembly a = specimens::assemble(
        specimens::random_grains(0.03, 0.03, diameter, 3), specimens::options());
    std::mt19937 random(7);
    flexpm::NearPairs pairs;
    std::size_t most = 0;
    for (int look = 0; look < 60; ++look) {
        scatter(a, way, random);
        const auto& found = pairs.find(a, margin);
        CHECK(found == flexpm::near_pairs(a, margin));
        most = std::max(most, found.size());
    }
    CHECK(most > 0);
}

TEST_CASE("Near pairs are searched anew when told, and for another margin")
{
    Assembly a = specimens::assemble(
        specimens::random_grains(0.03, 0.03, diameter, 3), specimens::options());
    flexpm::NearPairs pairs;
    pairs.find(a, margin);
    for (double& area : a.contacts.areas)
        area = 0.0;  // no contact holds any pair
    pairs.forget();
    CHECK(pairs.find(a, margin) == flexpm::near_pairs(a, margin));
    CHECK(pairs.find(a, 2.0 * margin) == flexpm::near_pairs(a, 2.0 * margin));
}

TEST_CASE("The order in which bonds are listed does not matter to near pairs")
{
    auto specimen = specimens::random_grains(0.03, 0.03, diameter, 3);
    const auto o = specimens::options();
    const auto found = flexpm::near_pairs(specimens::assemble(specimen, o), margin);
    auto& bonds = specimen.cells.shared_edges;
    std::reverse(bonds.begin(), bonds.end());
    CHECK(flexpm::near_pairs(specimens::assemble(specimen, o), margin) == found);
}

TEST_CASE("A grain that is nowhere has no near pair, the others have theirs")
{
    Assembly a = specimens::assemble(
        specimens::random_grains(0.03, 0.03, diameter, 3), specimens::options());
    flexpm::NearPairs pairs, others;
    const auto all = pairs.find(a, margin);
    REQUIRE(!all.empty());
    const int gone = all.front()[0];
    a.grains.displacement[a.grains.centre(gone)] = std::nan("");
    auto expected = all;
    expected.erase(std::remove_if(expected.begin(), expected.end(),
                       [gone](const flexpm::GrainPair& p) { return p[0] == gone || p[1] == gone; }),
        expected.end());
    CHECK(expected.size() < all.size());
    CHECK(others.find(a, margin) == expected);
}
