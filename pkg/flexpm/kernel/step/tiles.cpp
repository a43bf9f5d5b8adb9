// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Which grains follow which contacts.
#include <flexpm/kernel/step/tiles.hpp>

#include <algorithm>

namespace flexpm {

void list_chunks(Assembly& a)
{
    const int chunks = std::max((a.contact_blocks() + chunk_length - 1) / chunk_length, 1);
    std::vector<int> last_chunk(a.blocks(), 0);
    a.first_chunk.assign(a.blocks(), chunks - 1);
    for (int i = 0; i < 2 * a.contacts; ++i) {
        const int block = a.grain_slot[a.contact_grains[i]] / lanes;
        const int chunk = i / 2 / lanes / chunk_length;
        a.first_chunk[block] = std::min(a.first_chunk[block], chunk);
        last_chunk[block] = std::max(last_chunk[block], chunk);
    }
    std::vector<std::vector<int>> members(chunks);
    for (int block = 0; block < a.blocks(); ++block)
        members[last_chunk[block]].push_back(block);
    a.chunk_blocks.clear();
    a.chunk_first.assign(1, 0);
    for (const auto& blocks : members) {
        a.chunk_blocks.insert(a.chunk_blocks.end(), blocks.begin(), blocks.end());
        a.chunk_first.push_back(static_cast<int>(a.chunk_blocks.size()));
    }
}

}  // namespace flexpm
