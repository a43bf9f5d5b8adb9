// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Gravity on real masses in 2D and 3D, and walls that grains fall on. SI units; gravity
/// points down, against the last axis.
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/grain_stress.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/driven.hpp"
#include "support/solid_states.hpp"

using flexpm::Assembly;
using flexpm::component;
using flexpm::lanes;
using flexpm::Point;
using flexpm::SolidSide;
using flexpm::SolidState;

namespace {

constexpr double size = 3e-3, g = 9.81, density = 2650.0;
constexpr double mass = density * size * size * specimens::thickness;  // of a square

/// Soft grains, so that few steps fill a long time.
flexpm::ElasticMaterial soft_rock()
{
    auto soft = specimens::granite();
    soft.young = 1e8;
    return soft;
}

Assembly squares(int nx, int ny, bool rigid)
{
    auto o = specimens::options(specimens::strong_contact(1e11), soft_rock());
    o.rigid = rigid;
    return specimens::assemble(specimens::grid(nx, ny, size), o);
}

/// Cubes of the same size.
SolidState cubes(int nx, int ny, int nz, bool rigid)
{
    static_assert(solid_samples::side == size);
    return flexpm::make_solid(solid_samples::brick(nx, ny, nz),
        flexpm::Solid::box(size * nx, size * ny, size * nz),
        { { soft_rock() }, { specimens::strong_contact(1e11) }, {},
            flexpm::FacePointRule::corners_and_inner, rigid });
}

// what depends on the dimension

double grain_mass(const Assembly&) { return mass; }
double grain_mass(const SolidState&) { return density * size * size * size; }

double face_area(const Assembly&) { return size * specimens::thickness; }
double face_area(const SolidState&) { return size * size; }

void begin(Assembly& a) { flexpm::reset_energy_balance(a); }
void begin(SolidState& s) { flexpm::begin_balance(s); }

double stress_along(const Assembly& a, int grain)
{
    return flexpm::grain_stress(a, grain).stress.yy;
}
double stress_along(const SolidState& s, int grain)
{
    return flexpm::grain_stress(s, grain).stress.zz;
}

std::vector<int> low_nodes(const Assembly& a) { return flexpm::side_nodes(a, 0); }
std::vector<int> low_nodes(const SolidState& s) { return flexpm::side_nodes(s, SolidSide::bottom); }

double holding(const Assembly& a, const std::vector<int>& nodes)
{
    return flexpm::reaction(a, nodes, 1);
}
double holding(const SolidState& s, const std::vector<int>& nodes)
{
    return flexpm::holding_force(s, nodes, 2);
}

/// Index of a node's component along gravity.
template <class State> int down(const State& s, int node)
{
    return s.grains.component(node, s.grains.layout.dimension - 1);
}

template <class State> void pull(State& s)
{
    const bool plane = s.grains.layout.dimension == 2;
    flexpm::set_gravity(s, { 0.0, plane ? -g : 0.0, plane ? 0.0 : -g });
}

template <class State> void check_fall(State s, double damping)
{
    const double dt = 1e-7, falls = g * (1.0 - damping);
    flexpm::set_real_masses(s, damping);
    pull(s);
    begin(s);
    // without damping: the sign of a velocity of 0 makes the first step undamped
    const int n = 200;
    driven::run_measured(s, n, damping, dt);
    const double speed = falls * (n - 1) * dt + g * dt;
    const double way = falls * dt * dt * (n - 1) * (n - 2) / 2.0 + g * dt * dt * (n - 1);
    for (int grain = 0; grain < s.grains.count; ++grain) {
        const int centre = down(s, s.grains.centre(grain));
        CHECK(s.grains.velocity[centre] == Approx(-speed).epsilon(1e-9));
        for (int k = 0; k < s.grains.nodes_of(grain); ++k) {
            const int i = down(s, s.grains.node(grain, k));
            CHECK(s.grains.displacement[i] == Approx(-way).epsilon(1e-9));
        }
    }
    const auto e = flexpm::energies(s);
    CHECK(e.potential == Approx(-s.grains.count * grain_mass(s) * g * way));
    CHECK(e.kinetic > 0.0);
    CHECK(std::fabs(balance::total(e)) < 1e-9 * e.kinetic);
}

/// A column of grains, the lowest first, at rest on what holds the lowest nodes or centre.
template <class State> void check_column(State s, bool rigid)
{
    const int rows = s.grains.count;
    const double dt = flexpm::set_real_masses(s, 0.7), own = grain_mass(s) * g;
    const std::vector<int> base = rigid ? std::vector<int> { s.grains.centre(0) } : low_nodes(s);
    for (int n : base)
        s.grains.prescribed[down(s, n)] = 1;
    pull(s);
    begin(s);
    driven::run_measured(s, 8000, 0.7, dt);
    double settled = 0.0;
    for (int above = rows - 1; above > 0; --above)
        settled += above * own / (1e11 * face_area(s));
    const double top = s.grains.displacement[down(s, s.grains.centre(rows - 1))];
    const flexpm::Vector on = flexpm::resultant_on(s.grains, 0).force;
    const double borne = rigid ? -(on.y + on.z) : holding(s, base);  // one of them is across
    CHECK(borne == Approx(rows * own).epsilon(1e-6));
    if (rigid) CHECK(top == Approx(-settled).epsilon(1e-6));
    // density, g and height above the middle; the lowest rigid grain bears from its centre on
    for (int k = rigid ? 1 : 0; k < rows; ++k) {
        const double height = (rows - k - 0.5) * size;
        CHECK(stress_along(s, k) == Approx(-density * g * height).epsilon(1e-3));
    }
    const auto e = flexpm::energies(s);
    CHECK(e.potential < 0.0);
    CHECK(std::fabs(balance::total(e)) < 1e-9 * std::fabs(e.potential));
}

}  // namespace

