// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Clipping of lines by circles and by convex polygons.
#include <flexpm/kernel/geometry/outline.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace flexpm {
namespace {

Chord clip_by_circle(const Outline& outline, Point on_axis, Point direction)
{
    const Point rel = on_axis - outline.centre;
    const double b = dot(rel, direction);
    const double distance = cross(direction, rel);
    const double half_squared = outline.radius * outline.radius - distance * distance;
    const double half = std::sqrt(std::max(half_squared, 0.0));
    const auto at = [&](double t) { return on_axis + t * direction; };
    return { half_squared > 0.0, { at(-b - half), 0.0 }, { at(-b + half), 0.0 } };
}

/// Intersection of the line with one side, exactly on the side's own line.
OutlinePoint on_side(const Outline& outline, int side, Point on_axis, Point direction)
{
    const int n = outline.sides();
    const Point c = outline.corners[side], e = outline.corners[(side + 1) % n] - c;
    double s = cross(on_axis - c, direction) / cross(e, direction);
    s = std::clamp(s, 0.0, 1.0);
    return { c + s * e, side + std::min(s, 1.0 - 1e-12) };
}

Chord clip_by_polygon(const Outline& outline, Point on_axis, Point direction)
{
    const int n = outline.sides();
    double t0 = -std::numeric_limits<double>::infinity(), t1 = -t0;
    int side0 = -1, side1 = -1;
    bool exists = true;
    for (int side = 0; side < n; ++side) {
        const Point c = outline.corners[side], e = outline.corners[(side + 1) % n] - c;
        const double slope = cross(e, direction), inside = cross(e, on_axis - c);
        if (slope == 0.0) {
            exists = exists && inside > 0.0;
            continue;
        }
        const double t = -inside / slope;
        if (slope > 0.0 && t > t0) t0 = t, side0 = side;
        if (slope < 0.0 && t < t1) t1 = t, side1 = side;
    }
    return { exists && t0 < t1, on_side(outline, side0, on_axis, direction),
        on_side(outline, side1, on_axis, direction) };
}

/// Size and place of an outline [m]: beyond them squares of lengths overflow, or coordinates lose
/// the digits in which cells differ.
constexpr double least_size = 1e-9, largest_size = 1e9, farthest = 1e6;

Outline with_checked_size(const Outline& outline)
{
    const BoundingCircle box = bounding_circle(outline);
    if (!(box.radius >= least_size && box.radius <= largest_size)) {
        refuse(
            "outline: radius around it", box.radius, "m", "must be 1e-9 to 1e9 m; check the units");
    }
    if (!(norm(box.centre) <= farthest * box.radius)) {
        refuse("outline: centre", place(box.centre),
            "must be within 1e6 times its size of the origin; move it there");
    }
    return outline;
}

}  // namespace

Outline Outline::polygon(std::vector<Point> corners)
{
    const std::size_t n = corners.size();
    if (n < 3)
        refuse("outline: corners", static_cast<double>(n), "", "must be >= 3; give a polygon");
    double turn = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const Point a = corners[k], b = corners[(k + 1) % n], c = corners[(k + 2) % n];
        const Point u = b - a, v = c - b;
        if (!is_finite(a) || !(cross(u, v) > 1e-12 * norm(u) * norm(v))) {
            refuse("outline: corner " + std::to_string((k + 1) % n), place(b),
                "must be finite and the corners counter-clockwise and strictly convex;"
                " reverse or correct the polygon");
        }
        turn += std::atan2(cross(u, v), dot(u, v));
    }
    if (turn > 7.0) {
        refuse("outline: rotation along the polygon", turn, "rad",
            "must be 2 pi; correct the order of its corners");
    }
    Outline outline;
    outline.corners = std::move(corners);
    return with_checked_size(outline);
}

Outline Outline::circle(Point centre, double radius)
{
    if (!is_finite(centre)) refuse("outline: centre", place(centre), "must be finite; correct it");
    if (!(std::isfinite(radius) && radius > 0.0)) {
        refuse("outline: radius", radius, "m", "must be finite and > 0; correct it");
    }
    Outline outline;
    outline.centre = centre;
    outline.radius = radius;
    return with_checked_size(outline);
}

bool contains(const Outline& outline, Point p)
{
    if (outline.is_circle()) {
        const Point d = p - outline.centre;
        return dot(d, d) <= outline.radius * outline.radius;
    }
    for (int side = 0; side < outline.sides(); ++side) {
        const Point c = outline.corners[side];
        if (cross(outline.corners[(side + 1) % outline.sides()] - c, p - c) < 0.0) return false;
    }
    return true;
}

double distance_inside(const Outline& outline, Point p)
{
    if (outline.is_circle()) return outline.radius - norm(p - outline.centre);
    double smallest = std::numeric_limits<double>::infinity();
    for (int side = 0; side < outline.sides(); ++side) {
        const Point c = outline.corners[side];
        const Point e = outline.corners[(side + 1) % outline.sides()] - c;
        smallest = std::min(smallest, cross(e, p - c) / norm(e));
    }
    return smallest;
}

BoundingCircle bounding_circle(const Outline& outline)
{
    if (outline.is_circle()) return { outline.centre, outline.radius };
    BoundingCircle box { { 0.0, 0.0 }, 0.0 };
    for (Point c : outline.corners) {
        box.centre.x += c.x / outline.sides();
        box.centre.y += c.y / outline.sides();
    }
    for (Point c : outline.corners)
        box.radius = std::max(box.radius, norm(c - box.centre));
    return box;
}

Chord clip_radical_axis(const Outline& outline, const Disc& a, const Disc& b)
{
    const Point d = b.centre - a.centre;
    const double length_squared = dot(d, d), length = std::sqrt(length_squared);
    const double from_a =
        0.5 * (1.0 + (a.radius * a.radius - b.radius * b.radius) / length_squared);
    const Point on_axis = a.centre + from_a * d;
    const Point direction { -d.y / length, d.x / length };
    return outline.is_circle() ? clip_by_circle(outline, on_axis, direction)
                               : clip_by_polygon(outline, on_axis, direction);
}

}  // namespace flexpm
