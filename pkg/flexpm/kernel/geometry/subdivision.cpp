// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Union of the small cells of all grains in one tessellation.
#include <flexpm/kernel/geometry/subdivision.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/lloyd.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace flexpm {

namespace {

/// Distance below which two corners become one, over the diameter of an inner particle [-].
constexpr double merge_distance = 0.05;

/// Points that are to be one vertex (union-find); the smallest number stands for all.
class Vertices {
public:
    int add(Point p)
    {
        parent.push_back(static_cast<int>(parent.size()));
        places.push_back(p);
        return parent.back();
    }
    int find(int i) const
    {
        while (parent[i] != i)
            i = parent[i];
        return i;
    }
    void join(int i, int j)
    {
        i = find(i);
        j = find(j);
        parent[std::max(i, j)] = std::min(i, j);
    }
    Point place(int i) const { return places[find(i)]; }
    double distance(int i, int j) const { return norm(place(j) - place(i)); }

private:
    std::vector<int> parent;
    std::vector<Point> places;
};

/// A corner of a small cell while cells are joined.
struct Corner {
    int vertex;
    Beyond beyond;  ///< the edge that starts here; seeds are numbered as the cells of all grains
};

struct Builder {
    const Tessellation& grains;
    double merge;  ///< [m]
    Vertices vertices;
    std::vector<std::vector<Corner>> cells;
    std::vector<int> grain;       ///< per cell
    std::vector<int> first_cell;  ///< per grain, and the end
    std::vector<Disc> discs;
    std::map<std::pair<int, int>, std::pair<int, int>> shared;  ///< cells -> vertices
    std::vector<std::uint8_t> outer;
};

void add_grain(Builder& b, int grain, int count)
{
    const int first = static_cast<int>(b.cells.size());
    const std::vector<Point> polygon = cell_polygon(b.grains, grain);
    const InnerPacking packing = relax_seeds(polygon, count);
    for (int i = 0; i < count; ++i) {
        std::vector<Corner> corners;
        std::vector<Point> points;
        const auto& cell = packing.cells[i];
        for (std::size_t k = 0; k < cell.size(); ++k) {
            Beyond beyond = cell[k].beyond;
            const Beyond before = cell[(k + cell.size() - 1) % cell.size()].beyond;
            // between two edges of the grain lies a vertex of the coarse tessellation
            const bool of_grain = beyond.is_edge() && before.is_edge() && beyond != before;
            const int vertex = of_grain
                ? b.grains.cell_vertices[b.grains.cell_offsets[grain] + beyond.index]
                : b.vertices.add(cell[k].point);
            if (beyond.is_seed()) beyond.index += first;
            corners.push_back({ vertex, beyond });
            points.push_back(cell[k].point);
        }
        b.cells.push_back(corners);
        b.grain.push_back(grain);
        b.discs.push_back({ packing.seeds[i], std::sqrt(polygon_shape(points).area / pi) });
    }
}

int next_of(const std::vector<Corner>& cell, std::size_t k)
{
    return cell[(k + 1) % cell.size()].vertex;
}

/// Make the ends of each edge that two cells of a grain share the same vertices, and remove short
/// edges.
void join_inside(Builder& b)
{
    for (int i = 0; i < static_cast<int>(b.cells.size()); ++i) {
        const auto& cell = b.cells[i];
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const Beyond beyond = cell[k].beyond;
            const int p0 = cell[k].vertex, p1 = next_of(cell, k);
            if (beyond.is_seed() && beyond.index > i) {
                const auto& other = b.cells[beyond.index];
                for (std::size_t m = 0; m < other.size(); ++m) {
                    if (other[m].beyond != Beyond { Beyond::Kind::seed, i }) continue;
                    if (b.vertices.distance(p0, next_of(other, m)) < b.merge) {
                        b.vertices.join(p0, next_of(other, m));
                    }
                    if (b.vertices.distance(p1, other[m].vertex) < b.merge) {
                        b.vertices.join(p1, other[m].vertex);
                    }
                }
            }
            if (b.vertices.distance(p0, p1) < b.merge) b.vertices.join(p0, p1);
        }
    }
}

