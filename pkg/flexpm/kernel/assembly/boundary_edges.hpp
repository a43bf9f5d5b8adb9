// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The saved state of boundary edges: those of the outline, and all that a wall may touch.
#pragma once

#include <flexpm/kernel/assembly/layout.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Rows of the forces on a boundary edge: components on its first and on its second node, of the
/// pressure and then of the plates.
struct EdgeRow {
    enum : int { of_pressure = 0, of_plates = 2 * dimension, count = 4 * dimension };
};

struct BoundaryEdges {
    int count = 0;
    std::vector<int> grain;
    std::vector<int> side;         ///< side of the outline, -1: none
    std::vector<double> pressure;  ///< follows the deforming edge, compressive positive [Pa]
    Array<int> node_offsets;       ///< [block][first, second][lane], counter-clockwise in the grain
    Array<double> forces;          ///< [block][EdgeRow][lane] [N]

    int blocks() const { return blocks_of(count); }

    /// Offsets of the first and the second node.
    std::array<int, 2> nodes(int edge) const
    {
        return { node_offsets[row_index(edge, 0, 2)], node_offsets[row_index(edge, 1, 2)] };
    }
    void set_nodes(int edge, int first, int second)
    {
        node_offsets[row_index(edge, 0, 2)] = first;
        node_offsets[row_index(edge, 1, 2)] = second;
    }

    /// Fit all arrays with rows to `count`; new values are zero.
    void resize_rows()
    {
        node_offsets.resize(static_cast<std::size_t>(blocks()) * lanes * 2, 0);
        forces.resize(static_cast<std::size_t>(blocks()) * lanes * EdgeRow::count, 0.0);
    }

    /// Index of the x component of the force on the first node, EdgeRow::of_pressure or of_plates,
    /// in `forces`; that on the second node lies a node_stride further.
    static int force_index(int edge, int row) { return row_index(edge, row, EdgeRow::count); }

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("count", s.count);
        visit("grain", s.grain);
        visit("side", s.side);
        visit("pressure", s.pressure);
        visit("node_offsets", s.node_offsets);
        visit("forces", s.forces);
    }
};

}  // namespace flexpm
