// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/solid_loading.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/step/solid_step.hpp>

#include <algorithm>
#include <string>

namespace flexpm {

double end_place(const SolidState& s, SolidSide side)
{
    const std::vector<int> nodes = side_nodes(s, side);
    if (!nodes.empty()) return s.grains.reference[s.grains.component(nodes.front(), 2)];
    const int plate = find_plate(s, side);
    if (plate < 0) {
        refuse("nodes of an end", 0.0, "",
            "must be above 0; give a solid with bottom and top, or a disc between plates");
    }
    return s.plates[plate].position.z;
}

namespace {

/// @throws std::invalid_argument  unless a field is one of these grains
void check_field(const SolidState& s, const SolidField& field)
{
    const auto grains = static_cast<std::size_t>(s.grains.count);
    std::size_t nodes = 0;
    for (int g = 0; g < s.grains.count; ++g)
        nodes += s.grains.nodes_of(g);
    const bool rigid = !s.bodies.empty();
    const std::size_t wanted = rigid ? grains : nodes;
    if (field.ways.size() != wanted) {
        refuse("begin_from: vectors of the field", static_cast<double>(field.ways.size()), "",
            "must be those of " + std::to_string(wanted) + (rigid ? " rigid grains" : " nodes"));
    }
    if (field.turns.size() != (rigid ? grains : 0)) {
        refuse("begin_from: turns of the field", static_cast<double>(field.turns.size()), "",
            "must be those of " + std::to_string(rigid ? grains : 0) + " rigid grains");
    }
}

void begin_node(SolidState& s, int node, Vector way, double extent, double rate)
{
    set_space_vector(s.grains.displacement, node, extent * way);
    set_space_vector(s.grains.velocity, node, rate * way);
    set_space_vector(s.loading.grains.velocity, node, rate * way);
}

void begin_body(SolidState& s, int grain, const SolidField& field, double extent, double rate)
{
    begin_node(s, s.grains.centre(grain), field.ways[grain], extent, rate);
    s.bodies[grain].turn = rotation_by(extent * field.turns[grain]);
    place_body(s, grain, extent * field.ways[grain]);
    const Vector spin = rate * field.turns[grain];
    set_spin(s, grain, spin, s.bodies[grain].spin_held);
    set_space_vector(s.loading.grains.spin, 3 * grain, spin);
}

/// Add `rate` times a field to the velocities of plates that a load moves.
void add_plate_motion(SolidState& s, const SolidField& field, double rate)
{
    for (std::size_t i = 0; i < field.plates.size(); ++i) {
        Plate& plate = s.plates[i];
        if (!plate.loaded) continue;
        const Vector velocity = rate * field.plates[i].way * plate.normal;
        plate.velocity = plate.velocity + velocity;
        s.loading.plates.resize(s.plates.size());
        s.loading.plates[i].velocity = velocity;
    }
}

/// The same for node sets that float.
void add_set_motion(SolidState& s, const SolidField& field, double rate)
{
    if (!field.sets.empty()) s.loading.sets.resize(s.node_sets.size());
    for (std::size_t i = 0; i < field.sets.size(); ++i) {
        const Vector velocity = rate * field.sets[i];
        s.node_sets[i].velocity = s.node_sets[i].velocity + velocity;
        s.loading.sets[i].velocity = velocity;
    }
}

void add_node_motion(SolidState& s, int node, Vector velocity)
{
    set_space_vector(s.loading.grains.velocity, node, velocity);
    const double values[] = { velocity.x, velocity.y, velocity.z };
    for (int axis = 0; axis < s.grains.layout.dimension; ++axis) {
        const int i = s.grains.component(node, axis);
        if (!s.grains.prescribed[i]) s.grains.velocity[i] += values[axis];
    }
}

}  // namespace

void add_motion(SolidState& s, const SolidField& field, double rate)
{
    check_field(s, field);
    if (s.bodies.empty()) {
        auto next = field.ways.begin();
        for_each_node(s, [&](int grain, int number) {
            add_node_motion(s, s.grains.node(grain, number), rate * *next++);
        });
    }
    for (int g = 0; g < static_cast<int>(s.bodies.size()); ++g) {
        add_node_motion(s, s.grains.centre(g), rate * field.ways[g]);
        const Vector spin = rate * field.turns[g];
        if (!s.bodies[g].spin_held) set_spin(s, g, s.bodies[g].spin + spin, false);
        set_space_vector(s.loading.grains.spin, 3 * g, spin);
    }
    add_plate_motion(s, field, rate);
    add_set_motion(s, field, rate);
}

void begin_from(SolidState& s, const SolidField& field, double extent, double rate)
{
    check_field(s, field);
    if (s.bodies.empty()) {
        auto next = field.ways.begin();
        for_each_node(s, [&](int grain, int number) {
            begin_node(s, s.grains.node(grain, number), *next++, extent, rate);
        });
    }
    for (int g = 0; g < static_cast<int>(s.bodies.size()); ++g)
        begin_body(s, g, field, extent, rate);
    add_plate_motion(s, field, rate);
    add_set_motion(s, field, rate);
    begin_balance(s);
}

void begin_balance(SolidState& s)
{
    find_forces(s);
    std::fill(s.ledger.kinetic.begin(), s.ledger.kinetic.end(), 0.0);
    s.ledger.kinetic[0] = kinetic_of_velocities(s);
    const Energies there = energies(s);
    s.ledger.initial =
        there.elastic + there.damage + there.friction + there.kinetic + there.potential;
}

}  // namespace flexpm
