// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What discs must fulfil before they are given Laguerre cells, paper Sec. 3.1.
#pragma once

#include <flexpm/kernel/geometry/cells.hpp>
#include <flexpm/kernel/geometry/outline.hpp>

#include <vector>

namespace flexpm {

/// Check that all discs are sound and inside the outline.
/// @throws std::invalid_argument  for no disc, a non-finite number, a radius <= 0, or a centre
///                                outside
void require_discs_inside(const std::vector<Disc>& discs, const Outline& outline);

/// Check that the discs are those of the cells: each cell has a sound one.
/// @throws std::invalid_argument  if there are too few, or one has a non-finite number or a radius
///         <= 0
void require_disc_of_each_cell(const Tessellation& tessellation, const std::vector<Disc>& discs);

/// For each disc, whether a larger one (of equal ones: an earlier one) has its centre in the same
/// place, to 1e-6 of the mean diameter. The radical axis of such a pair is lost in round-off.
std::vector<bool> find_coincident(const std::vector<Disc>& discs);

}  // namespace flexpm
