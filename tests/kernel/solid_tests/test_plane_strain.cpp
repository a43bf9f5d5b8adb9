// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The plane within space: one layer of prisms between frictionless planes is the plane's
/// assembly in plane strain, whose three points of an edge are the default ones of a rectangle.
#include "support/catch.hpp"

#include <flexpm/kernel/solid_tests/solid_ends.hpp>
#include <flexpm/kernel/solid_tests/solid_frame.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include "solids/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double width = 0.02, height = 0.04;

/// Cells of the plane that keep all their edges.
specimens::Specimen plane_cells()
{
    specimens::Specimen s = specimens::random_grains(width, height, 3e-3, 11);
    s.cells = tessellate(s.discs,
        Outline::polygon({ { 0.0, 0.0 }, { width, 0.0 }, { width, height }, { 0.0, height } }),
        { 0.0, true });
    return s;
}

/// The same cells as prisms, the plane's y along z.
SolidState prisms(const specimens::Specimen& plane, double depth)
{
    std::vector<Sphere> spheres;
    for (int disc : plane.cells.disc_of_cell) {
        const auto& [centre, radius] = plane.discs[disc];
        spheres.push_back({ { centre.x, 0.5 * depth, centre.y }, radius });
    }
    const Solid solid = Solid::box(width, depth, height);
    SolidInput input = granite();
    input.contacts = { specimens::strong_contact() };
    return make_solid(polyhedra(spheres, solid, {}), solid, input);
}

/// Constants of the elastic solution: the mean of both lateral strains is half the one along x.
ElasticConstants constants(SolidState s)
{
    hold_ends(s, { false, false });
    scale_masses(s, 0.7);
    start_ends(s, elastic_field(s), 1e-7, 1e-12, true, 1.0);
    const AxialObservation now = observe(s, solid_frame(s, Sense::tension));
    return { now.axial_stress / now.axial_strain, 2.0 * now.lateral_strain / now.axial_strain };
}

}  // namespace

TEST_CASE("Prisms between frictionless planes have plane strain's E and nu", "[solids]")
{
    const specimens::Specimen plane = plane_cells();
    AssemblyOptions o =
        specimens::options(specimens::strong_contact(), specimens::granite(Plane::strain));
    o.mesh = MeshKind::fan;
    const ElasticConstants expected = elastic_constants(specimens::assemble(plane, o));
    for (const double depth : { 1e-3, 2e-3, 3e-3 }) {
        SolidState s = prisms(plane, depth);
        CHECK(s.contacts.count == static_cast<int>(plane.cells.shared_edges.size()));
        const ElasticConstants loose = constants(s);
        hold_side(s, static_cast<int>(SolidSide::front), 1);
        hold_side(s, static_cast<int>(SolidSide::back), 1);
        const ElasticConstants found = constants(s);
        CHECK(found.youngs_modulus == Approx(expected.youngs_modulus).epsilon(1e-3));
        CHECK(found.poissons_ratio == Approx(expected.poissons_ratio).epsilon(1e-3));
        CHECK(loose.youngs_modulus < 0.97 * expected.youngs_modulus);
    }
}

TEST_CASE("A side that cannot be held is refused", "[solids]")
{
    SolidState s = prisms(plane_cells(), 2e-3);
    CHECK_THROWS_WITH(hold_side(s, 9, 1), Catch::Contains("nodes of side 9 = 0"));
    CHECK_THROWS_WITH(hold_side(s, 4, 3), Catch::Contains("axis = 3, must be 0, 1 or 2"));
    const Packing p = packing(12, 2);
    SolidState rigid =
        make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, true));
    CHECK_THROWS_WITH(hold_side(rigid, 4, 1), Catch::Contains("rigid grains = 12, must be 0"));
}
