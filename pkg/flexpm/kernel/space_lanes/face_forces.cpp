// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/face_forces.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/prefetch_rows.hpp>
#include <flexpm/kernel/space_lanes/face_lanes.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>

namespace flexpm {

namespace {

/// Points of a face: the corners and one inside, or as many.
constexpr int most_points = most_corners + 1;

FLEXPM_INLINE void store_state(const FacePointState& s, double* rows, int l)
{
    rows[FaceRow::max_opening * lanes + l] = s.max_opening;
    rows[FaceRow::plastic_x * lanes + l] = s.plastic_slip.x;
    rows[FaceRow::plastic_y * lanes + l] = s.plastic_slip.y;
    rows[FaceRow::shear_damage * lanes + l] = s.shear_damage;
    rows[FaceRow::damage_energy * lanes + l] = s.damage_energy;
    rows[FaceRow::friction_energy * lanes + l] = s.friction_energy;
}

/// Rows of a state that a point on its branch changes: the first ones.
constexpr int held_rows = FaceRow::max_opening + 1;

/// Rows of a state that a point without damage reads or writes.
constexpr int undamaged_rows = FaceRow::shear_damage + 1;

FLEXPM_INLINE void store_slip(Point slip, double* rows, int l)
{
    rows[FaceRow::slip_x * lanes + l] = slip.x;
    rows[FaceRow::slip_y * lanes + l] = slip.y;
}

/// Whether any lane of a row is set.
FLEXPM_INLINE bool any_of(const std::int64_t* row)
{
    std::int64_t any = 0;
    for (int l = 0; l < lanes; ++l)
        any |= row[l];
    return any != 0;
}

/// Tractions of a point of each contact if all stay on their branches, and with `Intact` have no
/// damage, which is true of most; otherwise changes no state.
template <bool Intact, bool Dilating>
FLEXPM_INLINE bool hold_lanes(
    const FaceLanes& b, const double* places, double* state, double* traction)
{
    alignas(64) double next[held_rows * lanes];
    alignas(64) std::int64_t leaves[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const FacePlace at = load_place(places, l);
        const LawParameters law = load_rows<LawParameters>(b.law, l);
        FaceTraction t;
        double max_opening = 0.0;
        const bool holds = hold_face_point<Intact, Dilating>(law, at,
            Intact ? FacePointState { state[FaceRow::max_opening * lanes + l], {}, 0.0, 0.0, 0.0 }
                   : load_state(state, l),
            max_opening, t);
        const bool damaged = Intact
            && ((state[FaceRow::max_opening * lanes + l] > law.elastic_opening)
                | (state[FaceRow::shear_damage * lanes + l] > 0.0));
        store_vector({ t.normal, t.shear.x, t.shear.y }, traction, l);
        store_slip(at.slip, next, l);
        next[FaceRow::max_opening * lanes + l] = max_opening;
        leaves[l] = (holds & !damaged) ? 0 : 1;
    }
    if (any_of(leaves)) return false;
    for (int i = 0; i < held_rows * lanes; ++i)
        state[i] = next[i];
    return true;
}

/// Advances a point of each contact by the whole law. Returns the lanes that cracked.
template <bool Dilating>
FLEXPM_INLINE int advance_lanes(const FaceLanes& b, const double* places, double* state,
    double* traction, std::uint8_t* cracked)
{
    alignas(64) double fresh[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const FacePlace at = load_place(places, l);
        const Point before { state[FaceRow::slip_x * lanes + l],
            state[FaceRow::slip_y * lanes + l] };
        FacePointState s = load_state(state, l);
        const FaceTraction t =
            advance_face_point<Dilating>(load_rows<LawParameters>(b.law, l), at, before, s);
        store_state(s, state, l);
        store_slip(at.slip, state, l);
        store_vector({ t.normal, t.shear.x, t.shear.y }, traction, l);
        fresh[l] = ((t.damage_before < 1.0) & (t.damage >= 1.0)) ? 1.0 : 0.0;
    }
    int cracks = 0;
    for (int l = 0; l < lanes; ++l) {
        cracked[l] = fresh[l] > 0.0;
        cracks += cracked[l];
    }
    return cracks;
}

/// Add the couples of forces on points whose places on both sides are `jump` apart.
FLEXPM_INLINE void add_couples(const double* force, const double* jump, FaceMotion& m)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        store_vector(load_vector(m.couple, l) + cross(load_vector(force, l), load_vector(jump, l)),
            m.couple, l);
    }
}

