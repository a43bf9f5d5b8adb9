// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Set-up, true stress and linear stiffness of a triangle; what a step needs is in the
/// header.
#include <flexpm/kernel/fem/triangle.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <array>

namespace flexpm {

TriangleShape triangle_shape(Point p0, Point p1, Point p2, double thickness)
{
    const Point a = p1 - p0, b = p2 - p0;
    const double twice_area = cross(a, b);
    if (!(twice_area > 0.0)) {
        refuse("triangle area", 0.5 * twice_area, "m^2", "nodes must be counter-clockwise");
    }
    return { b.y / twice_area, -b.x / twice_area, -a.y / twice_area, a.x / twice_area,
        0.5 * twice_area * thickness };
}

Tensor cauchy_stress(const TriangleShape& s, const PlaneStiffness& c, Point u0, Point u1, Point u2)
{
    const Gradient h = displacement_gradient(s, u0, u1, u2);
    const Gradient p = first_stress(h, stress(c, green_strain(h)));
    const double fxx = 1.0 + h.xx, fyy = 1.0 + h.yy;
    const double volume_ratio = fxx * fyy - h.xy * h.yx;
    return { (p.xx * fxx + p.xy * h.xy) / volume_ratio, (p.yx * h.yx + p.yy * fyy) / volume_ratio,
        (p.xx * h.yx + p.xy * fyy) / volume_ratio };
}

StiffnessBlock stiffness_block(const TriangleShape& s, const PlaneStiffness& c, int a, int b)
{
    const std::array<Point, 3> g = { { { -s.g1x - s.g2x, -s.g1y - s.g2y }, { s.g1x, s.g1y },
        { s.g2x, s.g2y } } };
    const Point u = g[a], v = g[b];
    return { s.volume * (c.normal * u.x * v.x + c.shear * u.y * v.y),
        s.volume * (c.cross * u.x * v.y + c.shear * u.y * v.x),
        s.volume * (c.cross * u.y * v.x + c.shear * u.x * v.y),
        s.volume * (c.normal * u.y * v.y + c.shear * u.x * v.x) };
}

}  // namespace flexpm
