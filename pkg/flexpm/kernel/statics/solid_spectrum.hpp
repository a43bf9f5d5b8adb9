// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Largest frequency of an intact specimen in space, and masses that come close to what it
/// asks for. The bound of solid_masses.hpp lies well above it. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Square of the largest frequency with the present masses, by Lanczos' method, no lower than the
/// true one but for what the residual leaves open [1/s^2].
double largest_square_frequency(const SolidState& s);

/// Masses by the bound (scale_masses()), all times the same factor, so that the largest frequency
/// is that at which a step is stable, with the margin of Eq. 18.
/// @throws std::invalid_argument  as scale_masses()
void scale_masses_closely(SolidState& s, double damping, double dt = 1.0);

}  // namespace flexpm
