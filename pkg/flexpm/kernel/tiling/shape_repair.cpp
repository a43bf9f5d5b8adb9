// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Loops united along common stretches and split along diagonals.
#include <flexpm/kernel/tiling/shape_repair.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/edge_collapse.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/reference_point.hpp>
#include <flexpm/kernel/tiling/diagonals.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace flexpm {

namespace {

double area_of(const PlanarCells& cells, const Loop& loop)
{
    return polygon_shape(polygon_of(cells, loop)).area;
}

bool is_sliver(const std::vector<Point>& polygon, double mean_area)
{
    const double area = polygon_shape(polygon).area;
    double perimeter = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
        perimeter += norm(polygon[(k + 1) % polygon.size()] - polygon[k]);
    return area < least_piece * mean_area
        || 4.0 * area < least_width * 2.0 * std::sqrt(mean_area / pi) * perimeter;
}

/// Loop around two cells; empty unless they make one without a hole.
Loop united(const Loop& a, const Loop& b)
{
    std::set<VertexPair> edges;
    for (const Loop* loop : { &a, &b })
        for (std::size_t k = 0; k < loop->size(); ++k)
            edges.insert({ (*loop)[k], (*loop)[(k + 1) % loop->size()] });
    std::map<int, int> next;
    for (const auto& [u, v] : edges) {
        if (edges.count({ v, u })) continue;
        if (!next.emplace(u, v).second) return {};
    }
    if (next.empty()) return {};
    Loop loop { next.begin()->first };
    while (next.at(loop.back()) != loop.front()) {
        loop.push_back(next.at(loop.back()));
        if (loop.size() > next.size()) return {};
    }
    return loop.size() == next.size() ? loop : Loop {};
}

/// Neighbours of a cell, those with the longest common stretch first.
std::vector<int> neighbours(const PlanarCells& cells, const EdgeOwners& owners, const Loop& loop)
{
    std::map<int, double> shared;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const int u = loop[k], v = loop[(k + 1) % loop.size()];
        const int other = owners.left_of(v, u);
        if (other != EdgeOwners::none) shared[other] += norm(cells.vertices[v] - cells.vertices[u]);
    }
    std::vector<std::pair<double, int>> order;
    for (const auto& [cell, length] : shared)
        order.push_back({ -length, cell });
    std::sort(order.begin(), order.end());
    std::vector<int> found;
    for (const auto& entry : order)
        found.push_back(entry.second);
    return found;
}

/// Merge a cell with a neighbour; false if no merged cell is seen whole from a point.
bool merge_cell(PlanarCells& cells, EdgeOwners& owners, int cell)
{
    for (int other : neighbours(cells, owners, cells.cells[cell])) {
        Loop loop = united(cells.cells[cell], cells.cells[other]);
        if (loop.empty() || !reference_point(polygon_of(cells, loop))) continue;
        owners.remove(cells.cells[cell]);
        owners.remove(cells.cells[other]);
        owners.add(loop, other);
        cells.cells[cell].clear();
        cells.cells[other] = std::move(loop);
        cells.reshape(other);
        return true;
    }
    return false;
}

int reflex_corners(const std::vector<Point>& p)
{
    int count = 0;
    const std::size_t n = p.size();
    for (std::size_t k = 0; k < n; ++k)
        count += cross(p[(k + 1) % n] - p[k], p[(k + 2) % n] - p[(k + 1) % n]) < 0.0;
    return count;
}

/// How well a part is seen: its clearance in radii of equal area, or below zero the corners that
/// hide.
double visibility(const std::vector<Point>& part)
{
    const Disc disc = disc_of_area(part);
    if (!reference_point(part)) return -1.0 - reflex_corners(part);
    return clearance(part, disc.centre) / disc.radius;
}

struct Diagonal {
    int i = -1, j = -1;
    double visibility = -std::numeric_limits<double>::infinity();
};

Diagonal best_diagonal(const PlanarCells& cells, const Loop& loop)
{
    const std::vector<Point> p = polygon_of(cells, loop);
    const int n = static_cast<int>(p.size());
    Diagonal best;
    for (int i = 0; i < n; ++i) {
        const Point before = p[(i + n - 1) % n], after = p[(i + 1) % n];
        if (cross(p[i] - before, after - p[i]) >= 0.0) continue;
        for (int j = 0; j < n; ++j) {
            if (j == i || j == (i + 1) % n || i == (j + 1) % n || !is_diagonal(p, i, j)) continue;
            const double seen = std::min(visibility(polygon_of(cells, part_of(loop, i, j))),
                visibility(polygon_of(cells, part_of(loop, j, i))));
            if (seen > best.visibility) best = { i, j, seen };
        }
    }
    return best;
}

