// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Area and centroid of polygons, and the points that see all of one.
#include <flexpm/kernel/geometry/polygon.hpp>

#include "support/catch.hpp"

using namespace flexpm;

namespace {

const std::vector<Point> l_shape { { 0.0, 0.0 }, { 3.0, 0.0 }, { 3.0, 1.0 }, { 1.0, 1.0 },
    { 1.0, 2.0 }, { 0.0, 2.0 } };

std::vector<Point> shifted(std::vector<Point> polygon, Point by)
{
    for (Point& p : polygon)
        p = p + by;
    return polygon;
}

}  // namespace

TEST_CASE("area and centroid of an L are those of its two rectangles", "[polygon]")
{
    // 3 x 1 about (1.5, 0.5) and 1 x 1 about (0.5, 1.5)
    const PolygonShape shape = polygon_shape(l_shape);
    CHECK(shape.area == Approx(4.0).epsilon(1e-15));
    CHECK(shape.centroid.x == Approx(1.25).epsilon(1e-15));
    CHECK(shape.centroid.y == Approx(0.75).epsilon(1e-15));
}

TEST_CASE("a clockwise polygon has a negative area and the same centroid", "[polygon]")
{
    const PolygonShape shape = polygon_shape({ l_shape.rbegin(), l_shape.rend() });
    CHECK(shape.area == Approx(-4.0).epsilon(1e-15));
    CHECK(shape.centroid.x == Approx(1.25).epsilon(1e-14));
}

TEST_CASE("a polygon far from the origin keeps the digits of its shape", "[polygon]")
{
    // sums about the origin would lose twelve digits
    const PolygonShape shape = polygon_shape(shifted(l_shape, { 1048576.0, -1048576.0 }));
    CHECK(shape.area == Approx(4.0).epsilon(1e-15));
    CHECK(shape.centroid.x - 1048576.0 == Approx(1.25).epsilon(1e-9));
}

TEST_CASE("the section of a rectangle is that of textbooks, about any point", "[polygon]")
{
    const double b = 3.0, h = 2.0;
    const std::vector<Point> rectangle { { 0.0, 0.0 }, { b, 0.0 }, { b, h }, { 0.0, h } };
    for (const Point about : { Point { 1.5, 1.0 }, Point { 0.2, 1.9 }, Point { -4.0, 7.0 } }) {
        const PolygonSection section = polygon_section(rectangle, about);
        CHECK(section.area == Approx(b * h).epsilon(1e-14));
        CHECK(section.polar == Approx(b * h * (b * b + h * h) / 12.0).epsilon(1e-12));
    }
}

TEST_CASE("two corners have no area", "[polygon]")
{
    CHECK(polygon_shape({ { 0.0, 0.0 }, { 1.0, 0.0 } }).area == 0.0);
    CHECK_FALSE(is_star_shaped({ { 0.0, 0.0 }, { 1.0, 0.0 } }, { 0.5, 0.0 }, 0.0));
}

TEST_CASE("a point sees all edges of an L only from its inner square", "[polygon]")
{
    CHECK(is_star_shaped(l_shape, { 0.5, 0.5 }, 0.0));
    CHECK_FALSE(is_star_shaped(l_shape, { 2.0, 0.5 }, 0.0));  // the upper arm is hidden
    CHECK_FALSE(is_star_shaped(l_shape, { 4.0, 0.5 }, 0.0));  // outside
    // the smallest triangle stands on the short inner edge, 0.5 away
    CHECK(is_star_shaped(l_shape, { 0.5, 0.5 }, 0.24));
    CHECK_FALSE(is_star_shaped(l_shape, { 0.5, 0.5 }, 0.26));
}

TEST_CASE("a polygon that winds twice is not star-shaped", "[polygon]")
{
    std::vector<Point> star;
    for (int k = 0; k < 5; ++k)
        star.push_back({ std::cos(0.8 * pi * k), std::sin(0.8 * pi * k) });
    CHECK_FALSE(is_star_shaped(star, { 0.0, 0.0 }, 0.0));
}
