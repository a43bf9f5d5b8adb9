// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Vertices on the line and crossings of edges, sorted along the line.
#include <flexpm/kernel/tiling/joint_path.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/reference_point.hpp>
#include <flexpm/kernel/tiling/diagonals.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace flexpm {

namespace {

/// Share of the size of a cell below which a distance is round-off.
constexpr double round_off = 1e-9;
/// Share of the size of a cell below which a vertex may not come to the next one.
constexpr double least_edge = 0.001;

/// A place of the line: a vertex on it, or a crossing of the edge between two vertices.
struct Node {
    double along;     ///< [m]
    int vertex;       ///< -1: a crossing
    VertexPair edge;  ///< of a crossing
    Point place;
};

/// A line that goes on straight beyond both ends.
class LongLine {
public:
    LongLine(const JointLine& line, double beyond) : points(line.points), start(beyond)
    {
        const Point out = points[0] - points[1], on = points.back() - points[points.size() - 2];
        points.insert(points.begin(), points.front() + (beyond / norm(out)) * out);
        points.push_back(points.back() + (beyond / norm(on)) * on);
        at.push_back(0.0);
        for (std::size_t k = 1; k < points.size(); ++k)
            at.push_back(at.back() + norm(points[k] - points[k - 1]));
        end = at.back() - beyond;
    }

    int segments() const { return static_cast<int>(points.size()) - 1; }
    /// First point of a segment, which is the last of the one before.
    Point from(int segment) const { return points[segment]; }
    Point way(int segment) const { return points[segment + 1] - points[segment]; }
    double along(int segment, double share) const
    {
        return at[segment] + share * (at[segment + 1] - at[segment]);
    }

    Point way_at(double along) const { return way(segment_at(along)); }
    Point place(double along) const
    {
        const int segment = segment_at(along);
        return points[segment]
            + ((along - at[segment]) / (at[segment + 1] - at[segment])) * way(segment);
    }

    /// Part of a stretch that the line itself covers.
    double covered(double first, double last) const
    {
        if (!(last > first)) return first >= start && first <= end ? 1.0 : 0.0;
        return std::max(std::min(last, end) - std::max(first, start), 0.0) / (last - first);
    }

private:
    std::vector<Point> points;
    std::vector<double> at;  ///< of each point, along the line
    double start, end;       ///< of the line itself

    int segment_at(double along) const
    {
        const auto next = std::upper_bound(at.begin() + 1, at.end() - 1, along);
        return static_cast<int>(next - at.begin()) - 1;
    }
};

struct Nearest {
    double distance;
    double along;
};

Nearest nearest(const LongLine& line, Point p)
{
    Nearest best { std::numeric_limits<double>::infinity(), 0.0 };
    for (int k = 0; k < line.segments(); ++k) {
        const Point e = line.way(k);
        const double share = std::clamp(dot(p - line.from(k), e) / dot(e, e), 0.0, 1.0);
        const double distance = norm(p - (line.from(k) + share * e));
        if (distance < best.distance) best = { distance, line.along(k, share) };
    }
    return best;
}

bool is_inside(const std::vector<Point>& polygon, Point p)
{
    bool inside = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

bool is_in_a_cell(const PlanarCells& cells, Point p)
{
    return std::any_of(cells.cells.begin(), cells.cells.end(),
        [&](const Loop& loop) { return is_inside(polygon_of(cells, loop), p); });
}

std::set<VertexPair> edges_of(const PlanarCells& cells)
{
    std::set<VertexPair> edges;
    for (const Loop& loop : cells.cells)
        for (std::size_t k = 0; k < loop.size(); ++k)
            edges.insert(undirected(loop[k], loop[(k + 1) % loop.size()]));
    return edges;
}

double longest_edge(const PlanarCells& cells, const std::set<VertexPair>& edges)
{
    double longest = 0.0;
    for (const auto& [u, v] : edges)
        longest = std::max(longest, norm(cells.vertices[v] - cells.vertices[u]));
    return longest;
}

void add_crossings(
    const PlanarCells& cells, VertexPair edge, const LongLine& line, std::vector<Node>& nodes)
{
    const Point u = cells.vertices[edge.first], e = cells.vertices[edge.second] - u;
    for (int k = 0; k < line.segments(); ++k) {
        const Point a = line.from(k), b = line.from(k + 1), w = b - a;
        const double of_u = cross(w, u - a), of_v = cross(w, u + e - a);
        // the first end of a segment belongs to it, the last to the next, which must have the same numbers
        const double of_a = cross(e, a - u), of_b = cross(e, b - u);
        if (!((of_u > 0.0) != (of_v > 0.0) && (of_a >= 0.0) != (of_b >= 0.0))) continue;
        const double share = of_u / (of_u - of_v);
        nodes.push_back({ line.along(k, of_a / (of_a - of_b)), -1, edge, u + share * e });
    }
}

/// All places of a line, along it.
std::vector<Node> nodes_of(
    const PlanarCells& cells, const LongLine& line, const std::set<VertexPair>& edges, double snap)
{
    std::vector<Node> nodes;
    std::set<int> used, on_line;
    for (const auto& [u, v] : edges)
        used.insert({ u, v });
    for (int v : used) {
        const Nearest found = nearest(line, cells.vertices[v]);
        if (found.distance > snap) continue;
        on_line.insert(v);
        nodes.push_back({ found.along, v, {}, cells.vertices[v] });
    }
    for (const VertexPair& edge : edges)
        if (!on_line.count(edge.first) && !on_line.count(edge.second))
            add_crossings(cells, edge, line, nodes);
    std::stable_sort(
        nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.along < b.along; });
    return nodes;
}

/// Moves vertices onto a line where the cells around them stay sound.
class Straightener {
public:
    /// @param rails   joints along which their vertices may go
    Straightener(PlanarCells& c, double mean, const std::set<VertexPair>& joints) :
        cells(c),
        mean_area(mean),
        rails(joints)
    {
        for (std::size_t i = 0; i < cells.cells.size(); ++i)
            for (int v : cells.cells[i])
                around[v].push_back(i);
    }

