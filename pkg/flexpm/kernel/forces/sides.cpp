// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sides of a specimen.
#include <flexpm/kernel/forces/sides.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Nodes of a rigid grain follow its centre: a hold on one of them would have no effect.
void need_deformable(const Assembly& a, const std::vector<int>& nodes)
{
    for (int block = 0; block < a.grains.blocks(); ++block) {
        if (!a.grains.group(block).rigid) continue;
        const int first = a.grains.block_nodes[block];
        const int last = first + node_stride * a.grains.group(block).nodes;
        for (int n : nodes) {
            if (n < first || n >= last) continue;
            refuse("prescribed node", n, "", "belongs to a rigid grain; load it by a plate");
        }
    }
}

}  // namespace

double edge_length(const Assembly& a, int edge)
{
    const auto n = a.edges.nodes(edge);
    return norm(vector_at(a.grains.reference, n[1]) - vector_at(a.grains.reference, n[0]));
}

void require_side(const Assembly& a, int side)
{
    const auto& sides = a.edges.side;
    if (side >= 0 && std::find(sides.begin(), sides.end(), side) != sides.end()) return;
    refuse("side", side, "", "has no boundary edges; name a side of the outline");
}

bool is_on_side(const Assembly& a, int edge, int side)
{
    return a.edges.side[edge] == side && !a.grains.erased[a.edges.grain[edge]];
}

bool has_edges(const Assembly& a, int side)
{
    for (int e = 0; e < a.edges.count; ++e) {
        if (is_on_side(a, e, side)) return true;
    }
    return false;
}

std::vector<int> side_nodes(const Assembly& a, int side)
{
    require_side(a, side);
    std::vector<int> nodes;
    for (int e = 0; e < a.edges.count; ++e) {
        if (!is_on_side(a, e, side)) continue;
        for (int n : a.edges.nodes(e))
            nodes.push_back(n);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

void prescribe(Assembly& a, const std::vector<int>& nodes, int axis, double velocity)
{
    check_finite("prescribed velocity", velocity, "m/s");
    need_deformable(a, nodes);
    for (int n : nodes) {
        a.grains.prescribed[component(n, axis)] = 1;
        a.grains.velocity[component(n, axis)] = velocity;
    }
}

void update_prescribed_work(Assembly& a, double dt)
{
    for (int block = 0; block < a.grains.blocks(); ++block) {
        const int first = a.grains.block_nodes[block];
        double work = 0.0;
        for (int i = first; i < first + node_stride * a.grains.group(block).nodes; ++i) {
            work -=
                a.grains.prescribed[i] ? 0.5 * dt * a.grains.force[i] * a.grains.velocity[i] : 0.0;
        }
        a.ledger.prescribed_work[2 * block + 1] = work;
    }
}

void release(Assembly& a, const std::vector<int>& nodes, int axis)
{
    for (int n : nodes)
        a.grains.prescribed[component(n, axis)] = 0;
}

double reaction(const Assembly& a, const std::vector<int>& nodes, int axis)
{
    double sum = 0.0;
    for (int n : nodes)
        sum -= a.grains.force[component(n, axis)];
    return sum;
}

double side_displacement(const Assembly& a, int side, int axis, const Array<double>& moved)
{
    double moment = 0.0, length = 0.0;
    for (int e = 0; e < a.edges.count; ++e) {
        if (!is_on_side(a, e, side)) continue;
        const auto [n0, n1] = a.edges.nodes(e);
        const double l = edge_length(a, e);
        moment += 0.5 * l * (moved[component(n0, axis)] + moved[component(n1, axis)]);
        length += l;
    }
    return moment / length;
}

double side_length(const Assembly& a, int side)
{
    double length = 0.0;
    for (int e = 0; e < a.edges.count; ++e) {
        if (a.edges.side[e] == side) length += edge_length(a, e);
    }
    return length;
}

void set_pressure(Assembly& a, int side, double pressure)
{
    require_side(a, side);
    check_not_negative("pressure", pressure, "Pa");
    for (int e = 0; e < a.edges.count; ++e) {
        if (is_on_side(a, e, side)) a.edges.pressure[e] = pressure;
    }
}

namespace {

/// Whether pressure acts on an edge, or has acted until the last step.
bool is_pressed(const BoundaryEdges& edges, int edge)
{
    const Point f = vector_at(edges.forces, BoundaryEdges::force_index(edge, EdgeRow::of_pressure));
    return edges.pressure[edge] != 0.0 || f.x != 0.0 || f.y != 0.0;
}

/// Update the forces of the pressure on an edge; returns their work [J].
double press_edge(Assembly& a, int edge, double dt)
{
    const auto [n0, n1] = a.edges.nodes(edge);
    const Point v0 = vector_at(a.grains.velocity, n0), v1 = vector_at(a.grains.velocity, n1);
    const Point along = (a.grains.position(n1) - a.grains.position(n0)) + dt * (v1 - v0);
    // the outward normal of a counter-clockwise edge is (y, -x) / length
    // what has come loose lies no more in the skin that the pressure acts on, deviation D57
    const double pressure = a.grains.loose[a.edges.grain[edge]] ? 0.0 : a.edges.pressure[edge];
    const double half = 0.5 * pressure * a.thickness;
    const Point now = { -half * along.y, half * along.x };
    const int first = BoundaryEdges::force_index(edge, EdgeRow::of_pressure);
    const double work = 0.5 * dt * dot(vector_at(a.edges.forces, first) + now, v0 + v1);
    set_vector(a.edges.forces, first, now);
    set_vector(a.edges.forces, first + node_stride, now);
    return work;
}

}  // namespace

double update_edge_block(Assembly& a, int block, double dt)
{
    double work = 0.0;
    for (int e = block * lanes; e < std::min((block + 1) * lanes, a.edges.count); ++e) {
        if (is_pressed(a.edges, e)) work += press_edge(a, e, dt);
    }
    return work;
}

}  // namespace flexpm
