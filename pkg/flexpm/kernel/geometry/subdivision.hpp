// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains cut into small cells of about equal area, each the seat of one inner particle, paper
/// Sec. 4.1 and Fig. 5(e). SI units.
/// Deviation D22: the paper prints inner particles of 0.06 mm; 26 in a grain means 0.6 mm.
#pragma once

#include <flexpm/kernel/geometry/tessellation.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Inner particles on average in a grain, paper Sec. 4.1.
constexpr double inner_particles = 26.0;

/// The cells of all inner particles as one tessellation. Along the edge between two grains, cells meet
/// wherever they face each other: each stretch that two of them share is a shared edge.
struct InnerCells {
    Tessellation cells;
    std::vector<Disc> discs;          ///< one per cell, of its area
    std::vector<int> grain;           ///< per cell: the cell of the coarse tessellation
    std::vector<std::uint8_t> outer;  ///< per shared edge: 1 between two grains
};

/// A corner of a small cell; `tag` belongs to the edge that starts there: the number of the seed on
/// the other side, or -1 - k for edge k of the grain.
struct InnerCorner {
    Point point;
    int tag;
};

/// Seeds of a polygon, relaxed until their power cells have equal areas, and those cells.
struct InnerPacking {
    std::vector<Point> seeds;
    std::vector<std::vector<InnerCorner>> cells;  ///< counter-clockwise
};

/// Lloyd's relaxation with weights that even out the areas (to 1 % of the mean, in most polygons much
/// less). Depends on the polygon alone.
/// @param polygon  counter-clockwise, star-shaped
InnerPacking relax_seeds(const std::vector<Point>& polygon, int count);

/// @param mean_count  inner particles in a grain of mean area, at least 1
/// @throws std::invalid_argument  if mean_count is out of range
InnerCells make_inner_cells(const Tessellation& grains, double mean_count = inner_particles);

}  // namespace flexpm
