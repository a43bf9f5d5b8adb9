// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts, `lanes` at a time.
#include <flexpm/kernel/contact_block.hpp>

#include <flexpm/kernel/contact_rows.hpp>
#include <flexpm/kernel/fetch.hpp>
#include <flexpm/kernel/simd.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

constexpr int most_points = 3, blocks_ahead = 2;
constexpr int opening_row = ContactRows::opening * lanes, slip_row = ContactRows::slip * lanes;

/// The rows of one block of contacts.
struct Rows {
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
    bool shared_edges;  ///< see Assembly::shared_edges
    int ahead;          ///< blocks from this one to the one to ask for; 0: the caches hold all
};

/// What a block works out for its points on the way, [point][lane].
struct Motion {
    alignas(64) double opening[most_points * lanes];
    alignas(64) double slip[most_points * lanes];
};

__attribute__((always_inline)) inline bool any_of(const std::int64_t* flags)
{
    std::int64_t any = 0;
    for (int l = 0; l < lanes; ++l)
        any |= flags[l];
    return any != 0;
}

__attribute__((always_inline)) inline void store_state(const PointState& s, double* rows, int lane)
{
    double* r = rows + lane;
    r[0] = s.opening;
    r[lanes] = s.max_opening;
    r[2 * lanes] = s.shear_traction;
    r[3 * lanes] = s.slip;
    r[4 * lanes] = s.shear_damage;
    r[5 * lanes] = s.damage_energy;
    r[6 * lanes] = s.friction_energy;
}

/// A contact of the block takes its normal from its edges: it has no span, which marks it.
__attribute__((always_inline)) inline bool any_normal_of_edge(const Rows& b)
{
    alignas(64) std::int64_t of_edge[lanes];
    for (int l = 0; l < lanes; ++l)
        of_edge[l] = (b.span[l] == 0.0) & (b.span[lanes + l] == 0.0);
    return any_of(of_edge);
}

/// x and y of the nodes of a row, one node after the other, or the compiler runs out of registers for
/// the addresses.
__attribute__((always_inline)) inline void gather(const double* from, const int* nodes, double* to)
{
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) {
        to[l] = from[nodes[l]];
        to[lanes + l] = from[nodes[l] + lanes];
    }
}

/// A quantity at point `p` of an edge, less its value at the first end, from the difference of the ends.
/// `Shared`: three points, of weights 0, 1/2 and 1, on both sides.
template <bool Shared>
__attribute__((always_inline)) inline double between_edges(
    const Rows& b, int p, int l, double of_a, double of_b)
{
    if (Shared) return p == 0 ? 0.0 : p == 1 ? 0.5 * (of_b - of_a) : of_b - of_a;
    const double wa = b.weight[(2 * p) * lanes + l], wb = b.weight[(2 * p + 1) * lanes + l];
    return wb * of_b - wa * of_a;
}

/// Ask for an array's rows of the block ahead, of which there are `per_block`.
template <class T>
__attribute__((always_inline)) inline void fetch_ahead(const Rows& b, const T* rows, int per_block)
{
    if (b.ahead != 0) fetch_rows(rows + b.ahead * per_block * lanes, per_block);
}

