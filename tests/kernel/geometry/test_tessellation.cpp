// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Collapse of short edges, circular outlines, and what must not depend on order or units.
#include "support/disc_samples.hpp"

#include <algorithm>
#include <numeric>

using namespace flexpm_test;

namespace {

double length(const Tessellation& t, int u, int v)
{
    return std::hypot(t.vertices[u].x - t.vertices[v].x, t.vertices[u].y - t.vertices[v].y);
}

bool is_merged(const Tessellation& t, int v)
{
    return std::binary_search(t.merged_vertices.begin(), t.merged_vertices.end(), v);
}

/// Distance of a point from the radical axis of two discs.
double off_axis(Point p, const Disc& a, const Disc& b)
{
    const auto power = [&](const Disc& d) {
        return std::pow(p.x - d.centre.x, 2) + std::pow(p.y - d.centre.y, 2) - d.radius * d.radius;
    };
    const double apart = std::hypot(b.centre.x - a.centre.x, b.centre.y - a.centre.y);
    return std::abs(power(a) - power(b)) / (2.0 * apart);
}

std::vector<double> sorted_edge_lengths(const Tessellation& t)
{
    std::vector<double> lengths;
    for (const SharedEdge& e : t.shared_edges)
        lengths.push_back(length(t, e.vertex_0, e.vertex_1));
    std::sort(lengths.begin(), lengths.end());
    return lengths;
}

}  // namespace

TEST_CASE("short edges go, all others stay on their radical axis", "[tessellation]")
{
    const auto discs = random_discs(200, GENERATE(range(1, 7)));
    const double d = mean_diameter(discs), short_edge = 0.12 * d;
    const auto fine = tessellate(discs, rectangle(1.0, 1.0), { 0.0, true });
    const auto t = tessellate(discs, rectangle(1.0, 1.0), { short_edge, true });
    require_tiling(t, 1.0);
    REQUIRE(t.cells() == fine.cells());
    REQUIRE(t.uncollapsed_shared_edges == static_cast<int>(fine.shared_edges.size()));
    REQUIRE(t.shared_edges.size() < fine.shared_edges.size());
    int kept_short = 0;
    for (const SharedEdge& e : t.shared_edges) {
        kept_short += length(t, e.vertex_0, e.vertex_1) < short_edge;
        if (is_merged(t, e.vertex_0) || is_merged(t, e.vertex_1)) continue;
        const Disc& a = discs[t.disc_of_cell[e.cell_a]];
        const Disc& b = discs[t.disc_of_cell[e.cell_b]];
        REQUIRE(off_axis(t.vertices[e.vertex_0], a, b) < 1e-9 * d);
        REQUIRE(off_axis(t.vertices[e.vertex_1], a, b) < 1e-9 * d);
    }
    // kept only where a cell would have been spoiled; in random discs, with many small cells, a few
    REQUIRE(kept_short < 0.05 * static_cast<double>(t.shared_edges.size()));
}