/// Freedom of each vertex, by the sides of the boundary edges that meet there.
std::vector<VertexKind> kinds_of(const PlanarCells& cells)
{
    std::vector<VertexKind> kinds(cells.vertices.size(), VertexKind::inner);
    std::vector<int> side_of(cells.vertices.size(), -1);
    for (const auto& [edge, side] : cells.sides) {
        for (int v : { edge.first, edge.second }) {
            kinds[v] = side_of[v] < 0 || side_of[v] == side ? std::max(kinds[v], VertexKind::side)
                                                            : VertexKind::corner;
            side_of[v] = side;
        }
    }
    return kinds;
}

}  // namespace

void merge_slivers(PlanarCells& cells, double mean_area)
{
    EdgeOwners owners(cells.cells);
    std::set<std::pair<double, int>> slivers;
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        if (cells.whole[c] || !is_sliver(polygon_of(cells, cells.cells[c]), mean_area)) continue;
        slivers.insert({ area_of(cells, cells.cells[c]), static_cast<int>(c) });
    }
    for (const auto& [area, cell] : slivers) {
        // one may have grown by another
        const bool is_left = !cells.cells[cell].empty()
            && is_sliver(polygon_of(cells, cells.cells[cell]), mean_area);
        if (is_left) merge_cell(cells, owners, cell);
    }
}

void split_to_stars(PlanarCells& cells)
{
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        // a part may need a split again: the first stays in its place, the second comes last
        while (!cells.cells[c].empty() && !cells.whole[c]) {
            const Loop loop = cells.cells[c];
            if (reference_point(polygon_of(cells, loop))) break;
            const Diagonal cut = best_diagonal(cells, loop);
            if (cut.i < 0) {
                refuse("cell at " + place(cells.vertices[loop.front()])
                        + ": points that see all edges",
                    "none", "must be one; choose smaller grains");
            }
            cells.cells[c] = part_of(loop, cut.i, cut.j);
            cells.add_cell(part_of(loop, cut.j, cut.i), cells.origin[c], false);
        }
    }
}

void straighten_edges(PlanarCells& cells)
{
    std::map<int, std::vector<int>> cells_at;
    std::set<int> outer;
    for (std::size_t c = 0; c < cells.cells.size(); ++c)
        for (int v : cells.cells[c])
            cells_at[v].push_back(static_cast<int>(c));
    for (const auto& entry : cells.sides)
        outer.insert({ entry.first.first, entry.first.second });
    for (const auto& [vertex, around] : cells_at) {
        if (around.size() != 2 || outer.count(vertex)) continue;
        std::vector<Loop> shorter;
        for (int c : around) {
            Loop loop = cells.cells[c];
            loop.erase(std::find(loop.begin(), loop.end(), vertex));
            if (loop.size() >= 3 && reference_point(polygon_of(cells, loop)))
                shorter.push_back(loop);
        }
        if (shorter.size() < 2) continue;
        for (int i : { 0, 1 }) {
            cells.cells[around[i]] = shorter[i];
            cells.reshape(around[i]);
        }
    }
}

void collapse_short_edges(PlanarCells& cells, double short_edge)
{
    PowerDiagram diagram;
    diagram.vertices = cells.vertices;
    diagram.kinds = kinds_of(cells);
    const EdgeOwners owners(cells.cells);
    for (const Loop& loop : cells.cells) {
        diagram.cells.emplace_back();
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int u = loop[k], v = loop[(k + 1) % loop.size()];
            const auto side = cells.sides.find(undirected(u, v));
            diagram.cells.back().push_back(
                { u, owners.left_of(v, u), side == cells.sides.end() ? -1 : side->second });
        }
    }
    Outline polygon;  // vertices on straight sides need no more of it
    polygon.corners.resize(3);
    collapse_edges(diagram, polygon, short_edge, 0.0, true);
    cells.vertices = diagram.vertices;
    cells.sides.clear();
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        const auto& edges = diagram.cells[c];
        Loop loop;
        for (std::size_t k = 0; k < edges.size(); ++k) {
            loop.push_back(edges[k].vertex);
            if (edges[k].neighbour < 0)
                cells.sides[undirected(edges[k].vertex, edges[(k + 1) % edges.size()].vertex)] =
                    edges[k].side;
        }
        cells.cells[c] = loop;
    }
}

}  // namespace flexpm
