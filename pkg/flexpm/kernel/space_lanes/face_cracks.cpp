// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/face_cracks.hpp>

#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

namespace flexpm {

namespace {

/// Where a point is now: the middle of its places on both sides.
Vector point_position(const SolidState& s, int contact, int point)
{
    Vector sum;
    for (int side = 0; side < 2; ++side) {
        for (int k = 0; k < s.contacts.corners_of(contact); ++k) {
            const int node = s.contacts.node(contact, side, k);
            // nodes of rigid grains may be behind
            const Vector now = space_vector(s.grains.reference, node)
                + displacement_before(s, s.contacts.pairs[contact][side], node, 0.0);
            sum = sum + 0.5 * s.contacts.share(contact, point, k) * now;
        }
    }
    return sum;
}

}  // namespace

void record_cracks(SolidState& s, int block, const FreshCracks& cracks)
{
    FaceContacts& c = s.contacts;
    for (int p = 0; p < c.group_in(block).points; ++p) {
        for (int l = 0; l < lanes; ++l) {
            const int contact = c.in_slot[block * lanes + l];
            if (!cracks.has(p, l) || contact < 0) continue;
            const FacePointState state = c.point_state(contact, p);
            const bool opens = law::gap(c.law_of(contact), cracks.opening(p, l), state) > 0.0;
            c.set_crack(contact, p,
                { s.step + 1, opens ? tensile_crack : shear_crack, point_position(s, contact, p),
                    c.area(contact, p) * state.damage_energy });
        }
    }
}

}  // namespace flexpm
