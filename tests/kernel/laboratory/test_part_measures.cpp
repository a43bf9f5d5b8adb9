// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Supports on parts of the outline, gauges, the scales of a test between parts, and the
/// motion that a loading gives to a cracked specimen. SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/part_measures.hpp>
#include <flexpm/kernel/parts/part_plates.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/statics/unilateral_solve.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/specimens.hpp"

#include <cmath>

using namespace flexpm;

namespace {

constexpr double width = 0.02, height = 0.04;

Assembly grains(bool rigid = false)
{
    auto options = specimens::options(specimens::strong_contact());
    options.rigid = rigid;
    return specimens::assemble(specimens::random_grains(width, height, 2.8e-3, 3), options);
}

Patch patch(double x, double y, double length, Point normal = {})
{
    return { { x, y }, length, normal };
}

/// Sum of a plate's areas [m2] and the x of their centre [m].
struct Covered {
    double area = 0.0, centre = 0.0;
};

Covered covered(const Assembly& a, const Plate& plate)
{
    Covered sum;
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const Point x = vector_on_edge(a.grains.reference, a.facets.nodes(p.facet), p.weight);
        sum.area += plate.points[i].area;
        sum.centre += plate.points[i].area * x.x;
    }
    sum.centre /= sum.area;
    return sum;
}

/// Squeezed between plates along the whole bottom and top; the bottom does not slide.
PartGeometry squeeze(Assembly& a)
{
    const int bottom = add_patch_plate(a, patch(width / 2, 0.0, width), { 0.0, 1e6, false });
    const int top = add_patch_plate(a, patch(width / 2, height, width), {});
    scale_masses(a, 0.7);
    return { { top }, { bottom }, { 0.0, -1.0 }, width * specimens::thickness, height };
}

}  // namespace

TEST_CASE("A support presses evenly on just its part of the outline, about its middle")
{
    Assembly a = grains(GENERATE(false, true));
    const double x = GENERATE(0.0071, 0.01), length = GENERATE(0.4e-3, 5e-3);
    const int number = add_patch_plate(a, patch(x, 0.0, length), {});
    const Plate& plate = a.plates[number];
    const Covered found = covered(a, plate);
    CHECK(plate.normal.y == Approx(1.0));
    CHECK(plate.width == Approx(length));
    CHECK(plate.face_area == Approx(length * specimens::thickness));
    CHECK(found.area == Approx(length * specimens::thickness));
    CHECK(found.centre == Approx(x).epsilon(1e-9));
    for (const PlatePoint& point : plate.points)
        CHECK(point.gap == 0.0);
}

TEST_CASE("A support needs an outline that faces it")
{
    Assembly a = grains();
    CHECK_THROWS_WITH(
        add_patch_plate(a, patch(0.01, 0.02, 1e-3), {}), Catch::Contains("edges at a support = 0"));
    CHECK_THROWS_WITH(add_patch_plate(a, patch(0.01, 0.0, 1e-3, { 0.0, -1.0 }), {}),
        Catch::Contains("edges at a support = 0"));
    CHECK_THROWS_WITH(add_patch_plate(a, patch(0.01, 0.0, 0.0), {}), Catch::Contains("length"));
    CHECK(a.plates.empty());
}

TEST_CASE("Plates do not lie on each other, and a support lies on the outline")
{
    Assembly a = grains(GENERATE(false, true));
    const auto refused = [&](const Patch& p, const char* text) {
        CHECK_THROWS_WITH(add_patch_plate(a, p, {}), Catch::Contains(text));
    };
    add_patch_plate(a, patch(0.01, 0.0, 2e-3), {});
    add_patch_plate(a, patch(0.012, 0.0, 2e-3), {});  // beside it
    refused(patch(0.01, 0.0, 2e-3), "lies on plate 0");
    refused(patch(0.013, 0.0, 1.9e-3), "lies on plate 1");
    CHECK_THROWS_WITH(add_side_plates(a, 0, 1, {}), Catch::Contains("lies on plate 0"));
    refused(patch(0.01, height, 2.0 * width), "the length of its side");
    refused(patch(0.01, height + 5e-4, 1e-3), "off the outline");
    refused(patch(-1e-3, height, 4e-3), "off the outline");
    CHECK(a.plates.size() == 2);
    add_side_plates(a, top_side, 3, {});
    CHECK_THROWS_WITH(add_side_plates(a, top_side, 1, {}), Catch::Contains("lies on"));
    CHECK(a.plates.size() == 5);
}

