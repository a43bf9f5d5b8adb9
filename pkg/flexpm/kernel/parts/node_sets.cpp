// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Node sets: nodes with a prescribed motion, sums over them, and one that floats.
#include <flexpm/kernel/parts/node_sets.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/central_difference.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {

namespace {

NodeSet& set_at(BondedState& state, int set)
{
    if (set < 0 || set >= static_cast<int>(state.node_sets.size()))
        refuse("node set", set, "", "must be the index of a set; add one first");
    return state.node_sets[set];
}

bool is_2d(const Grains& grains) { return grains.layout.dimension == 2; }

/// Place of a node when bonded, in an error message.
std::string bonded_place(const Grains& grains, int node)
{
    const Vector p = grains.vector(grains.reference, node);
    return is_2d(grains) ? place(in_plane(p)) : place(p);
}

/// Call visit(node) for each node of a grain that has a motion of its own: of a rigid one the
/// centre.
template <class Visit> void for_each_mover(const Grains& grains, int grain, Visit visit)
{
    if (grains.is_rigid(grain)) {
        visit(grains.centre(grain));
        return;
    }
    for (int n = 0; n < grains.nodes_of(grain); ++n)
        visit(grains.node(grain, n));
}

// functions that know the dimension

std::array<int, 2> corners_of(const Assembly& a, int facet) { return a.facets.nodes(facet); }
std::array<int, 3> corners_of(const SolidState& s, int facet) { return s.surface.nodes[facet]; }

void set_body_velocity(Assembly& a, int grain, Vector velocity, double dt)
{
    set_motion(a.grains, grain, in_plane(velocity), a.grains.spin[a.grains.slot[grain]], dt);
}
void set_body_velocity(SolidState& s, int grain, Vector velocity, double)
{
    s.grains.set_vector(s.grains.velocity, s.grains.centre(grain), velocity);
}

/// All forces on a node that has a motion of its own, of a rigid grain on that [N].
Vector force_on(const Grains& grains, int grain, int node)
{
    return grains.is_rigid(grain) ? resultant_on(grains, grain).force
                                  : grains.vector(grains.force, node);
}

/// What a set holds of a vector.
Vector held_part(const NodeSet& set, Vector v)
{
    return { set.holds_x ? v.x : 0.0, set.holds_y ? v.y : 0.0, set.holds_z ? v.z : 0.0 };
}

/// Force that a set exerts on one of its nodes: against all others on it.
Vector reaction_at(const Grains& grains, const NodeSet& set, std::size_t i)
{
    return held_part(set, Vector {} - force_on(grains, set.grains[i], set.nodes[i]));
}

/// Force and moment of a set on the specimen.
void sum_reactions(const Grains& grains, NodeSet& set)
{
    set.force = {};
    set.moment = {};
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        const Vector force = reaction_at(grains, set, i);
        set.force = set.force + force;
        set.moment = set.moment + cross(grains.position(set.nodes[i]) - set.pivot, force);
    }
}

bool turns(const NodeSet& set) { return norm(set.spin) != 0.0; }

/// Power of its forces with the velocities that its nodes have [W].
double power_of(const Grains& grains, const NodeSet& set)
{
    if (!is_2d(grains) && !turns(set)) return dot(set.force, set.velocity);
    double power = 0.0;
    for (std::size_t i = 0; i < set.nodes.size(); ++i)
        power += dot(reaction_at(grains, set, i), grains.vector(grains.velocity, set.nodes[i]));
    return power;
}

/// Power of its forces on the translation of one that floats [W].
double float_power(const NodeSet& set) { return set.floats ? dot(set.force, set.velocity) : 0.0; }

/// What a set does in the half step that begins.
void promise_work(const Grains& grains, NodeSet& set, double dt)
{
    const double of_float = float_power(set);
    set.work_next = 0.5 * dt * (power_of(grains, set) - of_float);
    set.float_work_next = 0.5 * dt * of_float;
}

/// Velocity of a place of a set, at which a step takes it to where the rotation does.
Vector velocity_at(const Grains& grains, const NodeSet& set, Vector place, double dt)
{
    if (!turns(set)) return set.velocity;
    const Vector about_z = { 0.0, 0.0, 1.0 };
    const double rate = is_2d(grains) ? set.spin.z : norm(set.spin);
    const Vector axis = is_2d(grains) ? about_z : (1.0 / rate) * set.spin;
    const Vector around = cross(axis, place - set.pivot);
    const double half = std::sin(0.5 * dt * rate);
    const Vector turned = std::sin(dt * rate) * around + 2.0 * half * half * cross(axis, around);
    return set.velocity + (1.0 / dt) * turned;
}

