// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points that crack.
#include <flexpm/kernel/forces/crack_record.hpp>

namespace flexpm {

namespace {

/// Where a point is now: the middle of its places on the two edges.
Point point_position(const Assembly& a, int contact, int point, double dt)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const int n0 = a.contact_nodes[row_index(contact, 2 * side, ContactRows::nodes)];
        const int n1 = a.contact_nodes[row_index(contact, 2 * side + 1, ContactRows::nodes)];
        const double w = a.weight[row_index(contact, 2 * point + side, 2 * a.points)];
        const Point p0 = a.position(n0), p1 = a.position(n1);
        sum.x +=
            0.5 * ((1.0 - w) * (p0.x + dt * a.velocity[n0]) + w * (p1.x + dt * a.velocity[n1]));
        sum.y += 0.5
            * ((1.0 - w) * (p0.y + dt * a.velocity[n0 + lanes])
                + w * (p1.y + dt * a.velocity[n1 + lanes]));
    }
    return sum;
}

}  // namespace

void record_cracks(Assembly& a, int block, double dt, const std::uint8_t* cracked)
{
    for (int p = 0; p < a.points; ++p) {
        for (int l = 0; l < lanes; ++l) {
            const int contact = block * lanes + l;
            if (!cracked[p * lanes + l] || contact >= a.contacts) continue;
            const int index = row_index(contact, p, a.points);
            const double opening = a.point_state[row_index(
                contact, p * ContactRows::state, a.points * ContactRows::state)];
            const Point place = point_position(a, contact, p, dt);
            a.crack_step[index] = static_cast<int>(a.step + 1);
            a.crack_mode[index] = opening > 0.0 ? tensile_crack : shear_crack;
            a.crack_position[row_index(contact, 2 * p, 2 * a.points)] = place.x;
            a.crack_position[row_index(contact, 2 * p + 1, 2 * a.points)] = place.y;
        }
    }
}

}  // namespace flexpm
