// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Beams of space between rollers and a head: lines that bear, the deflection by Timoshenko,
/// forces and works.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/solid_beam.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0;

/// A beam between two rollers.
struct Beam {
    double length, depth, height, span;

    /// Rollers are laid before the head.
    PartGeometry parts() const
    {
        return { { 2 }, { 0, 1 }, { 0.0, 0.0, -1.0 }, 2.0 * depth * height * height / (3.0 * span),
            span * span / (6.0 * height) };
    }
    Packing packing(int grains, std::uint64_t seed) const
    {
        const Solid solid = Solid::box(length, depth, height);
        return { solid,
            polyhedra(flexpm_test::packed_spheres(solid, grains, seed), solid,
                { 0.1 * solid_samples::side, false }) };
    }
    void lay(SolidState& s) const
    {
        const double width = 0.5 * solid_samples::side;
        for (const double side : { -0.5, 0.5 })
            add_line_plate(s, SolidSide::bottom, { 0.5 * length + side * span, 0.0, width, false });
        add_line_plate(s, SolidSide::top, { 0.5 * length, height, width, true });
        scale_masses(s, damping);
    }
};

constexpr double a = solid_samples::side;
constexpr Beam few { 12.0 * a, 3.0 * a, 3.0 * a, 10.0 * a };

SolidState laid(const Beam& beam, const Packing& p, bool rigid)
{
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
    beam.lay(s);
    return s;
}

/// Mean way down of the nodes about the axis of a beam next to a section.
double axis_way(const SolidState& s, const SolidField& field, double x, double z, double reach)
{
    double sum = 0.0;
    int count = 0;
    std::size_t next = 0;
    for_each_node(s, [&](int grain, int number) {
        const Vector r = space_vector(s.grains.reference, s.grains.node(grain, number));
        const Vector way = field.ways[next++];
        if (std::fabs(r.x - x) > reach || std::fabs(r.z - z) > reach) return;
        sum += way.z;  // the head goes up in a field
        ++count;
    });
    return sum / count;
}

/// What plates of a side would push if they pulled, too; the head goes up by the height.
double load_of(const SolidState& s, const SolidField& field, SolidSide side)
{
    const double head = end_place(s, SolidSide::top) - end_place(s, SolidSide::bottom);
    double sum = 0.0;
    for (const LinearSolid::Press& p : linear_solid(s).presses) {
        if (s.plates[p.plate].side != static_cast<int>(side)) continue;
        double way = side == SolidSide::top ? -head : 0.0;
        for (int k = 0; k < 3; ++k)
            way += p.shares[k] * field.ways[p.nodes[k]].z;
        sum += p.stiffness * way;
    }
    return std::fabs(sum);
}

/// Deflection of the axis of a beam of cubic grains, so many high, over Timoshenko's.
double deflection(int high)
{
    const int longer = 30 * high / 4;
    const Beam beam { longer * a, a, high * a, (longer - 0.45 * high) * a };
    const Packing p { Solid::box(beam.length, beam.depth, beam.height),
        solid_samples::brick(longer, 1, high) };
    SolidInput input = granite();
    input.contacts[0].normal_stiffness *= 100.0;
    SolidState s = make_solid(p.cells, p.solid, input);
    beam.lay(s);
    const SolidField field = elastic_field(s);
    const double load = load_of(s, field, SolidSide::top);
    CHECK(load_of(s, field, SolidSide::bottom) == Approx(load).epsilon(1e-6));
    const double young = input.grains[0].young, poisson = input.grains[0].poisson;
    const double inertia = beam.depth * std::pow(beam.height, 3) / 12.0;
    const double factor = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
    const double shear = factor * 0.5 * young / (1.0 + poisson) * beam.depth * beam.height;
    const double told =
        load * (std::pow(beam.span, 3) / (48.0 * young * inertia) + beam.span / (4.0 * shear));
    const auto way = [&](double x) { return axis_way(s, field, x, 0.5 * beam.height, 0.7 * a); };
    const double middle = 0.5 * beam.length;
    const double found =
        way(middle) - 0.5 * (way(middle - 0.5 * beam.span) + way(middle + 0.5 * beam.span));
    return found / told;
}

}  // namespace

