// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Relative motion of the points of a block of contacts and their forces on the nodes, `lanes`
/// at a time, paper Eqs. 5-12 and 18-19. Inlined into the functions that are compiled for each
/// instruction set.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/simd.hpp>
#include <flexpm/kernel/forces/prefetch.hpp>

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
    const double* span;
    const double* reach;
    double* normal;
    double* state;
    double* force;
    const double* law;  ///< LawRows
    bool whole_edges;   ///< see Assembly::whole_edges
    int ahead;          ///< blocks from this one to the one to ask for; 0: the caches hold all
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

/// A contact of the block takes its normal from its edges: it has no span, which marks it.
FLEXPM_INLINE bool any_normal_of_edge(const ContactLanes& b)
{
    alignas(64) std::int64_t of_edge[lanes];
    for (int l = 0; l < lanes; ++l)
        of_edge[l] = (b.span[l] == 0.0) & (b.span[lanes + l] == 0.0);
    return any_of(of_edge);
}

/// x and y of the nodes of a row, one node after the other, or the compiler runs out of registers for
/// the addresses. A row is stored at once: a load of it in one register would wait for two halves.
FLEXPM_INLINE void gather_values(const double* from, const int* nodes, double* to)
{
#pragma omp simd simdlen(8)
    for (int l = 0; l < lanes; ++l) {
        to[l] = from[nodes[l]];
        to[lanes + l] = from[nodes[l] + lanes];
    }
}

/// The same where y follows x.
template <bool Wide>
FLEXPM_INLINE void gather_pairs(const double* from, const int* pairs, double* to)
{
    unzip<Wide>([&](int i) { return *reinterpret_cast<const Two*>(from + pairs[i]); }, to);
}

/// A quantity at point `p` of an edge, less its value at the first end, from the difference of the ends.
/// `Whole`: three points, of weights 0, 1/2 and 1, on both sides.
template <bool Whole>
FLEXPM_INLINE double between_edges(const ContactLanes& b, int p, int l, double of_a, double of_b)
{
    if (Whole) return p == 0 ? 0.0 : p == 1 ? 0.5 * (of_b - of_a) : of_b - of_a;
    const double wa = b.weight[(2 * p) * lanes + l], wb = b.weight[(2 * p + 1) * lanes + l];
    return wb * of_b - wa * of_a;
}

/// Ask for the first rows, or all, of the block ahead of an array with `per_block` rows a block.
template <class T>
FLEXPM_INLINE void fetch_ahead(const ContactLanes& b, const T* rows, int per_block, int first)
{
    if (b.ahead != 0) fetch_rows(rows + b.ahead * per_block * lanes, first);
}
template <class T>
FLEXPM_INLINE void fetch_ahead(const ContactLanes& b, const T* rows, int per_block)
{
    fetch_ahead(b, rows, per_block, per_block);
}

/// A vector along the normal at the end of the step: between the centres, rows of x and y of a and of b,
/// or, where a contact has no span, across the mean of the two edges.
template <bool OfEdges>
FLEXPM_INLINE Point direction(const ContactLanes& b, const double* centres, double dt, int l)
{
    const double dx = b.span[l] + (centres[2 * lanes + l] - centres[l]);
    const double dy = b.span[lanes + l] + (centres[3 * lanes + l] - centres[lanes + l]);
    if (!OfEdges) return { dx, dy };
    const double *u = b.displacement, *v = b.velocity;
    double ex = 0.0, ey = 0.0;
    for (int side = 0; side < 2; ++side) {
        const int n0 = b.nodes[2 * side * lanes + l], n1 = b.nodes[(2 * side + 1) * lanes + l];
        ex += (b.reference[n1] - b.reference[n0]) + (u[n1] + dt * v[n1]) - (u[n0] + dt * v[n0]);
        ey += (b.reference[n1 + lanes] - b.reference[n0 + lanes])
            + (u[n1 + lanes] + dt * v[n1 + lanes]) - (u[n0 + lanes] + dt * v[n0 + lanes]);
    }
    const bool of_edge = (b.span[l] == 0.0) & (b.span[lanes + l] == 0.0);
    return { of_edge ? ey : dx, of_edge ? -ex : dy };
}

template <bool Whole> FLEXPM_INLINE double reach_of_b(const ContactLanes& b, int l)
{
    return b.reach[(Whole ? 0 : lanes) + l];
}