TEST_CASE("the outline keeps its corners and its sides", "[tessellation]")
{
    const auto t = tessellate(random_discs(150, 5), rectangle(1.0, 1.0), { 0.03, true });
    std::vector<double> covered(4, 0.0);
    for (const BoundaryEdge& e : t.boundary_edges) {
        const Point a = t.vertices[e.vertex_0], b = t.vertices[e.vertex_1];
        const double level[4] = { a.y, a.x, a.y, a.x };
        const double other[4] = { b.y, b.x, b.y, b.x };
        const double wanted = e.side == 0 || e.side == 3 ? 0.0 : 1.0;
        REQUIRE(level[e.side] == wanted);
        REQUIRE(other[e.side] == wanted);
        covered[e.side] += length(t, e.vertex_0, e.vertex_1);
    }
    for (double side : covered)
        REQUIRE(side == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("a cell is never collapsed away", "[tessellation]")
{
    // a threshold above every edge: what is left must still be cells
    const auto discs = random_discs(60, 2);
    const auto t = tessellate(discs, rectangle(1.0, 1.0), { 10.0, true });
    require_tiling(t, 1.0);
    REQUIRE(t.cells() == tessellate(discs, rectangle(1.0, 1.0), { 0.0, true }).cells());
}

TEST_CASE("in a circle each boundary cell has one chord", "[tessellation]")
{
    const Point centre { 0.5, 0.5 };
    std::vector<Disc> discs;
    for (const Disc& d : random_discs(250, GENERATE(range(1, 5))))
        if (std::hypot(d.centre.x - 0.5, d.centre.y - 0.5) < 0.5) discs.push_back(d);
    const auto t = tessellate(discs, Outline::circle(centre, 0.5), { 0.005, true });
    std::set<int> cells;
    double area = 0.0, turn = 0.0;
    for (const BoundaryEdge& e : t.boundary_edges) {
        REQUIRE(cells.insert(e.cell).second);
        const Point a = t.vertices[e.vertex_0], b = t.vertices[e.vertex_1];
        REQUIRE(std::hypot(a.x - 0.5, a.y - 0.5) == Approx(0.5).epsilon(1e-12));
        area += 0.5 * orientation(centre, a, b);
        turn += std::atan2(
            orientation(centre, a, b), (a.x - 0.5) * (b.x - 0.5) + (a.y - 0.5) * (b.y - 0.5));
    }
    REQUIRE(turn == Approx(2.0 * 3.14159265358979323846).epsilon(1e-12));
    require_tiling(t, area);
}

TEST_CASE("the order of the discs does not matter", "[tessellation]")
{
    const auto discs = random_discs(150, 9);
    std::vector<int> order(discs.size());
    std::iota(order.begin(), order.end(), 0);
    Random random(1);
    for (std::size_t i = order.size() - 1; i > 0; --i)
        std::swap(order[i], order[static_cast<std::size_t>(random.next() * (i + 1))]);
    std::vector<Disc> shuffled;
    for (int i : order)
        shuffled.push_back(discs[i]);

    const TessellationOptions options { 0.1 * mean_diameter(discs), true };
    const auto t = tessellate(discs, rectangle(1.0, 1.0), options);
    const auto s = tessellate(shuffled, rectangle(1.0, 1.0), options);
    REQUIRE(s.cells() == t.cells());
    std::vector<double> area(discs.size(), 0.0);
    for (int c = 0; c < t.cells(); ++c)
        area[t.disc_of_cell[c]] = cell_area(t, c);
    for (int c = 0; c < s.cells(); ++c)
        REQUIRE(cell_area(s, c) == Approx(area[order[s.disc_of_cell[c]]]).epsilon(1e-10));
    const auto a = sorted_edge_lengths(t), b = sorted_edge_lengths(s);
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
        REQUIRE(a[k] == Approx(b[k]).epsilon(1e-9).margin(1e-12));
}

TEST_CASE("the unit of length does not matter", "[tessellation]")
{
    const auto discs = random_discs(150, 12);
    const double short_edge = 0.1 * mean_diameter(discs);
    const auto t = tessellate(discs, rectangle(1.0, 1.0), { short_edge, true });
    const double scale = GENERATE(0x1p-10, 1e-6, 1e4);
    auto scaled = discs;
    for (Disc& d : scaled)
        d = { { scale * d.centre.x, scale * d.centre.y }, scale * d.radius };
    const auto s = tessellate(scaled, rectangle(scale, scale), { scale * short_edge, true });
    REQUIRE(s.cell_vertices == t.cell_vertices);
    REQUIRE(s.merged_vertices == t.merged_vertices);
    for (std::size_t k = 0; k < t.vertices.size(); ++k) {
        REQUIRE(s.vertices[k].x == Approx(scale * t.vertices[k].x).margin(1e-10 * scale));
        REQUIRE(s.vertices[k].y == Approx(scale * t.vertices[k].y).margin(1e-10 * scale));
    }
}