    /// Move a vertex to the line that runs through `on_line` along `way`.
    void move(int vertex, Point on_line, Point way)
    {
        Point target = on_line;
        if (!around.count(vertex) || !stays_on_rail(vertex, way, target)) return;
        const Point before = cells.vertices[vertex];
        cells.vertices[vertex] = target;
        for (std::size_t cell : around[vertex]) {
            if (is_sound(cells.cells[cell], vertex)) continue;
            cells.vertices[vertex] = before;
            return;
        }
    }

private:
    PlanarCells& cells;
    double mean_area;
    std::map<int, std::vector<std::size_t>> around;
    const std::set<VertexPair>& rails;

    /// A vertex on a side or on a straight joint goes to where the line crosses it; a corner has no such place.
    bool stays_on_rail(int vertex, Point way, Point& target) const
    {
        std::vector<VertexPair> on_side;
        std::set<VertexPair> on_joint;
        std::set<int> sides;
        for (std::size_t cell : around.at(vertex)) {
            const Loop& loop = cells.cells[cell];
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const VertexPair edge = undirected(loop[k], loop[(k + 1) % loop.size()]);
                if (edge.first != vertex && edge.second != vertex) continue;
                if (rails.count(edge)) on_joint.insert(edge);
                const auto side = cells.sides.find(edge);
                if (side == cells.sides.end()) continue;
                on_side.push_back(edge);
                sides.insert(side->second);
            }
        }
        if (on_side.empty() && on_joint.empty()) return true;
        if (on_side.size() + on_joint.size() != 2 || sides.size() > 1) return false;
        const auto out = [&](const VertexPair& edge) {
            return cells.vertices[edge.first == vertex ? edge.second : edge.first]
                - cells.vertices[vertex];
        };
        const Point at = cells.vertices[vertex];
        const Point e = out(on_side.empty() ? *on_joint.begin() : on_side.front());
        if (on_side.empty()) {
            if (!is_between(e, {}, out(*on_joint.rbegin()))) return false;
        }
        const double slope = cross(e, way), share = cross(target - at, way) / slope;
        if (!(std::abs(slope) > 0.1 * norm(e) * norm(way))) return false;
        target = at + share * e;
        return true;
    }

    bool is_sound(const Loop& loop, int moved) const
    {
        const std::vector<Point> polygon = polygon_of(cells, loop);
        const std::size_t n = polygon.size(),
                          k = std::find(loop.begin(), loop.end(), moved) - loop.begin();
        for (std::size_t corner : { k + n - 1, k, k + 1 }) {
            if (angle_at(polygon, corner % n) < least_angle) return false;
        }
        // a line along an earlier joint would move a vertex onto the next one
        for (std::size_t next : { k + n - 1, k + 1 }) {
            if (norm(polygon[next % n] - polygon[k]) < least_edge * std::sqrt(mean_area))
                return false;
        }
        return polygon_shape(polygon).area >= least_piece * mean_area && reference_point(polygon);
    }
};

