// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Lists of forces, and their sums per node.
#include <flexpm/kernel/gather.hpp>

#include <algorithm>

namespace flexpm {

namespace {

constexpr int none = -1;
/// What a node without a source reads, x and y.
constexpr double zeros[lanes + 1] = {};

/// Sources of a block: the first two contacts of each outer node, and what else there is.
struct Sources {
    int* pairs;
    std::vector<int>& rest;
};

/// Sources come in the order of the gather list, edges after contacts, and are summed in it.
void add_source(Sources s, int source, int node)
{
    int* first = s.pairs + node / (2 * lanes) * 2 * lanes + node % lanes;
    if (source >= 0 && first[0] == none) {
        first[0] = source;
    } else if (source >= 0 && first[lanes] == none) {
        first[lanes] = source;
    } else {
        s.rest.insert(s.rest.end(), { source, node });
    }
}

/// Offsets of the forces on the second node of an edge follow those on the first.
int second_force(int source) { return source >= 0 ? source + 2 * lanes : ~(~source + 2 * lanes); }

}  // namespace

void list_forces(Assembly& a)
{
    std::vector<std::vector<int>> lists(a.blocks());
    const auto add = [&](int grain, int force, int n0, int n1) {
        const int block = a.grain_slot[grain] / lanes;
        lists[block].insert(
            lists[block].end(), { force, n0 - a.block_nodes[block], n1 - a.block_nodes[block] });
    };
    for (int c = 0; c < a.contacts; ++c) {
        for (int side = 0; side < 2; ++side) {
            add(a.contact_grains[2 * c + side], row_index(c, 4 * side, ContactRows::forces),
                a.contact_nodes[row_index(c, 2 * side, ContactRows::nodes)],
                a.contact_nodes[row_index(c, 2 * side + 1, ContactRows::nodes)]);
        }
    }
    for (int e = 0; e < a.edges; ++e) {
        for (int row : { 0, ContactRows::plate }) {
            add(a.edge_grain[e], ~row_index(e, row, ContactRows::forces),
                a.edge_nodes[row_index(e, 0, 2)], a.edge_nodes[row_index(e, 1, 2)]);
        }
    }
    a.gather_first.assign(1, 0);
    a.gather.clear();
    for (const auto& list : lists) {
        a.gather.insert(a.gather.end(), list.begin(), list.end());
        a.gather_first.push_back(static_cast<int>(a.gather.size()));
    }
    sort_sources(a);
}

void sort_sources(Assembly& a)
{
    a.source_pairs.assign(a.reference.size(), none);
    a.more_sources.clear();
    a.more_first.assign(1, 0);
    for (int block = 0; block < a.blocks(); ++block) {
        const Sources s = { a.source_pairs.data() + a.block_nodes[block], a.more_sources };
        for (int i = a.gather_first[block]; i < a.gather_first[block + 1]; i += 3) {
            add_source(s, a.gather[i], a.gather[i + 1]);
            add_source(s, second_force(a.gather[i]), a.gather[i + 2]);
        }
        a.more_first.push_back(static_cast<int>(a.more_sources.size()));
    }
}

void gather_forces(Assembly& a, int block)
{
    const int first = a.block_nodes[block];
    const MeshGroup& group = a.group(block);
    const double *contact = a.contact_force.data(), *edge = a.edge_force.data();
    double* force = a.force.data() + first;
    for (int n = 0; n < group.vertices; ++n) {
        const int* pair = a.source_pairs.data() + first + 2 * lanes * n;
        double* f = force + 2 * lanes * n;
        for (int l = 0; l < lanes; ++l) {
            const double* p = pair[l] != none ? contact + pair[l] : zeros;
            const double* q = pair[lanes + l] != none ? contact + pair[lanes + l] : zeros;
            f[l] = (0.0 + p[0]) + q[0];
            f[lanes + l] = (0.0 + p[lanes]) + q[lanes];
        }
    }
    std::fill(force + 2 * lanes * group.vertices, force + 2 * lanes * group.nodes, 0.0);
    const int *entry = a.more_sources.data() + a.more_first[block],
              *end = a.more_sources.data() + a.more_first[block + 1];
    for (; entry != end; entry += 2) {
        const double* f = entry[0] >= 0 ? contact + entry[0] : edge + ~entry[0];
        force[entry[1]] += f[0];
        force[entry[1] + lanes] += f[lanes];
    }
}

}  // namespace flexpm
