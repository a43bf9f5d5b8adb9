// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Products of 3x3 matrices that are given by rows, in the solvers of equilibrium.
#pragma once

#include <flexpm/kernel/fem/tetrahedron.hpp>

namespace flexpm {

inline Vector product(const SpaceGradient& a, Vector v)
{
    return { dot(a.x, v), dot(a.y, v), dot(a.z, v) };
}

inline SpaceGradient transposed(const SpaceGradient& a)
{
    return { { a.x.x, a.y.x, a.z.x }, { a.x.y, a.y.y, a.z.y }, { a.x.z, a.y.z, a.z.z } };
}

inline SpaceGradient product(const SpaceGradient& a, const SpaceGradient& b)
{
    const SpaceGradient columns = transposed(b);
    return transposed({ product(a, columns.x), product(a, columns.y), product(a, columns.z) });
}

}  // namespace flexpm
