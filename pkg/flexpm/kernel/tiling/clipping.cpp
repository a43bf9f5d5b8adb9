// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Boolean operations of CGAL on polygons with exact numbers: both neighbours find the same
/// crossing.
#include <flexpm/kernel/tiling/clipping.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/outline.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

namespace flexpm {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = Kernel::Point_2;
using ExactPolygon = CGAL::Polygon_2<Kernel>;
using ExactRegion = CGAL::Polygon_with_holes_2<Kernel>;
using Ring = std::vector<Point>;

ExactPolygon exact(const Ring& ring)
{
    ExactPolygon polygon;
    for (Point p : ring)
        polygon.push_back({ p.x, p.y });
    return polygon;
}

/// Nearest place in double precision; equal exact places give equal ones.
Point rounded(const ExactPoint& p)
{
    return { CGAL::to_double(p.x().exact()), CGAL::to_double(p.y().exact()) };
}

std::string name_of(std::size_t ring)
{
    return ring == 0 ? "polygon" : "hole " + std::to_string(ring - 1);
}

void check_ring(const Ring& ring, const std::string& name)
{
    const std::size_t n = ring.size();
    if (n < 3)
        refuse(name + ": corners", static_cast<double>(n), "", "must be >= 3; give a polygon");
    for (std::size_t k = 0; k < n; ++k) {
        if (!is_finite(ring[k]))
            refuse(name + ": corner " + std::to_string(k), place(ring[k]),
                "must be finite; correct it");
    }
    const SidePair crossing = crossing_sides({ ring });
    if (crossing.first >= 0) {
        refuse(name + ": side " + std::to_string(crossing.second) + " from",
            place(ring[crossing.second]),
            "must not cross or touch side " + std::to_string(crossing.first)
                + "; correct the order of the corners");
    }
    for (std::size_t k = 0; k < n; ++k) {
        const Point p = ring[k], u = ring[(k + 1) % n] - p, v = ring[(k + n - 1) % n] - p;
        const double angle = std::abs(std::atan2(cross(u, v), dot(u, v)));
        if (angle < least_angle) {
            refuse(name + ": angle at corner " + std::to_string(k), angle * 180.0 / pi, "degrees",
                "must be at least 5; remove the corner");
        }
    }
}

Ring turned(Ring ring, bool counter_clockwise)
{
    if ((polygon_shape(ring).area > 0.0) != counter_clockwise)
        std::reverse(ring.begin() + 1, ring.end());
    return ring;
}

struct Box {
    Point low, high;

    explicit Box(const Ring& ring) : low(ring.front()), high(ring.front())
    {
        for (Point p : ring) {
            low = { std::min(low.x, p.x), std::min(low.y, p.y) };
            high = { std::max(high.x, p.x), std::max(high.y, p.y) };
        }
    }
    bool meets(const Box& b) const
    {
        return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y;
    }
};

/// Cells under construction; a place has one vertex.
class Clipper {
public:
    Clipper(const Tessellation& t, const PolygonOutline& o) : tessellation(t), rings(o.rings())
    {
        region = ExactRegion(exact(o.corners));
        for (const Ring& hole : o.holes)
            region.add_hole(exact(hole));
        for (const Ring& ring : rings)
            for (std::size_t k = 0; k < ring.size(); ++k)
                sides.push_back({ ring[k], ring[(k + 1) % ring.size()] });
    }

    PlanarCells run()
    {
        for (int c = 0; c < tessellation.cells(); ++c) {
            const Ring polygon = cell_polygon(tessellation, c);
            const Box box(polygon);
            const bool meets = std::any_of(
                sides.begin(), sides.end(), [&](const Ring& side) { return box.meets(Box(side)); });
            if (meets)
                clip(c, polygon);
            else if (holds(polygon.front()))
                cells.add_cell(loop_of(polygon), c, true);
        }
        number_sides();
        return std::move(cells);
    }

private:
    const Tessellation& tessellation;
    std::vector<Ring> rings;
    std::vector<Ring> sides;  ///< two ends each
    ExactRegion region;
    PlanarCells cells;
    std::map<std::pair<double, double>, int> vertex_at;

    int vertex(Point p)
    {
        const auto [at, added] =
            vertex_at.try_emplace({ p.x, p.y }, static_cast<int>(cells.vertices.size()));
        if (added) cells.vertices.push_back(p);
        return at->second;
    }

    Loop loop_of(const Ring& ring)
    {
        Loop loop;
        for (Point p : ring) {
            const int v = vertex(p);
            if (loop.empty() || loop.back() != v) loop.push_back(v);
        }
        while (loop.size() > 1 && loop.back() == loop.front())
            loop.pop_back();
        return loop;
    }

    bool holds(Point p) const
    {
        const ExactPoint q(p.x, p.y);
        if (!region.outer_boundary().has_on_bounded_side(q)) return false;
        return std::none_of(region.holes_begin(), region.holes_end(),
            [&](const ExactPolygon& hole) { return !hole.has_on_unbounded_side(q); });
    }

