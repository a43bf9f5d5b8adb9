// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/plate_points.hpp>

#include <flexpm/kernel/parts/plate_springs.hpp>

#include <algorithm>
#include <limits>

namespace flexpm {

namespace {

/// Stored along the face at a point [J].
double shear_energy(const Plate& p, int index)
{
    const double stiffness = sliding_stiffness(p, index);
    if (!(stiffness > 0.0)) return 0.0;
    return 0.5 * dot(p.points[index].shear, p.points[index].shear) / stiffness;
}

bool lies_on_triangles(const Plate& p)
{
    return std::any_of(p.points.begin(), p.points.end(),
        [](const PlatePoint& point) { return point.weights[2] != 0.0; });
}

bool are_alike(const Plate& p, const Plate& q)
{
    const auto same = [](const PlatePoint& one, const PlatePoint& other) {
        return one.facet == other.facet && one.area == other.area && one.weights == other.weights;
    };
    return q.side == p.side
        && std::equal(p.points.begin(), p.points.end(), q.points.begin(), q.points.end(), same)
        && q.normal.x == p.normal.x && q.normal.y == p.normal.y && q.normal.z == p.normal.z
        && q.friction == p.friction && q.bonded == p.bonded && q.strip == p.strip
        && q.jaw_radius == p.jaw_radius && q.seated == p.seated;
}

}  // namespace

std::array<Vector, 2> face_axes(Vector normal)
{
    if (normal.z == 0.0) return { Vector { -normal.y, normal.x, 0.0 }, { 0.0, 0.0, 1.0 } };
    return seat_axes(normal);
}

double least_gap(const Plate& p)
{
    double least = std::numeric_limits<double>::infinity();
    for (const PlatePoint& point : p.points)
        least = std::min(least, point.gap);
    return least;
}

Vector point_shear(const Plate& p, int index)
{
    const auto [first, second] = face_axes(point_normal(p, index));
    return p.points[index].shear.x * first + p.points[index].shear.y * second;
}

Vector point_force(const Plate& p, int index)
{
    return point_push(p, index) * point_normal(p, index) + point_shear(p, index);
}

double elastic_energy(const Plate& p)
{
    // the order of the sums, which gives the last digit, is that of each dimension's first version
    const bool apart = lies_on_triangles(p);
    double sum = 0.0;
    for (int i = 0; i < plate_points(p); ++i) {
        sum -= 0.5 * point_push(p, i) * p.points[i].opening;
        if (!apart) sum += shear_energy(p, i);
    }
    for (int i = 0; apart && i < plate_points(p); ++i)
        sum += shear_energy(p, i);
    return sum;
}

double pressed_area(const Plate& p)
{
    double area = 0.0;
    for (const PlatePoint& point : p.points)
        if (point.opening < 0.0) area += point.area;
    return area;
}

int find_alike(const std::vector<Plate>& plates, const Plate& plate)
{
    const auto found = std::find_if(
        plates.begin(), plates.end(), [&](const Plate& there) { return are_alike(there, plate); });
    return found == plates.end() ? -1 : static_cast<int>(found - plates.begin());
}

}  // namespace flexpm
