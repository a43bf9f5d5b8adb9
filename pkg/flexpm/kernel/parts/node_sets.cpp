// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Node sets: nodes with a prescribed motion, sums over them, and one that floats.
#include <flexpm/kernel/parts/node_sets.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/core/central_difference.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

NodeSet& set_at(Assembly& a, int set)
{
    if (set < 0 || set >= static_cast<int>(a.node_sets.size()))
        refuse("node set", set, "", "must be the number of a set; add one first");
    return a.node_sets[set];
}

/// What a set holds of a vector.
Vector held_part(const NodeSet& set, Vector p)
{
    return { set.holds_x ? p.x : 0.0, set.holds_y ? p.y : 0.0, set.holds_z ? p.z : 0.0 };
}

/// Force that a set exerts on one of its nodes: against all others on it.
Vector reaction_at(const Assembly& a, const NodeSet& set, std::size_t i)
{
    const int grain = set.grains[i];
    const Vector on = a.grains.is_rigid(grain) ? resultant_on(a.grains, grain).force
                                               : a.grains.vector(a.grains.force, set.nodes[i]);
    return held_part(set, Vector {} - on);
}

/// Velocity of a place of a set, at which a step takes it to where the rotation, about z, does.
Vector velocity_at(const NodeSet& set, Vector place, double dt)
{
    const double spin = set.spin.z;
    if (spin == 0.0) return set.velocity;
    const Vector arm = place - set.pivot;
    const double half = std::sin(0.5 * dt * spin), sine = std::sin(dt * spin);
    const double cosine_less_one = -2.0 * half * half;
    const Vector turned = { cosine_less_one * arm.x - sine * arm.y,
        sine * arm.x + cosine_less_one * arm.y, 0.0 };
    return set.velocity + (1.0 / dt) * turned;
}

void give_velocity(Grains& grains, const NodeSet& set, std::size_t i, Vector velocity, double dt)
{
    const int node = set.nodes[i], grain = set.grains[i];
    if (grains.is_rigid(grain)) {
        set_motion(grains, grain, in_plane(velocity), grains.spin[grains.slot[grain]], dt);
    } else {
        set_vector(grains.velocity, node, in_plane(velocity));
    }
}

/// What is held of it goes with the set, the rest stays.
Vector next_velocity(const NodeSet& set, Vector place, Vector old, double dt)
{
    const Vector v = velocity_at(set, place, dt);
    return { set.holds_x ? v.x : old.x, set.holds_y ? v.y : old.y, set.holds_z ? v.z : old.z };
}

/// Power of its forces on the translation of one that floats [W].
double float_power(const NodeSet& set) { return set.floats ? dot(set.force, set.velocity) : 0.0; }

void drive(Assembly& a, NodeSet& set, double dt)
{
    Grains& grains = a.grains;
    double power = 0.0;
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        const int node = set.nodes[i];
        const Vector old = vector_at(grains.velocity, node), force = reaction_at(a, set, i);
        const Vector next = next_velocity(set, grains.point_at(node), old, dt);
        power += dot(force, next);
        if (next.x == old.x && next.y == old.y && next.z == old.z) continue;
        give_velocity(grains, set, i, next, dt);
        a.ledger.prescribed_work[2 * grains.block_of(set.grains[i]) + 1] +=
            0.5 * dt * dot(force, next - old);
    }
    const double of_float = float_power(set);
    set.work_next = 0.5 * dt * (power - of_float);
    set.float_work_next = 0.5 * dt * of_float;
}

/// Force and moment of the last step, and their power with the velocities that the nodes had in it
/// [W].
double sum_reactions(const Assembly& a, NodeSet& set)
{
    double power = 0.0;
    set.force = {};
    set.moment = {};
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        const Vector force = reaction_at(a, set, i);
        set.force = set.force + force;
        set.moment = set.moment + cross(a.grains.point_at(set.nodes[i]) - set.pivot, force);
        power += dot(force, vector_at(a.grains.velocity, set.nodes[i]));
    }
    return power;
}

/// Mass of what a set holds, scaled or real [kg].
double mass_of(const Grains& grains, const NodeSet& set)
{
    double mass = 0.0;
    for (int n : set.nodes) {
        const double inverse = grains.inverse_mass[scalar_index(n)];
        mass += inverse > 0.0 ? 1.0 / inverse : 0.0;
    }
    return mass;
}

/// One that floats answers to the specimen: to minus the forces that hold its nodes.
///
/// @param undamped  part of its velocity that damping does not act on [m/s]
void integrate_floating(const Assembly& a, NodeSet& set, Vector undamped, double dt, double damping)
{
    const double mass = mass_of(a.grains, set), inverse = mass > 0.0 ? 1.0 / mass : 0.0;
    StepSums sums;
    integrate_one<true>(
        { -set.force.x, inverse, 0.0, undamped.x }, dt, damping, set.velocity.x, sums, 0);
    integrate_one<true>(
        { -set.force.y, inverse, 0.0, undamped.y }, dt, damping, set.velocity.y, sums, 0);
    integrate_one<true>(
        { -set.force.z, inverse, 0.0, undamped.z }, dt, damping, set.velocity.z, sums, 0);
    set.damping_work += set.damping_work_next + sums.damped[0];
    set.damping_work_next = sums.damped_next[0];
    set.drag_work += set.drag_work_next + sums.dragged[0];
    set.drag_work_next = sums.dragged[0];
    set.kinetic = sums.kinetic[0];
    set.unbalanced = sums.largest[0];
}

