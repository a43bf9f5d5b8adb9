// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sums over a specimen.
#include <flexpm/kernel/measure/energy_balance.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/measure/face_sums.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <type_traits>
#include <vector>

namespace flexpm {

namespace {

template <class State> constexpr bool is_plane = std::is_same_v<State, Assembly>;

FLEXPM_INLINE bool all_finite(const double* values, int count)
{
    std::int64_t bad = 0;
    for (int i = 0; i < count; ++i)
        bad |= !(std::fabs(values[i]) <= std::numeric_limits<double>::max());
    return bad == 0;
}

/// Sum of the first values of pairs: work done up to the present places.
double first_of_pairs(const Array<double>& pairs)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < pairs.size(); i += 2)
        sum += pairs[i];
    return sum;
}

/// Sum of value(pair) over the pairs of grains without a common face, which are in 3D.
template <class State, class Value> double sum_of_pairs(const State& s, Value value)
{
    double sum = 0.0;
    if constexpr (!is_plane<State>)
        for (const PairContact& pair : s.pairs)
            sum += value(pair);
    return sum;
}

/// Stored in grains and contacts [J].
template <class State> double stored_energy(const State& s)
{
    if constexpr (is_plane<State>)
        return strain_energy(s.grains) + contact_energy(s.contacts);
    else
        return strain_energy(s) + contact_energy(s)
            + sum_of_pairs(s, [](const PairContact& p) { return p.elastic_energy; });
}

/// Spin of a rigid grain beyond the one that damping leaves alone; 0 of one whose spin is given.
template <class State> Vector free_spin(const State& s, int grain)
{
    if constexpr (is_plane<State>) {
        const int slot = s.grains.slot[grain];
        if (s.grains.spin_prescribed[slot]) return {};
        return { 0.0, 0.0, s.grains.spin[slot] - s.undamped().spin[slot] };
    } else {
        if (s.bodies[grain].spin_held) return {};
        return s.bodies[grain].spin - spin_in(s.undamped(), grain);
    }
}

/// Call add(force, velocity) for each component that damping acts on, of loaded plates and of node
/// sets that float: unbalanced force [N], and velocity beyond that of the loading [m/s].
template <class Add> void for_each_damped_part(const BondedState& s, Add add)
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
double largest_unbalanced(const BondedState& s, const std::vector<int>& grain_of)
{
    const auto& forces = s.ledger.largest_force;
    double largest = *std::max_element(forces.begin(), forces.end());
    const auto per_grain = [](double force, const std::set<int>& grains) {
        return force / static_cast<double>(grains.size());
    };
    for (const Plate& p : s.plates) {
        if (!(p.unbalanced > 0.0)) continue;
        std::set<int> grains;
        for (const PlatePoint& point : p.points)
            grains.insert(grain_of[point.facet]);
        largest = std::max(largest, per_grain(p.unbalanced, grains));
    }
    for (const NodeSet& set : s.node_sets) {
        if (!(set.unbalanced > 0.0)) continue;
        const std::set<int> grains(set.grains.begin(), set.grains.end());
        largest = std::max(largest, per_grain(set.unbalanced, grains));
    }
    return largest;
}

/// Grain of each facet of the boundary.
template <class State> const std::vector<int>& grain_of_facets(const State& s)
{
    if constexpr (is_plane<State>)
        return s.facets.grain;
    else
        return s.surface.grain;
}

/// Largest unbalanced force over the mean of `contacts` contact forces [-].
double ratio_of_forces(double largest, double contacts, double sum_of_forces)
{
    if (sum_of_forces > 0.0) return largest * contacts / sum_of_forces;
    // a specimen that flies apart is not in balance
    return contacts > 0.0 && largest > 0.0 ? 1.0 : 0.0;
}

/// Call visit(mode) for all points of contacts that may have cracked.
template <class Visit> void for_each_crack_mode(const Contacts& contacts, Visit visit)
{
    for (std::uint8_t mode : contacts.crack_modes)
        visit(mode);
}
template <class Visit> void for_each_crack_mode(const FaceContacts& contacts, Visit visit)
{
    for (const auto& block : contacts.cracks)
        for (const FaceCrack& crack : block)
            visit(crack.mode);
}

}  // namespace

