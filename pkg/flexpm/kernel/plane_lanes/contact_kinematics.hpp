// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Relative motion of the points of a block of contacts and their forces on the nodes,
/// `lanes` at a time, paper Eqs. 5-12 and 18-19. Inlined into the functions that are compiled for
/// each instruction set.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/simd.hpp>
#include <flexpm/kernel/plane_lanes/prefetch.hpp>

#include <cmath>

namespace flexpm {

constexpr int most_points = 3;

/// The rows of one block of contacts.
struct ContactLanes {
    const double* reference;
    const double* displacement;
    const double* velocity;
    const double* centres;
    const int* nodes;
    const double* weight;
    const double* area;
    const double* branch;
    const double* inverse_edge_length;
    double* normal;
    double* state;
    const double* paired_slip;
    double* crack_slip;
    double* force;
    const double* law;      ///< LawRows
    bool dilating;          ///< whether any of these laws dilates
    bool weakening;         ///< whether the friction of any of them falls after a crack
    bool whole_edges;       ///< see StepPlan::whole_edges
    int prefetch_distance;  ///< blocks to the one to ask for; 0: the caches hold all
};

/// What a block works out for its points on the way, [point][lane].
struct PointMotion {
    alignas(64) double opening[most_points * lanes];
    alignas(64) double slip[most_points * lanes];
};

/// By halves: of a sum over lanes the compiler makes one or two instructions a lane.
FLEXPM_INLINE bool any_of(const std::int64_t* flags)
{
    typedef std::int64_t Half __attribute__((vector_size(4 * sizeof(std::int64_t)), may_alias));
    typedef std::int64_t Quarter __attribute__((vector_size(2 * sizeof(std::int64_t)), may_alias));
    const auto* half = reinterpret_cast<const Half*>(flags);
    const Half either = half[0] | half[1];
    const auto* quarter = reinterpret_cast<const Quarter*>(&either);
    const Quarter both = quarter[0] | quarter[1];
    return (both[0] | both[1]) != 0;
}

/// Whether a contact takes its normal from its edges: it has no branch, which marks it.
FLEXPM_INLINE bool has_normal_of_edge(const ContactLanes& b, int l)
{
    const Point branch = vector_at(b.branch, l);
    return (branch.x == 0.0) & (branch.y == 0.0);
}

/// Whether any contact of the block does.
FLEXPM_INLINE bool any_normal_of_edge(const ContactLanes& b)
{
    alignas(64) std::int64_t of_edge[lanes];
    for (int l = 0; l < lanes; ++l)
        of_edge[l] = has_normal_of_edge(b, l);
    return any_of(of_edge);
}

/// x and y of the nodes of a row, one node after the other, or the compiler runs out of registers
/// for the addresses. A row is stored at once: a load of it in one register would wait for two
/// halves.
FLEXPM_INLINE void gather_values(const double* from, const int* nodes, double* to)
{
    const double* from_y = from + component(0, 1);
    double* to_y = to + component(0, 1);
#pragma omp simd simdlen(8)
    for (int l = 0; l < lanes; ++l) {
        to[l] = from[nodes[l]];
        to_y[l] = from_y[nodes[l]];
    }
}

/// The same where y follows x.
template <bool Wide>
FLEXPM_INLINE void gather_pairs(const double* from, const int* pairs, double* to)
{
    unzip<Wide>([&](int i) { return *reinterpret_cast<const Two*>(from + pairs[i]); }, to);
}

/// A quantity at point `p` of an edge, less its value at the first end, from the difference of the
/// ends. `Whole`: three points, of weights 0, 1/2 and 1, on both sides.
template <bool Whole>
FLEXPM_INLINE double between_edges(const ContactLanes& b, int p, int l, double of_a, double of_b)
{
    if (Whole) return p == 0 ? 0.0 : p == 1 ? 0.5 * (of_b - of_a) : of_b - of_a;
    const double wa = b.weight[(2 * p) * lanes + l], wb = b.weight[(2 * p + 1) * lanes + l];
    return wb * of_b - wa * of_a;
}

/// Distance along the tangent between the places of a point on the two edges [m].
template <bool Whole> FLEXPM_INLINE double gap_along(const ContactLanes& b, int p, int l)
{
    const double slip = b.state[(p * point_rows + row_of<&PointState::slip>)*lanes + l];
    return Whole ? slip : slip - b.paired_slip[p * lanes + l];
}

/// Ask for the first rows, or all, of the block ahead of an array with `per_block` rows a block.
template <class T>
FLEXPM_INLINE void prefetch_ahead(const ContactLanes& b, const T* rows, int per_block, int first)
{
    if (b.prefetch_distance == 0) return;
    prefetch_rows(rows + b.prefetch_distance * per_block * lanes, first);
}
template <class T>
FLEXPM_INLINE void prefetch_ahead(const ContactLanes& b, const T* rows, int per_block)
{
    prefetch_ahead(b, rows, per_block, per_block);
}

/// A vector along the normal at the end of the step: between the centres, rows of x and y of a and
/// of b, or, where a contact has no branch, across the mean of the two edges.
template <bool OfEdges>
FLEXPM_INLINE Point direction(const ContactLanes& b, const double* centres, double dt, int l)
{
    const Point from_a = vector_at(centres, l), from_b = vector_at(centres, node_stride + l);
    const Point between = vector_at(b.branch, l) + (from_b - from_a);
    if (!OfEdges) return between;
    const auto way = [&](int node) {
        return vector_at(b.displacement, node) + dt * vector_at(b.velocity, node);
    };
    Point edges;
    for (int side = 0; side < 2; ++side) {
        const int n0 = b.nodes[(NodeRow::a0 + 2 * side) * lanes + l];
        const int n1 = b.nodes[(NodeRow::a1 + 2 * side) * lanes + l];
        const Point edge = vector_at(b.reference, n1) - vector_at(b.reference, n0);
        edges = edges + (edge + way(n1) - way(n0));
    }
    const bool of_edge = has_normal_of_edge(b, l);
    return { of_edge ? edges.y : between.x, of_edge ? -edges.x : between.y };
}

template <bool Whole> FLEXPM_INLINE double inverse_length_of_b(const ContactLanes& b, int l)
{
    return b.inverse_edge_length[(Whole ? 0 : lanes) + l];
}

/// Unit normals at the end of the step, and the points' increments along the mean of the old and
/// the new normal: with it the work of a turning contact is what its energy says to third order.
///
/// Deviation D24: both grains are compared in the middle of the gap between their places of a point
/// (the paper's one contact location, Eq. 9), to which each edge carries its own rotation: a pair
/// that turns as one body neither opens nor slips.
template <int Points, bool OfEdges, bool Whole, bool Wide>
FLEXPM_INLINE void move_points(const ContactLanes& b, double dt, PointMotion& motion)
{
    prefetch_ahead(b, b.nodes, NodeRow::count);
    prefetch_ahead(b, b.branch, dimension);
    prefetch_ahead(b, b.inverse_edge_length, 2, Whole ? 1 : 2);
    prefetch_ahead(b, b.normal, dimension);
    alignas(64) double velocities[4 * node_stride], centres[2 * node_stride];
    for (int n = NodeRow::a0; n <= NodeRow::b1; ++n)
        gather_values(b.velocity, b.nodes + n * lanes, velocities + n * node_stride);
    for (int side = 0; side < 2; ++side) {
        gather_pairs<Wide>(
            b.centres, b.nodes + (NodeRow::centre_a + side) * lanes, centres + side * node_stride);
    }
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const auto velocity = [&](int node) {
            return vector_at(velocities, node * node_stride + l);
        };
        const Point along_normal = direction<OfEdges>(b, centres, dt, l);
        const Point n = (1.0 / std::sqrt(dot(along_normal, along_normal))) * along_normal;
        const Point mean = 0.5 * dt * (vector_at(b.normal, l) + n);
        set_vector(b.normal, l, n);
        // the ends of a, those of b, and the first end of b against that of a
        const Point of_a = velocity(NodeRow::a1) - velocity(NodeRow::a0);
        const Point of_b = velocity(NodeRow::b1) - velocity(NodeRow::b0);
        const Point of_gap = velocity(NodeRow::b0) - velocity(NodeRow::a0);
        const double a_apart = dot(of_a, mean), a_along = cross(mean, of_a);
        const double b_apart = dot(of_b, mean), b_along = cross(mean, of_b);
        const double g_apart = dot(of_gap, mean), g_along = cross(mean, of_gap);
        const double turn = -0.5
            * (b.inverse_edge_length[l] * a_apart + inverse_length_of_b<Whole>(b, l) * b_apart);
        for (int p = 0; p < Points; ++p) {
            const double* state = b.state + p * point_rows * lanes + l;
            const double apart = g_apart + between_edges<Whole>(b, p, l, a_apart, b_apart);
            const double along = g_along + between_edges<Whole>(b, p, l, a_along, b_along);
            const double opening = state[row_of<&PointState::opening> * lanes],
                         slip = gap_along<Whole>(b, p, l);
            motion.opening[p * lanes + l] = apart + turn * (slip + 0.5 * (along - turn * opening));
            motion.slip[p * lanes + l] = along - turn * (opening + 0.5 * (apart + turn * slip));
        }
    }
}

