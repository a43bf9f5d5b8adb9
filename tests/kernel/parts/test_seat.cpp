// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates that turn on a seat: no moment there, closed forms of springs in a row. SI units.
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/parts/part_plates.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/statics/elastic_state.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/specimens.hpp"

#include <algorithm>

using namespace flexpm;

namespace {

constexpr double size = 3e-3;          // side of the square grains [m]
constexpr double stiffness = 1.08e13;  // K_n [Pa/m]
constexpr int columns = 6;

/// A row of squares that are held below a seated plate with contacts twice as stiff on one side, or
/// two rows between it and another plate.
struct Row {
    Assembly a;
    int plate = 0;

    explicit Row(bool fixed, bool bonded = false)
    {
        auto o = specimens::options(specimens::strong_contact(stiffness));
        o.rigid = true;
        a = specimens::assemble(specimens::grid(columns, fixed ? 1 : 2, size), o);
        if (!fixed) add_side_plates(a, bottom_side, 1, { 0.0, 1e6, bonded });
        plate = add_side_plates(a, top_side, 1, { 0.0, 0.0, bonded, 0.0, true }).front();
        if (fixed) {
            std::fill(a.grains.prescribed.begin(), a.grains.prescribed.end(), std::uint8_t { 1 });
            std::fill(a.grains.spin_prescribed.begin(), a.grains.spin_prescribed.end(),
                std::uint8_t { 1 });
            Plate& p = a.plates[plate];
            for (PlatePoint& point : p.points)
                if (point.arm.z > 0.0) point.area *= 2.0;
        }
        scale_masses(a, 0.7);
    }

    void go(double way, int steps = 500)
    {
        set_velocity(a, plate, { 0.0, way / steps });
        run(steps);
        set_velocity(a, plate, {});
        run(2500);
    }

    void run(int steps)
    {
        StepOptions o;
        o.measure = true;
        for (int i = 0; i < steps; ++i)
            step(a, o);
    }

    const Plate& top() const { return a.plates[plate]; }

    double moment() const
    {
        double sum = 0.0;
        for (int i = 0; i < plate_points(top()); ++i)
            sum += seat_arm(top(), i).z * dot(top().normal, point_force(top(), i));
        return sum;
    }
};

/// Stiffness of springs below a seat [N/m], and by how much it turns for a unit way [rad/m].
std::pair<double, double> of_springs(const Plate& p)
{
    double force = 0.0, both = 0.0, moment = 0.0;
    for (int i = 0; i < plate_points(p); ++i) {
        const double k = edge_point(p, i).stiffness, arm = p.points[i].arm.z;
        force += k;
        both += k * arm;
        moment += k * arm * arm;
    }
    return { force - both * both / moment, both / moment };
}

}  // namespace

TEST_CASE("A seated plate turns until its springs have no moment about the seat", "[plate]")
{
    const bool bonded = GENERATE(false, true), pulls = bonded && GENERATE(false, true);
    Row row(true, bonded);
    const double way = pulls ? 1e-7 : -1e-7;
    row.go(way, 50);
    const auto [k, turn] = of_springs(row.top());
    CHECK(k < 1.5 * stiffness * columns * size * specimens::thickness);
    CHECK(row.top().force.y == Approx(k * way).epsilon(1e-9));
    CHECK(row.top().turn.z == Approx(-turn * dot(row.top().normal, Vector { 0.0, way })));
    CHECK(std::fabs(row.moment()) < 1e-9 * k * std::fabs(way) * size);
}

TEST_CASE("A seat in a soft machine is in series with it", "[plate]")
{
    Row row(true);
    const double k = of_springs(row.top()).first, machine = GENERATE(0.1, 3.0) * k;
    set_machine(row.a, row.plate, machine);
    row.go(-1e-7, 50);
    const double whole = 1.0 / (1.0 / k + 1.0 / machine);
    CHECK(row.top().force.y == Approx(-1e-7 * whole).epsilon(1e-9));
    CHECK(std::fabs(row.moment()) < 1e-9 * whole * 1e-7 * size);
}

TEST_CASE("A seated plate lies down on a face that is not parallel to it", "[plate]")
{
    Row row(false);
    Plate& p = row.a.plates[row.plate];
    const double tilt = GENERATE(-1e-5, 1e-5, -1e-3, 1e-3);
    // until both ends bear the steeper ones lie on one alone
    const double off = std::fabs(tilt) > 1e-4 ? 1e-7 : 0.0;
    for (PlatePoint& point : p.points)
        point.gap += tilt * point.arm.z + off;
    row.go(-1e-7 - off);
    const double whole = stiffness * columns * size * specimens::thickness / 3.0;
    CHECK(row.top().turn.z == Approx(tilt).epsilon(1e-6));
    CHECK(row.top().force.y == Approx(-whole * 1e-7).epsilon(1e-6));
    for (int i = 1; i < plate_points(row.top()); ++i) {
        CHECK(point_force(row.top(), i).y == Approx(point_force(row.top(), 0).y).epsilon(1e-5));
    }
    const Energies e = energies(row.a);
    CHECK(e.boundary_work == Approx(balance::total(e)).epsilon(1e-9));
}

