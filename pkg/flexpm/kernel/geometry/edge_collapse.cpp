// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Queue of edges by length; each collapse is tried on copies of the cells that it touches.
#include <flexpm/kernel/geometry/edge_collapse.hpp>

#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/reference_point.hpp>

#include <algorithm>
#include <set>
#include <tuple>

namespace flexpm {
namespace {

using Cell = std::vector<CellEdge>;

class Collapser {
public:
    Collapser(PowerDiagram& d, const Outline& o, double threshold_, double smallest_, bool any) :
        diagram(d),
        outline(o),
        threshold(threshold_),
        smallest(smallest_),
        seen_from_any(any),
        cells_at(d.vertices.size()),
        merged(d.vertices.size(), false)
    {
        for (std::size_t i = 0; i < d.cells.size(); ++i)
            for (const CellEdge& e : d.cells[i])
                cells_at[e.vertex].insert(static_cast<int>(i));
        for (const Cell& cell : d.cells)
            for (std::size_t k = 0; k < cell.size(); ++k)
                offer(cell[k].vertex, cell[(k + 1) % cell.size()].vertex);
    }

    std::vector<bool> run()
    {
        while (!queue.empty()) {
            const auto [length_then, u, v] = *queue.begin();
            queue.erase(queue.begin());
            const CellEdge* edge = find_edge(u, v);
            if (edge != nullptr && length(u, v) == length_then) collapse(*edge, u, v);
        }
        return std::move(merged);
    }

private:
    PowerDiagram& diagram;
    const Outline& outline;
    double threshold;
    double smallest;
    bool seen_from_any;
    std::vector<std::set<int>> cells_at;  ///< cells that meet in a vertex
    std::vector<bool> merged;
    std::set<std::tuple<double, int, int>> queue;  ///< (length, smaller vertex, larger vertex)

    double length(int u, int v) const { return norm(diagram.vertices[v] - diagram.vertices[u]); }

    void offer(int u, int v)
    {
        const double l = length(u, v);
        if (l < threshold) queue.emplace(l, std::min(u, v), std::max(u, v));
    }

    /// One of the (at most two) sides of the edge between u and v, or null if it is gone.
    const CellEdge* find_edge(int u, int v) const
    {
        for (int i : cells_at[u]) {
            const Cell& cell = diagram.cells[i];
            for (std::size_t k = 0; k < cell.size(); ++k) {
                const int a = cell[k].vertex, b = cell[(k + 1) % cell.size()].vertex;
                if ((a == u && b == v) || (a == v && b == u)) return &cell[k];
            }
        }
        return nullptr;
    }

    Point middle(int u, int v) const
    {
        const Point a = diagram.vertices[u], b = diagram.vertices[v];
        const Point m = 0.5 * (a + b);
        if (!outline.is_circle() || diagram.kinds[u] != VertexKind::side) return m;
        const Point out = m - outline.centre;
        return outline.centre + (outline.radius / norm(out)) * out;
    }

    void collapse(const CellEdge& edge, int u, int v)
    {
        const VertexKind ku = diagram.kinds[u], kv = diagram.kinds[v];
        const bool both_outer = ku != VertexKind::inner && kv != VertexKind::inner;
        if (both_outer && (edge.neighbour >= 0 || (ku == VertexKind::corner && ku == kv))) return;
        const int kept = kv > ku ? v : u, lost = kept == u ? v : u;
        const Point target = ku == kv ? middle(u, v) : diagram.vertices[kept];

        std::set<int> touched = cells_at[u];
        touched.insert(cells_at[v].begin(), cells_at[v].end());
        std::vector<Cell> changed;
        for (int i : touched) {
            changed.push_back(merge(diagram.cells[i], kept, lost));
            if (!is_sound(changed.back(), kept, target)) return;
        }
        diagram.vertices[kept] = target;
        merged[kept] = true;
        cells_at[kept] = touched;
        cells_at[lost].clear();
        auto next = changed.begin();
        for (int i : touched)
            diagram.cells[i] = std::move(*next++);
        for (int i : touched)
            offer_edges_at(kept, diagram.cells[i]);
    }

    /// The cell with `lost` replaced by `kept`, without the edge between them.
    static Cell merge(const Cell& cell, int kept, int lost)
    {
        Cell result;
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const int a = cell[k].vertex, b = cell[(k + 1) % cell.size()].vertex;
            if ((a == kept && b == lost) || (a == lost && b == kept)) continue;
            result.push_back(cell[k]);
            if (a == lost) result.back().vertex = kept;
        }
        return result;
    }

    bool is_sound(const Cell& cell, int moved, Point target) const
    {
        std::vector<Point> polygon;
        for (const CellEdge& e : cell)
            polygon.push_back(e.vertex == moved ? target : diagram.vertices[e.vertex]);
        const PolygonShape shape = polygon_shape(polygon);
        if (!(shape.area > 0.0)) return false;
        return is_star_shaped(polygon, shape.centroid, smallest)
            || (seen_from_any && reference_point(polygon));
    }

    void offer_edges_at(int vertex, const Cell& cell)
    {
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const int a = cell[k].vertex, b = cell[(k + 1) % cell.size()].vertex;
            if (a == vertex || b == vertex) offer(a, b);
        }
    }
};

}  // namespace

std::vector<bool> collapse_edges(PowerDiagram& diagram, const Outline& outline, double threshold,
    double smallest, bool seen_from_any)
{
    return Collapser(diagram, outline, threshold, smallest, seen_from_any).run();
}

}  // namespace flexpm
