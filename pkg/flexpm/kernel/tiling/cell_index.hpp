// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells that are being cut, with what is found quickly: cells near a line, around a vertex,
/// beside an edge.
#pragma once

#include <flexpm/kernel/tiling/planar_cells.hpp>

#include <queue>
#include <tuple>
#include <vector>

namespace flexpm {

/// Cells and their index. Loops and places change by its functions only, so that the index stays
/// true.
class CellIndex {
public:
    /// @param c  cells, none of which is empty; they must outlive the index
    explicit CellIndex(PlanarCells& c);

    PlanarCells& cells;

    /// Cells that have a vertex, in their order.
    const std::vector<int>& cells_at(int vertex) const { return around[vertex]; }
    bool is_boundary(int u, int v) const;
    double longest_edge();                            ///< [m]
    double largest_cell() const { return diagonal; }  ///< upper bound of the diameter of a cell [m]

    /// All cells that come within a distance of a straight segment, and some others; in their
    /// order.
    std::vector<int> near(Point a, Point b, double within) const;
    bool is_in_a_cell(Point p) const;

    /// Replace a cell by two parts; the second one comes last.
    void split(int cell, Loop first, Loop second);
    /// Divide an edge by a vertex, with its side and its joint, in the cells that have it.
    void divide(VertexPair edge, int vertex);
    /// Take a vertex out of the cells around it.
    void remove(int vertex);
    void move(int vertex, Point place);

private:
    /// Length and ends of an edge that was there once.
    using Edge = std::tuple<double, int, int>;

    std::vector<std::vector<int>> around;
    EdgeOwners owners;
    std::priority_queue<Edge> lengths;
    double diagonal = 0.0;
    // squares of one size over the box around all cells, each with the cells whose boxes meet it
    struct Box {
        Point low, high;
    };
    std::vector<Box> boxes;  ///< of the cells
    Point low;
    double square = 0.0;
    int columns = 1, rows = 1;
    std::vector<std::vector<int>> in_square;
    mutable std::vector<unsigned> seen;  ///< per cell: the last search that has found it
    mutable unsigned search = 0;

    void add(int cell);
    void place_in_squares(int cell);
    void take_out_of_squares(int cell);
    bool is_close(const Box& box, Point a, Point b, double within) const;
    void note_length(int u, int v);
    int column_of(double x) const;
    int row_of(double y) const;
};

}  // namespace flexpm
