// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What tests of solids leave: a break end to end with its balance, cracks, snapshot,
/// overlaps.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/measure/solid_overlaps.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include "support/solid_states.hpp"

#include <numeric>

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0;

struct Broken {
    SolidState state;
    double peak = 0.0, last = 0.0, imbalance = 0.0, work = 0.0;
};

/// From its elastic limit until the stress has fallen to half of its peak.
Broken broken(int grains, bool rigid, Sense sense, double rate, int threads = 1)
{
    const bool pulled = sense == Sense::tension;
    const double sign = pulled ? 1.0 : -1.0;
    const double diameter = solid_samples::side * std::cbrt(0.38 * grains);
    const auto solid = Solid::cylinder(diameter, 2.0 * diameter, solid_samples::side);
    const Polyhedra cells = polyhedra(
        flexpm_test::packed_spheres(solid, grains, 3), solid, { 0.1 * solid_samples::side, false });
    Broken b { make_solid(cells, solid, granite(FacePointRule::corners_and_inner, rigid)) };
    SolidState& s = b.state;
    hold_ends(s, { pulled, false });
    scale_masses(s, damping);
    const SolidField field = elastic_field(s);
    const SolidFrame frame = solid_frame(s, sense);
    const double start = 0.9 * elastic_strain(s, field, sign);
    start_ends(s, field, sign * start, sign * rate * frame.height, true, dt);
    for (int k = 0; k < 20000; ++k) {
        const bool look = k % 25 == 0;
        step(s, { dt, damping, threads, look });
        if (!look) continue;
        const AxialObservation now = observe(s, frame);
        const Energies& e = now.energies;
        const double given = e.boundary_work + e.initial;
        b.imbalance = std::max(b.imbalance,
            std::fabs(e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag - given));
        b.work = std::max(b.work, given);
        b.last = now.axial_stress;
        b.peak = std::max(b.peak, b.last);
        if (b.last < 0.5 * b.peak) break;
    }
    return b;
}

}  // namespace

TEST_CASE("A cylinder breaks between its ends, and its energies add up", "[solids]")
{
    for (const bool rigid : { false, true }) {
        for (const Sense sense : { Sense::tension, Sense::compression }) {
            const bool pulled = sense == Sense::tension;
            const Broken b = broken(30, rigid, sense, pulled ? 3e-7 : 2e-6);
            const CrackCount cracks = count_cracks(b.state);
            CAPTURE(rigid, pulled, b.peak, b.last, b.imbalance, b.work, cracks.tensile,
                cracks.shear, b.state.step);
            CHECK(b.last < 0.5 * b.peak);
            CHECK(b.imbalance < 3e-3 * b.work);
            CHECK(cracks.tensile > 10);
            const double strength = specimens::granite_contact().tensile_strength;
            if (pulled) {
                CHECK(b.peak > 0.7 * strength);
                CHECK(b.peak < 2.5 * strength);
            } else {
                CHECK(b.peak > 4.0 * strength);
                CHECK(b.peak < 40.0 * strength);
            }

            int rows = 0, parted = 0;
            double energy = 0.0;
            for (int c = 0; c < b.state.contacts.count; ++c) {
                bool holds = false;
                for (int p = 0; p < b.state.contacts.points_of(c); ++p) {
                    const FaceCrack& crack = b.state.contacts.crack(c, p);
                    holds = holds || crack.mode == intact;
                    if (crack.mode == intact) continue;
                    ++rows;
                    energy += crack.energy;
                    CHECK((crack.step > 0 && crack.step <= b.state.step));
                }
                parted += !holds;
            }
            CHECK(rows == cracks.tensile + cracks.shear);
            const Energies e = energies(b.state);
            CHECK(energy == Approx(e.damage - e.softened).epsilon(1e-9));
            CHECK(parted > 0);

            const SolidOverlap overlap = largest_overlap(b.state);
            CAPTURE(overlap.depth, overlap.of_diameter, overlap.pairs);
            CHECK(overlap.of_diameter < 0.1);
        }
    }
}

TEST_CASE("Plates of rigid grains have the same bits on any number of threads", "[solids]")
{
    const auto run = [](int threads) {
        const Packing p = packing(3 * tile_grains, 6);
        SolidState s =
            make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, true));
        hold_ends(s, { true, false });
        scale_masses(s, damping);
        start_ends(s, elastic_field(s), 1e-5, 1e-7 * p.solid.high.z, true, dt);
        for (int k = 0; k < 60; ++k)
            step(s, { dt, damping, threads, true });
        return s;
    };
    const SolidState one = run(1);
    CHECK(one.plates[0].force.z < 0.0);
    for (int threads : { 2, 5 }) {
        const SolidState other = run(threads);
        CHECK(other.grains.displacement == one.grains.displacement);
        CHECK(other.plates[1].force.z == one.plates[1].force.z);
        CHECK(other.plates[1].boundary_work == one.plates[1].boundary_work);
    }
}

