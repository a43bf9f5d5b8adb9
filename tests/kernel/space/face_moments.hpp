// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of a face against its moments, which are summed over triangles.
#pragma once

#include <flexpm/kernel/space/face_points.hpp>

#include "support/sphere_samples.hpp"

namespace flexpm_test {

/// Place of a point [m].
inline Vector point_of(const std::vector<Vector>& corners, const FacePoint& point)
{
    Vector sum;
    for (std::size_t k = 0; k < corners.size(); ++k)
        sum = sum + point.shares[k] * corners[k];
    return sum;
}

/// Corners from the first of them, on the plane through it that is normal to the area vector.
inline std::vector<Vector> projected(std::vector<Vector> corners)
{
    const Vector area = area_of(corners), normal = (1.0 / norm(area)) * area;
    const Vector first = corners[0];  // small faces far from the origin keep their digits
    for (Vector& c : corners)
        c = c - first - dot(c - first, normal) * normal;
    return corners;
}

/// Distance of a point from a plane polygon, 0 inside. A bent face may be concave when it is
/// projected.
inline double distance_outside(const std::vector<Vector>& corners, Vector normal, Vector p)
{
    double nearest = 1e300, turns = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vector a = corners[k] - p, b = corners[(k + 1) % corners.size()] - p, edge = b - a;
        const double share = std::clamp(-dot(a, edge) / dot(edge, edge), 0.0, 1.0);
        nearest = std::min(nearest, norm(a + share * edge));
        turns += std::atan2(triple(normal, a, b), dot(a, b)) / (2.0 * pi);
    }
    return turns > 0.5 ? 0.0 : nearest;
}

/// Weights are positive and points inside the projected face; they have its moments up to a degree:
/// 1e-12 of area times powers of its extent, about its first corner. Thin faces lose as many digits
/// as they are thin.
inline void require_exact(const std::vector<Vector>& bent, const FacePoints& found, int degree)
{
    const auto corners = projected(bent);
    double size = 0.0;
    for (const Vector& c : corners)
        size = std::max(size, norm(c - corners[0]));
    std::array<double, 10> sums {};  // of 1, x, y, z, xx, yy, zz, yz, xz, xy
    const auto add = [&](double area, Vector p) {
        const Vector q = (1.0 / size) * (p - corners[0]);
        const std::array<double, 10> terms = { 1.0, q.x, q.y, q.z, q.x * q.x, q.y * q.y, q.z * q.z,
            q.y * q.z, q.x * q.z, q.x * q.y };
        for (std::size_t k = 0; k < terms.size(); ++k)
            sums[k] += area / found.area * terms[k];
    };
    double least = 1.0, outside = 0.0;
    for (const FacePoint& point : found.points) {
        const Vector p = point_of(corners, point);
        add(point.area, p);
        least = std::min(least, point.area);
        outside = std::max(outside, distance_outside(corners, found.normal, p) / size);
    }
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vector a = corners[0], b = corners[k], c = corners[k + 1];
        const double area = 0.5 * triple(found.normal, b - a, c - a);
        for (Vector middle : { 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a) })
            add(-area / 3.0, middle);
    }
    double error = 0.0;
    for (int k = 0; k < (degree == 2 ? 10 : 4); ++k)
        error = std::max(error, std::abs(sums[k]));
    CAPTURE(error, outside, corners.size());
    REQUIRE(error < 1e-12 * std::max(1.0, 0.1 * size * size / found.area));
    REQUIRE(least > 0.0);
    REQUIRE(outside < 1e-9);
}

}  // namespace flexpm_test
