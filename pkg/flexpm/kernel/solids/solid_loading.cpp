// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_loading.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/solids/face_forces.hpp>
#include <flexpm/kernel/solids/solid_energies.hpp>

#include <algorithm>
#include <string>

namespace flexpm {

std::vector<int> side_nodes(const SolidState& s, SolidSide side)
{
    std::vector<int> nodes;
    for (std::size_t f = 0; f < s.surface.side.size(); ++f) {
        if (s.surface.side[f] != static_cast<int>(side)) continue;
        nodes.insert(nodes.end(), s.surface.nodes[f].begin(), s.surface.nodes[f].end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

void prescribe(SolidState& s, const std::vector<int>& nodes, int axis, double velocity)
{
    for (int n : nodes) {
        s.grains.velocity[s.grains.component(n, axis)] = velocity;
        s.grains.prescribed[s.grains.component(n, axis)] = 1;
    }
}

double holding_force(const SolidState& s, const std::vector<int>& nodes, int axis)
{
    double sum = 0.0;
    for (int n : nodes)
        sum -= s.grains.force[s.grains.component(n, axis)];
    return sum;
}

void begin_from(SolidState& s, const std::vector<Vector>& field, double extent, double rate)
{
    if (!s.bodies.empty()) {
        refuse("begin_from: rigid grains", static_cast<double>(s.bodies.size()), "",
            "must be 0; a field of nodes bends them");
    }
    std::size_t wanted = 0;
    for (int g = 0; g < s.grains.count; ++g)
        wanted += s.grains.nodes_of(g);
    if (field.size() != wanted) {
        refuse("begin_from: vectors of the field", static_cast<double>(field.size()), "",
            "must be those of " + std::to_string(wanted) + " nodes");
    }
    auto next = field.begin();
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        set_space_vector(s.grains.displacement, node, extent * *next);
        set_space_vector(s.grains.velocity, node, rate * *next);
        set_space_vector(s.undamped.velocity, node, rate * *next);
        ++next;
    });
    if (update_face_blocks(s, 0, s.contacts.blocks()) > 0) {
        refuse("begin_from: extent", extent, "",
            "must leave the sides of each contact opposite to each other");
    }
    const Energies there = energies(s);
    s.ledger.initial =
        there.elastic + there.damage + there.friction + kinetic_of_velocities(s.grains);
}

}  // namespace flexpm
