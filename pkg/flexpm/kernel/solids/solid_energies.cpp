// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_energies.hpp>

#include <flexpm/kernel/solids/solid_bodies.hpp>
#include <flexpm/kernel/solids/solid_plates.hpp>
#include <flexpm/kernel/solids/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flexpm {

namespace {

double strain_energy(const SolidState& s)
{
    double sum = 0.0;
    for (int block = 0; block < s.grains.blocks(); ++block) {
        if (s.grains.group(block).rigid) continue;
        const auto c = load_rows<PlaneStiffness>(
            &s.grains.stiffness[block * row_count<PlaneStiffness> * lanes], 0);
        for_each_tetrahedron(s, block, [&](const TetrahedronShape& t, std::array<int, 4> n) {
            const auto way = [&](int k) { return space_vector(s.grains.displacement, n[k]); };
            sum += tetrahedron_energy(t, c, way(0), way(1), way(2), way(3));
        });
    }
    return sum;
}

void add_points(const SolidState& s, Energies& e)
{
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const LawParameters& law = c.law_of(contact);
        for (int p = 0; p < c.points_of(contact); ++p) {
            const double area = c.area(contact, p);
            const FacePointState state = c.point_state(contact, p);
            e.elastic += area * law::elastic_energy(law, c.place_of(contact, p), state);
            e.damage += area * state.damage_energy;
            if (c.crack(contact, p).mode == intact) e.softened += area * state.damage_energy;
            e.friction += area * state.friction_energy;
        }
    }
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
    e.elastic = strain_energy(s);
    add_points(s, e);
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
    const LawParameters& law = contacts.law_of(contact);
    const FacePlace at = contacts.place_of(contact, point);
    const FacePointState state = contacts.point_state(contact, point);
    const double damage = law::damage(law, state.max_opening, state.shear_damage);
    const double opening = law::gap(law, at.opening, state);
    return { law::normal_traction(law, opening, state.max_opening, damage),
        law.shear_stiffness * (at.slip - state.plastic_slip), damage, damage };
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
    const FaceContacts& c = s.contacts;
    Dissipation d;
    for (int contact = 0; contact < c.count; ++contact) {
        for (int p = 0; p < c.points_of(contact); ++p) {
            const double area = c.area(contact, p);
            d.damage += area * c.state(contact, p, FaceRow::damage_energy);
            d.friction += area * c.state(contact, p, FaceRow::friction_energy);
        }
    }
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
    for (int contact = 0; contact < c.count; ++contact) {
        sum += norm(force_in(c, contact));
    }
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
    for (int c = 0; c < s.contacts.count; ++c) {
        for (int p = 0; p < s.contacts.points_of(c); ++p) {
            count.tensile += s.contacts.crack(c, p).mode == tensile_crack;
            count.shear += s.contacts.crack(c, p).mode == shear_crack;
        }
    }
    return count;
}

}  // namespace flexpm
