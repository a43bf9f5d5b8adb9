// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One rigid grain at a time.
#include <flexpm/kernel/motion/rigid_grain.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexpm {

namespace {

void need_rigid(const Assembly& a, int grain)
{
    if (!a.is_rigid(grain)) {
        refuse("grain", grain, "", "is deformable, only a rigid grain has a spin; drive its nodes");
    }
}

}  // namespace

RigidRows rigid_rows(Assembly& a, int block)
{
    const int first = a.block_nodes[block], nodes = a.group(block).nodes;
    const int centre = first + 2 * lanes * (nodes - 1);
    return { nodes, a.reference.data() + first, a.displacement.data() + first,
        a.velocity.data() + first, a.force.data() + first, a.held.data() + centre,
        a.inverse_mass.data() + centre / 2, a.rotation.data() + 3 * lanes * block,
        a.spin.data() + lanes * block, a.spin_held.data() + lanes * block,
        a.inverse_inertia.data() + lanes * block };
}

int rigid_index(const Assembly& a, int grain, int row, int rows)
{
    const int slot = a.grain_slot[grain];
    return (slot / lanes * rows + row) * lanes + slot % lanes;
}

void set_motion(Assembly& a, int grain, Point velocity, double spin, double dt)
{
    need_rigid(a, grain);
    check_finite("velocity", velocity.x, "m/s");
    check_finite("velocity", velocity.y, "m/s");
    check_finite("spin", spin, "rad/s");
    const int centre = a.centre(grain);
    a.velocity[centre] = velocity.x;
    a.velocity[centre + lanes] = velocity.y;
    a.spin[rigid_index(a, grain)] = spin;
    spread_velocities(rigid_rows(a, a.grain_slot[grain] / lanes), dt);
}

void drive_spin(Assembly& a, int grain, double spin, double dt)
{
    const int centre = a.centre(grain);
    set_motion(a, grain, { a.velocity[centre], a.velocity[centre + lanes] }, spin, dt);
    a.spin_held[rigid_index(a, grain)] = 1;
}

double rotation_of(const Assembly& a, int grain) { return a.rotation[rigid_index(a, grain, 2, 3)]; }

HalfTurn half_turn(const Assembly& a, int grain)
{
    const HalfTurn half = half_turn_of(
        a.rotation[rigid_index(a, grain, 0, 3)], a.rotation[rigid_index(a, grain, 1, 3)]);
    if (half.cosine >= least_half_cosine) return half;
    const double angle = 0.5 * rotation_of(a, grain);
    return { std::cos(angle), std::sin(angle) };
}

PolygonSection cell_section(const Assembly& a, int grain)
{
    const auto reference = [&](int node) {
        return Point { a.reference[node], a.reference[node + lanes] };
    };
    std::vector<Point> corners(a.group(a.grain_slot[grain] / lanes).vertices);
    for (std::size_t k = 0; k < corners.size(); ++k)
        corners[k] = reference(a.node(grain, static_cast<int>(k)));
    return polygon_section(corners, reference(a.centre(grain)));
}

Resultant resultant_on(const Assembly& a, int grain)
{
    Resultant sum = { { 0.0, 0.0 }, 0.0 };
    const Point c = a.position(a.centre(grain));
    for (int n = 0; n < a.nodes_of(grain); ++n) {
        const Point f = force_of(a, a.node(grain, n)), p = a.position(a.node(grain, n));
        sum.force.x += f.x;
        sum.force.y += f.y;
        sum.moment += (p.x - c.x) * f.y - (p.y - c.y) * f.x;
    }
    return sum;
}

}  // namespace flexpm
