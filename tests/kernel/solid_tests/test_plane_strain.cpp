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

/// Constants of the elastic solution, over the whole height as those of the plane.
ElasticConstants constants(SolidState s)
{
    hold_ends(s, { false, false });
    scale_masses(s, 0.7);
    start_ends(s, elastic_field(s), 1e-7, 1e-12, true, 1.0);
    const AxialObservation now = observe(s, solid_frame(s, Sense::tension));
    return { now.axial_stress / now.axial_strain, -mean_strain(s, &Vector::x) / now.axial_strain };
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
}

TEST_CASE("A push on a held face stops it and does no more than a plastic impact", "[solids]")
{
    const Packing p = packing(12, 2);
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, true));
    set_real_masses(s);
    const int axis = GENERATE(0, 1, 2);
    hold_side(s, 4, axis);  // the front, across y
    if (axis == 1) {
        CHECK(s.held_faces.empty());
        CHECK(side_nodes(s, SolidSide::front).size() > 3);
        return;
    }
    REQUIRE(s.held_faces.size() > 2);
    const HeldFace face = s.held_faces.back();
    s.held_faces = { face };
    const int centre = s.grains.centre(face.grain);
    const Vector spin { 2e-4, -1e-4, 3e-4 }, velocity { 1e-6, 2e-6, -3e-6 };
    set_motion(s, face.grain, velocity, spin);
    const Vector before = s.bodies[face.grain].angular_momentum;
    const double kinetic = kinetic_of_velocities(s);
    hold_faces(s);
    const Vector now = space_vector(s.grains.velocity, centre), turn = s.bodies[face.grain].spin;
    const auto along = [&](Vector v) { return axis == 0 ? v.x : v.z; };
    const double moving = along(velocity + cross(spin, face.arm));
    CHECK(std::fabs(along(now + cross(turn, face.arm))) < 1e-12 * std::fabs(moving));
    CHECK(now.y == velocity.y);
    // momenta change by one push in the middle of the face, half of whose work is lost
    const double mass = 1.0 / s.grains.inverse_mass[s.grains.scalar_index(centre)];
    const double push = mass * along(now - velocity);
    const Vector pushed = axis == 0 ? Vector { push, 0.0, 0.0 } : Vector { 0.0, 0.0, push };
    const Vector moment = s.bodies[face.grain].angular_momentum - before;
    CHECK(norm(moment - cross(face.arm, pushed)) < 1e-9 * norm(moment));
    CHECK(kinetic - kinetic_of_velocities(s) == Approx(-0.5 * push * moving).epsilon(1e-9));
    CHECK_THROWS_WITH(elastic_field(s), Catch::Contains("held faces of rigid grains = 1"));
}
