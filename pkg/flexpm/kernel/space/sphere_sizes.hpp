// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Number of the spheres of a specimen.
#pragma once

namespace flexpm {

/// Number of spheres N = V (1 - n) / (4/3 pi <R^3>), rounded to the nearest integer. The mean of
/// the cubes, and not the cube of the mean as in the plane (D64): large spheres take more than
/// their share.
///
/// @param volume     of the specimen [m^3], > 0
/// @param d_min      smallest diameter [m], > 0
/// @param d_max      largest diameter [m], >= d_min; diameters are uniform between them
/// @param porosity   n [-], 0 <= n < 1; sets the number only, the cells leave no pores
/// @throws std::invalid_argument  for an argument out of range or less than one sphere
int sphere_count(double volume, double d_min, double d_max, double porosity);

}  // namespace flexpm
