// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_energies.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/solids/face_forces.hpp>
#include <flexpm/kernel/solids/tetrahedron_forces.hpp>

#include <algorithm>
#include <numeric>
#include <string>

namespace flexpm {

namespace {

double strain_energy(const SolidState& s)
{
    double sum = 0.0;
    for (int block = 0; block < s.grains.blocks(); ++block) {
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
    e.boundary_work = sum_of_first(s.ledger.prescribed_work);
    e.initial = s.ledger.initial;
    return e;
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

std::vector<int> side_nodes(const SolidState& s, SolidSide side)
{
    std::vector<int> nodes;
    for (std::size_t f = 0; f < s.surface.side.size(); ++f) {
        if (s.surface.side[f] != static_cast<int>(side)) continue;
        nodes.insert(nodes.end(), s.surface.nodes[f].begin(), s.surface.nodes[f].end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

void prescribe(SolidState& s, const std::vector<int>& nodes, int axis, double velocity)
{
    for (int n : nodes) {
        s.grains.velocity[s.grains.component(n, axis)] = velocity;
        s.grains.prescribed[s.grains.component(n, axis)] = 1;
    }
}

double holding_force(const SolidState& s, const std::vector<int>& nodes, int axis)
{
    double sum = 0.0;
    for (int n : nodes)
        sum -= s.grains.force[s.grains.component(n, axis)];
    return sum;
}

void begin_from(SolidState& s, const std::vector<Vector>& field, double extent, double rate)
{
    std::size_t wanted = 0;
    for (int g = 0; g < s.grains.count; ++g)
        wanted += s.grains.nodes_of(g);
    if (field.size() != wanted) {
        refuse("begin_from: vectors of the field", static_cast<double>(field.size()), "",
            "must be those of " + std::to_string(wanted) + " nodes");
    }
    auto next = field.begin();
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        set_space_vector(s.grains.displacement, node, extent * *next);
        set_space_vector(s.grains.velocity, node, rate * *next);
        set_space_vector(s.undamped.velocity, node, rate * *next);
        ++next;
    });
    if (update_face_blocks(s, 0, s.contacts.blocks()) > 0) {
        refuse("begin_from: extent", extent, "",
            "must leave the sides of each contact opposite to each other");
    }
    const Energies there = energies(s);
    s.ledger.initial =
        there.elastic + there.damage + there.friction + kinetic_of_velocities(s.grains);
}

}  // namespace flexpm
