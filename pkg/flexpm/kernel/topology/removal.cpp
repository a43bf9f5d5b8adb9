// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/removal.hpp>

#include <flexpm/kernel/assembly/triangle_rows.hpp>

#include <algorithm>

namespace flexpm {

void remove_contact(Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p)
        contacts.area(contact, p) = 0.0;
    std::fill_n(
        &contacts.forces[Contacts::force_index(contact, 0, 0)], Contacts::force_values, 0.0);
}

void remove_grain(Assembly& a, int grain)
{
    Grains& grains = a.grains;
    const int block = grains.block_of(grain);
    for (int t = 0; t < grains.group(block).triangle_count(); ++t) {
        const int row = ShapeRow::count * t + ShapeRow::volume;
        grains.shape[grains.block_triangles[block] + row * lanes + grains.lane_of(grain)] = 0.0;
    }
    a.plan.element_bound.clear();
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        set_vector(grains.velocity, node, {});
        for (int axis = 0; axis < dimension; ++axis)
            grains.prescribed[component(node, axis)] = 1;
    }
    if (grains.is_rigid(grain)) {
        grains.spin[grains.slot[grain]] = 0.0;
        grains.spin_prescribed[grains.slot[grain]] = 1;
    }
    for (int e = 0; e < a.edges.count; ++e) {
        if (a.edges.grain[e] == grain) a.edges.pressure[e] = 0.0;
    }
}

}  // namespace flexpm
