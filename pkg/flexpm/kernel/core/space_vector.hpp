// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Vectors of space, and spheres. SI units everywhere.
#pragma once

#include <flexpm/kernel/core/require.hpp>

#include <cmath>
#include <string>

namespace flexpm {

/// A point or vector of space [m].
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

/// Volume spanned by three vectors: positive if they are right-handed.
constexpr double triple(Vector a, Vector b, Vector c) { return dot(a, cross(b, c)); }

inline double norm(Vector a) { return std::sqrt(dot(a, a)); }

inline bool is_finite(Vector a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A place in an error message, with its unit.
inline std::string place(Vector p)
{
    return "(" + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + ") m";
}

/// A sphere of the packing: the seed of one grain.
struct Sphere {
    Vector centre;        ///< [m]
    double radius = 0.0;  ///< [m]
};

}  // namespace flexpm