/// Divide an edge by a vertex in all cells that have it.
void divide(PlanarCells& cells, VertexPair edge, int vertex)
{
    for (Loop& loop : cells.cells) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            if (undirected(loop[k], loop[(k + 1) % loop.size()]) != edge) continue;
            loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(k) + 1, vertex);
            break;
        }
    }
    for (auto* labels : { &cells.sides, &cells.joints }) {
        const auto at = labels->find(edge);
        if (at == labels->end()) continue;
        const int label = at->second;
        labels->erase(at);
        labels->emplace(undirected(edge.first, vertex), label);
        labels->emplace(undirected(vertex, edge.second), label);
    }
}

/// Make vertices of the crossings among the nodes that are needed. Several may lie on one edge; closer together than
/// `least` they are one vertex, as where a line turns back onto itself.
void insert_crossings(
    PlanarCells& cells, std::vector<Node>& nodes, const std::vector<bool>& needed, double least)
{
    std::map<VertexPair, std::vector<std::pair<double, std::size_t>>> on_edge;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (!needed[k] || nodes[k].vertex >= 0) continue;
        on_edge[nodes[k].edge].push_back(
            { norm(nodes[k].place - cells.vertices[nodes[k].edge.first]), k });
    }
    for (auto& [edge, crossings] : on_edge) {
        std::sort(crossings.begin(), crossings.end());
        int from = edge.first;
        for (const auto& crossing : crossings) {
            Node& node = nodes[crossing.second];
            if (from != edge.first && norm(node.place - cells.vertices[from]) < least) {
                node.vertex = from;
                continue;
            }
            node.vertex = static_cast<int>(cells.vertices.size());
            cells.vertices.push_back(node.place);
            divide(cells, undirected(from, edge.second), node.vertex);
            from = node.vertex;
        }
    }
}

}  // namespace

std::vector<JointStep> joint_steps(PlanarCells& cells, const JointLine& joint, double mean_area)
{
    const double snap = snap_distance * 2.0 * std::sqrt(mean_area / pi);
    const std::set<VertexPair> edges = edges_of(cells);
    // beyond its ends a line is followed through the cells that they lie in
    const LongLine line(joint, 10.0 * longest_edge(cells, edges));
    std::vector<Node> nodes = nodes_of(cells, line, edges, snap);
    std::vector<bool> needed(nodes.size(), false);
    std::vector<std::size_t> steps;
    bool touched = false;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const double first = nodes[k].along, last = nodes[k + 1].along,
                     covered = line.covered(first, last);
        if (covered == 0.0 || !is_in_a_cell(cells, line.place(0.5 * (first + last)))) continue;
        touched = true;
        if (covered < 0.5) continue;
        steps.push_back(k);
        needed[k] = needed[k + 1] = true;
    }
    if (!touched) {
        refuse("joint from", place(joint.points.front()),
            "must lie inside the specimen; move or remove it");
    }
    std::set<VertexPair> rails;
    for (const auto& entry : cells.joints)
        rails.insert(entry.first);
    Straightener straightener(cells, mean_area, rails);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (needed[k] && nodes[k].vertex >= 0)
            straightener.move(
                nodes[k].vertex, line.place(nodes[k].along), line.way_at(nodes[k].along));
    }
    insert_crossings(cells, nodes, needed, least_edge * std::sqrt(mean_area));
    std::vector<JointStep> found;
    for (std::size_t k : steps)
        found.push_back({ nodes[k].vertex, nodes[k + 1].vertex });
    return found;
}

void straighten(PlanarCells& cells, const JointLine& joint, const std::vector<int>& vertices,
    const std::set<VertexPair>& laid, double mean_area)
{
    std::set<VertexPair> rails;
    for (const auto& entry : cells.joints)
        if (!laid.count(entry.first)) rails.insert(entry.first);
    const double least = round_off * std::sqrt(mean_area);
    const LongLine line(joint, 10.0 * longest_edge(cells, edges_of(cells)));
    Straightener straightener(cells, mean_area, rails);
    for (int v : vertices) {
        const Nearest found = nearest(line, cells.vertices[v]);
        if (found.distance > least)
            straightener.move(v, line.place(found.along), line.way_at(found.along));
    }
}

}  // namespace flexpm
