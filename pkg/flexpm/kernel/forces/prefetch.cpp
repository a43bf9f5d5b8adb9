// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Which nodes to ask for ahead.
#include <flexpm/kernel/forces/prefetch.hpp>

namespace flexpm {

namespace {

/// Blocks of contacts whose nodes are taken to be in a near cache still.
constexpr int blocks_kept = 48;

/// Adds the lines that a block of contacts reads, unless a block shortly before has read them, too.
struct LineList {
    std::vector<int>& lines;
    std::vector<int> last_read;

    LineList(std::vector<int>& to, std::size_t values) :
        lines(to),
        last_read(values / lanes, -1 - blocks_kept)
    {
    }

    template <class Name> void add(int offset, int block, Name name)
    {
        int& before = last_read[offset / lanes];
        if (block - before > blocks_kept) lines.push_back(name(offset / lanes));
        before = block;
    }
};

}  // namespace

void list_fetches(Assembly& a)
{
    a.fetch_first.assign(1, 0);
    a.fetch_lines.clear();
    if (!exceeds_caches(a)) return;
    LineList nodes(a.fetch_lines, a.velocity.size());
    LineList centres(a.fetch_lines, static_cast<std::size_t>(2 * lanes * a.blocks()));
    constexpr int edge_ends = 4;
    for (int block = 0; block < a.contact_blocks(); ++block) {
        const int* rows = a.contact_nodes.data() + block * ContactRows::nodes * lanes;
        for (int i = 0; i < edge_ends * lanes; ++i)
            nodes.add(rows[i], block, [](int line) { return line; });
        for (int i = edge_ends * lanes; i < ContactRows::nodes * lanes; ++i)
            centres.add(rows[i], block, [](int line) { return ~line; });
        a.fetch_first.push_back(static_cast<int>(a.fetch_lines.size()));
    }
}

}  // namespace flexpm
