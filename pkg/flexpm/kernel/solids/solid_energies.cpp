// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_energies.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/measure/lane_sum.hpp>
#include <flexpm/kernel/solids/face_lanes.hpp>
#include <flexpm/kernel/solids/solid_bodies.hpp>
#include <flexpm/kernel/solids/solid_plates.hpp>
#include <flexpm/kernel/solids/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flexpm {

namespace {

/// Stored in the points of a block.
FLEXPM_INLINE void add_stored(
    const double* areas, const double* states, const double* law, int points, LaneSum& energy)
{
    LaneSum sum = energy;  // a local, which no row aliases
    for (int p = 0; p < points; ++p) {
        const double *area = areas + p * lanes, *state = states + p * FaceRow::count * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            sum.lane[l] += area[l]
                * law::elastic_energy(
                    load_rows<LawParameters>(law, l), load_place(state, l), load_state(state, l));
        }
    }
    energy = sum;
}

/// Dissipated in the points of a block.
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

/// Forces that the contacts of a block bear, along normal and tangents, three rows.
FLEXPM_INLINE void sum_forces(
    const double* areas, const double* states, const double* law, int points, double* forces)
{
    alignas(64) double sum[vector_rows] = {};
    for (int p = 0; p < points; ++p) {
        const double *area = areas + p * lanes, *state = states + p * FaceRow::count * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const FaceTraction t = traction_at(
                load_rows<LawParameters>(law, l), load_place(state, l), load_state(state, l));
            store_vector(
                load_vector(sum, l) + area[l] * Vector { t.normal, t.shear.x, t.shear.y }, sum, l);
        }
    }
    for (int i = 0; i < vector_rows; ++i)
        forces[i] = sum[i];
}

/// Call visit(block, areas, states, laws, points) for the rows of each block of contacts.
template <class Visit> void for_each_block(const FaceContacts& c, Visit visit)
{
    FaceLaws laws;
    for (int block = 0; block < c.blocks(); ++block) {
        if (block == 0 || c.laws.size() > 1) laws.fill(c, block);
        const int first = c.block_points[block];
        visit(block, c.areas.data() + first, c.states.data() + first * FaceRow::count, laws.rows,
            c.group_in(block).points);
    }
}

double stored_in_points(const FaceContacts& c)
{
    LaneSum sum;
    const auto add = variant_of<add_stored>();
    for_each_block(
        c, [&](int, const double* areas, const double* states, const double* laws, int points) {
            add(areas, states, laws, points, sum);
        });
    return sum.total();
}

ContactLoss lost_in_points(const FaceContacts& c)
{
    LaneSum damage, friction;
    const auto add = variant_of<add_lost>();
    for_each_block(
        c, [&](int, const double* areas, const double* states, const double*, int points) {
            add(areas, states, points, damage, friction);
        });
    return { damage.total(), friction.total() };
}

/// Dissipated by damage in points that have softened and not cracked [J].
double softened_in_points(const FaceContacts& c)
{
    LaneSum whole, friction;
    double rest = 0.0;
    const auto add = variant_of<add_lost>();
    for_each_block(
        c, [&](int block, const double* areas, const double* states, const double*, int points) {
            const auto& cracks = c.cracks[block];
            if (cracks.empty()) add(areas, states, points, whole, friction);
            for (std::size_t i = 0; i < cracks.size(); ++i) {
                const double* state = states + i / lanes * FaceRow::count * lanes;
                if (cracks[i].mode != intact) continue;
                rest += areas[i] * state[FaceRow::damage_energy * lanes + i % lanes];
            }
        });
    return whole.total() + rest;
}

/// First of each pair: what has been done up to the present places.
double sum_of_first(const Array<double>& pairs)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < pairs.size(); i += 2)
        sum += pairs[i];
    return sum;
}

}  // namespace

Energies energies(const SolidState& s)
{
    Energies e;
    e.kinetic = std::accumulate(s.ledger.kinetic.begin(), s.ledger.kinetic.end(), 0.0);
    e.elastic = strain_energy(s) + stored_in_points(s.contacts);
    const ContactLoss lost = lost_in_points(s.contacts);
    e.damage = lost.damage;
    e.friction = lost.friction;
    e.softened = softened_in_points(s.contacts);
    e.drag = sum_of_first(s.ledger.drag_work);
    e.damping = sum_of_first(s.ledger.damping_work) - e.drag;
    e.boundary_work = sum_of_first(s.ledger.prescribed_work) + s.ledger.pressure_work;
    for (const Plate& plate : s.plates) {
        e.elastic += solid_plate_energy(plate);
        e.friction += rubbed_energy(plate);
        e.boundary_work += plate.boundary_work;
    }
    e.initial = s.ledger.initial;
    return e;
}

FaceTraction traction_of(const FaceContacts& contacts, int contact, int point)
{
    return traction_at(contacts.law_of(contact), contacts.place_of(contact, point),
        contacts.point_state(contact, point));
}

double kinetic_of_velocities(const SolidState& s)
{
    double sum = kinetic_of_velocities(s.grains);
    for (const RigidBody& body : s.bodies)
        if (!body.spin_held) sum += 0.5 * dot(body.spin, body.angular_momentum);
    return sum;
}

Dissipation dissipation(const SolidState& s)
{
    const ContactLoss lost = lost_in_points(s.contacts);
    Dissipation d;
    d.damage = lost.damage;
    d.friction = lost.friction;
    d.boundary_work = sum_of_first(s.ledger.prescribed_work) + s.ledger.pressure_work;
    for (const Plate& plate : s.plates)
        d.boundary_work += plate.boundary_work;
    return d;
}

double damping_power(const SolidState& s, double damping)
{
    const Grains& grains = s.grains;
    const GrainMotion& undamped = s.undamped();
    double total = 0.0;
    const auto add_node = [&](int node) {
        for (int axis = 0; axis < grains.layout.dimension; ++axis) {
            const int i = grains.component(node, axis);
            if (grains.prescribed[i]) continue;
            total += std::fabs(grains.force[i] * (grains.velocity[i] - undamped.velocity[i]));
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
    return damping * total;
}

Vector force_in(const FaceContacts& contacts, int contact)
{
    Vector sum;
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const FaceTraction t = traction_of(contacts, contact, p);
        sum = sum + contacts.area(contact, p) * Vector { t.normal, t.shear.x, t.shear.y };
    }
    return sum;
}

double unbalanced_ratio(const SolidState& s)
{
    const auto& forces = s.ledger.largest_force;
    const double largest = *std::max_element(forces.begin(), forces.end());
    const FaceContacts& c = s.contacts;
    double sum = 0.0;
    const auto add = variant_of<sum_forces>();
    for_each_block(
        c, [&](int, const double* areas, const double* states, const double* laws, int points) {
            alignas(64) double forces[vector_rows];
            add(areas, states, laws, points, forces);
            for (int l = 0; l < lanes; ++l)
                sum += norm(load_vector(forces, l));  // 0 of a padded lane
        });
    if (sum > 0.0) return largest * c.count / sum;
    // a specimen that flies apart is not in balance
    return c.count > 0 && largest > 0.0 ? 1.0 : 0.0;
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
