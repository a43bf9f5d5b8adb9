// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts, `lanes` at a time.
#include <flexpm/kernel/forces/contact_forces.hpp>

#include <flexpm/kernel/assembly/contact_rows.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/simd.hpp>
#include <flexpm/kernel/forces/contact_kinematics.hpp>
#include <flexpm/kernel/forces/crack_record.hpp>

namespace flexpm {

namespace {

constexpr int blocks_ahead = 2;  ///< rows, which follow each other
constexpr int nodes_ahead = 6;   ///< blocks whose nodes lie anywhere

FLEXPM_INLINE void store_state(const PointState& s, double* rows, int lane)
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

/// No point of the block has any damage: true of most blocks.
template <int Points> FLEXPM_INLINE bool is_intact(const ContactLanes& b)
{
    alignas(64) std::int64_t damaged[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        double opened = 0.0, sheared = 0.0;
        for (int p = 0; p < Points; ++p) {
            const PointState s = load_state(b.state + p * ContactRows::state * lanes, l);
            opened = std::max(opened, s.max_opening);
            sheared = std::max(sheared, s.shear_damage);
        }
        damaged[l] = (opened > law_of(b.law, l).elastic_opening) | (sheared > 0.0);
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
FLEXPM_INLINE void slide_lanes(
    const ContactLanes& b, int p, const std::int64_t* leaves, double* next, TractionRows traction)
{
    double* state = b.state + p * ContactRows::state * lanes;
    FLEXPM_INDEPENDENT
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
FLEXPM_INLINE bool advance_elastic_lanes(
    const ContactLanes& b, const PointMotion& motion, int p, TractionRows traction)
{
    double* state = b.state + p * ContactRows::state * lanes;
    alignas(64) std::int64_t leaves[lanes], needs_law[lanes];
    alignas(64) double next[4 * lanes];  // the members of a state that an elastic step changes
    FLEXPM_INDEPENDENT
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
FLEXPM_INLINE int advance_lanes(const ContactLanes& b, const PointMotion& motion, int p,
    TractionRows traction, std::uint8_t* cracked)
{
    double* state = b.state + p * ContactRows::state * lanes;
    alignas(64) double fresh[lanes];
    FLEXPM_INDEPENDENT
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
FLEXPM_INLINE int advance_points(const ContactLanes& b, const PointMotion& motion, double* normal,
    double* shear, std::uint8_t* cracked)
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

template <int Points, bool Whole, bool Wide>
FLEXPM_INLINE int update_lanes(const ContactLanes& b, double dt, std::uint8_t* cracked)
{
    PointMotion motion;
    // two calls, not one through a pointer: only a direct call is compiled for each instruction set
    if (any_normal_of_edge(b))
        move_points<Points, true, Whole, Wide>(b, dt, motion);
    else
        move_points<Points, false, Whole, Wide>(b, dt, motion);

    alignas(64) double normal[Points * lanes], shear[Points * lanes];
    const int cracks = is_intact<Points>(b)
        ? advance_points<Points, true>(b, motion, normal, shear, cracked)
        : advance_points<Points, false>(b, motion, normal, shear, cracked);
    if (!Whole) fetch_ahead(b, b.weight, 2 * Points);
    fetch_ahead(b, b.area, Points, Whole ? 2 : Points);
    fetch_ahead(b, b.force, ContactRows::forces);
    spread_forces<Points, Whole>(b, normal, shear);
    return cracks;
}

template <int Points, bool Wide>
FLEXPM_INLINE int update_block(const ContactLanes& b, double dt, std::uint8_t* cracked)
{
    if constexpr (Points == 3) {
        if (b.whole_edges) return update_lanes<3, true, Wide>(b, dt, cracked);
    }
    return update_lanes<Points, false, Wide>(b, dt, cracked);
}

template <int Points> auto update_for()
{
    return variant_of<update_block<Points, false>, update_block<Points, true>>();
}

ContactLanes rows_from(Assembly& a, int contact, const LawRows& law)
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
void advance_block(ContactLanes& b, int points)
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

void update_contact_blocks(Assembly& a, int first, int end, double dt)
{
    LawRows law;
    ContactLanes rows = rows_from(a, first * lanes, law);
    const auto update = a.points == 3 ? update_for<3>()
        : a.points == 2               ? update_for<2>()
                                      : update_for<1>();
    for (int block = first; block < end; ++block, advance_block(rows, a.points)) {
        law.fill(a, block);
        if (rows.ahead != 0 && block + nodes_ahead < a.contact_blocks()) {
            fetch_nodes(a, block + nodes_ahead);
        }
        rows.whole_edges = a.whole_edges[block] != 0;
        std::uint8_t cracked[most_points * lanes] = {};
        if (update(rows, dt, cracked) > 0) record_cracks(a, block, dt, cracked);
    }
}

}  // namespace flexpm