/// What is held of a node goes with its set, the rest stays.
Vector next_velocity(const NodeSet& set, Vector along, Vector old)
{
    return { set.holds_x ? along.x : old.x, set.holds_y ? along.y : old.y,
        set.holds_z ? along.z : old.z };
}

/// Velocities of the nodes for the step that follows, what their change does to the work of the
/// half step that has begun, and what the set itself does in that.
template <class State> void drive(State& state, NodeSet& set, double dt)
{
    Grains& grains = state.grains;
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        const int node = set.nodes[i], grain = set.grains[i];
        const Vector old = grains.vector(grains.velocity, node);
        const Vector next =
            next_velocity(set, velocity_at(grains, set, grains.position(node), dt), old);
        if (next.x == old.x && next.y == old.y && next.z == old.z) continue;
        if (grains.is_rigid(grain))
            set_body_velocity(state, grain, next, dt);
        else
            grains.set_vector(grains.velocity, node, next);
        state.ledger.prescribed_work[2 * grains.block_of(grain) + 1] +=
            0.5 * dt * dot(reaction_at(grains, set, i), next - old);
    }
    promise_work(grains, set, dt);
}

/// Mass of what a set holds, scaled or real [kg].
double mass_of(const Grains& grains, const NodeSet& set)
{
    double mass = 0.0;
    for (int n : set.nodes) {
        const double inverse = grains.inverse_mass[grains.scalar_index(n)];
        mass += inverse > 0.0 ? 1.0 / inverse : 0.0;
    }
    return mass;
}

/// One that floats answers to the specimen: to minus the forces that hold its nodes.
///
/// @param undamped  part of its velocity that damping does not act on [m/s]
void integrate_floating(
    const Grains& grains, NodeSet& set, Vector undamped, double dt, double damping)
{
    const double mass = mass_of(grains, set), inverse = mass > 0.0 ? 1.0 / mass : 0.0;
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

template <class State> bool lies_on(const State& state, const NodeSet& set, int facet)
{
    const auto corners = corners_of(state, facet);
    const int grain = state.facet_grains()[facet];
    const bool rigid = state.grains.is_rigid(grain);
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        if (set.grains[i] != grain) continue;
        if (rigid || std::count(corners.begin(), corners.end(), set.nodes[i]) != 0) return true;
    }
    return false;
}

/// Whether a plate lies on the specimen with one of its points, as it was laid.
bool lies_down(const Plate& plate, int point)
{
    const double turned = dot(point_arm(plate, point), plate.turn);
    return plate.points[point].area > 0.0 && !(plate.points[point].gap - turned > 0.0);
}

/// @throws std::invalid_argument  if a node of the set lies on the face of the plate
template <class State>
void require_apart(const State& state, const NodeSet& set, const Plate& plate)
{
    for (int i = 0; i < plate_points(plate); ++i) {
        const int facet = plate.points[i].facet;
        if (!lies_down(plate, i) || !lies_on(state, set, facet)) continue;
        refuse("node of a set", bonded_place(state.grains, corners_of(state, facet)[0]),
            "lies on a plate, must not; use another region or move the plate");
    }
}

}  // namespace

