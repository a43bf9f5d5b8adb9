// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A diagonal leaves both of its ends into the polygon and meets no other edge.
#include <flexpm/kernel/tiling/diagonals.hpp>

#include <cmath>

namespace flexpm {

namespace {

/// Share of a length below which a distance is round-off.
constexpr double round_off = 1e-9;

}  // namespace

bool is_diagonal(const std::vector<Point>& p, int i, int j)
{
    const int n = static_cast<int>(p.size());
    const auto at = [&](int k) { return p[(k + n) % n]; };
    const Point a = p[i], b = p[j];
    const auto leaves_inside = [&](int k, Point to) {
        const Point out = at(k + 1) - p[k], in = at(k - 1) - p[k], way = to - p[k];
        const bool convex = cross(out, in) >= 0.0;
        const bool left = cross(out, way) > 0.0, right = cross(way, in) > 0.0;
        return convex ? left && right : left || right;
    };
    if (!leaves_inside(i, b) || !leaves_inside(j, a)) return false;
    for (int k = 0; k < n; ++k) {
        const int l = (k + 1) % n;
        if (k == i || k == j || l == i || l == j) continue;
        const double of_k = cross(b - a, p[k] - a), of_l = cross(b - a, p[l] - a);
        const double of_a = cross(p[l] - p[k], a - p[k]), of_b = cross(p[l] - p[k], b - p[k]);
        if (of_k * of_l <= 0.0 && of_a * of_b <= 0.0) return false;
    }
    return true;
}

double angle_at(const std::vector<Point>& polygon, std::size_t k)
{
    const std::size_t n = polygon.size();
    const Point u = polygon[(k + 1) % n] - polygon[k], v = polygon[(k + n - 1) % n] - polygon[k];
    const double angle = std::atan2(cross(u, v), dot(u, v));
    return angle < 0.0 ? angle + 2.0 * pi : angle;
}

bool is_between(Point a, Point p, Point b)
{
    const Point way = b - a;
    return dot(p - a, p - b) <= 0.0 && std::abs(cross(way, p - a)) <= round_off * dot(way, way);
}

Loop part_of(const Loop& loop, int i, int j)
{
    Loop part;
    for (int k = i; k != j; k = (k + 1) % static_cast<int>(loop.size()))
        part.push_back(loop[k]);
    part.push_back(loop[j]);
    return part;
}

}  // namespace flexpm
