// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/solid_motion.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/rows_of_four.hpp>

#include <algorithm>

namespace flexpm {

namespace {

/// The nodes of one grain, two in each row of lanes.
struct NodePairs {
    int pairs;
    double* displacement;
    double* velocity;
    const double* undamped;
    const double* force;
    const std::uint8_t* prescribed;
    const double* inverse_mass;  ///< of nodes
};

NodePairs node_pairs(SolidState& s, int block)
{
    Grains& grains = s.grains;
    const int first = grains.block_nodes[block];
    return { (grains.group(block).nodes + 1) / 2, grains.displacement.data() + first,
        grains.velocity.data() + first, s.undamped().velocity.data() + first,
        grains.force.data() + first, grains.prescribed.data() + first,
        grains.inverse_mass.data() + grains.scalar_index(first) };
}

FLEXPM_INLINE void move_pairs(const NodePairs& b, double dt)
{
    for (int i = 0; i < b.pairs * lanes; ++i)
        b.displacement[i] += dt * b.velocity[i];
}

FLEXPM_INLINE void clear(double* values, int count)
{
    for (int i = 0; i < count; ++i)
        values[i] = 0.0;
}

/// The values of two nodes, each for all of its components.
template <bool Wide> FLEXPM_INLINE void spread_pair(const double* of_nodes, double* to)
{
    const Two pair = *reinterpret_cast<const Two*>(of_nodes);
    if constexpr (Wide) {
        // GCC makes a shuffle to eight by way of memory, which waits for the cache
        const double a = pair[0], b = pair[1];
        *reinterpret_cast<Eight*>(to) = Eight { a, a, a, a, b, b, b, b };
    } else {
        row_of_four(to) = __builtin_shufflevector(pair, pair, 0, 0, 0, 0);
        row_of_four(to + 4) = __builtin_shufflevector(pair, pair, 1, 1, 1, 1);
    }
}

/// As of the plane (motion/node_motion.cpp): few grains have anything prescribed.
template <bool Wide, bool Measure, bool Prescribed>
FLEXPM_INLINE void integrate_lanes(const NodePairs& b, double dt, double damping, StepSums& total)
{
    StepSums sums;
    for (int pair = 0; pair < b.pairs; ++pair) {
        const int row = pair * lanes;
        const double *f = b.force + row, *undamped = b.undamped + row;
        double* v = b.velocity + row;
        alignas(64) double mass[lanes], prescribed[lanes] = {};
        spread_pair<Wide>(b.inverse_mass + 2 * pair, mass);
        if (Prescribed) std::copy_n(b.prescribed + row, lanes, prescribed);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            integrate_one<Measure, Prescribed>(
                { f[l], mass[l], prescribed[l], undamped[l] }, dt, damping, v[l], sums, l);
        }
    }
    sums.copy_to(total);
}

template <bool Wide, bool Measure>
FLEXPM_INLINE void integrate_pairs(const NodePairs& b, double dt, double damping, StepSums& sums)
{
    std::uint8_t any = 0;
    for (int i = 0; i < b.pairs * lanes; ++i)
        any |= b.prescribed[i];
    if (any != 0) {
        integrate_lanes<Wide, Measure, true>(b, dt, damping, sums);
    } else {
        integrate_lanes<Wide, Measure, false>(b, dt, damping, sums);
    }
}

}  // namespace

void move_grain(SolidState& s, int block, double dt)
{
    variant_of<move_pairs>()(node_pairs(s, block), dt);
}

void clear_forces(SolidState& s, int first, int end)
{
    Grains& grains = s.grains;
    const int from = grains.block_nodes[first];
    const int to =
        end < grains.blocks() ? grains.block_nodes[end] : static_cast<int>(grains.force.size());
    variant_of<clear>()(grains.force.data() + from, to - from);
}

void integrate_grain(
    SolidState& s, int block, double dt, double damping, bool measure, StepSums& sums)
{
    const auto integrate = measure
        ? variant_of<integrate_pairs<false, true>, integrate_pairs<true, true>>()
        : variant_of<integrate_pairs<false, false>, integrate_pairs<true, false>>();
    integrate(node_pairs(s, block), dt, damping, sums);
}

}  // namespace flexpm
