// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Outlines in space.
#include "support/sphere_samples.hpp"

using namespace flexpm_test;

TEST_CASE("a cylinder is a prism of the same section", "[space]")
{
    for (double grain : { 3e-3, 5e-2 }) {
        const Solid solid = Solid::cylinder(0.05, 0.1, grain);
        const int facets = static_cast<int>(solid.walls.size()) - 2;
        CHECK(facets == (grain < 0.01 ? 52 : 16));
        // one cell fills all of it, and its mantle has straight edges
        const Polyhedra cells = polyhedra({ { { 1e-3, 2e-3, 0.04 }, 0.02 } }, solid, {});
        CHECK(cells.vertices.size() == static_cast<std::size_t>(2 * facets));
        CHECK(cells.volumes[0] == Approx(0.25 * pi * 0.05 * 0.05 * 0.1).epsilon(1e-13));
        require_filled(cells, solid);
    }
}

TEST_CASE("distances from the walls of a box", "[space]")
{
    const Solid box = Solid::box(1.0, 2.0, 3.0);
    CHECK(distance_inside(box, { 0.5, 0.4, 1.0 }) == Approx(0.4));
    CHECK(distance_inside(box, { 0.5, 1.0, 3.1 }) == Approx(-0.1));
    CHECK_THROWS_WITH(Solid::box(1.0, 0.0, 1.0), Catch::Contains("box: depth = 0 m"));
    CHECK_THROWS_WITH(Solid::box(1.0, 1.0, HUGE_VAL), Catch::Contains("box: height = inf m"));
    CHECK_THROWS_WITH(
        Solid::cylinder(-1.0, 1.0, 1.0), Catch::Contains("cylinder: diameter = -1 m"));
}

TEST_CASE("spheres are inserted inside and apart", "[space]")
{
    const Solid solid = Solid::cylinder(0.02, 0.02, 3e-3);
    std::vector<double> radii(100, 1e-3);
    radii[50] = 2e-3;
    const auto centres = insert_spheres(radii, solid, 0.5, 3);
    for (std::size_t i = 0; i < radii.size(); ++i) {
        CHECK(distance_inside(solid, centres[i]) >= 0.5 * radii[i]);
        for (std::size_t j = 0; j < i; ++j)
            CHECK(norm(centres[i] - centres[j]) >= 0.5 * (radii[i] + radii[j]));
    }
    CHECK_THROWS_WITH(
        insert_spheres({ 0.03 }, solid, 0.5, 1), Catch::Contains("must fit into the outline"));
}