TEST_CASE("A seated plate with a point on one side of its seat turns away from it", "[plate]")
{
    Row row(true);
    Plate& p = row.a.plates[row.plate];
    const double tilt = GENERATE(-1.0, 1.0);
    for (PlatePoint& point : p.points)
        point.gap += tilt * point.arm.z > 0.0 ? 1e-5 : 0.0;
    row.go(-1e-7, 50);
    CHECK(std::fabs(row.top().force.y) < 1e-12 * stiffness);
    CHECK(row.top().turn.z * tilt > 0.0);
}

TEST_CASE("A seated plate is laid down on what is before it", "[plate]")
{
    auto o = specimens::options(specimens::strong_contact(stiffness));
    specimens::Specimen s = specimens::grid(columns, 1, size);
    const double slope = GENERATE(-0.05, 0.0, 0.05);
    for (Point& x : s.cells.vertices)
        x.y *= 1.0 + slope * x.x / size;
    Assembly a = specimens::assemble(s, o);
    const Patch patch { { 0.5 * columns * size, size * (1.0 + 0.5 * columns * slope) },
        columns * size, { 0.0, -1.0 } };
    const Plate& p = a.plates[add_patch_plate(a, patch, { 0.0, 0.0, false, 0.0, true })];
    CHECK(p.turn.z == Approx(slope).margin(1e-12));
    for (const PlatePoint& point : p.points)
        CHECK(std::fabs(point.opening) < 1e-12 * size);
}

TEST_CASE("A plate without a seat does not turn", "[plate]")
{
    Row row(true);
    row.a.plates[row.plate].seated = false;
    row.go(-1e-7, 50);
    CHECK(row.top().turn.z == 0.0);
    CHECK(std::fabs(row.moment()) > 0.1 * std::fabs(row.top().force.y) * size);
}

TEST_CASE("Static solutions let a seat turn as the steps do", "[plate]")
{
    Row row(false);
    Plate& p = row.a.plates[row.plate];
    for (PlatePoint& point : p.points)
        if (point.arm.z > 0.0) point.area *= 3.0;
    scale_masses(row.a, 0.7);
    Assembly linear = row.a;
    linear.plates[row.plate].displacement = { 0.0, -1e-7 };
    const StaticSolution found = solve_static(linear, {});
    ElasticLoading asked;
    asked.plates = { row.plate };
    asked.direction = { 0.0, -1.0 };
    asked.way = 1e-7;
    const ElasticState state = find_elastic_state(row.a, asked);
    row.go(-1e-7);
    const double largest = std::fabs(row.top().force.y);
    CHECK(row.top().turn.z != 0.0);
    CHECK(state.load == Approx(largest).epsilon(1e-4));
    CHECK(state.state.plates[row.plate].turn.z == Approx(row.top().turn.z).epsilon(1e-3));
    const int centre = row.a.grains.centre(2 * columns - 1);
    const double way = row.a.grains.displacement_at(centre).y;
    CHECK(vector_at(found.displacement, centre).y == Approx(way).epsilon(1e-3));
    CHECK(vector_at(state.state.grains.displacement, centre).y == Approx(way).epsilon(1e-3));
}

TEST_CASE("A plate that is pressed and turns bears its load", "[plate]")
{
    Row row(false);
    Plate& p = row.a.plates[row.plate];
    const double tilt = 1e-6;
    for (PlatePoint& point : p.points)
        point.gap += tilt * point.arm.z;
    press(row.a, row.plate, 1e6);
    row.run(6000);
    CHECK(row.top().force.y == Approx(-row.top().load).epsilon(1e-6));
    CHECK(row.top().turn.z == Approx(tilt).epsilon(1e-3));
    CHECK(std::fabs(row.moment()) < 1e-6 * row.top().load * size);
}

TEST_CASE("A seated plate of a part of a side is found again by its seat", "[plate]")
{
    auto o = specimens::options(specimens::strong_contact(stiffness));
    Assembly a = specimens::assemble(specimens::grid(columns, 1, size), o);
    const Patch patch { { 2.0 * size, size }, 2.5 * size, {} };
    const int plate = add_patch_plate(a, patch, { 0.0, 0.0, false, 0.0, true });
    CHECK(find_patch_plate(a, patch, { 0.0, 0.0, false, 0.0, true }) == plate);
    CHECK(find_patch_plate(a, patch, {}) == -1);
    double moment = 0.0, largest = 0.0;
    for (const PlatePoint& point : a.plates[plate].points) {
        moment += point.arm.z * point.area;
        largest = std::max(largest, std::fabs(point.arm.z));
    }
    CHECK(std::fabs(moment) < 1e-15 * size);
    CHECK(largest > size);
}

TEST_CASE("A point at the seat bears without turning the plate, and is not alone there", "[plate]")
{
    auto o = specimens::options(specimens::strong_contact(stiffness));
    o.rigid = true;
    Assembly a = specimens::assemble(specimens::grid(3, 1, size), o);
    const Plate& p = a.plates[add_side_plates(a, top_side, 1, { 0.0, 0.0, false, 0.0, true })[0]];
    REQUIRE(p.points.size() == 3);
    for (int i = 0; i < 3; ++i)
        CHECK(std::fabs(p.points[i].arm.z) == Approx(i == 1 ? 0.0 : size));
    CHECK(p.points[1].arm.z == 0.0);
    Assembly one = specimens::assemble(specimens::grid(1, 1, size), o);
    CHECK_THROWS_WITH(add_side_plates(one, top_side, 1, { 0.0, 0.0, false, 0.0, true }),
        "points of a seated plate = 1, must be >= 2 at different positions; use a longer plate");
}
