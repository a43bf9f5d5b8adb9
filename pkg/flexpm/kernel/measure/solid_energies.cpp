// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/solid_energies.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/core/lane_sum.hpp>
#include <flexpm/kernel/measure/part_sums.hpp>
#include <flexpm/kernel/space_lanes/face_lanes.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Stored in the points of a block. `states` is null of a block without any.
template <bool Wide>
FLEXPM_INLINE void add_stored(const FaceLanes& b, const double* states, LaneSum& energy)
{
    LaneSum sum = energy;  // a local, which no row aliases
    FaceMotion m;
    move_corners<Wide>(b, m);
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
    move_corners<Wide>(b, m);
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

double stored_in_points(const SolidState& s)
{
    LaneSum sum;
    const auto add = variant_of<add_stored<false>, add_stored<true>>();
    for_each_block(s, [&](const FaceLanes& b, const double* states) { add(b, states, sum); });
    return sum.total();
}

ContactLoss lost_in_points(const FaceContacts& c)
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

/// Dissipated by damage in points that have softened and not cracked [J].
double softened_in_points(const FaceContacts& c)
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

}  // namespace

Dissipation dissipation(const SolidState& s)
{
    return dissipation_of(s, lost_in_points(s.contacts));
}

Energies energies(const SolidState& s)
{
    Energies e =
        energies_of(s, dissipation(s), strain_energy(s) + stored_in_points(s), solid_plate_energy);
    e.softened = softened_in_points(s.contacts);
    return e;
}

double kinetic_of_velocities(const SolidState& s)
{
    double sum = kinetic_of_velocities(s.grains);
    for (const RigidBody& body : s.bodies)
        if (!body.spin_held) sum += 0.5 * dot(body.spin, body.angular_momentum);
    for (const Plate& plate : s.plates)
        if (plate.loaded) sum += 0.5 * plate.mass * dot(plate.velocity, plate.velocity);
    return sum;
}

double damping_power(const SolidState& s, double damping)
{
    const Grains& grains = s.grains;
    const GrainMotion& undamped = s.undamped();
    double total = 0.0;
    const auto add = [&](double force, double velocity) { total += std::fabs(force * velocity); };
    const auto add_node = [&](int node) {
        for (int axis = 0; axis < grains.layout.dimension; ++axis) {
            const int i = grains.component(node, axis);
            if (grains.prescribed[i]) continue;
            add(grains.force[i], grains.velocity[i] - undamped.velocity[i]);
        }
    };
    for (int g = 0; g < grains.count; ++g) {
        if (!grains.is_rigid(g)) {
            for (int n = 0; n < grains.nodes_of(g); ++n)
                add_node(grains.node(g, n));
            continue;
        }
        add_node(grains.centre(g));
        if (s.bodies[g].spin_held) continue;
        const Vector moment = wrench_on(s, g).moment,
                     spin = s.bodies[g].spin - spin_in(undamped, g);
        total += std::fabs(moment.x * spin.x) + std::fabs(moment.y * spin.y)
            + std::fabs(moment.z * spin.z);
    }
    for_each_damped_part(s, add);
    return damping * total;
}

double unbalanced_ratio(const SolidState& s)
{
    double sum = 0.0;
    const auto add = variant_of<sum_forces<false>, sum_forces<true>>();
    for_each_block(s, [&](const FaceLanes& b, const double* states) {
        alignas(64) double forces[vector_rows];
        add(b, states, forces);
        for (int l = 0; l < lanes; ++l)
            sum += norm(load_vector(forces, l));  // 0 of a padded lane
    });
    return ratio_of_forces(largest_unbalanced(s, s.surface.grain), s.contacts.count, sum);
}

std::string find_bad_number(const SolidState& s)
{
    const Grains& grains = s.grains;
    for (int g = 0; g < grains.count; ++g) {
        for (int n = 0; n < grains.nodes_of(g); ++n) {
            const int node = grains.node(g, n);
            const bool force = is_finite(space_vector(grains.force, node));
            if (force && is_finite(space_vector(grains.velocity, node))) continue;
            return std::string(force ? "velocity" : "force") + " of node " + std::to_string(n)
                + " of grain " + std::to_string(g) + " is not a finite number at step "
                + std::to_string(s.step) + "; lower the loading rate or check the material";
        }
    }
    return {};
}

CrackCount count_cracks(const SolidState& s)
{
    CrackCount count;
    for (const auto& block : s.contacts.cracks) {
        for (const FaceCrack& crack : block) {
            count.tensile += crack.mode == tensile_crack;
            count.shear += crack.mode == shear_crack;
        }
    }
    return count;
}

}  // namespace flexpm
