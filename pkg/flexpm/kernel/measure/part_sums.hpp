// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What plates and node sets add to the sums over a specimen. One definition for the plane
/// and for space: `State` is Assembly or SolidState, whose members have the same names. SI units.
#pragma once

#include <flexpm/kernel/assembly/energy_ledger.hpp>
#include <flexpm/kernel/assembly/parts.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

namespace flexpm {

/// Sum of the first values of pairs: work done up to the present places.
inline double first_of_pairs(const Array<double>& pairs)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < pairs.size(); i += 2)
        sum += pairs[i];
    return sum;
}

/// Energy of friction of a plate's contacts [J].
inline double friction_of(const Plate& plate)
{
    return std::accumulate(plate.rubbed.begin(), plate.rubbed.end(), plate.friction_energy);
}

/// Dissipation of a specimen whose contacts have dissipated `contact`.
template <class State> Dissipation dissipation_of(const State& s, const ContactLoss& contact)
{
    Dissipation d;
    d.damage = contact.damage + s.ledger.removed_damage;
    d.friction = contact.friction + s.ledger.removed_friction;
    d.boundary_work = first_of_pairs(s.ledger.prescribed_work) + s.ledger.pressure_work;
    for (const Plate& p : s.plates) {
        d.friction += friction_of(p);
        d.boundary_work += p.boundary_work;
    }
    for (const NodeSet& set : s.node_sets)
        d.boundary_work -= set.float_work;  // which the ledger holds as work on its nodes
    return d;
}

/// Energies of a specimen without its softened points and its potential.
///
/// @param stored   in grains and contacts [J]
/// @param elastic  elastic(plate): stored in the contacts of a plate [J]
template <class State, class Elastic>
Energies energies_of(const State& s, const Dissipation& d, double stored, Elastic elastic)
{
    Energies e;
    e.kinetic = std::accumulate(s.ledger.kinetic.begin(), s.ledger.kinetic.end(), 0.0);
    e.elastic = stored;
    e.damage = d.damage;
    e.friction = d.friction;
    e.boundary_work = d.boundary_work;
    e.erased = s.ledger.erased;
    e.initial = s.ledger.initial;
    e.drag = first_of_pairs(s.ledger.drag_work);
    double damped = first_of_pairs(s.ledger.damping_work);
    for (const Plate& p : s.plates) {
        e.kinetic += p.kinetic;
        e.elastic += elastic(p);
        damped += p.damping_work;
        e.drag += p.drag_work;
    }
    for (const NodeSet& set : s.node_sets) {
        e.kinetic += set.kinetic;
        damped += set.damping_work;
        e.drag += set.drag_work;
    }
    e.damping = damped - e.drag;
    return e;
}

/// Call add(force, velocity) for each component that damping acts on, of loaded plates and of node
/// sets that float: unbalanced force [N], and velocity beyond that of the loading [m/s].
template <class State, class Add> void for_each_damped_part(const State& s, Add add)
{
    for (std::size_t i = 0; i < s.plates.size(); ++i) {
        const Plate& p = s.plates[i];
        if (!p.loaded) continue;
        add(p.unbalanced, dot(p.normal, p.velocity - s.loading.of_plate(i).velocity));
    }
    for (std::size_t i = 0; i < s.node_sets.size(); ++i) {
        const NodeSet& set = s.node_sets[i];
        if (!set.floats) continue;
        const Vector v = set.velocity - s.loading.of_set(i).velocity;
        add(set.force.x, v.x);
        add(set.force.y, v.y);
        add(set.force.z, v.z);
    }
}

/// Largest unbalanced force of a specimen [N]: component on a free node, or on a plate under a load
/// or a node set that floats, there divided by the number of its grains (deviation D103).
///
/// @param grain_of  grain of each facet of the boundary
template <class State> double largest_unbalanced(const State& s, const std::vector<int>& grain_of)
{
    const auto& forces = s.ledger.largest_force;
    double largest = *std::max_element(forces.begin(), forces.end());
    const auto per_grain = [](double force, const std::set<int>& grains) {
        return force / static_cast<double>(grains.size());
    };
    for (const Plate& p : s.plates) {
        if (!(p.unbalanced > 0.0)) continue;
        std::set<int> grains;
        for (int facet : p.facets)
            grains.insert(grain_of[facet]);
        largest = std::max(largest, per_grain(p.unbalanced, grains));
    }
    for (const NodeSet& set : s.node_sets) {
        if (!(set.unbalanced > 0.0)) continue;
        const std::set<int> grains(set.grains.begin(), set.grains.end());
        largest = std::max(largest, per_grain(set.unbalanced, grains));
    }
    return largest;
}

/// Largest unbalanced force over the mean of `contacts` contact forces [-].
inline double ratio_of_forces(double largest, double contacts, double sum_of_forces)
{
    if (sum_of_forces > 0.0) return largest * contacts / sum_of_forces;
    // a specimen that flies apart is not in balance
    return contacts > 0.0 && largest > 0.0 ? 1.0 : 0.0;
}

}  // namespace flexpm
