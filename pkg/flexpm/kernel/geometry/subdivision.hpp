// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains cut into small cells of about equal area, one for each inner particle, paper
/// Sec. 4.1 and Fig. 5(e). SI units.
/// Deviation D22: the paper prints inner particles of 0.06 mm; 26 in a grain means 0.6 mm.
#pragma once

#include <flexpm/kernel/geometry/cells.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Mean number of inner particles in a grain, paper Sec. 4.1.
constexpr double inner_particles = 26.0;

/// The cells of all inner particles as one tessellation. Along the edge between two grains, cells
/// meet wherever they face each other: each stretch that two of them share is a shared edge.
struct InnerCells {
    Tessellation cells;
    std::vector<Disc> discs;          ///< one per cell, of its area
    std::vector<int> grain;           ///< per cell: the cell of the coarse tessellation
    std::vector<std::uint8_t> outer;  ///< per shared edge: 1 between two grains
};

/// Cut all grains into cells of inner particles.
/// @param mean_count  inner particles in a grain of mean area, at least 1
/// @throws std::invalid_argument  if mean_count is out of range
InnerCells make_inner_cells(const Tessellation& grains, double mean_count = inner_particles);

}  // namespace flexpm
