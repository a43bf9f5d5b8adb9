// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Walks over the neighbours of cells.
#include <flexpm/kernel/labels/voxel_cells.hpp>

#include <string>

namespace flexpm {

std::vector<int> cells_of_voxels(
    const WeightedPoints& given, const CellComplex& cells, const VoxelGrid& grid)
{
    for (int count : grid.counts)
        if (count < 1) {
            refuse("cells_of_voxels: voxels along an axis", std::to_string(count),
                "must be 1 or more; give the counts of the grid");
        }
    if (given.points.size() != static_cast<std::size_t>(cells.cells)) {
        refuse("cells_of_voxels: cells", std::to_string(cells.cells),
            "must be those of " + std::to_string(given.points.size()) + " points; give them");
    }
    std::vector<std::vector<int>> neighbours(cells.cells);
    for (const CellFace& face : cells.faces) {
        if (face.second < 0) continue;
        neighbours[face.first].push_back(face.second);
        neighbours[face.second].push_back(face.first);
    }
    int at = cells.faces.empty() ? 0 : cells.faces.front().first;
    const auto distance = [&](int cell, Vector x) {
        const Vector d = x - given.points[cell];
        return dot(d, d) - given.weights[cell];
    };
    std::vector<int> found;
    found.reserve(static_cast<std::size_t>(grid.counts[0]) * grid.counts[1] * grid.counts[2]);
    for (int k = 0; k < grid.counts[2]; ++k)
        for (int j = 0; j < grid.counts[1]; ++j)
            for (int i = 0; i < grid.counts[0]; ++i) {
                const Vector x = grid.corner
                    + Vector { (i + 0.5) * grid.size.x, (j + 0.5) * grid.size.y,
                          (k + 0.5) * grid.size.z };
                double least = distance(at, x);
                for (bool moved = true; moved;) {
                    moved = false;
                    for (int next : neighbours[at]) {
                        const double there = distance(next, x);
                        if (there >= least) continue;
                        least = there;
                        at = next;
                        moved = true;
                        break;
                    }
                }
                found.push_back(at);
            }
    return found;
}

}  // namespace flexpm
