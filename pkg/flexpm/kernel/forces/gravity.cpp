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

void set_gravity(Assembly& a, Vector acceleration)
{
    check_finite("gravity", acceleration.x, "m/s^2");
    check_finite("gravity", acceleration.y, "m/s^2");
    check_finite("gravity", acceleration.z, "m/s^2");
    const double before = potential_energy(a);
    a.gravity = acceleration;
    a.ledger.initial += potential_energy(a) - before;
}

void add_weight(Assembly& a, int block)
{
    const int first = a.grains.block_nodes[block];
    for (int n = 0; n < a.grains.group(block).nodes; ++n) {
        for (int l = 0; l < lanes; ++l) {
            const int i = first + node_stride * n + l;
            const double mass = mass_at(a.grains, scalar_index(i));
            a.grains.force[i] += mass * a.gravity.x;
            a.grains.force[component(i, 1)] += mass * a.gravity.y;
        }
    }
}

double potential_energy(const Assembly& a)
{
    double total = 0.0;
    if (!a.has_gravity()) return total;  // most tests, at each measured step
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            const int i = a.grains.node(g, n);
            total -= mass_at(a.grains, scalar_index(i))
                * dot(a.gravity, vector_at(a.grains.displacement, i));
        }
    }
    return total;
}

}  // namespace flexpm
