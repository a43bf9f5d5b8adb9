// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/forces/held_sides.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <cmath>
#include <map>
#include <set>

namespace flexpm {

namespace {

/// Whether a side runs along an axis more than across it.
bool runs_along(const Assembly& a, int side, int axis)
{
    double along = 0.0, across = 0.0;
    for (int e = 0; e < a.facets.count; ++e) {
        if (!is_on_side(a, e, side)) continue;
        const Point way = facet_place(a, e).way();
        along += std::fabs(axis == 0 ? way.x : way.y);
        across += std::fabs(axis == 0 ? way.y : way.x);
    }
    return along > across;
}

/// Nodes of a side by their grains.
std::map<int, std::set<int>> nodes_of_grains(const Assembly& a, int side)
{
    std::map<int, std::set<int>> nodes;
    for (int e = 0; e < a.facets.count; ++e) {
        if (!is_on_side(a, e, side)) continue;
        for (int n : a.facets.nodes(e))
            nodes[a.facets.grain[e]].insert(n);
    }
    return nodes;
}

void hold(Grains& grains, int node, int axis)
{
    grains.prescribed[component(node, axis)] = 1;
    grains.velocity[component(node, axis)] = 0.0;
}

/// Velocity along an axis that a spin of 1 gives to the middle of some nodes of a grain [m].
double lever_of(const Grains& grains, int grain, const std::set<int>& nodes, int axis)
{
    const Point centre = vector_at(grains.reference, grains.centre(grain));
    double sum = 0.0;
    for (int n : nodes) {
        const Point arm = vector_at(grains.reference, n) - centre;
        sum += axis == 0 ? -arm.y : arm.x;
    }
    return sum / static_cast<double>(nodes.size());
}

}  // namespace

void hold_side(Assembly& a, int side, int axis)
{
    require_side(a, side);
    Grains& grains = a.grains;
    const bool along = runs_along(a, side, axis);
    for (const auto& [grain, nodes] : nodes_of_grains(a, side)) {
        if (!grains.is_rigid(grain)) {
            for (int n : nodes)
                hold(grains, n, axis);
        } else if (along) {
            a.held_edges.push_back({ grain, axis, lever_of(grains, grain, nodes, axis) });
        } else {
            hold(grains, grains.centre(grain), axis);
        }
    }
}

void hold_edges(Assembly& a, double dt)
{
    Grains& grains = a.grains;
    for (const HeldEdge& edge : a.held_edges) {
        if (grains.erased[edge.grain]) continue;
        const int centre = grains.centre(edge.grain), slot = grains.slot[edge.grain];
        const double inverse_mass = grains.inverse_mass[scalar_index(centre)];
        const double inverse_inertia = grains.inverse_inertia[slot];
        const double spin = grains.spin[slot], lever = edge.lever;
        Point velocity = vector_at(grains.velocity, centre);
        double& along = edge.axis == 0 ? velocity.x : velocity.y;
        const double push =
            -(along + spin * lever) / (inverse_mass + lever * lever * inverse_inertia);
        along += push * inverse_mass;
        set_motion(grains, edge.grain, velocity, spin + lever * push * inverse_inertia, dt);
    }
}

}  // namespace flexpm
