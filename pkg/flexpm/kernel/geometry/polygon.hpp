// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Area, centroid and second moment of area of simple polygons, corners counter-clockwise.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <vector>

namespace flexpm {

struct PolygonShape {
    double area = 0.0;  ///< positive counter-clockwise [m^2]
    Point centroid;
};

/// Area and centroid of a polygon; zero for less than three corners.
PolygonShape polygon_shape(const std::vector<Point>& polygon);

/// Section of a body of unit thickness.
struct PolygonSection {
    double area;   ///< [m^2]
    double polar;  ///< second moment of area about the centroid [m^4]
};

/// Section of a polygon.
/// @param about  point near the polygon, from which the sums are taken
PolygonSection polygon_section(const std::vector<Point>& polygon, Point about);

/// True if the polygon has three corners or more, winds once round the point, and each triangle
/// (point, edge) has an area above `smallest` [m^2].
bool is_star_shaped(const std::vector<Point>& polygon, Point from, double smallest);

}  // namespace flexpm
