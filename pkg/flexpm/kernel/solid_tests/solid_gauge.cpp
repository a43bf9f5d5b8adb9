// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solid_tests/solid_gauge.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <cmath>

namespace flexpm {

SolidSection section_at(const SolidState& s, double place, Vector direction, double half_width)
{
    SolidSection found;
    for (int g = 0; g < s.grains.count; ++g) {
        for (int k = 0; k < s.grains.nodes_of(g); ++k) {
            const int node = s.grains.node(g, k);
            const double along = dot(space_vector(s.grains.reference, node), direction);
            if (!(std::fabs(along - place) <= half_width)) continue;
            found.nodes.push_back(node);
            found.place += along;
        }
    }
    if (found.nodes.empty()) refuse("nodes in a section", 0.0, "", "must be at least 1");
    found.place /= static_cast<double>(found.nodes.size());
    return found;
}

double mean_way(const SolidState& s, const std::vector<int>& nodes, Vector direction)
{
    if (nodes.empty()) refuse("nodes of a gauge", 0.0, "", "must be at least 1");
    const int last = static_cast<int>(s.grains.displacement.size()) - s.grains.layout.node_stride;
    double sum = 0.0;
    for (int node : nodes) {
        if (node < 0 || node > last)
            refuse("node of a gauge", node, "", "must be one of section_at()");
        sum += dot(space_vector(s.grains.displacement, node), direction);
    }
    return sum / static_cast<double>(nodes.size());
}

}  // namespace flexpm
