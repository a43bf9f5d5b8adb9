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

namespace {

/// The same forces with other levels of the preconditioner: none.
struct Plain : LinearForces {
    const LinearForces& of;

    explicit Plain(const LinearForces& forces) : of(forces) { }
    void add(const double* u, double* forces) const override { of.add(u, forces); }
    DiagonalBlocks diagonal_blocks() const override { return of.diagonal_blocks(); }
    RigidPart rigid_part(int triple) const override { return of.rigid_part(triple); }
};

/// Mean displacement and mean rotation about z of all triples with a place.
void check_rest(const LinearForces& forces, const std::vector<double>& u)
{
    double along_x = 0.0, along_y = 0.0, about = 0.0, size = 0.0;
    for (std::size_t i = 0; i < u.size(); i += 3) {
        const RigidPart part = forces.rigid_part(static_cast<int>(i / 3));
        along_x += part.way * u[i];
        along_y += part.way * u[i + 1];
        about += part.arm.x * u[i + 1] - part.arm.y * u[i] + part.turn * u[i + 2];
        size += std::abs(u[i]) + std::abs(u[i + 1]);
    }
    CHECK(std::abs(along_x) < 1e-9 * size);
    CHECK(std::abs(along_y) < 1e-9 * size);
    CHECK(std::abs(about) < 1e-11 * size);  // arms of 1 cm
}

}  // namespace

TEST_CASE("Smooth platens leave sideways motions, which stay 0", "[solids]")
{
    const Packing p = packing(60, 6);
    for (const bool rigid : { false, true }) {
        SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners, rigid));
        scale_masses(s, 0.7);
        hold_ends(s, { false, true });
        const LinearSolid solid = linear_solid(s);
        const RigidSolid grains = rigid ? rigid_solid(s, solid) : RigidSolid(solid);
        const LinearForces& forces = rigid ? static_cast<const LinearForces&>(grains) : solid;
        std::vector<double> pushed(3 * solid.places.size(), 0.0);
        for (const LinearSolid::Press& press : solid.presses)
            add_triple(pushed.data(), press.nodes[0], press.stiffness * 1e-6 * press.normal);
        std::vector<double> load = pushed;
        if (rigid) {
            load.assign(6 * grains.centres.size(), 0.0);
            grains.gather(pushed.data(), load.data());
        }
        const std::vector<std::uint8_t> held(load.size(), 0);
        const std::vector<double> guess(load.size(), 0.0);
        const FreeSolution found = solve_free(forces, held, load, guess);
        const FreeSolution other = solve_free(Plain(forces), held, load, guess);
        CHECK(found.iterations < other.iterations);
        check_rest(forces, found.u);
        double largest = 0.0, apart = 0.0;
        for (std::size_t i = 0; i < found.u.size(); ++i) {
            largest = std::max(largest, std::abs(found.u[i]));
            apart = std::max(apart, std::abs(found.u[i] - other.u[i]));
        }
        CHECK(apart < 1e-8 * largest);
    }
}
