// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Discs of space between plates that touch them: the outline, what is pressed and held,
/// forces and works.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0;

/// Area of the facet that a plate touches [m^2].
double facet_area(const Packing& p)
{
    const auto facets = static_cast<double>(p.solid.walls.size() - 2);
    return 2.0 * p.solid.walls[2].offset * std::tan(pi / facets) * 3.0 * solid_samples::side;
}

SolidState between_plates(const Packing& p, bool rigid)
{
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
    add_disc_plates(s);
    scale_masses(s, damping);
    return s;
}

}  // namespace

TEST_CASE("A disc has its section's area, and a facet below and on top", "[space]")
{
    const Solid disc = Solid::disc(0.05, 0.025, 3e-3);
    CHECK(disc.volume == Approx(0.25 * pi * 0.05 * 0.05 * 0.025));
    REQUIRE(disc.walls.size() % 2 == 0);
    const std::size_t facets = disc.walls.size() - 2;
    CHECK(facets == 52);
    CHECK(disc.walls[2].normal.z == -1.0);
    CHECK(disc.walls[3].normal.z == 1.0);
    Vector sum;
    double section = 0.0;
    for (std::size_t k = 2; k < disc.walls.size(); ++k) {
        sum = sum + disc.walls[k].normal;
        section += disc.walls[k].offset * disc.walls[k].offset * std::tan(pi / facets);
        CHECK(norm(disc.walls[k].normal) == Approx(1.0));
    }
    CHECK(norm(sum) < 1e-12);  // as of a closed ring
    CHECK(section * 0.025 == Approx(disc.volume));
    CHECK_THROWS_WITH(Solid::disc(0.05, 0.0, 3e-3), Catch::Contains("disc: depth = 0 m"));
}

TEST_CASE("Half a disc has half its area, lies flat and has a facet on top", "[space]")
{
    const Solid half = Solid::half_disc(0.05, 0.02, 3e-3);
    CHECK(half.volume == Approx(0.125 * pi * 0.05 * 0.05 * 0.02));
    const std::size_t facets = half.walls.size() - 3;
    REQUIRE(facets % 2 == 1);
    CHECK(facets == 27);
    CHECK(half.walls[2].side == SolidSide::bottom);
    CHECK(half.walls[3].side == SolidSide::top);
    const double apothem = half.walls[3].offset;
    const double chord = 2.0 * apothem * std::tan(0.5 * pi / static_cast<double>(facets));
    Vector sum = 2.0 * half.high.x * half.walls[2].normal;
    for (std::size_t k = 3; k < half.walls.size(); ++k) {
        CHECK(norm(half.walls[k].normal) == Approx(1.0));
        CHECK(half.walls[k].offset == apothem);
        sum = sum + chord * half.walls[k].normal;
    }
    CHECK(norm(sum) < 1e-12);  // as of a closed ring
    CHECK(0.5 * static_cast<double>(facets) * chord * apothem * 0.02 == Approx(half.volume));
    CHECK_THROWS_WITH(Solid::half_disc(0.0, 0.02, 3e-3), Catch::Contains("diameter = 0 m"));
}

TEST_CASE("Plates touch a facet of a disc each, which does not move across", "[solids]")
{
    const Packing p = disc();
    for (const bool rigid : { false, true }) {
        SolidState s = between_plates(p, rigid);
        REQUIRE(s.plates.size() == 2);
        for (const Plate& plate : s.plates) {
            double touched = 0.0;
            for (const PlatePoint& point : plate.points) {
                CHECK(point.gap >= 0.0);
                if (point.gap == 0.0) touched += point.area;
            }
            CHECK(touched == Approx(facet_area(p)).epsilon(1e-6));
            CHECK(pressed_area(plate) == 0.0);
        }
        CHECK_THROWS_WITH(add_disc_plates(s), Catch::Contains("plates = 2, must be 0"));
    }
    const Packing other = box(20, 1);
    SolidState s = make_solid(other.cells, other.solid, granite());
    CHECK_THROWS_WITH(add_disc_plates(s), Catch::Contains("give a disc"));
    CHECK_THROWS_WITH(
        solid_disc_frame(s, 1.0, 1.0), Catch::Contains("must be a lower and an upper one"));
}