bool lies_on(const Assembly& a, const NodeSet& set, int facet)
{
    const auto nodes = a.facets.nodes(facet);
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        if (set.grains[i] != a.facets.grain[facet]) continue;
        const bool rigid = a.grains.is_rigid(set.grains[i]);
        if (rigid || std::count(nodes.begin(), nodes.end(), set.nodes[i]) != 0) return true;
    }
    return false;
}

/// @throws std::invalid_argument  if a node of the set lies on the face of the plate
void require_apart(const Assembly& a, const NodeSet& set, const Plate& plate)
{
    for (int i = 0; i < plate_points(plate); ++i) {
        const int facet = plate.facets[i / plate.points];
        if (plate.gap[i] != 0.0 || plate.area[i] == 0.0 || !lies_on(a, set, facet)) continue;
        refuse("node of a set", place(vector_at(a.grains.reference, a.facets.nodes(facet)[0])),
            "lies on a plate, must not; take another region or another place");
    }
}

}  // namespace

std::vector<int> holdable_nodes(const Assembly& a)
{
    std::vector<int> nodes;
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) continue;
        const int first = a.grains.is_rigid(g) ? a.grains.vertices_of(g) : 0;
        for (int k = first; k < a.grains.nodes_of(g); ++k)
            nodes.push_back(a.grains.node(g, k));
    }
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

int add_node_set(Assembly& a, const std::vector<int>& nodes, bool holds_x, bool holds_y)
{
    if (nodes.empty())
        refuse("nodes of a set", 0.0, "", "must be at least 1; take a larger region");
    const std::vector<int> there = holdable_nodes(a);
    NodeSet set;
    set.holds_x = holds_x;
    set.holds_y = holds_y;
    for (int n : nodes) {
        if (!std::binary_search(there.begin(), there.end(), n))
            refuse("node of a set", n, "", "must be a node that a set may hold");
        for (int axis = 0; axis < dimension; ++axis) {
            if (!set.holds(axis) || !a.grains.prescribed[component(n, axis)]) continue;
            refuse("node of a set", place(vector_at(a.grains.reference, n)),
                "is held already, must not be; take a region apart from that of other parts");
        }
        set.nodes.push_back(n);
        set.grains.push_back(grain_node(a.grains, n).grain);
        set.pivot = set.pivot + (1.0 / static_cast<double>(nodes.size())) * a.grains.point_at(n);
    }
    for (const Plate& plate : a.plates)
        require_apart(a, set, plate);
    for (int n : nodes) {
        for (int axis = 0; axis < dimension; ++axis) {
            if (!set.holds(axis)) continue;
            a.grains.prescribed[component(n, axis)] = 1;
            a.grains.velocity[component(n, axis)] = 0.0;
        }
    }
    a.node_sets.push_back(set);
    return static_cast<int>(a.node_sets.size()) - 1;
}

void set_pivot(Assembly& a, int set, Vector pivot)
{
    check_finite("pivot of a node set", pivot.x + pivot.y + pivot.z, "m");
    set_at(a, set).pivot = pivot;
}

void let_float(Assembly& a, int set) { set_at(a, set).floats = true; }

void set_motion_of(Assembly& a, int set, Vector velocity, double spin)
{
    check_finite("velocity of a node set", velocity.x + velocity.y + velocity.z, "m/s");
    check_finite("spin of a node set", spin, "rad/s");
    NodeSet& s = set_at(a, set);
    for (int axis = 0; axis < dimension; ++axis) {
        const double along = axis == 0 ? velocity.x : velocity.y;
        if (along == 0.0 || (s.holds(axis) && !s.floats)) continue;
        refuse(axis == 0 ? "velocity of a node set along x" : "velocity of a node set along y",
            along, "m/s",
            s.floats ? "must be 0 for one that turns freely" : "must be 0: it is free there");
    }
    if (!s.floats) s.velocity = velocity;
    s.spin = { 0.0, 0.0, spin };
}

void drive_node_sets(Assembly& a, double dt)
{
    for (NodeSet& set : a.node_sets)
        drive(a, set, dt);
}

void update_node_sets(Assembly& a, double dt, double damping)
{
    for (std::size_t i = 0; i < a.node_sets.size(); ++i) {
        NodeSet& set = a.node_sets[i];
        set.displacement = set.displacement + dt * set.velocity;
        set.pivot = set.pivot + dt * set.velocity;
        set.angle = set.angle + dt * set.spin;
        const double power = sum_reactions(a, set), of_float = float_power(set);
        set.work += set.work_next + 0.5 * dt * (power - of_float);
        set.float_work += set.float_work_next + 0.5 * dt * of_float;
        if (set.floats) integrate_floating(a, set, a.loading.of_set(i).velocity, dt, damping);
        drive(a, set, dt);
    }
}

double kinetic_of_velocity(const Assembly& a, const NodeSet& set)
{
    return set.floats ? 0.5 * mass_of(a.grains, set) * dot(set.velocity, set.velocity) : 0.0;
}

void require_apart(const Assembly& a, const Plate& plate)
{
    for (const NodeSet& set : a.node_sets)
        require_apart(a, set, plate);
}

}  // namespace flexpm