TEST_CASE("grains fall freely by g (1 - alpha), and their energy is kept", "[gravity]")
{
    const bool rigid = GENERATE(true, false);
    const double damping = GENERATE(0.0, 0.3);
    CAPTURE(rigid, damping);
    check_fall(squares(2, 2, rigid), damping);
    check_fall(cubes(2, 2, 2, rigid), damping);
    check_fall(cubes(1, 1, 1, rigid), damping);
}

TEST_CASE("a column settles by the weights above each contact, and its base bears all", "[gravity]")
{
    const bool rigid = GENERATE(true, false);
    CAPTURE(rigid);
    check_column(squares(1, 4, rigid), rigid);
    check_column(cubes(1, 1, 4, rigid), rigid);
}

TEST_CASE("deformable grains hand their weight to what holds them", "[gravity]")
{
    Assembly a = squares(3, 2, false);
    const double dt = flexpm::set_real_masses(a, 0.7);
    const auto bottom = flexpm::side_nodes(a, 0);
    flexpm::prescribe(a, bottom, 1, 0.0);
    flexpm::set_gravity(a, { 0.0, -g });
    flexpm::reset_energy_balance(a);
    driven::run_measured(a, 6000, 0.7, dt);
    CHECK(flexpm::reaction(a, bottom, 1) == Approx(6.0 * mass * g).epsilon(1e-6));
    const auto e = flexpm::energies(a);
    CHECK(e.potential < 0.0);
    CHECK(std::fabs(balance::total(e)) < 1e-9 * std::fabs(e.potential));
}

TEST_CASE("gravity that is set on a moved assembly is booked", "[gravity]")
{
    Assembly a = squares(1, 1, true);
    flexpm::set_real_masses(a, 0.0);
    flexpm::set_motion(a.grains, 0, { 0.0, 1.0 }, 0.0, 1e-6);
    flexpm::reset_energy_balance(a);
    driven::run_measured(a, 100, 0.0, 1e-6);
    flexpm::set_gravity(a, { 0.0, -g });
    driven::run_measured(a, 100, 0.0, 1e-6);
    const auto e = flexpm::energies(a);
    const double height = a.grains.displacement[component(a.grains.centre(0), 1)];
    CHECK(height > 1.9e-4);
    CHECK(e.potential == Approx(mass * g * height));
    // the half of a step in which gravity appears is its work, once
    CHECK(balance::total(e) == Approx(e.initial).margin(mass * g * 1e-6));
    CHECK_THROWS_WITH(flexpm::set_gravity(a, { 0.0, std::nan("") }), Catch::Contains("finite"));
}

TEST_CASE("grains of the inside, too, come to rest on a wall", "[gravity][plate]")
{
    const bool rigid = GENERATE(true, false);
    Assembly a = squares(3, 3, rigid);
    const int wall = flexpm::add_wall(a, { 0.0, -1e-4 }, { 0.0, 1.0 }, { 0.0, 0.3, false });
    CHECK(a.plates[wall].points.size() == 2 * 4 * 9);
    CHECK_THROWS_WITH(flexpm::add_wall(a, { 0.0, 1e-4 }, { 0.0, 1.0 }, {}),
        Catch::Contains("gap between wall and grains"));
    const double damping = 0.2, dt = flexpm::set_real_masses(a, damping);
    flexpm::set_gravity(a, { 0.0, -g });
    flexpm::reset_energy_balance(a);
    double error = 0.0;
    for (int i = 0; i < 200; ++i) {
        driven::run_measured(a, static_cast<int>(2e-4 / dt), damping, dt);
        const auto e = flexpm::energies(a);
        error = std::max(error, std::fabs(balance::miss(e)));
    }
    CHECK(a.plates[wall].force.y == Approx(9.0 * mass * g).epsilon(1e-3));
    CHECK(a.grains.displacement[component(a.grains.centre(4), 1)] == Approx(-1e-4).epsilon(0.02));
    CHECK(flexpm::energies(a).kinetic < 1e-9 * -flexpm::energies(a).potential);
    CHECK(error < 0.01 * -flexpm::energies(a).potential);
}

TEST_CASE("the stable step of real masses falls when a plate is added", "[gravity][mass]")
{
    Assembly a = squares(2, 1, true);
    const double before = flexpm::set_real_masses(a, 0.0);
    CHECK(flexpm::stable_step(a, 0.0) == Approx(before).epsilon(1e-12));
    flexpm::add_wall(a, { 0.0, -1e-4 }, { 0.0, 1.0 }, {});
    CHECK(flexpm::stable_step(a, 0.0) < before);
}
