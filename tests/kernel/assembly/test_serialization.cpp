// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Each saved part of an assembly lists all its members, and they are all that continues a
/// run.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/serialization.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/same_bits.hpp"

#include <cstddef>

using flexpm::Assembly;

namespace {

std::size_t rounded_up(std::size_t size, std::size_t step)
{
    return (size + step - 1) / step * step;
}

/// Size of a struct of the members that a part lists, in their order [B].
template <class Part> std::size_t size_of_members(const Part& part)
{
    std::size_t size = 0;
    flexpm::visit_members(part, [&](const char*, const auto& member) {
        size = rounded_up(size, alignof(decltype(member))) + sizeof member;
    });
    return rounded_up(size, alignof(Part));
}

/// Whether a part lists its members in the order in which it declares them, each once.
template <class Part> bool in_order(const Part& part)
{
    const char* last = nullptr;
    bool ascending = true;
    flexpm::visit_members(part, [&](const char*, const auto& member) {
        const char* place = reinterpret_cast<const char*>(&member);
        ascending &= place > last;
        last = place;
    });
    return ascending;
}

/// A part whose members fill it lists all of them; a member left out leaves a hole.
template <class Part> void check_members(const Part& part)
{
    CHECK(in_order(part));
    CHECK(size_of_members(part) == sizeof(Part));
}

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

/// A part comes back from what it lists, and every number of it counts.
template <class Part> void check_round_trip(const Part& part)
{
    const same_bits::Bytes bytes = same_bits::bytes(part);
    CHECK(bytes.size() > 4);
    CHECK(same_bits::difference(part, same_bits::copy_of_members(part)).empty());
    CHECK_FALSE(same_bits::difference(part, Part()).empty());
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
