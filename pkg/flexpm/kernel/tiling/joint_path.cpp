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
constexpr double least_length = 1e-9;
/// Share of the size of a cell below which a vertex may not come to the next one.
constexpr double least_edge = 0.001;

/// A place of the line: a vertex on it, or a crossing of the edge between two vertices.
struct Node {
    double along;     ///< [m]
    int vertex;       ///< -1: a crossing
    VertexPair edge;  ///< of a crossing
    Point place;
};

/// The place of a line nearest to a point [m].
struct Nearest {
    double distance, along;
};

/// The nearer one, of two alike the first.
Nearest nearer(Nearest first, Nearest second)
{
    return second.distance < first.distance ? second : first;
}

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

    Nearest nearest(Point p, int segment) const
    {
        const Point e = way(segment);
        const double share = std::clamp(dot(p - from(segment), e) / dot(e, e), 0.0, 1.0);
        return { norm(p - (from(segment) + share * e)), along(segment, share) };
    }

    /// Ends of a segment; of those beyond the ends of the line, the part within a distance.
    std::pair<Point, Point> stretch(int segment, double reach) const
    {
        const Point a = from(segment), b = from(segment + 1);
        const double share = std::min(reach / norm(b - a), 1.0);
        if (segment == 0) return { b + share * (a - b), b };
        if (segment == segments() - 1) return { a, a + share * (b - a) };
        return { a, b };
    }

    Point way_at(double along) const { return way(segment_at(along)); }
    Point place(double along) const
    {
        const int segment = segment_at(along);
        return points[segment]
            + ((along - at[segment]) / (at[segment + 1] - at[segment])) * way(segment);
    }

    /// Length that the line itself covers of a stretch.
    double overlap(double first, double last) const
    {
        return std::max(std::min(last, end) - std::max(first, start), 0.0);
    }

    /// Part of a stretch that the line itself covers.
    double covered(double first, double last) const
    {
        if (!(last > first)) return first >= start && first <= end ? 1.0 : 0.0;
        return overlap(first, last) / (last - first);
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

Nearest nearest(const LongLine& line, Point p)
{
    Nearest best = line.nearest(p, 0);
    for (int k = 1; k < line.segments(); ++k)
        best = nearer(best, line.nearest(p, k));
    return best;
}

/// Crossing of an edge and a segment of the line, if there is one.
void add_crossing(const PlanarCells& cells, VertexPair edge, const LongLine& line, int k,
    std::vector<Node>& nodes)
{
    const Point u = cells.vertices[edge.first], e = cells.vertices[edge.second] - u;
    const Point a = line.from(k), b = line.from(k + 1), w = b - a;
    const double of_u = cross(w, u - a), of_v = cross(w, u + e - a);
    // the first end of a segment belongs to it, the last to the next, which must have the same
    // numbers
    const double of_a = cross(e, a - u), of_b = cross(e, b - u);
    if (!((of_u > 0.0) != (of_v > 0.0) && (of_a >= 0.0) != (of_b >= 0.0))) return;
    const double share = of_u / (of_u - of_v);
    nodes.push_back({ line.along(k, of_a / (of_a - of_b)), -1, edge, u + share * e });
}

template <class T> void make_unique(std::vector<T>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// All places of a line, along it, and of what goes on so far before and after it.
std::vector<Node> nodes_of(
    const CellIndex& index, const LongLine& line, double before, double after, double snap)
{
    const PlanarCells& cells = index.cells;
    std::vector<std::pair<int, int>> close;               // vertices and the segments near to them
    std::vector<std::pair<VertexPair, int>> close_edges;  // the same of edges
    const int last = line.segments() - 1;
    for (int k = 0; k <= last; ++k) {
        const auto [from, to] = line.stretch(k, k == 0 ? before : after);
        for (int cell : index.near(from, to, snap)) {
            const Loop& loop = cells.cells[cell];
            for (std::size_t i = 0; i < loop.size(); ++i) {
                close.push_back({ loop[i], k });
                close_edges.push_back({ undirected(loop[i], loop[(i + 1) % loop.size()]), k });
            }
        }
    }
    make_unique(close);
    make_unique(close_edges);
    std::vector<Node> nodes;
    std::set<int> on_line;
    for (std::size_t i = 0; i < close.size();) {
        const int v = close[i].first;
        const Point p = cells.vertices[v];
        Nearest found = line.nearest(p, 0);
        for (; i < close.size() && close[i].first == v; ++i)
            found = nearer(found, line.nearest(p, close[i].second));
        found = nearer(found, line.nearest(p, last));
        if (found.distance > snap) continue;
        on_line.insert(v);
        nodes.push_back({ found.along, v, {}, p });
    }
    for (const auto& [edge, k] : close_edges)
        if (!on_line.count(edge.first) && !on_line.count(edge.second))
            add_crossing(cells, edge, line, k, nodes);
    std::stable_sort(
        nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.along < b.along; });
    return nodes;
}

/// Moves vertices onto a line where the cells around them stay sound.
class Straightener {
public:
    /// @param own_edges  of the line itself; other joints stay straight
    Straightener(CellIndex& i, double mean, const std::set<VertexPair>& own_edges) :
        index(i),
        cells(i.cells),
        mean_area(mean),
        own(own_edges)
    {
    }

    /// Move a vertex to the line that runs through `on_line` along `way`.
    void move(int vertex, Point on_line, Point way)
    {
        Point target = on_line;
        if (index.cells_at(vertex).empty() || !stays_on_rail(vertex, way, target)) return;
        const Point before = cells.vertices[vertex];
        cells.vertices[vertex] = target;
        for (int cell : index.cells_at(vertex)) {
            if (is_sound(cells.cells[cell], vertex)) continue;
            cells.vertices[vertex] = before;
            return;
        }
        index.move(vertex, target);
    }

private:
    CellIndex& index;
    PlanarCells& cells;
    double mean_area;
    const std::set<VertexPair>& own;

    /// A vertex on a side or on a straight joint goes to where the line crosses it; a corner has no
    /// such place.
    bool stays_on_rail(int vertex, Point way, Point& target) const
    {
        std::vector<VertexPair> on_side;
        std::set<VertexPair> on_joint;
        std::set<int> sides;
        for (int cell : index.cells_at(vertex)) {
            const Loop& loop = cells.cells[cell];
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const VertexPair edge = undirected(loop[k], loop[(k + 1) % loop.size()]);
                if (edge.first != vertex && edge.second != vertex) continue;
                if (cells.joints.count(edge) && !own.count(edge)) on_joint.insert(edge);
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

/// Make vertices of the crossings among the nodes that are needed. Several may lie on one edge;
/// closer together than `least` they are one vertex, as where a line turns back onto itself.
void insert_crossings(
    CellIndex& index, std::vector<Node>& nodes, const std::vector<bool>& needed, double least)
{
    PlanarCells& cells = index.cells;
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
            index.divide(undirected(from, edge.second), node.vertex);
            from = node.vertex;
        }
    }
}

/// How far a line is followed beyond its ends: through the cells that they lie in [m].
double beyond(CellIndex& index)
{
    return std::max(10.0 * index.longest_edge(), 2.0 * index.largest_cell());
}

/// How far from an end of a line the end of its cell may lie, and a vertex that stands for it [m].
double reach(CellIndex& index, Point end, double snap)
{
    if (!index.is_in_a_cell(end)) return index.largest_cell() + index.longest_edge() + snap;
    double farthest = 0.0;
    for (int cell : index.near(end, end, snap))
        for (int v : index.cells.cells[cell])
            farthest = std::max(farthest, norm(index.cells.vertices[v] - end));
    return farthest + snap;
}

}  // namespace

std::vector<JointStep> joint_steps(CellIndex& index, const JointLine& joint, double mean_area)
{
    const double snap = snap_distance * 2.0 * std::sqrt(mean_area / pi);
    const LongLine line(joint, beyond(index));
    std::vector<Node> nodes = nodes_of(index, line, reach(index, joint.points.front(), snap),
        reach(index, joint.points.back(), snap), snap);
    std::vector<bool> needed(nodes.size(), false);
    std::vector<std::size_t> steps;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const double first = nodes[k].along, last = nodes[k + 1].along;
        if (line.covered(first, last) < 0.5) continue;
        if (!index.is_in_a_cell(line.place(0.5 * (first + last)))) continue;
        steps.push_back(k);
        needed[k] = needed[k + 1] = true;
    }
    const std::set<VertexPair> none;  // nothing is laid yet
    Straightener straightener(index, mean_area, none);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (needed[k] && nodes[k].vertex >= 0)
            straightener.move(
                nodes[k].vertex, line.place(nodes[k].along), line.way_at(nodes[k].along));
    }
    insert_crossings(index, nodes, needed, least_edge * std::sqrt(mean_area));
    std::vector<JointStep> found;
    for (std::size_t k : steps) {
        found.push_back({ nodes[k].vertex, nodes[k + 1].vertex,
            line.overlap(nodes[k].along, nodes[k + 1].along) });
    }
    return found;
}

