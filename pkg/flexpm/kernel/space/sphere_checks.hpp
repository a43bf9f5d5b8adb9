// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What spheres must fulfil before they are given Laguerre cells.
#pragma once

#include <flexpm/kernel/space/solid.hpp>

#include <vector>

namespace flexpm {

/// Mean diameter [m].
double mean_diameter(const std::vector<Sphere>& spheres);

/// Check that all spheres are sound, inside the solid, and no two in one place: to 1e-6 of the mean
/// diameter.
/// @throws std::invalid_argument  for no sphere, a number that is not finite, a radius <= 0, a
///                                centre outside or in the place of another
void require_spheres_inside(const std::vector<Sphere>& spheres, const Solid& solid);

/// Refuse spheres that others hide.
/// @param hidden  their numbers
/// @throws std::invalid_argument  if there is one
void refuse_hidden(const std::vector<Sphere>& spheres, const std::vector<int>& hidden);

}  // namespace flexpm
