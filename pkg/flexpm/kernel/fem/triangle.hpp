// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Constant-strain triangle, total Lagrangian: exact under large rotation, paper Sec. 2.1.
/// Tension positive.
#pragma once

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/vector.hpp>
#include <flexpm/kernel/law/elastic.hpp>

namespace flexpm {

/// Reference shape: gradients of the shape functions of nodes 1 and 2, and the volume.
struct TriangleShape {
    double g1x = 0.0, g1y = 0.0, g2x = 0.0, g2y = 0.0;  ///< [1/m]
    double volume = 0.0;                                ///< area times thickness [m^3]

    /// Calls visit(name, member) for all members in the order of their rows.
    template <class Self, class Visitor>
    FLEXPM_INLINE static constexpr void visit_members(Self& s, Visitor&& visit)
    {
        visit("g1x", s.g1x);
        visit("g1y", s.g1y);
        visit("g2x", s.g2x);
        visit("g2y", s.g2y);
        visit("volume", s.volume);
    }
};

/// Shape of a triangle of given thickness [m].
/// @throws std::invalid_argument  if the triangle is not counter-clockwise
TriangleShape triangle_shape(Point p0, Point p1, Point p2, double thickness);

/// Displacement gradient H: xy is the derivative of the x displacement along y.
struct Gradient {
    double xx, xy, yx, yy;
};

/// Displacement gradient from the displacements of the three nodes [m], not from their positions:
/// small strains keep all their digits.
FLEXPM_INLINE Gradient displacement_gradient(const TriangleShape& s, Point u0, Point u1, Point u2)
{
    const double ax = u1.x - u0.x, ay = u1.y - u0.y;
    const double bx = u2.x - u0.x, by = u2.y - u0.y;
    return { ax * s.g1x + bx * s.g2x, ax * s.g1y + bx * s.g2y, ay * s.g1x + by * s.g2x,
        ay * s.g1y + by * s.g2y };
}

/// Green-Lagrange strain [-], deviation D47.
FLEXPM_INLINE Tensor green_strain(const Gradient& h)
{
    return { h.xx + 0.5 * (h.xx * h.xx + h.yx * h.yx), h.yy + 0.5 * (h.xy * h.xy + h.yy * h.yy),
        0.5 * (h.xy + h.yx + h.xx * h.xy + h.yx * h.yy) };
}

/// First Piola-Kirchhoff stress (I + H) S [Pa].
FLEXPM_INLINE Gradient first_stress(const Gradient& h, const Tensor& p)
{
    return { p.xx + h.xx * p.xx + h.xy * p.xy, p.xy + h.xx * p.xy + h.xy * p.yy,
        p.xy + h.yx * p.xx + h.yy * p.xy, p.yy + h.yx * p.xy + h.yy * p.yy };
}

/// Forces that a triangle exerts on its nodes 1 and 2 [N]; node 0 gets minus their sum.
struct TriangleForces {
    double f1x, f1y, f2x, f2y;
};

/// Forces of a triangle on its nodes.
/// @param u0, u1, u2  displacements of the nodes [m]
FLEXPM_INLINE TriangleForces triangle_forces(
    const TriangleShape& s, const PlaneStiffness& c, Point u0, Point u1, Point u2)
{
    const Gradient h = displacement_gradient(s, u0, u1, u2);
    const Gradient p = first_stress(h, stress(c, green_strain(h)));
    return { -s.volume * (p.xx * s.g1x + p.xy * s.g1y), -s.volume * (p.yx * s.g1x + p.yy * s.g1y),
        -s.volume * (p.xx * s.g2x + p.xy * s.g2y), -s.volume * (p.yx * s.g2x + p.yy * s.g2y) };
}

/// Strain energy of the triangle [J].
FLEXPM_INLINE double triangle_energy(
    const TriangleShape& s, const PlaneStiffness& c, Point u0, Point u1, Point u2)
{
    const Tensor e = green_strain(displacement_gradient(s, u0, u1, u2));
    const Tensor p = stress(c, e);
    return 0.5 * s.volume * (p.xx * e.xx + p.yy * e.yy + 2.0 * p.xy * e.xy);
}

/// Cauchy stress [Pa].
Tensor cauchy_stress(const TriangleShape& s, const PlaneStiffness& c, Point u0, Point u1, Point u2);

/// 2x2 block of the linear stiffness between nodes a and b (0..2) at the reference shape [N/m],
/// row by row: xx, xy, yx, yy.
struct StiffnessBlock {
    double xx, xy, yx, yy;
};
StiffnessBlock stiffness_block(const TriangleShape& s, const PlaneStiffness& c, int a, int b);

}  // namespace flexpm