double length_outside(const CellIndex& index, const JointLine& line)
{
    const PlanarCells& cells = index.cells;
    double outside = 0.0;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        const Point a = line.points[i], w = line.points[i + 1] - a;
        std::vector<double> shares { 0.0, 1.0 };
        for (int cell : index.near(a, line.points[i + 1], 0.0)) {
            const Loop& loop = cells.cells[cell];
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const int v = loop[k], next = loop[(k + 1) % loop.size()];
                const Point u = cells.vertices[v], e = cells.vertices[next] - u;
                const double of_u = cross(w, u - a), of_v = cross(w, u + e - a);
                const double share = cross(u - a, e) / cross(w, e);
                if ((of_u > 0.0) != (of_v > 0.0) && share > 0.0 && share < 1.0
                    && index.is_boundary(v, next))
                    shares.push_back(share);
            }
        }
        std::sort(shares.begin(), shares.end());
        for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
            if (!index.is_in_a_cell(a + 0.5 * (shares[k] + shares[k + 1]) * w))
                outside += (shares[k + 1] - shares[k]) * norm(w);
        }
    }
    return outside;
}

void straighten(CellIndex& index, const JointLine& joint, const std::vector<int>& vertices,
    const std::set<VertexPair>& laid, double mean_area)
{
    const double least = least_length * std::sqrt(mean_area);
    const LongLine line(joint, beyond(index));
    Straightener straightener(index, mean_area, laid);
    for (int v : vertices) {
        const Nearest found = nearest(line, index.cells.vertices[v]);
        if (found.distance > least)
            straightener.move(v, line.place(found.along), line.way_at(found.along));
    }
}

}  // namespace flexpm
