// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against parts of the outside of a solid: what they touch, the modulus between two
/// of them, one that a load moves, works.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/measure/mean_stress.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0, a = solid_samples::side;
constexpr Vector up { 0.0, 0.0, 1.0 }, right { 1.0, 0.0, 0.0 };

SolidState made(const Packing& p, bool rigid)
{
    return make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
}

/// What lies about a side; of an upright one between two heights.
SolidPatch side(const Packing& p, Vector inwards, double low, double high)
{
    const Vector top = p.solid.high;
    SolidPatch patch { inwards, { -a, -a, -a }, { top.x + a, top.y + a, top.z + a } };
    if (inwards.x > 0.0) patch.high.x = a;
    if (inwards.x < 0.0) patch.low.x = top.x - a;
    if (inwards.z > 0.0) patch.high.z = a;
    if (inwards.z < 0.0) patch.low.z = top.z - a;
    if (inwards.x != 0.0) {
        patch.low.z = low;
        patch.high.z = high;
    }
    return patch;
}

/// Both halves of a box held across, the lower ones along x to be driven: plates 0 to 3, its base
/// 4, a lid 5 under a load.
SolidState sheared(const Packing& p, bool rigid)
{
    SolidState s = made(p, rigid);
    const double height = p.solid.high.z, gap = 0.25 * a;
    for (const bool above : { false, true }) {
        for (const double inwards : { 1.0, -1.0 }) {
            SolidPatch half = side(p, inwards * right, above ? 0.5 * height + gap : -a,
                above ? height + a : 0.5 * height - gap);
            half.bonded = true;
            add_patch_plate(s, half);
        }
    }
    SolidPatch base = side(p, up, 0.0, 0.0), lid = side(p, -1.0 * up, 0.0, 0.0);
    base.bonded = true;
    add_patch_plate(s, base);
    free_plate(s, add_patch_plate(s, lid));
    scale_masses(s, damping, dt);
    return s;
}

PartGeometry shearing(const Packing& p)
{
    const Vector top = p.solid.high;
    return { { 0, 1 }, { 2, 3 }, right, top.x * top.y, top.z };
}

void go(SolidState& s, int steps)
{
    for (int k = 0; k < steps; ++k)
        step(s, { dt, damping, 1, true });
}

double imbalance(const Energies& e)
{
    return e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag - e.boundary_work
        - e.initial;
}

}  // namespace

TEST_CASE("A plate touches what of a side is in its box, to the hair", "[solids]")
{
    const Packing p = packing(80, 3);
    SolidState s = made(p, false);
    const Vector top = p.solid.high;
    for (const double height : { 0.31, 0.5, 2.0 }) {
        const double high = std::min(height, 1.0) * top.z;
        SolidState bare = s;
        const Plate& plate =
            bare.plates[add_patch_plate(bare, side(p, right, 0.0, height * top.z))];
        CHECK(plate.face_area == Approx(top.y * high).epsilon(1e-12));
        Vector middle;
        for (const PlatePoint& point : plate.points) {
            CHECK(point.gap == 0.0);
            for (int k = 0; k < 3; ++k)
                middle = middle
                    + point.area / plate.face_area * point.weights[k]
                        * space_vector(s.grains.reference, s.surface.nodes[point.facet][k]);
        }
        CHECK(std::fabs(middle.x) < 1e-12 * top.x);
        CHECK(middle.y == Approx(0.5 * top.y).epsilon(1e-9));
        CHECK(middle.z == Approx(0.5 * high).epsilon(1e-9));
    }
    CHECK_THROWS_WITH(add_patch_plate(s, side(p, right, 2.0 * top.z, 3.0 * top.z)),
        Catch::Contains("triangles before a plate = 0, must be > 0"));
    SolidPatch slanted = side(p, right, 0.0, top.z);
    slanted.normal = { 1.0, 1.0, 0.0 };
    CHECK_THROWS_WITH(add_patch_plate(s, slanted), Catch::Contains("must be a unit vector"));
}

TEST_CASE("Between two patches a solid has the modulus that it has between its ends", "[solids]")
{
    const Packing p = box(60, 2);
    SolidState s = made(p, true);
    for (const double sign : { 1.0, -1.0 }) {
        SolidPatch end = side(p, sign * up, 0.0, 0.0);
        end.bonded = true;
        add_patch_plate(s, end);
    }
    scale_masses(s, damping, dt);
    const Vector top = p.solid.high;
    const PartGeometry parts { { 1 }, { 0 }, up, top.x * top.y, top.z };
    const TestScales scales = solid_part_scales(s, parts, 1e6, dt);
    CHECK(scales.strength == 1e6);
    CHECK(scales.height == top.z);
    // the strain of a record between plates is that of the centres of rigid grains
    SolidState ends = made(p, true);
    hold_ends(ends, { true, false });
    scale_masses(ends, damping, dt);
    const SolidFrame frame = solid_frame(ends, Sense::tension);
    start_ends(ends, elastic_field(ends), 1e-7, 0.0, false, dt);
    CHECK(scales.modulus == Approx(observe(ends, frame).axial_stress / 1e-7).epsilon(1e-6));
    CHECK(scales.crossing_steps > 10.0);
}

