// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear elasticity of the grains in space. Tension positive. SI units.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>
#include <flexpm/kernel/law/elastic.hpp>

namespace flexpm {

/// Symmetric tensor of space.
struct SpaceTensor {
    double xx, yy, zz, yz, xz, xy;
};

/// Product with a vector.
FLEXPM_INLINE Vector operator*(const SpaceTensor& t, Vector a)
{
    return { t.xx * a.x + t.xy * a.y + t.xz * a.z, t.xy * a.x + t.yy * a.y + t.yz * a.z,
        t.xz * a.x + t.yz * a.y + t.zz * a.z };
}

/// Stiffness of a material in space: its three numbers are those of plane strain.
/// @throws std::invalid_argument  if a property is not finite or out of range
inline PlaneStiffness solid_stiffness(ElasticMaterial material)
{
    material.plane = Plane::strain;
    return plane_stiffness(material);
}

/// Second Piola-Kirchhoff stress [Pa] of a Green-Lagrange strain.
FLEXPM_INLINE SpaceTensor stress(const PlaneStiffness& c, const SpaceTensor& e)
{
    const double all = c.cross * (e.xx + e.yy + e.zz), twice = 2.0 * c.shear;
    return { all + twice * e.xx, all + twice * e.yy, all + twice * e.zz, twice * e.yz, twice * e.xz,
        twice * e.xy };
}

}  // namespace flexpm
