// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Weights of points whose cells have given volumes.
#pragma once

#include <flexpm/kernel/space/weighted_cells.hpp>

#include <vector>

namespace flexpm {

/// Weights for which the cells of the same points have given volumes, by the damped Newton method
/// of Kitagawa, Merigot and Thibert (Journal of the European Mathematical Society 21, 2019): the
/// volumes are the gradient of a concave function of the weights.
///
/// @param given      points, and weights for which each cell has a volume
/// @param volumes    [m^3], each above 0; their sum is the volume of the solid
/// @param tolerance  largest difference of a volume over the given volume [-]
/// @throws std::invalid_argument  for volumes that do not fit, or a hidden point
/// @throws std::runtime_error     if the tolerance is not reached
std::vector<double> weights_of_volumes(const WeightedPoints& given, const Solid& solid,
    const std::vector<double>& volumes, double tolerance);

}  // namespace flexpm
