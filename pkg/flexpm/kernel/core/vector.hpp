// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points and vectors of the x-y plane, and discs. SI units everywhere; angles in radians.
#pragma once

#include <cmath>

namespace flexpm {

constexpr double pi = 3.14159265358979323846;

/// A point or vector of the plane [m].
struct Point {
    double x = 0.0;
    double y = 0.0;
};

constexpr Point operator+(Point a, Point b) { return { a.x + b.x, a.y + b.y }; }
constexpr Point operator-(Point a, Point b) { return { a.x - b.x, a.y - b.y }; }
constexpr Point operator*(double factor, Point a) { return { factor * a.x, factor * a.y }; }

constexpr double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// Component along z of the cross product: positive if b lies counter-clockwise of a.
constexpr double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

inline double norm(Point a) { return std::hypot(a.x, a.y); }

inline bool is_finite(Point a) { return std::isfinite(a.x) && std::isfinite(a.y); }

/// A disc of the packing: the seed of one grain.
struct Disc {
    Point centre;         ///< [m]
    double radius = 0.0;  ///< [m]
};

}  // namespace flexpm
