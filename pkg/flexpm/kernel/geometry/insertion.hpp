// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Random insertion of shrunken discs, the start of a packing, paper Sec. 3.1.
#pragma once

#include <flexpm/kernel/geometry/outline.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Random centres so that discs of `shrink` times the radii overlap neither each other nor the
/// outline. The largest disc is placed first; the result is in the order of `radii`.
///
/// @throws std::invalid_argument  if a disc finds no place in 10000 tries
std::vector<Point> insert_discs(
    const std::vector<double>& radii, const Outline& outline, double shrink, std::uint64_t seed);

}  // namespace flexpm
