// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Power cells of points with any weights in a solid.
#pragma once

#include <flexpm/kernel/space/cell_complex.hpp>
#include <flexpm/kernel/space/solid.hpp>

#include <vector>

namespace flexpm {

/// Points whose cells are {x : |x - p_i|^2 - w_i is least}. A point may lie outside its cell and
/// outside the solid, and a weight may be below 0: adding a number to all weights changes no cell.
struct WeightedPoints {
    std::vector<Vector> points;   ///< [m], no two in one place
    std::vector<double> weights;  ///< [m^2]
};

/// Power cells with their measures. A point that others hide has volume 0 and no face.
struct WeightedCells {
    CellComplex complex;
    std::vector<double> volumes;    ///< [m^3]
    std::vector<Vector> centroids;  ///< [m]; of a hidden point, the point
};

/// Power cells in a solid, before short edges are collapsed.
///
/// @throws std::invalid_argument  for no point, a number that is not finite, other numbers of
///                                points and weights, or two points in one place
WeightedCells weighted_cells(const WeightedPoints& given, const Solid& solid);

}  // namespace flexpm
