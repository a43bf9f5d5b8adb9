// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sums over the triangles that a point makes with the edges of a polygon.
#include <flexpm/kernel/geometry/polygon.hpp>

namespace flexpm {

PolygonShape polygon_shape(const std::vector<Point>& polygon)
{
    // coordinates relative to the first corner: a grain is small against its distance from the origin.
    PolygonShape shape;
    if (polygon.size() < 3) return shape;
    const Point origin = polygon[0];
    Point moment;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const Point a = polygon[k] - origin, b = polygon[k + 1] - origin;
        const double twice = cross(a, b);
        shape.area += 0.5 * twice;
        moment.x += twice * (a.x + b.x) / 6.0;
        moment.y += twice * (a.y + b.y) / 6.0;
    }
    shape.centroid = { origin.x + moment.x / shape.area, origin.y + moment.y / shape.area };
    return shape;
}

bool is_star_shaped(const std::vector<Point>& polygon, Point from, double smallest)
{
    if (polygon.size() < 3) return false;
    double turn = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point a = polygon[k] - from, b = polygon[(k + 1) % polygon.size()] - from;
        const double twice = cross(a, b);
        if (!(0.5 * twice > smallest)) return false;
        turn += std::atan2(twice, dot(a, b));
    }
    return std::abs(turn - 2.0 * pi) < 1e-6;
}

}  // namespace flexpm
