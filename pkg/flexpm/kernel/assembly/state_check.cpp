// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/state_check.hpp>

#include <flexpm/kernel/assembly/triangle_rows.hpp>
#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace flexpm {

namespace {

/// Largest number of anything, so that no offset exceeds an int.
constexpr std::int64_t most = std::numeric_limits<int>::max() / 64;

[[noreturn]] void refuse_state(const char* part, std::int64_t value, const std::string& rule)
{
    refuse("saved state: " + std::string(part), std::to_string(value),
        rule + "; the file is damaged, build and run the specimen again");
}

void check_equal(const char* part, std::int64_t value, std::int64_t wanted)
{
    if (value != wanted) refuse_state(part, value, "must be " + std::to_string(wanted));
}

/// Refuse an array of another size.
void check_size(const char* part, std::size_t size, std::int64_t wanted)
{
    check_equal(part, static_cast<std::int64_t>(size), wanted);
}

void check_index(const char* part, std::int64_t value, std::int64_t end, std::int64_t first = 0)
{
    if (value >= first && value < end) return;
    refuse_state(part, value,
        "must be at least " + std::to_string(first) + " and below " + std::to_string(end));
}

template <class List> void check_indices(const char* part, const List& values, std::int64_t end)
{
    for (std::int64_t value : values)
        check_index(part, value, end);
}

void check_group(const MeshGroup& group)
{
    check_index("corners of a grain", group.vertices, most, 3);
    // the centre follows the corners
    check_index("nodes of a grain", group.nodes, most, group.vertices + 1);
    check_size("nodes of a triangle", group.triangles.size() % 3, 0);
    check_index("triangles", static_cast<std::int64_t>(group.triangles.size()), most);
    check_indices("node of a triangle", group.triangles, group.nodes);
    if (!group.rigid) return;
    check_equal("nodes of a rigid grain", group.nodes, group.vertices + 1);
    check_size("triangles of a rigid grain", group.triangles.size(), 0);
}

/// Each grain has a slot of its own, and no slot has another grain.
void check_slots(const Grains& grains)
{
    const std::int64_t slots = static_cast<std::int64_t>(grains.block_group.size()) * lanes;
    check_size("slots", grains.in_slot.size(), slots);
    check_size("slots of grains", grains.slot.size(), grains.count);
    check_indices("slot of a grain", grains.slot, slots);
    for (int g = 0; g < grains.count; ++g)
        check_equal("grain in a slot", grains.in_slot[grains.slot[g]], g);
    std::int64_t filled = 0;
    for (int grain : grains.in_slot)
        filled += grain != -1;
    check_equal("slots with a grain", filled, grains.count);
}

/// Blocks follow each other without a gap.
void check_blocks(const Grains& grains)
{
    const std::size_t blocks = grains.block_group.size();
    check_index("blocks of grains", static_cast<std::int64_t>(blocks), most);
    check_indices(
        "mesh of a block", grains.block_group, static_cast<std::int64_t>(grains.groups.size()));
    check_size("places of nodes", grains.block_nodes.size(), static_cast<std::int64_t>(blocks));
    check_size(
        "places of triangles", grains.block_triangles.size(), static_cast<std::int64_t>(blocks));
    std::int64_t nodes = 0, triangles = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        const MeshGroup& group = grains.groups[grains.block_group[b]];
        check_equal("place of nodes", grains.block_nodes[b], nodes);
        check_equal("place of triangles", grains.block_triangles[b], triangles);
        nodes += std::int64_t { grains.layout.node_stride } * group.nodes;
        triangles += std::int64_t { shape_rows } * lanes * group.triangle_count();
        check_index("values of nodes", nodes, std::numeric_limits<int>::max() / 2);
        check_index("values of triangles", triangles, std::numeric_limits<int>::max());
    }
    for (std::size_t size : { grains.reference.size(), grains.displacement.size(),
             grains.velocity.size(), grains.force.size(), grains.prescribed.size() }) {
        check_size("values of nodes", size, nodes);
    }
    check_size("masses", grains.inverse_mass.size(), nodes / grains.layout.dimension);
    check_size("shapes of triangles", grains.shape.size(), triangles);
}