TEST_CASE("A plate is found again by what it was laid with")
{
    Assembly a = grains(GENERATE(false, true));
    const Patch there = patch(0.01, 0.0, 2e-3);
    CHECK(find_patch_plate(a, there, {}) == -1);
    add_side_plates(a, top_side, 1, { 0.0, 0.3, true });
    add_patch_plate(a, there, {});
    CHECK(find_patch_plate(a, there, {}) == 1);
    CHECK(find_patch_plate(a, patch(0.0101, 0.0, 2e-3), {}) == -1);
    CHECK(find_patch_plate(a, patch(0.01, 0.0, 2.1e-3), {}) == -1);
    CHECK(find_patch_plate(a, there, { 0.0, 0.1, false }) == -1);
    CHECK(find_patch_plate(a, there, { 0.0, 0.0, true }) == -1);
    CHECK(find_side_plate(a, top_side, { 0.0, 0.3, true }) == 0);
    CHECK(find_side_plate(a, top_side, { 0.0, 0.3, false }) == -1);
    CHECK(find_side_plate(a, left_side, { 0.0, 0.3, true }) == -1);
}

TEST_CASE("Parts that leave the specimen free to move are named before the loading")
{
    Assembly a = grains(GENERATE(false, true));
    const int top = add_side_plates(a, top_side, 1, { 0.0, 0.0, true }).front();
    const PartGeometry parts = { { top }, {}, { 0.0, 1.0 }, 1.0, 1.0 };
    const auto refused = [&](const char* text) {
        CHECK_THROWS_WITH(part_scales(a, parts, 1.0, 1.0), Catch::Contains(text));
    };
    scale_masses(a, 0.7);
    refused("fix the specimen along x = 0");
    Assembly b = a;
    add_patch_plate(a, patch(0.0, height / 2, 2e-3), { 0.0, 0.0, true });
    scale_masses(a, 0.7);
    // it is held, but not against the load
    refused("resistance of the supports = 0 N, must be > 0: the specimen moves along y");
    b.plates.clear();
    const int corner = add_patch_plate(b, patch(width / 2, 0.0, 1e-4), { 0.0, 1.0, true });
    for (PlatePoint& point : b.plates[corner].points)
        point.area = 0.0;
    b.plates[corner].points[0].area = 1e-6;
    scale_masses(b, 0.7);
    CHECK_THROWS_WITH(part_scales(b, { { corner }, {}, { 0.0, 1.0 }, 1.0, 1.0 }, 1.0, 1.0),
        Catch::Contains("against rotation = 0"));
}

TEST_CASE("The first value of a row that is not finite is named")
{
    AxialObservation row;
    row.lateral_strain = NAN;  // which there need not be
    CHECK(find_bad_value(row) == nullptr);
    row.energies.boundary_work = NAN;
    CHECK(std::string(find_bad_value(row)) == "boundary work");
    row.axial_stress = INFINITY;
    CHECK(std::string(find_bad_value(row)) == "axial stress");
}

TEST_CASE("Gauges read what their nodes and plates move, each on its side of a notch")
{
    Assembly a = grains();
    const GaugePoints gauge = gauge_points(a.grains, { 0.004, 0.0 }, { 0.016, 0.0 });
    CHECK(gauge_length(a.grains, gauge) == Approx(0.012).margin(2e-3));
    // two places at one corner of two grains take a node of each grain
    const int e = 0;
    const Point corner = vector_at(a.grains.reference, a.contacts.node(e, 0, 0));
    const Point aside = 1e-4 * bonded_normal(a, e);
    const GaugePoints notch = gauge_points(a.grains, corner - aside, corner + aside);
    CHECK(grain_node(a.grains, notch.first).grain != grain_node(a.grains, notch.second).grain);
    for_each_component(a.grains, [&](int i) {
        a.grains.displacement[i] =
            a.grains.layout.axis_of(i) == 0 ? 1e-3 * a.grains.reference[i] : 0.0;
    });
    const double opening = gauge_opening(a.grains, a.grains.displacement, gauge, { 1.0, 0.0 });
    CHECK(opening == Approx(1e-3 * gauge_length(a.grains, gauge)).epsilon(0.05));
    CHECK(gauge_opening(a.grains, a.grains.displacement, gauge, { 0.0, 1.0 }) == 0.0);
    a.plates.resize(1);
    a.plates[0].displacement = { 2.0, 3.0 };
    CHECK(plate_way(a, 0, { 0.0, 1.0 }) == 3.0);
    CHECK_THROWS_WITH(plate_way(a, 1, { 0.0, 1.0 }), Catch::Contains("plate"));
    CHECK_THROWS_WITH(gauge_opening(a.grains, a.grains.displacement, { 0, 1 << 30 }, { 1.0, 0.0 }),
        Catch::Contains("node"));
    CHECK_THROWS_WITH(
        gauge_points(a.grains, { 0.0, 0.0 }, { 0.0, 0.0 }), Catch::Contains("length"));
}

