// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/solid_sets.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/forces/solid_sides.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace flexpm {

namespace {

NodeSet& set_at(SolidState& s, int set)
{
    if (set < 0 || set >= static_cast<int>(s.node_sets.size()))
        refuse("node set", set, "", "must be the number of a set; add one first");
    return s.node_sets[set];
}

/// Call visit(node) for each node of a grain that has a motion of its own: of a rigid one the
/// centre.
template <class Visit> void for_each_mover(const SolidState& s, int grain, Visit visit)
{
    if (s.grains.is_rigid(grain)) {
        visit(s.grains.centre(grain));
        return;
    }
    for (int n = 0; n < s.grains.nodes_of(grain); ++n)
        visit(s.grains.node(grain, n));
}

/// The grain of each node that a set may hold.
using Holdable = std::map<int, int>;

Holdable holdable(const SolidState& s)
{
    Holdable found;
    for (int g = 0; g < s.grains.count; ++g) {
        for_each_mover(s, g, [&](int node) { found[node] = g; });
    }
    return found;
}

/// All forces on a node that has a motion of its own, of a rigid grain on that [N].
Vector force_on(const SolidState& s, int grain, int node)
{
    return s.grains.is_rigid(grain) ? resultant_on(s.grains, grain).force
                                    : space_vector(s.grains.force, node);
}

/// What a set holds of a vector.
Vector held_part(const NodeSet& set, Vector v)
{
    return { set.holds_x ? v.x : 0.0, set.holds_y ? v.y : 0.0, set.holds_z ? v.z : 0.0 };
}

/// Force that a set exerts on one of its nodes: against all others on it.
Vector reaction_at(const SolidState& s, const NodeSet& set, std::size_t i)
{
    return held_part(set, Vector {} - force_on(s, set.grains[i], set.nodes[i]));
}

/// Force and moment of a set on the specimen.
void sum_reactions(const SolidState& s, NodeSet& set)
{
    set.force = {};
    set.moment = {};
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        const Vector force = reaction_at(s, set, i);
        set.force = set.force + force;
        set.moment = set.moment + cross(s.grains.position(set.nodes[i]) - set.pivot, force);
    }
}

bool turns(const NodeSet& set) { return norm(set.spin) != 0.0; }

/// Power of its forces with the velocities that its nodes have [W].
double power_of(const SolidState& s, const NodeSet& set)
{
    if (!turns(set)) return dot(set.force, set.velocity);
    double power = 0.0;
    for (std::size_t i = 0; i < set.nodes.size(); ++i)
        power += dot(reaction_at(s, set, i), space_vector(s.grains.velocity, set.nodes[i]));
    return power;
}

/// Velocity of a place of a set that turns, at which a step takes it to where the rotation does.
Vector velocity_at(const NodeSet& set, Vector place, double dt)
{
    const double rate = norm(set.spin), half = std::sin(0.5 * dt * rate);
    const Vector axis = (1.0 / rate) * set.spin, around = cross(axis, place - set.pivot);
    const Vector turned = std::sin(dt * rate) * around + 2.0 * half * half * cross(axis, around);
    return set.velocity + (1.0 / dt) * turned;
}

/// Take the nodes of a set that turns further along: its velocities for the step that follows, and
/// what their change does to the work of the half step that has begun.
void lead(SolidState& s, const NodeSet& set, double dt)
{
    Grains& grains = s.grains;
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        const int node = set.nodes[i];
        const Vector old = space_vector(grains.velocity, node);
        const Vector along = velocity_at(set, grains.position(node), dt);
        const Vector next = old + held_part(set, along - old);
        set_space_vector(grains.velocity, node, next);
        s.ledger.prescribed_work[2 * grains.block_of(set.grains[i]) + 1] +=
            0.5 * dt * dot(reaction_at(s, set, i), next - old);
    }
}

bool lies_on(const SolidState& s, const NodeSet& set, const Plate& plate, std::size_t index)
{
    const Vector arm = seat_arm(plate, static_cast<int>(index));
    if (plate.gap[index] - dot(arm, plate.turn) > 0.0 || !(plate.area[index] > 0.0)) return false;
    const int triangle = plate.facets[index], grain = s.surface.grain[triangle];
    const auto holds = [&](int node) {
        return std::find(set.nodes.begin(), set.nodes.end(), node) != set.nodes.end();
    };
    if (s.grains.is_rigid(grain)) return holds(s.grains.centre(grain));
    const auto& corners = s.surface.nodes[triangle];
    return std::any_of(corners.begin(), corners.end(), holds);
}

