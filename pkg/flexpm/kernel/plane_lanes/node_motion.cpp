// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/plane_lanes/node_motion.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>

#include <algorithm>

namespace flexpm {

namespace {

FLEXPM_INLINE void move_rows(const double* velocity, int values, double dt, double* displacement)
{
    for (int i = 0; i < values; ++i)
        displacement[i] += dt * velocity[i];
}

bool prescribes_any(const NodeRows& b)
{
    std::uint8_t any = 0;
    for (int i = 0; i < node_stride * b.nodes; ++i)
        any |= b.prescribed[i];
    return any != 0;
}

/// Few blocks lie on a boundary: all others are integrated without looking at `prescribed`. Bytes
/// and doubles in one loop are not vectorised, hence the copy; the sums are a local, which no row
/// aliases.
template <bool Measure, bool Prescribed>
FLEXPM_INLINE void integrate_lanes(const NodeRows& b, double dt, double damping, StepSums& total)
{
    StepSums sums;
    for (int n = 0; n < b.nodes; ++n) {
        const double* f = b.force + n * node_stride;
        double* v = b.velocity + n * node_stride;
        const double* undamped = b.undamped_velocity + n * node_stride;
        const double* inverse_mass = b.inverse_mass + n * lanes;
        alignas(64) double prescribed[node_stride] = {};
        if (Prescribed) std::copy_n(b.prescribed + n * node_stride, node_stride, prescribed);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            for (int axis = 0; axis < dimension; ++axis) {
                const int i = component(l, axis);
                integrate_one<Measure, Prescribed>(
                    { f[i], inverse_mass[l], prescribed[i], undamped[i] }, dt, damping, v[i], sums,
                    l);
            }
        }
    }
    sums.copy_to(total);
}

template <bool Measure>
FLEXPM_INLINE void integrate_block(const NodeRows& b, double dt, double damping, StepSums& sums)
{
    if (prescribes_any(b)) {
        integrate_lanes<Measure, true>(b, dt, damping, sums);
    } else {
        integrate_lanes<Measure, false>(b, dt, damping, sums);
    }
}

}  // namespace

NodeRows node_rows(Assembly& a, int block)
{
    Grains& grains = a.grains;
    const int first = grains.block_nodes[block];
    return { grains.group(block).nodes, grains.displacement.data() + first,
        grains.velocity.data() + first, a.undamped().velocity.data() + first,
        grains.force.data() + first, grains.prescribed.data() + first,
        grains.inverse_mass.data() + first / dimension };
}

void move_nodes(const NodeRows& b, double dt)
{
    variant_of<move_rows>()(b.velocity, node_stride * b.nodes, dt, b.displacement);
}

void integrate_nodes(const NodeRows& b, double dt, double damping, bool measure, StepSums& sums)
{
    const auto integrate =
        measure ? variant_of<integrate_block<true>>() : variant_of<integrate_block<false>>();
    integrate(b, dt, damping, sums);
}

}  // namespace flexpm
