// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of a block of contacts by their law, whatever the motion of their faces follows from:
/// nodes, or the motions of rigid grains. Inlined into the functions that are compiled for each
/// instruction set.
///
/// `Lanes` is what is read of a block, with the type of what it works out on the way, `Motion`, which
/// has the frames as FrameRows. For both are find_motion(), find_normals(), find_frames(),
/// find_jump(), add_force() and write_forces();
/// another hold_points() may take the place of that here.
#pragma once

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/prefetch_rows.hpp>
#include <flexpm/kernel/space_lanes/face_cracks.hpp>
#include <flexpm/kernel/space_lanes/face_lanes.hpp>

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace flexpm {

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

/// Law of a point: one that has cracked may have lost friction.
///
/// @tparam Extended  false: no law of the block dilates, and no friction falls
template <bool Extended>
FLEXPM_INLINE LawParameters law_at(const double* law_rows, const double* state, int l)
{
    LawParameters law = load_rows<LawParameters>(law_rows, l);
    if (Extended) law.friction = law::friction_after(law, state[FaceRow::crack_slip * lanes + l]);
    return law;
}

/// Tractions of a point of each contact if all stay on their branches, and with `Intact` have no
/// damage, which is true of most; otherwise changes no state.
template <bool Intact, bool Extended>
FLEXPM_INLINE bool hold_lanes(
    const double* law_rows, const double* places, double* state, double* traction)
{
    alignas(64) double next[held_rows * lanes];
    alignas(64) std::int64_t leaves[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const FacePlace at = load_place(places, l);
        const LawParameters law = law_at<Extended>(law_rows, state, l);
        FaceTraction t;
        double max_opening = 0.0;
        const bool holds = hold_face_point<Intact, Extended>(law, at,
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

/// Advances a point of each contact by the whole law.
template <bool Extended>
FLEXPM_INLINE void advance_lanes(const double* law_rows, const double* places, double* state,
    double* traction, int point, FreshCracks& cracks)
{
    alignas(64) double fresh[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const FacePlace at = load_place(places, l);
        const Point before { state[FaceRow::slip_x * lanes + l],
            state[FaceRow::slip_y * lanes + l] };
        FacePointState s = load_state(state, l);
        const LawParameters law = law_at<Extended>(law_rows, state, l);
        const Point plastic = s.plastic_slip;
        const FaceTraction t = advance_face_point<Extended>(law, at, before, s);
        if (Extended) {
            const bool rubs = (t.damage_before >= 1.0) & law::weakens(law);
            state[FaceRow::crack_slip * lanes + l] +=
                rubs ? law::length(s.plastic_slip - plastic) : 0.0;
        }
        store_state(s, state, l);
        store_slip(at.slip, state, l);
        store_vector({ t.normal, t.shear.x, t.shear.y }, traction, l);
        fresh[l] = ((t.damage_before < 1.0) & (t.damage >= 1.0)) ? 1.0 : 0.0;
    }
    for (int l = 0; l < lanes; ++l) {
        if (fresh[l] > 0.0) cracks.add(point, l, places[l]);
    }
}

/// Advances all points.
template <bool Extended, class Lanes>
FLEXPM_INLINE void advance_points(
    const Lanes& b, typename Lanes::Motion& m, double* states, FreshCracks& cracks)
{
    alignas(64) double jump[vector_rows], places[vector_rows], traction[vector_rows],
        force[vector_rows];
    for (int p = 0; p < b.group.points; ++p) {
        double* state = states + p * FaceRow::count * lanes;
        find_jump(b, m, p, jump);
        find_places(m, jump, places);
        if (!(!Extended && hold_lanes<true, false>(b.law, places, state, traction))
            && !hold_lanes<false, Extended>(b.law, places, state, traction))
            advance_lanes<Extended>(b.law, places, state, traction, p, cracks);
        find_force(m, b.areas + p * lanes, traction, force);
        add_force(b, p, force, jump, m);
    }
}

/// Forces of a block that has states. Returns the number of its lanes without a frame.
template <class Lanes, bool Wide>
FLEXPM_INLINE int update_block(
    const Lanes& b, double* states, const FaceForces& to, FreshCracks& cracks)
{
    typename Lanes::Motion m;
    find_motion(b, m, std::bool_constant<Wide>());
    find_frames(b, m);
    if (b.dilating || b.weakening) {
        advance_points<true>(b, m, states, cracks);
    } else {
        advance_points<false>(b, m, states, cracks);
    }
    write_forces(b, m, to, std::false_type());
    return count_turned(m, b.areas, b.group.points);
}

/// Add the forces of all points as long as they are intact. Returns false if one leaves its elastic
/// branch, or the face has no area.
template <class Lanes> FLEXPM_INLINE bool hold_points(const Lanes& b, typename Lanes::Motion& m)
{
    alignas(64) double jump[vector_rows];
    alignas(64) std::int64_t leaves[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l)
        leaves[l] = m.area[l] > no_size ? 0 : 1;
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
        add_force(b, p, at.force, jump, m);
    }
    return !any_of(leaves);
}

/// Forces of a block without states, if all of its points stay on their elastic branches. Else
/// returns false, and nothing is written.
template <class Lanes, bool Wide>
FLEXPM_INLINE bool hold_block(const Lanes& b, const FaceForces& to)
{
    typename Lanes::Motion m;
    find_motion(b, m, std::bool_constant<Wide>());
    find_normals(b, m);
    if (!hold_points(b, m)) return false;
    write_forces(b, m, to, std::true_type());
    return true;
}

/// Slips of all points, into the rows of their states.
template <class Lanes, bool Wide> FLEXPM_INLINE void find_slips(const Lanes& b, double* states)
{
    typename Lanes::Motion m;
    find_motion(b, m, std::bool_constant<Wide>());
    find_frames(b, m);
    alignas(64) double jump[vector_rows], places[vector_rows];
    for (int p = 0; p < b.group.points; ++p) {
        find_jump(b, m, p, jump);
        find_places(m, jump, places);
        for (int l = 0; l < lanes; ++l)
            store_slip(load_place(places, l).slip, states + p * FaceRow::count * lanes, l);
    }
}

/// Ask for what a step reads of the states of a block, some time before it does.
inline void prefetch_states(const FaceContacts& c, int block)
{
    const FaceGroup& group = c.group_in(block);
    prefetch_rows(c.areas.data() + c.block_points[block], group.points);
    const Array<double>& states = c.states[block];
    for (int p = 0; p < group.points && !states.empty(); ++p)
        prefetch_rows(states.data() + p * FaceRow::count * lanes, undamaged_rows);
}

/// Update blocks of contacts at the present places, and record what cracks. `Source` makes `Lanes`
/// and the first states of a block, and says where its forces go.
///
/// @return  number of contacts whose middle face has no area
template <class Source> int update_blocks(SolidState& s, int first, int end, double dt)
{
    using Lanes = typename Source::Lanes;
    const auto hold = variant_of<hold_block<Lanes, false>, hold_block<Lanes, true>>();
    const auto update = variant_of<update_block<Lanes, false>, update_block<Lanes, true>>();
    FaceContacts& c = s.contacts;
    FaceLaws laws;
    int turned = 0;
    for (int block = first; block < end; ++block) {
        if (block == first || c.laws.size() > 1) laws.fill(c, block);
        if (block + 1 < end) Source::prefetch(s, block + 1);
        const Lanes lanes_of = Source::lanes_of(s, block, laws);
        const FaceForces forces = Source::forces_of(s, block);
        if (c.states[block].empty()) {
            if (hold(lanes_of, forces)) continue;
            c.states[block] = Source::first_states(s, block, laws, dt);
        }
        FreshCracks cracks;
        turned += update(lanes_of, c.states[block].data(), forces, cracks);
        if (cracks.any()) record_cracks(s, block, cracks);
    }
    return turned;
}

}  // namespace flexpm
