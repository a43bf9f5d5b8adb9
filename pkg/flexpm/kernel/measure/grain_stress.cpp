// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/grain_stress.hpp>

#include <flexpm/kernel/geometry/polygon.hpp>

#include <vector>

namespace flexpm {

namespace {

/// A tensor over a volume. The quotient in 2D and the product in 3D may differ in the last digit.
SpaceTensor over(const Grains& grains, const SpaceTensor& t, double volume)
{
    if (grains.layout.dimension == 3) return sum_of({}, 1.0 / volume, t);
    return { t.xx / volume, t.yy / volume, 0.0, 0.0, 0.0, t.xy / volume };
}

}  // namespace

SpaceTensor sum_of(const SpaceTensor& a, double factor, const SpaceTensor& b)
{
    return { a.xx + factor * b.xx, a.yy + factor * b.yy, a.zz + factor * b.zz, a.yz + factor * b.yz,
        a.xz + factor * b.xz, a.xy + factor * b.xy };
}

SpaceTensor product_of(Vector f, Vector r)
{
    return { f.x * r.x, f.y * r.y, f.z * r.z, 0.5 * (f.y * r.z + f.z * r.y),
        0.5 * (f.x * r.z + f.z * r.x), 0.5 * (f.x * r.y + f.y * r.x) };
}

double cell_area(const Grains& grains, int grain)
{
    std::vector<Point> corners;
    for (int n = 0; n < grains.vertices_of(grain); ++n)
        corners.push_back(grains.reference_at(grains.node(grain, n)));
    return polygon_shape(corners).area;
}

SpaceTensor mean_stress(const Grains& grains, const Array<double>& forces, int grain,
    const SpaceTensor& sum, double volume)
{
    if (!grains.is_rigid(grain)) return over(grains, sum, volume);
    SpaceTensor total {};
    for_each_corner_force(grains, forces, grain, [&](Vector force, Vector arm) {
        total = sum_of(total, 1.0, over(grains, product_of(force, arm), volume));
    });
    return total;
}

}  // namespace flexpm
