// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/step/tiles.hpp>

#include <algorithm>

namespace flexpm {

Tiles make_tiles(const Grains& grains, const Contacts& contacts)
{
    const int count = std::max((contacts.blocks() + tile_length - 1) / tile_length, 1);
    Tiles tiles;
    tiles.first.assign(grains.blocks(), count - 1);
    std::vector<int> last(grains.blocks(), 0);
    for (int c = 0; c < contacts.count; ++c) {
        const int tile = c / lanes / tile_length;
        for (int grain : contacts.pairs[c]) {
            const int block = grains.block_of(grain);
            tiles.first[block] = std::min(tiles.first[block], tile);
            last[block] = std::max(last[block], tile);
        }
    }
    std::vector<std::vector<int>> members(count);
    for (int block = 0; block < grains.blocks(); ++block)
        members[last[block]].push_back(block);
    tiles.grain_blocks = Lists<int>(members);
    return tiles;
}

}  // namespace flexpm
