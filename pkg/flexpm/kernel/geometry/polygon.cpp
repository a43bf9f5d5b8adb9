// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sums over the triangles that a point makes with the edges of a polygon.
#include <flexpm/kernel/geometry/polygon.hpp>

namespace flexpm {

namespace {

/// Call visit(a, b, twice) for the triangle of `from` and each edge: the edge's ends relative to
/// `from` and twice the triangle's area.
template <class Visit>
void for_each_triangle(const std::vector<Point>& polygon, Point from, Visit visit)
{
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point a = polygon[k] - from, b = polygon[(k + 1) % polygon.size()] - from;
        visit(a, b, cross(a, b));
    }
}

}  // namespace

PolygonShape polygon_shape(const std::vector<Point>& polygon)
{
    PolygonShape shape;
    if (polygon.size() < 3) return shape;
    // about the first corner: a grain is small against its distance from the origin
    const Point origin = polygon[0];
    Point moment;
    for_each_triangle(polygon, origin, [&](Point a, Point b, double twice) {
        shape.area += 0.5 * twice;
        moment = moment + Point { twice * (a.x + b.x) / 6.0, twice * (a.y + b.y) / 6.0 };
    });
    shape.centroid = { origin.x + moment.x / shape.area, origin.y + moment.y / shape.area };
    return shape;
}

PolygonSection polygon_section(const std::vector<Point>& polygon, Point about)
{
    double area = 0.0, polar = 0.0;  // `polar` about the given point
    Point moment;
    for_each_triangle(polygon, about, [&](Point a, Point b, double twice) {
        area += 0.5 * twice;
        moment = moment + Point { twice * (a.x + b.x) / 6.0, twice * (a.y + b.y) / 6.0 };
        polar +=
            twice * (a.x * a.x + a.x * b.x + b.x * b.x + a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
    });
    return { area, polar - dot(moment, moment) / area };
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
