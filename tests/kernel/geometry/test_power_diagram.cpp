// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laguerre cells against closed forms and the definition of the power diagram.
#include "support/disc_samples.hpp"

using namespace flexpm_test;

namespace {

double power(Point p, const Disc& d)
{
    return std::pow(p.x - d.centre.x, 2) + std::pow(p.y - d.centre.y, 2) - d.radius * d.radius;
}

/// Every vertex of a cell has the same power to its disc as to its neighbours, and no smaller one
/// to any other disc.
void require_power_diagram(const std::vector<Disc>& discs, const Tessellation& t)
{
    const double tolerance = 1e-9 * mean_diameter(discs) * mean_diameter(discs);
    for (int c = 0; c < t.cells(); ++c)
        for (Point p : cell_polygon(t, c)) {
            const double own = power(p, discs[t.disc_of_cell[c]]);
            for (const Disc& d : discs)
                REQUIRE(power(p, d) >= own - tolerance);
        }
}

}  // namespace

TEST_CASE("one disc owns the whole polygon", "[power_diagram]")
{
    const auto t = tessellate({ { { 1.0, 2.0 }, 0.3 } }, rectangle(3.0, 4.0), {});
    REQUIRE(t.cells() == 1);
    REQUIRE(t.boundary_edges.size() == 4);
    REQUIRE(cell_area(t, 0) == 12.0);
    for (int side = 0; side < 4; ++side)
        REQUIRE(t.boundary_edges[side].side == side);
}

TEST_CASE("two discs are parted by their radical axis", "[power_diagram]")
{
    // x = 1 + (2 + (0.5^2 - 0.3^2) / 2) / 2 for centres at x = 1 and 3
    const std::vector<Disc> discs { { { 1.0, 1.0 }, 0.5 }, { { 3.0, 1.0 }, 0.3 } };
    const auto t = tessellate(discs, rectangle(4.0, 2.0), {});
    const double x = 1.0 + 0.5 * (2.0 + 0.5 * (0.25 - 0.09));
    REQUIRE(t.shared_edges.size() == 1);
    const SharedEdge e = t.shared_edges[0];
    REQUIRE(t.vertices[e.vertex_0].x == Approx(x).epsilon(1e-15));
    REQUIRE(t.vertices[e.vertex_0].y == 0.0);
    REQUIRE(t.vertices[e.vertex_1].x == Approx(x).epsilon(1e-15));
    REQUIRE(t.vertices[e.vertex_1].y == 2.0);
    REQUIRE(cell_area(t, 0) == Approx(2.0 * x).epsilon(1e-14));
}

TEST_CASE("three discs meet in their radical centre", "[power_diagram]")
{
    const double h = std::sqrt(3.0);
    const std::vector<Disc> discs { { { 1.0, 1.0 }, 0.4 }, { { 3.0, 1.0 }, 0.4 },
        { { 2.0, 1.0 + h }, 0.4 } };
    const auto t = tessellate(discs, rectangle(4.0, 4.0), {});
    REQUIRE(t.shared_edges.size() == 3);
    int met = 0;
    for (Point p : t.vertices)
        met += std::hypot(p.x - 2.0, p.y - 1.0 - h / 3.0) < 1e-14;
    REQUIRE(met == 1);
    require_tiling(t, 16.0);
}

