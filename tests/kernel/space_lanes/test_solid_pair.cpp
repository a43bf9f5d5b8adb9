// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Two cubic grains that have slid under pressure and turn as one body, in lanes: the
/// counterpart of what test_solid_faces.cpp asks of the plain step.
#include "support/catch.hpp"

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

/// Sum of the forces on the nodes of a grain, and their moment about the origin.
struct Load {
    Vector force, moment;
};

Load load_on(const SolidState& s, int grain)
{
    Load load;
    for (int n = 0; n < s.grains.nodes_of(grain); ++n) {
        const int node = s.grains.node(grain, n);
        const Vector f = space_vector(s.grains.force, node);
        const Vector place =
            space_vector(s.grains.reference, node) + space_vector(s.grains.displacement, node);
        load.force = load.force + f;
        load.moment = load.moment + cross(place, f);
    }
    return load;
}

/// Two cubes, one upon the other.
SolidState pair_of(FacePointRule rule = FacePointRule::corners_and_inner)
{
    const double d = solid_samples::side;
    return make_solid(solid_samples::brick(1, 1, 2), Solid::box(d, d, 2.0 * d), granite(rule));
}

/// Put the upper one a way off, then turn both about the origin.
void place(SolidState& s, Vector way, Vector angle)
{
    const Quaternion turn = rotation_by(angle);
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        const Vector moved = grain == 1 ? way : Vector {};
        const Vector there = space_vector(s.grains.reference, node) + moved;
        set_space_vector(s.grains.displacement, node, moved + turned_by(turn, there));
    });
    find_forces(s);
}

}  // namespace

TEST_CASE("A pair that has slid keeps force and slip as it turns, in lanes", "[solids]")
{
    const double d = solid_samples::side, slid = 1e-4, pressure = 40e6;
    const auto contact = specimens::granite_contact();
    const Vector pressed { 0.0, 0.0, -pressure / contact.normal_stiffness };
    for (const auto rule : { FacePointRule::corners_and_inner, FacePointRule::three }) {
        for (int axis = 0; axis < 3; ++axis) {
            SolidState s = pair_of(rule);
            for (int k = 1; k <= 200; ++k) {
                const double way = slid * k / 200;
                place(s, pressed + Vector { 0.6 * way, 0.8 * way, 0.0 }, {});
            }
            const Load before = load_on(s, 1);
            CHECK(before.force.z == Approx(pressure * d * d));
            CHECK(std::hypot(before.force.x, before.force.y)
                == Approx(contact.friction * pressure * d * d).epsilon(1e-6));
            const std::vector<FacePlace> slips = places_of(s, 0);
            CHECK(norm(slips[0].slip) == Approx(slid));
            const Vector angle { axis == 0 ? 0.1 : 0.0, axis == 1 ? 0.1 : 0.0,
                axis == 2 ? 0.1 : 0.0 };
            for (int k = 1; k <= 50; ++k)
                place(s, pressed + Vector { 0.6 * slid, 0.8 * slid, 0.0 }, (k / 50.0) * angle);
            const Load after = load_on(s, 1), below = load_on(s, 0);
            const Vector expected = turned(rotation_by(angle), before.force);
            CHECK(norm(after.force - expected) < 1e-6 * norm(expected));
            for (std::size_t p = 0; p < slips.size(); ++p) {
                const Point now = places_of(s, 0)[p].slip;
                CHECK(norm(now - slips[p].slip) < 1e-6 * slid);
            }
            CHECK(norm(after.force + below.force) < 1e-9 * norm(expected));
            CHECK(norm(after.moment + below.moment) < 1e-9 * norm(expected) * d);
        }
    }
}

TEST_CASE("A face that has parted and slid by half of it presses and rubs again", "[solids]")
{
    const double d = solid_samples::side, closing = 2e-7;
    const auto contact = specimens::granite_contact();
    const double force = contact.normal_stiffness * closing * d * d;
    SolidState s = pair_of();
    const Vector open { 0.0, 0.0, 1e-5 };
    for (int k = 1; k <= 100; ++k)
        place(s, (k / 100.0) * open, {});
    CHECK(count_cracks(s).tensile == s.contacts.points_of(0));
    for (const double slid : { 0.1 * d, 0.25 * d, 0.5 * d }) {
        for (int k = 1; k <= 10; ++k)
            place(s, open + Vector { k / 10.0 * slid, 0.0, 0.0 }, {});
        CHECK(norm(load_on(s, 1).force) < 1e-9 * force);
        place(s, { slid, 0.0, -closing }, {});
        const Vector pressed = load_on(s, 1).force;
        CHECK(pressed.z == Approx(force).epsilon(1e-9));
        CHECK(std::hypot(pressed.x, pressed.y) < 1e-9 * force);
        // back by more than what sticks
        for (int k = 1; k <= 20; ++k)
            place(s, { slid - k * 1e-6, 0.0, -closing }, {});
        const Vector rubbed = load_on(s, 1).force;
        CHECK(rubbed.x == Approx(contact.friction * force).epsilon(1e-9));
        CHECK(rubbed.z == Approx(force).epsilon(1e-9));
        place(s, open, {});
    }
}
