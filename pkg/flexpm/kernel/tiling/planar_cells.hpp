// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells as loops over common vertices, while they are clipped, merged, split and cut. SI
/// units.
#pragma once

#include <flexpm/kernel/geometry/cells.hpp>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace flexpm {

/// Vertices of a cell, counter-clockwise.
using Loop = std::vector<int>;

/// Two vertices. As a key of PlanarCells the smaller comes first; of an EdgeOwners, the start.
using VertexPair = std::pair<int, int>;

inline VertexPair undirected(int u, int v)
{
    return u < v ? VertexPair { u, v } : VertexPair { v, u };
}

/// Parts of the area and of the diameter of a mean cell below which a piece is a sliver, and the
/// smallest angle that a cut leaves [rad]: 5 degrees. Deviations D33 and D35.
constexpr double least_piece = 0.02;
constexpr double least_width = 0.15;
constexpr double least_angle = 0.087266462599716474;

struct PlanarCells {
    std::vector<Point> vertices;
    std::vector<Loop> cells;             ///< an empty one has been merged with another
    std::vector<int> origin;             ///< per cell: the grain that it is, or is a piece of
    std::vector<std::uint8_t> whole;     ///< per cell: 1 keeps the disc of its grain
    std::vector<std::uint8_t> laguerre;  ///< per cell, as in Tessellation; never empty
    std::map<VertexPair, int> sides;     ///< side of the outline of boundary edges
    std::map<VertexPair, int> joints;    ///< joint of edges between cells; others have none

    void add_cell(Loop loop, int from, bool is_whole)
    {
        cells.push_back(std::move(loop));
        origin.push_back(from);
        whole.push_back(is_whole);
        laguerre.push_back(is_whole);
    }

    /// Note that a cell has another shape than its disc gives it.
    void reshape(int cell) { whole[cell] = laguerre[cell] = 0; }
};

/// Cell on the left of each directed edge.
class EdgeOwners {
public:
    static constexpr int none = -1;
    explicit EdgeOwners(const std::vector<Loop>& cells);
    void add(const Loop& loop, int cell);
    void remove(const Loop& loop);
    int left_of(int from, int to) const;

private:
    std::map<VertexPair, int> cell_of;
};

/// Cells of a specimen and what belongs to them.
struct Tiling {
    Tessellation cells;
    std::vector<Disc>
        discs;  ///< per cell: reference point, from which all edges are seen, and radius
    std::vector<int> origin;      ///< per cell: the grain that it is, or is a piece of
    std::vector<int> edge_joint;  ///< per shared edge: joint, -1: none
};

std::vector<Point> polygon_of(const PlanarCells& cells, const Loop& loop);

PlanarCells planar_cells(const Tessellation& tessellation);

/// Numbered cells, vertices in the order of their use. A cell that is whole keeps the disc of its
/// grain; others take their reference point and the radius of a disc of their area.
Tiling make_tiling(const PlanarCells& cells, const std::vector<Disc>& discs);

/// The area that the outline of all cells encloses [m^2].
double enclosed_area(const Tessellation& tessellation);

}  // namespace flexpm
