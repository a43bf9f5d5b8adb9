// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/joint_sides.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <vector>

namespace flexpm {

namespace {

std::vector<int> contacts_on(const Contacts& contacts, int joint)
{
    std::vector<int> on_joint;
    for (int c = 0; c < contacts.count; ++c)
        if (contacts.joint[c] == joint) on_joint.push_back(c);
    return on_joint;
}

/// Grains on one joint, each with a vector that points across it.
using Sides = std::map<int, Point>;

/// Sides of the grains that have an edge on a joint: sums of the normals out of them.
Sides sides_by_edges(const Contacts& contacts, int joint)
{
    Sides outward;
    for (int c : contacts_on(contacts, joint)) {
        const auto& pair = contacts.pairs[c];
        outward[pair[0]] = outward[pair[0]] + contacts.normal(c);
        outward[pair[1]] = outward[pair[1]] - contacts.normal(c);
    }
    return outward;
}

/// Sides of the grains that have no more than a corner on a joint. They are those of the neighbours
/// with which they share an edge from there. What lies before the end of a joint is on no side.
Sides sides_by_corners(
    const Contacts& contacts, const Tessellation& t, int joint, const Sides& by_edges)
{
    std::map<int, int> edges_at;  // of the joint, at each of its vertices
    for (int c : contacts_on(contacts, joint)) {
        ++edges_at[t.shared_edges[c].vertex_0];
        ++edges_at[t.shared_edges[c].vertex_1];
    }
    const auto is_within = [&](int vertex) {
        const auto found = edges_at.find(vertex);
        return found != edges_at.end() && found->second > 1;
    };
    Sides outward;
    for (int c = 0; c < contacts.count; ++c) {
        const SharedEdge& edge = t.shared_edges[c];
        if (contacts.joint[c] == joint || !(is_within(edge.vertex_0) || is_within(edge.vertex_1)))
            continue;
        for (int side = 0; side < 2; ++side) {
            const int grain = contacts.pairs[c][side];
            const auto neighbour = by_edges.find(contacts.pairs[c][1 - side]);
            if (by_edges.count(grain) == 0 && neighbour != by_edges.end())
                outward[grain] = outward[grain] + neighbour->second;
        }
    }
    return outward;
}

/// Where a grain lies that has no part in a joint: the distance of its centre from the joint's
/// nearest edge and the unit normal of that, away from the grain.
struct Behind {
    double distance = -1.0;  ///< [m]; below 0: before the ends of the joint
    Point outward;
};

Behind find_behind(const Assembly& a, const std::vector<int>& on_joint, int grain)
{
    const Contacts& contacts = a.contacts;
    const Point centre = a.grains.point_at(a.grains.centre(grain));
    Behind nearest;
    for (int c : on_joint) {
        const Point from = a.grains.point_at(contacts.node(c, 0, 0));
        const Point along = a.grains.point_at(contacts.node(c, 0, 1)) - from;
        const double share = dot(centre - from, along) / dot(along, along);
        if (share < 0.0 || share > 1.0) continue;
        const double height = dot(centre - from, contacts.normal(c));
        const double distance = height < 0.0 ? -height : height;
        if (nearest.distance >= 0.0 && distance >= nearest.distance) continue;
        nearest = { distance, (height < 0.0 ? 1.0 : -1.0) * contacts.normal(c) };
    }
    return nearest;
}

/// How far the discs of grains on a joint reach beyond it at most [m].
double reach_beyond(const Assembly& a, const std::vector<int>& on_joint, const Sides& sides)
{
    double reach = 0.0;
    for (const auto& side : sides) {
        const Behind place = find_behind(a, on_joint, side.first);
        if (place.distance >= 0.0)
            reach = std::max(reach, a.grains.radius[side.first] - place.distance);
    }
    return reach;
}

/// Sides of the grains behind those on a joint whose discs could reach the ones on its other side.
Sides sides_behind(const Assembly& a, int joint, const Sides& sides)
{
    const std::vector<int> on_joint = contacts_on(a.contacts, joint);
    const double reach = reach_beyond(a, on_joint, sides);
    Sides behind;
    for (int grain = 0; grain < a.grains.count; ++grain) {
        if (sides.count(grain) > 0) continue;
        const Behind place = find_behind(a, on_joint, grain);
        if (place.distance >= 0.0 && place.distance < a.grains.radius[grain] + reach)
            behind[grain] = place.outward;
    }
    return behind;
}

}  // namespace

void part_sides_of_joints(Assembly& a, const Tessellation& t)
{
    for (int joint : std::set<int>(a.contacts.joint.begin(), a.contacts.joint.end())) {
        if (joint < 0) continue;
        Sides outward = sides_by_edges(a.contacts, joint);
        outward.merge(sides_by_corners(a.contacts, t, joint, outward));
        outward.merge(sides_behind(a, joint, outward));
        for (auto g = outward.begin(); g != outward.end(); ++g) {
            for (auto h = std::next(g); h != outward.end(); ++h) {
                if (dot(g->second, h->second) < 0.0)
                    a.contacts.close_pairs[{ g->first, h->first }] = 0.0;
            }
        }
    }
}

}  // namespace flexpm
