// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Number and radii of the discs of a specimen, paper Sec. 3.1.
#pragma once

#include <cstdint>
#include <vector>

namespace flexpm {

/// Number of discs N = A (1 - n) / (pi R^2), R the mean radius, rounded to the nearest integer.
///
/// @param area       of the specimen [m^2], > 0
/// @param d_min      smallest diameter [m], > 0
/// @param d_max      largest diameter [m], >= d_min
/// @param porosity   n [-], 0 <= n < 1; sets the number only, the cells leave no pores
/// @throws std::invalid_argument  for an argument out of range or less than one disc
int disc_count(double area, double d_min, double d_max, double porosity);

/// Radii of discs whose diameters are uniform in [d_min, d_max) [m].
std::vector<double> disc_radii(int count, double d_min, double d_max, std::uint64_t seed);

}  // namespace flexpm