/// Unit normals at the end of the step, and the points' increments along the mean of the old and
/// the new normal: with it the work of a turning contact is what its energy says to third order.
///
/// Deviation D24: both grains are compared in the middle of the gap between their places of a point
/// (the paper's one contact location, Eq. 9), to which each edge carries its own rotation: a pair that
/// turns as one body neither opens nor slips.
template <int Points, bool OfEdges, bool Whole, bool Wide>
FLEXPM_INLINE void move_points(const ContactLanes& b, double dt, PointMotion& motion)
{
    fetch_ahead(b, b.nodes, ContactRows::nodes);
    fetch_ahead(b, b.span, 2);
    fetch_ahead(b, b.reach, 2, Whole ? 1 : 2);
    fetch_ahead(b, b.normal, 2);
    alignas(64) double ends[8 * lanes], centres[4 * lanes];
    for (int n = 0; n < 4; ++n)
        gather_values(b.velocity, b.nodes + n * lanes, ends + 2 * n * lanes);
    for (int side = 0; side < 2; ++side)
        gather_pairs<Wide>(b.centres, b.nodes + (4 + side) * lanes, centres + 2 * side * lanes);
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const double* v = ends + l;
        const Point along_normal = direction<OfEdges>(b, centres, dt, l);
        const double dx = along_normal.x, dy = along_normal.y;
        const double per_length = 1.0 / std::sqrt(dx * dx + dy * dy);
        const double nx = per_length * dx, ny = per_length * dy;
        const double mx = 0.5 * dt * (b.normal[l] + nx), my = 0.5 * dt * (b.normal[lanes + l] + ny);
        b.normal[l] = nx;
        b.normal[lanes + l] = ny;
        // velocities of the ends of a, of b, and of the first end of b against that of a
        const double ax = v[2 * lanes] - v[0], ay = v[3 * lanes] - v[lanes];
        const double bx = v[6 * lanes] - v[4 * lanes], by = v[7 * lanes] - v[5 * lanes];
        const double gx = v[4 * lanes] - v[0], gy = v[5 * lanes] - v[lanes];
        const double a_apart = ax * mx + ay * my, a_along = ay * mx - ax * my;
        const double b_apart = bx * mx + by * my, b_along = by * mx - bx * my;
        const double g_apart = gx * mx + gy * my, g_along = gy * mx - gx * my;
        const double turn = -0.5 * (b.reach[l] * a_apart + reach_of_b<Whole>(b, l) * b_apart);
        for (int p = 0; p < Points; ++p) {
            const double* state = b.state + p * ContactRows::state * lanes + l;
            const double apart = g_apart + between_edges<Whole>(b, p, l, a_apart, b_apart);
            const double along = g_along + between_edges<Whole>(b, p, l, a_along, b_along);
            const double opening = state[ContactRows::opening * lanes],
                         slip = state[ContactRows::slip * lanes];
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

/// Tractions to nodal forces by the shape functions of the two edges, Eqs. 18-19. They act in the
/// middle of the gap: each edge takes half of the gap's moment by a couple on its ends.
template <int Points, bool Whole>
FLEXPM_INLINE void spread_forces(const ContactLanes& b, const double* normal, const double* shear)
{
    alignas(64) double rows[ContactRows::forces * lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const double nx = b.normal[l], ny = b.normal[lanes + l];
        // along the normal and along the tangent
        double moment = 0.0, sum_n = 0.0, sum_s = 0.0;
        EndShares end_n, end_s;
        for (int p = 0; p < Points; ++p) {
            const double area = b.area[(Whole && p == 2 ? 0 : p) * lanes + l];
            const double fn = area * normal[p * lanes + l], fs = area * shear[p * lanes + l];
            const double* state = b.state + p * ContactRows::state * lanes + l;
            moment +=
                state[ContactRows::opening * lanes] * fs - state[ContactRows::slip * lanes] * fn;
            sum_n += fn;
            sum_s += fs;
            end_n.add<Whole>(b, p, l, fn);
            end_s.add<Whole>(b, p, l, fs);
        }
        const double a_n = end_n.a - 0.5 * moment * b.reach[l];
        const double b_n = end_n.b + 0.5 * moment * reach_of_b<Whole>(b, l);
        const double sum_x = sum_n * nx - sum_s * ny, sum_y = sum_n * ny + sum_s * nx;
        const double a1x = a_n * nx - end_s.a * ny, a1y = a_n * ny + end_s.a * nx;
        const double b1x = b_n * nx - end_s.b * ny, b1y = b_n * ny + end_s.b * nx;
        double* f = rows + l;
        f[0 * lanes] = sum_x - a1x;
        f[1 * lanes] = sum_y - a1y;
        f[2 * lanes] = a1x;
        f[3 * lanes] = a1y;
        f[4 * lanes] = b1x - sum_x;
        f[5 * lanes] = b1y - sum_y;
        f[6 * lanes] = -b1x;
        f[7 * lanes] = -b1y;
    }
    for (int l = 0; l < lanes; l += 4) {
        for (int r = 0; r < ContactRows::forces; r += 4)
            transpose(rows + r * lanes + l, lanes, b.force + l * ContactRows::forces + r,
                ContactRows::forces);
    }
}

}  // namespace flexpm
