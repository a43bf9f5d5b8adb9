// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear elasticity of the grains in plane stress or plane strain, paper Sec. 2.1 and 3.1.
/// Tension positive. SI units.
#pragma once

#include <flexpm/kernel/core/compiler.hpp>

namespace flexpm {

enum class Plane { stress, strain };

/// Elastic properties of a grain.
struct ElasticMaterial {
    double young = 0.0;    ///< [Pa], > 0
    double poisson = 0.0;  ///< [-], 0 < nu < 0.5
    double density = 0.0;  ///< [kg/m^3], > 0
    Plane plane = Plane::stress;

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("young", s.young);
        visit("poisson", s.poisson);
        visit("density", s.density);
        visit("plane", s.plane);
    }
};

/// Plane stiffness: S11 = normal E11 + cross E22, S12 = 2 shear E12 [Pa].
struct PlaneStiffness {
    double normal = 0.0;
    double cross = 0.0;
    double shear = 0.0;

    /// Calls visit(name, member) for all members in the order of their rows.
    template <class Self, class Visitor>
    FLEXPM_INLINE static constexpr void visit_members(Self& s, Visitor&& visit)
    {
        visit("normal", s.normal);
        visit("cross", s.cross);
        visit("shear", s.shear);
    }
};

/// Plane stiffness of a material.
/// @throws std::invalid_argument  if a property is not finite or out of range
PlaneStiffness plane_stiffness(const ElasticMaterial& material);

/// Symmetric tensor of the plane.
struct Tensor {
    double xx, yy, xy;
};

/// Second Piola-Kirchhoff stress [Pa] of a Green-Lagrange strain.
FLEXPM_INLINE Tensor stress(const PlaneStiffness& c, const Tensor& e)
{
    return { c.normal * e.xx + c.cross * e.yy, c.cross * e.xx + c.normal * e.yy,
        2.0 * c.shear * e.xy };
}

}  // namespace flexpm