TEST_CASE("A snapshot of a solid has its volumes, places and stresses", "[solids]")
{
    for (const bool rigid : { false, true }) {
        const Packing p = packing(30, 4);
        SolidState s =
            make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
        hold_ends(s, { false, false });
        scale_masses(s, damping);
        const SolidField field = elastic_field(s);
        start_ends(s, field, -2e-5, 0.0, true, dt);
        for (int k = 0; k < 50; ++k)
            step(s, { dt, damping, 1, true });
        const SolidSnapshot now = take_snapshot(s);
        const double volume = std::accumulate(now.volumes.begin(), now.volumes.end(), 0.0);
        CHECK(volume == Approx(p.solid.volume).epsilon(1e-10));
        const int grains = s.grains.count;
        CHECK(static_cast<int>(now.centres.size()) == 3 * grains);
        CHECK(now.node_offsets.size() == static_cast<std::size_t>(grains + 1));
        CHECK(now.elements.size() == 4 * now.element_grain.size());
        CHECK(now.element_stress.size() == 6 * now.element_grain.size());
        CHECK(now.positions.size() == 3 * static_cast<std::size_t>(now.node_offsets.back()));
        CHECK(now.velocities.size() == now.positions.size());
        for (std::size_t t = 0; t < now.element_grain.size(); ++t) {
            const int grain = now.element_grain[t];
            const auto corner = [&](int k) {
                const int n = now.elements[4 * t + k];
                CHECK((n >= now.node_offsets[grain] && n < now.node_offsets[grain + 1]));
                const double* r = &now.positions[3 * n];
                return Vector { r[0], r[1], r[2] };
            };
            const Vector first = corner(0);
            CHECK(triple(corner(1) - first, corner(2) - first, corner(3) - first) > 0.0);
        }
        double area = 0.0, across = 0.0;
        for (int c = 0; c < s.contacts.count; ++c) {
            area += now.areas[c];
            const Vector n { now.normals[3 * c], now.normals[3 * c + 1], now.normals[3 * c + 2] };
            CHECK(norm(n) == Approx(1.0));
            const int a = now.contact_grains[2 * c], b = now.contact_grains[2 * c + 1];
            Vector between;
            for (int axis = 0; axis < 3; ++axis)
                (axis == 0          ? between.x
                        : axis == 1 ? between.y
                                    : between.z) =
                    now.centres[3 * b + axis] - now.centres[3 * a + axis];
            across += dot(n, between) > 0.0;
        }
        CHECK(across == s.contacts.count);
        CHECK(now.point_area.size() == static_cast<std::size_t>(now.point_offsets.back()));
        CHECK(std::accumulate(now.point_area.begin(), now.point_area.end(), 0.0)
            == Approx(area).epsilon(1e-10));
        CHECK(now.corners.size() == 3 * static_cast<std::size_t>(now.corner_offsets.back()));
        CHECK(now.corner_nodes.size() == 2 * static_cast<std::size_t>(now.corner_offsets.back()));
        // the mean stress along the axis is that of the ends
        const SolidFrame frame = solid_frame(s, Sense::compression);
        double mean = 0.0;
        for (int g = 0; g < grains; ++g)
            mean -= now.grain_stress[6 * g + 2] * now.volumes[g] / volume;
        CHECK(mean == Approx(observe(s, frame).axial_stress).epsilon(5e-3));
        CHECK(std::all_of(now.crack_step.begin(), now.crack_step.end(),
            [](std::int64_t step) { return step == -1; }));
    }
}

TEST_CASE("The overlap of grains that were never neighbours is their depth", "[solids]")
{
    const double d = solid_samples::side;
    const Packing p { Solid::box(d, d, 3.0 * d), solid_samples::brick(1, 1, 3) };
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, true));
    CHECK(largest_overlap(s).depth == 0.0);
    CHECK(largest_overlap(s).pair == GrainPair { -1, -1 });
    // the third grain moves past the second into the first, smaller than it
    const int third = s.contacts.pairs.back()[1], first = s.contacts.pairs.front()[0];
    const double way = 1.25 * d;
    for (int n = 0; n < s.grains.nodes_of(third); ++n) {
        const int node = s.grains.node(third, n);
        const Vector arm = space_vector(s.grains.reference, node)
            - space_vector(s.grains.reference, s.grains.centre(third));
        set_space_vector(s.grains.displacement, node, Vector { 0.0, 0.0, -way } - 0.2 * arm);
    }
    const SolidOverlap found = largest_overlap(s);
    CHECK(found.pairs == 1);
    CHECK(found.pair == GrainPair { first, third });
    // its lower face is at 2.5 d - 1.25 d - 0.4 d, 0.15 d below the top of the first, and its
    // corners 0.1 d from the sides
    const double diameter = 2.0 * std::cbrt(0.75 / pi) * d;
    CHECK(found.of_diameter == Approx(found.depth / diameter));
    CHECK(found.depth == Approx(0.1 * d));
    // nobody has looked for pairs: no force resists any of it
    CHECK(found.clearance == found.of_diameter);
}