TEST_CASE(
    "A plate under a load follows what it presses on, and the works add up", "[solids][many_steps]")
{
    const Packing p = packing(60, 5);
    const double pressure = 2e6;
    for (const bool rigid : { false, true }) {
        SolidState s = sheared(p, rigid);
        REQUIRE(s.plates.size() == 6);
        for (int k = 0; k < 4000; ++k) {
            press(s, 5, pressure * std::min(1.0, k / 1000.0));
            step(s, { dt, damping, 1, true });
        }
        const double load = pressure * s.plates[5].face_area;
        CHECK(-s.plates[5].force.z == Approx(load).epsilon(1e-3));
        CHECK(s.plates[4].force.z == Approx(load).epsilon(1e-3));
        CHECK(balance(s).plate_share < 1e-3);
        CHECK(plate_way(s, 5, up) < 0.0);
        CHECK(std::fabs(imbalance(energies(s))) < 1e-6 * energies(s).elastic);

        const PartGeometry parts = shearing(p);
        const SolidFrame frame = part_frame(s, parts);
        const SolidDrive drive = drive_of(parts);
        const double velocity = 1e-8 * p.solid.high.z;
        take_over(s, drive, elastic_field(s, drive), velocity, true, dt);
        const double lid = plate_way(s, 5, up);
        go(s, 500);
        const AxialObservation now = observe(s, frame);
        CHECK(now.axial_strain == Approx(500.0 * 1e-8).epsilon(1e-9));
        CHECK(now.axial_stress
            == Approx(solid_part_scales(s, parts, 1e6, dt).modulus * now.axial_strain)
                   .epsilon(0.03));
        CHECK(now.end_mismatch < 0.02);
        // the lid goes on bearing its load as it moves with the specimen
        CHECK(-s.plates[5].force.z == Approx(load).epsilon(1e-2));
        CHECK(plate_way(s, 5, up) != lid);
        CHECK(std::fabs(imbalance(now.energies)) < 1e-4 * now.energies.elastic);
        go_on(s, drive, 0.0, dt);
        CHECK(velocity_of(s, drive) == 0.0);
    }
}

TEST_CASE("A plate that no load moves takes none", "[solids]")
{
    const Packing p = packing(40, 5);
    SolidState s = sheared(p, true);
    CHECK_THROWS_WITH(press(s, 0, 1e6), Catch::Contains("let a load move it"));
    CHECK_THROWS_WITH(press(s, 9, 1e6), Catch::Contains("plate = 9, must be the index"));
    CHECK_THROWS_WITH(press(s, 5, -1.0), Catch::Contains("pressure on a plate = -1 Pa"));
    CHECK_THROWS_WITH(
        part_frame(s, { {}, {}, right, 1.0, 1.0 }), Catch::Contains("driven parts = 0"));
    CHECK_THROWS_WITH(plate_way(s, 9, up), Catch::Contains("plate of a gauge = 9"));
    const Vector middle = 0.5 * p.solid.high;
    const GaugePoints gauge = gauge_points(s.grains, middle - 0.5 * a * up, middle + 0.5 * a * up);
    CHECK(gauge.first != gauge.second);
    CHECK(gauge_length(s.grains, gauge) < 2.0 * a);
    CHECK(gauge_opening(s.grains, s.grains.displacement, gauge, up) == 0.0);
    CHECK_THROWS_WITH(
        gauge_points(s.grains, middle, middle), Catch::Contains("length of a gauge = 0 m"));
}

namespace {

/// A box on its base, 0, with a lid, 1, and a wall on the right, 2, that loads may move; the left
/// is held by 3.
SolidState between_walls(const Packing& p, bool rigid)
{
    SolidState s = made(p, rigid);
    for (const Vector inwards : { up, -1.0 * up, -1.0 * right, right })
        add_patch_plate(s, side(p, inwards, -a, p.solid.high.z + a));
    for (int plate : { 1, 2 })
        free_plate(s, plate);
    scale_masses(s, damping, dt);
    return s;
}

}  // namespace

TEST_CASE("A pressed plate that is driven has the scales of one that is not", "[solids]")
{
    const Packing p = packing(60, 5);
    const Vector top = p.solid.high;
    const PartGeometry parts { { 1 }, { 0 }, -1.0 * up, top.x * top.y, top.z };
    for (const bool rigid : { false, true }) {
        double moduli[2];
        for (const bool loaded : { false, true }) {
            SolidState s = made(p, rigid);
            for (const double sign : { 1.0, -1.0 })
                add_patch_plate(s, side(p, sign * up, 0.0, 0.0));
            if (loaded) free_plate(s, 1);  // the last plate, and the only one under a load
            scale_masses(s, damping, dt);
            moduli[loaded] = solid_part_scales(s, parts, 1e6, dt).modulus;
        }
        CHECK(moduli[1] == moduli[0]);
    }
}

