// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The saved state of all grains, deformable or rigid: their nodes, elements and motion.
#pragma once

#include <flexpm/kernel/assembly/layout.hpp>
#include <flexpm/kernel/law/elastic.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Connectivity shared by the grains of one group. Nodes: outer vertices first, then the centre.
/// Rigid grains have no triangles: their nodes move as one body about the centre.
struct MeshGroup {
    int vertices = 0;            ///< outer vertices; node number `vertices` is the centre
    int nodes = 0;               ///< all nodes of a grain
    std::vector<int> triangles;  ///< three node numbers each, counter-clockwise
    bool rigid = false;

    int triangle_count() const { return static_cast<int>(triangles.size()) / 3; }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("vertices", s.vertices);
        visit("nodes", s.nodes);
        visit("triangles", s.triangles);
        visit("rigid", s.rigid);
    }
};

/// Rows of the rotation of rigid grains from the reference.
struct RotationRow {
    enum : int { cosine_less_one, sine, angle, count };
};

/// Grains of one mesh connectivity form a group and are stepped `lanes` at a time. Node arrays are
/// laid out [block][node of the grain][component][lane]; a node is named by the offset of its x
/// value.
struct Grains {
    Layout layout = plane_layout;
    int count = 0;
    std::vector<MeshGroup> groups;
    std::vector<int> block_group;      ///< group of each block
    std::vector<int> block_nodes;      ///< offset of each block in the node arrays
    std::vector<int> block_triangles;  ///< offset of each block in `shape`
    std::vector<int> slot;             ///< block * lanes + lane of each grain
    std::vector<int> in_slot;          ///< grain in each slot, -1 where padded
    std::vector<std::uint8_t>
        erased;  ///< 1: a script has taken the grain out; its rows have no effect
    std::vector<std::uint8_t> loose;  ///< 1: no contact holds it to what is held, see find_loose()
    std::vector<double> radius;       ///< of the disc of each grain [m]
    std::vector<int> parent;    ///< grain of the rock that each is, or is an inner particle of
    std::vector<int> material;  ///< index into `elastic`
    std::vector<ElasticMaterial> elastic;

    // nodes
    Array<double> reference;         ///< position when bonded [m]
    Array<double> displacement;      ///< from `reference` [m]
    Array<double> velocity;          ///< half a step after `displacement` [m/s]
    Array<double> force;             ///< contacts, elements, pressure; without damping [N]
    Array<std::uint8_t> prescribed;  ///< 1: the velocity is given, not integrated
    Array<double> inverse_mass;      ///< [block][node][lane], of the scaled or real mass [1/kg]

    // rigid grains, without meaning for others: [slot] unless said. Their mass is that of the
    // centre node, which alone can be prescribed; velocities of all nodes follow from centre and
    // spin.
    Array<double> rotation;         ///< [block][RotationRow][lane]
    Array<double> spin;             ///< angular velocity, half a step after `rotation` [rad/s]
    Array<double> inverse_inertia;  ///< of the scaled or real moment of inertia [1/(kg m^2)]
    Array<std::uint8_t> spin_prescribed;  ///< 1: the spin is given, not integrated

    // triangles
    Array<double> shape;      ///< [block][triangle][row of TriangleShape][lane]
    Array<double> stiffness;  ///< [block][row of PlaneStiffness][lane] [Pa]

    int blocks() const { return static_cast<int>(block_group.size()); }
    int block_of(int grain) const { return slot[grain] / lanes; }
    int lane_of(int grain) const { return slot[grain] % lanes; }
    const MeshGroup& group(int block) const { return groups[block_group[block]]; }
    const MeshGroup& group_of(int grain) const { return group(block_of(grain)); }
    bool is_rigid(int grain) const { return group_of(grain).rigid; }
    int nodes_of(int grain) const { return group_of(grain).nodes; }
    int vertices_of(int grain) const { return group_of(grain).vertices; }

    /// Offset of a grain's node in the node arrays.
    int node(int grain, int number) const
    {
        return block_nodes[block_of(grain)] + layout.node_stride * number + lane_of(grain);
    }
    int centre(int grain) const { return node(grain, vertices_of(grain)); }

    /// Offset of a grain's centre in StepPlan::next_centre.
    int centre_place(int grain) const { return dimension * slot[grain]; }

    /// Index into Contacts::laws of a contact between two grains.
    int law_index(int grain_a, int grain_b) const
    {
        return material[grain_a] * static_cast<int>(elastic.size()) + material[grain_b];
    }

    // a vector of a node, by the node's offset, and the places of its components in the arrays of
    // nodes; the third component of a vector is 0 in 2D
    int component(int node, int axis) const { return layout.component(node, axis); }
    int scalar_index(int node) const { return layout.scalar_index(node); }
    Vector vector(const Array<double>& values, int node) const
    {
        return { values[component(node, 0)], values[component(node, 1)],
            layout.dimension == 3 ? values[component(node, 2)] : 0.0 };
    }
    void set_vector(Array<double>& values, int node, Vector v) const
    {
        values[component(node, 0)] = v.x;
        values[component(node, 1)] = v.y;
        if (layout.dimension == 3) values[component(node, 2)] = v.z;
    }
    Point vector_at(const Array<double>& values, int node) const
    {
        return in_plane(vector(values, node));
    }
    Point reference_at(int node) const { return vector_at(reference, node); }
    Point displacement_at(int node) const { return vector_at(displacement, node); }
    Point velocity_at(int node) const { return vector_at(velocity, node); }
    Point force_at(int node) const { return vector_at(force, node); }

    /// Vector at share `weight` of the way from the first to the second node of an edge.
    Point vector_on_edge(const Array<double>& values, std::array<int, 2> nodes, double weight) const
    {
        return (1.0 - weight) * vector_at(values, nodes[0]) + weight * vector_at(values, nodes[1]);
    }

    /// Present position of a node [m], with displacements that are `factor` times larger.
    Vector position(int node, double factor = 1.0) const
    {
        return vector(reference, node) + factor * vector(displacement, node);
    }
    Point point_at(int node, double factor = 1.0) const { return in_plane(position(node, factor)); }

    /// Length of a vector [m]: by hypot() in 2D, which may differ from norm() in the last digit.
    double length(Vector v) const { return layout.dimension == 2 ? norm(in_plane(v)) : norm(v); }

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("layout", s.layout);
        visit("count", s.count);
        visit("groups", s.groups);
        visit("block_group", s.block_group);
        visit("block_nodes", s.block_nodes);
        visit("block_triangles", s.block_triangles);
        visit("slot", s.slot);
        visit("in_slot", s.in_slot);
        visit("erased", s.erased);
        visit("loose", s.loose);
        visit("radius", s.radius);
        visit("parent", s.parent);
        visit("material", s.material);
        visit("elastic", s.elastic);
        visit("reference", s.reference);
        visit("displacement", s.displacement);
        visit("velocity", s.velocity);
        visit("force", s.force);
        visit("prescribed", s.prescribed);
        visit("inverse_mass", s.inverse_mass);
        visit("rotation", s.rotation);
        visit("spin", s.spin);
        visit("inverse_inertia", s.inverse_inertia);
        visit("spin_prescribed", s.spin_prescribed);
        visit("shape", s.shape);
        visit("stiffness", s.stiffness);
    }
};

}  // namespace flexpm
