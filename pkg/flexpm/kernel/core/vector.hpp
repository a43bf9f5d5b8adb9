// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points and vectors of the x-y plane and of space, and discs. SI units everywhere; angles
/// in radians.
#pragma once

#include <cmath>

namespace flexpm {

constexpr double pi = 3.14159265358979323846;

/// A point or vector of space, or of the plane where code serves both: its third component is then
/// 0, and of what turns the first two are [m].
struct Vector {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

constexpr Vector operator+(Vector a, Vector b) { return { a.x + b.x, a.y + b.y, a.z + b.z }; }
constexpr Vector operator-(Vector a, Vector b) { return { a.x - b.x, a.y - b.y, a.z - b.z }; }
constexpr Vector operator-(Vector a) { return { -a.x, -a.y, -a.z }; }
constexpr Vector operator*(double factor, Vector a)
{
    return { factor * a.x, factor * a.y, factor * a.z };
}

constexpr double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

constexpr Vector cross(Vector a, Vector b)
{
    return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/// Length; that of a Point, by hypot, may differ in the last digit.
inline double norm(Vector a) { return std::sqrt(dot(a, a)); }

inline bool is_finite(Vector a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A point or vector of the plane [m]; a Vector wherever one is asked for.
struct Point {
    double x = 0.0;
    double y = 0.0;

    constexpr operator Vector() const { return { x, y, 0.0 }; }
};

/// A vector of the plane that is held as one of space.
constexpr Point in_plane(Vector a) { return { a.x, a.y }; }

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