    void clip(int cell, const Ring& polygon)
    {
        std::vector<ExactRegion> parts;
        CGAL::intersection(
            exact(polygon), region, std::back_inserter(parts), CGAL::Tag_false {});  // segments
        const double area = polygon_shape(polygon).area;
        for (const ExactRegion& part : parts) {
            const Loop rim = loop_of(rounded_ring(part.outer_boundary()));
            if (rim.size() < 3) continue;
            if (part.number_of_holes() == 0) {
                const bool whole = parts.size() == 1
                    && polygon_shape(polygon_of(cells, rim)).area >= (1.0 - 1e-9) * area;
                cells.add_cell(rim, cell, whole);
                continue;
            }
            if (part.number_of_holes() > 1) {
                refuse("polygon: holes inside the cell of one grain, at " + place(polygon.front()),
                    static_cast<double>(part.number_of_holes()), "",
                    "must be at most 1; choose smaller grains");
            }
            const Loop hole = loop_of(rounded_ring(*part.holes_begin()));
            const std::vector<Loop> around = open_ring(cells.vertices, rim, hole, {});
            if (around.empty()) {
                refuse("polygon: hole inside the cell of one grain, at",
                    place(cells.vertices[hole.front()]),
                    "must be seen from the cell's corners; choose smaller grains");
            }
            for (const Loop& one : around)
                cells.add_cell(one, cell, false);
        }
    }

    static Ring rounded_ring(const ExactPolygon& polygon)
    {
        Ring ring;
        for (const ExactPoint& p : polygon)
            ring.push_back(rounded(p));
        return ring;
    }

    /// Boundary edges lie on the side nearest to their middle.
    void number_sides()
    {
        const EdgeOwners owners(cells.cells);
        for (const Loop& loop : cells.cells) {
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const int u = loop[k], v = loop[(k + 1) % loop.size()];
                if (owners.left_of(v, u) != EdgeOwners::none) continue;
                cells.sides[undirected(u, v)] =
                    nearest_side(0.5 * (cells.vertices[u] + cells.vertices[v]));
            }
        }
    }

    int nearest_side(Point p) const
    {
        double best = std::numeric_limits<double>::infinity();
        int side = -1;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            const Point a = sides[k][0], e = sides[k][1] - a;
            const double share = std::clamp(dot(p - a, e) / dot(e, e), 0.0, 1.0);
            const double distance = norm(p - (a + share * e));
            if (distance < best) best = distance, side = static_cast<int>(k);
        }
        return side;
    }
};

/// Cuts from a hole to the rim around it.
class RingOpener {
public:
    RingOpener(const std::vector<Point>& v, const Loop& rim_, const Loop& hole_,
        const std::vector<Loop>& other_holes) :
        vertices(v),
        rim(rim_),
        hole(hole_),
        others(other_holes)
    {
    }

    /// Two cells between a hole and a rim, with cuts from two corners of the hole; none if these
    /// see no corners of the rim.
    std::vector<Loop> open(int left, int right) const
    {
        const int n = static_cast<int>(rim.size()), m = static_cast<int>(hole.size());
        double best = std::numeric_limits<double>::infinity();
        int to_left = -1, to_right = -1;
        const std::vector<bool> from_left = seen_from(left), from_right = seen_from(right);
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                if (i == j || !from_left[i] || !from_right[j]) continue;
                const double length = norm(vertices[hole[left]] - vertices[rim[i]])
                    + norm(vertices[hole[right]] - vertices[rim[j]]);
                if (length < best && !meet(hole[left], rim[i], hole[right], rim[j]))
                    best = length, to_left = i, to_right = j;
            }
        }
        if (to_left < 0) return {};
        const auto stretch = [](const Loop& loop, int from, int to, int size) {
            Loop part;
            for (int k = from;; k = (k + 1) % size) {
                part.push_back(loop[k]);
                if (k == to) return part;
            }
        };
        // below the hole: along the rim from the left cut to the right one, and back along the hole
        std::vector<Loop> parts;
        for (const auto& [from, to, back_from, back_to] :
            { std::array { to_left, to_right, right, left },
                std::array { to_right, to_left, left, right } }) {
            parts.push_back(stretch(rim, from, to, n));
            const Loop back = stretch(hole, back_from, back_to, m);
            parts.back().insert(parts.back().end(), back.begin(), back.end());
        }
        return parts;
    }

