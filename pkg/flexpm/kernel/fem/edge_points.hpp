// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of a contact along an edge, paper Sec. 2.5.
#pragma once

#include <array>

namespace flexpm {

/// Place (share of the edge's second end) and share of area of each point: Lobatto.
struct EdgePoints {
    std::array<double, 3> weight;
    std::array<double, 3> share;
};

/// @param points  1, 2 or 3; what lies behind is 0
inline EdgePoints edge_points(int points)
{
    if (points == 1) return { { 0.5 }, { 1.0 } };
    if (points == 2) return { { 0.0, 1.0 }, { 0.5, 0.5 } };
    return { { 0.0, 0.5, 1.0 }, { 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0 } };
}

}  // namespace flexpm