TEST_CASE("discs in a row give strips", "[power_diagram]")
{
    std::vector<Disc> discs;
    for (int i = 0; i < 5; ++i)
        discs.push_back({ { i + 0.5, 0.5 }, 0.5 });
    const auto t = tessellate(discs, rectangle(5.0, 1.0), {});
    REQUIRE(t.shared_edges.size() == 4);
    for (int c = 0; c < 5; ++c)
        REQUIRE(cell_area(t, c) == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("a board of discs gives squares, though four cells meet in each point", "[power_diagram]")
{
    const double size = GENERATE(1.0, 3e-3, 0.1);
    const auto t = tessellate(square_grid(7, 5, size), rectangle(7 * size, 5 * size), {});
    REQUIRE(t.cells() == 35);
    REQUIRE(t.vertices.size() == 8 * 6);
    REQUIRE(t.shared_edges.size() == 6 * 5 + 7 * 4);
    REQUIRE(t.boundary_edges.size() == 24);
    REQUIRE(t.merged_vertices.empty());
    REQUIRE(t.uncollapsed_shared_edges == 58);
    for (int c = 0; c < t.cells(); ++c) {
        REQUIRE(t.vertices_of(c) == 4);
        REQUIRE(cell_area(t, c) == Approx(size * size).epsilon(1e-12));
    }
    require_tiling(t, 35.0 * size * size);
}

TEST_CASE("random discs satisfy the definition and tile the outline", "[power_diagram]")
{
    const auto seed = GENERATE(range(1, 9));
    const auto discs = random_discs(120, seed);
    const auto t = tessellate(discs, rectangle(1.0, 1.0), { 0.0, true });
    require_tiling(t, 1.0);
    require_power_diagram(discs, t);
}

TEST_CASE("cells are clipped by sloping sides", "[power_diagram]")
{
    const Outline hexagon = Outline::polygon(
        { { -0.2, 0.3 }, { 0.4, -0.6 }, { 1.3, -0.3 }, { 1.5, 0.8 }, { 0.7, 1.6 }, { -0.3, 1.2 } });
    double area = 0.0;
    for (int k = 0; k < 6; ++k) {
        const Point a = hexagon.corners[k], b = hexagon.corners[(k + 1) % 6];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    const auto discs = random_discs(80, 4);
    const auto t = tessellate(discs, hexagon, { 0.0, true });
    require_tiling(t, area);
    require_power_diagram(discs, t);
}

TEST_CASE("edges that run into corners of the outline lose no corner", "[power_diagram]")
{
    // the radical axes are the diagonals of the square
    const std::vector<Disc> discs { { { 1.0, 0.5 }, 0.3 }, { { 1.5, 1.0 }, 0.3 },
        { { 1.0, 1.5 }, 0.3 }, { { 0.5, 1.0 }, 0.3 } };
    const auto t = tessellate(discs, rectangle(2.0, 2.0), {});
    require_tiling(t, 4.0);
    REQUIRE(t.vertices.size() == 5);
    for (int c = 0; c < 4; ++c)
        REQUIRE(t.vertices_of(c) == 3);
}

TEST_CASE("far offsets keep the cells", "[power_diagram]")
{
    auto discs = random_discs(60, 3);
    const auto near = tessellate(discs, rectangle(1.0, 1.0), { 0.0, true });
    for (Disc& d : discs)
        d.centre = { d.centre.x + 1024.0, d.centre.y - 512.0 };
    const auto far = tessellate(discs,
        Outline::polygon(
            { { 1024.0, -512.0 }, { 1025.0, -512.0 }, { 1025.0, -511.0 }, { 1024.0, -511.0 } }),
        { 0.0, true });
    REQUIRE(far.cell_offsets == near.cell_offsets);
    for (int c = 0; c < near.cells(); ++c)
        REQUIRE(cell_area(far, c) == Approx(cell_area(near, c)).epsilon(1e-8));
}

TEST_CASE("discs without a cell are named, or dropped and listed", "[power_diagram]")
{
    const std::vector<Disc> discs { { { 1.0, 1.0 }, 1.0 }, { { 2.0, 2.0 }, 0.5 },
        { { 2.0, 2.0 }, 1.0 }, { { 2.05, 2.0 }, 0.1 } };
    REQUIRE_THROWS_WITH(
        tessellate(discs, rectangle(3.0, 3.0), {}), Catch::Contains("hidden discs = 2 (1, 3)"));
    const auto t = tessellate(discs, rectangle(3.0, 3.0), { 0.0, true });
    REQUIRE(t.hidden_discs == std::vector<int> { 1, 3 });
    REQUIRE(t.disc_of_cell == std::vector<int> { 0, 2 });
    require_tiling(t, 9.0);
}

TEST_CASE("wrong discs and outlines are refused", "[power_diagram]")
{
    const Outline box = rectangle(1.0, 1.0);
    REQUIRE_THROWS_AS(tessellate({}, box, {}), std::invalid_argument);
    REQUIRE_THROWS_WITH(tessellate({ { { 0.5, 0.5 }, 0.1 }, { { 1.5, 0.5 }, 0.1 } }, box, {}),
        Catch::Contains("disc 1") && Catch::Contains("inside the outline"));
    REQUIRE_THROWS_AS(tessellate({ { { NAN, 0.5 }, 0.1 } }, box, {}), std::invalid_argument);
    REQUIRE_THROWS_AS(tessellate({ { { 0.5, 0.5 }, 0.0 } }, box, {}), std::invalid_argument);
    REQUIRE_THROWS_AS(
        tessellate({ { { 0.5, 0.5 }, 0.1 } }, box, { -1.0, false }), std::invalid_argument);
    REQUIRE_THROWS_AS(Outline::polygon({ { 0, 0 }, { 0, 1 }, { 1, 0 } }), std::invalid_argument);
    REQUIRE_THROWS_AS(Outline::polygon({ { 0, 0 }, { 1, 0 } }), std::invalid_argument);
    REQUIRE_THROWS_AS(
        Outline::polygon({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 1, 1 } }), std::invalid_argument);
    REQUIRE_THROWS_AS(Outline::circle({ 0, 0 }, -1.0), std::invalid_argument);
    REQUIRE_THROWS_AS(tessellate({ { { 0.0, 0.0 }, 0.1 } }, Outline::circle({ 0, 0 }, 1.0), {}),
        std::invalid_argument);
    // one disc holds the whole circle and hides the other
    REQUIRE_THROWS_WITH(tessellate({ { { 0.0, 0.0 }, 9.0 }, { { 0.5, 0.0 }, 0.1 } },
                            Outline::circle({ 0, 0 }, 1.0), { 0.0, true }),
        Catch::Contains("must be enough to span an area"));
    REQUIRE_THROWS_WITH(
        Outline::circle({ 0, 0 }, 1e10), Catch::Contains("radius around it = 10000000000 m"));
    REQUIRE_THROWS_WITH(Outline::polygon({ { 0, 0 }, { 1e-10, 0 }, { 0, 1e-10 } }),
        Catch::Contains("check the units"));
    REQUIRE_THROWS_WITH(Outline::circle({ 2e6, 0 }, 1.0), Catch::Contains("of the origin"));
    for (double radius : { 1e3, 1e-10 }) {
        REQUIRE_THROWS_WITH(tessellate({ { { 0.5, 0.5 }, radius } }, box, {}),
            Catch::Contains("must be 1e-9 to 1000 times"));
    }
}

TEST_CASE("discs in one place to round-off count as one", "[power_diagram]")
{
    const double apart = GENERATE(0.0, 1e-18, 1e-12, 1e-8);
    const std::vector<Disc> discs { { { 0.5, 0.5 }, 0.05 }, { { 0.5, 0.75 }, 0.05 },
        { { 0.75, 0.02390625 + apart }, 0.05 }, { { 0.75, 0.02390625 }, 0.05000000000000001 } };
    const auto t = tessellate(discs, rectangle(1.0, 1.0), { 0.0, true });
    REQUIRE(t.hidden_discs == std::vector<int> { 2 });
    require_tiling(t, 1.0);
}
