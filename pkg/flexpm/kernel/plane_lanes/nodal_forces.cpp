// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/plane_lanes/nodal_forces.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/simd.hpp>

#include <algorithm>

namespace flexpm {

namespace {

/// Sums of the two contacts of each outer node, x and y at once.
template <bool Wide>
FLEXPM_INLINE void sum_lanes(const double* contact, const int* pairs, double* force, int vertices)
{
    const auto at = [&](int source) { return *reinterpret_cast<const Two*>(contact + source); };
    for (int i = 0; i < node_stride * vertices; i += node_stride) {
        const int *first = pairs + i, *second = first + lanes;
        unzip<Wide>([&](int l) { return 0.0 + at(first[l]) + at(second[l]); }, force + i);
    }
}

/// The first two contacts of each node, and for each block of grains the further ones.
void add_contacts(const Grains& grains, const Contacts& contacts, ForceSources& sources)
{
    const int none = contacts.no_force();
    sources.pairs.assign(grains.reference.size(), none);
    std::vector<std::vector<ForceSource>> further(grains.blocks());
    for (int c = 0; c < contacts.count; ++c) {
        for (int side = 0; side < 2; ++side) {
            const int block = grains.block_of(contacts.pairs[c][side]);
            for (int corner = 0; corner < contacts.corners_of(c); ++corner) {
                const int node = contacts.node(c, side, corner);
                const int force = Contacts::force_index(c, side, corner);
                int *first = &sources.pairs[node], *second = first + lanes;
                if (*first == none) {
                    *first = force;
                } else if (*second == none) {
                    *second = force;
                } else {
                    further[block].push_back({ force, node - grains.block_nodes[block] });
                }
            }
        }
    }
    sources.contacts = Lists<ForceSource>(further);
}

void add_facets(const Grains& grains, const Facets& facets, ForceSources& sources)
{
    std::vector<std::vector<ForceSource>> lists(grains.blocks());
    for (int e = 0; e < facets.count; ++e) {
        const int block = grains.block_of(facets.grain[e]);
        const int origin = grains.block_nodes[block];
        const auto nodes = facets.nodes(e);
        for (int row : { FacetRow::of_pressure, FacetRow::of_plates }) {
            for (int n = 0; n < facet_nodes; ++n)
                lists[block].push_back({ Facets::force_index(e, row, n), nodes[n] - origin });
        }
    }
    sources.facets = Lists<ForceSource>(lists);
}

}  // namespace

ForceSources find_sources(const Grains& grains, const Contacts& contacts, const Facets& facets)
{
    ForceSources sources;
    add_contacts(grains, contacts, sources);
    add_facets(grains, facets, sources);
    return sources;
}

void sum_forces(Assembly& a, int block)
{
    const ForceSources& sources = a.plan.sources;
    const int first = a.grains.block_nodes[block];
    const MeshGroup& group = a.grains.group(block);
    const double *contact = a.contacts.forces.data(), *facet = a.facets.forces.data();
    double* force = a.grains.force.data() + first;
    const auto sum_pairs = variant_of<sum_lanes<false>, sum_lanes<true>>();
    sum_pairs(contact, sources.pairs.data() + first, force, group.vertices);
    std::fill(force + node_stride * group.vertices, force + node_stride * group.nodes, 0.0);
    for (const ForceSource& s : sources.contacts[block]) {
        force[component(s.node, 0)] += contact[s.force];
        force[component(s.node, 1)] += contact[s.force + 1];
    }
    for (const ForceSource& s : sources.facets[block]) {
        force[component(s.node, 0)] += facet[component(s.force, 0)];
        force[component(s.node, 1)] += facet[component(s.force, 1)];
    }
}

}  // namespace flexpm