private:
    const std::vector<Point>& vertices;
    const Loop &rim, &hole;
    const std::vector<Loop>& others;

    /// Whether the segments between two pairs of vertices have a point in common.
    bool meet(int a, int b, int c, int d) const
    {
        const auto segment = [&](int u, int v) {
            const Point p = vertices[u], q = vertices[v];
            return Kernel::Segment_2({ p.x, p.y }, { q.x, q.y });
        };
        return CGAL::do_intersect(segment(a, b), segment(c, d));
    }

    /// Corners of the rim to which the segment from a corner of the hole meets nothing else.
    std::vector<bool> seen_from(int corner) const
    {
        std::vector<bool> seen;
        for (int to : rim)
            seen.push_back(is_clear(hole[corner], to));
        return seen;
    }

    bool is_clear(int from, int to) const
    {
        const Box box({ vertices[from], vertices[to] });
        const auto is_in_the_way = [&](const Loop& loop) {
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const int u = loop[k], v = loop[(k + 1) % loop.size()];
                if (u == from || v == from || u == to || v == to) continue;
                if (box.meets(Box({ vertices[u], vertices[v] })) && meet(from, to, u, v))
                    return true;
            }
            return false;
        };
        return !is_in_the_way(rim) && !is_in_the_way(hole)
            && std::none_of(others.begin(), others.end(), is_in_the_way);
    }
};

}  // namespace

std::vector<Loop> open_ring(const std::vector<Point>& vertices, const Loop& rim, const Loop& hole,
    const std::vector<Loop>& others)
{
    const RingOpener opener(vertices, rim, hole, others);
    const auto by_x = [&](int u, int v) { return vertices[u].x < vertices[v].x; };
    const int left =
        static_cast<int>(std::min_element(hole.begin(), hole.end(), by_x) - hole.begin());
    const int right =
        static_cast<int>(std::max_element(hole.begin(), hole.end(), by_x) - hole.begin());
    std::vector<Loop> parts = opener.open(left, right);
    // other holes may be in the way: any two corners, as far apart along the hole as can be
    const int m = static_cast<int>(hole.size());
    for (int apart = m / 2; apart > 0 && parts.empty() && !others.empty(); --apart)
        for (int k = 0; k < m && parts.empty(); ++k)
            parts = opener.open(k, (k + apart) % m);
    return parts;
}

SidePair crossing_sides(const std::vector<Ring>& rings)
{
    struct Side {
        Kernel::Segment_2 segment;
        Box box;
        int next;
    };
    std::vector<Side> sides;
    for (const Ring& ring : rings) {
        const int first = static_cast<int>(sides.size()), n = static_cast<int>(ring.size());
        for (int k = 0; k < n; ++k) {
            const Point p = ring[k], q = ring[(k + 1) % n];
            sides.push_back({ { { p.x, p.y }, { q.x, q.y } }, Box({ p, q }), first + (k + 1) % n });
        }
    }
    const int n = static_cast<int>(sides.size());
    for (int i = 0; i < n; ++i) {
        for (int j = i + 1; j < n; ++j) {
            if (!sides[i].box.meets(sides[j].box)) continue;
            const bool follows = sides[i].next == j, leads = sides[j].next == i;
            if (follows || leads) {
                // neighbours share one end and no more
                const auto& first = follows ? sides[i].segment : sides[j].segment;
                const auto& second = follows ? sides[j].segment : sides[i].segment;
                if (!first.has_on(second.target()) && !second.has_on(first.source())) continue;
            }
            if (CGAL::do_intersect(sides[i].segment, sides[j].segment)) return { i, j };
        }
    }
    return {};
}

PolygonOutline PolygonOutline::make(Ring corners, std::vector<Ring> holes)
{
    PolygonOutline outline;
    check_ring(corners, name_of(0));
    outline.corners = turned(std::move(corners), true);
    for (std::size_t h = 0; h < holes.size(); ++h) {
        check_ring(holes[h], name_of(h + 1));
        outline.holes.push_back(turned(std::move(holes[h]), false));
    }
    const std::vector<Ring> rings = outline.rings();
    for (std::size_t i = 0; i < rings.size(); ++i) {
        for (std::size_t j = i + 1; j < rings.size(); ++j) {
            const bool meets = crossing_sides({ rings[i], rings[j] }).first >= 0;
            const ExactPoint first(rings[j][0].x, rings[j][0].y),
                of_first(rings[i][0].x, rings[i][0].y);
            const bool inside = exact(rings[i]).has_on_bounded_side(first);
            if (!meets && i == 0 && inside) continue;
            if (!meets && i > 0 && !inside && !exact(rings[j]).has_on_bounded_side(of_first))
                continue;
            refuse(name_of(j) + ": corner 0", place(rings[j][0]),
                i == 0 ? "must lie inside the polygon with all of the hole; move the hole"
                       : "must lie outside " + name_of(i)
                        + " with all of the hole; move or join the holes");
        }
    }
    const Box box(outline.corners);
    Outline::polygon({ box.low, { box.high.x, box.low.y }, box.high,
        { box.low.x, box.high.y } });  // checks the size
    return outline;
}

std::vector<Ring> PolygonOutline::rings() const
{
    std::vector<Ring> all { corners };
    all.insert(all.end(), holes.begin(), holes.end());
    return all;
}

double PolygonOutline::area() const
{
    double sum = 0.0;
    for (const Ring& ring : rings())
        sum += polygon_shape(ring).area;
    return sum;
}

PlanarCells clip_cells(const Tessellation& tessellation, const PolygonOutline& outline)
{
    return Clipper(tessellation, outline).run();
}

}  // namespace flexpm
