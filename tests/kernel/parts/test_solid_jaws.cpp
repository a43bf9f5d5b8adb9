// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Curved jaws against the mantle of a disc: what they touch, friction along the rim, what
/// is refused.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>

#include "support/solid_states.hpp"

#include <numeric>

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0, a = solid_samples::side, depth = 3.0 * a;
constexpr Vector up { 0.0, 0.0, 1.0 };

SolidState made(const Packing& p, bool rigid = false)
{
    return make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
}

double area_of(const Plate& plate)
{
    return std::accumulate(plate.points.begin(), plate.points.end(), 0.0,
        [](double sum, const PlatePoint& point) { return sum + point.area; });
}

/// Distance of the facets from the axis [m].
double reach(const Packing& p) { return p.solid.walls[2].offset; }

/// Angle of a facet [rad].
double facet_angle(const Packing& p)
{
    return 2.0 * pi / static_cast<double>(p.solid.walls.size() - 2);
}

}  // namespace

TEST_CASE("A jaw lies before its angle of the mantle, to the hair", "[solids]")
{
    const Packing p = disc();
    SolidState s = made(p);
    const double facet = facet_angle(p), rim = reach(p);
    // half a facet on either side of its middle, three facets, and parts of the outer two
    for (const auto& [angle, length] :
        { std::pair { 0.5 * facet, 2.0 * rim * std::tan(0.25 * facet) },
            { 3.0 * facet, 6.0 * rim * std::tan(0.5 * facet) },
            { 2.0 * facet, 4.0 * rim * std::tan(0.5 * facet) } }) {
        SolidState one = made(p);
        const Plate& plate = one.plates[add_jaw_plate(one, { -2.0 * up, 1.5, angle })];
        CHECK(area_of(plate) == Approx(length * depth).epsilon(1e-9));
        CHECK(plate.disc_radius == Approx(rim).epsilon(1e-9));
        CHECK(plate.jaw_radius == Approx(1.5 * rim).epsilon(1e-9));
        CHECK(norm(plate.normal - up) == 0.0);
        CHECK(norm(plate.position - Vector { 0.0, 0.5 * depth, -rim }) < 1e-9 * rim);
    }
    // one of the disc's own radius touches everywhere, any other where it lies
    const int own = add_jaw_plate(s, { { 1.0, 0.0, 0.0 }, 1.0, 1.0, 0.3 });
    for (const PlatePoint& point : s.plates[own].points)
        CHECK(point.gap == 0.0);
    const int wide = add_jaw_plate(s, { up, 1.5, 2.0 * pi / 3.0 });
    double touching = 0.0;
    for (const PlatePoint& point : s.plates[wide].points)
        if (point.gap == 0.0) touching += point.area;
    CHECK(touching == Approx(2.0 * rim * std::tan(0.5 * facet) * depth).epsilon(1e-9));
    CHECK(find_jaw_plate(s, { up, 1.5, 2.0 * pi / 3.0 }) == wide);
    CHECK(find_jaw_plate(s, { up, 1.6, 2.0 * pi / 3.0 }) == -1);
    CHECK(find_jaw_plate(s, { { 1.0, 0.0, 0.0 }, 1.0, 1.0 }) == -1);  // without friction
    CHECK(contact_angle(s, wide) == 0.0);
}

TEST_CASE("Jaws with friction hold a disc and bear what presses it", "[solids][many_steps]")
{
    const Packing p = disc();
    // between jaws of the disc's own radius facets bear whose normals are not the jaws'
    for (const auto& [rigid, ratio] : { std::pair { false, 1.5 }, { false, 1.0 }, { true, 1.0 } }) {
        SolidState s = made(p, rigid);
        for (const double sign : { -1.0, 1.0 })
            add_jaw_plate(s, { sign * up, ratio, 1.0, 0.4 });
        scale_masses(s, damping, dt);
        const PartGeometry parts { { 1 }, { 0 }, -1.0 * up, 1.0, 1.0 };
        const SolidDrive drive = drive_of(parts);
        start(s, drive, elastic_field(s, drive), 0.0, 1e-8 * a, true, dt);
        for (int k = 0; k < 1500; ++k)
            step(s, { dt, damping, 1, true });
        const double load = part_load(s, parts);
        CHECK(load > 0.0);
        CHECK(s.plates[0].force.z == Approx(-s.plates[1].force.z).epsilon(0.01));
        CHECK(std::fabs(s.plates[0].force.x) < 0.02 * load);
        CHECK(contact_angle(s, 0) >= 0.999 * 2.0 * std::tan(0.5 * facet_angle(p)));
        for (const Plate& plate : s.plates) {
            for (int i = 0; i < plate_points(plate); ++i) {
                const Vector shear = point_shear(plate, i);
                // along the rim, within friction
                const double pushed =
                    std::max(-plate.points[i].opening, 0.0) * point_stiffness(plate, i);
                CHECK(std::fabs(dot(shear, point_normal(plate, i))) <= 1e-9 * norm(shear));
                CHECK(norm(shear) <= plate.friction * pushed * (1.0 + 1e-9));
            }
        }
        const Energies e = energies(s);
        CHECK(std::fabs(e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag
                  - e.boundary_work - e.initial)
            < 1e-4 * e.elastic);
    }
}

TEST_CASE("Jaws that cannot lie there are refused", "[solids]")
{
    const Packing p = disc();
    SolidState s = made(p);
    add_jaw_plate(s, { up, 1.5, 1.0 });
    CHECK_THROWS_WITH(
        add_jaw_plate(s, { up, 1.5, 0.2 }), Catch::Contains("a triangle before two plates"));
    CHECK_THROWS_WITH(add_jaw_plate(s, { -1.0 * up, 0.9, 1.0 }), Catch::Contains("must be >= 1"));
    CHECK_THROWS_WITH(
        add_jaw_plate(s, { {}, 1.5, 1.0 }), Catch::Contains("from the axis to a jaw"));
    CHECK_THROWS_WITH(add_jaw_plate(s, { -1.0 * up, 1.5, 0.0 }), Catch::Contains("angle of a jaw"));
    CHECK_THROWS_WITH(
        add_jaw_plate(s, { -1.0 * up, 1.5, 2.2 }), Catch::Contains("must be <= 2 pi / 3"));
    CHECK_THROWS_WITH(
        add_jaw_plate(s, { -1.0 * up, 1.5, 1.0, -0.1 }), Catch::Contains("friction of a plate"));
    CHECK_THROWS_WITH(contact_angle(s, 4), Catch::Contains("plate of a gauge = 4"));
    SolidPatch over { -1.0 * up, { -a, -a, 0.0 }, { a, depth + a, 6.0 * a } };
    CHECK_THROWS_WITH(add_patch_plate(s, over), Catch::Contains("a triangle before two plates"));
    CHECK(s.plates.size() == 1);
}
