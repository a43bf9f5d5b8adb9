// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One rigid grain at a time: its motion and its geometry. SI units, rotations
/// counter-clockwise.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/plane_lanes/rigid_block.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

/// Rows of a block, for a step.
RigidRows rigid_rows(Assembly& a, int block);

/// Velocity of the centre [m/s] and spin [rad/s]; the nodes follow. Use this, not the velocities of
/// nodes, for a rigid grain.
void set_motion(Grains& grains, int grain, Point velocity, double spin, double dt);

/// Angle from the reference [rad].
double rotation_of(const Grains& grains, int grain);

/// Cosine and sine of half the angle from the reference, a quaternion's components.
struct HalfTurn {
    double cosine, sine;
};
HalfTurn half_turn(const Grains& grains, int grain);

/// The same from cos - 1 and sin of the whole angle, up to a cosine of half of it of
/// `least_half_cosine`: near half a turn the quotient would lose its digits.
constexpr double least_half_cosine = 0.5;
FLEXPM_INLINE HalfTurn half_turn_of(double along, double across)
{
    const double cosine = std::sqrt(std::max(1.0 + 0.5 * along, 0.0));
    return { cosine, 0.5 * across / cosine };
}

/// Section of the grain's cell in its reference shape.
PolygonSection cell_section(const Grains& grains, int grain);

}  // namespace flexpm