/// Share of the second end of each edge in what acts on its points, along one direction.
struct EndShares {
    double a = 0.0, b = 0.0;

    template <bool Whole>
    FLEXPM_INLINE void add(const ContactLanes& rows, int p, int l, double force)
    {
        if (Whole) {
            if (p > 0) a += p == 1 ? 0.5 * force : force;
            b = a;
        } else {
            a += rows.weight[(2 * p) * lanes + l] * force;
            b += rows.weight[(2 * p + 1) * lanes + l] * force;
        }
    }
};

/// Vector from its components along a unit normal and along the tangent that lies counter-clockwise
/// of it.
FLEXPM_INLINE Point in_frame(Point normal, double along_normal, double along_tangent)
{
    return { along_normal * normal.x - along_tangent * normal.y,
        along_normal * normal.y + along_tangent * normal.x };
}

/// Tractions to nodal forces by the shape functions of the two edges, Eqs. 18-19. They act in the
/// middle of the gap: each edge takes half of the gap's moment by a couple on its ends.
template <int Points, bool Whole>
FLEXPM_INLINE void spread_forces(const ContactLanes& b, const double* normal, const double* shear)
{
    alignas(64) double rows[Contacts::force_values * lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        // along the normal and along the tangent
        double moment = 0.0, sum_n = 0.0, sum_s = 0.0;
        EndShares end_n, end_s;
        for (int p = 0; p < Points; ++p) {
            const double area = b.area[(Whole && p == 2 ? 0 : p) * lanes + l];
            const double fn = area * normal[p * lanes + l], fs = area * shear[p * lanes + l];
            const double* state = b.state + p * point_rows * lanes + l;
            moment +=
                state[row_of<&PointState::opening> * lanes] * fs - gap_along<Whole>(b, p, l) * fn;
            sum_n += fn;
            sum_s += fs;
            end_n.add<Whole>(b, p, l, fn);
            end_s.add<Whole>(b, p, l, fs);
        }
        const double a_n = end_n.a - 0.5 * moment * b.inverse_edge_length[l];
        const double b_n = end_n.b + 0.5 * moment * inverse_length_of_b<Whole>(b, l);
        const Point n = vector_at(b.normal, l);
        const Point sum = in_frame(n, sum_n, sum_s);
        const Point on_a1 = in_frame(n, a_n, end_s.a), on_b1 = in_frame(n, b_n, end_s.b);
        set_vector(rows, NodeRow::a0 * node_stride + l, sum - on_a1);
        set_vector(rows, NodeRow::a1 * node_stride + l, on_a1);
        set_vector(rows, NodeRow::b0 * node_stride + l, on_b1 - sum);
        set_vector(rows, NodeRow::b1 * node_stride + l, { -on_b1.x, -on_b1.y });
    }
    for (int l = 0; l < lanes; l += 4) {
        for (int r = 0; r < Contacts::force_values; r += 4)
            transpose(rows + r * lanes + l, lanes, b.force + l * Contacts::force_values + r,
                Contacts::force_values);
    }
}

}  // namespace flexpm
