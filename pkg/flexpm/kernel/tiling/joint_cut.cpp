// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Each step of a line is a diagonal of a cell, or the shortest way along edges.
#include <flexpm/kernel/tiling/joint_cut.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/reference_point.hpp>
#include <flexpm/kernel/tiling/diagonals.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>

namespace flexpm {

namespace {

/// Take out vertices on a straight edge between two cells that have the same joint on both sides of the vertex.
void remove_idle_vertices(PlanarCells& cells, std::size_t first)
{
    std::map<int, std::vector<std::size_t>> cells_at;
    for (std::size_t c = 0; c < cells.cells.size(); ++c)
        for (int v : cells.cells[c])
            if (v >= static_cast<int>(first)) cells_at[v].push_back(c);
    const auto joint_of = [&](VertexPair edge) {
        const auto at = cells.joints.find(edge);
        return at == cells.joints.end() ? -1 : at->second;
    };
    for (const auto& [vertex, around] : cells_at) {
        if (around.size() > 2) continue;
        const Loop& loop = cells.cells[around[0]];
        const std::size_t n = loop.size(),
                          k = std::find(loop.begin(), loop.end(), vertex) - loop.begin();
        const int last = loop[(k + n - 1) % n], next = loop[(k + 1) % n];
        const VertexPair before = undirected(last, vertex), after = undirected(vertex, next);
        const VertexPair whole = undirected(last, next);
        if (joint_of(before) != joint_of(after)) continue;
        // a later line may have moved it
        const auto& places = cells.vertices;
        if (!is_between(places[last], places[vertex], places[next])) continue;
        for (auto* labels : { &cells.sides, &cells.joints }) {
            const auto at = labels->find(before);
            if (at == labels->end()) continue;
            labels->emplace(whole, at->second);
            labels->erase(before);
            labels->erase(after);
        }
        for (std::size_t c : around) {
            Loop& changed = cells.cells[c];
            changed.erase(std::find(changed.begin(), changed.end(), vertex));
        }
    }
}

class Cutter {
public:
    Cutter(PlanarCells& c, double mean) : cells(c), mean_area(mean) { }

    void cut(const JointLine& line)
    {
        const std::size_t first = cells.vertices.size();
        laid.clear();
        const std::vector<JointStep> steps = joint_steps(cells, line, mean_area);
        for (const JointStep& step : steps)
            connect(step.from, step.to, line.joint);
        if (around.empty()) return;
        // places where it would have crossed are in the way
        remove_idle_vertices(cells, first);
        straighten(cells, line, around, laid, mean_area);
        around.clear();
    }

private:
    PlanarCells& cells;
    double mean_area;
    std::vector<int> around;    ///< vertices where the line goes along edges
    std::set<VertexPair> laid;  ///< edges of the line

    /// Lay a joint between two vertices.
    void connect(int from, int to, int joint)
    {
        if (from == to || split_between(from, to, joint)) return;
        const Loop way = way_along_edges(from, to);
        around.insert(around.end(), way.begin(), way.end());
        const EdgeOwners owners(cells.cells);
        for (std::size_t k = 0; k + 1 < way.size(); ++k) {
            const bool inner = owners.left_of(way[k], way[k + 1]) != EdgeOwners::none
                && owners.left_of(way[k + 1], way[k]) != EdgeOwners::none;
            if (inner) lay({ way[k], way[k + 1] }, joint);
        }
    }

    /// An edge keeps the joint that it has.
    void lay(VertexPair ends, int joint)
    {
        const VertexPair edge = undirected(ends.first, ends.second);
        if (cells.joints.emplace(edge, joint).second) laid.insert(edge);
    }

    /// Split the cell of which two vertices are the ends of a diagonal that leaves sound parts.
    bool split_between(int from, int to, int joint)
    {
        for (std::size_t c = 0; c < cells.cells.size(); ++c) {
            const Loop& loop = cells.cells[c];
            const auto at = std::find(loop.begin(), loop.end(), from),
                       other = std::find(loop.begin(), loop.end(), to);
            if (at == loop.end() || other == loop.end()) continue;
            const int i = static_cast<int>(at - loop.begin()),
                      j = static_cast<int>(other - loop.begin());
            const int n = static_cast<int>(loop.size());
            if ((i + 1) % n == j || (j + 1) % n == i || !is_diagonal(polygon_of(cells, loop), i, j))
                continue;
            Loop first = part_of(loop, i, j), second = part_of(loop, j, i);
            if (!is_sound(first) || !is_sound(second)) continue;
            cells.cells[c] = std::move(first);
            cells.whole[c] = 0;
            cells.add_cell(std::move(second), cells.origin[c], false);
            lay({ from, to }, joint);
            return true;
        }
        return false;
    }

