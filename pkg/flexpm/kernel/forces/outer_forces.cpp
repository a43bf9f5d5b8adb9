// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/forces/outer_forces.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace flexpm {

OuterForces forces_on_wall(const Assembly& a, const std::vector<char>& inside)
{
    std::map<int, Point> sums;
    for (int c = 0; c < a.contacts.count; ++c) {
        const auto [first, second] = a.contacts.pairs[c];
        if (a.contacts.erased[c] || inside[first] == inside[second]) continue;
        const int side = inside[first] ? 1 : 0;
        for (int corner = 0; corner < a.contacts.corners_of(c); ++corner) {
            Point& sum = sums[a.contacts.node(c, side, corner)];
            sum = sum + a.contacts.force(c, side, corner);
        }
    }
    OuterForces found;
    for (const auto& [node, force] : sums) {
        found.nodes.push_back(node);
        found.forces.push_back(force);
    }
    return found;
}

void check(const Assembly& a, const OuterForces& outer)
{
    if (outer.nodes.size() != outer.forces.size()) {
        refuse("outer forces", static_cast<double>(outer.forces.size()), "",
            "must be " + std::to_string(outer.nodes.size()) + ", one for each node");
    }
    const int end = static_cast<int>(a.grains.displacement.size()) - a.grains.component(0, 1);
    int last = -1;
    for (int node : outer.nodes) {
        if (!(node > last && node < end))
            refuse("node of outer forces", node, "", "must be one of the assembly, in their order");
        last = node;
    }
}

void add_outer_forces(Assembly& a, int block, const OuterForces& outer)
{
    Grains& grains = a.grains;
    const int first = grains.block_nodes[block];
    const int end = first + node_stride * grains.group(block).nodes;
    const auto begin = std::lower_bound(outer.nodes.begin(), outer.nodes.end(), first);
    for (auto at = begin; at != outer.nodes.end() && *at < end; ++at) {
        const Point force = outer.part * outer.forces[at - outer.nodes.begin()];
        grains.set_vector(grains.force, *at, grains.force_at(*at) + force);
    }
}

double work_of(const Assembly& a, const OuterForces& outer, double dt)
{
    double power = 0.0;
    for (std::size_t i = 0; i < outer.nodes.size(); ++i)
        power += dot(outer.forces[i], a.grains.velocity_at(outer.nodes[i]));
    return 0.5 * dt * (outer.before + outer.part) * power;
}

}  // namespace flexpm
