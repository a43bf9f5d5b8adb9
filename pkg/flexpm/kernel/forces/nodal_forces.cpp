// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Lists of forces, and their sums per node.
#include <flexpm/kernel/forces/nodal_forces.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/simd.hpp>

#include <algorithm>

namespace flexpm {

namespace {

/// Sources of a block: the first two contacts of each outer node, and what else there is.
struct Sources {
    int* pairs;
    std::vector<int>& rest;
    int none;  ///< stands for no contact
};

/// Sources come in the order of the gather list, edges after contacts, and are summed in it.
void add_source(Sources s, int source, int node)
{
    int* first = s.pairs + node / (2 * lanes) * 2 * lanes + node % lanes;
    if (source >= 0 && first[0] == s.none) {
        first[0] = source;
    } else if (source >= 0 && first[lanes] == s.none) {
        first[lanes] = source;
    } else {
        s.rest.insert(s.rest.end(), { source, node });
    }
}

/// The force on the second node follows that on the first: x and y two values on in a contact, two rows
/// on in a boundary edge.
int second_force(int source) { return source >= 0 ? source + 2 : ~(~source + 2 * lanes); }

/// Sums of the two contacts of each outer node, x and y at once.
template <bool Wide>
FLEXPM_INLINE void sum_lanes(const double* contact, const int* pairs, double* force, int vertices)
{
    const auto at = [&](int source) { return *reinterpret_cast<const Two*>(contact + source); };
    for (int i = 0; i < 2 * lanes * vertices; i += 2 * lanes) {
        const int *first = pairs + i, *second = first + lanes;
        unzip<Wide>([&](int l) { return 0.0 + at(first[l]) + at(second[l]); }, force + i);
    }
}

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
            add(a.contact_grains[2 * c + side], record_index(c, 4 * side, ContactRows::forces),
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
}

void sort_sources(Assembly& a)
{
    const int none = a.contact_blocks() * lanes * ContactRows::forces;
    a.contact_force.resize(static_cast<std::size_t>(none) + 2);  // x and y are zero
    a.source_pairs.assign(a.reference.size(), none);
    a.more_sources.clear();
    a.more_first.assign(1, 0);
    for (int block = 0; block < a.blocks(); ++block) {
        const Sources s = { a.source_pairs.data() + a.block_nodes[block], a.more_sources, none };
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
    const auto sum_pairs = variant_of<sum_lanes<false>, sum_lanes<true>>();
    sum_pairs(contact, a.source_pairs.data() + first, force, group.vertices);
    std::fill(force + 2 * lanes * group.vertices, force + 2 * lanes * group.nodes, 0.0);
    const int *entry = a.more_sources.data() + a.more_first[block],
              *end = a.more_sources.data() + a.more_first[block + 1];
    for (; entry != end; entry += 2) {
        const bool of_contact = entry[0] >= 0;
        const double* f = of_contact ? contact + entry[0] : edge + ~entry[0];
        force[entry[1]] += f[0];
        force[entry[1] + lanes] += f[of_contact ? 1 : lanes];
    }
}

}  // namespace flexpm
