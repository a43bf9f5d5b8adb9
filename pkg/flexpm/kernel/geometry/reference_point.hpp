// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The point of a cell from which all its edges are seen. Lengths in any one unit.
/// Deviation D32: the centroid, or the centre of the part from which all edges are seen, if that
/// sees them better.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <optional>
#include <vector>

namespace flexpm {

/// Part of a polygon, corners counter-clockwise, from which all its edges are seen; empty if there
/// is none.
std::vector<Point> star_kernel(const std::vector<Point>& polygon);

/// Smallest distance of a point from the lines of all edges, positive on their inner sides.
double clearance(const std::vector<Point>& polygon, Point p);

/// Point that sees all edges from at least 2 % of the radius of a disc of the polygon's area; none
/// if there is none.
std::optional<Point> reference_point(const std::vector<Point>& polygon);

/// Disc of the polygon's area about its reference point, or about the point that sees its edges
/// best.
Disc disc_of_area(const std::vector<Point>& polygon);

}  // namespace flexpm
