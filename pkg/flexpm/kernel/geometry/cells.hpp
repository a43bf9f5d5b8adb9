// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The cells of a specimen as polygons over common vertices, paper Sec. 3.1 and Fig. 4.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Edge shared by two cells: one contact of the bonded specimen.
struct SharedEdge {
    int cell_a;    ///< smaller cell index
    int cell_b;    ///< larger cell index
    int vertex_0;  ///< start, in the counter-clockwise sense of cell_a
    int vertex_1;  ///< end, in the counter-clockwise sense of cell_a
};

/// Edge of a cell on the outline.
struct BoundaryEdge {
    int cell;
    int vertex_0;  ///< start, in the counter-clockwise sense of the cell
    int vertex_1;  ///< end
    int side;      ///< of the outline (rectangle: 0 bottom, 1 right, 2 top, 3 left; circle: 0)
};

/// Cells as polygons over common vertices. Cell i belongs to disc `disc_of_cell[i]`; hidden discs
/// have no cell.
struct Tessellation {
    std::vector<Point> vertices;  ///< [m]
    /// Size cells + 1: cell i owns cell_vertices[cell_offsets[i] .. cell_offsets[i + 1]).
    std::vector<int> cell_offsets;
    std::vector<int> cell_vertices;  ///< vertex indices, counter-clockwise, cell after cell
    std::vector<int> disc_of_cell;   ///< index of the generating disc
    /// Per cell: 1 for the whole Laguerre cell of its disc, whose short edges may be collapsed
    /// (D7); 0 for a cell that was given, sawn, cut, merged or split. Empty: all 1.
    std::vector<std::uint8_t> laguerre;
    std::vector<SharedEdge> shared_edges;      ///< sorted by (cell_a, cell_b)
    std::vector<BoundaryEdge> boundary_edges;  ///< sorted by cell
    std::vector<int> merged_vertices;          ///< ascending; ends of collapsed edges
    std::vector<int> hidden_discs;             ///< discs whose cell is empty
    int uncollapsed_shared_edges = 0;          ///< shared edges before short edges were collapsed

    int cells() const { return static_cast<int>(disc_of_cell.size()); }
    bool is_laguerre(int cell) const { return laguerre.empty() || laguerre[cell] != 0; }
    int vertices_of(int cell) const { return cell_offsets[cell + 1] - cell_offsets[cell]; }
};

/// Corners of a cell, counter-clockwise.
std::vector<Point> cell_polygon(const Tessellation& tessellation, int cell);

/// Area of a cell [m^2].
double cell_area(const Tessellation& tessellation, int cell);

}  // namespace flexpm
