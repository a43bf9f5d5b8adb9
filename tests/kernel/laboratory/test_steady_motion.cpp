// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion that damping leaves alone while a specimen comes down from its peak, deviation
/// D55.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/steady_motion.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/specimens.hpp"

#include <cmath>

using namespace flexpm;

namespace {

constexpr double speed = 1e-9;  // [m/step]

/// Unbreakable grains that nothing holds, shaken and moving along x.
Assembly shaken_grains(bool rigid)
{
    AssemblyOptions o = specimens::options(specimens::strong_contact());
    o.rigid = rigid;
    Assembly a = specimens::assemble(specimens::random_grains(12e-3, 15e-3, 3e-3, 5), o);
    scale_masses(a, 0.7);
    Random random(3);
    const auto around = [&] { return 4.0 * speed * (random.next() - 0.5); };
    for (int g = 0; g < a.grains.count; ++g) {
        if (rigid) {
            set_motion(a.grains, g, { speed + around(), around() }, 0.0, 1.0);
            continue;
        }
        for (int n = 0; n < a.grains.nodes_of(g); ++n)
            set_vector(a.grains.velocity, a.grains.node(g, n), { speed + around(), around() });
    }
    return a;
}

double momentum(const Assembly& a)
{
    double sum = 0.0;
    for (int g = 0; g < a.grains.count; ++g) {
        const int first = a.grains.is_rigid(g) ? a.grains.vertices_of(g) : 0;
        for (int n = first; n < a.grains.nodes_of(g); ++n) {
            const int node = a.grains.node(g, n);
            const double inverse = a.grains.inverse_mass[scalar_index(node)];
            if (inverse > 0.0) sum += a.grains.velocity[node] / inverse;
        }
    }
    return sum;
}

/// Momentum after 400 steps over that before, with a look each 20 steps or without any.
double left_of_momentum(bool rigid, bool followed)
{
    Assembly a = shaken_grains(rigid);
    const double before = momentum(a);
    StepOptions o;
    o.damping = 0.7;
    for (int i = 0; i < 400; ++i) {
        if (followed && i % 20 == 0) follow_steady_motion(a, 1.0, 1.0);
        step(a, o);
    }
    return momentum(a) / before;
}

}  // namespace

TEST_CASE("What is shaken moves on steadily once its motion is followed", "[laboratory]")
{
    for (bool rigid : { false, true }) {
        CAPTURE(rigid);
        CHECK(left_of_momentum(rigid, true) > 1.5 * left_of_momentum(rigid, false));
    }
}

TEST_CASE("Damping leaves alone the mean motion since the last look", "[laboratory]")
{
    for (bool rigid : { false, true }) {
        CAPTURE(rigid);
        Assembly a = shaken_grains(rigid);
        const Array<double> of_loading = a.loading.grains.velocity;
        const Array<double> before = a.grains.displacement;
        const double angle = rigid ? rotation_of(a.grains, 0) : 0.0;
        follow_steady_motion(a, 1.0, 1.0);
        CHECK(a.undamped().velocity == of_loading);  // nothing is known yet
        follow_steady_motion(a, 1.0, 1.0);
        CHECK(a.undamped().velocity == of_loading);  // no step has been done
        StepOptions o;
        o.damping = 0.7;
        for (int i = 0; i < 10; ++i)
            step(a, o);
        follow_steady_motion(a, 1.0, 1.0);
        const int node = rigid ? a.grains.centre(0) : a.grains.node(0, 1);
        CHECK(a.undamped().velocity[node] == (a.grains.displacement[node] - before[node]) / 10.0);
        CHECK(a.undamped().velocity[node] != 0.0);
        if (rigid) {
            CHECK(a.undamped().spin[a.grains.slot[0]] == (rotation_of(a.grains, 0) - angle) / 10.0);
        }
        CHECK(a.loading.grains.velocity == of_loading);
        check_state(a);
        end_steady_motion(a);
        CHECK(a.undamped().velocity == of_loading);
        CHECK(!a.steady.is_followed());
    }
}

TEST_CASE("Damping acts on what is faster than a descent may be, and on all that is loose, D57")
{
    for (bool rigid : { false, true }) {
        CAPTURE(rigid);
        Assembly a = shaken_grains(rigid);
        a.grains.loose[1] = 1;
        const double fastest = 0.5 * speed;
        follow_steady_motion(a, 1.0, fastest);
        step(a, StepOptions {});
        const int node = rigid ? a.grains.centre(0) : a.grains.node(0, 1);
        const Point way = vector_at(a.grains.displacement, node);
        REQUIRE(norm(way) > fastest);
        follow_steady_motion(a, 1.0, fastest);
        const Point left = vector_at(a.undamped().velocity, node);
        CHECK(norm(left) == Approx(fastest).epsilon(1e-12));
        CHECK(left.x * way.y == Approx(left.y * way.x).epsilon(1e-12));
        CHECK(norm(vector_at(a.undamped().velocity, a.grains.centre(1))) == 0.0);
        CHECK_THROWS_AS(follow_steady_motion(a, 1.0, 0.0), std::invalid_argument);
    }
}

TEST_CASE("A followed motion is no part of the loading's", "[laboratory]")
{
    for (bool rigid : { false, true }) {
        CAPTURE(rigid);
        Assembly a = shaken_grains(rigid);
        const int node = a.grains.centre(1), slot = a.grains.slot[1];
        a.loading.grains.velocity[node] = 3.0 * speed;
        a.loading.grains.spin[slot] = rigid ? speed : 0.0;
        follow_steady_motion(a, 1.0, 1.0);
        step(a, StepOptions {});
        follow_steady_motion(a, 1.0, 1.0);
        CHECK(loading_field(a)[node] == 3.0 * speed);
        const double velocity = a.grains.velocity[node];
        const double followed = a.undamped().velocity[node];
        change_loading(a, 2.0);
        CHECK(a.grains.velocity[node] == Approx(velocity + 3.0 * speed).epsilon(1e-12));
        CHECK(a.undamped().velocity[node] == followed);
        CHECK(a.loading.grains.velocity[node] == 6.0 * speed);
        CHECK(a.loading.grains.spin[slot] == (rigid ? 2.0 * speed : 0.0));
    }
}

TEST_CASE("A followed motion that does not fit its grains is refused", "[laboratory]")
{
    Assembly a = shaken_grains(false);
    follow_steady_motion(a, 1.0, 1.0);
    check_state(a);
    Assembly cut = a;
    cut.steady.displacement.pop_back();
    CHECK_THROWS_WITH(check_state(cut), Catch::Contains("values of nodes followed"));
    cut = a;
    cut.steady.angle.push_back(0.0);
    CHECK_THROWS_WITH(check_state(cut), Catch::Contains("rotations followed"));
    for (std::int64_t step : { std::int64_t { -1 }, a.step + 1 }) {
        cut = a;
        cut.steady.step = step;
        CHECK_THROWS_WITH(check_state(cut), Catch::Contains("step of the last look"));
    }
}
