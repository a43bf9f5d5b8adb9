// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The same bits on any number of threads, from any saved state, on any instruction set.
#include "support/catch.hpp"

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/step_plan.hpp>

#include "support/same_bits.hpp"

using namespace driven;

namespace {

constexpr int steps = 500;

Assembly stepped(Assembly a, int count, int threads)
{
    flexpm::StepOptions o;
    o.threads = threads;
    for (int i = 0; i < count; ++i) {
        o.measure = i % 10 == 0;
        flexpm::step(a, o);
    }
    return a;
}

Assembly stepped(int threads) { return stepped(same_bits::breaking(), steps, threads); }

}  // namespace

TEST_CASE("One thread and two give the same bits while contacts break")
{
    const Assembly one = stepped(1);
    const auto cracks = flexpm::count_cracks(one);
    CHECK(cracks.tensile + cracks.shear > 10);
    CHECK(cracks.tensile + cracks.shear < 3 * one.contacts.count);
    CHECK(same_bits::difference(one, stepped(2)).empty());
}

TEST_CASE("Threads that share grains give the bits of one")
{
    Assembly a =
        specimens::assemble(specimens::random_grains(75e-3, 75e-3, 3e-3, 3), specimens::options());
    flexpm::scale_masses(a, 0.7);
    flexpm::prescribe(a, flexpm::side_nodes(a, 0), 1, 0.0);
    flexpm::prescribe(a, flexpm::side_nodes(a, 2), 1, 1e-6);
    flexpm::set_pressure(a, 1, 1e5);
    REQUIRE(a.plan.tiles.count() > 3);
    const Assembly one = stepped(a, 60, 1);
    CHECK(one.ledger.kinetic.back() > 0.0);
    for (int threads : { 2, 3, 7 })  // of seven some have no contacts
        CHECK(same_bits::difference(one, stepped(a, 60, threads)).empty());
}

TEST_CASE("A specimen larger than the caches gives the same bits on one thread and two")
{
    Assembly a = specimens::assemble(
        specimens::random_grains(200e-3, 240e-3, 2.8e-3, 3), specimens::options());
    REQUIRE(a.plan.prefetch.needed);
    flexpm::scale_masses(a, 0.7);
    flexpm::prescribe(a, flexpm::side_nodes(a, 0), 1, 0.0);
    flexpm::prescribe(a, flexpm::side_nodes(a, 2), 1, 2e-6);
    flexpm::show_positions(a);
    const Assembly one = stepped(a, 31, 1), two = stepped(a, 31, 2);
    CHECK(flexpm::count_cracks(one).tensile > 10);
    CHECK(same_bits::difference(one, two).empty());
    CHECK(one.plan.shown_position == two.plan.shown_position);
}

TEST_CASE("A run continued from the listed state gives the same bits")
{
    const Assembly whole = stepped(1);
    Assembly first = same_bits::breaking();
    flexpm::StepOptions o;
    for (int i = 0; i < 300; ++i) {
        o.measure = i % 10 == 0;
        flexpm::step(first, o);
    }
    Assembly second = same_bits::copy_of_members(first);
    CHECK_THROWS_WITH(flexpm::step(second, o), Catch::Contains("prepare_step"));
    flexpm::prepare_step(second);
    for (int i = 300; i < steps; ++i) {
        o.measure = i % 10 == 0;
        flexpm::step(second, o);
    }
    CHECK(same_bits::difference(whole, second).empty());
}

TEST_CASE("A difference of one bit is seen")
{
    Assembly a = stepped(1), b = a;
    CHECK(same_bits::difference(a, b).empty());
    b.grains.velocity[0] = std::nextafter(b.grains.velocity[0], 1.0);
    CHECK(same_bits::difference(a, b) == "grains.velocity ");
}
