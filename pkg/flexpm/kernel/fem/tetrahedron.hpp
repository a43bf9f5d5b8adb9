// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Constant-strain tetrahedron, total Lagrangian: exact under large rotation, the twin in
/// space of triangle.hpp. Tension positive.
#pragma once

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/law/solid_elastic.hpp>

namespace flexpm {

/// Reference shape: gradients of the shape functions of nodes 1 to 3, and the volume.
struct TetrahedronShape {
    Vector g1, g2, g3;  ///< [1/m]
    double volume;      ///< [m^3]
};

/// Shape of a tetrahedron.
/// @throws std::invalid_argument  unless the ways from node 0 to nodes 1, 2, 3 are right-handed
TetrahedronShape tetrahedron_shape(Vector p0, Vector p1, Vector p2, Vector p3);

/// Displacement gradient H by rows: x is the gradient of the x displacement.
struct SpaceGradient {
    Vector x, y, z;
};

/// Displacement gradient from the displacements of the four nodes [m], not from their positions:
/// small strains keep all their digits.
FLEXPM_INLINE SpaceGradient displacement_gradient(
    const TetrahedronShape& s, Vector u0, Vector u1, Vector u2, Vector u3)
{
    const Vector a = u1 - u0, b = u2 - u0, c = u3 - u0;
    return { a.x * s.g1 + b.x * s.g2 + c.x * s.g3, a.y * s.g1 + b.y * s.g2 + c.y * s.g3,
        a.z * s.g1 + b.z * s.g2 + c.z * s.g3 };
}

/// Green-Lagrange strain [-], deviation D47: H + H^T + H^T H over 2, with I + H in the products, so
/// that small strains keep all their digits.
FLEXPM_INLINE SpaceTensor green_strain(const SpaceGradient& h)
{
    const double x = 1.0 + h.x.x, y = 1.0 + h.y.y, z = 1.0 + h.z.z;
    return { 0.5 * ((1.0 + x) * h.x.x + h.y.x * h.y.x + h.z.x * h.z.x),
        0.5 * (h.x.y * h.x.y + (1.0 + y) * h.y.y + h.z.y * h.z.y),
        0.5 * (h.x.z * h.x.z + h.y.z * h.y.z + (1.0 + z) * h.z.z),
        0.5 * (h.x.y * h.x.z + y * h.y.z + h.z.y * z),
        0.5 * (x * h.x.z + h.y.x * h.y.z + h.z.x * z),
        0.5 * (x * h.x.y + h.y.x * y + h.z.x * h.z.y) };
}

/// First Piola-Kirchhoff stress (I + H) S by rows [Pa].
FLEXPM_INLINE SpaceGradient first_stress(const SpaceGradient& h, const SpaceTensor& p)
{
    return { p * Vector { 1.0 + h.x.x, h.x.y, h.x.z }, p * Vector { h.y.x, 1.0 + h.y.y, h.y.z },
        p * Vector { h.z.x, h.z.y, 1.0 + h.z.z } };
}

/// Forces that a tetrahedron exerts on its nodes 1 to 3 [N]; node 0 gets minus their sum.
struct TetrahedronForces {
    Vector f1, f2, f3;
};

/// Forces of a tetrahedron on its nodes.
/// @param u0, u1, u2, u3  displacements of the nodes [m]
FLEXPM_INLINE TetrahedronForces tetrahedron_forces(
    const TetrahedronShape& s, const PlaneStiffness& c, Vector u0, Vector u1, Vector u2, Vector u3)
{
    const SpaceGradient h = displacement_gradient(s, u0, u1, u2, u3);
    // minus the volume once, not in each component of a force
    const PlaneStiffness whole { -s.volume * c.normal, -s.volume * c.cross, -s.volume * c.shear };
    const SpaceGradient p = first_stress(h, stress(whole, green_strain(h)));
    const auto force = [&](Vector g) { return Vector { dot(p.x, g), dot(p.y, g), dot(p.z, g) }; };
    return { force(s.g1), force(s.g2), force(s.g3) };
}

/// Strain energy of the tetrahedron [J].
FLEXPM_INLINE double tetrahedron_energy(
    const TetrahedronShape& s, const PlaneStiffness& c, Vector u0, Vector u1, Vector u2, Vector u3)
{
    const SpaceTensor e = green_strain(displacement_gradient(s, u0, u1, u2, u3));
    const SpaceTensor p = stress(c, e);
    return 0.5 * s.volume
        * (p.xx * e.xx + p.yy * e.yy + p.zz * e.zz
            + 2.0 * (p.yz * e.yz + p.xz * e.xz + p.xy * e.xy));
}

/// Cauchy stress [Pa].
SpaceTensor cauchy_stress(
    const TetrahedronShape& s, const PlaneStiffness& c, Vector u0, Vector u1, Vector u2, Vector u3);

/// Second moments of its volume about the origin, the integral of r r^T [m^5], of a tetrahedron
/// with these corners. Its sign is that of the volume.
SpaceTensor second_moments(Vector p0, Vector p1, Vector p2, Vector p3);

/// Tensor of inertia of a body with these second moments of its mass: trace less moments [kg m^2].
SpaceTensor inertia_of(const SpaceTensor& moments);

/// 3x3 block of the linear stiffness between nodes a and b (0..3) at the reference shape [N/m], by
/// rows: the force of the element on node a is minus the block times the displacement of node b.
SpaceGradient stiffness_block(const TetrahedronShape& s, const PlaneStiffness& c, int a, int b);

/// The same of any two shape functions with these gradients [1/m] over a volume [m^3].
SpaceGradient stiffness_block(Vector u, Vector v, double volume, const PlaneStiffness& c);

}  // namespace flexpm
