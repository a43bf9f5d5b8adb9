// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Layout of the packed arrays: the values of `lanes` grains, contacts or facets lie side by
/// side, one in each lane, row after row and block after block. Lanes that nothing fills repeat a
/// real one, without effect.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include <array>

namespace flexpm {

/// Where the components of the vectors of nodes lie. A node is named by the place of its first
/// component.
struct Layout {
    int dimension = 0;         ///< components of a vector
    int grains_per_block = 0;  ///< grains whose values lie side by side
    int axis_stride = 0;       ///< values from a component to the next
    int node_stride = 0;       ///< values from a node of a grain to its next

    /// Index of a component (0: x, 1: y), from the node's offset.
    constexpr int component(int node, int axis) const { return node + axis * axis_stride; }

    /// Component that an index names.
    constexpr int axis_of(int index) const { return index % node_stride / axis_stride; }

    /// Index into the arrays with one value per node, from a node's offset.
    constexpr int scalar_index(int node) const
    {
        return node / node_stride * grains_per_block + node % node_stride;
    }

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("dimension", s.dimension);
        visit("grains_per_block", s.grains_per_block);
        visit("axis_stride", s.axis_stride);
        visit("node_stride", s.node_stride);
    }
};

/// Grains of the plane: a row of `lanes` grains for each component.
constexpr Layout plane_layout { 2, lanes, lanes, 2 * lanes };

/// Grains of space: x, y, z and a zero for each node, one grain after the other.
constexpr Layout space_layout { 3, 1, 1, 4 };

// The same as constants, for lanes, which are made for the one layout. What is no lane asks
// Grains::layout.
constexpr int dimension = plane_layout.dimension;
constexpr int node_stride = plane_layout.node_stride;
constexpr int component(int node, int axis) { return plane_layout.component(node, axis); }
constexpr int scalar_index(int node) { return plane_layout.scalar_index(node); }

/// Index of a value of an item (grain's slot, contact, facet) in an array with `rows` rows
/// per block.
constexpr int row_index(int item, int row, int rows)
{
    return (item / lanes * rows + row) * lanes + item % lanes;
}

/// The same in an array in which the values of one item follow those of the other.
constexpr int record_index(int item, int value, int values) { return item * values + value; }

/// Blocks that a number of items fill.
constexpr int blocks_of(int items) { return (items + lanes - 1) / lanes; }

/// Vector of a node, or whatever else has a row for each component.
FLEXPM_INLINE Point vector_at(const double* values, int node)
{
    return { values[component(node, 0)], values[component(node, 1)] };
}
inline Point vector_at(const Array<double>& values, int node)
{
    return vector_at(values.data(), node);
}

FLEXPM_INLINE void set_vector(double* values, int node, Point p)
{
    values[component(node, 0)] = p.x;
    values[component(node, 1)] = p.y;
}
inline void set_vector(Array<double>& values, int node, Point p)
{
    set_vector(values.data(), node, p);
}

/// Vector at a point of an edge, at share `weight` of the way from its first to its second node.
inline Point vector_on_edge(const Array<double>& values, std::array<int, 2> nodes, double weight)
{
    return (1.0 - weight) * vector_at(values, nodes[0]) + weight * vector_at(values, nodes[1]);
}

}  // namespace flexpm
