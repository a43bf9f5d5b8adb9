// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/forces/solid_sides.hpp>

#include <algorithm>

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

}  // namespace flexpm
