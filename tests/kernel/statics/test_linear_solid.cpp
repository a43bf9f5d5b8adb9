// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces of points that lie at corners are those of their shares, and those that threads
/// share are those of one, to the bit.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/statics/linear_solid.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

TEST_CASE("A spring knows the corner that it lies at", "[solids]")
{
    const auto at = spring_at(2.0, { 0.0, 0.0, 1.0, 0.0 });
    CHECK(at.corner == 2);
    CHECK(at.shares.empty());
    CHECK((at.share(2) == 1.0 && at.share(0) == 0.0));
    for (const auto& shares : { std::vector<double> { 1e-17, 0.0, 1.0 }, { 1.0, 1.0, 0.0 },
             { 0.5, 0.5, 0.0 }, { 1.0, 0.25, -0.25 } }) {
        CHECK(spring_at(2.0, shares).corner == -1);
        CHECK(spring_at(2.0, shares).shares == shares);
    }
}

TEST_CASE("Forces of points at corners are those of their shares to the bit", "[solids]")
{
    const Packing p = packing(40, 6);
    const SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner));
    const LinearSolid known = linear_solid(s);
    LinearSolid spelled = known;
    int at_corners = 0, others = 0;
    for (LinearSolid::Face& face : spelled.faces) {
        for (LinearSolid::Spring& spring : face.springs) {
            ++(spring.corner < 0 ? others : at_corners);
            if (spring.corner < 0) continue;
            spring.shares.assign(face.nodes[0].size(), 0.0);
            spring.shares[spring.corner] = 1.0;
            spring.corner = -1;
        }
    }
    CHECK(at_corners > 3 * others);
    REQUIRE(others > 0);
    Random random(4);
    std::vector<double> u(3 * known.places.size());
    for (double& value : u)
        value = random.next() - 0.5;
    std::vector<double> forces(u.size(), 0.0), wanted(u.size(), 0.0);
    known.add(u.data(), forces.data());
    spelled.add(u.data(), wanted.data());
    CHECK(forces == wanted);
    CHECK(known.diagonal_blocks().values() == spelled.diagonal_blocks().values());
}

TEST_CASE("Linear forces and fields have the same bits on any threads", "[solids]")
{
    const Packing p = packing(40, 6);
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner));
    scale_masses(s, 0.7);
    hold_ends(s, { true, true });
    const SolidField wanted_field = elastic_field(s);
    LinearSolid alone = linear_solid(s);
    Random random(4);
    std::vector<double> u(3 * alone.places.size());
    for (double& value : u)
        value = random.next() - 0.5;
    std::vector<double> wanted(u.size(), 0.0);
    alone.share_among(1);
    alone.add(u.data(), wanted.data());
    for (int threads : { 2, 3, 64 }) {
        std::vector<double> forces(u.size(), 0.0);
        linear_solid(s, threads).add(u.data(), forces.data());
        CHECK(forces == wanted);
        const SolidField field = elastic_field(s, threads);
        bool same = field.ways.size() == wanted_field.ways.size();
        for (std::size_t n = 0; same && n < field.ways.size(); ++n)
            same = field.ways[n].x == wanted_field.ways[n].x
                && field.ways[n].y == wanted_field.ways[n].y
                && field.ways[n].z == wanted_field.ways[n].z;
        CHECK(same);
    }
}

TEST_CASE("Contacts that are much stiffer than grains cost few iterations", "[solids]")
{
    const Packing p = packing(60, 6);
    const auto iterations = [&](double stiffer) {
        SolidInput input = granite(FacePointRule::corners_and_inner);
        input.contacts.front().normal_stiffness *= stiffer;
        const LinearSolid solid = linear_solid(make_solid(p.cells, p.solid, input));
        std::vector<std::uint8_t> held;
        std::vector<double> load;
        for (const Vector& place : solid.places) {
            const bool bottom = place.z < 1e-9;
            held.insert(held.end(), 3, bottom ? 1 : 0);
            load.insert(load.end(), { 0.0, 0.0, bottom ? 0.0 : 1.0 });
        }
        return solve_free(solid, held, load, std::vector<double>(load.size(), 0.0)).iterations;
    };
    // 1920 and 297 with each node in a block of its own, 163 and 166 so
    CHECK(iterations(100.0) < 1.5 * iterations(1.0));
}
