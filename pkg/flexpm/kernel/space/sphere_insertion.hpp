// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Random insertion of shrunken spheres, the start of a packing.
#pragma once

#include <flexpm/kernel/space/solid.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Random centres so that spheres of `shrink` times the radii overlap neither each other nor the
/// walls. The largest sphere is placed first; the result is in the order of `radii`.
///
/// @throws std::invalid_argument  if a sphere finds no place in 10000 tries
std::vector<Vector> insert_spheres(
    const std::vector<double>& radii, const Solid& solid, double shrink, std::uint64_t seed);

}  // namespace flexpm
