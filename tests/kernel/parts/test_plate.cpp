// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rigid plates: stiffness in series, unilateral and bonded contacts, friction, pressure,
/// energy. SI units; forces on the specimen positive along the plate's normal.
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/parts/part_plates.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include <flexpm/kernel/step/mass_scaling.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/driven.hpp"

using flexpm::Assembly;
using flexpm::component;
using flexpm::lanes;
using flexpm::Point;

namespace {

constexpr double size = 3e-3;          // side of the square grains [m]
constexpr double stiffness = 1.08e13;  // K_n [Pa/m]

Assembly squares(int nx, int ny, bool rigid)
{
    auto o = specimens::options(specimens::strong_contact(stiffness));
    o.rigid = rigid;
    return specimens::assemble(specimens::grid(nx, ny, size), o);
}

/// Largest error of the energy balance over the largest work, looked at every 50 steps.
struct Balance {
    double error = 0.0, work = 0.0;

    void look(const Assembly& a)
    {
        const auto e = flexpm::energies(a);
        work = std::max(work, std::fabs(e.boundary_work));
        error = std::max(error, std::fabs(balance::miss(e)));
    }
    double ratio() const { return error / work; }
};

}  // namespace

TEST_CASE("plates are in series with a grid of rigid squares", "[plate]")
{
    const int nx = 3, ny = GENERATE(2, 5);
    const bool bonded = GENERATE(false, true);
    Assembly a = squares(nx, ny, true);
    flexpm::add_side_plates(a, flexpm::bottom_side, 1, { 0.0, 0.0, bonded });
    const int upper = flexpm::add_side_plates(a, flexpm::top_side, 1, { 0.0, 0.0, bonded }).front();
    flexpm::scale_masses(a, 0.7);
    const double closure = 1e-7;
    flexpm::set_velocity(a, upper, { 0.0, -closure / 500 });
    driven::run_measured(a, 500);
    flexpm::set_velocity(a, upper, { 0.0, 0.0 });
    driven::run_measured(a, 1500);
    // ny - 1 contacts of grains and two of plates, all of stiffness K_n per area
    const double stress = stiffness * closure / (ny + 1);
    const double force = stress * nx * size * specimens::thickness;
    CHECK(flexpm::plate_force(a, flexpm::top_side).y == Approx(-force).epsilon(1e-6));
    CHECK(flexpm::plate_force(a, flexpm::bottom_side).y == Approx(force).epsilon(1e-6));
    if (ny > 2) {
        const auto o = flexpm::observe(a, flexpm::rectangle_frame(a, flexpm::Sense::compression));
        CHECK(o.axial_stress == Approx(stress).epsilon(1e-6));
        CHECK(o.axial_stress / o.axial_strain == Approx(stiffness * size).epsilon(1e-6));
    }
}

TEST_CASE("a plate lets go unless it is bonded", "[plate]")
{
    const bool bonded = GENERATE(false, true);
    Assembly a = squares(2, 2, true);
    flexpm::add_side_plates(a, flexpm::bottom_side, 1, { 0.0, 0.0, true });
    const int upper = flexpm::add_side_plates(a, flexpm::top_side, 1, { 0.0, 0.0, bonded }).front();
    flexpm::scale_masses(a, 0.7);
    flexpm::set_velocity(a, upper, { 0.0, 1e-10 });
    driven::run_measured(a, 1000);
    const double pull = flexpm::plate_force(a, flexpm::top_side).y;
    if (bonded) CHECK(pull > 1.0);
    if (!bonded) CHECK(pull == 0.0);
}

