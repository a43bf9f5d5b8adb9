// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/solid_plan.hpp>

#include <algorithm>

namespace flexpm {

namespace {

/// First places in a list of so many, and the end, from the number of values of each.
std::vector<int> ends_of(const std::vector<int>& counts)
{
    std::vector<int> ends { 0 };
    for (int count : counts)
        ends.push_back(ends.back() + count);
    return ends;
}

int tile_of_grain(const SolidState& s, int grain) { return s.grains.block_of(grain) / tile_grains; }

void find_tiles(SolidState& s)
{
    const FaceContacts& c = s.contacts;
    SolidPlan& plan = s.plan;
    const int tiles = (s.grains.blocks() + tile_grains - 1) / tile_grains;
    plan.tile_contacts.assign(tiles + 1, 0);
    plan.first_tile.resize(s.grains.blocks());
    for (int block = 0; block < s.grains.blocks(); ++block)
        plan.first_tile[block] = block / tile_grains;
    for (int contact = 0; contact < c.count; ++contact) {
        const int tile = tile_of(s, contact);
        int& end = plan.tile_contacts[tile + 1];
        end = std::max(end, c.block_of(contact) + 1);
        for (int grain : c.pairs[contact]) {
            int& first = plan.first_tile[s.grains.block_of(grain)];
            first = std::min(first, tile);
        }
    }
    // a tile without contacts ends where the one before does
    for (int tile = 0; tile < tiles; ++tile)
        plan.tile_contacts[tile + 1] =
            std::max(plan.tile_contacts[tile + 1], plan.tile_contacts[tile]);
}

/// When grains move: before the first tile that has a contact of theirs.
void find_moves(SolidState& s)
{
    SolidPlan& plan = s.plan;
    std::vector<int> counts(plan.tiles(), 0);
    for (int tile : plan.first_tile)
        ++counts[tile];
    plan.tile_moves = ends_of(counts);
    std::vector<int> next = plan.tile_moves;
    plan.moves.resize(plan.first_tile.size());
    for (std::size_t block = 0; block < plan.moves.size(); ++block)
        plan.moves[next[plan.first_tile[block]]++] = static_cast<int>(block);
}

/// Block of contacts by block: room for its parcels, if it has any, and which nodes they are for.
void find_parcels(SolidState& s)
{
    const FaceContacts& c = s.contacts;
    SolidPlan& plan = s.plan;
    std::vector<std::vector<Parcel>> of_grain(s.grains.blocks());
    plan.first_parcel.assign(c.blocks(), -1);
    int values = 0;
    for (int block = 0; block < c.blocks(); ++block) {
        if (!reaches_out(s, c.in_slot[block * lanes])) continue;
        plan.first_parcel[block] = values;
        const int first = c.block_nodes[block];
        for (int i = first; i < c.block_nodes[block + 1]; ++i) {
            const int offset = i - first, side = offset / lanes % 2;
            const int contact = c.in_slot[block * lanes + offset % lanes];
            if (contact < 0) continue;
            const int grains = s.grains.block_of(c.pairs[contact][side]);
            of_grain[grains].push_back({ c.nodes[i] - s.grains.block_nodes[grains],
                values + offset * s.grains.layout.node_stride });
        }
        values += (c.block_nodes[block + 1] - first) * s.grains.layout.node_stride;
    }
    plan.parcels.assign(values, 0.0);
    plan.block_sums = { 0 };
    plan.sums.clear();
    for (const auto& sums : of_grain) {
        plan.sums.insert(plan.sums.end(), sums.begin(), sums.end());
        plan.block_sums.push_back(static_cast<int>(plan.sums.size()));
    }
}

/// Contacts of plates on each block of grains.
void find_presses(SolidState& s)
{
    std::vector<std::vector<PlateTouch>> of_block(s.grains.blocks());
    for (std::size_t p = 0; p < s.plates.size(); ++p) {
        for (std::size_t i = 0; i < s.plates[p].facets.size(); ++i) {
            const int grain = s.surface.grain[s.plates[p].facets[i]];
            of_block[s.grains.block_of(grain)].push_back(
                { static_cast<int>(p), static_cast<int>(i) });
        }
    }
    s.plan.first_press.clear();
    s.plan.presses.clear();
    if (s.plates.empty()) return;
    for (const auto& touches : of_block) {
        s.plan.first_press.push_back(static_cast<int>(s.plan.presses.size()));
        s.plan.presses.insert(s.plan.presses.end(), touches.begin(), touches.end());
    }
    s.plan.first_press.push_back(static_cast<int>(s.plan.presses.size()));
}

/// Surface triangles of each block of grains, if pressures act on them.
void find_pressed(SolidState& s)
{
    SolidPlan& plan = s.plan;
    plan.first_pressed.clear();
    plan.pressed.clear();
    plan.pressure_works.assign(s.surface.pressure.size(), 0.0);
    if (s.surface.pressure.empty()) return;
    std::vector<std::vector<int>> of_block(s.grains.blocks());
    for (std::size_t t = 0; t < s.surface.pressure.size(); ++t)
        of_block[s.grains.block_of(s.surface.grain[t])].push_back(static_cast<int>(t));
    for (const auto& triangles : of_block) {
        plan.first_pressed.push_back(static_cast<int>(plan.pressed.size()));
        plan.pressed.insert(plan.pressed.end(), triangles.begin(), triangles.end());
    }
    plan.first_pressed.push_back(static_cast<int>(plan.pressed.size()));
}

}  // namespace

int tile_of(const SolidState& s, int contact)
{
    const auto [a, b] = s.contacts.pairs[contact];
    return std::min(tile_of_grain(s, a), tile_of_grain(s, b));
}

bool reaches_out(const SolidState& s, int contact)
{
    const auto [a, b] = s.contacts.pairs[contact];
    return tile_of_grain(s, a) != tile_of_grain(s, b);
}

void prepare_step(SolidState& s)
{
    find_tiles(s);
    find_moves(s);
    find_parcels(s);
    find_presses(s);
    find_pressed(s);
}

}  // namespace flexpm
