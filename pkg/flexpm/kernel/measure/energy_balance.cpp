// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sums over an assembly.
#include <flexpm/kernel/measure/energy_balance.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/measure/part_sums.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace flexpm {

namespace {

FLEXPM_INLINE bool all_finite(const double* values, int count)
{
    std::int64_t bad = 0;
    for (int i = 0; i < count; ++i)
        bad |= !(std::fabs(values[i]) <= std::numeric_limits<double>::max());
    return bad == 0;
}

}  // namespace

double damping_power(const Assembly& a, double damping)
{
    const Grains& grains = a.grains;
    const GrainMotion& undamped = a.undamped();
    double total = 0.0;
    const auto add = [&](double force, double velocity) { total += std::fabs(force * velocity); };
    const auto add_vector = [&](Point force, int node) {
        const Point v = grains.velocity_at(node) - grains.vector_at(undamped.velocity, node);
        if (!grains.prescribed[grains.component(node, 0)]) add(force.x, v.x);
        if (!grains.prescribed[grains.component(node, 1)]) add(force.y, v.y);
    };
    for (int g = 0; g < grains.count; ++g) {
        if (grains.is_rigid(g)) {
            const int slot = grains.slot[g];
            const Resultant on = resultant_on(grains, g);
            add_vector(on.force, grains.centre(g));
            if (!grains.spin_prescribed[slot])
                add(on.moment, grains.spin[slot] - undamped.spin[slot]);
            continue;
        }
        for (int n = 0; n < grains.nodes_of(g); ++n)
            add_vector(grains.force_at(grains.node(g, n)), grains.node(g, n));
    }
    for_each_damped_part(a, add);
    return damping * total;
}

double kinetic_of_velocities(const Grains& grains)
{
    double total = 0.0;
    for (int g = 0; g < grains.count; ++g) {
        const int slot = grains.slot[g];
        const double inverse_inertia = grains.inverse_inertia[slot], spin = grains.spin[slot];
        if (grains.is_rigid(g) && !grains.spin_prescribed[slot] && inverse_inertia > 0.0) {
            total += 0.5 * spin * spin / inverse_inertia;
        }
        for (int n = 0; n < grains.nodes_of(g); ++n) {
            const int node = grains.node(g, n);
            const double inverse_mass = grains.inverse_mass[grains.scalar_index(node)];
            if (inverse_mass == 0.0) continue;
            for (int axis = 0; axis < grains.layout.dimension; ++axis) {
                const int i = grains.component(node, axis);
                if (grains.prescribed[i]) continue;
                total += 0.5 * grains.velocity[i] * grains.velocity[i] / inverse_mass;
            }
        }
    }
    return total;
}

Dissipation dissipation(const Assembly& a) { return dissipation_of(a, contact_loss(a.contacts)); }

Energies energies(const Assembly& a)
{
    const double stored = strain_energy(a.grains) + contact_energy(a.contacts);
    Energies e =
        energies_of(a, dissipation(a), stored, [](const Plate& p) { return elastic_energy(p); });
    e.softened = softened_energy(a.contacts);
    e.potential = potential_energy(a);
    return e;
}

void reset_energy_balance(Assembly& a)
{
    Contacts& contacts = a.contacts;
    for (int c = 0; c < contacts.count; ++c) {
        for (int p = 0; p < contacts.points_of(c); ++p) {
            set_dissipated(contacts, c, p, 0.0, 0.0);
            PointCrack crack = contacts.crack(c, p);
            crack.energy = 0.0;
            contacts.set_crack(c, p, crack);
        }
    }
    // before the first step there is no work but that of the elastic start, which stays
    const double start = a.step == 0 ? first_of_pairs(a.ledger.prescribed_work) : 0.0;
    // the halves of the last step's works that fall into the next step stay
    for (auto* work : { &a.ledger.damping_work, &a.ledger.drag_work, &a.ledger.prescribed_work }) {
        for (std::size_t i = 0; i < work->size(); i += 2)
            (*work)[i] = 0.0;
    }
    a.ledger.prescribed_work[0] = start;
    a.ledger.pressure_work = a.ledger.removed_damage = a.ledger.removed_friction = 0.0;
    a.ledger.erased = 0.0;
    for (Plate& p : a.plates)
        p.boundary_work = p.damping_work = p.drag_work = p.friction_energy = 0.0;
    for (NodeSet& set : a.node_sets)
        set.work = set.float_work = set.damping_work = set.drag_work = 0.0;
    if (a.step == 0) {
        a.ledger.kinetic[0] = kinetic_of_velocities(a.grains);
        a.ledger.erased_next = 0.0;
        for (NodeSet& set : a.node_sets)
            set.kinetic = kinetic_of_velocity(a, set);
    }
    const Energies now = energies(a);
    a.ledger.initial = now.kinetic + now.elastic + now.potential - start;
}

double unbalanced_ratio(const Assembly& a)
{
    const auto& erased = a.contacts.erased;
    const auto left = a.contacts.count - std::count(erased.begin(), erased.end(), 1);
    return ratio_of_forces(largest_unbalanced(a, a.facets.grain), static_cast<double>(left),
        sum_of_forces(a.contacts));
}

CrackCount count_cracks(const Assembly& a)
{
    CrackCount count;
    for (std::uint8_t mode : a.contacts.crack_modes) {
        count.tensile += mode == tensile_crack;
        count.shear += mode == shear_crack;
    }
    return count;
}

std::string find_bad_number(const Assembly& a)
{
    const Grains& grains = a.grains;
    const int values = static_cast<int>(grains.force.size());
    const auto finite = variant_of<all_finite>();
    if (finite(grains.force.data(), values) && finite(grains.velocity.data(), values)) return {};
    for (int g = 0; g < grains.count; ++g) {
        for (int n = 0; n < grains.nodes_of(g); ++n) {
            const int node = grains.node(g, n);
            const bool force = is_finite(grains.force_at(node));
            if (force && is_finite(grains.velocity_at(node))) continue;
            return std::string(force ? "velocity" : "force") + " of node " + std::to_string(n)
                + " of grain " + std::to_string(g) + " is not a finite number at step "
                + std::to_string(a.step) + "; lower the loading rate or check the material";
        }
    }
    return {};
}

}  // namespace flexpm
