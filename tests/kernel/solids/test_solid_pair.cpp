// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Two cubic grains that have slid under pressure and turn as one body, in lanes: the
/// counterpart of what test_solid_faces.cpp asks of the plain step.
#include "support/catch.hpp"

#include "solids/solid_states.hpp"

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

}  // namespace

TEST_CASE("A pair that has slid keeps force and slip as it turns, in lanes", "[solids]")
{
    const double d = solid_samples::side, slid = 1e-4, pressure = 40e6;
    const auto contact = specimens::granite_contact();
    const Solid solid = Solid::box(d, d, 2.0 * d);
    const Vector pressed { 0.0, 0.0, -pressure / contact.normal_stiffness };
    for (const auto rule : { FacePointRule::corners_and_inner, FacePointRule::three }) {
        for (int axis = 0; axis < 3; ++axis) {
            SolidState s = make_solid(solid_samples::brick(1, 1, 2), solid, granite(rule));
            const auto place = [&](Vector way, Vector angle) {
                const Quaternion turn = rotation_by(angle);
                for_each_node(s, [&](int grain, int number) {
                    const int node = s.grains.node(grain, number);
                    const Vector moved = grain == 1 ? way : Vector {};
                    const Vector there = space_vector(s.grains.reference, node) + moved;
                    set_space_vector(s.grains.displacement, node, moved + turned_by(turn, there));
                });
                find_forces(s);
            };
            for (int k = 1; k <= 200; ++k) {
                const double way = slid * k / 200;
                place(pressed + Vector { 0.6 * way, 0.8 * way, 0.0 }, {});
            }
            const Load before = load_on(s, 1);
            CHECK(before.force.z == Approx(pressure * d * d));
            CHECK(std::hypot(before.force.x, before.force.y)
                == Approx(contact.friction * pressure * d * d).epsilon(1e-6));
            std::vector<FacePlace> slips;
            for (int p = 0; p < s.contacts.points_of(0); ++p)
                slips.push_back(s.contacts.place_of(0, p));
            CHECK(norm(slips[0].slip) == Approx(slid));
            const Vector angle { axis == 0 ? 0.1 : 0.0, axis == 1 ? 0.1 : 0.0,
                axis == 2 ? 0.1 : 0.0 };
            for (int k = 1; k <= 50; ++k)
                place(pressed + Vector { 0.6 * slid, 0.8 * slid, 0.0 }, (k / 50.0) * angle);
            const Load after = load_on(s, 1), below = load_on(s, 0);
            const Vector expected = turned(rotation_by(angle), before.force);
            CHECK(norm(after.force - expected) < 1e-6 * norm(expected));
            for (std::size_t p = 0; p < slips.size(); ++p) {
                const Point now = s.contacts.place_of(0, static_cast<int>(p)).slip;
                CHECK(norm(now - slips[p].slip) < 1e-6 * slid);
            }
            CHECK(norm(after.force + below.force) < 1e-9 * norm(expected));
            CHECK(norm(after.moment + below.moment) < 1e-9 * norm(expected) * d);
        }
    }
}
