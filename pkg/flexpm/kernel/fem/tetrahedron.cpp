// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Set-up, true stress and linear stiffness of a tetrahedron; what a step needs is in the
/// header.
#include <flexpm/kernel/fem/tetrahedron.hpp>

#include <array>

namespace flexpm {

TetrahedronShape tetrahedron_shape(Vector p0, Vector p1, Vector p2, Vector p3)
{
    const Vector a = p1 - p0, b = p2 - p0, c = p3 - p0;
    const double six_volumes = triple(a, b, c);
    if (!(six_volumes > 0.0)) {
        refuse("tetrahedron volume", six_volumes / 6.0, "m^3", "nodes must be right-handed");
    }
    const double factor = 1.0 / six_volumes;
    return { factor * cross(b, c), factor * cross(c, a), factor * cross(a, b), six_volumes / 6.0 };
}

SpaceTensor cauchy_stress(
    const TetrahedronShape& s, const PlaneStiffness& c, Vector u0, Vector u1, Vector u2, Vector u3)
{
    const SpaceGradient h = displacement_gradient(s, u0, u1, u2, u3);
    const SpaceGradient p = first_stress(h, stress(c, green_strain(h)));
    const Vector fx = Vector { 1.0, 0.0, 0.0 } + h.x, fy = Vector { 0.0, 1.0, 0.0 } + h.y,
                 fz = Vector { 0.0, 0.0, 1.0 } + h.z;
    const double ratio = 1.0 / triple(fx, fy, fz);
    return { ratio * dot(p.x, fx), ratio * dot(p.y, fy), ratio * dot(p.z, fz), ratio * dot(p.y, fz),
        ratio * dot(p.x, fz), ratio * dot(p.x, fy) };
}

SpaceTensor second_moments(Vector p0, Vector p1, Vector p2, Vector p3)
{
    const double factor = triple(p1 - p0, p2 - p0, p3 - p0) / 120.0;
    SpaceTensor sum { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    for (const Vector& r : { p0, p1, p2, p3, p0 + p1 + p2 + p3 }) {
        sum.xx += factor * r.x * r.x;
        sum.yy += factor * r.y * r.y;
        sum.zz += factor * r.z * r.z;
        sum.yz += factor * r.y * r.z;
        sum.xz += factor * r.x * r.z;
        sum.xy += factor * r.x * r.y;
    }
    return sum;
}

SpaceTensor inertia_of(const SpaceTensor& m)
{
    return { m.yy + m.zz, m.xx + m.zz, m.xx + m.yy, -m.yz, -m.xz, -m.xy };
}

SpaceGradient stiffness_block(const TetrahedronShape& s, const PlaneStiffness& c, int a, int b)
{
    const std::array<Vector, 4> g = { -(s.g1 + s.g2 + s.g3), s.g1, s.g2, s.g3 };
    return stiffness_block(g[a], g[b], s.volume, c);
}

SpaceGradient stiffness_block(Vector u, Vector v, double volume, const PlaneStiffness& c)
{
    // cross u v^T + shear (v u^T + (u . v) I)
    const double shear = volume * c.shear, cross = volume * c.cross, both = shear * dot(u, v);
    return { cross * u.x * v + shear * v.x * u + Vector { both, 0.0, 0.0 },
        cross * u.y * v + shear * v.y * u + Vector { 0.0, both, 0.0 },
        cross * u.z * v + shear * v.z * u + Vector { 0.0, 0.0, both } };
}

}  // namespace flexpm
