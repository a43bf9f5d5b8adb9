// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Geometry of a specimen's outline: inside test, and where a radical axis crosses it.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <vector>

namespace flexpm {

/// Region that the cells fill: a convex polygon, or a circle whose arcs become chords.
struct Outline {
    std::vector<Point> corners;  ///< counter-clockwise, strictly convex; empty for a circle
    Point centre;                ///< of the circle
    double radius = 0.0;         ///< of the circle

    bool is_circle() const { return corners.empty(); }
    int sides() const { return is_circle() ? 1 : static_cast<int>(corners.size()); }

    /// Convex polygon.
    /// @throws std::invalid_argument  unless finite, counter-clockwise and strictly convex
    static Outline polygon(std::vector<Point> corners);
    /// Circle.
    /// @throws std::invalid_argument  unless finite and radius > 0
    static Outline circle(Point centre, double radius);
};

/// Point of the outline and its place along it: side + fraction for a polygon, 0 for a circle.
struct OutlinePoint {
    Point point;
    double position = 0.0;
};

/// Part of a line inside the outline.
struct Chord {
    bool exists = false;  ///< false: the line misses the outline, the ends mean nothing
    OutlinePoint enter;
    OutlinePoint leave;
};

struct BoundingCircle {
    Point centre;
    double radius;
};

/// True for points inside or on the outline.
bool contains(const Outline& outline, Point p);

/// Distance from the outline, positive inside [m]; the nearest side's line for points outside.
double distance_inside(const Outline& outline, Point p);

/// A circle that holds the outline.
BoundingCircle bounding_circle(const Outline& outline);

/// Radical axis of two discs inside the outline, walked with disc a on the left.
Chord clip_radical_axis(const Outline& outline, const Disc& a, const Disc& b);

}  // namespace flexpm