TEST_CASE("A section reads the mean way of the nodes in its band")
{
    Assembly a = grains(GENERATE(false, true));
    const Point up = { 0.0, 1.0 };
    const Section found = section_at(a.grains, 0.01, up, 0.002);
    REQUIRE(found.nodes.size() > 10);
    CHECK(found.place == Approx(0.01).margin(5e-4));
    for (int n : found.nodes)
        CHECK(std::fabs(a.grains.reference[component(n, 1)] - 0.01) <= 0.002);
    // a strain of 1e-3 along y moves the nodes by that of their mean place
    for_each_component(a.grains, [&](int i) {
        a.grains.displacement[i] =
            a.grains.layout.axis_of(i) == 1 ? 1e-3 * a.grains.reference[i] : 0.0;
    });
    CHECK(mean_way(a.grains, a.grains.displacement, found.nodes, up)
        == Approx(1e-3 * found.place).epsilon(1e-12));
    CHECK(mean_way(a.grains, a.grains.displacement, found.nodes, { 1.0, 0.0 }) == 0.0);
    // a grain that has been erased has no nodes any more
    const int gone = grain_node(a.grains, found.nodes.front()).grain;
    a.grains.erased[gone] = 1;
    for (int n : section_at(a.grains, 0.01, up, 0.002).nodes)
        CHECK(grain_node(a.grains, n).grain != gone);
    CHECK_THROWS_WITH(section_at(a.grains, 5.0, up, 0.001), Catch::Contains("section"));
    CHECK_THROWS_WITH(
        mean_way(a.grains, a.grains.displacement, {}, up), Catch::Contains("at least 1"));
    CHECK_THROWS_WITH(
        mean_way(a.grains, a.grains.displacement, { -1 }, up), Catch::Contains("node"));
    CHECK_THROWS_WITH(
        mean_way(a.grains, a.grains.displacement, { 1 << 30 }, up), Catch::Contains("node"));
}

TEST_CASE("The scales of a bar between parts are those of its length and modulus")
{
    Assembly a = grains();
    const double young = elastic_constants(a).youngs_modulus;
    const PartGeometry parts = squeeze(a);
    const TestScales scales = part_scales(a, parts, 1e6, 1.0);
    const double plates = 2.0 / (1.8e14 * height);  // their contacts in series
    CHECK(scales.modulus == Approx(1.0 / (1.0 / young + plates)).epsilon(0.02));
    const TestScales bar =
        rectangle_scales(scale_inputs(a, Sense::compression, 1.0), width, height);
    CHECK(scales.crossing_steps == Approx(bar.crossing_steps).epsilon(0.1));
    CHECK(scales.strength == 1e6);
    CHECK(part_scales(a, parts, 0.0, 1.0).strength > 0.0);
    CHECK_THROWS_WITH(
        part_scales(a, { {}, {}, { 0, 1 }, 1, 1 }, 1e6, 1.0), Catch::Contains("driven"));
    CHECK_THROWS_WITH(
        part_scales(a, { { 7 }, {}, { 0, 1 }, 1, 1 }, 1e6, 1.0), Catch::Contains("part = 7"));
}

TEST_CASE("Load and reaction of parts agree, and their work is the specimen's energy")
{
    Assembly a = grains(GENERATE(false, true));
    PartGeometry parts = squeeze(a);
    set_velocity(a, parts.driven[0], { 0.0, -1e-9 });
    start_elastically(a, true, Held::by_parts);
    StepOptions options;
    options.measure = true;
    for (int i = 0; i < 2000; ++i)
        step(a, options);
    const AxialObservation now = observe(a, part_frame(a, parts));
    CHECK(part_displacement(a, parts) == Approx(2e-6));
    CHECK(now.axial_strain == Approx(2e-6 / height));
    CHECK(now.axial_stress * parts.area == Approx(part_load(a, parts)));
    CHECK(now.axial_stress
        == Approx(now.axial_strain * part_scales(a, parts, 1e6, 1.0).modulus).epsilon(0.03));
    CHECK(now.end_mismatch < 0.01);
    CHECK(std::isnan(now.lateral_strain));
    const double work = a.plates[0].boundary_work + a.plates[1].boundary_work;
    CHECK(work == Approx(now.energies.elastic).epsilon(0.02));
    parts.holding.clear();  // the load alone counts
    CHECK(observe(a, part_frame(a, parts)).end_mismatch == 0.0);
}

