// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Walls in 2D and 3D: a block is pressed between them, and a grain runs into one. SI units.
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/plate_loading.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/driven.hpp"
#include "support/solid_states.hpp"

using namespace flexpm;

namespace {

constexpr double size = solid_samples::side;

/// Grains so soft that contacts and walls are stiff beside them.
ElasticMaterial soft_rock()
{
    auto soft = specimens::granite();
    soft.young = 1e8;
    return soft;
}

Assembly squares(int nx, int ny, bool rigid)
{
    auto o = specimens::options(specimens::strong_contact(1e14), soft_rock());
    o.rigid = rigid;
    return specimens::assemble(specimens::grid(nx, ny, size), o);
}

SolidState cubes(int nx, int ny, int nz, bool rigid)
{
    return make_solid(solid_samples::brick(nx, ny, nz), Solid::box(size * nx, size * ny, size * nz),
        { { soft_rock() }, { specimens::strong_contact(1e14) }, {},
            FacePointRule::corners_and_inner, rigid });
}

// what depends on the dimension

int lay_wall(Assembly& a, Vector position, Vector normal, double friction = 0.0)
{
    return add_wall(a, in_plane(position), in_plane(normal), { 0.0, friction, false });
}
int lay_wall(SolidState& s, Vector position, Vector normal, double friction = 0.0)
{
    return add_wall(s, position, normal, friction);
}

Vector up_in(const Assembly&) { return { 0.0, 1.0, 0.0 }; }
Vector up_in(const SolidState&) { return { 0.0, 0.0, 1.0 }; }

double face_of_two(const Assembly&) { return 2.0 * size * specimens::thickness; }
double face_of_two(const SolidState&) { return 4.0 * size * size; }

/// Area of the corners at the bottom of a grain [m^2]: an edge has half of its own at each end, a
/// triangle a third at each corner.
double area_at_bottom(const Assembly&) { return 2.0 * size * specimens::thickness; }
double area_at_bottom(const SolidState& s)
{
    double sum = 0.0;
    for (std::size_t t = 0; t < s.surface.nodes.size(); ++t)
        for (int node : s.surface.nodes[t])
            if (std::fabs(space_vector(s.grains.reference, node).z) < 1e-9 * size)
                sum += norm(area_vector(s, static_cast<int>(t))) / 3.0;
    return sum;
}

double mass_of(const Assembly& a) { return soft_rock().density * size * size * a.thickness; }
double mass_of(const SolidState&) { return soft_rock().density * size * size * size; }

void begin(Assembly& a) { reset_energy_balance(a); }
void begin(SolidState& s) { begin_balance(s); }

void set_grain_velocity(Assembly& a, Vector v)
{
    if (a.grains.is_rigid(0))
        set_motion(a.grains, 0, in_plane(v), 0.0, 1.0);
    else
        driven::set_velocity(a, 0, in_plane(v));
}
void set_grain_velocity(SolidState& s, Vector v)
{
    if (!s.bodies.empty()) return set_motion(s, 0, v, {});
    for_each_node(s,
        [&](int grain, int n) { set_space_vector(s.grains.velocity, s.grains.node(grain, n), v); });
}

/// Momentum of a grain [kg m/s].
template <class State> Vector momentum(const State& s)
{
    Vector sum;
    for (int n = 0; n < s.grains.nodes_of(0); ++n) {
        const int node = s.grains.is_rigid(0) ? s.grains.centre(0) : s.grains.node(0, n);
        const double mass = 1.0 / s.grains.inverse_mass[s.grains.scalar_index(node)];
        sum = sum + mass * s.grains.vector(s.grains.velocity, node);
        if (s.grains.is_rigid(0)) break;
    }
    return sum;
}

/// A block of two grains along each axis bears what its strain asks for.
template <class State> void check_press(State s)
{
    const Vector up = up_in(s);
    const double height = 2.0 * size, way = 1e-6 * height;
    const int lower = lay_wall(s, {}, 3.0 * up), upper = lay_wall(s, height * up, -up);
    scale_masses(s, 0.7);
    begin(s);
    set_velocity(s, upper, (-way / 500.0) * up);
    driven::run_measured(s, 500);
    set_velocity(s, upper, {});
    driven::run_measured(s, 6000);
    const double force = 1e8 * way / height * face_of_two(s);
    CHECK(dot(s.plates[lower].force, up) == Approx(force).epsilon(2e-3));
    CHECK(dot(s.plates[upper].force, up) == Approx(-force).epsilon(2e-3));
    const Energies e = energies(s);
    CHECK(e.boundary_work >= 0.5 * force * way);
    CHECK(balance::miss(e) / e.elastic == Approx(0.0).margin(0.01));  // it starts at once
    CHECK_THROWS_WITH(lay_wall(s, 0.1 * size * up, up), Catch::Contains("wall and grains"));
    CHECK_THROWS_WITH(lay_wall(s, -size * up, {}), Catch::Contains("plate's normal"));
    CHECK_THROWS_WITH(lay_wall(s, -size * up, up, -0.1), Catch::Contains("friction"));
}

/// A grain leaves a smooth wall as fast as it came; only its momentum across the wall changes.
template <class State> void check_rebound(State s, double inclination)
{
    const double gap = 1e-7 * size;
    const Vector up = up_in(s), aside { 1.0, 0.0, 0.0 };
    const Vector normal = std::cos(inclination) * up + std::sin(inclination) * aside;
    const int wall = lay_wall(s, -gap * normal, normal);
    const double dt = 0.05 * set_real_masses(s, 0.0), speed = gap / (100.0 * dt);
    set_grain_velocity(s, -speed * normal);
    begin(s);
    const Vector before = momentum(s);
    const double kinetic = energies(s).kinetic;
    double largest = 0.0, most = 0.0;
    int touching = 0;
    // a soft grain leaves for good once waves have crossed it
    const double crossing =
        s.grains.is_rigid(0) ? 0.0 : size * std::sqrt(soft_rock().density / 1e8);
    const int least = 200 + static_cast<int>(4.0 * crossing / dt);
    for (int k = 0; k < least || norm(s.plates[wall].force) > 0.0; ++k) {
        REQUIRE(k < 10 * least);
        driven::run_measured(s, 1, 0.0, dt);
        const Vector force = s.plates[wall].force;
        touching += dot(force, normal) > 0.0;
        largest = std::max(largest, norm(force - dot(force, normal) * normal));
        most = std::max(most, norm(force));
    }
    REQUIRE(touching > 10);
    CHECK(largest < 1e-12 * most);
    const Energies e = energies(s);
    CHECK(e.kinetic + e.elastic == Approx(kinetic).epsilon(5e-3));
    CHECK(e.boundary_work == 0.0);
    const Vector change = momentum(s) - before;
    CHECK(norm(change - dot(change, normal) * normal) < 1e-9 * norm(before));
    CHECK(dot(change, normal) > 1.2 * norm(before));
    if (inclination != 0.0 || !s.grains.is_rigid(0)) return;
    CHECK(dot(change, normal) == Approx(2.0 * norm(before)).epsilon(5e-3));
    // half a period of its mass on the springs of its corners, which in 3D are not symmetrical
    const double stiffness = 1e14 * area_at_bottom(s);
    CAPTURE(touching);
    CHECK(touching * dt
        == Approx(pi * std::sqrt(mass_of(s) / stiffness))
               .epsilon(s.grains.layout.dimension == 2 ? 0.02 : 0.1));
}

/// A wall slides along a block that another one holds: its points have its slip and the energy of
/// friction.
template <class State> void check_slide(State s)
{
    constexpr double friction = 0.3, speed = 5e-11;
    const Vector up = up_in(s), aside { 1.0, 0.0, 0.0 };
    const double height = 2.0 * size;
    const int lower = lay_wall(s, {}, up, friction), upper = lay_wall(s, height * up, -up, 1e3);
    scale_masses(s, 0.7);
    begin(s);
    set_velocity(s, upper, (-1e-6 * height / 500.0) * up);
    driven::run_measured(s, 500);
    set_velocity(s, upper, {});
    set_velocity(s, lower, speed * aside);
    driven::run_measured(s, 4000);
    const Plate before = s.plates[lower];
    const int steps = 2000;
    driven::run_measured(s, steps);
    const Plate& now = s.plates[lower];
    const double pressed = dot(now.force, up);
    CHECK(pressed > 0.0);
    CHECK(now.force.x == Approx(friction * pressed).epsilon(1e-9));
    double energy = 0.0;
    for (int i = 0; i < plate_points(now); ++i) {
        energy += now.points[i].friction_energy;
        if (!(point_push(now, i) > 0.0)) continue;
        const Vector slip = now.points[i].slip - before.points[i].slip;
        CHECK(slip.x == Approx(-steps * speed).epsilon(0.01));
        CHECK(std::fabs(dot(slip, up)) < 1e-12 * steps * speed);
        CHECK(point_shear(now, i).x == Approx(friction * point_push(now, i)).epsilon(1e-6));
    }
    CHECK(energy == Approx(now.friction_energy).epsilon(1e-9));
    CHECK(now.friction_energy - before.friction_energy
        == Approx(friction * pressed * steps * speed).epsilon(0.01));
    CHECK(energies(s).friction == Approx(now.friction_energy + s.plates[upper].friction_energy));
}

}  // namespace

TEST_CASE("A wall that slides has the same slip and energy in 2D and 3D", "[plate][solids]")
{
    const bool rigid = GENERATE(true, false);
    CAPTURE(rigid);
    check_slide(squares(2, 2, rigid));
    check_slide(cubes(2, 2, 2, rigid));
}

TEST_CASE("A block that is pressed between walls bears E eps A", "[plate][solids]")
{
    check_press(squares(2, 2, false));
    check_press(cubes(2, 2, 2, false));
}

TEST_CASE("A grain rebounds from a wall and keeps its energy", "[plate][solids]")
{
    const bool rigid = GENERATE(true, false);
    const double inclination = GENERATE(0.0, 0.4);
    CAPTURE(rigid, inclination);
    check_rebound(squares(1, 1, rigid), inclination);
    check_rebound(cubes(1, 1, 1, rigid), inclination);
}
