// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/plane_lanes/prefetch.hpp>

namespace flexpm {

namespace {

constexpr int cached_contacts = 1 << 14;  ///< with their grains the caches hold about as many

/// Blocks of contacts whose nodes are taken to be in a near cache still.
constexpr int blocks_kept = 48;

/// Rows of an array that blocks of contacts read, unless a block shortly before has read them, too.
class RowLists {
public:
    explicit RowLists(std::size_t values) : last_read(values / lanes, -1 - blocks_kept) { }

    void start_block() { lists.emplace_back(); }
    void add(int offset)
    {
        const int block = static_cast<int>(lists.size()) - 1;
        int& before = last_read[offset / lanes];
        if (block - before > blocks_kept) lists.back().push_back(offset / lanes);
        before = block;
    }
    Lists<int> packed() const { return Lists<int>(lists); }

private:
    std::vector<int> last_read;
    std::vector<std::vector<int>> lists;
};

}  // namespace

PrefetchLists list_prefetches(const Grains& grains, const Contacts& contacts)
{
    PrefetchLists lists;
    lists.needed = contacts.count > cached_contacts;
    if (!lists.needed) return lists;
    RowLists nodes(grains.velocity.size());
    RowLists centres(static_cast<std::size_t>(dimension * lanes) * grains.blocks());
    for (int block = 0; block < contacts.blocks(); ++block) {
        nodes.start_block();
        centres.start_block();
        for (int row = 0; row < NodeRow::count; ++row) {
            for (int l = 0; l < lanes; ++l) {
                const int offset =
                    contacts.nodes[row_index(block * lanes + l, row, NodeRow::count)];
                (row < NodeRow::centre_a ? nodes : centres).add(offset);
            }
        }
    }
    lists.nodes = nodes.packed();
    lists.centres = centres.packed();
    return lists;
}

}  // namespace flexpm
