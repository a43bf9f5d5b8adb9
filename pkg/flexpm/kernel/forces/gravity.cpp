// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Gravity on real masses.
#include <flexpm/kernel/forces/gravity.hpp>

#include <flexpm/kernel/core/require.hpp>

namespace flexpm {

namespace {

/// 0 of nodes that follow a rigid grain and of padded lanes.
double mass_at(const Assembly& a, int scalar)
{
    return a.inverse_mass[scalar] > 0.0 ? 1.0 / a.inverse_mass[scalar] : 0.0;
}

}  // namespace

void set_gravity(Assembly& a, Point acceleration)
{
    check_finite("gravity", acceleration.x, "m/s^2");
    check_finite("gravity", acceleration.y, "m/s^2");
    const double before = potential_energy(a);
    a.gravity = acceleration;
    a.initial_energy += potential_energy(a) - before;
}

void add_weight(Assembly& a, int block)
{
    const int first = a.block_nodes[block];
    for (int n = 0; n < a.group(block).nodes; ++n) {
        for (int l = 0; l < lanes; ++l) {
            const int i = first + 2 * lanes * n + l;
            const double mass = mass_at(a, scalar_index(i));
            a.force[i] += mass * a.gravity.x;
            a.force[i + lanes] += mass * a.gravity.y;
        }
    }
}

double potential_energy(const Assembly& a)
{
    double total = 0.0;
    if (a.gravity.x == 0.0 && a.gravity.y == 0.0)
        return total;  // most tests, at each measured step
    for (int g = 0; g < a.grains; ++g) {
        for (int n = 0; n < a.nodes_of(g); ++n) {
            const int i = a.node(g, n);
            total -= mass_at(a, scalar_index(i))
                * (a.gravity.x * a.displacement[i] + a.gravity.y * a.displacement[i + lanes]);
        }
    }
    return total;
}

}  // namespace flexpm