/// A stretch of a grain's edge that belongs to one small cell, in the edge's own direction.
struct Stretch {
    int cell;
    int start, end;  ///< vertices
};

/// Stretches of edge `k` of a grain from its start to its end.
std::vector<Stretch> stretches_of(const Builder& b, int grain, int k)
{
    std::vector<Stretch> found;
    for (int i = b.first_cell[grain]; i < b.first_cell[grain + 1]; ++i) {
        for (std::size_t m = 0; m < b.cells[i].size(); ++m) {
            if (b.cells[i][m].beyond != Beyond { Beyond::Kind::edge, k }) continue;
            const int start = b.vertices.find(b.cells[i][m].vertex);
            const int end = b.vertices.find(next_of(b.cells[i], m));
            if (start != end) found.push_back({ i, start, end });
        }
    }
    const int first = b.grains.cell_vertices[b.grains.cell_offsets[grain] + k];
    std::sort(found.begin(), found.end(), [&](const Stretch& s, const Stretch& t) {
        return b.vertices.distance(first, s.start) < b.vertices.distance(first, t.start);
    });
    return found;
}

/// Number of the edge of a grain that starts at a vertex.
int edge_from(const Builder& b, int grain, int vertex)
{
    const int first = b.grains.cell_offsets[grain];
    for (int k = 0; k < b.grains.vertices_of(grain); ++k) {
        if (b.grains.cell_vertices[first + k] == vertex) return k;
    }
    return -1;
}

/// Make one vertex of inner ends of the stretches of both grains that lie close together.
void merge_across(Builder& b, const std::vector<Stretch>& one, const std::vector<Stretch>& other)
{
    for (const Stretch& s : one) {
        for (const Stretch& t : other) {
            for (int p : { s.start, s.end }) {
                for (int q : { t.start, t.end }) {
                    if (b.vertices.distance(p, q) < b.merge) b.vertices.join(p, q);
                }
            }
        }
    }
}

void insert_after(std::vector<Corner>& cell, const Builder& b, int start, int end, int vertex)
{
    for (std::size_t k = 0; k < cell.size(); ++k) {
        if (b.vertices.find(cell[k].vertex) != start) continue;
        if (b.vertices.find(next_of(cell, k)) != end) continue;
        cell.insert(cell.begin() + static_cast<std::ptrdiff_t>(k) + 1, { vertex, cell[k].beyond });
        return;
    }
}

/// Find the shared stretches along the edge between two grains. Every end of a stretch of the one
/// becomes a vertex of the other.
void join_across(Builder& b, const SharedEdge& e)
{
    const int ka = edge_from(b, e.cell_a, e.vertex_0), kb = edge_from(b, e.cell_b, e.vertex_1);
    merge_across(b, stretches_of(b, e.cell_a, ka), stretches_of(b, e.cell_b, kb));
    const auto along_a = stretches_of(b, e.cell_a, ka);
    auto along_b = stretches_of(b, e.cell_b, kb);
    std::reverse(along_b.begin(), along_b.end());
    for (Stretch& s : along_b)
        std::swap(s.start, s.end);
    const int origin = e.vertex_0;
    const auto place = [&](int vertex) { return b.vertices.distance(origin, vertex); };
    std::size_t i = 0, j = 0;
    int from = along_a.empty() || along_b.empty() ? -1 : along_a[0].start;
    int last_a = from, last_b = from;
    while (i < along_a.size() && j < along_b.size()) {
        const Stretch &s = along_a[i], &t = along_b[j];
        const bool both = s.end == t.end, first = both || place(s.end) < place(t.end);
        const int to = first ? s.end : t.end;
        b.shared[{ s.cell, t.cell }] = { from, to };
        if (!both && first) insert_after(b.cells[t.cell], b, t.end, last_b, to);
        if (!both && !first) insert_after(b.cells[s.cell], b, last_a, s.end, to);
        last_a = last_b = from = to;
        i += both || first;
        j += both || !first;
    }
}