void require_apart(const SolidState& s, const NodeSet& set, const Plate& plate)
{
    for (std::size_t i = 0; i < plate.facets.size(); ++i) {
        if (!lies_on(s, set, plate, i)) continue;
        refuse("node of a set",
            place(space_vector(s.grains.reference, s.surface.nodes[plate.facets[i]][0])),
            "lies on a plate, must not; take another region or another place");
    }
}

}  // namespace

std::vector<int> holdable_nodes(const SolidState& s)
{
    std::vector<int> nodes;
    for (const auto& [node, grain] : holdable(s))
        nodes.push_back(node);
    return nodes;
}

int add_node_set(SolidState& s, const std::vector<int>& nodes, std::array<bool, 3> axes)
{
    if (nodes.empty())
        refuse("nodes of a set", 0.0, "", "must be at least 1; take a larger region");
    NodeSet set;
    set.holds_x = axes[0];
    set.holds_y = axes[1];
    set.holds_z = axes[2];
    if (!(axes[0] || axes[1] || axes[2])) refuse("axes of a set", 0.0, "", "must be at least 1");
    const Holdable there = holdable(s);
    for (int n : nodes) {
        const auto found = there.find(n);
        if (found == there.end())
            refuse("node of a set", n, "", "must be a node that a set may hold");
        for (int axis = 0; axis < 3; ++axis) {
            if (!set.holds(axis) || !s.grains.prescribed[s.grains.component(n, axis)]) continue;
            refuse("node of a set", place(space_vector(s.grains.reference, n)),
                "is held already, must not be; take a region apart from that of other parts");
        }
        set.nodes.push_back(n);
        set.grains.push_back(found->second);
        set.pivot =
            set.pivot + (1.0 / static_cast<double>(nodes.size())) * s.grains.position(n);
    }
    for (const Plate& plate : s.plates)
        require_apart(s, set, plate);
    for (int axis = 0; axis < 3; ++axis)
        if (set.holds(axis)) prescribe(s, nodes, axis, 0.0);
    s.node_sets.push_back(set);
    return static_cast<int>(s.node_sets.size()) - 1;
}

void require_apart(const SolidState& s, const Plate& plate)
{
    for (const NodeSet& set : s.node_sets)
        require_apart(s, set, plate);
}

void set_pivot(SolidState& s, int set, Vector pivot)
{
    check_finite("pivot of a node set", pivot.x + pivot.y + pivot.z, "m");
    set_at(s, set).pivot = pivot;
}

void set_motion_of(SolidState& s, int number, Vector velocity, Vector spin, double dt)
{
    check_finite("velocity of a node set", velocity.x + velocity.y + velocity.z, "m/s");
    check_finite("spin of a node set", spin.x + spin.y + spin.z, "rad/s");
    NodeSet& set = set_at(s, number);
    const double along[] = { velocity.x, velocity.y, velocity.z };
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] != 0.0 && !set.holds(axis)) {
            refuse("velocity of a node set along axis " + std::to_string(axis), along[axis], "m/s",
                "must be 0: it is free there");
        }
        if (set.holds(axis)) prescribe(s, set.nodes, axis, along[axis]);
    }
    set.velocity = velocity;
    set.spin = spin;
    if (turns(set)) lead(s, set, dt);
}

void promise_work(SolidState& s, double dt)
{
    const Grains& grains = s.grains;
    for (int g = 0; g < grains.count; ++g) {
        double work = 0.0;
        bool any = false;
        for_each_mover(s, g, [&](int node) {
            const Vector on = force_on(s, g, node);
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
        set.work_next = 0.5 * dt * power_of(s, set);
}

void sum_node_sets(SolidState& s, double dt)
{
    for (NodeSet& set : s.node_sets) {
        set.displacement = set.displacement + dt * set.velocity;
        set.pivot = set.pivot + dt * set.velocity;
        set.angle = set.angle + dt * set.spin;
        sum_reactions(s, set);
        set.work += set.work_next + 0.5 * dt * power_of(s, set);
        if (turns(set) && dt > 0.0) lead(s, set, dt);
        set.work_next = 0.5 * dt * power_of(s, set);
    }
}

}  // namespace flexpm
