// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/face_sums.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/lane_sum.hpp>
#include <flexpm/kernel/space_lanes/face_lanes.hpp>

namespace flexpm {

namespace {

/// Stored in the points of a block. `states` is null of a block without any.
template <bool Wide>
FLEXPM_INLINE void add_stored(const FaceLanes& b, const double* states, LaneSum& energy)
{
    LaneSum sum = energy;  // a local, which no row aliases
    FaceMotion m;
    find_motion(b, m, std::bool_constant<Wide>());
    alignas(64) double jump[vector_rows], places[vector_rows];
    IntactRows at;
    states ? find_frames(b, m) : find_normals(b, m);
    for (int p = 0; p < b.group.points; ++p) {
        find_jump(b, m, p, jump);
        if (!states) {
            find_intact(b, m, p, jump, at);
            FLEXPM_INDEPENDENT
            for (int l = 0; l < lanes; ++l)
                sum.lane[l] += 0.5 * dot(load_vector(at.force, l), load_vector(jump, l));
            continue;
        }
        const double *area = b.areas + p * lanes, *state = states + p * FaceRow::count * lanes;
        find_places(m, jump, places);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            sum.lane[l] += area[l]
                * law::elastic_energy(load_rows<LawParameters>(b.law, l), load_place(places, l),
                    load_state(state, l));
        }
    }
    energy = sum;
}

/// Dissipated in the points of a block that has states.
FLEXPM_INLINE void add_lost(
    const double* areas, const double* states, int points, LaneSum& damage, LaneSum& friction)
{
    LaneSum of_damage = damage, of_friction = friction;
    for (int p = 0; p < points; ++p) {
        const double *area = areas + p * lanes, *state = states + p * FaceRow::count * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            of_damage.lane[l] += area[l] * state[FaceRow::damage_energy * lanes + l];
            of_friction.lane[l] += area[l] * state[FaceRow::friction_energy * lanes + l];
        }
    }
    damage = of_damage;
    friction = of_friction;
}

/// Forces that the contacts of a block bear, three rows. `states` is null of a block without any.
template <bool Wide>
FLEXPM_INLINE void sum_forces(const FaceLanes& b, const double* states, double* forces)
{
    alignas(64) double sum[vector_rows] = {};
    alignas(64) double jump[vector_rows], places[vector_rows], traction[vector_rows];
    FaceMotion m;
    find_motion(b, m, std::bool_constant<Wide>());
    IntactRows at;
    states ? find_frames(b, m) : find_normals(b, m);
    for (int p = 0; p < b.group.points; ++p) {
        find_jump(b, m, p, jump);
        if (states) {
            find_places(m, jump, places);
            FLEXPM_INDEPENDENT
            for (int l = 0; l < lanes; ++l) {
                const FaceTraction t = traction_at(load_rows<LawParameters>(b.law, l),
                    load_place(places, l), load_state(states + p * FaceRow::count * lanes, l));
                store_vector({ t.normal, t.shear.x, t.shear.y }, traction, l);
            }
            find_force(m, b.areas + p * lanes, traction, at.force);
        } else {
            find_intact(b, m, p, jump, at);
        }
        for (int i = 0; i < vector_rows; ++i)
            sum[i] += at.force[i];
    }
    for (int i = 0; i < vector_rows; ++i)
        forces[i] = sum[i];
}

/// Call visit(lanes, states) for each block of contacts; `states` is null of one without any.
template <class Visit> void for_each_block(const SolidState& s, Visit visit)
{
    const FaceContacts& c = s.contacts;
    FaceLaws laws;
    for (int block = 0; block < c.blocks(); ++block) {
        if (block == 0 || c.laws.size() > 1) laws.fill(c, block);
        const Array<double>& states = c.states[block];
        visit(face_lanes(s, block, laws), states.empty() ? nullptr : states.data());
    }
}

}  // namespace

double contact_energy(const SolidState& s)
{
    LaneSum sum;
    const auto add = variant_of<add_stored<false>, add_stored<true>>();
    for_each_block(s, [&](const FaceLanes& b, const double* states) { add(b, states, sum); });
    return sum.total();
}

ContactLoss contact_loss(const FaceContacts& c)
{
    LaneSum damage, friction;
    const auto add = variant_of<add_lost>();
    for (int block = 0; block < c.blocks(); ++block) {
        if (c.states[block].empty()) continue;
        add(c.areas.data() + c.block_points[block], c.states[block].data(),
            c.group_in(block).points, damage, friction);
    }
    return { damage.total(), friction.total() };
}

double softened_energy(const FaceContacts& c)
{
    LaneSum whole, friction;
    double rest = 0.0;
    const auto add = variant_of<add_lost>();
    for (int block = 0; block < c.blocks(); ++block) {
        if (c.states[block].empty()) continue;
        const double* areas = c.areas.data() + c.block_points[block];
        const Array<double>& states = c.states[block];
        const auto& cracks = c.cracks[block];
        if (cracks.empty()) add(areas, states.data(), c.group_in(block).points, whole, friction);
        for (std::size_t i = 0; i < cracks.size(); ++i) {
            const double* state = states.data() + i / lanes * FaceRow::count * lanes;
            if (cracks[i].mode != intact) continue;
            rest += areas[i] * state[FaceRow::damage_energy * lanes + i % lanes];
        }
    }
    return whole.total() + rest;
}

double sum_of_forces(const SolidState& s)
{
    double sum = 0.0;
    const auto add = variant_of<sum_forces<false>, sum_forces<true>>();
    for_each_block(s, [&](const FaceLanes& b, const double* states) {
        alignas(64) double forces[vector_rows];
        add(b, states, forces);
        for (int l = 0; l < lanes; ++l)
            sum += norm(load_vector(forces, l));  // 0 of a padded lane
    });
    return sum;
}

}  // namespace flexpm