    /// Whether a part is large and blunt enough; the cut runs from its last vertex to its first.
    bool is_sound(const Loop& part) const
    {
        const std::vector<Point> polygon = polygon_of(cells, part);
        return polygon_shape(polygon).area >= least_piece * mean_area
            && angle_at(polygon, 0) >= least_angle
            && angle_at(polygon, polygon.size() - 1) >= least_angle && reference_point(polygon);
    }

    /// Vertices of the shortest way along edges; what lies off the straight line counts twice.
    Loop way_along_edges(int from, int to) const
    {
        std::map<int, std::vector<int>> next;
        for (const Loop& loop : cells.cells) {
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const int u = loop[k], v = loop[(k + 1) % loop.size()];
                next[u].push_back(v);
                next[v].push_back(u);
            }
        }
        const Point a = cells.vertices[from], way = cells.vertices[to] - a;
        // a cost that is no number would never end the search
        const double square = std::max(dot(way, way), std::numeric_limits<double>::min());
        const auto off = [&](Point p) {
            const double share = std::clamp(dot(p - a, way) / square, 0.0, 1.0);
            return norm(p - (a + share * way));
        };
        using Entry = std::pair<double, int>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
        std::map<int, std::pair<double, int>> best { { from, { 0.0, -1 } } };
        open.push({ 0.0, from });
        while (!open.empty() && open.top().second != to) {
            const auto [cost, u] = open.top();
            open.pop();
            if (cost > best.at(u).first) continue;
            for (int v : next[u]) {
                const double longer = cost + norm(cells.vertices[v] - cells.vertices[u])
                    + 2.0 * off(0.5 * (cells.vertices[u] + cells.vertices[v]));
                const auto found = best.find(v);
                if (found != best.end() && found->second.first <= longer) continue;
                best[v] = { longer, u };
                open.push({ longer, v });
            }
        }
        Loop found;
        for (int v = to; v >= 0 && best.count(v); v = best.at(v).second)
            found.insert(found.begin(), v);
        return found;
    }
};

/// Sizes of the specimen within which a line may reach: beyond, round-off shows in its places.
constexpr double farthest = 1e6;

double size_of(const Tessellation& t)
{
    double size = 0.0;
    for (Point p : t.vertices)
        size = std::max(size, norm(p - t.vertices.front()));
    return size;
}

/// @param reach  how far from a vertex of the specimen its points may lie [m]
void check_line(const JointLine& line, std::size_t number, Point vertex, double reach)
{
    const std::string name = "joint line " + std::to_string(number);
    if (line.points.size() < 2) {
        refuse(name + ": points", static_cast<double>(line.points.size()), "",
            "must be >= 2; complete the line");
    }
    for (std::size_t k = 0; k < line.points.size(); ++k) {
        if (!is_finite(line.points[k]))
            refuse(name + ": point", place(line.points[k]), "must be finite; correct it");
        if (!(norm(line.points[k] - vertex) <= reach)) {
            refuse(name + ": point", place(line.points[k]),
                "must lie within 1e6 sizes of the specimen; move it there");
        }
        if (k > 0 && !(norm(line.points[k] - line.points[k - 1]) > 0.0))
            refuse(name + ": point", place(line.points[k]), "must not be there twice; remove one");
    }
}

}  // namespace

Tiling cut_by_joints(const Tessellation& tessellation, const std::vector<Disc>& discs,
    const std::vector<int>& joints, const std::vector<JointLine>& lines)
{
    PlanarCells cells = planar_cells(tessellation);
    for (std::size_t e = 0; e < joints.size(); ++e) {
        const SharedEdge& edge = tessellation.shared_edges[e];
        if (joints[e] >= 0) cells.joints[undirected(edge.vertex_0, edge.vertex_1)] = joints[e];
    }
    Cutter cutter(cells, enclosed_area(tessellation) / tessellation.cells());
    const double reach = farthest * size_of(tessellation);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        check_line(lines[k], k, tessellation.vertices.front(), reach);
        cutter.cut(lines[k]);
    }
    remove_idle_vertices(cells, tessellation.vertices.size());
    // a vertex that was moved onto a line may be out of sight of the disc's centre
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        const Point centre = discs[cells.origin[c]].centre;
        if (!(clearance(polygon_of(cells, cells.cells[c]), centre) > 0.0)) cells.whole[c] = 0;
    }
    return make_tiling(cells, discs);
}

}  // namespace flexpm