/// A vector along the normal at the end of the step: between the centres, or, where a contact has no
/// span, across the mean of the two edges.
template <bool OfEdges>
__attribute__((always_inline)) inline Point direction(const Rows& b, double dt, int l)
{
    const double* centres = b.centres;
    const int ca = b.nodes[4 * lanes + l], cb = b.nodes[5 * lanes + l];
    const double dx = b.span[l] + (centres[cb] - centres[ca]);
    const double dy = b.span[lanes + l] + (centres[cb + lanes] - centres[ca + lanes]);
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

template <bool Shared> __attribute__((always_inline)) inline double reach_of_b(const Rows& b, int l)
{
    return b.reach[(Shared ? 0 : lanes) + l];
}

/// Unit normals at the end of the step, and the points' increments along the mean of the old and
/// the new normal: with it the work of a turning contact is what its energy says to third order.
///
/// Deviation D24: both grains are compared in the middle of the gap between their places of a point
/// (the paper's one contact location, Eq. 9), to which each edge carries its own rotation: a pair that
/// turns as one body neither opens nor slips.
template <int Points, bool OfEdges, bool Shared>
__attribute__((always_inline)) inline void move_points(const Rows& b, double dt, Motion& motion)
{
    fetch_ahead(b, b.nodes, ContactRows::nodes);
    fetch_ahead(b, b.span, 2);
    fetch_ahead(b, b.reach, 2);
    fetch_ahead(b, b.normal, 2);
    alignas(64) double ends[8 * lanes];
    for (int n = 0; n < 4; ++n)
        gather(b.velocity, b.nodes + n * lanes, ends + 2 * n * lanes);
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) {
        const double* v = ends + l;
        const Point along_normal = direction<OfEdges>(b, dt, l);
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
        const double turn = -0.5 * (b.reach[l] * a_apart + reach_of_b<Shared>(b, l) * b_apart);
        for (int p = 0; p < Points; ++p) {
            const double* state = b.state + p * ContactRows::state * lanes + l;
            const double apart = g_apart + between_edges<Shared>(b, p, l, a_apart, b_apart);
            const double along = g_along + between_edges<Shared>(b, p, l, a_along, b_along);
            const double opening = state[opening_row], slip = state[slip_row];
            motion.opening[p * lanes + l] = apart + turn * (slip + 0.5 * (along - turn * opening));
            motion.slip[p * lanes + l] = along - turn * (opening + 0.5 * (apart + turn * slip));
        }
    }
}

/// Share of the second end of each edge in what acts on its points, along one direction.
struct EndShares {
    double a = 0.0, b = 0.0;

