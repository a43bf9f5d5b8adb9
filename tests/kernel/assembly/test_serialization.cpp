// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Each saved part of an assembly lists all its members, and they are all that continues a
/// run.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/serialization.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "assembly/members.hpp"

using flexpm::Assembly;
using namespace members;

namespace {

/// A specimen in motion of which no part is empty.
Assembly used()
{
    Assembly a = same_bits::breaking();
    flexpm::add_side_plates(a, flexpm::top_side, 2, { 0.0, 0.1, false });
    flexpm::scale_masses(a, 0.7);
    a.contacts.close_pairs[{ 0, 2 }] = 1e-3;
    a.gravity = { 1.0, -2.0 };
    flexpm::StepOptions o;
    o.measure = true;
    for (int i = 0; i < 20; ++i)
        flexpm::step(a, o);
    return a;
}

}  // namespace

TEST_CASE("Each saved part lists all its members")
{
    check_members(flexpm::Grains());
    check_members(flexpm::Contacts());
    check_members(flexpm::ContactGroup());
    check_members(flexpm::Facets());
    check_members(flexpm::EnergyLedger());
    check_members(flexpm::Layout());
    check_members(flexpm::MeshGroup());
    check_members(flexpm::ElasticMaterial());
    check_members(flexpm::LawParameters());
    check_members(flexpm::Plate());
    check_members(flexpm::NodeSet());
    check_members(flexpm::PartMotion());
}

TEST_CASE("An assembly saves all its members but the plan of a step")
{
    const Assembly a;
    CHECK(in_order(a));
    CHECK(size_of_members(a) + sizeof(flexpm::StepPlan) == sizeof(Assembly));
}

TEST_CASE("Each saved part comes back from the members that it lists")
{
    const Assembly a = used();
    check_round_trip(a.grains);
    check_round_trip(a.contacts);
    check_round_trip(a.facets);
    check_round_trip(a.plates.front());
    check_round_trip(a.ledger);
}

TEST_CASE("The plan of a loaded state is that of the state that was saved")
{
    const Assembly a = used();
    Assembly loaded = same_bits::copy_of_members(a);
    flexpm::prepare_step(loaded);
    CHECK(loaded.plan.sources.pairs == a.plan.sources.pairs);
    CHECK(loaded.plan.tiles.first == a.plan.tiles.first);
    CHECK(loaded.plan.tiles.grain_blocks.items == a.plan.tiles.grain_blocks.items);
    CHECK(loaded.plan.whole_edges == a.plan.whole_edges);
    CHECK(loaded.plan.element_bound == a.plan.element_bound);
}
