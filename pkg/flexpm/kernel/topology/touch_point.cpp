// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/touch_point.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

ClosestPoint closest_point(const Grains& grains, int grain, Point x, Point tangent)
{
    const int corners = grains.vertices_of(grain);
    ClosestPoint best {};
    double least = -1.0;
    for (int k = 0; k < corners; ++k) {
        const int n0 = grains.node(grain, k), n1 = grains.node(grain, (k + 1) % corners);
        const Point p0 = grains.point_at(n0), edge = grains.point_at(n1) - p0;
        const double square = dot(edge, edge);
        const double share = dot(x - p0, edge) / square;
        const double w = std::min(std::max(share, 0.0), 1.0);
        const double distance = norm(p0 + w * edge - x);
        if (least >= 0.0 && distance >= least) continue;
        least = distance;
        best = { n0, n1, w, dot(edge, tangent), std::sqrt(square) };
    }
    return best;
}

}  // namespace

TouchPoint touch_point(const Grains& grains, GrainPair pair)
{
    const Point a = grains.point_at(grains.centre(pair[0]));
    const Point branch = grains.point_at(grains.centre(pair[1])) - a;
    const double distance = norm(branch);
    const Point normal { branch.x / distance, branch.y / distance };
    const Point tangent { -branch.y / distance, branch.x / distance };
    // Eq. 7 with d_v = 0
    const double arm = 0.5 * (distance + grains.radius[pair[0]] - grains.radius[pair[1]]);
    const Point x = a + arm * normal;
    return { normal,
        { closest_point(grains, pair[0], x, tangent),
            closest_point(grains, pair[1], x, tangent) } };
}

void attach(Contacts& contacts, int contact, const TouchPoint& touch)
{
    for (int side = 0; side < 2; ++side) {
        const ClosestPoint& p = touch.closest[side];
        contacts.node(contact, side, 0) = p.node_0;
        contacts.node(contact, side, 1) = p.node_1;
        // an edge across the tangent cannot carry the gap's couple
        const bool facing = std::fabs(p.along_tangent) > 0.5 * p.edge_length;
        contacts.inverse_edge_length(contact, side) = facing ? 1.0 / p.along_tangent : 0.0;
        for (int i = 0; i < contacts.points_of(contact); ++i)
            contacts.weight(contact, i, side) = p.weight;
    }
}

bool is_elsewhere(const Contacts& contacts, int contact, const TouchPoint& touch)
{
    constexpr double small = 0.05;  // part of an edge
    for (int side = 0; side < 2; ++side) {
        const ClosestPoint& p = touch.closest[side];
        if (contacts.node(contact, side, 0) != p.node_0
            || std::fabs(contacts.weight(contact, 0, side) - p.weight) > small) {
            return true;
        }
    }
    return false;
}

}  // namespace flexpm