/// What a block comes to.
struct FaceUpdate {
    int cracks;  ///< lanes, summed over points, that cracked in this step
    int turned;  ///< see update_face_blocks()
};

/// Advances all points. Returns the lanes, summed over points, that cracked.
template <bool Dilating>
FLEXPM_INLINE int advance_points(
    const FaceLanes& b, FaceMotion& m, double* states, std::uint8_t* cracked)
{
    int cracks = 0;
    alignas(64) double jump[vector_rows], places[vector_rows], traction[vector_rows],
        force[vector_rows];
    for (int p = 0; p < b.group.points; ++p) {
        double* state = states + p * FaceRow::count * lanes;
        find_jump(b, m, p, jump);
        find_places(m, jump, places);
        if (!(!Dilating && hold_lanes<true, false>(b, places, state, traction))
            && !hold_lanes<false, Dilating>(b, places, state, traction))
            cracks += advance_lanes<Dilating>(b, places, state, traction, cracked + p * lanes);
        find_force(m, b.areas + p * lanes, traction, force);
        add_couples(force, jump, m);
        spread_point(b, p, force, m);
    }
    return cracks;
}

/// Forces of a block that has states.
template <bool Wide>
FLEXPM_INLINE FaceUpdate update_block(
    const FaceLanes& b, double* states, const FaceForces& to, std::uint8_t* cracked)
{
    FaceMotion m;
    move_corners<Wide>(b, m);
    find_frames(b, m);
    const int cracks = b.dilating ? advance_points<true>(b, m, states, cracked)
                                  : advance_points<false>(b, m, states, cracked);
    write_forces<false>(b, m, to);
    return { cracks, count_turned(m) };
}

/// Forces of a block without states, if all of its points stay on their elastic branches. Else
/// returns false, and nothing is written.
template <bool Wide> FLEXPM_INLINE bool hold_block(const FaceLanes& b, const FaceForces& to)
{
    FaceMotion m;
    move_corners<Wide>(b, m);
    find_normals(b, m);
    alignas(64) double jump[vector_rows];
    alignas(64) std::int64_t leaves[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l)
        leaves[l] = m.area[l] > 0.0 ? 0 : 1;
    IntactRows at;
    for (int p = 0; p < b.group.points; ++p) {
        find_jump(b, m, p, jump);
        find_intact(b, m, p, jump, at);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const bool holds =
                holds_intact(load_rows<LawParameters>(b.law, l), at.opening[l], at.slip_squared[l]);
            leaves[l] |= holds ? 0 : 1;
        }
        add_couples(at.force, jump, m);
        spread_point(b, p, at.force, m);
    }
    if (any_of(leaves)) return false;
    write_forces<true>(b, m, to);
    return true;
}

/// Slips of all points, into the rows of their states.
template <bool Wide> FLEXPM_INLINE void find_slips(const FaceLanes& b, double* states)
{
    FaceMotion m;
    move_corners<Wide>(b, m);
    find_frames(b, m);
    alignas(64) double jump[vector_rows], places[vector_rows];
    for (int p = 0; p < b.group.points; ++p) {
        find_jump(b, m, p, jump);
        find_places(m, jump, places);
        for (int l = 0; l < lanes; ++l)
            store_slip(load_place(places, l).slip, states + p * FaceRow::count * lanes, l);
    }
}