void share_inside(Builder& b)
{
    for (int i = 0; i < static_cast<int>(b.cells.size()); ++i) {
        for (std::size_t k = 0; k < b.cells[i].size(); ++k) {
            const Beyond beyond = b.cells[i][k].beyond;
            const int start = b.vertices.find(b.cells[i][k].vertex);
            const int end = b.vertices.find(next_of(b.cells[i], k));
            if (!beyond.is_seed() || beyond.index <= i || start == end) continue;
            b.shared[{ i, beyond.index }] = { start, end };
        }
    }
}

/// Sides of the outline by grain and edge.
void list_outline(const Builder& b, Tessellation& t)
{
    for (const BoundaryEdge& e : b.grains.boundary_edges) {
        const int k = edge_from(b, e.cell, e.vertex_0);
        for (const Stretch& s : stretches_of(b, e.cell, k)) {
            t.boundary_edges.push_back({ s.cell, s.start, s.end, e.side });
        }
    }
    std::stable_sort(t.boundary_edges.begin(), t.boundary_edges.end(),
        [](const BoundaryEdge& p, const BoundaryEdge& q) { return p.cell < q.cell; });
}

InnerCells finish(Builder& b)
{
    InnerCells result;
    Tessellation& t = result.cells;
    list_outline(b, t);
    for (const auto& [cells, ends] : b.shared) {
        t.shared_edges.push_back({ cells.first, cells.second, ends.first, ends.second });
        result.outer.push_back(b.grain[cells.first] != b.grain[cells.second]);
    }
    t.uncollapsed_shared_edges = static_cast<int>(t.shared_edges.size());
    std::map<int, int> numbers;  // vertices in use
    const auto number = [&](int vertex) {
        const auto [entry, fresh] =
            numbers.try_emplace(b.vertices.find(vertex), static_cast<int>(t.vertices.size()));
        if (fresh) t.vertices.push_back(b.vertices.place(vertex));
        return entry->second;
    };
    t.cell_offsets.assign(1, 0);
    for (const auto& cell : b.cells) {
        for (std::size_t k = 0; k < cell.size(); ++k) {
            if (b.vertices.find(cell[k].vertex) == b.vertices.find(next_of(cell, k))) continue;
            t.cell_vertices.push_back(number(cell[k].vertex));
        }
        t.cell_offsets.push_back(static_cast<int>(t.cell_vertices.size()));
    }
    for (SharedEdge& e : t.shared_edges) {
        e.vertex_0 = number(e.vertex_0);
        e.vertex_1 = number(e.vertex_1);
    }
    for (BoundaryEdge& e : t.boundary_edges) {
        e.vertex_0 = number(e.vertex_0);
        e.vertex_1 = number(e.vertex_1);
    }
    t.disc_of_cell.resize(b.cells.size());
    std::iota(t.disc_of_cell.begin(), t.disc_of_cell.end(), 0);
    result.discs = b.discs;
    result.grain = b.grain;
    return result;
}

}  // namespace

InnerCells make_inner_cells(const Tessellation& grains, double mean_count)
{
    check_finite("inner particles in a grain", mean_count, "");
    if (!(mean_count >= 1.0 && mean_count <= 1000.0)) {
        refuse("inner particles in a grain", mean_count, "", "must be 1 to 1000; correct it");
    }
    double area = 0.0;
    for (int g = 0; g < grains.cells(); ++g)
        area += cell_area(grains, g) / grains.cells();
    const double diameter = 2.0 * std::sqrt(area / mean_count / pi);
    Builder b { grains, merge_distance * diameter, {}, {}, {}, {}, {}, {}, {} };
    for (Point p : grains.vertices)
        b.vertices.add(p);
    for (int g = 0; g < grains.cells(); ++g) {
        b.first_cell.push_back(static_cast<int>(b.cells.size()));
        const double count = std::round(mean_count * cell_area(grains, g) / area);
        add_grain(b, g, std::max(1, static_cast<int>(count)));
    }
    b.first_cell.push_back(static_cast<int>(b.cells.size()));
    join_inside(b);
    share_inside(b);
    for (const SharedEdge& e : grains.shared_edges)
        join_across(b, e);
    return finish(b);
}

}  // namespace flexpm
