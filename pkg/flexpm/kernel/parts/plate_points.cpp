// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/plate_points.hpp>

#include <algorithm>

namespace flexpm {

namespace {

double squared(Vector v) { return dot(v, v); }

/// Stored along the face at a point [J].
double shear_energy(const Plate& p, int index)
{
    const double stiffness = sliding_stiffness(p, index);
    if (!(stiffness > 0.0)) return 0.0;
    const double of_force = has_three_axes(p, p.shear_force)
        ? squared(three_axes(p.shear_force, index))
        : p.shear_force[index] * p.shear_force[index];
    return 0.5 * of_force / stiffness;
}

bool are_alike(const Plate& p, const Plate& q)
{
    return q.side == p.side && q.facets == p.facets && q.area == p.area && q.shares == p.shares
        && q.normal.x == p.normal.x && q.normal.y == p.normal.y && q.normal.z == p.normal.z
        && q.friction == p.friction && q.bonded == p.bonded && q.strip == p.strip
        && q.jaw_radius == p.jaw_radius && q.seated == p.seated;
}

}  // namespace

Vector point_shear(const Plate& p, int index)
{
    if (p.shear_force.empty()) return {};
    if (has_three_axes(p, p.shear_force)) return three_axes(p.shear_force, index);
    const Vector normal = point_normal(p, index);
    return p.shear_force[index] * Vector { -normal.y, normal.x, 0.0 };
}

Vector point_force(const Plate& p, int index)
{
    return point_push(p, index) * point_normal(p, index) + point_shear(p, index);
}

double elastic_energy(const Plate& p)
{
    // the order of the sums, which gives the last digit, is that of each dimension's first version
    const bool apart = has_three_axes(p, p.shear_force);
    double sum = 0.0;
    for (int i = 0; i < plate_points(p); ++i) {
        sum -= 0.5 * point_push(p, i) * p.opening[i];
        if (!apart) sum += shear_energy(p, i);
    }
    for (int i = 0; apart && i < plate_points(p); ++i)
        sum += shear_energy(p, i);
    return sum;
}

double pressed_area(const Plate& p)
{
    double area = 0.0;
    for (int i = 0; i < plate_points(p); ++i)
        if (p.opening[i] < 0.0) area += p.area[i];
    return area;
}

int find_alike(const std::vector<Plate>& plates, const Plate& plate)
{
    const auto found = std::find_if(
        plates.begin(), plates.end(), [&](const Plate& there) { return are_alike(there, plate); });
    return found == plates.end() ? -1 : static_cast<int>(found - plates.begin());
}

}  // namespace flexpm
