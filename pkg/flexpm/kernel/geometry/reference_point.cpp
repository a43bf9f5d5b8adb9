// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The visible part is cut out by the line of each edge in turn.
#include <flexpm/kernel/geometry/reference_point.hpp>

#include <flexpm/kernel/geometry/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

constexpr double ample =
    0.1;  ///< clearance of a centroid that needs no other point, in radii of equal area
constexpr double least = 0.02;  ///< clearance of a reference point

/// Part of a convex polygon on the left of the line through a and b.
std::vector<Point> left_part(const std::vector<Point>& convex, Point a, Point b)
{
    std::vector<Point> part;
    const auto height = [&](Point p) { return cross(b - a, p - a); };
    for (std::size_t k = 0; k < convex.size(); ++k) {
        const Point p = convex[k], q = convex[(k + 1) % convex.size()];
        const double hp = height(p), hq = height(q);
        if (hp >= 0.0) part.push_back(p);
        if ((hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0))
            part.push_back(p + (hp / (hp - hq)) * (q - p));
    }
    return part;
}

double equal_radius(double area) { return std::sqrt(std::max(area, 0.0) / pi); }

/// The better of the centroid and the centre of the kernel, and its clearance.
struct Seat {
    Point point;
    double clearance;
};

Seat best_seat(const std::vector<Point>& polygon, const PolygonShape& shape)
{
    Seat seat { shape.centroid, clearance(polygon, shape.centroid) };
    if (seat.clearance >= ample * equal_radius(shape.area)) return seat;
    const std::vector<Point> kernel = star_kernel(polygon);
    const PolygonShape inner = polygon_shape(kernel);
    if (!(inner.area > 0.0)) return seat;
    const double distance = clearance(polygon, inner.centroid);
    if (distance > seat.clearance) seat = { inner.centroid, distance };
    return seat;
}

}  // namespace

std::vector<Point> star_kernel(const std::vector<Point>& polygon)
{
    Point low = polygon.front(), high = low;
    for (Point p : polygon) {
        low = { std::min(low.x, p.x), std::min(low.y, p.y) };
        high = { std::max(high.x, p.x), std::max(high.y, p.y) };
    }
    std::vector<Point> kernel { low, { high.x, low.y }, high, { low.x, high.y } };
    for (std::size_t k = 0; k < polygon.size() && !kernel.empty(); ++k)
        kernel = left_part(kernel, polygon[k], polygon[(k + 1) % polygon.size()]);
    return kernel;
}

double clearance(const std::vector<Point>& polygon, Point p)
{
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point a = polygon[k], edge = polygon[(k + 1) % polygon.size()] - a;
        smallest = std::min(smallest, cross(edge, p - a) / norm(edge));
    }
    return smallest;
}

std::optional<Point> reference_point(const std::vector<Point>& polygon)
{
    const PolygonShape shape = polygon_shape(polygon);
    if (!(shape.area > 0.0)) return {};
    const Seat seat = best_seat(polygon, shape);
    if (!(seat.clearance >= least * equal_radius(shape.area))) return {};
    return seat.point;
}

Disc disc_of_area(const std::vector<Point>& polygon)
{
    const PolygonShape shape = polygon_shape(polygon);
    return { best_seat(polygon, shape).point, equal_radius(shape.area) };
}

}  // namespace flexpm
