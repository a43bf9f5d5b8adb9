// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Deviation D34: how near corners become one. What covers a place twice or not at all shows
/// in the boundary: cells run counter-clockwise, so a boundary of one ring, with rings inside it
/// for holes, encloses each place once.
#include <flexpm/kernel/tiling/given_cells.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/tiling/clipping.hpp>
#include <flexpm/kernel/tiling/shape_repair.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string>

namespace flexpm {

namespace {

using Ring = std::vector<Point>;

constexpr double snap = 1e-6;      ///< of the mean diameter: corners as near are one
constexpr double straight = 1e-4;  ///< turn of a boundary that is no corner [rad]
constexpr double largest = 1e9;    ///< beyond, squares of lengths lose their digits [m]

std::string name_of(std::size_t polygon) { return "polygon " + std::to_string(polygon); }

void check_polygon(const Ring& ring, std::size_t number)
{
    if (ring.size() < 3) {
        refuse(name_of(number) + ": corners", static_cast<double>(ring.size()), "",
            "must be >= 3; complete or remove it");
    }
    for (Point p : ring) {
        if (!is_finite(p) || norm(p) > largest)
            refuse(name_of(number) + ": corner", place(p),
                "must be finite and within 1e9 m of the origin; correct it");
    }
    const SidePair crossing = crossing_sides({ ring });
    if (crossing.first >= 0) {
        refuse(name_of(number) + ": side " + std::to_string(crossing.second) + " from",
            place(ring[crossing.second]),
            "must not cross or touch side " + std::to_string(crossing.first)
                + "; correct the order of its corners");
    }
}

/// Each edge has one cell on its left.
void check_edges(const PlanarCells& cells)
{
    std::map<VertexPair, std::size_t> owner;
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        const Loop& loop = cells.cells[c];
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int u = loop[k], v = loop[(k + 1) % loop.size()];
            const auto [at, added] = owner.try_emplace({ u, v }, c);
            if (!added) {
                refuse(name_of(c) + ": edge from", place(cells.vertices[u]),
                    "must not overlap " + name_of(at->second) + "; correct one of them");
            }
        }
    }
}

/// Cells from polygons with common vertices, divided where a corner of another cell lies on an
/// edge.
class Joiner {
public:
    Joiner(const std::vector<Ring>& given, double tolerance_) : tolerance(tolerance_)
    {
        snap_corners(given);
        divide_edges();
        check_edges(cells);
    }

    PlanarCells cells;

private:
    double tolerance;

    void snap_corners(const std::vector<Ring>& given)
    {
        struct Corner {
            Point p;
            std::size_t polygon, number;
        };
        std::vector<Corner> corners;
        std::vector<Loop> loops(given.size());
        for (std::size_t i = 0; i < given.size(); ++i) {
            loops[i].assign(given[i].size(), -1);
            for (std::size_t k = 0; k < given[i].size(); ++k)
                corners.push_back({ given[i][k], i, k });
        }
        std::stable_sort(corners.begin(), corners.end(),
            [](const Corner& a, const Corner& b) { return a.p.x < b.p.x; });
        for (std::size_t i = 0; i < corners.size(); ++i) {
            int& v = loops[corners[i].polygon][corners[i].number];
            for (std::size_t j = i;
                 j-- > 0 && v < 0 && corners[i].p.x - corners[j].p.x <= tolerance;) {
                const int u = loops[corners[j].polygon][corners[j].number];
                if (norm(cells.vertices[u] - corners[i].p) <= tolerance) v = u;
            }
            if (v >= 0) continue;
            v = static_cast<int>(cells.vertices.size());
            cells.vertices.push_back(corners[i].p);
        }
        for (std::size_t i = 0; i < loops.size(); ++i) {
            Loop loop;
            for (int v : loops[i])
                if (loop.empty() || loop.back() != v) loop.push_back(v);
            while (loop.size() > 1 && loop.back() == loop.front())
                loop.pop_back();
            const double area = loop.size() < 3 ? 0.0 : polygon_shape(polygon_of(cells, loop)).area;
            if (!(std::abs(area) > tolerance * tolerance)) {
                refuse(name_of(i) + ": area", area, "m^2",
                    "must be above zero once corners within " + number(tolerance)
                        + " m are merged; remove it");
            }
            if (area < 0.0) std::reverse(loop.begin(), loop.end());
            cells.add_cell(loop, static_cast<int>(i), false);
        }
    }

