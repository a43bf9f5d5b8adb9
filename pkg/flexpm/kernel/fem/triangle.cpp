// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Constant-strain triangle: set-up, stress, linear stiffness.
#include <flexpm/kernel/fem/triangle.hpp>

#include <flexpm/kernel/core/checks.hpp>

#include <array>

namespace flexpm {

PlaneStiffness plane_stiffness(const ElasticMaterial& m)
{
    check_positive("young", m.young, "Pa");
    if (!(m.poisson > 0.0 && m.poisson < 0.5)) {
        refuse("poisson", m.poisson, "", "must lie between 0 and 0.5");
    }
    check_positive("density", m.density, "kg/m^3");
    const double shear = 0.5 * m.young / (1.0 + m.poisson);
    if (m.plane == Plane::stress) {
        const double normal = m.young / (1.0 - m.poisson * m.poisson);
        return { normal, m.poisson * normal, shear };
    }
    const double scale = m.young / ((1.0 + m.poisson) * (1.0 - 2.0 * m.poisson));
    return { (1.0 - m.poisson) * scale, m.poisson * scale, shear };
}

TriangleShape triangle_shape(Point p0, Point p1, Point p2, double thickness)
{
    const double ax = p1.x - p0.x, ay = p1.y - p0.y;
    const double bx = p2.x - p0.x, by = p2.y - p0.y;
    const double twice_area = ax * by - ay * bx;
    if (!(twice_area > 0.0)) {
        refuse("triangle area", 0.5 * twice_area, "m^2", "nodes must be counter-clockwise");
    }
    return { by / twice_area, -bx / twice_area, -ay / twice_area, ax / twice_area,
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
