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

/// Take out vertices on a straight edge between two cells that have the same joint on both sides of
/// the vertex.
void remove_idle_vertices(CellIndex& index, std::size_t first)
{
    PlanarCells& cells = index.cells;
    const auto joint_of = [&](VertexPair edge) {
        const auto at = cells.joints.find(edge);
        return at == cells.joints.end() ? -1 : at->second;
    };
    for (int vertex = static_cast<int>(first); vertex < static_cast<int>(cells.vertices.size());
         ++vertex) {
        const std::vector<int>& around = index.cells_at(vertex);
        if (around.empty() || around.size() > 2) continue;
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
        index.remove(vertex);
    }
}

class Cutter {
public:
    Cutter(CellIndex& i, double mean) : index(i), cells(i.cells), mean_area(mean) { }

    LineCut cut(const JointLine& line)
    {
        const std::size_t first = cells.vertices.size();
        found = {};
        taken_by.clear();
        laid.clear();
        for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
            found.length += norm(line.points[k + 1] - line.points[k]);
        const double outside = length_outside(index, line);
        for (const JointStep& step : joint_steps(index, line, mean_area))
            connect(step, line.joint);
        found.outside = std::max(std::min(outside, found.length - found.cut - found.taken), 0.0);
        const auto most = std::max_element(taken_by.begin(), taken_by.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
        if (most != taken_by.end()) found.on = most->first;
        if (around.empty()) return found;
        // places where it would have crossed are in the way
        remove_idle_vertices(index, first);
        straighten(index, line, around, laid, mean_area);
        around.clear();
        return found;
    }

private:
    CellIndex& index;
    PlanarCells& cells;
    double mean_area;
    std::vector<int> around;         ///< vertices where the line goes along edges
    std::set<VertexPair> laid;       ///< edges of the line
    LineCut found;                   ///< what came of the line
    std::map<int, double> taken_by;  ///< length that lies on edges of each joint [m]

    /// Lay a joint along a step.
    void connect(const JointStep& step, int joint)
    {
        if (step.from == step.to) return;
        if (split_between(step.from, step.to, joint)) {
            found.cut += step.length;
            ++found.contacts;
            return;
        }
        const Loop way = way_along_edges(step.from, step.to);
        around.insert(around.end(), way.begin(), way.end());
        double length = 0.0, fresh = 0.0;
        std::map<int, double> old;
        for (std::size_t k = 0; k + 1 < way.size(); ++k) {
            const double edge = norm(cells.vertices[way[k + 1]] - cells.vertices[way[k]]);
            length += edge;
            if (index.is_boundary(way[k], way[k + 1])) continue;
            const int owner = lay({ way[k], way[k + 1] }, joint);
            (owner < 0 ? fresh : old[owner]) += edge;
            found.contacts += owner < 0;
        }
        if (!(length > 0.0)) return;
        found.cut += step.length * (fresh / length);
        for (const auto& [owner, part] : old) {
            found.taken += step.length * (part / length);
            taken_by[owner] += step.length * (part / length);
        }
    }

    /// An edge keeps the joint that it has, which is returned; -1: it had none.
    int lay(VertexPair ends, int joint)
    {
        const VertexPair edge = undirected(ends.first, ends.second);
        const auto [at, added] = cells.joints.emplace(edge, joint);
        if (added) laid.insert(edge);
        return added ? -1 : at->second;
    }

    /// Split the cell of which two vertices are the ends of a diagonal that leaves sound parts.
    bool split_between(int from, int to, int joint)
    {
        for (int c : index.cells_at(from)) {
            const Loop& loop = cells.cells[c];
            const auto at = std::find(loop.begin(), loop.end(), from),
                       other = std::find(loop.begin(), loop.end(), to);
            if (other == loop.end()) continue;
            const int i = static_cast<int>(at - loop.begin()),
                      j = static_cast<int>(other - loop.begin());
            const int n = static_cast<int>(loop.size());
            if ((i + 1) % n == j || (j + 1) % n == i || !is_diagonal(polygon_of(cells, loop), i, j))
                continue;
            Loop first = part_of(loop, i, j), second = part_of(loop, j, i);
            if (!is_sound(first) || !is_sound(second)) continue;
            index.split(c, std::move(first), std::move(second));
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

    /// Vertices at the other ends of the edges of a vertex, some twice.
    std::vector<int> next_to(int vertex) const
    {
        std::vector<int> next;
        for (int c : index.cells_at(vertex)) {
            const Loop& loop = cells.cells[c];
            const std::size_t n = loop.size(),
                              k = std::find(loop.begin(), loop.end(), vertex) - loop.begin();
            next.push_back(loop[(k + n - 1) % n]);
            next.push_back(loop[(k + 1) % n]);
        }
        return next;
    }

    /// Vertices of the shortest way along edges; what lies off the straight line counts twice.
    Loop way_along_edges(int from, int to) const
    {
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
            for (int v : next_to(u)) {
                const double longer = cost + norm(cells.vertices[v] - cells.vertices[u])
                    + 2.0 * off(0.5 * (cells.vertices[u] + cells.vertices[v]));
                const auto known = best.find(v);
                if (known != best.end() && known->second.first <= longer) continue;
                best[v] = { longer, u };
                open.push({ longer, v });
            }
        }
        Loop vertices;
        for (int v = to; v >= 0 && best.count(v); v = best.at(v).second)
            vertices.push_back(v);
        std::reverse(vertices.begin(), vertices.end());
        return vertices;
    }
};

/// Sizes of the specimen within which a line may reach: beyond, round-off shows in its places.
constexpr double farthest = 1e6;
/// Sizes of the specimen within which two points of a line are one: round-off of their distance,
/// as far as they lie where they cut something.
constexpr double same_place = 1e-12;

double size_of(const Tessellation& t)
{
    double size = 0.0;
    for (Point p : t.vertices)
        size = std::max(size, norm(p - t.vertices.front()));
    return size;
}

/// A line whose points that are there twice in a row count once.
/// @param size  of the specimen [m], which has this vertex
JointLine checked_line(const JointLine& line, std::size_t number, Point vertex, double size)
{
    const std::string name = "joint line " + std::to_string(number);
    if (line.points.size() < 2) {
        refuse(name + ": points", static_cast<double>(line.points.size()), "",
            "must be >= 2; complete the line");
    }
    JointLine found { {}, line.joint };
    for (const Point p : line.points) {
        if (!is_finite(p)) refuse(name + ": point", place(p), "must be finite; correct it");
        if (!(norm(p - vertex) <= farthest * size)) {
            refuse(name + ": point", place(p),
                "must lie within 1e6 sizes of the specimen; move it there");
        }
        if (found.points.empty() || norm(p - found.points.back()) > same_place * size)
            found.points.push_back(p);
    }
    if (found.points.size() < 2) {
        refuse(name + ": point", place(line.points.front()),
            "must not be there twice in a line without length; remove the line");
    }
    return found;
}

}  // namespace

JointCut cut_by_joints(const Tessellation& tessellation, const std::vector<Disc>& discs,
    const std::vector<int>& joints, const std::vector<JointLine>& lines,
    const std::function<void(std::size_t)>& tell)
{
    PlanarCells cells = planar_cells(tessellation);
    for (std::size_t e = 0; e < joints.size(); ++e) {
        const SharedEdge& edge = tessellation.shared_edges[e];
        if (joints[e] >= 0) cells.joints[undirected(edge.vertex_0, edge.vertex_1)] = joints[e];
    }
    const double size = size_of(tessellation);
    std::vector<JointLine> checked;
    for (std::size_t k = 0; k < lines.size(); ++k)
        checked.push_back(checked_line(lines[k], k, tessellation.vertices.front(), size));
    CellIndex index(cells);
    Cutter cutter(index, enclosed_area(tessellation) / tessellation.cells());
    JointCut made;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        made.lines.push_back(cutter.cut(checked[k]));
        if (tell) tell(k + 1);
    }
    remove_idle_vertices(index, tessellation.vertices.size());
    // a vertex that was moved onto a line may be out of sight of the disc's centre
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        const Point centre = discs[cells.origin[c]].centre;
        if (!(clearance(polygon_of(cells, cells.cells[c]), centre) > 0.0)) cells.whole[c] = 0;
    }
    made.tiling = make_tiling(cells, discs);
    return made;
}

}  // namespace flexpm
