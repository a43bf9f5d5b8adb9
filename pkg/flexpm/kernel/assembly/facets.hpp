// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The saved state of the boundary's facets, those of the outline and all that a wall may
/// touch: what pressures press, plates touch and sides consist of. In the plane they are edges.
#pragma once

#include <flexpm/kernel/assembly/grains.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Nodes of a facet: as many as a vector has components.
constexpr int facet_nodes = dimension;

/// Rows of the forces on a facet: components on its nodes, one after the other, of the pressure and
/// then of the plates.
struct FacetRow {
    enum : int {
        of_pressure = 0,
        of_plates = facet_nodes * dimension,
        count = 2 * facet_nodes * dimension
    };
};

struct Facets {
    int count = 0;
    std::vector<int> grain;
    std::vector<int> side;         ///< side of the outline, -1: none
    std::vector<double> pressure;  ///< follows the deforming facet, compressive positive [Pa]
    Array<int> node_offsets;       ///< [block][node][lane], counter-clockwise in the grain
    Array<double> forces;          ///< [block][FacetRow][lane] [N]

    int blocks() const { return blocks_of(count); }

    /// Offsets of its nodes.
    std::array<int, facet_nodes> nodes(int facet) const
    {
        return { node_offsets[row_index(facet, 0, facet_nodes)],
            node_offsets[row_index(facet, 1, facet_nodes)] };
    }
    void set_nodes(int facet, std::array<int, facet_nodes> nodes)
    {
        for (int n = 0; n < facet_nodes; ++n)
            node_offsets[row_index(facet, n, facet_nodes)] = nodes[n];
    }

    /// Fit all arrays with rows to `count`; new values are zero.
    void resize_rows()
    {
        node_offsets.resize(static_cast<std::size_t>(blocks()) * lanes * facet_nodes, 0);
        forces.resize(static_cast<std::size_t>(blocks()) * lanes * FacetRow::count, 0.0);
    }

    /// Index of the x component of the force on a node, FacetRow::of_pressure or of_plates, in
    /// `forces`.
    static int force_index(int facet, int row, int node = 0)
    {
        return row_index(facet, row, FacetRow::count) + node * node_stride;
    }

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

/// The one tangent that a normal has in the plane: turned by 90 degrees, counter-clockwise.
constexpr Point tangent_of(Point normal) { return { -normal.y, normal.x }; }

/// Velocity [m/s] that a spin [rad/s] gives to the end of an arm [m].
constexpr Point velocity_of_spin(double spin, Point arm) { return spin * tangent_of(arm); }

/// Parts that the nodes of a facet have in a point at share `weight` of the way from its first to
/// its second node.
inline std::array<double, facet_nodes> facet_parts(double weight)
{
    return { 1.0 - weight, weight };
}

/// A facet where it was bonded, its grain on the left.
struct FacetPlace {
    Point start, end;

    Point way() const { return end - start; }
    double length() const { return norm(way()); }

    /// Point at share `weight` of the way.
    Point at(double weight) const { return (1.0 - weight) * start + weight * end; }

    /// Unit vector into the grain: plates and pressures push along it.
    Point normal() const { return { (start.y - end.y) / length(), (end.x - start.x) / length() }; }
};

inline FacetPlace facet_place(const Grains& grains, const Facets& facets, int facet)
{
    const auto [start, end] = facets.nodes(facet);
    return { grains.reference_at(start), grains.reference_at(end) };
}

/// A factor times the way from a facet's first node to its second, as they lie now, turned into the
/// grain.
FLEXPM_INLINE Point across_facet(Point way, double factor)
{
    return { -factor * way.y, factor * way.x };
}

}  // namespace flexpm
