// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Taking grains and contacts out of an assembly.
#include <flexpm/kernel/topology/removal.hpp>

#include <flexpm/kernel/motion/rigid_grain.hpp>

namespace flexpm {

void retire_contact(Assembly& a, int contact)
{
    for (int p = 0; p < a.points; ++p)
        a.area[row_index(contact, p, a.points)] = 0.0;
    for (int r = 0; r < ContactRows::forces; ++r) {
        a.contact_force[record_index(contact, r, ContactRows::forces)] = 0.0;
    }
}

void retire_grain(Assembly& a, int grain)
{
    const int slot = a.grain_slot[grain], block = slot / lanes, lane = slot % lanes;
    const int triangles = static_cast<int>(a.group(block).triangles.size()) / 3;
    for (int t = 0; t < triangles; ++t) {
        a.shape[a.block_triangles[block] + (5 * t + 4) * lanes + lane] = 0.0;
    }
    a.element_bound.clear();
    for (int n = 0; n < a.nodes_of(grain); ++n) {
        for (int i : { a.node(grain, n), a.node(grain, n) + lanes }) {
            a.velocity[i] = 0.0;
            a.held[i] = 1;
        }
    }
    if (a.is_rigid(grain)) {
        a.spin[rigid_index(a, grain)] = 0.0;
        a.spin_held[rigid_index(a, grain)] = 1;
    }
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_grain[e] == grain) a.edge_pressure[e] = 0.0;
    }
}

}  // namespace flexpm