TEST_CASE("boundary nodes of deformable grains carry their tributary length", "[plate]")
{
    Assembly a = squares(3, 1, false);
    const int plate = flexpm::add_side_plates(a, flexpm::top_side, 1, {}).front();
    flexpm::scale_masses(a, 0.7);
    driven::hold_all(a);
    flexpm::set_velocity(a, plate, { 0.0, -1e-9 });
    driven::run_measured(a, 1);
    for (int e = 0; e < a.facets.count; ++e) {
        if (a.facets.side[e] != flexpm::top_side) continue;
        for (int node : a.facets.nodes(e)) {
            const double force = stiffness * 0.5 * size * specimens::thickness * 1e-9;
            CHECK(a.grains.force[component(node, 1)] == Approx(-force).epsilon(1e-9));
        }
    }
    CHECK(flexpm::contact_width(a, plate) == Approx(4.0 * size - size).epsilon(0.4));
}

TEST_CASE("friction of a plate is Coulomb's, and its loss is booked", "[plate]")
{
    Assembly a = squares(1, 1, true);
    const double friction = 0.3;
    const int upper =
        flexpm::add_side_plates(a, flexpm::top_side, 1, { 0.0, friction, false }).front();
    flexpm::scale_masses(a, 0.0);
    a.grains.prescribed[a.grains.centre(0)] =
        a.grains.prescribed[component(a.grains.centre(0), 1)] = 1;
    driven::prescribe_spin(a.grains, 0, 0.0);
    flexpm::set_velocity(a, upper, { 0.0, -1e-9 });
    driven::run_measured(a, 100, 0.0);
    const double normal = -flexpm::plate_force(a, flexpm::top_side).y;
    const double k = stiffness * size * specimens::thickness;
    CHECK(normal == Approx(k * 1e-7).epsilon(1e-9));

    const double slip = 5e-7;
    flexpm::set_velocity(a, upper, { slip / 100, 0.0 });
    driven::run_measured(a, 100, 0.0);
    CHECK(flexpm::plate_force(a, flexpm::top_side).x == Approx(friction * normal).epsilon(1e-12));
    const double elastic = friction * normal / (0.28 * k);  // slip before it slides
    CHECK(flexpm::energies(a).friction
        == Approx(friction * normal * (slip - elastic))
               .epsilon(1e-3));  // sliding starts within a step
    CHECK(flexpm::energies(a).boundary_work
        == Approx(balance::total(flexpm::energies(a))).epsilon(1e-12));
}

TEST_CASE("a membrane of loaded plates presses with its pressure", "[plate]")
{
    Assembly a = specimens::assemble(specimens::random_grains(18e-3, 36e-3, size, 4), [] {
        auto o = specimens::options(specimens::strong_contact(stiffness));
        o.rigid = true;
        return o;
    }());
    std::vector<int> membrane = flexpm::add_side_plates(a, flexpm::left_side, 6, {});
    for (int p : flexpm::add_side_plates(a, flexpm::right_side, 6, {}))
        membrane.push_back(p);
    flexpm::scale_masses(a, 0.7);
    const double pressure = 4e6;
    Balance balance;
    for (int i = 0; i < 3000; ++i) {
        for (int p : membrane)
            flexpm::press(a, p, pressure * flexpm::ramp_factor(a.step, 1000));
        driven::run_measured(a, 1);
        if (i % 50 == 0) balance.look(a);
    }
    for (int p : membrane) {
        const flexpm::Plate& plate = a.plates[p];
        CHECK(plate.force.x * plate.normal.x
            == Approx(pressure * 36e-3 / 6 * specimens::thickness).epsilon(1e-6));
        CHECK(plate.force.y == 0.0);
        CHECK(plate.displacement.x * plate.normal.x > 0.0);
    }
    CHECK(balance.ratio() < 1e-6);
}

TEST_CASE("energy of a specimen broken between plates is accounted for", "[plate][energy]")
{
    auto o = specimens::options();
    o.rigid = GENERATE(true, false);
    Assembly a = specimens::assemble(specimens::random_grains(12e-3, 18e-3, size, 6), o);
    flexpm::add_side_plates(a, flexpm::bottom_side, 1, { 0.0, 0.2, false });
    const int upper = flexpm::add_side_plates(a, flexpm::top_side, 1, { 0.0, 0.2, false }).front();
    flexpm::scale_masses(a, 0.7);
    flexpm::set_velocity(a, upper, { 0.0, -4e-8 });
    Balance balance;
    for (int i = 0; i < 120; ++i) {
        driven::run_measured(a, 50);
        balance.look(a);
    }
    REQUIRE(flexpm::count_cracks(a).shear + flexpm::count_cracks(a).tensile > 10);
    CHECK(balance.ratio() < 0.01);
}

