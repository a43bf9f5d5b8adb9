// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/face_forces.hpp>

#include <flexpm/kernel/space_lanes/face_points.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <vector>

namespace flexpm {

namespace {

/// Blocks whose faces move with the nodes of their grains.
struct NodeFaces {
    using Lanes = FaceLanes;

    /// Nodes are near, since their grains have just moved.
    static void prefetch(const SolidState& s, int block)
    {
        const FaceContacts& c = s.contacts;
        const FaceGroup& group = c.group_in(block);
        const int nodes = c.block_nodes[block];
        prefetch_rows(c.nodes.data() + nodes, 2 * group.corners);
        prefetch_rows(c.places.data() + nodes / 2 * 3, 3 * group.corners);
        prefetch_rows(c.shares.data() + c.block_shares[block],
            (group.points - group.at_corners) * group.corners);
        if (!c.states[block].empty()) prefetch_rows(c.line.data() + block * lanes, 1);
        prefetch_states(c, block);
    }

    static FaceLanes lanes_of(const SolidState& s, int block, const FaceLaws& laws)
    {
        return face_lanes(s, block, laws);
    }

    static FaceForces forces_of(SolidState& s, int block)
    {
        const int parcels = s.plan.first_parcel[block];
        return { s.grains.force.data(), parcels < 0 ? nullptr : s.plan.parcels.data() + parcels };
    }

    /// States of a block whose points have been elastic until the step: intact, with the slips before
    /// it, which follow from where the nodes were.
    static Array<double> first_states(
        const SolidState& s, int block, const FaceLaws& laws, double dt)
    {
        const FaceContacts& c = s.contacts;
        const int nodes = 2 * c.group_in(block).corners * lanes, first = c.block_nodes[block];
        constexpr int stride = space_layout.node_stride;
        Array<double> before(static_cast<std::size_t>(nodes) * stride, 0.0);
        std::vector<int> own(nodes);
        for (int i = 0; i < nodes; ++i) {
            const int side = i / lanes % 2, in_slot = c.in_slot[block * lanes + i % lanes];
            // padded lanes follow the first one
            const int contact = in_slot >= 0 ? in_slot : c.in_slot[block * lanes];
            own[i] = i * stride;
            set_space_vector(before, own[i],
                displacement_before(s, c.pairs[contact][side], c.nodes[first + i], dt));
        }
        FaceLanes b = face_lanes(s, block, laws);
        b.displacement = before.data();
        b.nodes = own.data();
        Array<double> states(c.state_count(block), 0.0);
        variant_of<find_slips<FaceLanes, false>, find_slips<FaceLanes, true>>()(b, states.data());
        return states;
    }
};

}  // namespace

int update_face_blocks(SolidState& s, int first, int end, double dt)
{
    return update_blocks<NodeFaces>(s, first, end, dt);
}

void add_node_forces(const SolidState& s, double* force)
{
    const auto hold = variant_of<hold_block<FaceLanes, false>, hold_block<FaceLanes, true>>();
    const auto update = variant_of<update_block<FaceLanes, false>, update_block<FaceLanes, true>>();
    const FaceContacts& c = s.contacts;
    FaceLaws laws;
    for (int block = 0; block < c.blocks(); ++block) {
        if (block == 0 || c.laws.size() > 1) laws.fill(c, block);
        const FaceLanes b = face_lanes(s, block, laws);
        const FaceForces forces { force, nullptr };
        if (c.states[block].empty() && hold(b, forces)) continue;
        Array<double> states = c.states[block].empty()
            ? NodeFaces::first_states(s, block, laws, 0.0)
            : c.states[block];
        FreshCracks cracks;
        update(b, states.data(), forces, cracks);
    }
}

}  // namespace flexpm
