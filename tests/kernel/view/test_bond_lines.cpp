// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Lines of a contact between two square grains.
#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/view/bond_forces.hpp>
#include <flexpm/kernel/view/bond_lines.hpp>

#include "support/catch.hpp"

#include "support/driven.hpp"

using namespace driven;

namespace {

constexpr double size = 3e-3;  // of a grain [m]

Assembly pair(int points = 3)
{
    auto o = specimens::options();
    o.points = points;
    Assembly a = specimens::assemble(specimens::grid(2, 1, size), o);
    hold_all(a);
    return a;
}

}  // namespace

TEST_CASE("The lines of a contact's points make up its edge, by their areas", "[view]")
{
    const int points = GENERATE(1, 2, 3);
    const Assembly a = pair(points);
    double area = 0.0, length = 0.0;
    for (int p = 0; p < points; ++p)
        area += a.contacts.area(0, p);
    for (int p = 0; p < points; ++p) {
        const flexpm::Line line = flexpm::point_line(a, 0, p, 1.0);
        const double part = norm(line.to - line.from);
        CHECK(line.from.x == Approx(size));
        CHECK(part == Approx(size * a.contacts.area(0, p) / area));
        length += part;
    }
    CHECK(length == Approx(size));
}

TEST_CASE("Displacements are drawn as many times larger as asked", "[view]")
{
    Assembly a = pair();
    set_velocity(a, 1, Point { 1e-9, 0.0 });
    run(a, 1);
    CHECK(flexpm::point_line(a, 0, 1, 1e4).from.x == Approx(size + 0.5e-5).epsilon(1e-9));
    const auto branch = flexpm::branch_line(a.grains, a.contacts.pairs[0], 1e4);
    CHECK(branch[0].x == Approx(0.5 * size));
    CHECK(branch[1].x == Approx(1.5 * size + 1e-5).epsilon(1e-9));
}

TEST_CASE("Normal forces are positive in tension", "[view]")
{
    const double way = GENERATE(1e-9, -1e-9);
    Assembly a = pair();
    set_velocity(a, 1, Point { way, 0.0 });
    run(a, 1);
    const double force = a.contacts.law_of(0).normal_stiffness * way * size * specimens::thickness;
    CHECK(flexpm::normal_force(a, 0) == Approx(force).epsilon(1e-6));
    CHECK(flexpm::largest_contact_force(a) == Approx(std::fabs(force)).epsilon(1e-6));
}
