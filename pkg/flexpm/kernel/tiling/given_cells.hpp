// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains given as polygons: a tiling, checked. SI units.
#pragma once

#include <flexpm/kernel/tiling/planar_cells.hpp>

#include <vector>

namespace flexpm {

/// Cells of given polygons and the outline that they fill.
struct GivenCells {
    Tiling tiling;
    std::vector<std::vector<Point>>
        rings;  ///< corners of the outline, counter-clockwise, and of holes, clockwise [m]
};

/// Cells from polygons, corners in any sense. Corners closer than 1e-6 of the mean diameter become
/// one vertex, a corner as close to an edge divides it (Deviation D34). A polygon whose edges are
/// not all seen from one point is split. Polygons that lie inside of another one are grains within
/// it: it goes around them in parts (Deviation D62).
///
/// The outline's sides begin at its lowest corner, of these the one furthest left.
///
/// @param with_holes  whether the tiling may have holes
/// @throws std::invalid_argument  for a polygon that crosses itself, polygons that overlap, or a
///         gap between them
GivenCells cells_of_polygons(const std::vector<std::vector<Point>>& polygons, bool with_holes);

/// Cells as a file holds them.
struct StoredCells {
    std::vector<Point> vertices;         ///< [m]
    std::vector<Loop> cells;             ///< counter-clockwise
    std::map<VertexPair, int> sides;     ///< of boundary edges
    std::map<VertexPair, int> joints;    ///< of edges between cells that have one
    std::vector<Disc> discs;             ///< per cell
    std::vector<std::uint8_t> laguerre;  ///< per cell, as in Tessellation; empty: all 1
};

/// The tiling that was stored: same cells, same order.
/// @throws std::invalid_argument  for a vertex, cell or disc that cannot be
Tiling cells_of_file(const StoredCells& stored);

}  // namespace flexpm