    /// Put into edges without a neighbour the vertices of others that lie on them.
    void divide_edges()
    {
        const EdgeOwners owners(cells.cells);
        std::vector<int> loose;
        const auto is_loose = [&](int u, int v) {
            return owners.left_of(v, u) == EdgeOwners::none;
        };
        for (const Loop& loop : cells.cells)
            for (std::size_t k = 0; k < loop.size(); ++k)
                if (is_loose(loop[k], loop[(k + 1) % loop.size()]))
                    loose.insert(loose.end(), { loop[k], loop[(k + 1) % loop.size()] });
        std::sort(loose.begin(), loose.end());
        loose.erase(std::unique(loose.begin(), loose.end()), loose.end());
        std::sort(loose.begin(), loose.end(),
            [&](int u, int v) { return cells.vertices[u].x < cells.vertices[v].x; });
        for (Loop& loop : cells.cells) {
            Loop divided;
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const int u = loop[k], v = loop[(k + 1) % loop.size()];
                divided.push_back(u);
                if (!is_loose(u, v)) continue;
                for (int w : on_edge(u, v, loose))
                    divided.push_back(w);
            }
            loop = divided;
        }
    }

    /// Vertices between the ends of an edge, in order along it; `among` goes from left to right.
    Loop on_edge(int u, int v, const std::vector<int>& among) const
    {
        const Point a = cells.vertices[u], e = cells.vertices[v] - a;
        const double length = norm(e), left = std::min(a.x, a.x + e.x) - tolerance,
                     right = std::max(a.x, a.x + e.x) + tolerance;
        std::vector<std::pair<double, int>> found;
        auto at = std::lower_bound(among.begin(), among.end(), left,
            [&](int w, double x) { return cells.vertices[w].x < x; });
        for (; at != among.end() && cells.vertices[*at].x <= right; ++at) {
            const Point to = cells.vertices[*at] - a;
            const double along = dot(to, e) / length;
            if (*at == u || *at == v || along <= 0.0 || along >= length
                || std::abs(cross(e, to)) > tolerance * length)
                continue;
            found.push_back({ along, *at });
        }
        std::sort(found.begin(), found.end());
        Loop order;
        for (const auto& entry : found)
            order.push_back(entry.second);
        return order;
    }
};

/// Boundary of cells as rings of vertices.
std::vector<Loop> boundary_rings(const PlanarCells& cells)
{
    const EdgeOwners owners(cells.cells);
    std::map<int, int> next;
    for (const Loop& loop : cells.cells) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int u = loop[k], v = loop[(k + 1) % loop.size()];
            if (owners.left_of(v, u) != EdgeOwners::none) continue;
            if (!next.emplace(u, v).second) {
                refuse("polygons: boundary at", place(cells.vertices[u]),
                    "must not meet itself; close the gap or part the overlap there");
            }
        }
    }
    std::vector<Loop> rings;
    while (!next.empty()) {
        Loop ring;
        for (auto at = next.begin(); at != next.end(); at = next.find(ring.back())) {
            if (ring.empty()) ring.push_back(at->first);
            ring.push_back(at->second);
            next.erase(at);
        }
        ring.pop_back();
        rings.push_back(ring);
    }
    return rings;
}

/// Name of a polygon that has an edge of a ring.
std::string name_at(const PlanarCells& cells, const Loop& ring)
{
    const int cell = EdgeOwners(cells.cells).left_of(ring[0], ring[1]);
    return name_of(static_cast<std::size_t>(cells.origin[cell]));
}

