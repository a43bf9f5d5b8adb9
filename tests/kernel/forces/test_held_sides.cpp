// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sides that are kept from moving along an axis: what a push on an edge leaves alone. SI
/// units.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/core/vector.hpp>
#include <flexpm/kernel/forces/held_sides.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/specimens.hpp"

using namespace flexpm;

namespace {

constexpr double size = 3e-3;

Assembly squares(bool rigid)
{
    AssemblyOptions o = specimens::options(specimens::strong_contact());
    o.rigid = rigid;
    Assembly a = specimens::assemble(specimens::grid(2, 2, size), o);
    scale_masses(a, 0.0);
    return a;
}

/// Velocity of the middle of the edge of a square on a side [m/s].
Point edge_velocity(const Assembly& a, int side, int grain)
{
    for (int e = 0; e < a.facets.count; ++e) {
        if (a.facets.grain[e] != grain || !is_on_side(a, e, side)) continue;
        const auto [from, to] = a.facets.nodes(e);
        return 0.5 * (vector_at(a.grains.velocity, from) + vector_at(a.grains.velocity, to));
    }
    throw std::logic_error("the grain has no edge there");
}

/// Grain of the first edge on a side.
int grain_on(const Assembly& a, int side)
{
    for (int e = 0; e < a.facets.count; ++e)
        if (is_on_side(a, e, side)) return a.facets.grain[e];
    throw std::logic_error("no grain lies there");
}

struct Held {
    int side, axis;
};

}  // namespace

TEST_CASE("A push on an edge stops it and changes no moment of momentum about it", "[forces]")
{
    const Held held = GENERATE(Held { left_side, 1 }, Held { right_side, 1 },
        Held { bottom_side, 0 }, Held { top_side, 0 });
    const int side = held.side, axis = held.axis;
    Assembly a = squares(true);
    hold_side(a, side, axis);
    REQUIRE(a.held_edges.size() == 2);
    const int g = grain_on(a, side), c = a.grains.centre(g), slot = a.grains.slot[g];
    const double mass = 1.0 / a.grains.inverse_mass[scalar_index(c)];
    const double inertia = 1.0 / a.grains.inverse_inertia[slot];
    const double speed = 1e-6, spin = 2e-4;
    set_motion(a.grains, g, { speed, 2.0 * speed }, spin, 1.0);
    const double lever =
        a.held_edges.front().grain == g ? a.held_edges.front().lever : a.held_edges.back().lever;
    CHECK(std::fabs(lever) == Approx(0.5 * size));
    const auto along = [&] { return a.grains.velocity[component(c, axis)]; };
    const auto about_edge = [&] { return inertia * a.grains.spin[slot] - mass * lever * along(); };
    const auto kinetic = [&] {
        return 0.5 * mass * along() * along()
            + 0.5 * inertia * a.grains.spin[slot] * a.grains.spin[slot];
    };
    const double moment = about_edge(), before = kinetic(),
                 across = a.grains.velocity[component(c, 1 - axis)];
    const double of_edge = along() + spin * lever;
    hold_edges(a, 1.0);
    CHECK(about_edge() == Approx(moment).epsilon(1e-12));
    CHECK(a.grains.velocity[component(c, 1 - axis)] == across);
    // the edge moves with what a spin gives to second order in its angle
    const Point left = edge_velocity(a, side, g);
    CHECK(std::fabs(axis == 0 ? left.x : left.y) < 1e-3 * std::fabs(of_edge));
    // a plastic impact loses the energy of the edge's speed with the mass that it feels
    const double felt = 1.0 / (1.0 / mass + lever * lever / inertia);
    CHECK(before - kinetic() == Approx(0.5 * felt * of_edge * of_edge).epsilon(1e-9));
    hold_edges(a, 1.0);
    CHECK(about_edge() == Approx(moment).epsilon(1e-12));
}

TEST_CASE("What is held of a side stands still over steps, and the rest moves on", "[forces]")
{
    const bool rigid = GENERATE(false, true);
    const int axis = GENERATE(0, 1);
    Assembly a = squares(rigid);
    hold_side(a, left_side, axis);
    CHECK(a.held_edges.size() == (rigid && axis == 1 ? 2 : 0));
    check_state(a);
    for (int g = 0; g < a.grains.count; ++g) {
        const Point v = { axis == 0 ? 0.0 : 1e-9, axis == 0 ? 1e-9 : 0.0 };
        if (rigid) {
            set_motion(a.grains, g, v, 0.0, 1.0);
        } else {
            for (int n = 0; n < a.grains.nodes_of(g); ++n)
                set_vector(a.grains.velocity, a.grains.node(g, n), v);
        }
    }
    StepOptions o;
    o.damping = 0.0;
    for (int i = 0; i < 50; ++i)
        step(a, o);
    const Array<double>& moved = a.grains.displacement;
    const double other = side_displacement(a, left_side, 1 - axis, moved);
    CHECK(other == Approx(50e-9).epsilon(1e-3));
    CHECK(std::fabs(side_displacement(a, left_side, axis, moved)) < 1e-6 * other);
}

TEST_CASE("A side that is not there cannot be held, and held edges name grains", "[forces]")
{
    Assembly a = squares(true);
    CHECK_THROWS_WITH(hold_side(a, 99, 0), Catch::Contains("side = 99"));
    a.held_edges.push_back({ a.grains.count, 0, 0.0 });
    CHECK_THROWS_WITH(check_state(a), Catch::Contains("grain of a held edge"));
    a.held_edges = { { 0, 2, 0.0 } };
    CHECK_THROWS_WITH(check_state(a), Catch::Contains("axis of a held edge"));
}