    template <bool Shared>
    __attribute__((always_inline)) inline void add(const Rows& rows, int p, int l, double force)
    {
        if (Shared) {
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
template <int Points, bool Shared>
__attribute__((always_inline)) inline void spread_forces(
    const Rows& b, const double* normal, const double* shear)
{
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) {
        const double nx = b.normal[l], ny = b.normal[lanes + l];
        // along the normal and along the tangent
        double moment = 0.0, sum_n = 0.0, sum_s = 0.0;
        EndShares end_n, end_s;
        for (int p = 0; p < Points; ++p) {
            const double area = b.area[(Shared && p == 2 ? 0 : p) * lanes + l];
            const double fn = area * normal[p * lanes + l], fs = area * shear[p * lanes + l];
            const double* state = b.state + p * ContactRows::state * lanes + l;
            moment += state[opening_row] * fs - state[slip_row] * fn;
            sum_n += fn;
            sum_s += fs;
            end_n.add<Shared>(b, p, l, fn);
            end_s.add<Shared>(b, p, l, fs);
        }
        const double a_n = end_n.a - 0.5 * moment * b.reach[l];
        const double b_n = end_n.b + 0.5 * moment * reach_of_b<Shared>(b, l);
        const double sum_x = sum_n * nx - sum_s * ny, sum_y = sum_n * ny + sum_s * nx;
        const double a1x = a_n * nx - end_s.a * ny, a1y = a_n * ny + end_s.a * nx;
        const double b1x = b_n * nx - end_s.b * ny, b1y = b_n * ny + end_s.b * nx;
        double* f = b.force + l;
        f[0 * lanes] = sum_x - a1x;
        f[1 * lanes] = sum_y - a1y;
        f[2 * lanes] = a1x;
        f[3 * lanes] = a1y;
        f[4 * lanes] = b1x - sum_x;
        f[5 * lanes] = b1y - sum_y;
        f[6 * lanes] = -b1x;
        f[7 * lanes] = -b1y;
    }
}

/// No point of the block has any damage: true of most blocks.
template <int Points> __attribute__((always_inline)) inline bool is_intact(const Rows& b)
{
    alignas(64) std::int64_t damaged[lanes] = {};
    for (int p = 0; p < Points; ++p) {
        const double* state = b.state + p * ContactRows::state * lanes;
#pragma GCC ivdep
        for (int l = 0; l < lanes; ++l) {
            const PointState s = load_state(state, l);
            const double excess = s.max_opening - law_of(b.law, l).elastic_opening;
            damaged[l] |= (excess > 0.0) | (s.shear_damage > 0.0);
        }
    }
    return !any_of(damaged);
}

/// Traction of one point of each contact [Pa].
struct TractionRows {
    double* normal;
    double* shear;
};

/// Slides the points that leave their branch, which shear has used up: `next` holds what an elastic
/// step would have made of all.
__attribute__((always_inline)) inline void slide_lanes(
    const Rows& b, int p, const std::int64_t* leaves, double* next, TractionRows traction)
{
    double* state = b.state + p * ContactRows::state * lanes;
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) {
        const PointState s = load_state(state, l);
        const Sliding slide = slide_used_up(
            law_of(b.law, l), traction.normal[l], next[2 * lanes + l], s.shear_traction);
        const bool slides = leaves[l] != 0;
        traction.shear[l] = slides ? slide.shear : traction.shear[l];
        next[2 * lanes + l] = traction.shear[l];
        state[6 * lanes + l] = s.friction_energy + (slides ? slide.loss : 0.0);
    }
}

/// Advances a point of each contact if all stay on their branches or only friction holds them;
/// otherwise changes no state.
template <bool Intact>
__attribute__((always_inline)) inline bool advance_elastic_lanes(
    const Rows& b, const Motion& motion, int p, TractionRows traction)
{
    double* state = b.state + p * ContactRows::state * lanes;
    alignas(64) std::int64_t leaves[lanes], needs_law[lanes];
    alignas(64) double next[4 * lanes];  // the members of a state that an elastic step changes
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) {
        PointState s;
        Traction t;
        const PointState old = load_state(state, l);
        const bool elastic = advance_elastic<Intact>(
            law_of(b.law, l), motion.opening[p * lanes + l], motion.slip[p * lanes + l], old, s, t);
        next[0 * lanes + l] = s.opening;
        next[1 * lanes + l] = s.max_opening;
        next[2 * lanes + l] = s.shear_traction;
        next[3 * lanes + l] = s.slip;
        traction.normal[l] = t.normal;
        traction.shear[l] = t.shear;
        leaves[l] = !elastic;
        needs_law[l] = !elastic & !(old.shear_damage >= 1.0);
    }
    if (any_of(leaves)) {
        if (Intact || any_of(needs_law)) return false;
        slide_lanes(b, p, leaves, next, traction);
    }
    for (int i = 0; i < 4 * lanes; ++i)
        state[i] = next[i];
    return true;
}

/// Advances a point of each contact. Returns the lanes that cracked in this step.
__attribute__((always_inline)) inline int advance_lanes(
    const Rows& b, const Motion& motion, int p, TractionRows traction, std::uint8_t* cracked)
{
    double* state = b.state + p * ContactRows::state * lanes;
    alignas(64) double fresh[lanes];
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) {
        PointState s = load_state(state, l);
        const Traction t = advance_point(
            law_of(b.law, l), motion.opening[p * lanes + l], motion.slip[p * lanes + l], s);
        store_state(s, state, l);
        traction.normal[l] = t.normal;
        traction.shear[l] = t.shear;
        fresh[l] = (t.damage_before < 1.0) & (t.damage >= 1.0) ? 1.0 : 0.0;
    }
    int cracks = 0;
    for (int l = 0; l < lanes; ++l) {
        cracked[l] = fresh[l] > 0.0;
        cracks += cracked[l];
    }
    return cracks;
}

