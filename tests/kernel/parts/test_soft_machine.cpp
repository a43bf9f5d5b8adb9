// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A plate in a soft machine: series of springs, energy, linear solution. Layers before
/// plates. SI units.
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/specimens.hpp"

#include <limits>

using namespace flexpm;

namespace {

constexpr double size = 3e-3;          // side of the square grains [m]
constexpr double stiffness = 1.08e13;  // K_n [Pa/m]
constexpr int columns = 3, rows = 2;

/// Rigid squares between plates.
struct Squares {
    Assembly a;
    int lower, upper;
    /// Stiffness of a row of contacts [N/m].
    double row = stiffness * columns * size * specimens::thickness;

    explicit Squares(const PlateContact& contact) : a(made())
    {
        lower = add_side_plates(a, bottom_side, 1, { 0.0, 1e6, contact.bonded }).front();
        upper = add_side_plates(a, top_side, 1, contact).front();
        scale_masses(a, 0.7);
    }

    static Assembly made()
    {
        auto o = specimens::options(specimens::strong_contact(stiffness));
        o.rigid = true;
        return specimens::assemble(specimens::grid(columns, rows, size), o);
    }

    void run(int steps, double damping = 0.7)
    {
        StepOptions o;
        o.damping = damping;
        o.measure = true;
        for (int i = 0; i < steps; ++i)
            step(a, o);
    }
};

}  // namespace

TEST_CASE("A plate in a soft machine bears in series with its spring", "[plate]")
{
    const bool bonded = GENERATE(false, true);
    Squares s({ 0.0, 0.0, bonded });
    const double specimen = s.row / (rows + 1), machine = GENERATE(0.1, 1.0, 30.0) * specimen;
    set_machine(s.a, s.upper, machine);
    const double way = bonded ? 1e-7 : -1e-7, series = 1.0 / (1.0 / specimen + 1.0 / machine);
    set_velocity(s.a, s.upper, { 0.0, way / 500 });
    s.run(500);
    set_velocity(s.a, s.upper, {});
    s.run(2500);
    const Plate& p = s.a.plates[s.upper];
    const double force = series * way;
    CHECK(p.force.y == Approx(force).epsilon(1e-6));
    CHECK(crosshead_displacement(p).y == Approx(way).epsilon(1e-12));
    CHECK(p.displacement.y == Approx(force / specimen).epsilon(1e-6));
    CHECK(machine_energy(p) == Approx(0.5 * force * force / machine).epsilon(1e-6));
    const Energies e = energies(s.a);
    CHECK(e.boundary_work == Approx(balance::total(e)).epsilon(1e-9));
    CHECK(e.elastic == Approx(0.5 * force * force / specimen).epsilon(1e-6));
}

TEST_CASE("A crosshead that goes back takes the plate off", "[plate]")
{
    Squares s({});
    set_machine(s.a, s.upper, s.row);
    set_velocity(s.a, s.upper, { 0.0, 1e-10 });
    s.run(100);
    const Plate& p = s.a.plates[s.upper];
    CHECK(p.force.y == 0.0);
    CHECK(p.machine_give == 0.0);
    CHECK(p.displacement.y == Approx(1e-8));
}

TEST_CASE("The linear solution has a soft machine in series", "[plate]")
{
    Squares s({});
    const double specimen = s.row / (rows + 1), machine = GENERATE(0.1, 1.0, 30.0) * specimen;
    set_machine(s.a, s.upper, machine);
    Plate& p = s.a.plates[s.upper];
    p.displacement = { 0.0, -1.0 };
    const StaticSolution found = solve_static(s.a, {});
    const double lag = plate_lag(s.a, p, p.displacement, &found.displacement).give;
    CHECK(machine * lag == Approx(specimen * machine / (specimen + machine)));
    CHECK(plate_lag(s.a, s.a.plates[s.lower], {}, &found.displacement).give == 0.0);
}

TEST_CASE("A soft layer is in series with a plate's contacts", "[plate]")
{
    const double strip = GENERATE(0.01, 1.0) * stiffness;
    Squares s({ 0.0, 0.0, false, strip });
    set_velocity(s.a, s.upper, { 0.0, -1e-7 / 500 });
    s.run(500);
    set_velocity(s.a, s.upper, {});
    s.run(2500);
    const double layer = strip * columns * size * specimens::thickness;
    const double whole = 1.0 / ((rows + 1) / s.row + 1.0 / layer);
    CHECK(s.a.plates[s.upper].force.y == Approx(-whole * 1e-7).epsilon(1e-6));
    CHECK(find_side_plate(s.a, top_side, { 0.0, 0.0, false, strip }) == s.upper);
    CHECK(find_side_plate(s.a, top_side, {}) == -1);
}

TEST_CASE("A soft machine is given once, with a stiffness above 0", "[plate]")
{
    Squares s({});
    const double bad = GENERATE(0.0, -1.0, std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN());
    CHECK_THROWS_WITH(set_machine(s.a, s.upper, bad), Catch::Contains("stiffness of a machine"));
    CHECK_THROWS_WITH(set_machine(s.a, 7, 1.0), Catch::Contains("plate"));
    set_machine(s.a, s.upper, 1.0);
    CHECK_THROWS_WITH(set_machine(s.a, s.upper, 1.0), Catch::Contains("once"));
}
