// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What space has besides vectors: volumes, and spheres. SI units everywhere.
#pragma once

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/core/vector.hpp>

namespace flexpm {

/// Volume spanned by three vectors: positive if they are right-handed.
constexpr double triple(Vector a, Vector b, Vector c) { return dot(a, cross(b, c)); }

/// A sphere of the packing: the seed of one grain.
struct Sphere {
    Vector centre;        ///< [m]
    double radius = 0.0;  ///< [m]
};

}  // namespace flexpm