/// Returns the lanes, summed over points, that cracked in this step; `cracked` holds zeros before.
template <int Points, bool Intact>
__attribute__((always_inline)) inline int advance_points(
    const Rows& b, const Motion& motion, double* normal, double* shear, std::uint8_t* cracked)
{
    int cracks = 0;
    for (int p = 0; p < Points; ++p) {
        const TractionRows traction = { normal + p * lanes, shear + p * lanes };
        if (b.ahead != 0) {
            fetch_rows(
                b.state + (b.ahead * Points + p) * ContactRows::state * lanes, ContactRows::state);
        }
        if (advance_elastic_lanes<Intact>(b, motion, p, traction)) continue;
        cracks += advance_lanes(b, motion, p, traction, cracked + p * lanes);
    }
    return cracks;
}

template <int Points, bool Shared>
__attribute__((always_inline)) inline int update_lanes(
    const Rows& b, double dt, std::uint8_t* cracked)
{
    Motion motion;
    // two calls, not one through a pointer: only a direct call is compiled for each instruction set
    if (any_normal_of_edge(b))
        move_points<Points, true, Shared>(b, dt, motion);
    else
        move_points<Points, false, Shared>(b, dt, motion);

    alignas(64) double normal[Points * lanes], shear[Points * lanes];
    const int cracks = is_intact<Points>(b)
        ? advance_points<Points, true>(b, motion, normal, shear, cracked)
        : advance_points<Points, false>(b, motion, normal, shear, cracked);
    if (!Shared) fetch_ahead(b, b.weight, 2 * Points);
    fetch_ahead(b, b.area, Points);
    fetch_ahead(b, b.force, ContactRows::forces);
    spread_forces<Points, Shared>(b, normal, shear);
    return cracks;
}

FLEXPM_MULTIVERSION int update_1(const Rows& b, double dt, std::uint8_t* cracked)
{
    return update_lanes<1, false>(b, dt, cracked);
}
FLEXPM_MULTIVERSION int update_2(const Rows& b, double dt, std::uint8_t* cracked)
{
    return update_lanes<2, false>(b, dt, cracked);
}
FLEXPM_MULTIVERSION int update_3(const Rows& b, double dt, std::uint8_t* cracked)
{
    return b.shared_edges ? update_lanes<3, true>(b, dt, cracked)
                          : update_lanes<3, false>(b, dt, cracked);
}

/// Where a point is now: the middle of its places on the two edges.
Point point_position(const Assembly& a, int contact, int point, double dt)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const int n0 = a.contact_nodes[row_index(contact, 2 * side, ContactRows::nodes)];
        const int n1 = a.contact_nodes[row_index(contact, 2 * side + 1, ContactRows::nodes)];
        const double w = a.weight[row_index(contact, 2 * point + side, 2 * a.points)];
        const Point p0 = a.position(n0), p1 = a.position(n1);
        sum.x +=
            0.5 * ((1.0 - w) * (p0.x + dt * a.velocity[n0]) + w * (p1.x + dt * a.velocity[n1]));
        sum.y += 0.5
            * ((1.0 - w) * (p0.y + dt * a.velocity[n0 + lanes])
                + w * (p1.y + dt * a.velocity[n1 + lanes]));
    }
    return sum;
}

void record_cracks(Assembly& a, int block, double dt, const std::uint8_t* cracked)
{
    for (int p = 0; p < a.points; ++p) {
        for (int l = 0; l < lanes; ++l) {
            const int contact = block * lanes + l;
            if (!cracked[p * lanes + l] || contact >= a.contacts) continue;
            const int index = row_index(contact, p, a.points);
            const double opening = a.point_state[row_index(
                contact, p * ContactRows::state, a.points * ContactRows::state)];
            const Point place = point_position(a, contact, p, dt);
            a.crack_step[index] = static_cast<int>(a.step + 1);
            a.crack_mode[index] = opening > 0.0 ? tensile_crack : shear_crack;
            a.crack_position[row_index(contact, 2 * p, 2 * a.points)] = place.x;
            a.crack_position[row_index(contact, 2 * p + 1, 2 * a.points)] = place.y;
        }
    }
}

