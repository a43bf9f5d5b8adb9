// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion of the centres, `lanes` at a time.
#include <flexpm/kernel/motion/centre_motion.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>

namespace flexpm {

namespace {

FLEXPM_INLINE void half_turns(const double* rotation, double* cosine, double* sine)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const HalfTurn half = half_turn_of(rotation[l], rotation[lanes + l]);
        cosine[l] = half.cosine;
        sine[l] = half.sine;
    }
}

void find_turns(const Assembly& a, int block, CentreMotion& motion)
{
    variant_of<half_turns>()(
        a.rotation.data() + 3 * lanes * block, motion.half_cosine, motion.half_sine);
    for (int l = 0; l < lanes; ++l) {
        motion.spin[l] = a.spin[lanes * block + l];
        const int grain = a.slot_grain[lanes * block + l];
        if (motion.half_cosine[l] >= least_half_cosine || grain < 0) continue;
        const HalfTurn half = half_turn(a, grain);
        motion.half_cosine[l] = half.cosine;
        motion.half_sine[l] = half.sine;
    }
}

FLEXPM_INLINE void move_pairs(const double* u, const double* v, double dt, double* pairs)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        pairs[2 * l] = u[l] + dt * v[l];
        pairs[2 * l + 1] = u[lanes + l] + dt * v[lanes + l];
    }
}

}  // namespace

void predict_centres(Assembly& a, int block, double dt)
{
    const int first = a.block_nodes[block] + 2 * lanes * a.group(block).vertices;
    variant_of<move_pairs>()(a.displacement.data() + first, a.velocity.data() + first, dt,
        a.next_centre.data() + 2 * lanes * block);
}

void find_centre_motion(const Assembly& a, int block, CentreMotion& motion)
{
    const MeshGroup& group = a.group(block);
    const int first = a.block_nodes[block] + 2 * lanes * group.vertices;
    const double *reference = a.reference.data() + first, *u = a.displacement.data() + first;
    const double* v = a.velocity.data() + first;
    for (int l = 0; l < lanes; ++l) {
        motion.x[l] = reference[l] + u[l];
        motion.y[l] = reference[lanes + l] + u[lanes + l];
        motion.vx[l] = v[l];
        motion.vy[l] = v[lanes + l];
    }
    if (group.rigid) find_turns(a, block, motion);
}

}  // namespace flexpm
