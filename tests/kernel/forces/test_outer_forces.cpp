// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces that grains leave behind as they are taken away. SI units.
#include <flexpm/kernel/forces/outer_forces.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/erasure.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/specimens.hpp"

using namespace flexpm;

namespace {

/// Grains three by three between plates on two sides, pressed from above.
Assembly pressed(bool rigid)
{
    auto o = specimens::options(specimens::strong_contact(1e13));
    o.rigid = rigid;
    Assembly a = specimens::assemble(specimens::grid(3, 3, 3e-3), o);
    add_side_plates(a, bottom_side, 1, { 0.0, 1e6 });
    const int top = add_side_plates(a, top_side, 1, {}).front();
    scale_masses(a, 0.7);
    press(a, top, 1e6);
    return a;
}

void run(Assembly& a, int steps, OuterForces* outer, double to = 1.0)
{
    StepOptions o;
    o.measure = true;
    o.outer = outer;
    const double from = outer ? outer->part : 0.0;
    for (int i = 1; i <= steps; ++i) {
        if (outer) {
            outer->before = outer->part;
            outer->part = from + (to - from) * std::min(1.0, 2.0 * i / steps);
        }
        step(a, o);
    }
}

}  // namespace

TEST_CASE("A wall does not move while it has the forces of the grains that are gone", "[erasure]")
{
    Assembly a = pressed(GENERATE(false, true));
    run(a, 6000, nullptr);
    const double stored = energies(a).elastic;
    reset_energy_balance(a);
    std::vector<char> inside(a.grains.count, 0);
    inside[4] = 1;  // in the middle
    OuterForces wall = forces_on_wall(a, inside);
    Point sum;
    for (Point force : wall.forces)
        sum = sum + force;
    CHECK(norm(sum) < 1e-6 * 1e6 * 3e-3 * specimens::thickness);
    const Array<double> before = a.grains.displacement;
    erase(a, { { 4 }, {} }, 1.0);
    wall.part = 1.0;
    run(a, 200, &wall);
    double largest = 0.0, change = 0.0;
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) continue;
        const int c = a.grains.centre(g);
        largest = std::max(largest, norm(vector_at(before, c)));
        change = std::max(change, norm(a.grains.displacement_at(c) - vector_at(before, c)));
    }
    CHECK(change < 1e-6 * largest);

    // what is released in parts is in balance, and its work is booked
    for (double part : { 0.5, 0.0 }) {
        run(a, 6000, &wall, part);
        const Energies e = energies(a);
        CHECK(std::fabs(balance::miss(e)) < 1e-9 * stored);
    }
    CHECK(wall.part == 0.0);

    // at the end it is where one comes that has lost the grains at once
    Assembly other = pressed(a.grains.is_rigid(0));
    run(other, 6000, nullptr);
    erase(other, { { 4 }, {} }, 1.0);
    run(other, 12000, nullptr);
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) continue;
        const int c = a.grains.centre(g);
        const Point apart = a.grains.displacement_at(c) - other.grains.displacement_at(c);
        CHECK(norm(apart) < 1e-4 * largest);
    }
}

TEST_CASE("Grains that all others touch push on no other", "[erasure]")
{
    Assembly a = pressed(true);
    run(a, 100, nullptr);
    CHECK(forces_on_wall(a, std::vector<char>(a.grains.count, 0)).nodes.empty());
    CHECK(forces_on_wall(a, std::vector<char>(a.grains.count, 1)).nodes.empty());
}
