// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Power cells fitted to the labels of voxels. Lengths in any one unit.
///
/// A power diagram is a linear classifier: the cell of x is the one with the largest score
/// 2 a.x + b. The labels of voxels are fitted as in multinomial logistic regression: the mean of
/// -log of the share that the softmax of score / T gives to the label of a voxel is convex in all
/// (a, b), and for labels of a power diagram it tends to 0.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <vector>

namespace flexpm {

/// Score 2 slope.(x - centre) + level of each label.
struct LabelScores {
    std::vector<Vector> centres;  ///< near the label's voxels, so that no digits are lost
    std::vector<Vector> slopes;
    std::vector<double> levels;

    int labels() const { return static_cast<int>(levels.size()); }
    double at(int label, Vector x) const
    {
        return 2.0 * dot(slopes[label], x - centres[label]) + levels[label];
    }
};

/// Voxels of which the labels are known, and the labels that compete for them.
struct LabelSamples {
    std::vector<Vector> points;      ///< middles of voxels
    std::vector<int> labels;         ///< per point
    std::vector<double> weights;     ///< per point, above 0
    std::vector<int> rival_offsets;  ///< of each label in `rivals`, and the end
    std::vector<int> rivals;         ///< labels near a label, itself included
};

struct LabelFitOptions {
    double temperature = 1.0;  ///< T, in units of a score [length^2]
    double size = 1.0;         ///< mean radius of a label [length]
    double tie = 1e-6;         ///< weight of |a - centre|^2 / size^2 a label
    int steps = 12;            ///< most Newton steps
};

/// Scores that fit the labels better, by a truncated Newton method: conjugate gradients with a
/// block of 4 x 4 for each label, and steps that are halved until the loss falls.
///
/// All sums are in one order: the result has the same bits on any number of threads.
///
/// @throws std::invalid_argument  for arrays of unlike sizes, indices or numbers out of range
LabelScores fit_labels(
    const LabelSamples& samples, const LabelScores& start, const LabelFitOptions& options);

}  // namespace flexpm
