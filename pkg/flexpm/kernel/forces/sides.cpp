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
    for (int block = 0; block < a.blocks(); ++block) {
        if (!a.group(block).rigid) continue;
        const int first = a.block_nodes[block], last = first + 2 * lanes * a.group(block).nodes;
        for (int n : nodes) {
            if (n < first || n >= last) continue;
            refuse("prescribed node", n, "", "belongs to a rigid grain; load it by a plate");
        }
    }
}

}  // namespace

double edge_length(const Assembly& a, int edge)
{
    const auto n = edge_nodes(a, edge);
    return std::hypot(a.reference[n[1]] - a.reference[n[0]],
        a.reference[n[1] + lanes] - a.reference[n[0] + lanes]);
}

std::vector<int> side_nodes(const Assembly& a, int side)
{
    std::vector<int> nodes;
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_side[e] != side) continue;
        for (int n : edge_nodes(a, e))
            nodes.push_back(n);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

void drive(Assembly& a, const std::vector<int>& nodes, int component, double velocity)
{
    check_finite("prescribed velocity", velocity, "m/s");
    need_deformable(a, nodes);
    for (int n : nodes) {
        a.held[n + component * lanes] = 1;
        a.velocity[n + component * lanes] = velocity;
    }
}

void rebook_driven(Assembly& a, double dt)
{
    for (int block = 0; block < a.blocks(); ++block) {
        const int first = a.block_nodes[block];
        double work = 0.0;
        for (int i = first; i < first + 2 * lanes * a.group(block).nodes; ++i) {
            work -= a.held[i] ? 0.5 * dt * a.force[i] * a.velocity[i] : 0.0;
        }
        a.driven_work[2 * block + 1] = work;
    }
}

void release(Assembly& a, const std::vector<int>& nodes, int component)
{
    for (int n : nodes)
        a.held[n + component * lanes] = 0;
}

double reaction(const Assembly& a, const std::vector<int>& nodes, int component)
{
    double sum = 0.0;
    for (int n : nodes)
        sum -= a.force[n + component * lanes];
    return sum;
}

double side_displacement(const Assembly& a, int side, int component)
{
    double moment = 0.0, length = 0.0;
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_side[e] != side) continue;
        const auto n = edge_nodes(a, e);
        const double l = edge_length(a, e), *u = a.displacement.data() + component * lanes;
        moment += 0.5 * l * (u[n[0]] + u[n[1]]);
        length += l;
    }
    return moment / length;
}

double side_length(const Assembly& a, int side)
{
    double length = 0.0;
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_side[e] == side) length += edge_length(a, e);
    }
    return length;
}

void set_pressure(Assembly& a, int side, double pressure)
{
    check_not_negative("pressure", pressure, "Pa");
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_side[e] == side) a.edge_pressure[e] = pressure;
    }
}

namespace {

/// Pressure acts on an edge, or has acted until the last step.
bool is_pressed(const Assembly& a, int edge)
{
    const double* f = a.edge_force.data() + row_index(edge, 0, ContactRows::forces);
    return a.edge_pressure[edge] != 0.0 || f[0] != 0.0 || f[lanes] != 0.0;
}

}  // namespace

double update_edge_block(Assembly& a, int block, double dt)
{
    double work = 0.0;
    for (int e = block * lanes; e < std::min((block + 1) * lanes, a.edges); ++e) {
        if (!is_pressed(a, e)) continue;
        double* f = a.edge_force.data() + row_index(e, 0, ContactRows::forces);
        const int n0 = a.edge_nodes[row_index(e, 0, 2)], n1 = a.edge_nodes[row_index(e, 1, 2)];
        const Point p0 = a.position(n0), p1 = a.position(n1);
        const double* v = a.velocity.data();
        const double ex = (p1.x - p0.x) + dt * (v[n1] - v[n0]);
        const double ey = (p1.y - p0.y) + dt * (v[n1 + lanes] - v[n0 + lanes]);
        // the outward normal of a counter-clockwise edge is (ey, -ex) / length
        const double half = 0.5 * a.edge_pressure[e] * a.thickness;
        const double fx = -half * ey, fy = half * ex;
        work += 0.5 * dt
            * ((f[0] + fx) * (v[n0] + v[n1]) + (f[lanes] + fy) * (v[n0 + lanes] + v[n1 + lanes]));
        f[0] = f[2 * lanes] = fx;
        f[lanes] = f[3 * lanes] = fy;
    }
    return work;
}

}  // namespace flexpm
