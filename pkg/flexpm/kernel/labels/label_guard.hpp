// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Levels for which each label has at least a given number of its voxels.
#pragma once

#include <flexpm/kernel/labels/label_fit.hpp>
#include <flexpm/kernel/labels/voxel_cells.hpp>

#include <vector>

namespace flexpm {

/// All voxels of a grid, and the labels that compete for them.
struct LabelledGrid {
    VoxelGrid grid;
    std::vector<int> labels;         ///< per voxel, x fastest
    std::vector<int> rival_offsets;  ///< of each label in `rivals`, and the end
    std::vector<int> rivals;         ///< labels near a label, itself included, both ways
    int separate;                    ///< labels from this one on share their voxels (pores)
};

/// Outcome of `raise_levels`.
struct RaisedLevels {
    std::vector<double> levels;
    bool reached;  ///< whether each label has its voxels
};

/// Raise the levels of labels until each label has the largest score in at least `least` of its own
/// voxels.
///
/// A higher level gives voxels to its label and takes voxels from other labels. So each label is
/// raised by no more than it lacks, again and again. If there are such levels for these slopes, the
/// smallest ones above those of the start are found (but for the labels that share their voxels).
///
/// @param least  number of voxels of each label
/// @param most   largest number of raises for each label in the mean
/// @throws std::invalid_argument  for arrays of unlike sizes or indices out of range
RaisedLevels raise_levels(
    const LabelledGrid& voxels, const LabelScores& start, const std::vector<int>& least, int most);

}  // namespace flexpm