std::vector<int> holdable_nodes(const BondedState& state)
{
    const Grains& grains = state.grains;
    std::vector<int> nodes;
    for (int g = 0; g < grains.count; ++g)
        if (!grains.erased[g]) for_each_mover(grains, g, [&](int n) { nodes.push_back(n); });
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

template <class State>
int add_node_set(State& state, const std::vector<int>& nodes, std::array<bool, 3> axes)
{
    Grains& grains = state.grains;
    if (nodes.empty()) refuse("nodes of a set", 0.0, "", "must be >= 1; use a larger region");
    if (!(axes[0] || axes[1] || axes[2]))
        refuse("axes of a set", 0.0, "", "must be >= 1; give an axis");
    const std::vector<int> there = holdable_nodes(state);
    NodeSet set;
    set.holds_x = axes[0];
    set.holds_y = axes[1];
    set.holds_z = axes[2];
    for (int n : nodes) {
        if (!std::binary_search(there.begin(), there.end(), n))
            refuse("node of a set", n, "", "must be a node that a set may hold");
        for (int axis = 0; axis < grains.layout.dimension; ++axis) {
            if (!set.holds(axis) || !grains.prescribed[grains.component(n, axis)]) continue;
            refuse("node of a set", bonded_place(grains, n),
                "is fixed already; use a region that does not overlap other parts");
        }
        set.nodes.push_back(n);
        set.grains.push_back(grain_node(grains, n).grain);
        set.pivot = set.pivot + (1.0 / static_cast<double>(nodes.size())) * grains.position(n);
    }
    for (const Plate& plate : state.plates)
        require_apart(state, set, plate);
    for (int n : nodes) {
        for (int axis = 0; axis < grains.layout.dimension; ++axis) {
            if (!set.holds(axis)) continue;
            grains.prescribed[grains.component(n, axis)] = 1;
            grains.velocity[grains.component(n, axis)] = 0.0;
        }
    }
    state.node_sets.push_back(set);
    return static_cast<int>(state.node_sets.size()) - 1;
}

void set_pivot(BondedState& state, int set, Vector pivot)
{
    check_finite("pivot of a node set", pivot.x + pivot.y + pivot.z, "m");
    set_at(state, set).pivot = pivot;
}

void let_float(BondedState& state, int set) { set_at(state, set).floats = true; }

void set_motion_of(BondedState& state, int set, Vector velocity, Vector spin)
{
    check_finite("velocity of a node set", velocity.x + velocity.y + velocity.z, "m/s");
    check_finite("spin of a node set", spin.x + spin.y + spin.z, "rad/s");
    NodeSet& s = set_at(state, set);
    const double along[] = { velocity.x, velocity.y, velocity.z };
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0 || (s.holds(axis) && !s.floats)) continue;
        refuse(std::string("velocity of a node set along ") + "xyz"[axis], along[axis], "m/s",
            s.floats ? "must be 0 for one that turns freely" : "must be 0: it is free there");
    }
    if (!s.floats) s.velocity = velocity;
    s.spin = spin;
}

template <class State> void drive_node_sets(State& state, double dt)
{
    for (NodeSet& set : state.node_sets)
        drive(state, set, dt);
}

void promise_work(SolidState& s, double dt)
{
    const Grains& grains = s.grains;
    for (int g = 0; g < grains.count; ++g) {
        double work = 0.0;
        bool any = false;
        for_each_mover(grains, g, [&](int node) {
            const Vector on = force_on(grains, g, node);
            const double force[] = { on.x, on.y, on.z };
            for (int axis = 0; axis < 3; ++axis) {
                const int i = grains.component(node, axis);
                if (!grains.prescribed[i]) continue;
                any = true;
                work -= 0.5 * dt * force[axis] * grains.velocity[i];
            }
        });
        // a spin that is held has its own work there
        if (any || !grains.is_rigid(g)) s.ledger.prescribed_work[2 * grains.block_of(g) + 1] = work;
    }
    for (NodeSet& set : s.node_sets)
        promise_work(grains, set, dt);
}

template <class State> void update_node_sets(State& state, double dt, double damping)
{
    for (std::size_t i = 0; i < state.node_sets.size(); ++i) {
        NodeSet& set = state.node_sets[i];
        set.displacement = set.displacement + dt * set.velocity;
        set.pivot = set.pivot + dt * set.velocity;
        set.angle = set.angle + dt * set.spin;
        sum_reactions(state.grains, set);
        if (!(dt > 0.0)) continue;
        const double of_float = float_power(set);
        set.work += set.work_next + 0.5 * dt * (power_of(state.grains, set) - of_float);
        set.float_work += set.float_work_next + 0.5 * dt * of_float;
        if (set.floats)
            integrate_floating(state.grains, set, state.loading.of_set(i).velocity, dt, damping);
        drive(state, set, dt);
    }
}

double kinetic_of_velocity(const BondedState& state, const NodeSet& set)
{
    return set.floats ? 0.5 * mass_of(state.grains, set) * dot(set.velocity, set.velocity) : 0.0;
}

template <class State> void require_apart(const State& state, const Plate& plate)
{
    for (const NodeSet& set : state.node_sets)
        require_apart(state, set, plate);
}

template int add_node_set(Assembly&, const std::vector<int>&, std::array<bool, 3>);
template int add_node_set(SolidState&, const std::vector<int>&, std::array<bool, 3>);
template void drive_node_sets(Assembly&, double);
template void drive_node_sets(SolidState&, double);
template void update_node_sets(Assembly&, double, double);
template void update_node_sets(SolidState&, double, double);
template void require_apart(const Assembly&, const Plate&);
template void require_apart(const SolidState&, const Plate&);

}  // namespace flexpm
