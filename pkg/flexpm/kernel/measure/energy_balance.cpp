// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sums over an assembly.
#include <flexpm/kernel/measure/energy_balance.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

namespace flexpm {

namespace {

double first_of_pairs(const Array<double>& values)
{
    double total = 0.0;
    for (std::size_t i = 0; i < values.size(); i += 2)
        total += values[i];
    return total;
}

FLEXPM_INLINE bool all_finite(const double* values, int count)
{
    std::int64_t bad = 0;
    for (int i = 0; i < count; ++i)
        bad |= !(std::fabs(values[i]) <= std::numeric_limits<double>::max());
    return bad == 0;
}

}  // namespace

double kinetic_of_velocities(const Assembly& a)
{
    double total = 0.0;
    for (int g = 0; g < a.grains; ++g) {
        const int i = rigid_index(a, g);
        if (a.is_rigid(g) && !a.spin_held[i] && a.inverse_inertia[i] > 0.0) {
            total += 0.5 * a.spin[i] * a.spin[i] / a.inverse_inertia[i];
        }
        for (int n = 0; n < a.nodes_of(g); ++n) {
            const int node = a.node(g, n);
            const double inverse_mass = a.inverse_mass[scalar_index(node)];
            if (inverse_mass == 0.0) continue;
            for (int i : { node, node + lanes }) {
                if (!a.held[i]) total += 0.5 * a.velocity[i] * a.velocity[i] / inverse_mass;
            }
        }
    }
    return total;
}

Dissipation dissipation(const Assembly& a)
{
    const ContactLoss contact = contact_loss(a);
    Dissipation d;
    d.damage = contact.damage + a.past_damage;
    d.friction = contact.friction + a.past_friction;
    d.boundary_work = first_of_pairs(a.driven_work) + a.pressure_work;
    for (const Plate& p : a.plates) {
        d.friction += p.friction_energy;
        d.boundary_work += p.boundary_work;
    }
    return d;
}

Energies energies(const Assembly& a)
{
    const Dissipation d = dissipation(a);
    Energies e;
    for (double k : a.kinetic)
        e.kinetic += k;
    e.elastic = strain_energy(a) + contact_energy(a);
    e.damage = d.damage;
    e.friction = d.friction;
    e.damping = first_of_pairs(a.damping_work);
    e.potential = potential_energy(a);
    e.boundary_work = d.boundary_work;
    for (const Plate& p : a.plates) {
        e.kinetic += p.kinetic;
        e.elastic += elastic_energy(p);
        e.damping += p.damping_work;
    }
    e.initial = a.initial_energy;
    return e;
}

void open_books(Assembly& a)
{
    for (int c = 0; c < a.contacts; ++c) {
        for (int p = 0; p < a.points; ++p) {
            for (int row : { 5, 6 }) {  // the two dissipated energies
                a.point_state[row_index(
                    c, p * ContactRows::state + row, a.points * ContactRows::state)] = 0.0;
            }
        }
    }
    // the halves of the last step's works that fall into the next step stay
    for (auto* work : { &a.damping_work, &a.driven_work }) {
        for (std::size_t i = 0; i < work->size(); i += 2)
            (*work)[i] = 0.0;
    }
    a.pressure_work = a.past_damage = a.past_friction = 0.0;
    for (Plate& p : a.plates)
        p.boundary_work = p.damping_work = p.friction_energy = 0.0;
    if (a.step == 0) a.kinetic[0] = kinetic_of_velocities(a);
    const Energies now = energies(a);
    a.initial_energy = now.kinetic + now.elastic + now.potential;
}

double unbalanced_ratio(const Assembly& a)
{
    double largest = *std::max_element(a.largest_force.begin(), a.largest_force.end());
    for (const Plate& p : a.plates)
        largest = std::max(largest, p.unbalanced);
    const double sum = sum_of_forces(a);
    return sum > 0.0 ? largest * a.contacts / sum : 0.0;
}

CrackCount count_cracks(const Assembly& a)
{
    CrackCount count;
    for (std::uint8_t mode : a.crack_mode) {
        count.tensile += mode == tensile_crack;
        count.shear += mode == shear_crack;
    }
    return count;
}

std::string find_bad_number(const Assembly& a)
{
    const int values = static_cast<int>(a.force.size());
    const auto finite = variant_of<all_finite>();
    if (finite(a.force.data(), values) && finite(a.velocity.data(), values)) return {};
    for (int g = 0; g < a.grains; ++g) {
        for (int n = 0; n < a.nodes_of(g); ++n) {
            for (int c = 0; c < 2; ++c) {
                const int i = a.node(g, n) + c * lanes;
                const bool force = std::isfinite(a.force[i]);
                if (force && std::isfinite(a.velocity[i])) continue;
                std::ostringstream text;
                text << (force ? "velocity" : "force") << " of node " << n << " of grain " << g
                     << " is not a finite number at step " << a.step
                     << "; lower the loading rate or check the material";
                return text.str();
            }
        }
    }
    return {};
}

}  // namespace flexpm
