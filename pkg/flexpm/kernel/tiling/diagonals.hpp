// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Diagonals of polygons, along which cells are split and cut.
#pragma once

#include <flexpm/kernel/tiling/planar_cells.hpp>

#include <vector>

namespace flexpm {

/// Whether the segment between two corners runs inside a simple polygon, corners counter-clockwise.
bool is_diagonal(const std::vector<Point>& polygon, int i, int j);

/// Angle inside a polygon at a corner [rad], from 0 to 2 pi.
double angle_at(const std::vector<Point>& polygon, std::size_t k);

/// Whether a point lies on the straight line between two others, to within round-off.
bool is_between(Point a, Point p, Point b);

/// Part of a loop from its place i to its place j, both included.
Loop part_of(const Loop& loop, int i, int j);

}  // namespace flexpm