TEST_CASE("Static solutions under pressures bear them and superpose", "[solids]")
{
    const Packing p = packing(60, 5);
    const Vector top = p.solid.high;
    const PartGeometry parts { { 1 }, { 0 }, -1.0 * up, top.x * top.y, top.z };
    const PartGeometry none { {}, {}, up, 1.0, 1.0 };
    const double lid = 4e6, wall = 1e6;
    for (const bool rigid : { false, true }) {
        const SolidState s = between_walls(p, rigid);
        const auto pressed = [&](const std::vector<PlatePressure>& pressures) {
            return pressed_part_state(s, none, pressures);
        };
        const SolidPartState both = pressed({ { 1, lid }, { 2, wall } });
        CHECK(both.load == 0.0);
        CHECK(both.way > 0.0);
        const auto force = [&](int plate) {
            return (1.0 / both.way) * both.state.plates[plate].force;
        };
        CHECK(-force(1).z == Approx(lid * s.plates[1].face_area).epsilon(1e-6));
        CHECK(force(0).z == Approx(lid * s.plates[1].face_area).epsilon(1e-6));
        CHECK(-force(2).x == Approx(wall * s.plates[2].face_area).epsilon(1e-6));
        CHECK(force(3).x == Approx(wall * s.plates[3].face_area).epsilon(1e-6));
        const SolidPartState first = pressed({ { 1, lid }, { 2, 0.0 } });
        const SolidPartState second = pressed({ { 1, 0.0 }, { 2, wall } });
        const auto way = [](const SolidPartState& of, int plate, Vector along) {
            return dot(of.state.plates[plate].displacement, along) / of.way;
        };
        for (const auto& [plate, along] : { std::pair { 1, up }, { 2, right } })
            CHECK(way(both, plate, along)
                == Approx(way(first, plate, along) + way(second, plate, along)).epsilon(1e-6));
        // Betti: what one load works on the way of the other
        CHECK(lid * s.plates[1].face_area * way(second, 1, up)
            == Approx(wall * s.plates[2].face_area * way(first, 2, right)).epsilon(1e-5));
        // steps lead there
        SolidState moved = between_walls(p, rigid);
        for (int k = 0; k < 6000; ++k) {
            press(moved, 1, lid * std::min(1.0, k / 2000.0));
            press(moved, 2, wall * std::min(1.0, k / 2000.0));
            step(moved, { dt, damping, 1, true });
        }
        CHECK(plate_way(moved, 1, up) == Approx(way(both, 1, up)).epsilon(0.02));
        // driven by that way, it bears the load; another plate under a load gives way to none
        const SolidPartState driven = elastic_part_state(s, parts, dt);
        CHECK(driven.load / driven.way
            == Approx(lid * s.plates[1].face_area / -way(first, 1, up)).epsilon(1e-5));
        CHECK(std::fabs(driven.state.plates[2].force.x) < 1e-6 * driven.load);
        CHECK_THROWS_WITH(pressed({ { 0, lid } }), Catch::Contains("be free to move"));
        CHECK_THROWS_WITH(pressed({ { 1, 0.0 } }), Catch::Contains("under pressures = 0 m"));
        CHECK_THROWS_WITH(
            pressed_part_state(s, parts, { { 1, lid } }), Catch::Contains("not be driven"));
    }
}

TEST_CASE("The load of plates grows as their contacts tell", "[solids]")
{
    const Packing p = packing(60, 5);
    const Vector top = p.solid.high;
    for (const bool rigid : { false, true }) {
        SolidState s = made(p, rigid);
        for (const double sign : { 1.0, -1.0 }) {
            SolidPatch end = side(p, sign * up, 0.0, 0.0);
            end.friction = 0.5;
            add_patch_plate(s, end);
        }
        scale_masses(s, damping, dt);
        const PartGeometry parts { { 1 }, { 0 }, -1.0 * up, top.x * top.y, top.z };
        const SolidDrive drive = drive_of(parts);
        const double velocity = 1e-8 * top.z;
        start(s, drive, elastic_field(s, drive), 0.0, velocity, true, dt);
        go(s, 400);
        const double load = part_load(s, parts), rate = part_load_rate(s, parts, loading_field(s));
        CHECK(load > 0.0);
        go(s, 100);
        CHECK(part_load(s, parts) - load == Approx(100.0 * dt * rate).epsilon(0.02));
        // what holds tells the same where node sets would be driven
        const PartGeometry held { {}, { 0 }, -1.0 * up, 1.0, 1.0 };
        CHECK(part_load_rate(s, held, loading_field(s)) == Approx(rate).epsilon(0.02));
    }
}
