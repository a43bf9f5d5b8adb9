// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Discs and checks shared by the tests of the geometry.
#pragma once

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/geometry/tessellation.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace flexpm_test {

using namespace flexpm;

inline Outline rectangle(double width, double height)
{
    return Outline::polygon({ { 0.0, 0.0 }, { width, 0.0 }, { width, height }, { 0.0, height } });
}

/// Centres of the unit squares of a columns x rows board.
inline std::vector<Disc> square_grid(int columns, int rows, double size = 1.0)
{
    std::vector<Disc> discs;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            discs.push_back({ { (i + 0.5) * size, (j + 0.5) * size }, 0.5 * size });
    return discs;
}

/// Discs at random in the unit square; some may be hidden.
inline std::vector<Disc> random_discs(int count, std::uint64_t seed)
{
    Random random(seed);
    const double radius = 0.5 / std::sqrt(count);
    std::vector<Disc> discs;
    for (int i = 0; i < count; ++i) {
        const double x = random.next(), y = random.next();
        discs.push_back({ { x, y }, radius * (0.7 + 0.6 * random.next()) });
    }
    return discs;
}

inline double mean_diameter(const std::vector<Disc>& discs)
{
    double sum = 0.0;
    for (const Disc& d : discs)
        sum += 2.0 * d.radius;
    return sum / static_cast<double>(discs.size());
}

inline double total_area(const Tessellation& t)
{
    double sum = 0.0;
    for (int c = 0; c < t.cells(); ++c)
        sum += cell_area(t, c);
    return sum;
}

inline double orientation(Point a, Point b, Point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// No two edges of the polygon that do not share a corner have a point in common.
inline bool is_simple(const std::vector<Point>& p)
{
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j + 1 == n) continue;
            const Point a = p[i], b = p[i + 1], c = p[j], d = p[(j + 1) % n];
            if (orientation(a, b, c) * orientation(a, b, d) <= 0.0
                && orientation(c, d, a) * orientation(c, d, b) <= 0.0)
                return false;
        }
    return true;
}

/// Cells are simple and of positive area, fill `area`, and fit together: each directed edge occurs
/// once, has its reverse in the neighbour unless it lies on the outline, and Euler's formula holds.
inline void require_tiling(const Tessellation& t, double area)
{
    REQUIRE(std::abs(total_area(t) / area - 1.0) < 1e-12);
    std::set<std::pair<int, int>> edges;
    for (int c = 0; c < t.cells(); ++c) {
        REQUIRE(t.vertices_of(c) >= 3);
        REQUIRE(cell_area(t, c) > 0.0);
        REQUIRE(is_simple(cell_polygon(t, c)));
        const int first = t.cell_offsets[c], n = t.vertices_of(c);
        for (int k = 0; k < n; ++k)
            REQUIRE(
                edges.insert({ t.cell_vertices[first + k], t.cell_vertices[first + (k + 1) % n] })
                    .second);
    }
    for (const SharedEdge& e : t.shared_edges) {
        REQUIRE(e.cell_a < e.cell_b);
        REQUIRE(edges.count({ e.vertex_0, e.vertex_1 }) == 1);
        REQUIRE(edges.count({ e.vertex_1, e.vertex_0 }) == 1);
    }
    for (const BoundaryEdge& e : t.boundary_edges)
        REQUIRE(edges.count({ e.vertex_1, e.vertex_0 }) == 0);
    REQUIRE(edges.size() == 2 * t.shared_edges.size() + t.boundary_edges.size());
    REQUIRE(
        t.vertices.size() + t.cells() + 1 == t.shared_edges.size() + t.boundary_edges.size() + 2);
}

}  // namespace flexpm_test
