// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rotations of space as unit quaternions: what turns a rigid grain that is no disc.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <cmath>

namespace flexpm {

/// Rotation: w is the cosine of half the angle, v the sine of it times the axis.
struct Quaternion {
    double w = 1.0;
    Vector v;
};

/// Rotation by `b`, then by `a`.
constexpr Quaternion operator*(const Quaternion& a, const Quaternion& b)
{
    return { a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v) };
}

/// The rotation back.
constexpr Quaternion inverse(const Quaternion& q) { return { q.w, -q.v }; }

/// What a rotation adds to a vector: without loss of digits for a small angle.
constexpr Vector turned_by(const Quaternion& q, Vector r)
{
    const Vector across = 2.0 * cross(q.v, r);
    return q.w * across + cross(q.v, across);
}

constexpr Vector turned(const Quaternion& q, Vector r) { return r + turned_by(q, r); }

/// Rotation by a vector: its direction is the axis, its length the angle [rad].
inline Quaternion rotation_by(Vector angle)
{
    const double half = 0.5 * norm(angle);
    // sin x / x is 1 to the last digit below that angle
    const double ratio = half > 1e-9 ? std::sin(half) / half : 1.0;
    return { std::cos(half), (0.5 * ratio) * angle };
}

/// Rotation by a vector, which is small in most cases, but for its length.
inline Quaternion scaled_rotation_by(Vector angle)
{
    const double squared = 0.25 * dot(angle, angle);
    if (squared > 1e-4) return rotation_by(angle);
    // tan x / x by its series, to the last digit up to there
    const double ratio =
        1.0 + squared * (1.0 / 3.0 + squared * (2.0 / 15.0 + squared * (17.0 / 315.0)));
    return { 1.0, (0.5 * ratio) * angle };
}

/// The same rotation with a length of 1.
inline Quaternion normalized(const Quaternion& q)
{
    const double factor = 1.0 / std::sqrt(q.w * q.w + dot(q.v, q.v));
    return { factor * q.w, factor * q.v };
}

}  // namespace flexpm
