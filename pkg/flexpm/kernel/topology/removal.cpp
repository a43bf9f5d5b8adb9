// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/removal.hpp>

#include <flexpm/kernel/assembly/triangle_rows.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <algorithm>

namespace flexpm {

void remove_contact(Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p)
        contacts.area(contact, p) = 0.0;
    std::fill_n(
        &contacts.forces[Contacts::force_index(contact, 0, 0)], Contacts::force_values, 0.0);
}

namespace {

/// Take the points on the facets of a grain from a plate, and the force that they passed on.
void forget_facets(const Assembly& a, int grain, Plate& plate)
{
    const auto is_gone = [&](const PlatePoint& point) {
        return a.facets.grain[point.facet] == grain;
    };
    for (int i = 0; i < plate_points(plate); ++i)
        if (is_gone(plate.points[i])) plate.force = plate.force - point_force(plate, i);
    plate.points.erase(
        std::remove_if(plate.points.begin(), plate.points.end(), is_gone), plate.points.end());
}

/// Take the nodes of a grain from a set.
void forget_nodes(int grain, NodeSet& set)
{
    NodeSet kept = set;
    kept.nodes.clear();
    kept.grains.clear();
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        if (set.grains[i] == grain) continue;
        kept.nodes.push_back(set.nodes[i]);
        kept.grains.push_back(set.grains[i]);
    }
    set = kept;
}

void remove_triangles(Grains& grains, int grain)
{
    const int block = grains.block_of(grain);
    for (int t = 0; t < grains.group(block).triangle_count(); ++t) {
        const int row = shape_rows * t + row_of<&TriangleShape::volume>;
        grains.shape[grains.block_triangles[block] + row * lanes + grains.lane_of(grain)] = 0.0;
    }
}

void stop(Grains& grains, int grain)
{
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        grains.set_vector(grains.velocity, node, {});
        grains.set_vector(grains.force, node, {});
        grains.inverse_mass[grains.scalar_index(node)] = 0.0;
        for (int axis = 0; axis < grains.layout.dimension; ++axis)
            grains.prescribed[grains.component(node, axis)] = 1;
    }
    if (!grains.is_rigid(grain)) return;
    const int slot = grains.slot[grain];
    grains.spin[slot] = grains.inverse_inertia[slot] = 0.0;
    grains.spin_prescribed[slot] = 1;
}

}  // namespace

void remove_grain(Assembly& a, int grain)
{
    a.grains.erased[grain] = 1;
    remove_triangles(a.grains, grain);
    stop(a.grains, grain);
    a.plan.element_bound.clear();
    for (Plate& plate : a.plates)
        forget_facets(a, grain, plate);
    for (NodeSet& set : a.node_sets)
        forget_nodes(grain, set);
    for (int e = 0; e < a.facets.count; ++e) {
        if (a.facets.grain[e] != grain) continue;
        a.facets.pressure[e] = 0.0;
        for (int row = 0; row < FacetRow::count; ++row)
            a.facets.forces[row_index(e, row, FacetRow::count)] = 0.0;
    }
}

}  // namespace flexpm
