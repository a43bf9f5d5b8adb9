// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laguerre (power) diagram of discs, weight R^2, clipped to an outline, paper Sec. 3.1.
/// Lengths in any one unit; cells run counter-clockwise.
#pragma once

#include <flexpm/kernel/geometry/outline.hpp>

#include <vector>

namespace flexpm {

/// Freedom of a vertex to move when edges are collapsed.
enum class VertexKind { inner, side, corner };

/// Edge of a cell, from `vertex` to the vertex of the cell's next edge.
struct CellEdge {
    int vertex;     ///< start
    int neighbour;  ///< disc on the other side, or -1 on the outline
    int side;       ///< side of the outline, or -1 between cells
};

/// Cells over shared vertices: every cell that meets a point refers to it by the same index.
struct PowerDiagram {
    std::vector<Point> vertices;
    std::vector<VertexKind> kinds;             ///< per vertex
    std::vector<std::vector<CellEdge>> cells;  ///< per disc; empty for a hidden disc
};

/// Laguerre cells of the discs inside the outline. Where four or more cells meet in one point,
/// edges of zero length (to round-off) remain; tessellate() removes them.
///
/// @throws std::invalid_argument  for no disc, a non-finite number, a radius <= 0, or a centre
///                                outside
PowerDiagram power_diagram(const std::vector<Disc>& discs, const Outline& outline);

}  // namespace flexpm
