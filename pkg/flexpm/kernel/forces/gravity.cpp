// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Gravity on real masses.
#include <flexpm/kernel/forces/gravity.hpp>

#include <flexpm/kernel/core/require.hpp>

namespace flexpm {

namespace {

/// 0 of nodes that follow a rigid grain and of padded lanes.
double mass_at(const Grains& grains, int scalar)
{
    return grains.inverse_mass[scalar] > 0.0 ? 1.0 / grains.inverse_mass[scalar] : 0.0;
}

}  // namespace

void set_gravity(BondedState& s, Vector acceleration)
{
    check_finite("gravity", acceleration.x, "m/s^2");
    check_finite("gravity", acceleration.y, "m/s^2");
    check_finite("gravity", acceleration.z, "m/s^2");
    const double before = potential_energy(s);
    s.gravity = acceleration;
    s.ledger.initial += potential_energy(s) - before;
}

void add_weight(BondedState& s, int block)
{
    Grains& grains = s.grains;
    const Layout layout = grains.layout;
    const double along[] = { s.gravity.x, s.gravity.y, s.gravity.z };
    for (int n = 0; n < grains.group(block).nodes; ++n) {
        for (int l = 0; l < layout.grains_per_block; ++l) {
            const int node = grains.block_nodes[block] + layout.node_stride * n + l;
            const double mass = mass_at(grains, layout.scalar_index(node));
            for (int axis = 0; axis < layout.dimension; ++axis)
                grains.force[layout.component(node, axis)] += mass * along[axis];
        }
    }
}

double potential_energy(const BondedState& s)
{
    double total = 0.0;
    if (!s.has_gravity()) return total;  // most tests, at each measured step
    const Grains& grains = s.grains;
    for (int g = 0; g < grains.count; ++g) {
        for (int n = 0; n < grains.nodes_of(g); ++n) {
            const int i = grains.node(g, n);
            total -= mass_at(grains, grains.scalar_index(i))
                * dot(s.gravity, grains.vector(grains.displacement, i));
        }
    }
    return total;
}

}  // namespace flexpm
