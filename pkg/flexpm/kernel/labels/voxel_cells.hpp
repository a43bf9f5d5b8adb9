// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cell of each voxel of a grid.
#pragma once

#include <flexpm/kernel/space/weighted_cells.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Voxels of a box along x, y and z; x is the fastest.
struct VoxelGrid {
    std::array<int, 3> counts;  ///< along x, y, z
    Vector size;                ///< of a voxel [m]
    Vector corner;              ///< of the first voxel [m]
};

/// Cell with the middle of each voxel inside.
///
/// A voxel's cell is found by a walk from cell to neighbour with a smaller power distance, from the
/// cell of the voxel before. In a convex solid the walk ends at the smallest one of all.
///
/// @param cells  power cells of the points, in a solid with all middles inside
/// @throws std::invalid_argument  for a grid without voxels, or cells of other points
std::vector<int> cells_of_voxels(
    const WeightedPoints& given, const CellComplex& cells, const VoxelGrid& grid);

}  // namespace flexpm
