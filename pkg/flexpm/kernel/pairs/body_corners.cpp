// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/pairs/body_corners.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Planes whose normals span less than this have no point in common.
constexpr double parallel = 1e-9;
/// By how much planes may move and turn, over the size of their body.
constexpr double deformation = 2e-3;

/// Six times the volume that three unit normals span.
double spanned(const ContactPlane& a, const ContactPlane& b, const ContactPlane& c)
{
    return dot(a.normal, cross(b.normal, c.normal));
}

Vector common_point(
    const ContactPlane& a, const ContactPlane& b, const ContactPlane& c, double volume)
{
    return (1.0 / volume)
        * (a.offset * cross(b.normal, c.normal) + b.offset * cross(c.normal, a.normal)
            + c.offset * cross(a.normal, b.normal));
}

double size_of(const std::vector<ContactPlane>& planes)
{
    double size = 0.0;
    for (const ContactPlane& p : planes)
        size = std::max(size, std::abs(p.offset));
    return size;
}

/// How far a point is outside of a plane.
double outside(const ContactPlane& p, Vector at) { return dot(p.normal, at) - p.offset; }

/// Collect the planes near a point. Return false if one of them has it outside by more than the margin.
bool find_near(const std::vector<ContactPlane>& planes, const std::array<int, 3>& own, Vector at,
    double margin, std::vector<int>& near)
{
    near.clear();
    for (int k = 0; k < static_cast<int>(planes.size()); ++k) {
        if (std::find(own.begin(), own.end(), k) != own.end()) continue;
        const double beyond = outside(planes[k], at);
        if (beyond > margin) return false;
        if (beyond > -margin) near.push_back(k);
    }
    return true;
}

}  // namespace

std::vector<BodyCorner> corners_behind(const std::vector<ContactPlane>& planes)
{
    const auto count = static_cast<int>(planes.size());
    const double size = size_of(planes);
    std::vector<BodyCorner> corners;
    std::vector<int> near;
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            for (int c = b + 1; c < count; ++c) {
                const double volume = spanned(planes[a], planes[b], planes[c]);
                const double spread = std::max(std::abs(volume), parallel);
                const Vector at =
                    common_point(planes[a], planes[b], planes[c], std::copysign(spread, volume));
                // a point of planes that are nearly parallel moves far
                const double margin = deformation * size * (1.0 + 3.0 / spread);
                if (find_near(planes, { a, b, c }, at, margin, near))
                    corners.push_back({ { a, b, c }, near });
            }
        }
    }
    return corners;
}

void place_corners(const std::vector<ContactPlane>& planes, const std::vector<BodyCorner>& corners,
    std::vector<Vector>& positions)
{
    const double tie = 1e-13 * size_of(planes);
    positions.clear();
    for (const BodyCorner& corner : corners) {
        const auto [a, b, c] = corner.planes;
        const double volume = spanned(planes[a], planes[b], planes[c]);
        if (std::abs(volume) < parallel) continue;
        const Vector at = common_point(planes[a], planes[b], planes[c], volume);
        if (std::none_of(corner.near.begin(), corner.near.end(),
                [&](int k) { return outside(planes[k], at) > tie; })) {
            positions.push_back(at);
        }
    }
}

}  // namespace flexpm