TEST_CASE("A specimen that is cracked through moves as two halves under an undamped loading")
{
    Assembly a = grains();
    add_patch_plate(a, patch(0.0, height / 2, height), { 0.0, 1e6, true });
    const int right = add_patch_plate(a, patch(width, height / 2, height), { 0.0, 1e6, true });
    scale_masses(a, 0.7);
    set_velocity(a, right, { 1.0, 0.0 });
    start_elastically(a, true, Held::by_parts);
    CHECK(count_softened(a) == 0);
    const auto x = [&](int g) { return a.grains.reference[a.grains.centre(g)]; };
    const auto along = [&](int g) { return a.loading.grains.velocity[a.grains.centre(g)]; };
    for (int g = 0; g < a.grains.count; ++g)
        CHECK(along(g) == Approx(x(g) / width).margin(0.15));
    for (int c = 0; c < a.contacts.count; ++c) {
        const auto [g, h] = a.contacts.pairs[c];
        if ((x(g) < width / 2) == (x(h) < width / 2)) continue;
        for (int p = 0; p < a.contacts.points_of(c); ++p)
            a.contacts.state(c, p, &PointState::shear_damage) = 1.0;
    }
    CHECK(count_softened(a) > 0);
    renew_loading(a);
    for (int g = 0; g < a.grains.count; ++g)
        CHECK(along(g) == Approx(x(g) < width / 2 ? 0.0 : 1.0).margin(0.02));
}

namespace {

/// A block upon another one, held at the bottom, a joint without strength between them; the plate
/// on top is driven.
struct Blocks {
    Assembly a;
    int joint = 0, top = 0;
};

Blocks blocks_with_joint(Point velocity)
{
    constexpr double size = 3e-3;
    auto options = specimens::options();
    ContactMaterial law = specimens::granite_contact();
    law.cohesion = law.tensile_strength = 0.0;
    law.tensile_fracture_energy = law.shear_fracture_energy = 0.0;
    options.joints = { law };
    options.edge_joint = { 0 };
    Blocks b;
    b.a = specimens::assemble(specimens::grid(1, 2, size), options);
    add_patch_plate(b.a, patch(size / 2, 0.0, size), { 0.0, 1e6, true });
    b.top = add_patch_plate(b.a, patch(size / 2, 2.0 * size, size), { 0.0, 1e6, true });
    scale_masses(b.a, 0.7);
    set_velocity(b.a, b.top, velocity);
    return b;
}

/// Press the faces together and let them bear a share of their friction [-].
void press_faces(Blocks& b, double share)
{
    const LawParameters& law = b.a.contacts.law_of(b.joint);
    for (int p = 0; p < b.a.contacts.points_of(b.joint); ++p) {
        b.a.contacts.state(b.joint, p, &PointState::opening) = -1e-7;
        b.a.contacts.state(b.joint, p, &PointState::shear_traction) =
            share * law.friction * law.normal_stiffness * 1e-7;
    }
}

/// Part of the plate's motion that the centre of the lower block has in the elastic solution [-].
double lower_motion(const Blocks& b, int axis)
{
    return elastic_velocities(b.a, Held::by_parts)[component(b.a.grains.centre(0), axis)];
}

}  // namespace

TEST_CASE("A crack that is pressed stays closed in the elastic solution, one that is not opens")
{
    Blocks b = blocks_with_joint({ 0.0, 1.0 });
    CHECK(lower_motion(b, 1) == Approx(0.0).margin(1e-3));
    press_faces(b, 0.0);
    CHECK(lower_motion(b, 1) > 0.1);
}

TEST_CASE("A joint slides once it is at its friction, and lets go of what it drove")
{
    Blocks b = blocks_with_joint({ 1.0, 0.0 });
    CHECK(count_sliding_joints(b.a) == 0);
    press_faces(b, 0.9);
    CHECK(count_sliding_joints(b.a) == 0);
    CHECK(lower_motion(b, 0) > 0.1);
    press_faces(b, 1.0);
    CHECK(count_sliding_joints(b.a) == 1);
    CHECK(lower_motion(b, 0) == Approx(0.0).margin(1e-3));
    b.a.contacts.erased[b.joint] = 1;
    CHECK(count_sliding_joints(b.a) == 0);
    b.a.contacts.erased[b.joint] = 0;
    b.a.contacts.joint[b.joint] = -1;  // a crack of the rock counts as softened
    CHECK(count_sliding_joints(b.a) == 0);
}

TEST_CASE("Where a grain has come loose the motion of the loading stays what it was")
{
    Blocks b = blocks_with_joint({ 0.0, -1.0 });
    start_elastically(b.a, true, Held::by_parts);
    CHECK(renew_loading(b.a));
    const Array<double> before = b.a.loading.grains.velocity;
    b.a.plates.pop_back();
    for (int p = 0; p < b.a.contacts.points_of(b.joint); ++p)
        b.a.contacts.area(b.joint, p) = 0.0;  // nothing holds the upper block
    CHECK_FALSE(renew_loading(b.a));
    CHECK(b.a.loading.grains.velocity == before);
}