bool is_inside(const Ring& polygon, Point p)
{
    bool inside = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

/// The smallest cell around a ring of others, -1: none.
int holder_of(const PlanarCells& cells, const Loop& ring)
{
    int holder = -1;
    double least = 0.0;
    const Point p = cells.vertices[ring.front()];
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        const Loop& loop = cells.cells[c];
        if (std::find(loop.begin(), loop.end(), ring.front()) != loop.end()) continue;
        const Ring polygon = polygon_of(cells, loop);
        if (!is_inside(polygon, p)) continue;
        const double area = polygon_shape(polygon).area;
        if (holder < 0 || area < least) holder = static_cast<int>(c), least = area;
    }
    if (holder < 0) return holder;
    const Ring places = polygon_of(cells, ring), around = polygon_of(cells, cells.cells[holder]);
    const SidePair crossing = crossing_sides({ around, places });
    if (crossing.first >= 0) {
        refuse(name_at(cells, ring) + ": corner", place(p),
            "must not cross the sides of " + name_of(static_cast<std::size_t>(cells.origin[holder]))
                + " near " + place(around[crossing.first]) + "; correct one of them");
    }
    return holder;
}

/// Cells around a cell's holes in place of it.
void open_cell(PlanarCells& cells, int cell, std::vector<Loop> holes)
{
    std::vector<std::pair<Loop, std::vector<Loop>>> open { { cells.cells[cell],
        std::move(holes) } };
    bool first = true;
    while (!open.empty()) {
        auto [rim, inside] = std::move(open.back());
        open.pop_back();
        if (inside.empty()) {
            if (!first) {
                cells.add_cell(rim, cells.origin[cell], false);
                continue;
            }
            cells.cells[cell] = rim;
            first = false;
            continue;
        }
        std::vector<Loop> parts, others;
        for (std::size_t k = 0; k < inside.size() && parts.empty(); ++k) {
            others = inside;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
            parts = open_ring(cells.vertices, rim, inside[k], others);
        }
        if (parts.empty()) {
            refuse(name_of(static_cast<std::size_t>(cells.origin[cell])) + ": grain inside at",
                place(cells.vertices[inside.front().front()]),
                "must be seen from its corners; divide the polygon around it");
        }
        for (Loop& part : parts) {
            std::vector<Loop> its;
            const Ring polygon = polygon_of(cells, part);
            std::copy_if(others.begin(), others.end(), std::back_inserter(its),
                [&](const Loop& hole) { return is_inside(polygon, cells.vertices[hole.front()]); });
            open.push_back({ std::move(part), std::move(its) });
        }
    }
}

/// Join cells that lie inside of others to these. Deviation D62.
void join_islands(PlanarCells& cells, const std::vector<Loop>& rings)
{
    std::map<int, std::vector<Loop>> holes;
    for (const Loop& ring : rings) {
        if (!(polygon_shape(polygon_of(cells, ring)).area > 0.0)) continue;
        const int holder = holder_of(cells, ring);
        if (holder >= 0) holes[holder].emplace_back(ring.rbegin(), ring.rend());
    }
    for (auto& [cell, inside] : holes)
        open_cell(cells, cell, std::move(inside));
}

/// Corners of rings, which must not cross.
std::vector<Ring> places_of(const PlanarCells& cells, const std::vector<Loop>& rings)
{
    std::vector<Ring> places;
    for (const Loop& ring : rings)
        places.push_back(polygon_of(cells, ring));
    const SidePair crossing = crossing_sides(places);
    if (crossing.first >= 0) {
        std::size_t side = crossing.second, ring = 0;
        while (side >= places[ring].size())
            side -= places[ring++].size();
        refuse("polygons: boundary at", place(places[ring][side]),
            "must not cross itself; the polygons overlap there, correct them");
    }
    return places;
}

/// Check that the rings are one body: the outer ring comes first.
void check_rings(
    const PlanarCells& cells, std::vector<Loop>& rings, double least_hole, bool with_holes)
{
    const std::vector<Ring> places = places_of(cells, rings);
    std::vector<Loop> outer, holes;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const PolygonShape shape = polygon_shape(places[i]);
        (shape.area > 0.0 ? outer : holes).push_back(rings[i]);
        if (shape.area > 0.0 || (with_holes && -shape.area >= least_hole)) continue;
        refuse("polygons: gap at " + place(places[i].front()) + ", area", -shape.area, "m^2",
            with_holes ? "must be at least 2 % of a mean cell to be a hole; close it"
                       : "must be closed; move corners together, or allow holes");
    }
    if (outer.size() != 1) {
        refuse("polygons: connected parts", static_cast<double>(outer.size()), "",
            "must be 1; " + name_at(cells, outer[1]) + " at "
                + place(cells.vertices[outer[1].front()]) + " does not reach "
                + name_at(cells, outer[0]) + " at " + place(cells.vertices[outer[0].front()])
                + ": join them, or remove overlapping polygons");
    }
    rings = std::move(outer);
    rings.insert(rings.end(), holes.begin(), holes.end());
}

