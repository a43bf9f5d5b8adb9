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

void require_side(const Assembly& a, int side)
{
    const auto& sides = a.facets.side;
    if (side >= 0 && std::find(sides.begin(), sides.end(), side) != sides.end()) return;
    refuse("side", side, "", "has no boundary edges; name a side of the outline");
}

bool is_on_side(const Assembly& a, int facet, int side)
{
    return a.facets.side[facet] == side && !a.grains.erased[a.facets.grain[facet]];
}

bool has_facets(const Assembly& a, int side)
{
    for (int e = 0; e < a.facets.count; ++e) {
        if (is_on_side(a, e, side)) return true;
    }
    return false;
}

std::vector<int> side_nodes(const Assembly& a, int side)
{
    require_side(a, side);
    std::vector<int> nodes;
    for (int e = 0; e < a.facets.count; ++e) {
        if (!is_on_side(a, e, side)) continue;
        for (int n : a.facets.nodes(e))
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
    for (int e = 0; e < a.facets.count; ++e) {
        if (!is_on_side(a, e, side)) continue;
        const auto [n0, n1] = a.facets.nodes(e);
        const double l = facet_place(a, e).length();
        moment += 0.5 * l * (moved[component(n0, axis)] + moved[component(n1, axis)]);
        length += l;
    }
    return moment / length;
}

double side_length(const Assembly& a, int side)
{
    double length = 0.0;
    for (int e = 0; e < a.facets.count; ++e) {
        if (a.facets.side[e] == side) length += facet_place(a, e).length();
    }
    return length;
}

void set_pressure(Assembly& a, int side, double pressure)
{
    require_side(a, side);
    check_not_negative("pressure", pressure, "Pa");
    for (int e = 0; e < a.facets.count; ++e) {
        if (is_on_side(a, e, side)) a.facets.pressure[e] = pressure;
    }
}

namespace {

/// Whether pressure acts on a facet, or has acted until the last step.
bool is_pressed(const Facets& facets, int facet)
{
    const Point f = vector_at(facets.forces, Facets::force_index(facet, FacetRow::of_pressure));
    return facets.pressure[facet] != 0.0 || f.x != 0.0 || f.y != 0.0;
}

/// Update the forces of the pressure on a facet; returns their work [J].
double press_facet(Assembly& a, int facet, double dt)
{
    const auto [n0, n1] = a.facets.nodes(facet);
    const Point v0 = vector_at(a.grains.velocity, n0), v1 = vector_at(a.grains.velocity, n1);
    const Point way = (a.grains.point_at(n1) - a.grains.point_at(n0)) + dt * (v1 - v0);
    // what has come loose lies no more in the skin that the pressure acts on, deviation D57
    const double pressure = a.grains.loose[a.facets.grain[facet]] ? 0.0 : a.facets.pressure[facet];
    const Point now = across_facet(way, a.area_of(0.5 * pressure));
    const int first = Facets::force_index(facet, FacetRow::of_pressure);
    const double work = 0.5 * dt * dot(vector_at(a.facets.forces, first) + now, v0 + v1);
    set_vector(a.facets.forces, first, now);
    set_vector(a.facets.forces, first + node_stride, now);
    return work;
}

}  // namespace

double update_facet_block(Assembly& a, int block, double dt)
{
    double work = 0.0;
    for (int e = block * lanes; e < std::min((block + 1) * lanes, a.facets.count); ++e) {
        if (is_pressed(a.facets, e)) work += press_facet(a, e, dt);
    }
    return work;
}

}  // namespace flexpm
