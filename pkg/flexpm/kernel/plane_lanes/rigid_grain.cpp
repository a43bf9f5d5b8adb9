// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <cmath>
#include <vector>

namespace flexpm {

namespace {

void need_rigid(const Grains& grains, int grain)
{
    if (!grains.is_rigid(grain)) {
        refuse("grain", grain, "",
            "is deformable, only a rigid grain has a spin; prescribe its nodes");
    }
}

/// Rows of a block without what a step needs besides.
RigidRows rows_of(Grains& grains, int block)
{
    const int first = grains.block_nodes[block], nodes = grains.group(block).nodes;
    const int centre = first + node_stride * (nodes - 1);
    return { nodes, grains.reference.data() + first, grains.displacement.data() + first,
        grains.velocity.data() + first, nullptr, grains.force.data() + first,
        grains.prescribed.data() + centre, grains.inverse_mass.data() + centre / dimension,
        grains.rotation.data() + RotationRow::count * lanes * block,
        grains.spin.data() + lanes * block, nullptr, grains.spin_prescribed.data() + lanes * block,
        grains.inverse_inertia.data() + lanes * block };
}

}  // namespace

RigidRows rigid_rows(Assembly& a, int block)
{
    RigidRows rows = rows_of(a.grains, block);
    const GrainMotion& undamped = a.undamped();
    rows.undamped_velocity =
        undamped.velocity.data() + (rows.prescribed - a.grains.prescribed.data());
    rows.undamped_spin = undamped.spin.data() + lanes * block;
    return rows;
}

void set_motion(Grains& grains, int grain, Point velocity, double spin, double dt)
{
    need_rigid(grains, grain);
    check_finite("velocity", velocity.x, "m/s");
    check_finite("velocity", velocity.y, "m/s");
    check_finite("spin", spin, "rad/s");
    const int centre = grains.centre(grain);
    set_vector(grains.velocity, centre, velocity);
    grains.spin[grains.slot[grain]] = spin;
    spread_velocities(rows_of(grains, grains.block_of(grain)), dt);
}

double rotation_of(const Grains& grains, int grain)
{
    return grains.rotation[row_index(grains.slot[grain], RotationRow::angle, RotationRow::count)];
}

HalfTurn half_turn(const Grains& grains, int grain)
{
    const auto row = [&](int row) {
        return grains.rotation[row_index(grains.slot[grain], row, RotationRow::count)];
    };
    const HalfTurn half = half_turn_of(row(RotationRow::cosine_less_one), row(RotationRow::sine));
    if (half.cosine >= least_half_cosine) return half;
    const double angle = 0.5 * rotation_of(grains, grain);
    return { std::cos(angle), std::sin(angle) };
}

PolygonSection cell_section(const Grains& grains, int grain)
{
    std::vector<Point> corners(grains.vertices_of(grain));
    for (std::size_t k = 0; k < corners.size(); ++k)
        corners[k] = vector_at(grains.reference, grains.node(grain, static_cast<int>(k)));
    return polygon_section(corners, vector_at(grains.reference, grains.centre(grain)));
}

}  // namespace flexpm
