// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Layout of the packed arrays: the values of `lanes` grains, contacts or edges lie side by
/// side, one in each lane, row after row and block after block. Lanes that nothing fills repeat a
/// real one, without effect.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include <array>

namespace flexpm {

/// Components of a vector.
constexpr int dimension = 2;

/// Values of one node of each grain of a block: a row for each component.
constexpr int node_stride = dimension * lanes;

/// Index of a component of a node's vector (0: x, 1: y), from the node's offset.
constexpr int component(int node, int axis) { return node + axis * lanes; }

/// Component that an index names.
constexpr int axis_of(int index) { return index % node_stride / lanes; }

/// Index into the arrays with one value per node, from a node's offset.
constexpr int scalar_index(int node) { return (node + node % lanes) / dimension; }

/// Index of a value of an item (grain's slot, contact, boundary edge) in an array with `rows` rows
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