TEST_CASE("Rollers and head of a beam bear along lines across all of its depth", "[solids]")
{
    const Packing p = few.packing(110, 2);
    for (const bool rigid : { false, true }) {
        const SolidState s = laid(few, p, rigid);
        REQUIRE(s.plates.size() == 3);
        for (const Plate& plate : s.plates) {
            double length = 0.0, worst = 0.0;
            for (const PlatePoint& point : plate.points) {
                length += point.area / (0.5 * a);
                double x = 0.0, sum = 0.0;
                for (int k = 0; k < 3; ++k) {
                    const double share = point.weights[k];
                    CHECK(share > -1e-12);
                    sum += share;
                    x += share * s.grains.reference[s.surface.nodes[point.facet][k]];
                }
                CHECK(sum == Approx(1.0));
                worst = std::max(worst, std::fabs(x - plate.position.x));
                CHECK(point.gap < 1e-12);
            }
            CHECK(length == Approx(few.depth));
            CHECK(worst < 1e-12);
        }
    }
    SolidState s = make_solid(p.cells, p.solid, granite());
    CHECK_THROWS_WITH(add_line_plate(s, SolidSide::bottom, { 1.0, 0.0, a, false }),
        Catch::Contains("triangles at x = 1 m, z = 0 m = 0, must be > 0"));
    CHECK_THROWS_WITH(add_line_plate(s, SolidSide::left, { a, 0.0, a, false }),
        Catch::Contains("side = 3, must be 0, the bottom, or 2, the top"));
    CHECK_THROWS_WITH(
        part_frame(s, few.parts()), Catch::Contains("part = 2, must be the index of a plate"));
}

TEST_CASE("A beam with stiff contacts is bent as Timoshenko's", "[solids][elastic_bodies]")
{
    const double coarse = deflection(4), middle = deflection(8), fine = deflection(16);
    CAPTURE(coarse, middle, fine);
    // tetrahedra are stiff in bending, by the square of their size over the height
    CHECK(coarse < middle);
    CHECK(middle < fine);
    CHECK((4.0 * middle - coarse) / 3.0 == Approx(fine).epsilon(0.01));
    CHECK(fine == Approx(1.0).epsilon(0.02));
}

TEST_CASE("Rollers and head of a beam bear the same, which is the work that is stored", "[solids]")
{
    const Packing p = few.packing(110, 2);
    for (const bool rigid : { false, true }) {
        SolidState s = laid(few, p, rigid);
        const SolidFrame frame = part_frame(s, few.parts());
        const TestScales scales = solid_part_scales(s, few.parts(), 10e6, dt);
        CHECK(scales.height == Approx(few.parts().length));
        CHECK(scales.strength == 10e6);
        const SolidDrive drive = drive_of(few.parts());
        start(s, drive, elastic_field(s, drive), 0.0, 8e-9 * few.height, true, dt);
        for (int k = 0; k < 1000; ++k)
            step(s, { dt, damping, 1, true });
        const AxialObservation now = observe(s, frame);
        const double way = 8e-6 * few.height;
        CHECK(now.axial_strain * few.parts().length == Approx(way).epsilon(1e-9));
        CHECK(now.axial_stress == Approx(scales.modulus * now.axial_strain).epsilon(0.02));
        CHECK(now.end_mismatch < 0.01);
        const Energies& e = now.energies;
        const double force = now.axial_stress * few.parts().area;
        CHECK(e.elastic == Approx(0.5 * force * way).epsilon(0.01));
        CHECK(std::fabs(e.kinetic + e.elastic + e.damping + e.drag - e.boundary_work - e.initial)
            < 1e-4 * e.elastic);
        // the outer fibre of the middle is pulled
        CHECK(mouth_opening(s, { 0.5 * few.length, a }) > 0.0);
    }
}