Rows rows_from(Assembly& a, int contact, const LawRows& law)
{
    return { a.reference.data(), a.displacement.data(), a.velocity.data(), a.next_centre.data(),
        a.contact_nodes.data() + contact * ContactRows::nodes,
        a.weight.data() + contact * 2 * a.points, a.area.data() + contact * a.points,
        a.span.data() + contact * 2, a.edge_reach.data() + contact * 2,
        a.normal.data() + contact * 2,
        a.point_state.data() + contact * a.points * ContactRows::state,
        a.contact_force.data() + contact * ContactRows::forces, law.values, false,
        exceeds_caches(a) ? blocks_ahead : 0 };
}

/// Go on to the rows of the next block.
void advance_block(Rows& b, int points)
{
    b.nodes += lanes * ContactRows::nodes;
    b.weight += lanes * 2 * points;
    b.area += lanes * points;
    b.span += lanes * 2;
    b.reach += lanes * 2;
    b.normal += lanes * 2;
    b.state += lanes * points * ContactRows::state;
    b.force += lanes * ContactRows::forces;
}

}  // namespace

void predict_centres(Assembly& a, int block, double dt)
{
    const int first = a.block_nodes[block] + 2 * lanes * a.group(block).vertices;
    const double *u = a.displacement.data() + first, *v = a.velocity.data() + first;
    double* next = a.next_centre.data() + 2 * lanes * block;
    for (int i = 0; i < 2 * lanes; ++i)
        next[i] = u[i] + dt * v[i];
}

void update_contact_blocks(Assembly& a, int first, int end, double dt)
{
    LawRows law;
    Rows rows = rows_from(a, first * lanes, law);
    for (int block = first; block < end; ++block, advance_block(rows, a.points)) {
        law.fill(a, block);
        rows.shared_edges = a.shared_edges[block] != 0;
        std::uint8_t cracked[most_points * lanes] = {};
        const int cracks = a.points == 3 ? update_3(rows, dt, cracked)
            : a.points == 2              ? update_2(rows, dt, cracked)
                                         : update_1(rows, dt, cracked);
        if (cracks > 0) record_cracks(a, block, dt, cracked);
    }
}

double update_edge_block(Assembly& a, int block, double dt)
{
    double work = 0.0;
    for (int e = block * lanes; e < std::min((block + 1) * lanes, a.edges); ++e) {
        double* f = a.edge_force.data() + row_index(e, 0, ContactRows::forces);
        if (a.edge_pressure[e] == 0.0 && f[0] == 0.0 && f[lanes] == 0.0) continue;
        const int n0 = a.edge_nodes[row_index(e, 0, 2)], n1 = a.edge_nodes[row_index(e, 1, 2)];
        const Point p0 = a.position(n0), p1 = a.position(n1);
        const double* v = a.velocity.data();
        const double ex = (p1.x - p0.x) + dt * (v[n1] - v[n0]);
        const double ey = (p1.y - p0.y) + dt * (v[n1 + lanes] - v[n0 + lanes]);
        // the outward normal of a counter-clockwise edge is (ey, -ex) / length
        const double half = 0.5 * a.edge_pressure[e] * a.thickness;
        const double fx = -half * ey, fy = half * ex;
        work += 0.5 * dt
            * ((f[0] + fx) * (v[n0] + v[n1]) + (f[lanes] + fy) * (v[n0 + lanes] + v[n1 + lanes]));
        f[0] = f[2 * lanes] = fx;
        f[lanes] = f[3 * lanes] = fy;
    }
    return work;
}

}  // namespace flexpm
