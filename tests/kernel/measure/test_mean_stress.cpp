// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The mean stress of a specimen and the one of what acts on it from outside.
#include "support/catch.hpp"

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/mean_stress.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include <cmath>

#include "support/specimens.hpp"

using flexpm::Assembly;
using flexpm::Balance;

namespace {

constexpr double width = 18e-3, height = 24e-3, size = 3e-3, pressure = 1e4;

Assembly grains(bool rigid)
{
    auto o = specimens::options(specimens::strong_contact());
    o.rigid = rigid;
    return specimens::assemble(specimens::random_grains(width, height, size, 4), o);
}

void run(Assembly& a, int steps)
{
    for (int i = 0; i < steps; ++i)
        flexpm::step(a, flexpm::StepOptions());
}

void check_stress(const flexpm::SpaceTensor& stress, double xx, double yy, double margin)
{
    CHECK(std::fabs(stress.xx - xx) < margin * pressure);
    CHECK(std::fabs(stress.yy - yy) < margin * pressure);
}

}  // namespace

TEST_CASE("pressure on all edges of deformable grains is their mean stress", "[balance]")
{
    Assembly a = grains(false);
    flexpm::scale_masses(a, 0.7);
    for (int side = 0; side < 4; ++side)
        flexpm::set_pressure(a, side, side % 2 == 0 ? 2.0 * pressure : pressure);
    run(a, 40);
    Balance now = flexpm::balance(a);
    // a wave has not yet come to the middle
    check_stress(now.outside_stress, -pressure, -2.0 * pressure, 1e-4);
    CHECK(now.mean_stress.yy > -1.6 * pressure);
    run(a, 8000);
    now = flexpm::balance(a);
    check_stress(now.mean_stress, -pressure, -2.0 * pressure, 1e-5);
    check_stress(now.outside_stress, -pressure, -2.0 * pressure, 1e-5);
    CHECK(std::fabs(now.mean_stress.xy) < 1e-5 * pressure);  // plates, which do not turn, have some
    CHECK(std::fabs(now.missing_force.y) < 1e-6 * pressure * width * specimens::thickness);
}

TEST_CASE("a held end reacts as if it pressed", "[balance]")
{
    Assembly a = grains(false);
    flexpm::scale_masses(a, 0.7);
    const std::vector<int> bottom = flexpm::side_nodes(a, flexpm::bottom_side);
    flexpm::prescribe(a, bottom, 1, 0.0);
    flexpm::prescribe(a, { bottom.front() }, 0, 0.0);
    flexpm::set_pressure(a, flexpm::top_side, pressure);
    run(a, 30);
    Balance now = flexpm::balance(a);
    const double force = pressure * width * specimens::thickness;
    // what presses on the top and is not borne yet moves what is free
    const double reaction = flexpm::reaction(a, bottom, 1);
    CHECK(now.missing_force.y == Approx(reaction - force).epsilon(1e-4));
    run(a, 20000);
    now = flexpm::balance(a);
    check_stress(now.mean_stress, 0.0, -pressure, 1e-4);
    CHECK(std::fabs(now.missing_force.y) < 1e-4 * force);
}

TEST_CASE("forces and branches of rigid grains between plates are their mean stress", "[balance]")
{
    Assembly a = grains(true);
    flexpm::add_side_plates(a, flexpm::bottom_side, 1, {});
    std::vector<int> pressed = flexpm::add_side_plates(a, flexpm::top_side, 1, {});
    for (int side : { flexpm::left_side, flexpm::right_side }) {
        for (int p : flexpm::add_side_plates(a, side, 3, {}))
            pressed.push_back(p);
    }
    flexpm::scale_masses(a, 0.7);
    for (int p : pressed)
        flexpm::press(a, p, pressure);
    run(a, 20);
    CHECK(flexpm::balance(a).plate_share > 0.05);
    run(a, 6000);
    const Balance now = flexpm::balance(a);
    check_stress(now.mean_stress, -pressure, -pressure, 1e-4);
    check_stress(now.outside_stress, -pressure, -pressure, 1e-4);
    CHECK(now.plate_share < 1e-6);
}

TEST_CASE("grains that nothing acts on have no stress", "[balance]")
{
    Assembly a = grains(GENERATE(false, true));
    flexpm::scale_masses(a, 0.7);
    run(a, 10);
    const Balance now = flexpm::balance(a);
    CHECK(now.mean_stress.xx == 0.0);
    CHECK(now.outside_stress.yy == 0.0);
    CHECK(now.missing_force.x == 0.0);
    CHECK(now.plate_share == 0.0);
}
