// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pairs of boxes that meet, among many of similar size. SI units.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Box with edges along the axes.
struct AxisBox {
    Vector low, high;  ///< [m]
};

/// Numbers (i, k) of boxes that have a point in common, i < k, ascending. Boxes without finite
/// corners meet none. The time grows with the number of boxes if their sizes are similar.
std::vector<std::array<int, 2>> meeting_boxes(const std::vector<AxisBox>& boxes);

}  // namespace flexpm