void check_loading(const Assembly& a)
{
    const LoadingMotion& l = a.loading;
    check_size("velocities of the loading", l.grains.velocity.size(), a.grains.velocity.size());
    check_size("spins of the loading", l.grains.spin.size(), a.grains.spin.size());
    check_index("plates of the loading", l.plates.size(), a.plates.size() + 1);
    check_index("node sets of the loading", l.sets.size(), a.node_sets.size() + 1);
}

void check_steady(const Assembly& a)
{
    const SteadyMotion& s = a.steady;
    const bool followed = s.is_followed();
    for (std::size_t size : { s.mean.velocity.size(), s.displacement.size() })
        check_size("values of nodes followed", size, followed ? a.grains.displacement.size() : 0);
    for (std::size_t size : { s.mean.spin.size(), s.angle.size() })
        check_size("rotations followed", size, followed ? a.grains.spin.size() : 0);
    check_index("step of the last look", s.step, a.step + 1);
}

/// The one layout that lanes are made for.
void check_layout(const Layout& layout)
{
    check_equal("components of a vector", layout.dimension, plane_layout.dimension);
    check_equal("grains of a block", layout.grains_per_block, plane_layout.grains_per_block);
    check_equal("values to the next component", layout.axis_stride, plane_layout.axis_stride);
    check_equal("values to the next node", layout.node_stride, plane_layout.node_stride);
}

void check_grains(const Grains& grains)
{
    check_layout(grains.layout);
    check_index("grains", grains.count, most);
    for (const MeshGroup& group : grains.groups)
        check_group(group);
    check_blocks(grains);
    check_slots(grains);
    for (std::size_t size : { grains.radius.size(), grains.parent.size(), grains.material.size(),
             grains.erased.size(), grains.loose.size() }) {
        check_size("values of grains", size, grains.count);
    }
    const auto kinds = static_cast<std::int64_t>(grains.elastic.size());
    check_index("materials", kinds, most);
    check_indices("material of a grain", grains.material, kinds);
    check_indices("grain of a particle", grains.parent, grains.count);
    const std::int64_t slots = static_cast<std::int64_t>(grains.in_slot.size());
    for (std::size_t size :
        { grains.spin.size(), grains.inverse_inertia.size(), grains.spin_prescribed.size() }) {
        check_size("rotations", size, slots);
    }
    check_size("rotations", grains.rotation.size(), RotationRow::count * slots);
    check_size("stiffnesses", grains.stiffness.size(), stiffness_rows * slots);
}

/// A node of a grain, by its offset.
void check_node(const Grains& grains, int grain, int offset)
{
    const std::int64_t from = std::int64_t { offset } - grains.node(grain, 0);
    const char* part = "node of a contact or an edge";
    check_index(part, from, std::int64_t { grains.layout.node_stride } * grains.nodes_of(grain));
    check_equal(part, from % grains.layout.node_stride, 0);
}

void check_pair(const Grains& grains, const GrainPair& pair)
{
    check_index("second grain of a pair", pair[1], grains.count);
    check_index("first grain of a pair", pair[0], pair[1]);
}

/// Contact `c`, or a padded lane that repeats `like`.
void check_nodes(const Assembly& a, int c, int like)
{
    const GrainPair& pair = a.contacts.pairs[like];
    const int centre_rows[] = { NodeRow::centre_a, NodeRow::centre_b };
    for (int side = 0; side < 2; ++side) {
        for (int node : a.contacts.edge(c, side))
            check_node(a.grains, pair[side], node);
        check_equal("place of a centre",
            a.contacts.nodes[row_index(c, centre_rows[side], NodeRow::count)],
            a.grains.centre_place(pair[side]));
    }
}

