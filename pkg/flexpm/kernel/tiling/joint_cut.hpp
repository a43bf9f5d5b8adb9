// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells cut by joints: what one cuts becomes two cells, with a contact of the joint between
/// them. SI units.
/// Deviation D35: what a cut may leave.
#pragma once

#include <flexpm/kernel/tiling/joint_path.hpp>

#include <functional>

namespace flexpm {

/// What came of a line. What is neither cut nor taken nor outside ends within grains, or runs along
/// the outline.
struct LineCut {
    double length = 0.0;   ///< of the line as it was asked for [m]
    double cut = 0.0;      ///< where it has made contacts of its joint [m]
    double taken = 0.0;    ///< where it lies on contacts that had a joint before [m]
    double outside = 0.0;  ///< outside of all cells [m]
    int on = -1;           ///< the joint on which most of `taken` lies
    int contacts = 0;      ///< that it has made
};

/// Cells cut by joints, and what came of each line.
struct JointCut {
    Tiling tiling;
    std::vector<LineCut> lines;
};

/// Cut cells by the lines of joints, one after the other. Within a cell a line is straight. Where a
/// cut would leave a piece below 2 % of the area of a mean cell, an angle below 5 degrees, or a
/// piece whose edges no point sees, the joint goes along edges around it. An edge keeps the joint
/// that it got first. A cell that is not cut keeps its disc as long as its centre sees all edges. A
/// line, or a part of one, that lies outside cuts nothing.
///
/// @param discs   of the cells
/// @param joints  per shared edge: joint that it has already, -1: none; empty: none has one
/// @param tell    called with the number of lines done, if there is one
/// @throws std::invalid_argument  for a line of less than two points, without length, with a point
///         that is not finite, or that reaches further than 1e6 sizes
JointCut cut_by_joints(const Tessellation& tessellation, const std::vector<Disc>& discs,
    const std::vector<int>& joints, const std::vector<JointLine>& lines,
    const std::function<void(std::size_t)>& tell = {});

}  // namespace flexpm