template <class State> double damping_power(const State& s, double damping)
{
    const Grains& grains = s.grains;
    const Array<double>& undamped = s.undamped().velocity;
    double total = 0.0;
    const auto add = [&](double force, double velocity) { total += std::fabs(force * velocity); };
    const auto add_vector = [&](Vector force, int node) {
        const Vector v = grains.vector(grains.velocity, node) - grains.vector(undamped, node);
        const auto is_free = [&](int axis) {
            return !grains.prescribed[grains.component(node, axis)];
        };
        if (is_free(0)) add(force.x, v.x);
        if (is_free(1)) add(force.y, v.y);
        if (grains.layout.dimension == 3 && is_free(2)) add(force.z, v.z);
    };
    for (int g = 0; g < grains.count; ++g) {
        if (grains.is_rigid(g)) {
            const Resultant on = resultant_on(s, g);
            add_vector(on.force, grains.centre(g));
            const Vector spin = free_spin(s, g);
            total += std::fabs(on.moment.x * spin.x) + std::fabs(on.moment.y * spin.y)
                + std::fabs(on.moment.z * spin.z);
            continue;
        }
        for (int n = 0; n < grains.nodes_of(g); ++n)
            add_vector(grains.vector(grains.force, grains.node(g, n)), grains.node(g, n));
    }
    for_each_damped_part(s, add);
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

template <class State> double kinetic_of_velocities(const State& s)
{
    double sum = kinetic_of_velocities(s.grains);
    if constexpr (!is_plane<State>)
        for (const RigidBody& body : s.bodies)
            if (!body.spin_held) sum += 0.5 * dot(body.spin, body.angular_momentum);
    for (const Plate& plate : s.plates)
        if (plate.loaded) sum += 0.5 * plate.mass * dot(plate.velocity, plate.velocity);
    for (const NodeSet& set : s.node_sets)
        sum += kinetic_of_velocity(s, set);
    return sum;
}

template <class State> Dissipation dissipation(const State& s)
{
    const ContactLoss contact = contact_loss(s.contacts);
    Dissipation d;
    d.damage = contact.damage + s.ledger.removed_damage;
    d.friction = contact.friction + s.ledger.removed_friction
        + sum_of_pairs(s, [](const PairContact& p) { return p.friction_energy; });
    d.boundary_work = first_of_pairs(s.ledger.prescribed_work) + s.ledger.pressure_work;
    for (const Plate& p : s.plates) {
        d.friction += p.friction_energy;
        d.boundary_work += p.boundary_work;
    }
    for (const NodeSet& set : s.node_sets)
        d.boundary_work -= set.float_work;  // which the ledger holds as work on its nodes
    return d;
}

template <class State> Energies energies(const State& s)
{
    const Dissipation d = dissipation(s);
    Energies e;
    e.kinetic = std::accumulate(s.ledger.kinetic.begin(), s.ledger.kinetic.end(), 0.0);
    e.elastic = stored_energy(s);
    e.damage = d.damage;
    e.softened = softened_energy(s.contacts);
    e.friction = d.friction;
    e.boundary_work = d.boundary_work;
    e.erased = s.ledger.erased;
    e.initial = s.ledger.initial;
    e.drag = first_of_pairs(s.ledger.drag_work);
    double damped = first_of_pairs(s.ledger.damping_work);
    for (const Plate& p : s.plates) {
        e.kinetic += p.kinetic;
        e.elastic += elastic_energy(p);
        damped += p.damping_work;
        e.drag += p.drag_work;
    }
    for (const NodeSet& set : s.node_sets) {
        e.kinetic += set.kinetic;
        damped += set.damping_work;
        e.drag += set.drag_work;
    }
    e.damping = damped - e.drag;
    e.potential = potential_energy(s);
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
    for (Plate& p : a.plates) {
        p.boundary_work = p.damping_work = p.drag_work = p.friction_energy = 0.0;
        for (PlatePoint& point : p.points)
            point.friction_energy = 0.0;
    }
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

template <class State> double unbalanced_ratio(const State& s)
{
    double contacts = s.contacts.count, sum = 0.0;
    if constexpr (is_plane<State>) {
        const auto& erased = s.contacts.erased;
        contacts -= static_cast<double>(std::count(erased.begin(), erased.end(), 1));
        sum = sum_of_forces(s.contacts);
    } else {
        const auto& ended = s.contacts.ended;
        contacts -= static_cast<double>(std::count(ended.begin(), ended.end(), 1));
        contacts += sum_of_pairs(s, [](const PairContact& p) { return p.presses() ? 1.0 : 0.0; });
        sum =
            sum_of_forces(s) + sum_of_pairs(s, [](const PairContact& p) { return norm(p.force); });
    }
    return ratio_of_forces(largest_unbalanced(s, grain_of_facets(s)), contacts, sum);
}

template <class State> CrackCount count_cracks(const State& s)
{
    CrackCount count;
    for_each_crack_mode(s.contacts, [&](int mode) {
        count.tensile += mode == tensile_crack;
        count.shear += mode == shear_crack;
    });
    return count;
}

std::string find_bad_number(const BondedState& s)
{
    const Grains& grains = s.grains;
    const int values = static_cast<int>(grains.force.size());
    const auto finite = variant_of<all_finite>();
    if (finite(grains.force.data(), values) && finite(grains.velocity.data(), values)) return {};
    for (int g = 0; g < grains.count; ++g) {
        for (int n = 0; n < grains.nodes_of(g); ++n) {
            const int node = grains.node(g, n);
            const bool force = is_finite(grains.vector(grains.force, node));
            if (force && is_finite(grains.vector(grains.velocity, node))) continue;
            return std::string(force ? "velocity" : "force") + " of node " + std::to_string(n)
                + " of grain " + std::to_string(g) + " is not a finite number at step "
                + std::to_string(s.step) + "; lower the loading rate or check the material";
        }
    }
    return {};
}

template Energies energies(const Assembly&);
template Energies energies(const SolidState&);
template double kinetic_of_velocities(const Assembly&);
template double kinetic_of_velocities(const SolidState&);
template Dissipation dissipation(const Assembly&);
template Dissipation dissipation(const SolidState&);
template double damping_power(const Assembly&, double);
template double damping_power(const SolidState&, double);
template double unbalanced_ratio(const Assembly&);
template double unbalanced_ratio(const SolidState&);
template CrackCount count_cracks(const Assembly&);
template CrackCount count_cracks(const SolidState&);

}  // namespace flexpm