void check_contacts(const Assembly& a)
{
    const Contacts& contacts = a.contacts;
    check_index("contacts", contacts.count, most);
    check_equal("corners of a contact", contacts.group.corners, facet_nodes);
    check_index("points of a contact", contacts.group.points, 4, 1);
    for (std::size_t size : { contacts.pairs.size(), contacts.id.size(), contacts.law.size(),
             contacts.joint.size(), contacts.bonded.size(), contacts.erased.size() }) {
        check_size("values of contacts", size, contacts.count);
    }
    // also for contacts that come
    const auto kinds = static_cast<std::int64_t>(a.grains.elastic.size());
    const auto laws = static_cast<std::int64_t>(contacts.laws.size());
    check_index("laws of contacts", laws, most, a.grains.count > 0 ? kinds * kinds : 0);
    check_indices("law of a contact", contacts.law, laws);
    check_indices("number of a contact", contacts.id, contacts.next_id);
    for (const GrainPair& pair : contacts.pairs)
        check_pair(a.grains, pair);
    const std::int64_t padded = std::int64_t { contacts.blocks() } * lanes;
    Contacts::visit_rows(contacts, [&](const auto& values, int rows, auto) {
        // a force of zero follows those of contacts, but where nothing was ever assembled
        const bool forces =
            static_cast<const void*>(&values) == &contacts.forces && !values.empty();
        check_size("rows of contacts", values.size(), padded * rows + (forces ? dimension : 0));
    });
    for (int c = 0; c < padded; ++c)
        check_nodes(a, c, std::min(c, contacts.count - 1));
    check_indices("mode of a crack", contacts.crack_modes, erased_point + 1);
}

void check_facets(const Assembly& a)
{
    const Facets& facets = a.facets;
    check_index("boundary edges", facets.count, most);
    for (std::size_t size : { facets.grain.size(), facets.side.size(), facets.pressure.size() })
        check_size("values of boundary edges", size, facets.count);
    const std::int64_t padded = std::int64_t { facets.blocks() } * lanes;
    check_size("nodes of boundary edges", facets.node_offsets.size(), facet_nodes * padded);
    check_size("forces of boundary edges", facets.forces.size(), FacetRow::count * padded);
    check_indices("grain of a boundary edge", facets.grain, a.grains.count);
    for (int f = 0; f < facets.count; ++f) {
        for (int node : facets.nodes(f))
            check_node(a.grains, facets.grain[f], node);
    }
}

void check_plate(const Plate& plate, int facets)
{
    check_index("points of a plate", static_cast<std::int64_t>(plate.points.size()), most);
    for (const PlatePoint& point : plate.points)
        check_index("edge of a plate", point.facet, facets);
}

void check_node_set(const Grains& grains, const NodeSet& set)
{
    check_size(
        "grains of held nodes", set.grains.size(), static_cast<std::int64_t>(set.nodes.size()));
    check_indices("grain of a held node", set.grains, grains.count);
    for (std::size_t i = 0; i < set.nodes.size(); ++i)
        check_node(grains, set.grains[i], set.nodes[i]);
}

void check_ledger(const EnergyLedger& ledger, int blocks)
{
    for (std::size_t size : { ledger.damping_work.size(), ledger.drag_work.size() })
        check_size("works of damping", size, 2 * std::int64_t { blocks });
    check_size(
        "works of prescribed nodes", ledger.prescribed_work.size(), 2 * std::int64_t { blocks });
    check_size("kinetic energies", ledger.kinetic.size(), blocks);
    check_size("largest forces", ledger.largest_force.size(), blocks);
}

}  // namespace

void check_state(const Assembly& a)
{
    check_grains(a.grains);
    check_contacts(a);
    check_facets(a);
    check_index("plates", static_cast<std::int64_t>(a.plates.size()), most);
    for (const Plate& plate : a.plates)
        check_plate(plate, a.facets.count);
    check_index("node sets", static_cast<std::int64_t>(a.node_sets.size()), most);
    for (const NodeSet& set : a.node_sets)
        check_node_set(a.grains, set);
    for (const HeldEdge& edge : a.held_edges) {
        check_index("grain of a held edge", edge.grain, a.grains.count);
        check_index("axis of a held edge", edge.axis, dimension);
    }
    check_ledger(a.ledger, a.grains.blocks());
    check_index("step", a.step, std::int64_t { 1 } << 60);
    check_loading(a);
    check_steady(a);
}

}  // namespace flexpm
