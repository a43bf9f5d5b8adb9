// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion of the centres, `lanes` at a time.
#include <flexpm/kernel/plane_lanes/centre_motion.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

namespace flexpm {

namespace {

FLEXPM_INLINE void half_turns(const double* rotation, double* cosine, double* sine)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const HalfTurn half = half_turn_of(rotation[RotationRow::cosine_less_one * lanes + l],
            rotation[RotationRow::sine * lanes + l]);
        cosine[l] = half.cosine;
        sine[l] = half.sine;
    }
}

void find_turns(const Grains& grains, int block, CentreMotion& motion)
{
    variant_of<half_turns>()(grains.rotation.data() + RotationRow::count * lanes * block,
        motion.half_cosine, motion.half_sine);
    for (int l = 0; l < lanes; ++l) {
        motion.spin[l] = grains.spin[lanes * block + l];
        const int grain = grains.in_slot[lanes * block + l];
        if (motion.half_cosine[l] >= least_half_cosine || grain < 0) continue;
        const HalfTurn half = half_turn(grains, grain);
        motion.half_cosine[l] = half.cosine;
        motion.half_sine[l] = half.sine;
    }
}

/// Offset of the centres of a block's grains in the node arrays.
int centres_of(const Grains& grains, int block)
{
    return grains.block_nodes[block] + node_stride * grains.group(block).vertices;
}

FLEXPM_INLINE void move_pairs(const double* u, const double* v, double dt, double* pairs)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const int x = component(l, 0), y = component(l, 1);
        pairs[dimension * l] = u[x] + dt * v[x];
        pairs[dimension * l + 1] = u[y] + dt * v[y];
    }
}

}  // namespace

void predict_centres(const Grains& grains, int block, double dt, Array<double>& next_centre)
{
    const int first = centres_of(grains, block);
    variant_of<move_pairs>()(grains.displacement.data() + first, grains.velocity.data() + first, dt,
        next_centre.data() + dimension * lanes * block);
}

void find_centre_motion(const Grains& grains, int block, CentreMotion& motion)
{
    const int first = centres_of(grains, block);
    for (int l = 0; l < lanes; ++l) {
        const Point p = grains.point_at(first + l), v = vector_at(grains.velocity, first + l);
        motion.x[l] = p.x;
        motion.y[l] = p.y;
        motion.vx[l] = v.x;
        motion.vy[l] = v.y;
    }
    if (grains.group(block).rigid) find_turns(grains, block, motion);
}

}  // namespace flexpm