TEST_CASE("a plate touches a polygon at its outermost point", "[plate]")
{
    auto o = specimens::options();
    o.rigid = GENERATE(true, false);
    Assembly a = specimens::assemble(specimens::hexagon(), o);
    const int plate = flexpm::add_touching_plate(a, { 0.0, -2.0 }, {});
    const flexpm::Plate& p = a.plates[plate];
    CHECK(p.normal.y == -1.0);
    CHECK(flexpm::least_gap(p) == 0.0);
    CHECK(p.position.y == Approx(o.rigid ? 2.55e-3 : 2.8e-3));
    flexpm::fix_tangential(a, plate);
    int held = 0;
    for (int n = 0; n < a.grains.nodes_of(0); ++n) {
        CHECK(a.grains.prescribed[component(a.grains.node(0, n), 1)] == 0);
        held += a.grains.prescribed[a.grains.node(0, n)];
    }
    CHECK(held == 1);
}

TEST_CASE("plates are checked", "[plate]")
{
    Assembly a = squares(2, 2, true);
    CHECK_THROWS_WITH(flexpm::add_side_plates(a, 9, 1, {}), Catch::Contains("side = 9"));
    CHECK_THROWS_WITH(flexpm::add_side_plates(a, 0, 0, {}), Catch::Contains("at least 1"));
    CHECK_THROWS_WITH(flexpm::add_side_plates(a, 0, 40, {}), Catch::Contains("must be fewer"));
    CHECK_THROWS_WITH(
        flexpm::add_side_plates(a, 0, 1, { -1.0, 0.0, false }), Catch::Contains("stiffness"));
    const int plate = flexpm::add_side_plates(a, 0, 1, {}).front();
    CHECK_THROWS_WITH(flexpm::press(a, plate, 1e6), Catch::Contains("scale the masses"));
    CHECK_THROWS_WITH(flexpm::set_velocity(a, 7, { 0.0, 0.0 }), Catch::Contains("plate = 7"));
}

TEST_CASE("A plate is where its load acts: an even pressure has no moment there", "[plate]")
{
    for (const bool rigid : { false, true }) {
        CAPTURE(rigid);
        Assembly a = squares(5, 2, rigid);
        const double length = 5.0 * size;
        // on one edge, across a corner, of several edges, half of it beyond the outline
        const double asked[][3] = { { 1.3e-3, 1e-3, 1.3e-3 }, { 3.2e-3, 1e-3, 3.2e-3 },
            { 8e-3, 5e-3, 8e-3 }, { length, 2e-3, length - 0.5e-3 } };
        for (const auto& [x, width, place] : asked) {
            CAPTURE(x);
            const int number = flexpm::add_patch_plate(a, { { x, 0.0 }, width, { 0.0, 1.0 } }, {});
            const flexpm::Plate& p = a.plates[number];
            CHECK(p.position.x == Approx(place).epsilon(1e-12));
            CHECK(p.position.y == 0.0);
            double moment = 0.0;
            for (int i = 0; i < flexpm::plate_points(p); ++i) {
                const auto point = flexpm::edge_point(p, i);
                const auto nodes = a.facets.nodes(point.facet);
                moment += p.points[i].area
                    * (flexpm::vector_on_edge(a.grains.reference, nodes, point.weight).x
                        - p.position.x);
            }
            CHECK(std::fabs(moment) < 1e-12 * length * p.width * specimens::thickness);
            a.plates.clear();
        }
        flexpm::add_side_plates(a, flexpm::right_side, 1, {});
        CHECK(a.plates[0].position.x == length);
        CHECK(a.plates[0].position.y == Approx(size).epsilon(1e-12));
    }
}
