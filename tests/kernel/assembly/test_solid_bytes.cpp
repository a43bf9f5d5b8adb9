// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bytes of a grain: what a step may read and write is counted, so that it does not grow
/// without a word.
#include "support/catch.hpp"

#include "support/same_bits.hpp"
#include "support/solid_states.hpp"

#include <array>

using namespace solid_states;

namespace {

std::size_t bytes_of_state(const SolidState& s)
{
    std::size_t sum = 0;
    for (const auto& [name, bytes] : same_bits::bytes(s))
        sum += bytes.size();
    return sum;
}

template <class... Lists> std::size_t bytes_of(const Lists&... lists)
{
    return ((lists.size() * sizeof(typename Lists::value_type)) + ...);
}

std::size_t bytes_of_plan(const SolidPlan& p)
{
    // a further member changes the size: count it below, too; intact specimens have no pairs
    static_assert(sizeof(SolidPlan) == 21 * sizeof(std::vector<int>) + 8 + sizeof(PairPlan));
    return bytes_of(p.tile_contacts, p.first_tile, p.tile_moves, p.moves, p.first_parcel,
        p.block_sums, p.sums, p.parcels, p.shown_forces, p.node_loads, p.body_places, p.motions,
        p.wrenches, p.faces, p.face_places, p.face_grains, p.first_press, p.presses,
        p.first_pressed, p.pressed, p.pressure_works);
}

}  // namespace

TEST_CASE("State and plan of a solid have no more bytes than stated", "[solids]")
{
    const Packing p = packing(300, 6);
    const auto bytes_per_grain = [&](bool rigid) {
        SolidState s =
            make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
        scale_masses(s, 0.7);
        step(s, {});
        const double grains = s.grains.count;
        return std::array<double, 2> { static_cast<double>(bytes_of_state(s)) / grains,
            static_cast<double>(bytes_of_plan(s.plan)) / grains };
    };
    const auto flexible = bytes_per_grain(false), rigid = bytes_per_grain(true);
    CAPTURE(flexible[0], flexible[1], rigid[0], rigid[1]);
    CHECK(flexible[0] <= 8449);
    CHECK(flexible[1] <= 417);
    CHECK(rigid[0] <= 8626);
    CHECK(rigid[1] <= 2647);
}