TEST_CASE("Both plates bear what is pressed, which is the work that is stored", "[solids]")
{
    const Packing p = disc();
    const double diameter = 6.0 * solid_samples::side, depth = 3.0 * solid_samples::side;
    for (const bool rigid : { false, true }) {
        SolidState s = between_plates(p, rigid);
        const SolidFrame frame = solid_disc_frame(s, diameter, depth);
        CHECK(frame.area == Approx(0.5 * pi * diameter * depth));
        start_ends(s, elastic_field(s), 0.0, -8e-9 * diameter, true, dt);
        for (int k = 0; k < 1000; ++k)
            step(s, { dt, damping, 1, true });
        const AxialObservation now = observe(s, frame);
        CHECK(now.axial_strain == Approx(8e-6).epsilon(1e-9));
        CHECK(now.axial_stress > 0.0);
        CHECK(now.lateral_strain > 0.0);
        CHECK(now.end_mismatch < 0.01);
        const Energies& e = now.energies;
        const double force = 0.5 * (end_forces(s).bottom - end_forces(s).top);
        // linear while no other triangle comes to lie on a plate
        CHECK(e.elastic == Approx(0.5 * force * 8e-6 * diameter).epsilon(0.01));
        CHECK(std::fabs(e.kinetic + e.elastic + e.damping + e.drag - e.boundary_work - e.initial)
            < 1e-4 * e.elastic);
        CHECK(pressed_area(s.plates[0]) == Approx(facet_area(p)).epsilon(0.2));
    }
}

TEST_CASE("A jaw has the gaps and normals of two circles, and a wide one is flat", "[solids]")
{
    const Packing p = disc();
    const SolidState flat = between_plates(p, false);
    const double rim = std::fabs(flat.plates[0].position.z), radius = 1.5 * rim;
    SolidState wide = make_solid(p.cells, p.solid, granite());
    add_disc_plates(wide, 1e5 * rim);
    SolidState bent = make_solid(p.cells, p.solid, granite());
    add_disc_plates(bent, radius);
    for (int side = 0; side < 2; ++side) {
        const Plate &plate = bent.plates[side], &like = wide.plates[side];
        REQUIRE(plate.points.size() == flat.plates[side].points.size());
        for (int i = 0; i < plate_points(plate); ++i) {
            const PlatePoint &point = plate.points[i], &on_flat = flat.plates[side].points[i];
            REQUIRE(point.facet == on_flat.facet);
            const Vector outwards = area_vector(bent, point.facet);
            const double cosine = -dot(outwards, plate.normal) / norm(outwards);
            // the triangle of both centres and the place on the rim
            const double apart = radius - rim;
            const double way = std::sqrt(rim * rim + apart * apart + 2.0 * rim * apart * cosine);
            CHECK(std::fabs(point.gap - (radius - way)) < 1e-8 * rim);
            CHECK(std::fabs(like.points[i].gap - rim * (1.0 - cosine)) < 1e-4 * rim);
            CHECK(norm(point_normal(plate, i)) == Approx(1.0));
            CHECK(norm(point_normal(like, i) - plate.normal) < 1e-4);
            CHECK(dot(point_normal(plate, i), outwards) < 0.0);
            CHECK((point.gap == 0.0) == (on_flat.gap == 0.0));
        }
    }
    SolidState other = make_solid(p.cells, p.solid, granite());
    CHECK_THROWS_WITH(add_disc_plates(other, 0.9 * rim), Catch::Contains("radius of a jaw"));
    CHECK(other.plates.empty());
}

TEST_CASE("Jaws bear the same below and on top, and energies sum", "[solids]")
{
    const Packing p = disc();
    const double diameter = 6.0 * solid_samples::side, depth = 3.0 * solid_samples::side;
    for (const bool rigid : { false, true }) {
        SolidState s =
            make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
        add_disc_plates(s, 1.001 * p.solid.walls[2].offset);  // nearly its own
        scale_masses(s, damping);
        start_ends(s, elastic_field(s), 0.0, -8e-7 * diameter, true, dt);
        for (int k = 0; k < 600; ++k)
            step(s, { dt, damping, 1, true });
        const AxialObservation now = observe(s, solid_disc_frame(s, diameter, depth));
        CHECK(now.axial_stress > 0.0);
        CHECK(now.end_mismatch < 0.05);
        // more than one facet lies in a jaw by now
        CHECK(pressed_area(s.plates[0]) > 1.5 * facet_area(p));
        const Energies& e = now.energies;
        const double lost = e.damping + e.drag + e.damage + e.friction;
        CHECK(std::fabs(e.kinetic + e.elastic + lost - e.boundary_work - e.initial)
            < 1e-3 * e.boundary_work);
    }
}