/// States of a block whose points have been elastic until the step: intact, with the slips before
/// it, which follow from where the nodes were.
Array<double> first_states(const SolidState& s, int block, const FaceLaws& laws, double dt)
{
    const FaceContacts& c = s.contacts;
    const int nodes = 2 * c.group_in(block).corners * lanes, first = c.block_nodes[block];
    constexpr int stride = space_layout.node_stride;
    Array<double> before(static_cast<std::size_t>(nodes) * stride, 0.0);
    std::vector<int> own(nodes);
    for (int i = 0; i < nodes; ++i) {
        const int side = i / lanes % 2, in_slot = c.in_slot[block * lanes + i % lanes];
        // padded lanes follow the first one
        const int contact = in_slot >= 0 ? in_slot : c.in_slot[block * lanes];
        own[i] = i * stride;
        set_space_vector(
            before, own[i], displacement_before(s, c.pairs[contact][side], c.nodes[first + i], dt));
    }
    FaceLanes b = face_lanes(s, block, laws);
    b.displacement = before.data();
    b.nodes = own.data();
    Array<double> states(c.state_count(block), 0.0);
    variant_of<find_slips<false>, find_slips<true>>()(b, states.data());
    return states;
}

FaceForces face_forces(SolidState& s, int block)
{
    const int parcels = s.plan.first_parcel[block];
    return { s.grains.force.data(), parcels < 0 ? nullptr : s.plan.parcels.data() + parcels };
}

/// Ask for the rows of a block of contacts that a step reads, some time before it does. Nodes are
/// near, since their grains have just moved.
void prefetch_block(const FaceContacts& c, int block)
{
    const FaceGroup& group = c.group_in(block);
    const int nodes = c.block_nodes[block];
    prefetch_rows(c.nodes.data() + nodes, 2 * group.corners);
    prefetch_rows(c.places.data() + nodes / 2 * 3, 3 * group.corners);
    prefetch_rows(c.areas.data() + c.block_points[block], group.points);
    prefetch_rows(
        c.shares.data() + c.block_shares[block], (group.points - group.at_corners) * group.corners);
    const Array<double>& states = c.states[block];
    if (states.empty()) return;
    prefetch_rows(c.line.data() + block * lanes, 1);
    for (int p = 0; p < group.points; ++p)
        prefetch_rows(states.data() + p * FaceRow::count * lanes, undamaged_rows);
}

/// Where a point is now: the middle of its places on both sides.
Vector point_position(const SolidState& s, int contact, int point)
{
    Vector sum;
    for (int side = 0; side < 2; ++side) {
        for (int k = 0; k < s.contacts.corners_of(contact); ++k) {
            const int node = s.contacts.node(contact, side, k);
            sum = sum + 0.5 * s.contacts.share(contact, point, k) * s.grains.position(node);
        }
    }
    return sum;
}

void record_cracks(SolidState& s, int block, const std::uint8_t* cracked)
{
    FaceContacts& c = s.contacts;
    for (int p = 0; p < c.group_in(block).points; ++p) {
        for (int l = 0; l < lanes; ++l) {
            const int contact = c.in_slot[block * lanes + l];
            if (!cracked[p * lanes + l] || contact < 0) continue;
            const FacePointState state = c.point_state(contact, p);
            const FacePlace place = places_of(s, contact)[p];
            const bool opens = law::gap(c.law_of(contact), place.opening, state) > 0.0;
            c.set_crack(contact, p,
                { s.step + 1, opens ? tensile_crack : shear_crack, point_position(s, contact, p),
                    c.area(contact, p) * state.damage_energy });
        }
    }
}

}  // namespace

int update_face_blocks(SolidState& s, int first, int end, double dt)
{
    const auto hold = variant_of<hold_block<false>, hold_block<true>>();
    const auto update = variant_of<update_block<false>, update_block<true>>();
    FaceContacts& c = s.contacts;
    FaceLaws laws;
    int turned = 0;
    for (int block = first; block < end; ++block) {
        if (block == first || c.laws.size() > 1) laws.fill(c, block);
        if (block + 1 < end) prefetch_block(c, block + 1);
        const FaceLanes lanes_of = face_lanes(s, block, laws);
        const FaceForces forces = face_forces(s, block);
        if (c.states[block].empty()) {
            if (hold(lanes_of, forces)) continue;
            c.states[block] = first_states(s, block, laws, dt);
        }
        std::uint8_t cracked[most_points * lanes] = {};
        const FaceUpdate done = update(lanes_of, c.states[block].data(), forces, cracked);
        turned += done.turned;
        if (done.cracks > 0) record_cracks(s, block, cracked);
    }
    return turned;
}

}  // namespace flexpm
