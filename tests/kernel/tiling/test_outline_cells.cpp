// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Reference points, clipped and given cells. Lengths in one unit.
#include "support/catch.hpp"

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/reference_point.hpp>
#include <flexpm/kernel/tiling/given_cells.hpp>
#include <flexpm/kernel/tiling/outline_cells.hpp>

#include <cmath>

using namespace flexpm;

namespace {

double total_area(const Tiling& tiling)
{
    double area = 0.0;
    for (int c = 0; c < tiling.cells.cells(); ++c)
        area += cell_area(tiling.cells, c);
    return area;
}

std::vector<Disc> random_discs(int count, double size)
{
    Random random(7);
    std::vector<Disc> discs;
    for (int i = 0; i < count; ++i) {
        const double x = random.next(), y = random.next();
        discs.push_back({ { size * x, size * y }, 0.5 * size / std::sqrt(count) });
    }
    return discs;
}

}  // namespace

TEST_CASE("The reference point of an L is where both arms are seen", "[tiling]")
{
    const std::vector<Point> l_shape { { 0, 0 }, { 4, 0 }, { 4, 1 }, { 1, 1 }, { 1, 4 }, { 0, 4 } };
    const auto kernel = star_kernel(l_shape);
    CHECK(polygon_shape(kernel).area == Approx(1.0));
    const auto found = reference_point(l_shape);
    REQUIRE(found);
    CHECK(found->x == Approx(0.5));
    CHECK(found->y == Approx(0.5));
    CHECK(clearance(l_shape, *found) == Approx(0.5));
    CHECK(clearance(l_shape, { 2.0, 2.0 }) == Approx(-1.0));
}

TEST_CASE("No point sees all of a U", "[tiling]")
{
    const std::vector<Point> u_shape { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 },
        { 1, 3 }, { 0, 3 } };
    CHECK_FALSE(reference_point(u_shape));
}

TEST_CASE("Cells in a star with a hole have its area and see their edges", "[tiling]")
{
    std::vector<Point> star, hole;
    for (int k = 0; k < 10; ++k) {
        const double angle = 0.2 * pi * k, size = k % 2 ? 4.0 : 9.0;
        star.push_back({ 10.0 + size * std::cos(angle), 10.0 + size * std::sin(angle) });
        hole.push_back({ 10.0 + 1.5 * std::cos(angle), 10.0 + 1.5 * std::sin(angle) });
    }
    const PolygonOutline outline = PolygonOutline::make(star, { hole });
    const Tiling tiling = cells_in_outline(random_discs(400, 20.0), outline, 0.1);
    CHECK(total_area(tiling) == Approx(outline.area()).epsilon(1e-12));
    CHECK(enclosed_area(tiling.cells) == Approx(outline.area()).epsilon(1e-12));
    for (int c = 0; c < tiling.cells.cells(); ++c) {
        const std::vector<Point> polygon = cell_polygon(tiling.cells, c);
        CHECK(is_star_shaped(polygon, tiling.discs[c].centre, 0.0));
    }
}

TEST_CASE("Given cells are joined where a corner lies on an edge", "[tiling]")
{
    const GivenCells given = cells_of_polygons(
        { { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 0, 1 } }, { { 0, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } },
            { { 1, 1 }, { 2, 1 }, { 2, 2 }, { 1, 2 } } },
        false);
    CHECK(given.tiling.cells.shared_edges.size() == 3);
    REQUIRE(given.rings.size() == 1);
    CHECK(given.rings[0].size() == 4);
    CHECK(total_area(given.tiling) == Approx(4.0));
    CHECK_THROWS_WITH(
        cells_of_polygons(
            { { { 0, 0 }, { 1, 0 }, { 1, 1 } }, { { 0.2, 0.1 }, { 2, 0.1 }, { 2, 1 } } }, false),
        Catch::Contains("overlap"));
}

TEST_CASE("Cells of a file are checked before they are used", "[tiling]")
{
    StoredCells stored;
    stored.vertices = { { 0, 0 }, { 1, 0 }, { 0, 1 } };
    stored.cells = { { 0, 1, 2 } };
    stored.discs = { { { 0.3, 0.3 }, 0.4 } };
    CHECK(cells_of_file(stored).cells.boundary_edges.size() == 3);
    stored.cells = { { 0, 1, 3 } };
    CHECK_THROWS_WITH(cells_of_file(stored), Catch::Contains("vertex = 3"));
    stored.cells = { { 0, 2, 1 } };
    CHECK_THROWS_WITH(cells_of_file(stored), Catch::Contains("clockwise"));
    stored.discs.clear();
    CHECK_THROWS_WITH(cells_of_file(stored), Catch::Contains("one for each of 1 cells"));
}