/// Corners of a ring; its edges get the number of their side, from `first` on.
Ring number_sides(PlanarCells& cells, const Loop& ring, int first)
{
    const int n = static_cast<int>(ring.size());
    const auto at = [&](int k) { return cells.vertices[ring[(k + n) % n]]; };
    std::vector<int> corners;
    for (int k = 0; k < n; ++k) {
        const Point in = at(k) - at(k - 1), out = at(k + 1) - at(k);
        if (std::abs(std::atan2(cross(in, out), dot(in, out))) > straight) corners.push_back(k);
    }
    const auto start = std::min_element(corners.begin(), corners.end(),
        [&](int k, int l) { return std::pair(at(k).y, at(k).x) < std::pair(at(l).y, at(l).x); });
    std::rotate(corners.begin(), start, corners.end());
    Ring places;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        places.push_back(at(corners[i]));
        const int end = corners[(i + 1) % corners.size()];
        for (int k = corners[i]; k != end; k = (k + 1) % n)
            cells.sides[undirected(ring[k], ring[(k + 1) % n])] = first + static_cast<int>(i);
    }
    return places;
}

}  // namespace

GivenCells cells_of_polygons(const std::vector<Ring>& polygons, bool with_holes)
{
    if (polygons.empty()) refuse("polygons", 0.0, "", "must be >= 1; give at least one cell");
    double area = 0.0;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        check_polygon(polygons[i], i);
        area += std::abs(polygon_shape(polygons[i]).area) / static_cast<double>(polygons.size());
    }
    PlanarCells cells = Joiner(polygons, snap * 2.0 * std::sqrt(area / pi)).cells;
    std::vector<Loop> rings = boundary_rings(cells);
    if (rings.size() > 1) {
        places_of(cells, rings);
        join_islands(cells, rings);
        rings = boundary_rings(cells);
    }
    check_rings(cells, rings, least_piece * area, with_holes);
    GivenCells given;
    int sides = 0;
    for (const Loop& ring : rings) {
        given.rings.push_back(number_sides(cells, ring, sides));
        sides += static_cast<int>(given.rings.back().size());
    }
    split_to_stars(cells);
    given.tiling = make_tiling(cells, {});
    return given;
}

Tiling cells_of_file(const StoredCells& stored)
{
    if (stored.cells.empty() || stored.discs.size() != stored.cells.size()) {
        refuse("discs of stored cells", static_cast<double>(stored.discs.size()), "",
            "must be one for each of " + std::to_string(stored.cells.size())
                + " cells, and at least one; save the specimen again");
    }
    if (!stored.laguerre.empty() && stored.laguerre.size() != stored.cells.size()) {
        refuse("laguerre of stored cells", static_cast<double>(stored.laguerre.size()), "",
            "must be one for each of " + std::to_string(stored.cells.size())
                + " cells; save the specimen again");
    }
    PlanarCells cells;
    cells.vertices = stored.vertices;
    cells.sides = stored.sides;
    cells.joints = stored.joints;
    for (std::size_t c = 0; c < stored.cells.size(); ++c) {
        for (int v : stored.cells[c]) {
            if (v >= 0 && v < static_cast<int>(stored.vertices.size())) continue;
            refuse("stored cell " + std::to_string(c) + ": vertex", v, "",
                "must be the number of one, from 0; save the specimen again");
        }
        check_polygon(polygon_of(cells, stored.cells[c]), c);
        if (!(polygon_shape(polygon_of(cells, stored.cells[c])).area > 0.0))
            refuse("stored cell " + std::to_string(c) + ": corners", "clockwise",
                "must run counter-clockwise; save the specimen again");
        cells.add_cell(stored.cells[c], static_cast<int>(c), true);
        if (!stored.laguerre.empty()) cells.laguerre[c] = stored.laguerre[c];
    }
    check_edges(cells);
    return make_tiling(cells, stored.discs);
}

}  // namespace flexpm
